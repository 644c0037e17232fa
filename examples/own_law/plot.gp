# own_law.txt -> own_law.png
set terminal pngcairo size 640,400 font 'sans,11'
set output 'own_law.png'
set key bottom right
set xlabel 'time [s]'
set ylabel 'speed of the crate [m/s]'
plot 'own_law.txt' using 1:3 with lines title 'expected: m g sin a / drag (1 - exp(-drag t / m))', \
     'own_law.txt' using 1:2 with points pt 7 ps 0.7 title 'simulation with the law of this folder'
