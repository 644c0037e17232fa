# SPDX-License-Identifier: MIT
# The change of the inner solid fraction over the wall's displacement.
load system("dirname '".ARG0."'")."/style.gp"
# Rows of packing.csv with the x of the same time in wall.csv.
joined = "< awk -F, 'FNR == 1 {next} FNR == NR {x[$1] = $3; next} $1 in x {print $1 \",\" x[$1] \",\" $2}' '".wall."' '".packing."'"
stats packing every ::0::0 using 2 skip 1 nooutput
inner = STATS_min
start = 0
if (has_events) {
  stats events using 2 skip 1 nooutput
  start = STATS_min  # the filling transient is left out
}
set output folder."/rho_x.png"
set lmargin screen 0.13
set rmargin screen 0.85
unset key
set autoscale cbfix
set xlabel "x  [mm]"
set ylabel "Δρ, inner control volume"
set cblabel "t  [s]" offset 0.5
set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05
plot joined using ($1 >= start ? mm($2) : NaN):($3 - inner):1 with linespoints pointtype 7 pointsize 0.35 linewidth 0.8 linecolor palette notitle
