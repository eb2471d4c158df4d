# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a C++ header that lists the pins and registers of a Verilated model for SignalWave.

Usage: signal_list.py NAMES HEADER OUTPUT SOURCE...
HEADER is PREFIX___024root.h of the model, SOURCE... its RTL. NAMES is a TOML file:

  [pins]   port = "its name in the waveform"; a name that ends in "*" gets the number of the bit, and
           each bit is a signal of its own. Ports that are not named are left out.

Registers are the variables whose names end in _q. A register with a struct type is listed by its
members, one with an enum type with the names of its values. Registers of checks, of synchronisers and
of memories are left out. The program fails if a port that NAMES names is not there."""

import re
import sys
import tomllib
from pathlib import Path

VARIABLE = re.compile(
    r"^\s+(?:VL_(?:IN|OUT)(?:8|16|64|W)?\((?P<pin>\w+),(?P<high>\d+),(?P<low>\d+)(?:,\d+)?\)"
    r"|(?:CData|SData|IData|QData|VlWide<\d+>)/\*(?P<msb>\d+):0\*/ (?P<name>\w+));", re.M)
CHECK = re.compile(r"_A_\w*_q$|sync_q$")
FEWEST = 20  # registers of any model


def plain(text):
    return re.sub(r"//[^\n]*", "", text)


def variables(header):
    """{name: bits}; ports and registers."""
    found = {}
    for one in VARIABLE.finditer(header):
        if one["pin"]:
            found[one["pin"]] = int(one["high"]) - int(one["low"]) + 1
        else:
            found[one["name"]] = int(one["msb"]) + 1
    return found


def literal(text):
    """The value of 3'd5 or 2'b10, or None."""
    match = re.fullmatch(r"\s*(?:\d+'([bd]))?(\d+)\s*", text)
    return int(match[2], 2 if match[1] == "b" else 10) if match else None


class Sources:
    """Instances, enums and packed structs of the RTL."""

    def __init__(self, paths):
        self.instances = {}   # (module, instance): module
        self.registers = {}   # (module, register): type
        self.enums = {}       # (module or package, type): names of the values
        self.structs = {}     # package::type: [(member, bits)], the highest first
        for path in paths:
            text = plain(Path(path).read_text(encoding="utf-8"))
            name = Path(path).stem
            for body, kind in re.findall(r"typedef struct packed \{([^}]*)\}\s*(\w+);", text):
                members, whole = [], 0
                for high, inner, member in re.findall(r"(?:logic\s*(?:\[(\d+):0\])?|(\w+_t))\s*(\w+);", body):
                    parts = self.structs.get(f"{name}::{inner}", []) if inner else [("", 1 + int(high or 0))]
                    members += [(f"{member}.{part}" if part else member, width) for part, width in parts]
                    whole += bool(parts)
                if whole == body.count(";"):
                    self.structs[f"{name}::{kind}"] = members
            for body, kind in re.findall(r"typedef enum logic[^{]*\{([^}]*)\}\s*(\w+);", text):
                items = [item.split("=") for item in body.split(",")]
                # Values in order from 0 on, or written as such.
                if all(len(item) == 1 or literal(item[1]) == number for number, item in enumerate(items)):
                    self.enums[name, kind] = [item[0].strip() for item in items]
            for kind, instance in re.findall(
                    r"\b(\w+)\s+(?:#\s*\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)\s*)?(u_\w+)\s*\(",
                    text):
                self.instances[name, instance] = kind
            for kind, names in re.findall(
                    r"^\s*((?:\w+::)?\w+_[te])\s+(\w+(?:\s*,\s*\w+)*);", text, re.M):
                for register in names.split(","):
                    self.registers[name, register.strip()] = kind

    def type_of(self, path):
        """(module, type) of a register, the type None if it is a plain vector."""
        module = path[0]
        for step in path[1:-1]:
            module = self.instances.get((module, step), module)
        return module, self.registers.get((module, path[-1]))


def fields(sources, path, bits):
    """[(name behind the path, lowest bit, bits, names of values)] of a register."""
    module, kind = sources.type_of(path)
    if kind is None:
        return [("", 0, bits, ())]
    package, _, local = kind.rpartition("::")
    names = sources.enums.get((package or module, local))
    if names:
        return [("", 0, bits, names)]
    members = sources.structs.get(kind if package else f"{module}::{kind}", [])
    if sum(width for _, width in members) != bits:
        return [("", 0, bits, ())]
    found, low = [], bits
    for member, width in members:
        low -= width
        found.append((f".{member}", low, width, ()))
    return found


def natural(path):
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", path)]


def signals(names, header, sources):
    """[(path, variable, lowest bit, bits, names of values)], pins first."""
    found = []
    known = variables(header)
    for port, name in names["pins"].items():
        if port not in known:
            raise SystemExit(f"signal_list.py: the model has no port '{port}'")
        if name.endswith("*"):
            found += [(f"{name[:-1]}{bit}", port, bit, 1, ()) for bit in range(known[port])]
        else:
            found.append((name, port, 0, known[port], ()))
    registers = []
    for name, bits in known.items():
        if not name.endswith("_q") or CHECK.search(name) or "__V" in name:
            continue
        path = re.sub(r"__BRA__(\d+)__KET__", r"[\1]", name).split("__DOT__")
        for end, low, width, values in fields(sources, path, bits):
            registers.append((".".join(path[1:]) + end, name, low, width, values))
    if len(registers) < FEWEST:
        raise SystemExit("signal_list.py: the header is written in an unknown form")
    return found + sorted(registers, key=lambda row: natural(row[0]))


def main(names, header, output, *paths):
    rows = signals(tomllib.loads(Path(names).read_text(encoding="utf-8")),
                   Path(header).read_text(encoding="utf-8"), Sources(paths))
    root = Path(header).name.removesuffix(".h")
    lines = ["// Made by signal_list.py.", f"#include <{root}.h>", "",
             '#include "sim/model/signal_wave.hpp"', "",
             f"inline std::vector<mb4::sim::WaveSignal> wave_signals(const {root}& root) {{",
             "  return {"]
    lines += [f'      {{"{path}", &root.{name}, sizeof root.{name}, {low}, {bits}, '
              f'"{" ".join(values)}"}},' for path, name, low, bits, values in rows]
    lines += ["  };", "}", ""]
    Path(output).write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 5:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
