#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Time per grain and step, stage by stage, and memory per grain, for 1,200 to 97,200 grains on 1 and 2
# threads. Writes scaling.csv, scaling.md and scaling.png into a folder; the tiles that it prepares stay
# there for the next time. Takes 10 to 20 minutes. Sizes that are in the table already are left out.
#
#   bench/scaling.sh [FOLDER [SHAPES [TILES [THREADS]]]]
#   bench/scaling.sh scaling-output "polyhedron sphere" "1 9 18 81" 2
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
if [[ ${1:-} == -* ]]; then
  echo "usage: bench/scaling.sh [FOLDER [SHAPES [TILES [THREADS]]]]" >&2
  exit 2
fi
folder=${1:-scaling-output} shapes=${2:-polyhedron sphere} tiles=${3:-1 9 18 81} threads=${4:-2}
"$top/.ci/require" g++ cmake ninja-build pkg-config libeigen3-dev libbenchmark-dev python3
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
build=$top/build/bench
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_EXAMPLES=OFF -DMOREAU_BUILD_BENCHES=ON >/dev/null
cmake --build "$build" --target bench_scaling
program=$build/bench/bench_scaling
mkdir -p "$folder"
table=$folder/scaling.csv
[ -f "$table" ] || "$program" >"$table"
for shape in $shapes; do
  for count in $tiles; do
    grep -q "^$shape,curve,$((1200 * count))," "$table" && continue
    echo "$shape: $((1200 * count)) grains"
    lines=$("$program" "$shape" "$count" "$threads" curve 40 "$folder")
    echo "$lines" >>"$table"
  done
done
python3 "$top/bench/scaling.py" "$folder"
gnuplot -e "folder='$folder'" "$top/bench/scaling.gp"
echo "wrote $folder/scaling.md and $folder/scaling.png"
