# SPDX-License-Identifier: MIT
"""The Python of examples/guide/python.md runs, from the first fragment to the last."""
import pathlib
import re

PAGE = pathlib.Path(__file__).parents[2] / "guide" / "python.md"


def test_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    fragments = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.S)
    assert len(fragments) >= 5
    for fragment in fragments:
        exec(compile(fragment, str(PAGE), "exec"), names)  # noqa: S102
    assert {"box.png", "forces.png"} <= {path.name for path in tmp_path.iterdir()}
    assert 3 < names["simulation"].coordination(2).neighbours < 9
