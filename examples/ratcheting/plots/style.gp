# SPDX-License-Identifier: MIT
# Terminal, colours and the names of the tables, for run.gp and uniqueness.gp. `folder` is the folder of the
# run.
if (!exists("folder")) folder = "."
wall = folder."/wall.csv"        # t,f,x,v,f_g
packing = folder."/packing.csv"  # t,rho_inner,rho_box,kinetic_energy,contacts,coordination
solver = folder."/solver.csv"    # step,pairs,points,sweeps,residual,max_overlap,mean_overlap,ms_...
events = folder."/events.csv"    # period,t_before,x_before,t_onset,t_force_min,t_peak,x_peak,
                                 # t_after,x_after; may be missing
has_events = system("test $(cat '".events."' 2>/dev/null | wc -l) -gt 1 && echo 1 || echo 0") + 0

if (strstrt(GPVAL_TERMINALS, "pngcairo")) {
  set terminal pngcairo size 1200, 800 font "DejaVu Sans,17" linewidth 1.6 rounded
} else {
  set terminal png size 1200, 800 medium linewidth 2
}
set encoding utf8
set autoscale xfix
set datafile separator ","
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror textcolor rgb "#444444"
set grid linetype 1 linewidth 0.4 linecolor rgb "#d8d8d8"
set key opaque box linecolor rgb "#d8d8d8" samplen 2
blue = "#1f5fa8"
red = "#b3261e"
green = "#2e7d4f"
orange = "#d07a00"
grey = "#7a7a7a"
mm(x) = 1e3 * x
kN(f) = 1e-3 * f
