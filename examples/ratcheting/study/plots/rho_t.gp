# SPDX-License-Identifier: MIT
# The change of the solid fraction since the start, in the inner control volume and in the box.
width = 1400; height = 1000
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 2 margins 0.08, 0.98, 0.07, 0.95 spacing 0.09, 0.14
set xlabel "t  [s]"
set ylabel "Δρ"
set xrange [0:1]
set key bottom right
set offsets 0, 0, graph 0.05, graph 0.05
do for [shape in shapes] {
  if (!has("packing", shape)) {
    set multiplot next
    continue
  }
  stats file_of("packing", shape) every ::0::0 using 2 skip 1 nooutput
  inner = STATS_min
  stats file_of("packing", shape) every ::0::0 using 3 skip 1 nooutput
  box = STATS_min
  set title title_of(shape)
  set label 1 (shape eq "polyhedron" ? "paper: +2 % by 0.2 s" : "") at 0.22, 0.02 * inner textcolor rgb grey font ",12"
  set arrow 1 from 0, 0.02 * inner to (shape eq "polyhedron" ? 0.2 : 0), 0.02 * inner nohead dashtype 2 linecolor rgb grey
  plot file_of("packing", shape) using 1:($3 - box) skip 1 with lines linecolor rgb grey linewidth 0.9 title sprintf("whole box, from %.3f", box), \
       file_of("packing", shape) using 1:($2 - inner) skip 1 with lines linecolor rgb color_of(shape) linewidth 1.6 title sprintf("inner volume, from %.3f", inner)
}
unset multiplot
