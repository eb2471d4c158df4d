#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the documentation site build/site/html from README.md and docs, and prints its size.
# Usage: tools/site/build.sh [FOLDER [CHIP_PAGE]]. `tools/setup.sh site` installs what it needs; the
# first build fetches Sphinx from PyPI into FOLDER/venv. CHIP_PAGE is the page of tools/web/build.sh,
# build/web/openmb4.html if it is there; the site then holds it. Exit status 3: PyPI cannot be
# reached.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/tools/site
folder=${1:-$root/build/site}
chip=${2:-$root/build/web/openmb4.html}
python=/usr/bin/python3
[ -x "$python" ] || python=python3
"$python" -c "import ensurepip, venv" 2>/dev/null ||
  { echo "site: python3-venv is missing: tools/setup.sh site" >&2; exit 1; }
mkdir -p "$folder"

if ! cmp -s "$here/requirements.txt" "$folder/requirements.txt"; then
  rm -rf "$folder/venv"
  "$python" -m venv "$folder/venv"
  "$folder/venv/bin/pip" install --quiet --disable-pip-version-check -r "$here/requirements.txt" >&2 ||
    { echo "site: pip cannot fetch what tools/site/requirements.txt names" >&2; exit 3; }
  cp "$here/requirements.txt" "$folder/requirements.txt"
fi

[ -f "$chip" ] || chip=
"$folder/venv/bin/python" -B "$here/pages.py" "$root" "$folder" ${chip:+"$chip"}
rm -rf "$folder/html"
PYTHONDONTWRITEBYTECODE=1 "$folder/venv/bin/sphinx-build" --quiet --fail-on-warning --keep-going \
  -c "$here" -d "$folder/doctrees" "$folder/source" "$folder/html"
[ ! -d "$folder/text" ] || cp -r "$folder/text" "$folder/html/files"
# The chip's page shows a link to the documents where its root element names them.
[ -z "$chip" ] || sed 's|<html lang="en">|<html lang="en" data-documents="docs/README.html">|' "$chip" \
  >"$folder/html/chip.html"
pages=$(find "$folder/html" -name '*.html' | wc -l)
echo "$folder/html: $pages pages, $(du -sk "$folder/html" | cut -f1) kB"
