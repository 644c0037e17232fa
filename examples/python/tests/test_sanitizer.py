# SPDX-License-Identifier: MIT
"""The address sanitizer, if it runs, sees what the tests of memory look for: the reading of freed memory."""
import os
import subprocess
import sys

import pytest

PROGRAM = """
import ctypes
c = ctypes.CDLL(None)
c.malloc.restype, c.malloc.argtypes, c.free.argtypes = ctypes.c_void_p, [ctypes.c_size_t], [ctypes.c_void_p]
p = c.malloc(800)
c.free(p)
ctypes.string_at(p, 800)
"""


@pytest.mark.skipif("libasan" not in os.environ.get("LD_PRELOAD", ""), reason="without the address sanitizer")
def test_reading_freed_memory_is_seen():
    run = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True)
    assert run.returncode != 0 and "heap-use-after-free" in run.stderr
