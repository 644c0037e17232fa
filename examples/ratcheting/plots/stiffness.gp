# SPDX-License-Identifier: MIT
# gnuplot -e "name='polygon-1-5'; period=0.2; fmax=6000" stiffness.gp, in the folder of stiffness.sh:
# position of the wall over the second period after the hold, for all stiffnesses and tolerances.
set datafile separator ","
set terminal pngcairo size 900,620 font "sans,13"
set output name.".png"
parts = system("echo ".name." | tr - ' '")
set title sprintf("%s, seed %s: 1200 grains, {/Symbol n} = %g Hz, f_{max} = %g kN, second period", word(parts, 1), word(parts, 2), 1 / period, fmax / 1e3)
set xlabel "time since f was largest / period"
set ylabel "displacement of the wall since then, outward [mm]"
set xrange [0:0.75]
set key left top
set grid
start = 1.75 * period
at(file) = system(sprintf("awk -F, -v t=%.6f 'NR > 1 && $1 >= t - 1e-5 { printf \"%%.9f\", $3; exit }' %s", start, file)) + 0
x(k) = name."-".word("rigid rigid-tight k 3k 10k", k)."/wall.csv"
plot x(1) using (($1 - start) / period):(1e3 * ($3 - at(x(1)))) every 5 with lines lw 2 lc rgb "#999999" title "rigid, QM/16 10^{-4}", \
     x(2) using (($1 - start) / period):(1e3 * ($3 - at(x(2)))) every 5 with lines lw 2 lc rgb "#444444" title "rigid, residual 10^{-5}", \
     x(3) using (($1 - start) / period):(1e3 * ($3 - at(x(3)))) every 5 with lines lw 2 lc rgb "#4FB3D9" title "k = 10^8 N/m, residual 10^{-5}", \
     x(4) using (($1 - start) / period):(1e3 * ($3 - at(x(4)))) every 5 with lines lw 2 lc rgb "#0B6E99" title "3 k, residual 3·10^{-6}", \
     x(5) using (($1 - start) / period):(1e3 * ($3 - at(x(5)))) every 5 with lines lw 2 lc rgb "#B5482A" title "10 k, residual 10^{-6}"
