# SPDX-License-Identifier: MIT
# The force of the grains on the wall over its displacement: the loop of each period.
load system("dirname '".ARG0."'")."/style.gp"
set output folder."/f_g_x.png"
set lmargin screen 0.12
set rmargin screen 0.85
unset key
set autoscale cbfix
set xlabel "x  [mm]"
set ylabel "f_g  [kN]"
set cblabel "t  [s]" offset 0.5
set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
set offsets graph 0.03, graph 0.03, graph 0.03, 0
start = 0
if (has_events) {
  stats events using 2 skip 1 nooutput
  start = STATS_min  # the filling transient is left out
}
plot wall using ($1 >= start ? mm($3) : NaN):(kN($5)):1 skip 1 with lines linewidth 0.9 linecolor palette notitle
