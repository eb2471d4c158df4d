#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs the Debian 12 packages that are missing. Usage: tools/setup.sh [demo|test|python|web|site]
#   demo    what the build and the command line need (default)
#   test    that, and what the tests use besides
#   python  what `pip install tools/python` needs
#   web     what tools/web/build.sh and the test of its page need; a node that brings npm is kept
#   site    what tools/site/build.sh needs; it fetches Sphinx from PyPI
set -euo pipefail

demo_packages=(
  ca-certificates ccache cmake g++ libcli11-dev libfmt-dev libgtest-dev libtomlplusplus-dev
  ninja-build python3 verilator zlib1g-dev
)
test_packages=(
  clang ghdl git groff gtkwave libbenchmark-dev iverilog liblz4-dev librsvg2-bin pkg-config
  sigrok-cli spi-tools valgrind yosys z3 zsh
  clang-format clang-tidy gcovr
  gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib linux-libc-dev
  arduino-core-avr avr-libc gcc-avr gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf qemu-system-arm
  mypy python3-cffi python3-distributed python3-ipykernel python3-jsonschema python3-matplotlib python3-nbclient python3-numpy
  python3-pandas python3-pytest python3-tqdm python3-yaml
)
python_packages=(
  cmake g++ libcli11-dev libfmt-dev libtomlplusplus-dev ninja-build python3 python3-pip python3-venv verilator zlib1g-dev
)

web_packages=(
  ca-certificates ccache chromium chromium-driver cmake emscripten libfast-float-dev libfmt-dev
  libtomlplusplus-dev ninja-build nodejs python3 python3-cffi python3-numpy python3-pytest python3-selenium
  python3-tqdm verilator
)
# Other nodes than Debian's hold npm themselves, and Debian's npm does not go with them.
command -v npm >/dev/null || web_packages+=(npm)

site_packages=(ca-certificates python3 python3-venv)

case "${1:-demo}" in
  demo) packages=("${demo_packages[@]}") ;;
  test) packages=("${demo_packages[@]}" "${test_packages[@]}") ;;
  python) packages=("${python_packages[@]}") ;;
  web) packages=("${web_packages[@]}") ;;
  site) packages=("${site_packages[@]}") ;;
  *)
    echo "usage: tools/setup.sh [demo|test|python|web|site]" >&2
    exit 2
    ;;
esac

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
[ "${#missing[@]}" -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: these packages are missing and neither root nor sudo is at hand: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}" >&2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q >&2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -q --no-install-recommends "${missing[@]}" >&2
