# contact_dynamics_vs_springs.csv -> contact_dynamics_vs_springs.png
set datafile separator ','
set terminal pngcairo size 1100,420 font 'sans,11'
set output 'contact_dynamics_vs_springs.png'
set multiplot layout 1,2
set logscale x
set format x '10^{%T}'
set key top left
set xlabel 'stiffness [N/m]'
set ylabel 'height of the lid [mm]'
stats 'contact_dynamics_vs_springs.csv' using 3 every ::2::2 nooutput
rigid = STATS_min * 1e3
plot 'contact_dynamics_vs_springs.csv' using ($1 > 0 ? $1 : 1/0):($3 * 1e3) with linespoints pt 7 \
       title 'springs', rigid dashtype 2 title 'contact dynamics'
set logscale y
set ylabel 'wall clock per simulated second [s]'
stats 'contact_dynamics_vs_springs.csv' using 8 every ::2::2 nooutput
cost = STATS_min
plot 'contact_dynamics_vs_springs.csv' using ($1 > 0 ? $1 : 1/0):8 with linespoints pt 7 \
       title 'springs', cost dashtype 2 title 'contact dynamics'
