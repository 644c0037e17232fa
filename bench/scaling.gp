# SPDX-License-Identifier: MIT
# gnuplot -e "folder='scaling-output'" scaling.gp: time and memory per grain over the number of grains.
set terminal pngcairo size 1100,450 font "sans,11"
set output folder.'/scaling.png'
set multiplot layout 1,2
set logscale x
set xrange [800:150000]
set yrange [0:*]
set xlabel 'grains'
set grid lc rgb '#dddddd'
set key left top
exists(name) = system("[ -f '".folder."/scaling-".name.".dat' ] && echo 1 || echo 0") + 0
file(name) = folder.'/scaling-'.name.'.dat'
shapes = ''
do for [name in 'polyhedron sphere polygon disk'] { if (exists(name)) { shapes = shapes.' '.name } }
set ylabel 'time per grain and step [us]'
plot for [k=1:words(shapes)] file(word(shapes, k)) u 1:2 w lp lw 2 lc k pt 7 t word(shapes, k).', 1 thread', \
     for [k=1:words(shapes)] file(word(shapes, k)) u 1:3 w lp lw 2 lc k dt 2 pt 6 t word(shapes, k).', 2 threads'
set ylabel 'memory per grain [kB]'
plot for [k=1:words(shapes)] file(word(shapes, k)) u 1:4 w lp lw 2 lc k pt 7 t word(shapes, k)
