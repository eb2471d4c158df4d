#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Line, branch and toggle coverage of the RTL by the tests of the whole chip, in one HTML page.
# Usage: tools/coverage.sh [BUILD]   (default build; configured before)
# Report: BUILD/coverage/index.html. Fails below the goals (tests/coverage/report.py).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(realpath "${1:-$root/build}")
out=$build/coverage
mkdir -p "$out"

cmake --build "$build" --target coverage_programs -- --quiet
# Tests for statistics are shortened or left out, and so are those of one thing at many phases: they
# reach no new code and take most of the time.
export MB4_RANDOM_CONFIGS=100 MB4_HOST_FRAMES=300
skipped=$(grep -v '^#' "$root/tests/support/statistics.txt" | paste -sd:):Cuts/MaPulse.*:ConfigChange.*
# run PROGRAM SHARD: a quarter of a program's tests.
run() {
  echo "coverage: $1, part $2 of 4" >&2
  MB4_COVERAGE=$out/$1.$2.dat GTEST_TOTAL_SHARDS=4 GTEST_SHARD_INDEX=$(($2 - 1)) \
    "$build/bin/cover_$1" --gtest_brief=1 --gtest_filter="$filter" >"$out/$1.$2.log" 2>&1 ||
    { tail -20 "$out/$1.$2.log"; return 255; }
}
export -f run
export build out filter="${MB4_COVERAGE_FILTER:--$skipped}"
rm -f "$out"/*.dat
printf '%s\n' {chip_test,protocol_test,chip_host_test}' '{1,2,3,4} |
  xargs -P "$(nproc)" -L 1 bash -c 'run "$@"' run
python3 -B "$root/tests/coverage/report.py" "$out/index.html" "$out"/*.dat
