#!/bin/sh
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Uses drivers/ without the rest of the build.
#
#   standalone.sh beside_regmap|copied_with_header|copied_without_header|headers_alone CMAKE ROOT
#
# The first two must configure and build a program against mb4::driver, the third must stop with a
# message that says what is missing. headers_alone copies only what drivers/README.md names for use
# without CMake, and compiles a program with it.

set -u
case=$1
cmake=$2
root=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat > "$work/main.cpp" << END
#include "mb4/mb4.hpp"
int main() { return mb4::validate(mb4::Config()).ok() ? 1 : 0; }
END

if [ "$case" = headers_alone ]; then
  sentence=$(sed -n '/^Or copy the folders/,/^$/p' "$root/drivers/README.md" | tr '\n' ' ')
  mkdir "$work/include"
  for part in $(echo "${sentence%% of *}" | grep -o '`[^`]*`' | tr -d '`'); do
    cp -r "$root/drivers/include/$part" "$work/include/"
  done
  cp "$root/regmap/generated/mb4/mb4_regs.hpp" "$work/include/"
  "${CXX:-c++}" -std=c++17 -Wall -Wextra -I "$work/include" "$work/main.cpp" -o "$work/main"
  exit
fi

case $case in
  beside_regmap)
    driver=$root/drivers
    ;;
  copied_*)
    driver=$work/copy
    cp -r "$root/drivers" "$driver"
    if [ "$case" = copied_with_header ]; then
      cp "$root/regmap/generated/mb4/mb4_regs.hpp" "$driver/include/"
    fi
    ;;
esac

mkdir "$work/app"
mv "$work/main.cpp" "$work/app/"
cat > "$work/app/CMakeLists.txt" << END
cmake_minimum_required(VERSION 3.25)
project(app LANGUAGES CXX)
add_subdirectory($driver driver)
add_executable(app main.cpp)
target_link_libraries(app PRIVATE mb4::driver)
END

if "$cmake" -G Ninja -S "$work/app" -B "$work/build" > "$work/log" 2>&1; then
  if [ "$case" = copied_without_header ]; then
    echo "configures without mb4_regs.hpp"
    exit 1
  fi
  "$cmake" --build "$work/build" || exit 1
else
  if [ "$case" != copied_without_header ] || ! grep -q "mb4_regs.hpp" "$work/log"; then
    cat "$work/log"
    exit 1
  fi
  grep -m 1 "mb4_regs.hpp" "$work/log"
fi
