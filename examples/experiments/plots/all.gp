# SPDX-License-Identifier: MIT
# gnuplot -e "folder='...'; data='...'" all.gp: draws what the folder of results holds.
set datafile separator ","
set terminal pngcairo size 900,560 font "sans,12"
set grid
set key top right
has(name) = int(system(sprintf("[ -s '%s/%s.csv' ] && echo 1 || echo 0", folder, name)))
file(name) = sprintf("%s/%s.csv", folder, name)
own = "#0B6E99"; other = "#B5482A"; third = "#7A7A7A"; last = "#2E8540"

if (has("drum")) {
  set output folder . "/drum_count.png"
  set title "Drum: M1 balls with x < 0 and z < 0. 30,000 balls of M1 and 8,000 of M2, step 1 ms"
  set xlabel "t [s]"; set ylabel "number of balls"
  plot data . "/drum_zone2_M1.csv" using 1:2 skip 1 with lines lw 2 lc rgb other title "LIGGGHTS", \
       data . "/drum_zone2_M1.csv" using 1:3 skip 1 with lines lw 2 dt 2 lc rgb third title "MUSEN", \
       file("drum") using 1:2 skip 1 with points pt 6 lc rgb own title "moreau, rigid", \
       (has("drum_reversed") ? file("drum_reversed") : "/dev/null") using 1:2 skip 1 with points pt 1 lc rgb last title has("drum_reversed") ? "the same, reversed order" : ""
}
do for [n in "25 50 100"] {
  name = sprintf("impact_%sk", n); part = name . "_so_far"
  loose = name . (n eq "25" ? "_twice_the_step" : "") . "_loose"; loose_part = loose . "_so_far"
  if (has(name) || has(part) || has(loose) || has(loose_part)) {
    set output folder . "/" . name . ".png"
    set title sprintf("Impact: height of the steel ball, bed of %s,000 balls, step %s µs, tolerance 1e-3", n, n eq "25" ? "50" : "100")
    set xlabel "t [ms]"; set ylabel "z [mm]"; set key top center
    csv(name) = has(name) ? file(name) : "/dev/null"
    count = has(name) ? int(system(sprintf("head -1 '%s' | tr ',' '\n' | wc -l", file(name)))) : 2
    plot data . "/" . name . ".csv" using 1:(1000 * $2) skip 1 with lines lw 2 lc rgb other title "LIGGGHTS", \
         data . "/" . name . ".csv" using 1:(1000 * $3) skip 1 with lines lw 2 dt 2 lc rgb third title "MUSEN", \
         for [k = 3:count] csv(name) using 1:(1000 * column(k)) skip 1 with lines lw 1.5 lc rgb own title (k == 3 ? "moreau, each bed" : ""), \
         csv(part) using 1:(1000 * $2) skip 1 with lines lw 2 dt 3 lc rgb own title has(part) ? "moreau, run not finished" : "", \
         csv(loose) using 1:(1000 * $2) skip 1 with lines lw 2 lc rgb last title has(loose) ? "moreau, loose bed, step 100 µs" : "", \
         csv(loose_part) using 1:(1000 * $2) skip 1 with lines lw 2 lc rgb last title has(loose_part) ? "moreau, loose bed, run not finished" : ""
    set key top right
  }
}
if (has("squeeze_10000_SignoriniCoulomb_500")) {
  set output folder . "/squeeze.png"
  set title "Velocity of the steel ball, narrow bed of 10,000 balls"
  set xlabel "t [ms]"; set ylabel "velocity upwards [m/s]"; set key top left
  csv(name) = has(name) ? file(name) : "/dev/null"
  plot csv("squeeze_10000_HertzMindlin_10") using 1:3 skip 1 with lines lw 2 lc rgb other title "HertzMindlin, 1 µs", \
       csv("squeeze_10000_HertzMindlin_e0.20_10") using 1:3 skip 1 with lines dt 2 lc rgb other title "the same, e = 0.2", \
       csv("squeeze_10000_SignoriniCoulomb_500") using 1:3 skip 1 with lines lw 2 lc rgb own title "rigid, 50 µs, residual 1e-3", \
       csv("squeeze_10000_SignoriniCoulomb_500_tight") using 1:3 skip 1 with lines lw 2 dt 3 lc rgb last title "the same, 1e-5", \
       csv("squeeze_10000_SignoriniCoulomb_e1.00_500") using 1:3 skip 1 with lines dt 2 lc rgb own title "the same, e = 1, 1e-3", \
       csv("squeeze_10000_Compliant_200") using 1:3 skip 1 with lines lc rgb third title "Compliant, 20 µs"
  set key top right
}
if (has("silo_large_M1_100k") || has("silo_large_M1_30k") || has("silo_large_M2_30k")) {
  set output folder . "/silo_count.png"
  set title "Silo: balls below the orifice, d = 4 mm, step 0.5 ms"; set key top left; set xrange [0:has("silo_large_M1_100k") ? 4.5 : 1.5]
  set xlabel "t [s]"; set ylabel "number of balls"
  plot data . "/silo_large_M1.csv" using 1:(100000 - $2) skip 1 with lines lw 2 lc rgb other title "LIGGGHTS, M1, 100,000, large orifice", \
       data . "/silo_large_M1.csv" using 1:(100000 - $3) skip 1 with lines lw 2 dt 2 lc rgb third title "MUSEN, M1, 100,000, large orifice", \
       data . "/silo_small_M1.csv" using 1:(100000 - $2) skip 1 with lines lw 2 dt 3 lc rgb third title "MUSEN, M1, 100,000, small orifice", \
       for [name in "silo_large_M1_100k silo_small_M1_100k silo_large_M1_30k silo_small_M1_30k silo_large_M2_30k silo_small_M2_30k"] \
         (has(name) ? file(name) : "/dev/null") using 1:3 skip 1 with points title (has(name) ? "moreau " . name[6:*] : "") noenhanced
  set key top right; set autoscale
}
if (has("heap_5200")) {
  set output folder . "/heap.png"
  set title "Heap of 5,200 spheres at the start, half the lengths: slope of the highest spheres"
  set xlabel "t [s]"; set ylabel "angle [degrees]"; set yrange [0:30]
  plot 19.7 with lines lw 2 lc rgb other title "Zhou et al., correlation", \
       file("heap_5200") using 1:2 skip 1 with linespoints pt 6 lc rgb own title "rolling friction 1 mm, step 0.5 ms", \
       (has("heap_5200_long") ? file("heap_5200_long") : "/dev/null") using 1:2 skip 1 with linespoints pt 4 lc rgb last title has("heap_5200_long") ? "the same, step 1 ms" : "", \
       (has("heap_5200_no_rolling") ? file("heap_5200_no_rolling") : "/dev/null") using 1:2 skip 1 with linespoints pt 2 lc rgb third title has("heap_5200_no_rolling") ? "no rolling friction" : ""
  set autoscale
}
if (has("oblique_glass") && has("oblique_acetate")) {
  set output folder . "/oblique.png"
  set title "Oblique impacts of two spheres: tangential velocity after the impact over before, both over u_n"
  set xlabel "{/Symbol y}_1"; set ylabel "{/Symbol y}_2"
  set key top left Left reverse
  walton(x, e, mu, b) = x * (1 + b) < 3.5 * (1 + e) * mu ? -b * x : x - 3.5 * (1 + e) * mu
  plot walton(x, 0.97, 0.092, 0.44) with lines lw 2 lc rgb other title "Foerster et al., glass: 0.97, 0.092, 0.44", \
       walton(x, 0.87, 0.25, 0.43) with lines lw 2 lc rgb third title "acetate: 0.87, 0.25, 0.43", \
       file("oblique_glass") using 1:2 skip 1 with points pt 6 lc rgb own title "TangentialRestitution", \
       file("oblique_acetate") using 1:2 skip 1 with points pt 6 lc rgb own notitle, \
       file("oblique_acetate_coulomb") using 1:2 skip 1 with points pt 2 ps 0.5 lc rgb last title "SignoriniCoulomb, acetate"
  set key top right
}
do for [kind in "plane axisymmetric"] {
  name = "columns_" . kind; angular = name . "_polygons"; rough = name . "_rolling"
  if (has(name)) {
    set output folder . "/" . name . ".png"
    set title sprintf("Collapse of a column, %s: run-out over the initial radius", kind)
    set xlabel "a = height / radius"; set ylabel "run-out / radius"; set xrange [0:*]; set yrange [0:*]
    set key top left
    of(name, mu) = has(name) ? sprintf("< awk -F, 'NR > 1 && $1 == %s' '%s'", mu, file(name)) : "/dev/null"
    round = kind eq "plane" ? "disks" : "balls"
    formula(a) = kind eq "plane" ? 1.2 * a : a < 1.7 ? 1.24 * a : 1.6 * sqrt(a)
    plot formula(x) with lines lw 2 lc rgb other title "experiments (formula)", \
         of(name, "0.3") using 2:3:($4 > 0 ? $4 : 0) with yerrorbars pt 6 lc rgb own title round . ", friction 0.3", \
         of(name, "0.6") using 2:3:($4 > 0 ? $4 : 0) with yerrorbars pt 4 lc rgb last title round . ", friction 0.6", \
         of(angular, "0.3") using 2:3:($4 > 0 ? $4 : 0) with yerrorbars pt 7 lc rgb own title has(angular) ? "polygons, friction 0.3" : "", \
         of(angular, "0.6") using 2:3:($4 > 0 ? $4 : 0) with yerrorbars pt 5 lc rgb last title has(angular) ? "polygons, friction 0.6" : "", \
         of(rough, "0.3") using 2:3:($4 > 0 ? $4 : 0) with yerrorbars pt 7 lc rgb own title has(rough) ? "with resistance to rolling, friction 0.3" : "", \
         of(rough, "0.6") using 2:3:($4 > 0 ? $4 : 0) with yerrorbars pt 5 lc rgb last title has(rough) ? "with resistance to rolling, friction 0.6" : ""
    set key top right; set autoscale
  }
}
if (has("dice")) {
  set output folder . "/dice.png"
  set title "Dice: solid fraction, loosest and sediment (open), poured (crosses) and densest (filled)"
  set xlabel "faces"; set ylabel "solid fraction"; set xrange [3:21]; set yrange [0.4:0.75]
  of(column, friction) = sprintf("< awk -F, 'NR > 1 && $2 == %s && $%d != \"nan\" {print $1 \",\" $%d}' '%s'", friction, column, column, file("dice"))
  plot file("dice") using 1:4 skip 1 with points pt 4 ps 2 lc rgb other title "Baker and Kudrolli, loosest", \
       file("dice") using 1:6 skip 1 with points pt 5 ps 2 lc rgb other title "densest", \
       of(3, "0.5") using ($1 + 0.15):2 with points pt 8 ps 1.5 lc rgb last title "moreau, friction 0.5", \
       of(5, "0.5") using ($1 + 0.15):2 with points pt 9 ps 1.5 lc rgb last notitle, \
       of(7, "0.5") using ($1 + 0.15):2 with points pt 2 ps 1.5 lc rgb last notitle, \
       of(3, "0.2") using ($1 - 0.15):2 with points pt 6 ps 1.5 lc rgb own title "moreau, friction 0.2", \
       of(5, "0.2") using ($1 - 0.15):2 with points pt 7 ps 1.5 lc rgb own notitle, \
       of(7, "0.2") using ($1 - 0.15):2 with points pt 2 ps 1.5 lc rgb own notitle, \
       of(5, "0") using ($1 - 0.3):2 with points pt 11 ps 1.5 lc rgb third title "moreau, friction 0", \
       of(7, "0") using ($1 - 0.3):2 with points pt 2 ps 1.5 lc rgb third notitle, \
       of(11, "0.5") using 1:2 with points pt 12 ps 1.8 lw 2 lc rgb "black" title "rounded edges, sediment, friction 0.5", \
       of(13, "0.2") using 1:2 with points pt 13 ps 1.8 lc rgb "black" title "rounded edges, friction 0.2"
  set key top right; set autoscale
}
