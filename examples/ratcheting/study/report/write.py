# SPDX-License-Identifier: MIT
"""write.py RESULTS: draws RESULTS/figures/*.png from RESULTS/runs.jsonl, and writes each page RESULTS/NAME.md of which there is a
template RESULTS/NAME.md.in, with the numbers of the runs put into it (template.py, values.py). The shapes of the grains are drawn
from their vertices in RESULTS/grains.csv, if it is there.

    python3 examples/ratcheting/study/report/write.py examples/ratcheting/results

Needs gnuplot, and of Python only its own library."""
import argparse
import pathlib

import drawings
import plots
import template
from controls import split
from figures import CONTROL_FIGURES, FIGURES, Missing
from runs import read
from values import Values

HERE = pathlib.Path(__file__).resolve().parent
PICTURE = HERE.parents[1] / "ballast.png"


def draw_all(runs, results):
    """Draws the figures that there are runs for. @returns their number."""
    folder = results / "figures"
    folder.mkdir(exist_ok=True)
    grains, drawn = results / "grains.csv", 0
    if grains.exists():
        drawings.contact_types(folder / "contact_types.png")
        drawings.grain_shapes(grains, folder / "grain_shapes.png")
        drawings.snapshot(PICTURE, folder / "snapshot.png")
        drawn = 3
    study, _ = split(runs)
    for name, function, shown in [(*f, study) for f in FIGURES] + [(*f, runs) for f in CONTROL_FIGURES]:
        try:
            function(shown, folder / f"{name}.png")
            drawn += 1
        except Missing:
            continue
    return drawn


def pages(runs, results):
    """Fills the templates of the folder. @returns the names of the pages."""
    values, written = Values(runs, results), []
    for path in sorted(results.glob("*.md.in")):
        page = path.with_suffix("")
        page.write_text(template.fill(path.read_text(encoding="utf8"), values, path.name), encoding="utf8")
        written.append(page.name)
    return written


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("results", type=pathlib.Path, help="folder with runs.jsonl")
    parser.add_argument("--figures-only", action="store_true", help="write no page")
    parser.add_argument("--pages-only", action="store_true", help="draw no figure")
    parser.add_argument("--figure", action="append", default=[],
                        help="draw only this figure; may be given more than once")
    options = parser.parse_args()
    names = [name for name, _ in FIGURES + CONTROL_FIGURES] + ["contact_types", "grain_shapes", "snapshot"]
    for name in options.figure:
        if name not in names:
            parser.error(f"--figure {name}: there are {', '.join(names)}")
    plots.WANTED.update(options.figure)
    table_path = options.results / "runs.jsonl"
    runs = read(table_path) if table_path.exists() else []
    if not runs:
        print(f"no runs in {table_path}: no figures")
        return
    drawn = 0 if options.pages_only else draw_all(runs, options.results)
    written = [] if options.figures_only else pages(runs, options.results)
    print(f"{len(runs)} runs: {drawn} figures in {options.results / 'figures'}"
          + (f"; {', '.join(written)}" if written else ""))


if __name__ == "__main__":
    main()
