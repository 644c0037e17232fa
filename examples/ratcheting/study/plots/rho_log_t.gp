# SPDX-License-Identifier: MIT
# The solid fraction of the inner volume at the force maxima over a hundred periods.
width = 900; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set logscale x
set xrange [0.5:*]
set xlabel "periods"
set ylabel "ρ − ρ(first maximum of f), inner volume"
set key top left
commands = ""
do for [shape in shapes] {
  do for [nu in "5 20"] {
    if (has("long".nu, shape)) {
      stats file_of("long".nu, shape) every ::0::0 using 3 skip 1 nooutput
      commands = commands.sprintf("file_of('long%s', '%s') using 2:($3 - %g) skip 1 with linespoints pointtype %d linecolor rgb '%s' title '%s, %s Hz', ", nu, shape, STATS_min, nu eq "5" ? 2 : point_of(shape), color_of(shape), title_of(shape), nu)
    }
  }
}
eval "plot ".commands." NaN notitle"
