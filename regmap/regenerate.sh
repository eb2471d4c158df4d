#!/bin/sh
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes regmap/generated/ anew after a change of a map (*.rdl) or a template. Only maintainers need it: the generated
# files are checked in. Installs the packages of generator/requirements.txt into its own virtual environment.
#
#   regmap/regenerate.sh [VENV_DIR]        default: build/regmap-venv, or $MB4_REGMAP_VENV
set -eu

here=$(cd "$(dirname "$0")" && pwd)
venv=${1:-${MB4_REGMAP_VENV:-$here/../build/regmap-venv}}

if [ ! -x "$venv/bin/python3" ]; then
  python3 -m venv "$venv" || { echo "no virtual environment; on Debian: apt install python3-venv" >&2; exit 1; }
fi
"$venv/bin/python3" -m pip install --quiet --requirement "$here/generator/requirements.txt"
"$venv/bin/python3" "$here/generator/generate.py"
"$venv/bin/python3" "$here/generator/generate.py" "$here/../tests/regmap/sample.rdl" \
  --out "$here/../tests/regmap/generated"
