#!/bin/sh
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# A Guarded device without ENC_CHECK_REENTRY is the same machine code as the device itself. With it,
# it is other code, which needs no library.
#
#   guarded.sh CPU FLAGS...      CPU: cortex-m0plus cortex-m4; FLAGS are the include options
#
# Exit status 77: the compiler is missing.

set -eu
cpu=$1
shift
here=$(dirname "$0")
if ! command -v arm-none-eabi-g++ > /dev/null 2>&1; then
  echo "skipped: arm-none-eabi-g++ is not installed"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

code() {
  name=$1
  shift
  arm-none-eabi-g++ -mcpu="$cpu" -mthumb --specs=nano.specs -std=c++17 -ffreestanding \
    -fno-exceptions -fno-rtti -fno-threadsafe-statics -Os -Wall -Wextra -Wconversion -Wshadow \
    -Werror "$@" -c "$here/guarded.cpp" -o "$work/$name.o"
  arm-none-eabi-objdump -dr --no-show-raw-insn "$work/$name.o" | tail -n +4 > "$work/$name.txt"
}
code plain -DPLAIN "$@"
code off "$@"
code on -DENC_CHECK_REENTRY "$@"
cmp "$work/plain.txt" "$work/off.txt"
if cmp -s "$work/off.txt" "$work/on.txt"; then
  echo "the switch changes nothing"
  exit 1
fi
if arm-none-eabi-nm "$work/on.o" | grep __atomic; then
  echo "the guard needs a library"
  exit 1
fi
for name in plain off on; do
  echo "$cpu $name: $(arm-none-eabi-size "$work/$name.o" | awk 'NR == 2 { print $1 }') bytes"
done
