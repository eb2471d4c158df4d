#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Line and branch coverage of the driver by its own tests, against limits.
# Usage: tools/driver_coverage.sh BUILD_DIR [LINES_PERCENT [BRANCHES_PERCENT]]
#   BUILD_DIR has the simulator's libraries (tools/test.sh makes build/). Defaults: 100 and 90.
# Prints gcovr's table; exit status 1 below a limit, 77 where gcovr is missing.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
lines=${2:-100}
branches=${3:-90}

if ! command -v gcovr >/dev/null; then
  echo "skipped: gcovr is not installed"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

flags=(-std=c++20 -O0 --coverage -fno-inline "-DMB4_EXAMPLES=\"$root/examples\""
  "-I$root/drivers/include" "-I$root/regmap/generated" "-I$root/sim/include"
  "-I$root/tools/mb4sim" "-I$root/tests/chip" "-I$root/tests/driver")
compile() {
  for source in "$@"; do
    echo "$source"
  done | xargs -P "$(nproc)" -I{} sh -c \
    'g++ "$@" -c "$0" -o "$(basename "$0" .cpp).o"' {} "${flags[@]}"
}

# Without the faults that take minutes: they repeat what others show.
mapfile -t rtl < <(ls "$root"/tests/driver/rtl_*_test.cpp | grep -v -e ports)
mapfile -t unit < <(ls "$root"/tests/driver/*_test.cpp | grep -v /rtl_)
compile "${unit[@]}" "${rtl[@]}"
unit_objects=()
for source in "${unit[@]}"; do unit_objects+=("$(basename "$source" .cpp).o"); done
rtl_objects=()
for source in "${rtl[@]}"; do rtl_objects+=("$(basename "$source" .cpp).o"); done
g++ --coverage "${unit_objects[@]}" -lgtest -lgtest_main -lpthread -o unit_tests
g++ --coverage "${rtl_objects[@]}" "$build/lib/libmb4sim_core.a" "$build/lib/libmb4sim_chip.a" \
  -lfmt -lz -lpthread -ldl -lgtest -lgtest_main -o rtl_tests
./unit_tests --gtest_brief=1
./rtl_tests --gtest_brief=1 --gtest_filter=-Ways/DriverFault.*

# Branches that only an exception takes are the test program's, not the driver's.
gcovr --root "$root" --filter "$root/drivers/include/mb4/" --exclude-throw-branches \
  --exclude-unreachable-branches --object-directory "$work" . --txt lines.txt \
  --json-summary summary.json
gcovr --root "$root" --filter "$root/drivers/include/mb4/" --exclude-throw-branches \
  --exclude-unreachable-branches --object-directory "$work" . --branches | tee branches.txt | tail -4
cat lines.txt
python3 - summary.json "$lines" "$branches" <<'EOF'
import json
import sys

summary = json.load(open(sys.argv[1]))
low = [f"{what} coverage is {summary[key]} %, less than {limit} %"
       for what, key, limit in (("line", "line_percent", float(sys.argv[2])),
                                ("branch", "branch_percent", float(sys.argv[3])))
       if summary[key] < limit]
print("\n".join(low) or f"lines {summary['line_percent']} %, branches {summary['branch_percent']} %")
sys.exit(bool(low))
EOF
