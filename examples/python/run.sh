#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the Python module into build/python/package, and runs its tests.
# The C++ programs that the scripts are compared with are built, too.
#
#   run.sh [arguments of pytest]     e.g. run.sh -k packing
#   run.sh --module                  builds the module alone, without tests
#   run.sh --asan                    the tests of memory and of wrong uses, under the address sanitizer, which
#                                    watches all memory that the module, NumPy and Python allocate
#   run.sh --speed                   a step in Python beside one in C++, and reading a million poses
#
# PYTHON names another interpreter than /usr/bin/python3. CMAKE_OPTIONS go to the configuration.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
python=${PYTHON:-/usr/bin/python3}
"$top/.ci/require" g++ cmake ninja-build libeigen3-dev libpng-dev python3 python3-dev python3-numpy python3-matplotlib \
  python3-pytest pybind11-dev
what=tests
case ${1:-} in --module | --asan | --speed) what=${1#--} && shift ;; esac
build=$top/build/python options=(-DMOREAU_NATIVE=ON)
[[ $what != tests && $what != speed ]] || options+=(-DMOREAU_PYTHON_TWINS=ON)
# shellcheck disable=SC2086  # options, none of which holds a space
cmake -S "$here" -B "$build" -G Ninja -DPython_EXECUTABLE="$python" "${options[@]}" ${CMAKE_OPTIONS:-} >/dev/null
echo "building the module in $build/package"
cmake --build "$build" --parallel "$(nproc)"
export PYTHONPATH=$build/package PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg
case $what in
  module) echo "export PYTHONPATH=$build/package" ;;
  speed) "$python" "$here/speed.py" "$build" ;;
  asan)
    # The sanitizer replaces malloc(), free() and memcpy(). Python itself leaks.
    LD_PRELOAD="$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libstdc++.so)" ASAN_OPTIONS=detect_leaks=0 \
      PYTHONMALLOC=malloc "$python" -m pytest -p no:cacheprovider -q "$here"/tests/test_{memory,errors,sanitizer}.py "$@"
    ;;
  tests) MOREAU_TWINS=$build "$python" -m pytest -p no:cacheprovider -q "$here/tests" "$@" ;;
esac
