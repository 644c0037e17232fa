#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the program and runs it. Without arguments it runs a small
# case: 120 polyhedra, with the wall's force scaled to the weight of the sample. Arguments replace
# those of the small case; the program's defaults are the full case. --help builds nothing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
case " $* " in *" --help "* | *" -h "*) exec cat "$here/help.txt" ;; esac
"$top/.ci/require" g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev libpng-dev gnuplot-nox
# Builds only the shapes that were asked for, now or before: each takes as long again.
shapes=$(printf '%s\n' "$@" | sed -n 's/^--shape=//p; /^--shape$/{n;p}' | tail -n 1)
known=$(sed -n 's/^RATCHETING_SHAPES:[^=]*=//p' "$top/build/study/CMakeCache.txt" 2>/dev/null || true)
shapes=$(printf '%s\n' ${known//;/ } "${shapes:-polyhedron}" | sort -u | paste -sd ';')
cmake -S "$top" -B "$top/build/study" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_BENCHES=OFF "-DRATCHETING_SHAPES=$shapes" >/dev/null
echo "building ratcheting in $top/build/study"
cmake --build "$top/build/study" --target ratcheting
[ $# -gt 0 ] || set -- --grains 120 --fmax 600
echo "ratcheting $*"
exec "$top/build/study/examples/ratcheting" "$@"
