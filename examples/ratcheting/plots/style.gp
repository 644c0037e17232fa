# SPDX-License-Identifier: MIT
# Terminal, colours, caption and the names of the tables, for run.gp and uniqueness.gp. `folder` is the folder of the
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
# Caption above the plot: what was simulated, from run.json of the folder.
parameter(run, key) = system(sprintf("sed -n 's/^ *\"%s\": *\"*\\([^\",]*\\).*/\\1/p' '%s/run.json' 2>/dev/null | head -n 1", key, run))
caption(run) = strlen(parameter(run, "grains")) == 0 ? "" : sprintf("N = %s (%s), {/Symbol n} = %g Hz, f_{max} = %g kN, seed %s, %s, tolerance %s (%s)", parameter(run, "grains"), parameter(run, "shape"), real(parameter(run, "frequency")), kN(real(parameter(run, "fmax"))), parameter(run, "seed"), parameter(run, "method"), parameter(run, "tolerance"), parameter(run, "stop_test"))
set tmargin 2
set label 99 caption(folder) at screen 0.54, screen 0.98 center font ",12" textcolor rgb grey
