#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the batch runner and runs it. Without arguments it runs
# the small plan. Arguments replace --plan small; the program's default is the whole study. --help
# builds nothing; --report-only and --list do not build the program that simulates.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../../.." && pwd)
targets=(ratcheting ratcheting_study)
case " $* " in
  *" --help "* | *" -h "*) exec cat "$here/help.txt" ;;
  *" --report-only "* | *" --list "*) targets=(ratcheting_study) ;;
esac
"$top/.ci/require" g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
# The same instructions on all machines that have them: a run then has the same bits.
instructions=-march=native
if g++ -march=x86-64-v3 -E - </dev/null >/dev/null 2>&1 && grep -qw avx2 /proc/cpuinfo; then
  instructions=-march=x86-64-v3
fi
shapes="polyhedron;polygon;sphere;disk"
case " $* " in *settled*) shapes+=";compound;compound_polygon" ;; esac  # its concave grains
cmake -S "$top" -B "$top/build/study" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=OFF \
  "-DCMAKE_CXX_FLAGS=$instructions" \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_BENCHES=OFF \
  "-DRATCHETING_SHAPES=$shapes" \
  "-DRATCHETING_METHODS=contact_dynamics;compliant" >/dev/null
echo "building ${targets[*]} in $top/build/study"
cmake --build "$top/build/study" --target "${targets[@]}"
[ $# -gt 0 ] || set -- --plan small
echo "ratcheting_study $*"
exec "$top/build/study/examples/ratcheting_study" "$@"
