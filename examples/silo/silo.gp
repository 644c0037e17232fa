# SPDX-License-Identifier: MIT
# gnuplot silo.gp, in the folder of silo.csv and beverloo.csv.
set datafile separator ","
set terminal pngcairo size 1000,460 font "sans,12"
set output "silo.png"
d = 0.02
samples(dim) = real(system(sprintf("awk -F, '$1 == %d && $5 > n {n = $5} END {print n}' silo.csv", dim)))
grains(dim) = real(system(sprintf("awk -F, '$1 == %d {print $3; exit}' silo.csv", dim)))
of(dim, parts, file) = sprintf("< awk -F, '$1 == %d && $2 == %d' %s", dim, parts, file)
# C and k of a shape; 0 if it was not run
fitted(dim, parts, column) = real("0" . system(sprintf("awk -F, '$1 == %d && $2 == %d {printf \"%%.9g\", $%d}' beverloo.csv", dim, parts, column)))
law(x, dim, c, k) = c > 0 && x > k * d ? c ** (1 / (dim - 0.5)) * (x - k * d) : 1 / 0
set xlabel "outlet D [m]"
set ylabel "(W / {/Symbol r}{/Symbol \326}g)^{1/(dim - 1/2)} [m]"
set yrange [0:*]
set xrange [0:0.21]
set key top left Left reverse
set grid
set multiplot layout 1,2 title "Discharge of a silo: grains of 2 cm, friction 0.4, tolerance 1e-4, step 0.5 ms"
do for [dim = 2:3] {
  c1 = fitted(dim, 1, 5); k1 = fitted(dim, 1, 7); c4 = fitted(dim, 4, 5); k4 = fitted(dim, 4, 7)
  set title sprintf("%s, N = %d, samples: %d", dim == 2 ? "plane" : "space", grains(dim), samples(dim))
  plot of(dim, 1, "silo.csv") using 4:($6 > 0 ? $8 : 1 / 0) pt 6 lc rgb "#0B6E99" title sprintf("convex: C = %.2f, k = %.1f", c1, k1), \
       law(x, dim, c1, k1) lc rgb "#0B6E99" notitle, \
       of(dim, 4, "silo.csv") using 4:($6 > 0 ? $8 : 1 / 0) pt 4 lc rgb "#B5482A" title sprintf("concave: C = %.2f, k = %.1f", c4, k4), \
       law(x, dim, c4, k4) lc rgb "#B5482A" notitle
}
unset multiplot
