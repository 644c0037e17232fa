# SPDX-License-Identifier: MIT
# For the tests of programs: $folder is theirs until they end; fail counts what went wrong.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
