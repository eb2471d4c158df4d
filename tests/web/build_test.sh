#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the page and checks its size: build_test.sh FOLDER. Exit status 77: a tool or npm's package
# is missing.
set -euo pipefail

for tool in emcmake ninja npm; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool: tools/setup.sh web"; exit 77; }
done
[ -e /usr/include/fast_float ] || { echo "skipped: no libfast-float-dev: tools/setup.sh web"; exit 77; }
most=$((3 * 1000 * 1000))
status=0
"$(dirname "$0")/../../tools/web/build.sh" "$1" || status=$?
[ "$status" -ne 3 ] || { echo "skipped: npm cannot fetch the page's package"; exit 77; }
[ "$status" -eq 0 ] || exit "$status"
size=$(stat -c %s "$1/openmb4.html")
[ "$size" -lt "$most" ] || { echo "the page has $size bytes, at most $most are wanted" >&2; exit 1; }
