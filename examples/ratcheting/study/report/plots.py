# SPDX-License-Identifier: MIT
"""Figures by gnuplot: panels of curves, points with error bars and arrows. The data are part of the
script that gnuplot reads from its standard input."""
import math
import subprocess

COLOR = {"polyhedron": "#1f5fa8", "polygon": "#b3261e", "sphere": "#2e7d4f", "disk": "#d07a00"}
POINT = {"polyhedron": 7, "polygon": 5, "sphere": 9, "disk": 13}
GREY, BLACK = "#7a7a7a", "#222222"


class Panel:
    """One pair of axes. `settings` are gnuplot commands, run before the plot."""

    def __init__(self, title="", xlabel="", ylabel="", settings=()):
        self.commands = [f'set title "{title}" font ",13"', f'set xlabel "{xlabel}"',
                         f'set ylabel "{ylabel}"', *settings]
        self.curves = []  # (rows, gnuplot's using and style)

    def add(self, rows, using, style, title=None):
        rows = [row for row in rows if all(v is not None and math.isfinite(v) for v in row)]
        if rows:
            name = f'title "{title}"' if title else "notitle"
            self.curves.append((rows, f"using {using} {style} {name}"))

    def curve(self, points, color, title=None, width=1.6, dash=1):
        self.add(points, "1:2", f'with lines lw {width} dt {dash} lc rgb "{color}"', title)

    def points(self, points, color, symbol=7, title=None, size=1.1):
        self.add(points, "1:2", f'with points pt {symbol} ps {size} lc rgb "{color}"', title)

    def bars(self, rows, color, symbol=7, title=None, size=1.1):
        """Rows x, mean, half of the interval. An interval that is not known has no bar."""
        with_bars = [row[:3] for row in rows if math.isfinite(row[2])]
        self.add(with_bars, "1:2:3",
                 f'with yerrorbars pt {symbol} ps {size} lw 1.2 lc rgb "{color}"', title)
        alone = [row[:2] for row in rows if not math.isfinite(row[2])]
        self.points(alone, color, symbol, None if with_bars else title, size)

    def ranges(self, rows, color, symbol=7, title=None, size=1.1):
        """Rows x, value, low and high end of its interval."""
        self.add(rows, "1:2:3:4", f'with yerrorbars pt {symbol} ps {size} lw 1.2 lc rgb "{color}"', title)

    def function(self, text, color, title=None, dash=2, width=1.2):
        name = f'title "{title}"' if title else "notitle"
        self.curves.append((None, f'{text} with lines lw {width} dt {dash} lc rgb "{color}" {name}'))

    def script(self, number):
        lines, parts = [], []
        for k, (rows, style) in enumerate(self.curves):
            if rows is None:
                parts.append(style)
                continue
            name = f"$d{number}_{k}"
            lines += [f"{name} << EOD"] + [" ".join(f"{v:.8g}" for v in row) for row in rows]
            lines.append("EOD")
            parts.append(f"{name} {style}")
        return lines + self.commands + (["plot " + ", \\\n  ".join(parts)] if parts
                                        else ["set multiplot next"])


WANTED = set()  # names of the figures that draw() writes; empty: all


def draw(path, panels, rows, columns, width=1500, height=1000, margins="0.07, 0.98, 0.08, 0.95",
         spacing="0.08, 0.13"):
    """Writes a PNG file with the panels in rows, if its name is wanted."""
    if WANTED and path.stem not in WANTED:
        return
    script = [f'set terminal pngcairo size {width}, {height} font "DejaVu Sans,13" rounded',
              f'set output "{path}"', "set encoding utf8", 'set border lw 0.8 lc rgb "#444444"',
              'set tics nomirror tc rgb "#444444" font ",12"', "set bars 0.6",
              'set grid lt 1 lw 0.4 lc rgb "#dddddd"', "set key samplen 1.5 font ',12'",
              f"set multiplot layout {rows}, {columns} margins {margins} spacing {spacing}"]
    for number, panel in enumerate(panels):
        script += ["set xrange [*:*]", "set yrange [*:*]", "unset logscale", "set format '%g'",
                   "set size noratio", "unset label", "unset arrow", "unset object",
                   "set key default samplen 1.5 font ',12'", "unset offsets",
                   "set xtics auto", "set ytics auto", *panel.script(number)]
    script.append("unset multiplot")
    done = subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True,
                          capture_output=True, check=False)
    if done.returncode != 0 or "line" in done.stderr:
        raise RuntimeError(f"gnuplot: {path}: {done.stderr}")
