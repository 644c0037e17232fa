# SPDX-License-Identifier: MIT
# The wall's displacement above the force on it.
load system("dirname '".ARG0."'")."/style.gp"
set output folder."/x_t.png"
set multiplot layout 2, 1 margins 0.10, 0.97, 0.11, 0.96 spacing 0, 0.03
set format x ""
unset key
set ylabel "wall displacement x  [mm]"
set yrange [*:*]
set offsets graph 0, 0, 0.06, 0.06
plot wall using 1:(mm($3)) skip 1 with lines linecolor rgb blue
set format x "%g"
set xlabel "t  [s]"
set ylabel "driving force f  [kN]"
plot wall using 1:(kN($2)) skip 1 with lines linecolor rgb red
unset multiplot
