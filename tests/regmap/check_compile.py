#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Compile the generated files of each map and compare the values in them with its JSON file.

The maps are those of regmap/ and sample.rdl, whose widths, names and kinds of access are others.

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
FOLDERS = [*sorted(f for f in GENERATED.iterdir() if f.is_dir()), HERE / "generated" / "sample"]
SKIPPED = 77
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]
CXX = ["-std=c++17", *STRICT, "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-fsyntax-only"]
ACCESS = {
    "rw": "kReadWrite", "ro": "kReadOnly", "wo": "kWriteOnly", "sc": "kSelfClearing", "w0c": "kWriteZeroClears",
    "w1c": "kWriteOneClears", "w1s": "kWriteOneSets", "rc": "kReadClears",
}  # fmt: skip
NOT_WRITTEN = ("ro", "rc", "rom")


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stdout + done.stderr


def named(regmap):
    """Fields of both meanings without the constants."""
    return [f for f in regmap["fields"] + regmap["alternate_fields"] if f["access"] != "rom"]


def place(f):
    """Number in the family from 1, and part of a word that several registers make up, or None."""
    return f["index"], f.get("part")


def headers(tool):
    for header in sorted(h for folder in FOLDERS for h in folder.glob("*.hpp")):
        good, text = run(tool, *CXX, "-x", "c++", "-include", header, "/dev/null")
        print(f"{header.name}: {'compiles alone' if good else text}")
        if not good:
            return False
    return True


def negative(tool):
    source = HERE / "regs_negative.cpp"
    cases = re.findall(r"MB4_CASE == (\d+)  // (?:error: )?(.+)", source.read_text(encoding="utf-8"))
    good = len(cases) > 1
    for number, expected in cases:
        compiled, text = run(tool, *CXX, f"-I{GENERATED / 'mb4'}", f"-DMB4_CASE={number}", source)
        right = compiled if number == "0" else not compiled and expected in text
        print(f"case {number}, {expected}: {'as expected' if right else 'WRONG ' + text}")
        good &= right
    return good


def cpp(regmap):
    lines = [
        f'#include "{regmap["prefix"]}_regs.hpp"', f'#include "{regmap["prefix"]}_regs_table.hpp"',
        f"using namespace {regmap['namespace']};",
        "template <typename F> constexpr bool is(unsigned a, unsigned l, unsigned w, Access c, unsigned r) {",
        "  return F::kAddress == a && F::kLsb == l && F::kWidth == w && F::kAccess == c && F::kReset == r; }",
        "constexpr bool same(const char* a, const char* b) {",
        "  for (; *a != 0 && *a == *b; ++a, ++b) {} return *a == *b; }",
        "constexpr bool row(const FieldInfo& f, const char* n, unsigned a, unsigned l, unsigned w, Access c, unsigned r) {",
        "  return same(f.name, n) && f.address == a && f.lsb == l && f.width == w && f.access == c && f.reset == r; }",
    ]  # fmt: skip
    for f in named(regmap):
        number, part = place(f)
        arguments = "" if number is None else f"<{number}>" if part is None else f"<{number}, {part}>"
        values = f"{f['address']}, {f['lsb']}, {f['width']}, Access::{ACCESS[f['access']]}, {f['reset']}"
        lines.append(f'static_assert(is<{f["ident"]}{arguments}>({values}), "{f["name"]}");')
    for array, key in (("kFields", "fields"), ("kAlternateFields", "alternate_fields")):
        fields = named({"fields": regmap[key], "alternate_fields": []})
        if key == "alternate_fields" and not fields:
            continue
        lines.append(f'static_assert({array}.size() == {len(fields)}, "{array}");')
        for i, f in enumerate(fields):
            values = f"{f['address']}, {f['lsb']}, {f['width']}, Access::{ACCESS[f['access']]}, {f['reset']}"
            lines.append(f'static_assert(row({array}[{i}], "{f["name"]}", {values}), "{f["name"]}");')
    return lines


def c99(regmap):
    lines = [f'#include "{regmap["prefix"]}_regs.h"']
    for n, f in enumerate(named(regmap)):
        name, (number, part) = f"{regmap['prefix']}_{f['ident']}".upper(), place(f)
        x = "" if number is None else f"({number}U)"
        mask = ((1 << f["width"]) - 1) << f["lsb"]
        if part is not None:
            test = f"{name}_ADDR({number}U, {part}U) == {f['address']}U"
        else:
            test = (
                f"{name}_ADDR{x} == {f['address']}U && {name}_SHIFT{x} == {f['lsb']}U"
                f" && {name}_MASK{x} == {mask}U && {name}_RESET == {f['reset']}U"
            )
        lines.append(f"typedef char check_{n}[({test}) ? 1 : -1]; /* {f['name']} */")
    return lines


def systemverilog(regmap):
    pkg, a_bits, v_bits = f"{regmap['prefix']}_regs_pkg::", regmap["address_width"], regmap["register_width"]
    lines = [f"module {TOP} (output logic ok_o);", "  assign ok_o = 1'b1;"]
    tests = []
    registers = {}
    for f in regmap["fields"]:
        registers.setdefault(f["address"], []).append(f)
    for f in named(regmap):
        name, (number, part) = pkg + f["ident"].upper(), place(f)
        if part is not None:
            place_of = f"{pkg}ADDR_{f['ident'].upper()} + {name}_STRIDE * {a_bits}'d{number - 1}"
            tests.append((f["name"], f"{place_of} + {a_bits}'d{part * (v_bits // 8)} != {a_bits}'d{f['address']}"))
            continue
        address, lsb = f"32'({name}_ADDR)", f"{name}_LSB"
        mask = ""
        if number is not None:
            address += f" + {name}_STRIDE * (32'd{number - 1} / {name}_PER_REG)"
            lsb += f" + {name}_LSB_STEP * (32'd{number - 1} % {name}_PER_REG)"
        else:
            mask = f" || ({name}_MASK != {v_bits}'d{((1 << f['width']) - 1) << f['lsb']})"
        tests.append((
            f["name"],
            f"({address} != 32'd{f['address']}) || ({lsb} != 32'd{f['lsb']})"
            f" || ({name}_W != 32'd{f['width']}) || ({name}_RESET != {f['width']}'d{f['reset']}){mask}",
        ))  # fmt: skip
    # Registers by the addresses that the package gives them.
    package = (regmap["folder"] / f"{regmap['prefix']}_regs_pkg.sv").read_text(encoding="utf-8")
    for name, value in re.findall(r"ADDR_(\w+) = \d+'h(\w+);", package):
        fields = registers.get(int(value, 16), [])
        if re.search(rf"RESET_{name} =", package) and fields:
            masks = [(f, ((1 << f["width"]) - 1) << f["lsb"]) for f in fields]
            values = {
                "RESET": sum(f["reset"] << f["lsb"] for f in fields),
                "WMASK": sum(mask for f, mask in masks if f["access"] not in NOT_WRITTEN),
                "CONST": sum(mask for f, mask in masks if f["access"] == "rom"),
            }
            tests.append((name, " || ".join(f"({pkg}{k}_{name} != {v_bits}'d{v})" for k, v in values.items())))
    for n, (name, test) in enumerate(tests):
        lines += [f"  if ({test}) begin : gen_bad_{n}", f'    $error("{name}");', "  end"]
    return lines + ["endmodule"]


def compare(write, command, suffix):
    """Assertions that hold for the map and fail for a map with one changed value."""

    def check_one(tool, regmap):
        spoiled = copy.deepcopy(regmap)
        wrong = [f for f in named(spoiled) if f.get("part") is None][-1]
        wrong["lsb"] += 1
        with tempfile.TemporaryDirectory() as scratch:
            source = Path(scratch) / f"{TOP}{suffix}"
            source.write_text("\n".join(write(regmap)) + "\n", encoding="utf-8")
            good, text = run(tool, *command(source, regmap))
            source.write_text("\n".join(write(spoiled)) + "\n", encoding="utf-8")
            failed, second = run(tool, *command(source, regmap))
        failed = not failed and wrong["name"] in second
        print(f"{regmap['prefix']}, {len(named(regmap))} fields: {'values agree' if good else text}")
        print(f"with a changed value: {'noticed' if failed else 'NOT NOTICED ' + second}")
        return good and failed

    def check(tool):
        for folder in FOLDERS:
            (source,) = folder.glob("*.json")
            regmap = json.loads(source.read_text(encoding="utf-8")) | {"folder": folder}
            if not check_one(tool, regmap):
                return False
        return True

    return check


def package(regmap):
    return regmap["folder"] / f"{regmap['prefix']}_regs_pkg.sv"


TOP = "regs_values"
CHECKS = {
    "headers": headers,
    "negative": negative,
    "cpp": compare(cpp, lambda source, regmap: [*CXX, f"-I{regmap['folder']}", source], ".cpp"),
    "c": compare(
        c99,
        lambda source, regmap: ["-std=c99", *STRICT, f"-I{regmap['folder']}", "-ffreestanding", "-fsyntax-only", source],
        ".c",
    ),
    "verilator": compare(
        systemverilog,
        lambda source, regmap: [
            "--lint-only", "-Wall", "-fno-const-bit-op-tree", "--top-module", TOP,
            package(regmap), source,
        ],
        ".sv",
    ),
    "yosys": compare(
        systemverilog,
        lambda source, regmap: ["-q", "-p", f"read_verilog -sv {package(regmap)} {source}; synth -top {TOP}; check -assert"],
        ".sv",
    ),
}  # fmt: skip


def main():
    check, tool = sys.argv[1:3]
    if shutil.which(tool) is None:
        print(f"skipped: no program for '{check}' (given: {tool})")
        return SKIPPED
    return 0 if CHECKS[check](tool) else 1


if __name__ == "__main__":
    sys.exit(main())
