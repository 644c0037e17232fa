# SPDX-License-Identifier: MIT
# The change of the solid fraction since the start, in the inner control volume and in the box.
load system("dirname '".ARG0."'")."/style.gp"
stats packing every ::0::0 using 2 skip 1 nooutput
inner = STATS_min
stats packing every ::0::0 using 3 skip 1 nooutput
box = STATS_min
set output folder."/rho_t.png"
set xlabel "t  [s]"
set ylabel "Δρ"
set key above nobox
set offsets 0, 0, graph 0.05, graph 0.05
plot packing using 1:($3 - box) skip 1 with lines linecolor rgb grey linewidth 0.9 title sprintf("whole box, from %.4f", box), \
     packing using 1:($2 - inner) skip 1 with lines linecolor rgb green linewidth 1.6 title sprintf("inner control volume, from %.4f", inner)
