#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs missing packages, builds everything, runs every test through CTest.
# Usage: tools/test.sh [--sanitize] [--nightly] [CTEST-ARGUMENT...]
#        tools/test.sh --changed [--all]
#   --sanitize   the same with AddressSanitizer and UBSan, in build-sanitize/
#   --nightly    instead of the normal suite the long runs (label nightly) with their figures
#   --changed    builds, and runs what has changed since it passed by --changed, up to the first failure
# JUnit report: build/junit.xml (build-sanitize/junit.xml); time of each part: times.txt beside it.
# MB4_DATASHEET=FILE names the datasheet's text for the register map comparison.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1:-}" = --changed ]; then
  shift
  cmake --preset default >/dev/null
  exec tools/changed_tests.py build "$@"
fi

preset=default
build=build
nightly=no
configuration=()
while true; do
  case "${1:-}" in
    --sanitize)
      preset=sanitize
      build=build-sanitize
      ;;
    --nightly) nightly=yes ;;
    *) break ;;
  esac
  shift
done

mkdir -p "$build"
times=$build/times.txt
: >"$times"
part_began=$SECONDS
# Writes the time since the end of the previous part.
part_done() {
  printf '%-15s %-10s %5d s\n' "$build" "$1" "$((SECONDS - part_began))" >>"$times"
  part_began=$SECONDS
}

tools/setup.sh test
part_done packages

for tool in "cmake --version" "g++ --version" "verilator --version" "yosys -V" "iverilog -V"; do
  $tool 2>/dev/null | sed -n 1p
done

echo "test: configuring $build/" >&2
if ! cmake --preset "$preset" >"$build/configure.log" 2>&1; then
  cat "$build/configure.log" >&2
  exit 1
fi
part_done configure
echo "test: building" >&2
cmake --build "$build" -- --quiet
part_done build

if [ "$nightly" = yes ]; then
  configuration=(-C nightly)
  set -- -C nightly -L nightly --verbose "$@"
fi

status=0
ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$(nproc)" \
  --output-junit junit.xml "$@" >"$build/ctest.log" 2>&1 || status=$?
part_done tests
# Most tests pass: show only the failed ones with their output, and the summary.
if [ "$status" -ne 0 ]; then
  grep -v -e ' Passed ' -e '^ *Start ' "$build/ctest.log" || true
else
  # What the long runs print besides gtest's own lines.
  if [ "$nightly" = yes ]; then
    sed -n -E '/^[0-9]+: (Running main|Note: |\[|Test |  *MB4_|Environment)/d; /^[0-9]+: ./p' \
      "$build/ctest.log"
  fi
  sed -n '/tests passed/,$p' "$build/ctest.log"
fi
if [ "$status" -ne 0 ]; then
  # "  12 - Name (Failed)", but not the skipped ones.
  sed -n '/tests FAILED/,$ s/^[[:space:]]*\([0-9]*\) - .* (.*)$/\1/p' "$build/ctest.log" |
    while read -r number; do
      echo "repeat with: ctest --test-dir $build ${configuration[*]} --output-on-failure -I $number,$number"
    done
fi
exit "$status"
