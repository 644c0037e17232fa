# own_integrator.txt -> own_integrator.png
set terminal pngcairo size 640,400 font 'sans,11'
set output 'own_integrator.png'
set logscale xy
set format '10^{%T}'
set key top left
set xlabel 'step [s]'
set ylabel 'error of the heights of bounces [m]'
plot 'own_integrator.txt' using 1:2 with linespoints pt 7 title 'VelocityVerlet', \
     'own_integrator.txt' using 1:3 with linespoints pt 6 ps 1.6 title 'SymplecticEuler, of one''s own', \
     4e3 * x**2 with lines dashtype 2 title 'step^2'
