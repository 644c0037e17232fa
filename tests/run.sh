#!/bin/bash
# SPDX-License-Identifier: MIT
# Installs what the project needs (Debian), builds the tests and runs them. Arguments go to ctest:
#   tests/run.sh                 tests of all folders, without what takes longest to compile
#   tests/run.sh --all           all but the long tests; must be the first argument
#   tests/run.sh --room measure  builds and runs the tests of the folder tests/measure alone; must be first
#   tests/run.sh -R detect       those whose name contains detect
#   PRESET=asan tests/run.sh     all of another preset of CMakePresets.json than release
# CMAKE_OPTIONS go to the configuration.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${PRESET:-release}
jobs=$(nproc)
target=moreau_tests
test_preset=$preset
room=
if [[ ${1:-} == --all ]]; then
  shift
elif [[ ${1:-} == --room ]]; then
  room=${2:-}
  [[ -n $room && -d tests/$room ]] || { echo "tests/run.sh: there is no folder tests/$room" >&2 && exit 2; }
  shift 2
  target=moreau_test_$room
  test_preset=$preset-quick
  [[ $preset == release ]] || test_preset=$preset
  set -- --tests-regex "^$room\\.[a-z_]*$" "$@"
elif [[ $preset == release ]]; then
  target=moreau_quick_tests
  test_preset=release-quick
fi

.ci/require cmake g++ ninja-build pkg-config libeigen3-dev doctest-dev libcli11-dev \
  nlohmann-json3-dev libbenchmark-dev libhdf5-dev libpng-dev
case $preset in clang | asan) .ci/require clang libclang-rt-14-dev ;; esac
[[ $preset != release ]] || CMAKE_OPTIONS="-DMOREAU_TEST_FAST=ON -DMOREAU_TEST_ROOM=$room ${CMAKE_OPTIONS:-}"
# shellcheck disable=SC2086  # options, none of which holds a space
cmake --preset "$preset" ${CMAKE_OPTIONS:-}
cmake --build --preset "$preset" --target $target --parallel "$jobs"
ctest --preset "$test_preset" --parallel "$jobs" "$@"
