# SPDX-License-Identifier: MIT
# The curves of a validation run. Call: gnuplot -e "folder='...'" all.gp; draws those whose CSV
# files are in the folder.
if (!exists("folder")) folder = "."
if (strstrt(GPVAL_TERMINALS, "pngcairo")) {
  set terminal pngcairo size 1000, 700 font "DejaVu Sans,15" linewidth 1.6 rounded
} else {
  set terminal png size 1000, 700 medium linewidth 2
}
set encoding utf8
set datafile separator ","
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror textcolor rgb "#444444"
set grid linetype 1 linewidth 0.4 linecolor rgb "#d8d8d8"
set key opaque box linecolor rgb "#d8d8d8" samplen 2
blue = "#1f5fa8"
red = "#b3261e"
file(name) = folder."/".name.".csv"
has(name) = system("test -s '".file(name)."' && echo 1 || echo 0") + 0
do for [d in "2d 3d"] {
  if (has("incline_".d)) {
    set output folder."/incline_".d.".png"
    set key left top
    set xlabel "tilt  [rad]"
    set ylabel "acceleration  [m/s²]"
    plot file("incline_".d) using 1:3 skip 1 with lines lc rgb red title "g (sin − μ cos)", \
         '' using 1:2 skip 1 with points pt 7 lc rgb blue title "measured"
  }
  if (has("arch_".d)) {
    set output folder."/arch_".d.".png"
    set key right top
    set xlabel "thickness / radius"
    set ylabel "fall of the crown in 0.5 s, at most 0.01  [radii]"
    set arrow 1 from 0.1075, graph 0 to 0.1075, graph 1 nohead lc rgb red
    plot file("arch_".d) using 1:2 skip 1 with linespoints pt 7 lc rgb blue title "measured", \
         NaN with lines lc rgb red title "least thickness, 0.1075"
    unset arrow 1
  }
  if (has("janssen_".d)) {
    set output folder."/janssen_".d.".png"
    set key right bottom
    set xlabel "weight above / (ρ g λ A)"
    set ylabel "vertical stress / (ρ g λ)"
    plot file("janssen_".d) using 1:3 skip 1 with lines lc rgb red title "1 − exp(−z/λ)", \
         '' using 1:2 skip 1 with points pt 7 lc rgb blue title "measured"
  }
  if (has("close_packing_".d)) {
    set output folder."/close_packing_".d.".png"
    set key right bottom
    set logscale x
    set xlabel "grains"
    set ylabel "solid fraction"
    published = d eq "3d" ? 0.64 : 0.84
    set xrange [100:2000]
    set yrange [published - 0.02 : published + 0.01]
    plot file("close_packing_".d) using 1:2 skip 1 with linespoints pt 7 lc rgb blue title "measured", \
         published with lines lc rgb red title "published"
    set autoscale
    unset logscale x
  }
}
if (has("top_3d")) {
  set output folder."/top_3d.png"
  set key left top
  set logscale y
  set format y "10^{%L}"
  set xlabel "t  [s]"
  set ylabel "spin about the first axis / Ω"
  plot file("top_3d") using 1:3 skip 1 with lines lc rgb red title "exact", \
       '' using 1:2 skip 1 with points pt 7 ps 0.6 lc rgb blue title "measured"
}
if (has("shear_2d")) {
  set output folder."/shear_2d.png"
  unset logscale
  set format y
  set key left top
  set xlabel "inertial number I"
  set ylabel "effective friction"
  plot file("shear_2d") using 1:3 skip 1 with lines lc rgb red title "published, 0.25 + 1.1 I", \
       '' using 1:2 skip 1 with points pt 7 lc rgb blue title "measured"
}
