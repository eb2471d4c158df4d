#!/bin/sh
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds and links a small firmware for Cortex-M0+, prints what it takes, and rejects every symbol
# that a driver without heap, exceptions and static constructors cannot need.
#
#   arm_footprint.sh FILE LIMIT FLAGS...
#
# LIMIT: most bytes of code and constants in the linked program. FLAGS are the include options and
# definitions. Exit status 77: compiler or its C++ headers are missing.

set -u
file=$1
limit=$2
shift 2
prefix=arm-none-eabi-

if ! command -v ${prefix}g++ > /dev/null 2>&1; then
  echo "skipped: ${prefix}g++ is not installed"
  exit 77
fi
cpu="-mcpu=cortex-m0plus -mthumb"
if ! echo '#include <array>' |
  ${prefix}g++ $cpu -std=c++17 -x c++ -fsyntax-only - 2> /dev/null; then
  echo "skipped: C++ headers of ${prefix}g++ are missing (libstdc++-arm-none-eabi-newlib)"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags="-std=c++17 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -Os
  -ffunction-sections -fdata-sections -fstack-usage
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
${prefix}g++ $cpu $flags "$@" -c "$file" -o "$work/unit.o" || exit 1
# Without start files and C++ runtime: everything but libgcc arithmetic and memcpy is the driver's.
${prefix}gcc $cpu -nostartfiles --specs=nano.specs -Wl,--gc-sections -Wl,-e,firmware \
  "$work/unit.o" -o "$work/unit.elf" || exit 1

echo "object file:"
${prefix}size "$work/unit.o"
echo "linked, with libgcc and memcpy:"
${prefix}size "$work/unit.elf"
echo "largest stack frames in bytes:"
sort -t "$(printf '\t')" -k 2 -n -r "$work"/*.su | head -n 4 | sed 's/^[^:]*:[0-9]*:[0-9]*://'
echo "symbols from outside:"
${prefix}nm -u "$work/unit.o"

heap='malloc|calloc|realloc| free$|_Znw|_Zna|_Zdl|_Zda'
runtime='__cxa_|__aeabi_atexit|_Unwind|_GLOBAL__sub_I|__gxx_'
bad=$(${prefix}nm "$work/unit.o" "$work/unit.elf" | grep -E "$heap|$runtime")
if [ -n "$bad" ]; then
  echo "forbidden symbols:"
  echo "$bad"
  exit 1
fi
data=$(${prefix}size "$work/unit.o" | awk 'NR == 2 { print $2 }')
if [ "$data" != 0 ]; then
  echo "the driver must have no initialised static data, but has $data bytes"
  exit 1
fi
text=$(${prefix}size "$work/unit.elf" | awk 'NR == 2 { print $1 }')
if [ "$text" -gt "$limit" ]; then
  echo "code and constants take $text bytes, more than the limit of $limit"
  exit 1
fi
