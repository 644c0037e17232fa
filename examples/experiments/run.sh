#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the program and runs it. Without arguments it runs the small
# versions of all experiments: about two minutes. Arguments replace --quick; --help lists them.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
"$top/.ci/require" g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev xz-utils
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
cmake -S "$top" -B "$top/build/examples" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_BENCHES=OFF >/dev/null
echo "building experiments in $top/build/examples"
cmake --build "$top/build/examples" --target experiments
[ $# -gt 0 ] || set -- --quick
exec "$top/build/examples/examples/experiments" "$@"
