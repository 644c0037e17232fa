#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the program, runs it and plots the result. Arguments go to the
# program; run.sh --help lists them. Writes into biaxial-output, or the folder given by --output.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
"$top/.ci/require" g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
cmake -S "$top" -B "$top/build/examples" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_BENCHES=OFF >/dev/null
echo "building biaxial in $top/build/examples"
cmake --build "$top/build/examples" --target biaxial
failed=0
"$top/build/examples/examples/biaxial" "$@" || failed=1  # a check does not hold; plot all the same
case " $* " in *" --help "* | *" -h "*) exit ;; esac
folder=$(printf '%s\n' "$@" | sed -n 's/^--output=//p; /^--output$/{n;p}' | tail -n 1)
cd "${folder:-biaxial-output}"
gnuplot "$here/biaxial.gp"
echo "plotted $PWD/biaxial.png"
exit $failed
