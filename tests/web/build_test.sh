#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the page and checks its size: build_test.sh FOLDER. Exit status 77: a tool is missing.
set -euo pipefail

for tool in emcmake ninja npm; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool: tools/setup.sh web"; exit 77; }
done
most=$((3 * 1000 * 1000))
"$(dirname "$0")/../../tools/web/build.sh" "$1"
size=$(stat -c %s "$1/openmb4.html")
[ "$size" -lt "$most" ] || { echo "the page has $size bytes, at most $most are wanted" >&2; exit 1; }
