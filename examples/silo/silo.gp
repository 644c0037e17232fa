# SPDX-License-Identifier: MIT
# gnuplot silo.gp, in the folder of silo.csv and beverloo.csv.
set datafile separator ","
d = 0.02
# numbers of a dimension; 0 if it was not run
samples(dim) = int(system(sprintf("awk -F, '$1 == %d && $5 > n {n = $5} END {print n + 0}' silo.csv", dim)))
grains(dim) = int(system(sprintf("awk -F, '$1 == %d {n = $3} END {print n + 0}' silo.csv", dim)))
rows(dim, parts) = int(system(sprintf("awk -F, '$1 == %d && $2 == %d && $6 > 0 {n++} END {print n + 0}' silo.csv", dim, parts)))
of(dim, parts, file) = sprintf("< awk -F, '$1 == %d && $2 == %d' %s", dim, parts, file)
# C and k of a shape; 0 if it was not run
fitted(dim, parts, column) = real(system(sprintf("awk -F, '$1 == %d && $2 == %d {x = $%d} END {print x + 0}' beverloo.csv", dim, parts, column)))
law(x, dim, c, k) = c > 0 && x > k * d ? c ** (1 / (dim - 0.5)) * (x - k * d) : 1 / 0
set xlabel "outlet D [m]"
set ylabel "(W / {/Symbol r}{/Symbol \326}g)^{1/(dim - 1/2)} [m]"
set yrange [0:*]
set xrange [0:0.21]
set key top left Left reverse
set grid
colour(parts) = parts eq "1" ? 0x0B6E99 : 0xB5482A
first = rows(2, 1) + rows(2, 4) > 0 ? 2 : 3
last = rows(3, 1) + rows(3, 4) > 0 ? 3 : 2
if (last < first) { print "silo.csv: nothing flowed out of a silo, no plot"; exit }
count = last - first + 1
set terminal pngcairo size 500 * count, 460 font "sans,12"
set output "silo.png"
set multiplot layout 1,count title (count == 2 ? "Discharge of a silo: grains of 2 cm, friction 0.4, tolerance 1e-4, step 0.5 ms" : "Discharge of a silo: grains of 2 cm, step 0.5 ms")
do for [dim = first:last] {
  set title sprintf("%s, N = %d, samples: %d", dim == 2 ? "plane" : "space", grains(dim), samples(dim))
  run = (rows(dim, 1) > 0 ? "1 " : "") . (rows(dim, 4) > 0 ? "4" : "")  # numbers of parts that were run
  c(parts) = fitted(dim, int(parts), 5); k(parts) = fitted(dim, int(parts), 7)
  plot for [p in run] of(dim, int(p), "silo.csv") using 4:($6 > 0 ? $8 : 1 / 0) pt (p eq "1" ? 6 : 4) lc rgb colour(p) \
         title sprintf("%s: C = %.2f, k = %.1f", p eq "1" ? "convex" : "concave", c(p), k(p)), \
       for [p in run] law(x, dim, c(p), k(p)) lc rgb colour(p) notitle
}
unset multiplot
