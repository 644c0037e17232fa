# breaking_stone > breaking_stone.txt; gnuplot breaking_stone.gp -> breaking_stone.png
set terminal pngcairo size 900,360 font 'sans,11'
set output 'breaking_stone.png'
set multiplot layout 1,2
set xlabel 'displacement of the plate [mm]'
set ylabel 'force on the plate [N], in the plane [N/m]'
set y2label 'fragments'
set yrange [0:*]
set y2range [0:4.4]
set y2tics 1
set ytics nomirror
set key top left
blue = '#1f5fa8'; red = '#c0392b'
names = 'polygons polyhedra'
ends = '1.5 4'
do for [k = 0:1] {
  set title word(names, k + 1)
  set xrange [0:word(ends, k + 1)]
  plot 'breaking_stone.txt' index k using 1:2 with lines lw 2 lc rgb blue title 'force', \
       '' index k using 1:5 axes x1y2 with steps lw 2 dt 2 lc rgb red title 'fragments'
}
unset multiplot
