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
  [[ -n $room ]] || { echo "tests/run.sh: --room needs the name of a folder of tests" >&2 && exit 2; }
  [[ -d tests/$room ]] || { echo "tests/run.sh: there is no folder tests/$room" >&2 && exit 2; }
  shift 2
  target=moreau_test_$room
  test_preset=$preset-quick
  [[ $preset == release ]] || test_preset=$preset
  set -- --tests-regex "^$room\\.[a-z_]*$" "$@"
elif [[ $preset == release ]]; then
  target=moreau_quick_tests
  test_preset=release-quick
fi

# ctest ignores what it does not know, and would run all tests after all of them are built.
if command -v ctest >/dev/null; then
  known=" $(ctest --help | grep -oE '(^|[ ,])--?[A-Za-z][A-Za-z-]*' | tr -d ' ,' | tr '\n' ' ')"
  before=
  for argument in "$@"; do
    case $argument in
      --all | --room) echo "tests/run.sh: $argument must be the first argument" >&2 && exit 2 ;;
      -*) [[ $known == *" ${argument%%=*} "* || $argument =~ ^-[jRELI][^-] ]] ||
        { echo "tests/run.sh: ctest has no option $argument" >&2 && exit 2; } ;;
      *) [[ -n $before ]] || { echo "tests/run.sh: $argument is no option; for a folder: --room $argument, for names: -R $argument" >&2 && exit 2; } ;;
    esac
    before=yes
    [[ $argument == -* ]] || before=
  done
fi

.ci/require cmake g++ ninja-build pkg-config libeigen3-dev doctest-dev libcli11-dev \
  nlohmann-json3-dev libbenchmark-dev libhdf5-dev libpng-dev
case $preset in clang | asan) .ci/require clang libclang-rt-14-dev ;; esac
[[ $preset != release ]] || CMAKE_OPTIONS="-DMOREAU_TEST_FAST=ON -DMOREAU_TEST_ROOM=$room ${CMAKE_OPTIONS:-}"
# shellcheck disable=SC2086  # options, none of which holds a space
cmake --preset "$preset" ${CMAKE_OPTIONS:-}
[[ $(ctest --preset "$test_preset" -N "$@") != *"Total Tests: 0"* ]] ||
  { echo "tests/run.sh: no test of this preset fits $*" >&2 && exit 2; }
cmake --build --preset "$preset" --target $target --parallel "$jobs"
ctest --preset "$test_preset" --parallel "$jobs" "$@"
