#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Compile the generated files and compare the values in them with regmap/generated/mb4_regs.json.

  check_compile.py headers  COMPILER   each C++ header alone, freestanding, all warnings are errors
  check_compile.py negative COMPILER   the cases of regs_negative.cpp
  check_compile.py cpp      COMPILER   every field type and table entry against the map
  check_compile.py c        COMPILER   every macro against the map, C99
  check_compile.py verilator PROGRAM   lint of the package, every constant against the map
  check_compile.py yosys     PROGRAM   the same, read by Yosys

The comparisons are assertions written to a scratch file that the tool compiles or elaborates; each is repeated with
one value changed, which has to fail. Exit status 77: the tool is not there.
"""

import copy
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
GENERATED = HERE.parents[1] / "regmap" / "generated"
SKIPPED = 77
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", f"-I{GENERATED}"]
CXX = ["-std=c++17", *STRICT, "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-fsyntax-only"]
ACCESS = {"rw": "kReadWrite", "ro": "kReadOnly", "sc": "kSelfClearing", "w0c": "kWriteZeroClears"}


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stdout + done.stderr


def named(regmap):
    """Fields of both meanings without the constants."""
    return [f for f in regmap["fields"] + regmap["alternate_fields"] if f["access"] != "rom"]


def place(f):
    """Number in the family from 1, and byte within SCDATAx."""
    return f["index"], f["address"] % 8


def headers(tool, _):
    for header in sorted(GENERATED.glob("*.hpp")):
        good, text = run(tool, *CXX, "-x", "c++", "-include", header, "/dev/null")
        print(f"{header.name}: {'compiles alone' if good else text}")
        if not good:
            return False
    return True


def negative(tool, _):
    source = HERE / "regs_negative.cpp"
    cases = re.findall(r"MB4_CASE == (\d+)  // (?:error: )?(.+)", source.read_text(encoding="utf-8"))
    good = len(cases) > 1
    for number, expected in cases:
        compiled, text = run(tool, *CXX, f"-DMB4_CASE={number}", source)
        right = compiled if number == "0" else not compiled and expected in text
        print(f"case {number}, {expected}: {'as expected' if right else 'WRONG ' + text}")
        good &= right
    return good


def cpp(regmap):
    lines = [
        '#include "mb4_regs.hpp"', '#include "mb4_regs_table.hpp"', "using namespace mb4::regs;",
        "template <typename F> constexpr bool is(unsigned a, unsigned l, unsigned w, Access c, unsigned r) {",
        "  return F::kAddress == a && F::kLsb == l && F::kWidth == w && F::kAccess == c && F::kReset == r; }",
        "constexpr bool same(const char* a, const char* b) {",
        "  for (; *a != 0 && *a == *b; ++a, ++b) {} return *a == *b; }",
        "constexpr bool row(const FieldInfo& f, const char* n, unsigned a, unsigned l, unsigned w, Access c, unsigned r) {",
        "  return same(f.name, n) && f.address == a && f.lsb == l && f.width == w && f.access == c && f.reset == r; }",
    ]  # fmt: skip
    for f in named(regmap):
        number, byte = place(f)
        arguments = "" if number is None else f"<{number}, {byte}>" if f["ident"] == "SCDATA" else f"<{number}>"
        values = f"{f['address']}, {f['lsb']}, {f['width']}, Access::{ACCESS[f['access']]}, {f['reset']}"
        lines.append(f'static_assert(is<{f["ident"]}{arguments}>({values}), "{f["name"]}");')
    for array, key in (("kFields", "fields"), ("kAlternateFields", "alternate_fields")):
        fields = named({"fields": regmap[key], "alternate_fields": []})
        lines.append(f'static_assert({array}.size() == {len(fields)}, "{array}");')
        for i, f in enumerate(fields):
            values = f"{f['address']}, {f['lsb']}, {f['width']}, Access::{ACCESS[f['access']]}, {f['reset']}"
            lines.append(f'static_assert(row({array}[{i}], "{f["name"]}", {values}), "{f["name"]}");')
    return lines


def c99(regmap):
    lines = ['#include "mb4_regs.h"']
    for n, f in enumerate(named(regmap)):
        name, (number, byte) = "MB4_" + f["ident"].upper(), place(f)
        x = "" if number is None else f"({number}U)"
        mask = ((1 << f["width"]) - 1) << f["lsb"]
        if f["ident"] == "SCDATA":
            test = f"{name}_ADDR({number}U, {byte}U) == {f['address']}U"
        else:
            test = (
                f"{name}_ADDR{x} == {f['address']}U && {name}_SHIFT{x} == {f['lsb']}U"
                f" && {name}_MASK{x} == {mask}U && {name}_RESET == {f['reset']}U"
            )
        lines.append(f"typedef char check_{n}[({test}) ? 1 : -1]; /* {f['name']} */")
    return lines


def systemverilog(regmap):
    lines = ["module mb4_regs_values (output logic ok_o);", "  assign ok_o = 1'b1;"]
    tests = []
    registers = {}
    for f in regmap["fields"]:
        registers.setdefault(f["address"], []).append(f)
    for f in named(regmap):
        name, (number, byte) = "mb4_regs_pkg::" + f["ident"].upper(), place(f)
        if f["ident"] == "SCDATA":
            place_of = "mb4_regs_pkg::ADDR_SCDATA + mb4_regs_pkg::SCDATA_STRIDE"
            tests.append((f["name"], f"({place_of} * 8'd{number - 1}) + 8'd{byte} != 8'd{f['address']}"))
            continue
        address, lsb = f"32'({name}_ADDR)", f"{name}_LSB"
        if number is not None:
            address += f" + {name}_STRIDE * (32'd{number - 1} / {name}_PER_REG)"
            lsb += f" + {name}_LSB_STEP * (32'd{number - 1} % {name}_PER_REG)"
        tests.append((
            f["name"],
            f"({address} != 32'd{f['address']}) || ({lsb} != 32'd{f['lsb']})"
            f" || ({name}_W != 32'd{f['width']}) || ({name}_RESET != {f['width']}'d{f['reset']})",
        ))  # fmt: skip
    # Registers by the addresses that the package gives them.
    package = (GENERATED / "mb4_regs_pkg.sv").read_text(encoding="utf-8")
    for name, value in re.findall(r"ADDR_(\w+) = 8'h(..);", package):
        fields = registers.get(int(value, 16), [])
        if re.search(rf"RESET_{name} =", package) and fields:
            reset = sum(f["reset"] << f["lsb"] for f in fields)
            wmask = sum(((1 << f["width"]) - 1) << f["lsb"] for f in fields if f["access"] not in ("ro", "rom"))
            pkg = "mb4_regs_pkg::"
            tests.append((name, f"({pkg}RESET_{name} != 8'd{reset}) || ({pkg}WMASK_{name} != 8'd{wmask})"))
    for n, (name, test) in enumerate(tests):
        lines += [f"  if ({test}) begin : gen_bad_{n}", f'    $error("{name}");', "  end"]
    return lines + ["endmodule"]


def compare(write, command, suffix):
    """Assertions that hold for the map and fail for a map with one changed value."""

    def check(tool, regmap):
        spoiled = copy.deepcopy(regmap)
        next(f for f in spoiled["fields"] if f["name"] == "SCDLEN3")["lsb"] += 1
        with tempfile.TemporaryDirectory() as scratch:
            source = Path(scratch) / f"mb4_regs_values{suffix}"
            source.write_text("\n".join(write(regmap)) + "\n", encoding="utf-8")
            good, text = run(tool, *command(source))
            source.write_text("\n".join(write(spoiled)) + "\n", encoding="utf-8")
            failed, second = run(tool, *command(source))
        failed = not failed and "SCDLEN3" in second
        print(f"{len(named(regmap))} fields: {'values agree' if good else text}")
        print(f"with a changed value: {'noticed' if failed else 'NOT NOTICED ' + second}")
        return good and failed

    return check


PACKAGE = GENERATED / "mb4_regs_pkg.sv"
CHECKS = {
    "headers": headers,
    "negative": negative,
    "cpp": compare(cpp, lambda source: [*CXX, source], ".cpp"),
    "c": compare(c99, lambda source: ["-std=c99", *STRICT, "-ffreestanding", "-fsyntax-only", source], ".c"),
    "verilator": compare(
        systemverilog,
        lambda source: ["--lint-only", "-Wall", "-fno-const-bit-op-tree", "--top-module", "mb4_regs_values", PACKAGE, source],
        ".sv",
    ),
    "yosys": compare(
        systemverilog,
        lambda source: ["-q", "-p", f"read_verilog -sv {PACKAGE} {source}; synth -top mb4_regs_values; check -assert"],
        ".sv",
    ),
}  # fmt: skip


def main():
    check, tool = sys.argv[1:3]
    if shutil.which(tool) is None:
        print(f"skipped: no program for '{check}' (given: {tool})")
        return SKIPPED
    regmap = json.loads((GENERATED / "mb4_regs.json").read_text(encoding="utf-8"))
    return 0 if CHECKS[check](tool, regmap) else 1


if __name__ == "__main__":
    sys.exit(main())
