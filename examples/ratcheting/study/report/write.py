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
from figures import FIGURES, Missing
from runs import read
from values import Values

HERE = pathlib.Path(__file__).resolve().parent
PICTURE = HERE.parents[1] / "ballast.png"


def draw_all(runs, results):
    """Draws the figures. @returns title and caption by name of each that there are runs for."""
    folder = results / "figures"
    folder.mkdir(exist_ok=True)
    grains = results / "grains.csv"
    found = {}
    if grains.exists():
        fixed = [("contact_types", "Types of contacts (paper, fig. 1)", drawings.contact_types),
                 ("grain_shapes", "Shapes of grains (paper, fig. 2)",
                  lambda path: drawings.grain_shapes(grains, path)),
                 ("snapshot", "A packing (paper, fig. 3)",
                  lambda path: drawings.snapshot(PICTURE, path))]
        found |= {name: (title, function(folder / f"{name}.png")) for name, title, function in fixed}
    for name, title, function in FIGURES:
        try:
            found[name] = (title, function(runs, folder / f"{name}.png"))
        except Missing:
            continue
    return found


def pages(runs, results, figures):
    """Fills the templates of the folder. @returns the names of the pages."""
    values, written = Values(runs, results, figures), []
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
    names = [name for name, _, _ in FIGURES] + ["contact_types", "grain_shapes", "snapshot"]
    for name in options.figure:
        if name not in names:
            parser.error(f"--figure {name}: there are {', '.join(names)}")
    plots.WANTED.update(["none"] if options.pages_only else options.figure)
    table_path = options.results / "runs.jsonl"
    runs = read(table_path) if table_path.exists() else []
    if not runs:
        print(f"no runs in {table_path}: no figures")
        return
    figures = draw_all(runs, options.results)
    written = [] if options.figures_only else pages(runs, options.results, figures)
    print(f"{len(runs)} runs: {len(figures)} figures in {options.results / 'figures'}"
          + (f"; {', '.join(written)}" if written else ""))


if __name__ == "__main__":
    main()
