# SPDX-License-Identifier: MIT
"""Ctrl-C ends a run after the present step."""
import signal
import subprocess
import sys
import time

PROGRAM = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores the signal for what runs in its background
sys.path.insert(0, {tests!r})
from conftest import heap
s = heap({shape!r}, count=60)
print("begins", flush=True)
try:
    s.run(1e-6, 10**9{each})
except KeyboardInterrupt:
    print("interrupted", s.step(1e-6).points >= 0, flush=True)
"""


def interrupted(each: str) -> float:
    import pathlib
    import moreau
    shape = moreau._moreau.instances()[0][0]
    program = PROGRAM.format(tests=str(pathlib.Path(__file__).parent), shape=shape, each=each)
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begins\n"
    time.sleep(0.3)
    start = time.monotonic()
    process.send_signal(signal.SIGINT)
    text, _ = process.communicate(timeout=60)
    assert text == "interrupted True\n" and process.returncode == 0
    return time.monotonic() - start


def test_a_run_in_cpp():
    assert interrupted("") < 20


def test_a_run_with_a_function():
    assert interrupted(", each=lambda report: None") < 20
