#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the program, runs it and plots the result. Arguments go to the
# program; run.sh --help lists them. Writes into silo-output, or the folder given by --output.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
"$top/.ci/require" g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev libpng-dev
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
cmake -S "$top" -B "$top/build/examples" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_BENCHES=OFF >/dev/null
echo "building silo in $top/build/examples"
cmake --build "$top/build/examples" --target silo
"$top/build/examples/examples/silo" "$@"
case " $* " in *" --help "* | *" -h "*) exit ;; esac
folder=$(printf '%s\n' "$@" | sed -n 's/^--output=//p; /^--output$/{n;p}' | tail -n 1)
cd "${folder:-silo-output}"
gnuplot "$here/silo.gp"
echo "plotted $PWD/silo.png"
