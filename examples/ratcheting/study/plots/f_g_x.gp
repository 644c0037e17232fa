# SPDX-License-Identifier: MIT
# The force of the grains on the wall over its displacement, from the first jam on; logarithmic, for
# the way out takes a hundredth of what the jammed wall bears.
width = 1400; height = 1000
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 2 margins 0.08, 0.89, 0.07, 0.95 spacing 0.2, 0.14
unset key
set xlabel "x  [mm]"
set ylabel "f_g  [kN]"
set format y "%g"
set cblabel "t  [s]"
set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
set offsets graph 0.03, graph 0.03, 0, 0
set logscale y
set yrange [0.008:12]
do for [shape in shapes] {
  if (!has("wall", shape)) {
    set multiplot next
    continue
  }
  set title title_of(shape)
  plot file_of("wall", shape) using ($1 >= 0.15 ? mm($3) : NaN):(kN($5)):1 skip 1 with lines linewidth 0.9 linecolor palette
}
unset multiplot
