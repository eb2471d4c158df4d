#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Line, branch and toggle coverage of the RTL by the tests of a whole master, in one HTML page.
# Usage: tools/coverage.sh [--design NAME] [BUILD]   (default build; configured before)
# NAME is a design of masters.toml, `measured`; by default chip, mb4_chip. Its entry has the programs, the files that
# count and the goals, below which the run fails. Report: BUILD/coverage/NAME/index.html; of chip BUILD/coverage/index.html.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
design=chip
if [ "${1:-}" = --design ]; then
  design=${2:?tools/coverage.sh: --design has no name}
  shift 2
fi
build=$(realpath "${1:-$root/build}")
out=$build/coverage
[ "$design" = chip ] || out=$out/$design
told=$(python3 -B "$root/tools/masters.py" --measured "$design")
{ read -r programs; read -r tests; } <<<"$told"
mkdir -p "$out"

cmake --build "$build" --target "coverage_$design" -- --quiet
# Tests for statistics are shortened or left out, and so are those of one thing at many phases: they
# reach no new code and take most of the time.
export MB4_RANDOM_CONFIGS=100 MB4_HOST_FRAMES=300
skipped=$(grep -v '^#' "$root/tests/support/statistics.txt" | paste -sd:):Cuts/MaPulse.*:ConfigChange.*
# run PROGRAM SHARD: a quarter of a program's tests.
run() {
  echo "coverage: $1, part $2 of 4" >&2
  MB4_COVERAGE=$out/$1.$2.dat GTEST_TOTAL_SHARDS=4 GTEST_SHARD_INDEX=$(($2 - 1)) \
    "$build/bin/cover_${design}_$1" --gtest_brief=1 --gtest_filter="$filter" >"$out/$1.$2.log" 2>&1 ||
    { tail -20 "$out/$1.$2.log"; return 255; }
}
export -f run
[ "$tests" != - ] || tests=-$skipped
export build out design filter="${MB4_COVERAGE_FILTER:-$tests}"
rm -f "$out"/*.dat
for program in $programs; do printf '%s\n' "$program "{1,2,3,4}; done |
  xargs -P "$(nproc)" -L 1 bash -c 'run "$@"' run
python3 -B "$root/tests/coverage/report.py" "$design" "$out/index.html" "$out"/*.dat
