#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How unique is the solution? Simulates the same packing under the same force four times: with a warm
# start of the solver, with a cold start, and with the contacts in two other orders. Plots x and f_g over
# time in uniqueness.png and writes their spread to spread.md. A simulation that is done is not repeated.
#
#   uniqueness.sh PROGRAM FOLDER [OPTIONS OF THE PROGRAM]
#   uniqueness.sh build/study/examples/ratcheting uniqueness --shape polygon
set -euo pipefail
program=$(realpath "$1") && folder=$2 && shift 2
plots=$(cd "$(dirname "$0")/plots" && pwd)
mkdir -p "$folder" && cd "$folder"
declare -A variant=([warm]="" [cold]="--cold-start" [order1]="--order 1" [order2]="--order 2")
names=(warm cold order1 order2)
for name in "${names[@]}"; do
  [ -f "$name/done" ] && continue
  # shellcheck disable=SC2086
  "$program" "$@" ${variant[$name]} --packing packing.snapshot --snapshots 0 --no-pictures \
    --output "$name" >"$name.log" 2>&1
  touch "$name/done"
done

# Columns of wall.csv: t, f, x, v, f_g.
paste -d, warm/wall.csv cold/wall.csv order1/wall.csv order2/wall.csv >all.csv
awk -F, '
  NR > 1 && NF == 20 {
    low = high = $3; below = above = $5
    for (k = 1; k < 4; ++k) {
      x = $(3 + 5 * k); f = $(5 + 5 * k)
      if (x < low) low = x; if (x > high) high = x
      if (f < below) below = f; if (f > above) above = f
    }
    spread = high - low; ++n; sum += spread * spread; if (spread > most) most = spread
    gap = above - below; all += gap * gap; mean += ($5 + $10 + $15 + $20) / 4
    if ($3 < least) least = $3
    t = $1
    if (t < 0.2) early = most
  }
  END {
    printf "| spread over warm start, cold start, two other orders | |\n|---|---|\n"
    printf "| x, largest by t = 0.2 s | %.3g mm |\n| x, largest by t = %.3g s | %.3g mm |\n", 1e3 * early, t, 1e3 * most
    printf "| x, root of the mean square | %.3g mm, %.2g of the way in of %.3g mm |\n", 1e3 * sqrt(sum / n), sqrt(sum / n) / -least, -1e3 * least
    printf "| f_g, root of the mean square over the mean | %.3g |\n", sqrt(all / n) / (mean / n)
  }' all.csv | tee spread.md
if command -v gnuplot >/dev/null; then gnuplot -e "folder='.'" "$plots/uniqueness.gp"; fi
