# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a C++ header that copies the state of the model without tracing into the model with it.

Usage: traced_state.py PLAIN_HEADER TRACED_HEADER OUTPUT
PLAIN_HEADER and TRACED_HEADER are PREFIX___024root.h of the two Verilated models. A variable of the
traced model has the same name in the plain one, without the name of the traced model's top. What
has no partner there is a value that the model computes from others. Flops (their names end in _q)
and memories are no such values: the program fails if one of them has no partner."""

import re
import sys
from pathlib import Path

PLAIN_TOP = "mb4_chip__DOT__"
TRACED_TOP = "mb4sim_trace_top__DOT__u_chip__DOT__"
VARIABLE = re.compile(
    r"^\s+(?:VL_(?:IN|OUT)(?:8|16|64|W)?\((?P<pin>\w+),(?P<range>\d+,\d+)(?:,\d+)?\)"
    r"|(?P<type>(?:CData|SData|IData|QData|VlWide<\d+>)/\*\d+:\d+\*/|VlUnpacked<[^;]*>)"
    r" (?P<name>\w+));", re.M)
STATE = re.compile(r"^(?!__V).*(?:_q|__DOT__mem)$")


def variables(path):
    """{name: type} of a model."""
    text = Path(path).read_text(encoding="utf-8")
    return {found["pin"] or found["name"]: found["range"] or found["type"].replace(" ", "")
            for found in VARIABLE.finditer(text)}


def prefix(path):
    return Path(path).name.removesuffix("___024root.h")


def pairs(plain, traced):
    """[(name in the plain model, name in the traced one)] of all variables that both have."""
    found = []
    for other, kind in traced.items():
        name = other.replace(TRACED_TOP, PLAIN_TOP)
        if plain.get(name) == kind:
            found.append((name, other))
        elif STATE.search(name):
            raise SystemExit(f"traced_state.py: '{other}' has no partner in the plain model")
    return found


def main(plain_path, traced_path, output):
    rows = pairs(variables(plain_path), variables(traced_path))
    if sum(1 for name, _ in rows if STATE.search(name)) < 100:
        raise SystemExit(f"traced_state.py: '{plain_path}' is written in an unknown form")
    body = "".join(f"  to.{other} = from.{name};\n" for name, other in rows)
    Path(output).write_text(
        "// Made by traced_state.py.\n"
        f"#include <{prefix(plain_path)}___024root.h>\n#include <{prefix(traced_path)}___024root.h>\n\n"
        f"inline void copy_state(const {prefix(plain_path)}___024root& from,\n"
        f"                            {prefix(traced_path)}___024root& to) {{\n{body}}}\n",
        encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
