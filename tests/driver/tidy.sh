#!/bin/sh
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# clang-tidy with drivers/.clang-tidy over the whole driver, the C binding and the Linux port. First
# a planted fault, which has to be reported.
#
#   tidy.sh CLANG_TIDY ROOT
#
# Exit status 77: clang-tidy is missing.

set -u
tidy=$1
root=$2
if ! command -v "$tidy" > /dev/null 2>&1; then
  echo "skipped: clang-tidy is not installed"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags="-std=c++17 -fno-exceptions -fno-rtti -I$root/drivers/include -I$root/regmap/generated/mb4 -I$root/regmap/generated/mb4_page"

run() {
  "$tidy" --quiet --config-file="$root/drivers/.clang-tidy" "$1" -- $flags
}

printf 'int f(int a, int b) { if ((a = b)) { a; } return *(int*)0; }\n#define FIVE 5\n' \
  > "$work/planted.cpp"
if run "$work/planted.cpp" > "$work/log" 2>&1 || ! grep -q 'macro-usage' "$work/log"; then
  echo "a planted fault is not reported"
  exit 1
fi
printf '#include "mb4/ports/arduino.hpp"\n#include "mb4/ports/spidev.hpp"\n#include "mb4/words/memory_bus.hpp"\n#include "mb4/words/snapshots.hpp"\n' > "$work/ports.cpp"
ports=$root/tests/driver/ports
printf '#include "main.h"\n#include "mb4/ports/stm32_hal.hpp"\n#include "mb4/ports/pico.hpp"\n#include "mb4/ports/esp_idf.hpp"\n' > "$work/mcu.cpp"
flags="$flags -isystem $ports/stm32 -isystem $ports/pico -isystem $ports/esp_idf"
status=0
for file in "$root/drivers/c/mb4_c.cpp" "$root/tests/driver/footprint/whole.cpp" \
  "$root/tests/driver/footprint/safety.cpp" "$root/tests/driver/footprint/guarded.cpp" \
  "$work/ports.cpp" "$work/mcu.cpp"; do
  run "$file" 2> "$work/log" || { status=1; grep -E 'warning|error' "$work/log"; }
done
exit $status
