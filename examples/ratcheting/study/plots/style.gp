# SPDX-License-Identifier: MIT
# Common to all figures. Call: gnuplot -e "data='...'; out='...'; format='png'" <name>.gp; data is a
# folder with the tables of a study, format png or svg. A figure sets `width` and `height` before it
# loads this.
if (!exists("data")) data = "."
if (!exists("format")) format = "png"
if (!exists("out")) out = "figure.".format
if (!exists("width")) { width = 1600; height = 800 }
if (format eq "svg") {
  set terminal svg size width, height font "DejaVu Sans,15" linewidth 1.3 rounded background "white"
} else {
  if (strstrt(GPVAL_TERMINALS, "pngcairo")) {
    set terminal pngcairo size width, height font "DejaVu Sans,15" linewidth 1.4 rounded
  } else {
    set terminal png size width, height medium linewidth 2
  }
}
set output out
set encoding utf8
set datafile separator ","
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror textcolor rgb "#444444" font ",12"
set grid linetype 1 linewidth 0.4 linecolor rgb "#d8d8d8"
set key opaque box linecolor rgb "#d8d8d8" samplen 2
blue = "#1f5fa8"
red = "#b3261e"
green = "#2e7d4f"
orange = "#d07a00"
grey = "#7a7a7a"
mm(x) = 1e3 * x
# A bar on a logarithmic axis, as long below as above, of the value and spread in these columns; none
# (NaN) where the spread is not known.
below(k, spread) = valid(spread) ? column(k) / (1 + column(spread) / column(k)) : NaN
above(k, spread) = valid(spread) ? column(k) + column(spread) : NaN
# Commands for eval: points of column k over the expression x, times unit, with their bars.
points_of(file, x, k, unit, symbol, color, title) = sprintf("'%s' using (%s):(%g * column(%d)) skip 1 with points pointtype %d linecolor rgb '%s' %s, ", file, x, unit, k, symbol, color, title eq "" ? "notitle" : "title '".title."'")
bars_of(file, x, k, spread, unit, color) = sprintf("'%s' using (%s):(%g * below(%d, %d)):(0):(%g * (above(%d, %d) - below(%d, %d))) skip 1 with vectors nohead linewidth 0.9 linecolor rgb '%s' notitle, ", file, x, unit, k, spread, unit, k, spread, k, spread, color)
law_of(factor, exponent, x, color) = sprintf("%g * (%s)**%g with lines linewidth 0.8 linecolor rgb '%s' notitle, ", factor, x, exponent, color)
# The paper's C times the load of grains with corners at the baseline, mm, and its law over x.
paper_of(shape, c, law) = known(number("load", shape)) ? sprintf("%g * (%s) with lines dashtype %d linecolor rgb grey title 'paper, %s: C = %g', ", 1e3 * c * number("load", shape), law, shape eq "polyhedron" ? 2 : 4, shape eq "polyhedron" ? "3D" : "2D", c) : ""
papers_of(law) = paper_of("polyhedron", 0.01, law).paper_of("polygon", 0.05, law)
kN(f) = 1e-3 * f
shapes = "polyhedron polygon sphere disk"
title_of(shape) = shape eq "polyhedron" ? "3D, polyhedra" : shape eq "polygon" ? "2D, polygons" : shape eq "sphere" ? "3D, spheres" : "2D, disks"
color_of(shape) = shape eq "polyhedron" ? blue : shape eq "polygon" ? red : shape eq "sphere" ? green : orange
point_of(shape) = shape eq "polyhedron" ? 7 : shape eq "polygon" ? 5 : shape eq "sphere" ? 6 : 4
file_of(name, shape) = data."/".name."_".shape.".csv"
has(name, shape) = system("test $(cat '".file_of(name, shape)."' 2>/dev/null | wc -l) -gt 1 && echo 1 || echo 0") + 0
# A distance of tics that leaves three to six over a range: 1, 2 or 5 times a power of ten.
power(range) = 10**floor(log10(range / 3.))
tics_over(range) = power(range) * (range / power(range) > 15 ? 5 : range / power(range) > 6 ? 2 : 1)
# A number of values.csv, NaN if it is not there.
number(name, shape) = real(system(sprintf("awk -F, -v wanted='%s_%s' '$1 == wanted {print $2; found = 1} END {if (!found) print \"NaN\"}' '%s/values.csv'", name, shape, data)))
known(x) = x == x
