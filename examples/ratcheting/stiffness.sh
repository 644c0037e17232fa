#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How much do the results depend on the stiffness of the contacts, the tolerance and the time step?
# For each shape and sample, one run with compliant contacts ends at a jammed state under the largest
# force. From this checkpoint four periods are simulated with other stiffnesses, tolerances, steps and
# frequencies. The rigid contacts of the default have a checkpoint of their own. A simulation that is
# done is not repeated, so the script can be stopped at any time. Plots the position of the wall over a
# period. `python3 stiffness.py FOLDER` prints the tables.
#
#   stiffness.sh PROGRAM FOLDER [SHAPE...]
#   stiffness.sh build/study/examples/ratcheting stiffness polygon disk
#
# SEEDS="2 3" chooses samples. CHECKS=stiffness leaves out rigid contacts and other steps.
set -euo pipefail
program=$(realpath "$1") && folder=$2 && shift 2
plots=$(cd "$(dirname "$0")/plots" && pwd)
[ $# -gt 0 ] || set -- polygon disk sphere polyhedron
mkdir -p "$folder" && cd "$folder"

# run NAME OPTIONS: one simulation in folder NAME
run() {
  local name=$1 && shift
  [ -f "$name/done" ] && return
  mkdir -p "$name"
  "$program" "$@" --snapshots 0 --no-pictures --no-plots --output "$name" >"$name/log" 2>&1
  touch "$name/done"
}
rigid=(--method contact-dynamics)
soft=(--method compliant --max-sweeps 2000 --cold-sweeps 3000)
tight=(--stop-test residual --tolerance 1e-5)
for seed in ${SEEDS:-1 2 3}; do
  for shape in "$@"; do
    start=$shape-$seed-start
    common=(--shape "$shape" --seed "$seed")
    run "$start-soft" "${common[@]}" "${soft[@]}" --duration 0.35 --checkpoint-every 1750
    # The elastic lines: the force falls in half a second, to 0.035 of its maximum.
    for stiffness in k 3k 10k; do
      case $stiffness in k) options=() ;; 3k) options=(--stiffness 3e8 --tolerance 3e-6) ;;
        10k) options=(--stiffness 1e9 --tolerance 1e-6) ;; esac
      run "$shape-$seed-static-$stiffness" "${common[@]}" "${soft[@]}" "${options[@]}" \
        --frequency 1 --duration 0.49 --from "$start-soft/checkpoint.snapshot"
    done
    for frequency in 5 20; do
      # Four periods after the hold of 0.05 s.
      duration=$(awk "BEGIN { print 0.05 + 4 / $frequency }")
      common=(--shape "$shape" --seed "$seed" --frequency "$frequency" --duration "$duration")
      from=(--from "$start-soft/checkpoint.snapshot")
      name=$shape-$seed-$frequency
      run "$name-k" "${common[@]}" "${soft[@]}" "${from[@]}"
      run "$name-k-tol10" "${common[@]}" "${soft[@]}" "${from[@]}" --tolerance 1e-6
      run "$name-3k" "${common[@]}" "${soft[@]}" "${from[@]}" --stiffness 3e8 --tolerance 3e-6
      run "$name-10k" "${common[@]}" "${soft[@]}" "${from[@]}" --stiffness 1e9 --tolerance 1e-6
      [ "${CHECKS:-all}" = all ] || continue
      run "$name-half-step" "${common[@]}" "${soft[@]}" "${from[@]}" --step 1e-4
      run "$name-double-step" "${common[@]}" "${soft[@]}" "${from[@]}" --step 4e-4
      run "$start-rigid" --shape "$shape" --seed "$seed" "${rigid[@]}" --duration 0.35 \
        --checkpoint-every 1750
      from=(--from "$start-rigid/checkpoint.snapshot")
      run "$name-rigid" "${common[@]}" "${rigid[@]}" "${from[@]}"
      run "$name-rigid-tight" "${common[@]}" "${rigid[@]}" "${from[@]}" "${tight[@]}"
      if command -v gnuplot >/dev/null; then
        gnuplot -e "name='$name'; period=1.0/$frequency; fmax=6000" "$plots/stiffness.gp"
      fi
    done
  done
done
