# SPDX-License-Identifier: MIT
"""Each script gives the bits of its C++ twin. The twins are the programs of the other folders, compiled with the flags of
the module; MOREAU_TWINS is their folder."""
import os
import pathlib
import subprocess
import sys

import pytest

import moreau

SCRIPTS = pathlib.Path(__file__).parent.parent
TWINS = os.environ.get("MOREAU_TWINS")
pytestmark = pytest.mark.skipif(not TWINS, reason="MOREAU_TWINS is not set: run.sh sets it")


def python(folder: pathlib.Path, script: str, *arguments: object) -> str:
    folder.mkdir(exist_ok=True)
    run = [sys.executable, SCRIPTS / script, *map(str, arguments)]
    return subprocess.run(run, cwd=folder, check=True, capture_output=True, text=True).stdout


def twin(folder: pathlib.Path, program: str, *arguments: object) -> str:
    folder.mkdir(exist_ok=True)
    run = [pathlib.Path(TWINS) / f"twin_{program}", *map(str, arguments)]
    return subprocess.run(run, cwd=folder, check=True, capture_output=True, text=True).stdout


def test_hello(tmp_path):
    ours = python(tmp_path / "python", "hello.py", "polyhedron", 17)
    assert len(ours.splitlines()) == 40 and ours == twin(tmp_path / "twin", "hello")


@pytest.mark.parametrize("shape", ["polygon", "ball", "disk"])
def test_hello_of_other_shapes(shape, tmp_path):
    lines = python(tmp_path, "hello.py", shape).splitlines()
    assert len(lines) == 40 and int(lines[-1].split()[0]) > 0


def test_packing(tmp_path):
    ours, theirs = python(tmp_path / "python", "packing.py", 17), twin(tmp_path / "twin", "packing")
    assert "at rest" in ours and ours == theirs
    a, b = ((tmp_path / name / "packing.snapshot").read_bytes() for name in ("python", "twin"))
    assert a == b  # the whole state


# Aspect ratios of the C++ program that are not compared; it takes stored samples for finished.
NAMES = {"polygon": "polygons_40", "disk": "disks_40", "polyhedron": "polyhedra_250", "ball": "balls_250"}
COMPARED = {"polygon": 1, "disk": 0.5, "polyhedron": 2, "ball": 4}


def test_column(tmp_path):
    samples = tmp_path / "samples"
    samples.mkdir()
    for shape, name in NAMES.items():
        for aspect in (0.5, 1, 2, 4):
            if aspect != COMPARED[shape]:
                (samples / f"{name}_{aspect:g}_1.txt").write_text("1 1 1 1 0\n")
    twin(tmp_path, "column", tmp_path, 40, 250, 1)
    for shape, name in NAMES.items():
        aspect = COMPARED[shape]
        line = python(tmp_path, "column.py", "--plane", 40, "--space", 250, "--aspects", aspect, "--shapes", shape,
                      "--digits", 17)
        stored = (samples / f"{name}_{aspect:g}_1.txt").read_text()
        assert line.split(": ")[1] == stored, shape
    assert (tmp_path / "column.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


@pytest.mark.parametrize("shape,grains", [("polygon", 40), ("polyhedron", 40)])
def test_ratcheting(shape, grains, tmp_path):
    python(tmp_path, "ratcheting.py", "--shape", shape, "--grains", grains, "--duration", 0.1, "--fmax", 300)
    ours = (tmp_path / "wall.csv").read_text().splitlines()
    theirs = twin(tmp_path, "ratcheting", shape, grains, 0.1, 300).splitlines()
    assert ours[0] == theirs[0] and len(ours) == len(theirs) == 501
    numbers = lambda lines: [[float(x) for x in line.split(",")] for line in lines[1:]]  # noqa: E731
    assert numbers(ours) == numbers(theirs)
