# SPDX-License-Identifier: MIT
# The wall's velocity over its displacement.
load system("dirname '".ARG0."'")."/style.gp"
set output folder."/phase_portrait.png"
set lmargin screen 0.12
set rmargin screen 0.85
unset key
set autoscale cbfix
set xlabel "x  [mm]"
set ylabel "v  [mm/s]"
set cblabel "t  [s]" offset 0.5
set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05
set xzeroaxis linetype 1 linecolor rgb grey
start = 0
if (has_events) {
  stats events using 2 skip 1 nooutput
  start = STATS_min  # the filling transient is left out
}
plot wall using ($1 >= start ? mm($3) : NaN):(1e3 * $4):1 skip 1 with lines linewidth 1.1 linecolor palette notitle
