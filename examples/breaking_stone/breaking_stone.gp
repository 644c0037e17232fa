# breaking_stone > breaking_stone.txt; gnuplot breaking_stone.gp -> breaking_stone.png
set terminal pngcairo size 820,360 font 'sans,11'
set output 'breaking_stone.png'
set multiplot layout 1,2
set xlabel 'displacement of the plate [mm]'
set key top right
set ylabel 'force on the plate [N]'
set yrange [0:*]
blue = '#1f5fa8'; red = '#c0392b'
plot 'breaking_stone.txt' index 0 using 1:2 with linespoints pt 7 ps 0.6 lc rgb blue title 'polygons [N/m]', \
     '' index 1 using 1:2 with linespoints pt 5 ps 0.6 lc rgb red title 'polyhedra'
set ylabel 'bonds'
set y2label 'fragments'
set y2tics
set ytics nomirror
set y2range [0:*]
plot 'breaking_stone.txt' index 0 using 1:3 with steps lw 2 lc rgb blue title 'bonds, polygons', \
     '' index 1 using 1:3 with steps lw 2 lc rgb red title 'polyhedra', \
     '' index 0 using 1:5 axes x1y2 with lines dt 2 lc rgb blue title 'fragments, polygons', \
     '' index 1 using 1:5 axes x1y2 with lines dt 2 lc rgb red title 'polyhedra'
unset multiplot
