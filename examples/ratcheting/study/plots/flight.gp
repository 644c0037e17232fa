# SPDX-License-Identifier: MIT
# What the force on the wall tells of each way out, f_g = F - beta m a, over that way: every run of
# the master curve.
width = 1600; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 1, 2 margins 0.06, 0.99, 0.11, 0.97 spacing 0.07, 0
set logscale x
set format x "10^{%L}"
set xrange [7e-5:3]
set xlabel "way out without creep / smallest grain size"
do for [name in "F beta"] {
  set ylabel (name eq "F" ? "thrust F / mg" : "carried grains β")
  set yrange [0:(name eq "F" ? 0.6 : 1.4)]
  set key bottom left Left reverse
  commands = ""
  do for [shape in shapes] {
    if (has("master", shape)) {
      commands = commands.points_of(file_of("master", shape), "$8", name eq "F" ? 9 : 10, 1, point_of(shape), color_of(shape), title_of(shape))
    }
  }
  eval "plot ".commands.(name eq "F" ? "" : "1 with lines dashtype 2 linecolor rgb grey title 'paper: β = 1', ")." NaN notitle"
}
unset multiplot
