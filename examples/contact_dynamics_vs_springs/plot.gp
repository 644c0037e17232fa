# contact_dynamics_vs_springs.csv, force_distribution.csv -> contact_dynamics_vs_springs.png
set datafile separator ','
set terminal pngcairo size 1100,840 font 'sans,11'
set output 'contact_dynamics_vs_springs.png'
runs = 'contact_dynamics_vs_springs.csv'
forces = 'force_distribution.csv'
set multiplot layout 2,2
# The second line is contact dynamics with the finer step; compared with the first it shows the
# influence of the step.
stats runs using 3 every ::2::2 nooutput
rigid = STATS_min
stats runs using 2 every ::1::1 nooutput
coarse = STATS_max
stats runs using 8 every ::1::1 nooutput
cost = STATS_min
set format x '10^{%T}'
set logscale x
set xlabel 'stiffness [N/m]'
set key bottom right
set ylabel 'height of the lid [mm]'
plot runs using ($1 > 0 ? $1 : 1/0):($3 * 1e3) with linespoints pt 7 title 'springs', \
     rigid * 1e3 dashtype 2 title 'contact dynamics'
set logscale y
set format y '10^{%T}'
set key top right
set ylabel 'time step [s]'
plot runs using ($1 > 0 ? $1 : 1/0):2 with linespoints pt 7 title 'springs', \
     coarse dashtype 2 title 'contact dynamics'
set xlabel 'distance of the lid from that of contact dynamics [mm]'
set ylabel 'wall clock per simulated second [s]'
plot runs using ($1 > 0 ? abs($3 - rigid) * 1e3 : 1/0):8 with linespoints pt 7 title 'springs', \
     cost dashtype 2 title sprintf('contact dynamics, h = %g s', coarse)
unset logscale
set format
set yrange [0:*]
set xlabel 'contact force over its mean'
set ylabel 'probability density'
plot forces using ($1 == 0 && $2 < coarse ? $3 : 1/0):4 with lines lw 3 title 'contact dynamics', \
     for [n in '5 6 9'] forces using ($1 == 10**n ? $3 : 1/0):4 with lines \
       title sprintf('springs, 1e%s N/m', n)
