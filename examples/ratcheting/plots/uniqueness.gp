# SPDX-License-Identifier: MIT
# Displacement of the wall and force of the grains on it, for runs that differ only in the start of
# the solver and the order of the contacts (uniqueness.sh).
load system("dirname '".ARG0."'")."/style.gp"
set output folder."/uniqueness.png"
set label 99 caption(folder."/warm")
array names = ["warm start", "cold start", "another order", "a third order"]
array runs = ["warm", "cold", "order1", "order2"]
array colors = [blue, red, green, orange]
set multiplot layout 2, 1 margins 0.10, 0.97, 0.11, 0.96 spacing 0, 0.03
set format x ""
set ylabel "wall displacement x  [mm]"
plot for [k = 1:4] folder."/".runs[k]."/wall.csv" using 1:(mm($3)) skip 1 with lines \
  linecolor rgb colors[k] title names[k]
set format x "%g"
unset key
set xlabel "t  [s]"
set ylabel "force of the grains f_g  [kN]"
plot for [k = 1:4] folder."/".runs[k]."/wall.csv" using 1:(kN($5)) skip 1 with lines \
  linecolor rgb colors[k]
unset multiplot
