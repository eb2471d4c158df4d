#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Line and branch coverage of the driver (headers, ports, C binding) by its own tests, against
# limits.
# Usage: tools/driver_coverage.sh [BUILD [LINES_PERCENT [BRANCHES_PERCENT]]]
#   BUILD was configured before (default build). Default limits: 100 and 97.
# Prints gcovr's table; BUILD/driver-coverage/ keeps it with what is not covered (lines.txt,
# branches.txt). Exit status 1 below a limit, 77 where gcovr is missing.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(realpath "${1:-$root/build}")
lines=${2:-100}
branches=${3:-97}

if ! command -v gcovr >/dev/null; then
  echo "skipped: gcovr is not installed"
  exit 77
fi
cmake --build "$build" --target mb4sim_core mb4sim_shared -- -j2 >/dev/null
work=$build/driver-coverage
mkdir -p "$work"
cd "$work"
rm -f -- *.gcda *.gcno *.o

launcher=$(command -v ccache || true)
tests=$root/tests/driver
# Built without exceptions, as users build the driver: then no branch belongs to an exception.
export FLAGS="-O0 --coverage -fno-inline -DMB4_EXAMPLES=\"$root/examples\" \
  -DMB4_MANUAL=\"$root/docs/driver.md\" -I$root/drivers/include \
  -I$root/regmap/generated/mb4 -I$root/regmap/generated/mb4_page -I$root \
  -I$root/sim/include -I$root/tools/mb4sim \
  -I$tests/ports"
# compile COMPILER SOURCE...: one object each, two at once. A source that does not compile stops it.
compile() {
  local compiler=$1
  shift
  printf '%s\n' "$@" | xargs -P 2 -I{} sh -c \
    "$launcher $compiler"' $FLAGS -c "$1" -o "$(basename "$1").o"' - {}
}
compile "g++ -std=c++20 -fno-exceptions" "$tests"/{enc,mb4}/*_test.cpp
# Some headers of the simulator throw; these are copies that stop instead.
rm -rf headers
mkdir headers
(cd "$root" && find sim -name '*.h' -o -name '*.hpp' | xargs cp --parents -t "$work/headers")
find headers -type f -exec sed -i -E 's/\bthrow [A-Z_a-z:]+\(.*\);/__builtin_trap();/' {} +
compile "g++ -std=c++20 -fno-exceptions -I$work/headers -I$work/headers/sim/include" \
  "$tests"/{rtl,ports}/rtl_*_test.cpp
compile "g++ -std=c++17 -fno-exceptions -fno-rtti" "$root/drivers/c/mb4_c.cpp"
compile "gcc -std=c99" "$tests"/c/{c_binding,cyclic}_test.c

simulator=("$build/lib/libmb4sim_core.a" "$build/lib/libmb4sim_chip.a" -lfmt -lz -lpthread -ldl)
gtest=(-lgtest -lgtest_main -lpthread)
mapfile -t unit < <(ls -- *_test.cpp.o | grep -v '^rtl_')
mapfile -t rtl < <(ls -- rtl_*_test.cpp.o | grep -v -e ports -e rtio)
g++ --coverage "${unit[@]}" "${gtest[@]}" -o unit_tests
g++ --coverage "${rtl[@]}" "${simulator[@]}" "${gtest[@]}" -o rtl_tests
g++ --coverage rtl_{ports,rtio}_test.cpp.o "${simulator[@]}" "${gtest[@]}" -o ports_tests \
  -Wl,--wrap=open,--wrap=close,--wrap=ioctl
g++ --coverage c_binding_test.c.o mb4_c.cpp.o -L"$build/lib" -lmb4sim \
  -Wl,-rpath,"$build/lib" -o c_tests
g++ --coverage cyclic_test.c.o -L"$build/lib" -lmb4sim -Wl,-rpath,"$build/lib" -o cyclic_tests

./unit_tests --gtest_brief=1
./ports_tests --gtest_brief=1
./c_tests
./cyclic_tests
# Left out: fault tests that take minutes. Other tests reach the same branches.
./rtl_tests --gtest_brief=1 --gtest_filter=-Ways/DriverFault.*
# A parallel bus, with what needs the least time.
MB4_HOST=intel ./rtl_tests --gtest_brief=1 --gtest_filter=*DriverCall*:-*EachTransferFails*

# Branches that only an exception takes belong to the test programs and not to the driver.
report() {
  gcovr --root "$root" --filter "$root/drivers/" --exclude-throw-branches \
    --exclude-unreachable-branches --object-directory "$work" "$work" "$@"
}
report --txt lines.txt --json-summary summary.json --json coverage.json
report --branches >branches.txt
cat lines.txt
python3 - summary.json "$lines" "$branches" <<'PYTHON'
import json
import sys

with open(sys.argv[1]) as file:
    summary = json.load(file)
low = [f"{what} coverage is {summary[key]} %, less than {limit} %"
       for what, key, limit in (("line", "line_percent", float(sys.argv[2])),
                                ("branch", "branch_percent", float(sys.argv[3])))
       if summary[key] < limit]
print(f"lines {summary['line_percent']} %, branches {summary['branch_percent']} %")
print("\n".join(low))
sys.exit(bool(low))
PYTHON
