# hello > hello.txt; gnuplot plot.gp -> hello.png
set terminal pngcairo size 640,400 font 'sans,11'
set output 'hello.png'
set key top right
set xlabel 'time [s]'
set xrange [0:1]
set yrange [0:*]
set ylabel 'contact points; sweeps (every 50th step)'
plot 'hello.txt' using (0.025 * ($0 + 1)):3 with linespoints pt 7 ps 0.5 lc rgb '#1f5fa8' title 'sweeps of the step', \
     '' using (0.025 * ($0 + 1)):1 with steps lw 2 lc 'black' title 'contact points'
