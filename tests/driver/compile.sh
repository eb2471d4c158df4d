#!/bin/sh
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Compiles driver code the way drive firmware does.
#
#   compile.sh accept COMPILER FILE FLAGS...           FILE must compile without a warning
#   compile.sh as_cpp COMPILER FILE FLAGS...           FILE in C must compile as C++ without a warning
#   compile.sh reject COMPILER FILE MESSAGE FLAGS...   FILE must fail and print MESSAGE
#   compile.sh one_error COMPILER HEADERS MESSAGE FLAGS...   all HEADERS as C++14 must give one error, MESSAGE
#   compile.sh readme COMPILER FILE FLAGS...           cpp blocks of a Markdown file must build
#
# FLAGS are the include options. Exit status 77: the compiler is missing.

set -u
mode=$1
compiler=$2
file=$3
shift 3

if ! command -v "$compiler" > /dev/null 2>&1; then
  echo "skipped: $compiler is not installed"
  exit 77
fi

strict="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
freestanding="-std=c++17 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics"
case $file in
  *.c) freestanding="-x c -std=c99 -ffreestanding" ;;
esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

case $mode in
  accept)
    # Twice: the include guard has to hold as well.
    printf '#include "%s"\n#include "%s"\n' "$file" "$file" > "$work/unit.cpp"
    case $file in *.c) cp "$file" "$work/unit.cpp" ;; esac
    "$compiler" $freestanding $strict "$@" -c "$work/unit.cpp" -o "$work/unit.o" || exit 1
    # GCC folds masks less with sanitizers, and then warns where it did not.
    case $compiler in
      gcc | g++) "$compiler" $freestanding $strict -fsanitize=undefined "$@" -fsyntax-only "$work/unit.cpp" ;;
    esac
    ;;
  as_cpp)
    "$compiler" -x c++ -std=c++17 -ffreestanding $strict "$@" -c "$file" -o "$work/unit.o"
    ;;
  reject)
    message=$1
    shift
    if "$compiler" $freestanding $strict "$@" -c "$file" -o "$work/unit.o" 2> "$work/log"; then
      echo "$file compiles, but must not"
      exit 1
    fi
    if ! grep -q -e "$message" "$work/log"; then
      echo "$file is rejected, but without the message '$message':"
      cat "$work/log"
      exit 1
    fi
    grep -m 1 -e "$message" "$work/log"
    ;;
  one_error)
    message=$1
    shift
    for header in $file; do
      printf '#include "%s"\n' "$header" >> "$work/unit.cpp"
    done
    "$compiler" -std=c++14 $strict "$@" -fsyntax-only "$work/unit.cpp" 2> "$work/log"
    if [ "$(grep -cE ': (fatal )?error:' "$work/log")" != 1 ] || ! grep -q "error: .*$message" "$work/log"; then
      echo "not the one error '$message', but:"
      cat "$work/log"
      exit 1
    fi
    grep -m 1 "$message" "$work/log"
    ;;
  readme)
    awk '/^```cpp$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$file" > "$work/unit.cpp"
    if ! [ -s "$work/unit.cpp" ]; then
      echo "$file has no cpp block"
      exit 1
    fi
    # An application, not firmware: hosted, but with the same warnings.
    "$compiler" -std=c++17 $strict "$@" "$work/unit.cpp" -o "$work/unit"
    ;;
  *)
    echo "unknown mode $mode"
    exit 2
    ;;
esac
