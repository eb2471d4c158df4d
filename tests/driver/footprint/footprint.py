#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Builds driver code for a microcontroller, prints what it takes, compares with budget.toml.

  footprint.py TARGET PROGRAM INCLUDE_DIR...     TARGET: cortex-m0plus cortex-m4 rv32imc
                                                 PROGRAM: cyclic position single steps safety whole
  footprint.py self-test                         the checks of stack and budget can fail

Rejects every symbol that a driver without heap, exceptions and static constructors cannot need.
Exit status 77: compiler or its C++ headers are missing.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
SKIPPED = 77
TARGETS = {
    "cortex-m0plus": ("arm-none-eabi-", ["-mcpu=cortex-m0plus", "-mthumb"], "--specs=nano.specs"),
    "cortex-m4": ("arm-none-eabi-", ["-mcpu=cortex-m4", "-mthumb"], "--specs=nano.specs"),
    "rv32imc": ("riscv64-unknown-elf-", ["-march=rv32imc", "-mabi=ilp32", "-msave-restore"],
                "--specs=picolibc.specs"),
}
FLAGS = ("-std=c++17 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -Os "
         "-ffunction-sections -fdata-sections -fcallgraph-info=su "
         "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror").split()
CPP_FLAGS = ("-std=c++17", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics")
FORBIDDEN = re.compile(r"malloc|calloc|realloc| free$|_Znw|_Zna|_Zdl|_Zda|"
                       r"__cxa_|__aeabi_atexit|_Unwind|_GLOBAL__sub_I|__gxx_")


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def run(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{done.stderr}{' '.join(map(str, command))}: exit {done.returncode}")
    return done.stdout


def library_headers(prefix):
    """Debian has no C++ library for riscv64-unknown-elf. The headers of the same GCC version for ARM
    are the same files; what the driver uses of them needs no library."""
    if prefix.startswith("arm"):
        return []
    if not shutil.which("arm-none-eabi-g++"):
        skip("the C++ headers come with arm-none-eabi-g++, which is not installed")
    listing = subprocess.run(["arm-none-eabi-g++", "-E", "-v", "-x", "c++", "/dev/null"],
                             capture_output=True, text=True).stderr
    folders = [line.strip() for line in listing.splitlines()
               if line.startswith(" /") and "/c++/" in line]
    return [part for folder in folders for part in ("-isystem", folder)]


def call_graph(text):
    """(stack of each function, callees of each function) from GCC's -fcallgraph-info=su."""
    stack, calls = {}, {}
    for name, label in re.findall(r'node: \{ title: "([^"]*)" label: "([^"]*)"', text):
        size = re.search(r"(\d+) bytes \((\w+)", label)
        stack[name] = int(size.group(1)) if size else None  # None: from outside
        if size and size.group(2) == "dynamic":
            raise ValueError(f"{name}: stack size is not known")
    for caller, callee in re.findall(
            r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"', text):
        calls.setdefault(caller, set()).add(callee)
    return stack, calls


def deepest(stack, calls, entry):
    """(bytes, chain) of the deepest call chain; functions from outside count as 0."""
    known = {}
    # A call through a pointer may reach any function that nobody calls by name.
    named = set().union(*calls.values())
    if "__indirect_call" in named:
        calls["__indirect_call"] = {name for name, size in stack.items()
                                    if size is not None and name not in named | {entry}}

    def depth(name, above):
        if name in above:
            raise ValueError(f"recursion through {name}")
        if name not in known:
            below = [depth(callee, above | {name}) for callee in calls.get(name, ())]
            size, chain = max(below, key=lambda item: item[0], default=(0, []))
            known[name] = ((stack.get(name) or 0) + size, [name] + chain)
        return known[name]

    return depth(entry, frozenset())


def over(budget, figures):
    return [f"{what}: {figures[what]} bytes, more than the budget of {limit}"
            for what, limit in budget.items() if figures[what] > limit]


PROGRAMS = {"cyclic": "read path in C99", "position": "position read path", "single": "one encoder, single frames",
            "steps": "everything in steps", "safety": "BiSS Safety and a snapshot",
            "whole": "everything", "second": "a second type of bus"}


def manual(target, program):
    """(flash, stack on M0+ or None) of docs/driver.md."""
    text = (HERE.parents[2] / "docs" / "driver.md").read_text()
    cells = re.search(rf"^\| {PROGRAMS[program]} \|(.*)\|$", text, re.M).group(1).split("|")
    column = list(TARGETS).index(target)
    stack = cells[3].strip()
    return int(cells[column]), int(stack) if column == 0 and stack != "-" else None


def sizes(prefix, path):
    fields = run([prefix + "size", path]).splitlines()[1].split()
    return [int(field) for field in fields[:3]]


def second_bus(symbols):
    """Bytes of the functions that are there for OtherBus, without those of the program."""
    sized = [line.split() for line in symbols.splitlines() if "8OtherBus" in line]
    return sum(int(fields[1], 16) for fields in sized
               if len(fields) == 4 and not re.search(r"(call|plan)_all", fields[3]))


def measure(target, program, includes):
    prefix, cpu, specs = TARGETS[target]
    if not shutil.which(prefix + "g++"):
        skip(f"{prefix}g++ is not installed")
    base = [prefix + "g++", *cpu, specs, *library_headers(prefix)]
    probe = subprocess.run([*base, "-std=c++17", "-ffreestanding", "-x", "c++", "-fsyntax-only",
                            "-"], input="#include <array>\n", capture_output=True, text=True)
    if probe.returncode != 0:
        skip(f"C or C++ headers of {prefix}g++ are missing")
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        for unit in (program, "board"):
            source = HERE / f"{unit}.cpp"
            language = [*base, *FLAGS]
            if not source.exists():
                source = source.with_suffix(".c")
                language = [prefix + "gcc", *cpu, specs, "-std=c99",
                            *[flag for flag in FLAGS if flag not in CPP_FLAGS]]
            run([*language, *[f"-I{path}" for path in includes], "-c", source, "-o",
                 work / f"{unit}.o"])
        elf = work / "unit.elf"
        # Without start files and C++ runtime: all but libgcc arithmetic and memcpy is the driver's.
        run([prefix + "gcc", *cpu, specs, "-nostartfiles", "-Wl,--gc-sections", "-Wl,-e,firmware",
             "-Wl,--undefined=firmware", "-Wl,--undefined=firmware_open",
             "-Wl,--undefined=firmware_other", work / f"{program}.o", work / "board.o", "-o", elf])
        symbols = run([prefix + "nm", work / f"{program}.o", elf])
        object_data = sizes(prefix, work / f"{program}.o")[1:]
        board = run([prefix + "nm", "-S", elf])
        board_bytes = sum(int(line.split()[1], 16) for line in board.splitlines()
                          if re.search(r" [Tt] board_", line))
        text = sizes(prefix, elf)[0] - board_bytes
        if program == "second":
            text = second_bus(board)
        stack, chain = deepest(*call_graph((work / f"{program}.ci").read_text()), "firmware")
    bad = [line for line in symbols.splitlines() if FORBIDDEN.search(line)]
    figures = {"flash": text, "ram": sum(object_data), "stack": stack}
    print(f"{target} {program}: flash {figures['flash']} bytes, static RAM {figures['ram']}, "
          f"stack {figures['stack']}")
    shown = [re.sub(r".*/(\w+\.hpp):", r"\1:", name) for name in chain]
    print("deepest call chain: " + " > ".join(name.split(":")[-1] for name in shown))
    budget = tomllib.loads((HERE / "budget.toml").read_text())[program][target]
    findings = [f"forbidden symbol: {line}" for line in bad] + over(budget, figures)
    flash, depth = manual(target, program)
    if abs(flash - figures["flash"]) > 64 or abs((depth or stack) - stack) > 64:
        findings.append(f"docs/driver.md says flash {flash}, stack {depth}: more than 64 bytes off")
    for finding in findings:
        print(finding)
    return 1 if findings else 0


def self_test():
    graph = ('node: { title: "a" label: "a\\nx.cpp:1\\n16 bytes (static)" }\n'
             'node: { title: "b" label: "b\\nx.cpp:2\\n40 bytes (static)" }\n'
             'node: { title: "c" label: "c\\nx.cpp:3\\n8 bytes (static)" }\n'
             'node: { title: "memcpy" label: "memcpy" shape : ellipse }\n'
             'edge: { sourcename: "a" targetname: "b" }\nedge: { sourcename: "a" targetname: "c" }\n'
             'edge: { sourcename: "c" targetname: "memcpy" }\n')
    assert deepest(*call_graph(graph), "a") == (56, ["a", "b"])
    try:
        deepest(*call_graph(graph + 'edge: { sourcename: "b" targetname: "a" }\n'), "a")
        raise AssertionError("recursion was not noticed")
    except ValueError:
        pass
    pointer = graph + ('node: { title: "d" label: "d\\nx.cpp:4\\n100 bytes (static)" }\n'
                       'edge: { sourcename: "b" targetname: "__indirect_call" }\n')
    assert deepest(*call_graph(pointer), "a") == (156, ["a", "b", "__indirect_call", "d"])
    assert second_bus("0 00000010 T _ZN8OtherBus1fEv\n0 00000100 T _Z8call_allI8OtherBusEv\n"
                      "0 00000001 T _ZN8BoardBus1fEv\n") == 16
    assert over({"flash": 10, "ram": 0}, {"flash": 11, "ram": 0}) != []
    assert over({"flash": 10, "ram": 0}, {"flash": 10, "ram": 0}) == []
    assert FORBIDDEN.search("00000000 T _Znwj") and not FORBIDDEN.search("00000000 T firmware")
    print("stack, budget and symbol checks can fail")


if __name__ == "__main__":
    if sys.argv[1:] == ["self-test"]:
        self_test()
        sys.exit(0)
    if len(sys.argv) < 3 or sys.argv[1] not in TARGETS:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    sys.exit(measure(sys.argv[1], sys.argv[2], sys.argv[3:]))
