#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# From a bare Debian 12 to positions of a simulated encoder: installs missing packages, builds the
# simulator, runs the examples. The second run is quick.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ $# -gt 0 ]; then
  echo "usage: tools/demo.sh" >&2
  exit 2
fi

log=build/demo.log
step() {
  echo "demo: $1" >&2
  shift
  if ! "$@" >>"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "demo: failed; the whole log is $log" >&2
    exit 1
  fi
}

tools/setup.sh demo
mkdir -p build
: >"$log"
if [ -f build/CMakeCache.txt ]; then
  step "configuring" cmake build
else
  step "configuring" cmake --preset first
fi
step "building (the first time two to three minutes on two cores)" cmake --build build --target mb4sim

for example in resolute-26 ramp-sensor ti-tidm-1010; do
  printf '\n$ build/bin/mb4sim run examples/%s.toml --frames 5\n' "$example"
  build/bin/mb4sim run "examples/$example.toml" --frames 5
done
printf '\nThe same chip by hand, over SPI (read REVISION and VERSION):\n'
printf "\$ echo '03 EA 00 00' | build/bin/mb4sim spi examples/resolute-26.toml\n"
echo '03 EA 00 00' | build/bin/mb4sim spi examples/resolute-26.toml
