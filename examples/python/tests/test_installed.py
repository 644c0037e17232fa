# SPDX-License-Identifier: MIT
"""The module can be built with an installed moreau, outside the repository."""
import pathlib
import shutil
import subprocess
import sys

import pytest

HERE = pathlib.Path(__file__).parents[1]
TOP = HERE.parents[1]


def run(*command: object) -> str:
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


@pytest.mark.skipif(not shutil.which("ninja"), reason="needs ninja")
def test_installed(tmp_path):
    off = [f"-DMOREAU_BUILD_{part}=OFF" for part in ("TESTS", "BENCHES", "EXAMPLES")]
    run("cmake", "-S", TOP, "-B", tmp_path / "moreau", "-G", "Ninja", *off)
    run("cmake", "--install", tmp_path / "moreau", "--prefix", tmp_path / "prefix")
    shutil.copytree(HERE, tmp_path / "python", ignore=shutil.ignore_patterns("tests"))
    run("cmake", "-S", tmp_path / "python", "-B", tmp_path / "build", "-G", "Ninja", "-DMOREAU_PYTHON_INSTALLED=ON",
        f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}", f"-DPython_EXECUTABLE={sys.executable}")
    commands = run("ninja", "-C", tmp_path / "build", "-t", "commands", "moreau_python").splitlines()
    units = [line for line in commands if " -c " in line]
    assert len(units) == 11  # six of the engine, four shapes, the binding
    assert all(f"{tmp_path}/prefix/include" in line and str(TOP) not in line for line in units)
    (probe := tmp_path / "probe.cpp").write_text('#include "engine.hpp"\n')
    flags = [flag for flag in units[0].split() if flag.startswith(("-std", "-I", "-D"))]
    run("g++", "-fsyntax-only", *flags, f"-I{tmp_path / 'python' / 'engine'}", "-isystem", tmp_path / "prefix" / "include",
        "-isystem", "/usr/include/eigen3", probe)
