#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Splits the rising edge of CLK into parts. Only those parts run whose inputs have changed.

  split_edge.py FOLDER BUSY_TXT OUTPUT [--count|--check]
     FOLDER    Verilator's output for mb4_chip
     BUSY_TXT  lists the fast variables, and how often each group of statements has work; a variable
               that the group writes is its name (find_busy.py). A wrong entry costs speed only
     OUTPUT    a header for direct_steps.hpp; it defines MB4_EDGE_NOT_SPLIT if this program does not
               understand the model
     --check   at some edges the model also computes the parts whose flags are not set; the program
               ends if one of them would change a variable
     --count   each group is a part and counts how often it runs; find_busy.py reads the counts

Verilator computes all logic of a clock at each of its edges. This program puts Verilator's
statements, unchanged, into groups: a register with the statements that write it. The order of the
groups keeps every dependency. A fast variable is one that changes at nearly every clock. A group
that writes one runs always. Other groups are put into bundles of two kinds:

* One flag controls the bundle. The flag is set when a variable that the bundle reads changes.
* If the bundle reads fast variables of a few bits, these are its key, and each value of the key has
  a flag. All flags are set when any other variable that the bundle reads changes. If the bundle
  computes a different result, the flags of the other values of the key are set. So while a flag is
  not set, the bundle would compute the present result with that value of the key.

If a variable is only compared with numbers, it counts as changed when the result of a comparison
changes."""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from generated_model import (NotUnderstood, constants, functions, places,  # noqa: E402
                             statements, triggers, widths)
from groups import Group, Kinds, Part, groups_of, parts_of  # noqa: E402
from header import PIN, PREFIX, ROOT, Writer  # noqa: E402
from self_check import check  # noqa: E402

CLOCKS = {"clk_i", "mb4_chip__DOT__clk"}
RELEASED = {f"mb4_chip__DOT__u_engine__DOT__{name}_core_n" for name in ("rst", "por")}
EDGES = {"rise": {"posedge clk_i", "posedge mb4_chip.clk"},
         "fall": {"negedge clk_i", "negedge mb4_chip.clk"}}


def started(bodies, names):
    """[(function, the events that start it)] in the order of eval_nba()."""
    calls = re.findall(rf"if \(([^{{]*)\) \{{\s*{ROOT}___(\w+)\(vlSelf\);", bodies["eval_nba"])
    return [(function, {event for k in re.findall(r"\.at\((\w+?)U\)", condition)
                        for event in names[int(k, 0)]})
            for condition, function in calls]


def behind(rows, names):
    """Those statements that depend on any of these variables, and the statements that they need."""
    taken = set()
    while True:
        size = len(taken)
        touched = set(names).union(*(rows[i].writes for i in taken))
        needed = {name for i in taken for name in rows[i].reads if "." in name}
        taken |= {i for i, row in enumerate(rows) if row.reads & touched or row.writes & needed}
        if len(taken) == size:
            return [rows[i] for i in sorted(taken)]


def by_host(functions_of, rows_of):
    """The variables that an edge of a host pin can change while no clock and no reset does."""
    clocks = EDGES["rise"] | EDGES["fall"]
    other = [row for function, events in functions_of for row in rows_of[function]
             if not (function.startswith("nba_sequent") and events & clocks)]
    first = {name for function, events in functions_of for row in rows_of[function]
             for name in row.writes if function.startswith("nba_sequent") and not events & clocks}
    rows = rows_of["ico_sequent__TOP__0"] + other
    pins = {name for many in rows_of.values() for row in many for name in row.reads
            if PIN.match(name)} - CLOCKS
    return pins | first | {name for row in behind(rows, pins | first) for name in row.writes}


def made(folder, busy, count, checked):
    bodies, names = functions(folder, PREFIX), triggers(folder, PREFIX)
    if not {"eval_nba", "ico_sequent__TOP__0"} <= bodies.keys():
        raise NotUnderstood("no functions of the model found")
    functions_of = started(bodies, names)
    # Verilator may split long functions or keep modules apart. Then the calls look different.
    if len(functions_of) != bodies["eval_nba"].count("___nba_") or \
            bodies.get("eval_ico", "").count("___ico_") != 1:
        raise NotUnderstood("calls in eval_nba() or eval_ico()")
    types, rows_of = {}, {}
    for function in ["ico_sequent__TOP__0", *(name for name, _ in functions_of)]:
        local, rows_of[function] = statements(function, bodies[function])
        types |= local
    rise, fall = ([row for function, events in functions_of if events & EDGES[kind]
                   for row in rows_of[function]] for kind in ("rise", "fall"))
    if not rise or not fall:
        raise NotUnderstood("no edges of CLK found")
    # No code looks for events after an edge of CLK. The core's resets may change, as they only end
    # there.
    watched = {event.split()[1].replace(".", "__DOT__") for events in names.values()
               for event in events}
    moved = {name for row in rise + fall for name in row.writes} & watched - RELEASED - CLOCKS
    if moved:
        raise NotUnderstood(f"an edge of CLK makes events: {sorted(moved)}")
    for row in rise:
        if (row.reads | row.writes) & CLOCKS or "__Vtrig" in row.text:
            raise NotUnderstood(f"depends on CLK itself: {row.text[:80]}")
    bits = widths(folder, PREFIX, bodies)
    parts, flags = parts_of(groups_of(rise), Kinds(busy, bits), count)
    behind_sl = Group(behind(rows_of["ico_sequent__TOP__0"], ["sl1_i", "sl2_i"]))
    arrays = {name for rows in rows_of.values() for row in rows for name in row.arrays}
    writer = Writer(types, bits, places(folder, PREFIX), constants(folder, PREFIX), arrays,
                    by_host(functions_of, rows_of), {
                        "rise": parts, "fall": [Part([Group(fall)])],
                        "follow_sl": [Part([behind_sl])]})
    return writer.header(flags, count, check(writer) if checked else ())


def main():
    arguments = [value for value in sys.argv[1:] if not value.startswith("--")]
    folder, listing, output = map(Path, arguments)
    busy = [] if "--count" in sys.argv else [
        line.split() for line in listing.read_text(encoding="utf-8").splitlines()
        if line and not line.startswith("#")]
    try:
        text = made(folder, busy, "--count" in sys.argv, "--check" in sys.argv)
    except Exception as error:  # another Verilator: files are missing, unreadable or different
        print("split_edge.py: the model runs whole, at a third of its speed: "
              f"{type(error).__name__}: {error}")
        text = "#define MB4_EDGE_NOT_SPLIT\n"
    output.write_text(text, encoding="utf-8")


main()
