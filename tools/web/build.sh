#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the page build/web/openmb4.html and prints its size. Usage: tools/web/build.sh [FOLDER]
# `tools/setup.sh web` installs what it needs. The first build takes minutes. Exit status 3: npm
# cannot fetch the package that the page needs.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${1:-$root/build/web}
for tool in emcmake cmake ninja npm python3; do
  command -v "$tool" >/dev/null || { echo "web: $tool is missing: tools/setup.sh web" >&2; exit 1; }
done
mkdir -p "$folder"

# Debian's emscripten uses acorn of Debian's node; another node looks for it in NODE_PATH only.
export NODE_PATH=/usr/share/nodejs${NODE_PATH:+:$NODE_PATH}
if [ ! -f "$folder/build.ninja" ]; then
  emcmake cmake -S "$root" -B "$folder" -G Ninja -Wno-dev -DCMAKE_BUILD_TYPE=Release \
    -DMB4_WERROR=OFF >"$folder/configure.log" 2>&1 ||
    { cat "$folder/configure.log" >&2; exit 1; }
fi
cmake --build "$folder" --target openmb4_web -- --quiet

if ! cmp -s "$root/tools/web/package-lock.json" "$folder/package-lock.json"; then
  cp "$root/tools/web/package.json" "$folder/"
  (cd "$folder" && cp "$root/tools/web/package-lock.json" new-lock.json &&
    mv new-lock.json package-lock.json &&
    npm ci --ignore-scripts --no-audit --no-fund --loglevel=error) >&2 ||
    { rm -f "$folder/package-lock.json"
      echo "web: npm cannot fetch what tools/web/package-lock.json names" >&2; exit 3; }
fi
python3 -B "$root/tools/web/page.py" "$folder/bin/openmb4.js" "$folder/bin/openmb4.wasm" \
  "$folder/node_modules/uplot" "$folder/openmb4.html"
