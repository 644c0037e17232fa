# SPDX-License-Identifier: MIT
# Plot of bench/run.sh: the time of collide() of touching pairs, for each shape.
#   gnuplot -e "folder='bench-output'" bench/narrow_phase.gp
set terminal pngcairo size 1200, 700 font "DejaVu Sans,16" rounded
set output folder."/narrow_phase.png"
set encoding utf8
set title "collide() of touching pairs: contact points, normal and gaps; one thread"
set ylabel "time per pair [ns]"
set logscale y
set yrange [1:*]
set grid y linetype 1 linewidth 0.4 linecolor rgb "#d8d8d8"
set border 3
set tics nomirror
set style data histogram
set style histogram cluster gap 1
set style fill solid 0.9 border -1
set boxwidth 0.9
set xtics rotate by -35 noenhanced
set key outside top center horizontal
plot folder."/narrow_phase.dat" using 2:xtic(1) title "cold" linecolor rgb "#1f5fa8", \
     "" using 3 title "with the pair cache" linecolor rgb "#2e7d4f", \
     "" using 4 title "with the pair cache, from memory" linecolor rgb "#d07a00"
