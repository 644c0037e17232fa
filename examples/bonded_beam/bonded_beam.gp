# bonded_beam > bonded_beam.txt; gnuplot bonded_beam.gp -> bonded_beam.png
set terminal pngcairo size 640,320 font 'sans,11'
set output 'bonded_beam.png'
set key top right
set xlabel 'position along the beam [mm]'
set ylabel 'deflection [mm]'
set yrange [0:*] reverse
plot 'bonded_beam.txt' index 0 using 1:3 with lines lw 2 lc 'black' title 'Euler–Bernoulli', \
     '' index 0 using 1:2 with points pt 6 ps 1.6 lc rgb '#1f5fa8' title 'disks', \
     '' index 1 using 1:2 with points pt 7 ps 0.7 lc rgb '#c0392b' title 'spheres'
