#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Measures contact detection: all shapes and queries, without and with a cache, with data in the caches
# of the processor and from memory; beside them FCL, libccd, Bullet and Box2D where they are installed.
# Writes tables and a plot into a folder. Takes 10 to 40 minutes on a machine without other load.
#
#   bench/run.sh                          into the folder bench-output
#   bench/run.sh --output FOLDER          into another folder
#   bench/run.sh --shape HEADER TYPE      also a shape of your own: see examples/guide/timing.md
#   bench/run.sh --filter REGEX           only benchmarks whose name matches, e.g. '^own|^balls'
#   bench/run.sh --no-peers               without the other libraries, even if they are installed
#   bench/run.sh --install-peers          installs the other libraries first (Debian)
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
output=bench-output filter=. header="" type="" peers=yes install=no
usage() { sed -n '3,12s/^# \{0,1\}//p' "$0" >&2 && echo "bench/run.sh: $1" >&2 && exit 2; }
while [ $# -gt 0 ]; do
  case $1 in
    --output | --filter) [ $# -ge 2 ] || usage "$1 needs a value" ;;
    --shape) [ $# -ge 3 ] && [ -f "$2" ] || usage "--shape needs a header that exists and the name of a type" ;;
  esac
  case $1 in
    --output) output=$2 && shift 2 ;;
    --shape) header=$(realpath "$2") type=$3 && shift 3 ;;
    --filter) filter=$2 && shift 2 ;;
    --no-peers) peers=no && shift ;;
    --install-peers) install=yes && shift ;;
    *) usage "unknown option $1" ;;
  esac
done
"$top/.ci/require" g++ cmake ninja-build pkg-config libeigen3-dev libbenchmark-dev python3
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
[ $install = no ] || "$top/.ci/require" libfcl-dev libccd-dev libbullet-dev libbox2d-dev
only=OFF
[[ -z $header || $filter != ^own* ]] || only=ON
build=$top/build/bench
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON -DMOREAU_BENCH_PEERS=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_EXAMPLES=OFF -DMOREAU_BUILD_BENCHES=ON \
  "-DMOREAU_BENCH_HEADER=$header" "-DMOREAU_BENCH_SHAPE=$type" \
  -DMOREAU_BENCH_OWN_ONLY=$only >/dev/null
cmake --build "$build" --target bench_narrow_phase
mkdir -p "$output"
"$build/bench/bench_narrow_phase" --benchmark_filter="$filter" --benchmark_min_time=0.05 \
  --benchmark_out="$output/narrow_phase.json" --benchmark_out_format=json | tee "$output/narrow_phase.log"
if [ $peers = no ]; then
  rm -f "$output/peers.txt"
elif ninja -C "$build" -t query bench_peers >/dev/null 2>&1; then
  cmake --build "$build" --target bench_peers
  "$build/bench/peers/bench_peers" | tee "$output/peers.txt"
else
  echo "No comparison with other libraries: install them, or use --install-peers"
fi
python3 "$top/bench/table.py" "$output/narrow_phase.json" "$output"
if command -v gnuplot >/dev/null; then
  gnuplot -e "folder='$output'" "$top/bench/narrow_phase.gp"
fi
echo "wrote $output/narrow_phase.md and $output/narrow_phase.png"
