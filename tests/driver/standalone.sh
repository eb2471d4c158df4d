#!/bin/sh
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Uses drivers/ without the rest of the build.
#
#   standalone.sh beside_regmap|copied_with_header|copied_without_header|headers_alone|one_header CMAKE ROOT
#
# The first two must configure and build a program against mb4::driver, the third must stop with a
# message that says what is missing. headers_alone copies only what drivers/README.md names for use
# without CMake, and compiles a program with it. one_header
# does so with the header that tools/one_header.py makes, in two units of a program that reads.

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

if [ "$case" = one_header ]; then
  mkdir "$work/include"
  "$root/tools/one_header.py" "$work/include/openmb4.hpp" mb4/words/snapshots.hpp mb4/ports/spidev.hpp || exit 1
  if grep -n '#include "' "$work/include/openmb4.hpp"; then
    echo "openmb4.hpp includes another header of the driver"
    exit 1
  fi
  cat > "$work/main.cpp" << END
#include "openmb4.hpp"
int position(mb4::Device<mb4::FunctionBus, mb4::FunctionClock>& device);
int main() {
  const auto fails = [](void*, const std::uint8_t*, std::uint8_t*, std::size_t) { return false; };
  mb4::FunctionBus bus(fails, nullptr);
  mb4::FunctionClock clock([](void*) -> std::uint32_t { return 0; }, nullptr);
  mb4::Device<mb4::FunctionBus, mb4::FunctionClock> device(bus, clock);
  return position(device) == static_cast<int>(mb4::Error::kNotConfigured) ? 0 : 1;
}
END
  cat > "$work/other.cpp" << END
#include "openmb4.hpp"
#include "openmb4.hpp"
int position(mb4::Device<mb4::FunctionBus, mb4::FunctionClock>& device) {
  static mb4::Operation operation;
  static std::array<std::uint8_t, 4> data;
  if (device.control().plan_read(operation, {1, 0}, 0x78, data)) return 0;
  return static_cast<int>(device.read_frame(1).error());
}
END
  "${CXX:-c++}" -std=c++17 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I "$work/include" \
    "$work/main.cpp" "$work/other.cpp" -o "$work/main" && "$work/main"
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
