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
# Tests that repeat many frames for statistics are shortened or left out: they reach no new code and
# take most of the time.
export MB4_RANDOM_CONFIGS=100 MB4_HOST_FRAMES=300
skipped='Lockstep.*:HostFuzz.*:ChipFaults.*:ControlWeak.*:Table37Slow/*:Percent/*:*HundredThousand*'
for program in chip_test protocol_test chip_host_test; do
  echo "coverage: $program" >&2
  MB4_COVERAGE=$out/$program.dat "$build/bin/cover_$program" --gtest_brief=1 \
    --gtest_filter="${MB4_COVERAGE_FILTER:--$skipped}" >"$out/$program.log" 2>&1 ||
    { tail -20 "$out/$program.log"; exit 1; }
done
python3 -B "$root/tests/coverage/report.py" "$out/index.html" "$out"/*.dat
