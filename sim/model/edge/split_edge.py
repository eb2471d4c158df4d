#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The rising edge of CLK in parts, of which only those run whose inputs have changed.

  split_edge.py FOLDER BUSY_TXT OUTPUT [--count|--check]
     FOLDER    what Verilator has made of mb4_chip
     BUSY_TXT  fast variables, and how often groups have something to do, each by a variable that
               it writes (find_busy.py); a wrong entry costs speed, nothing else
     OUTPUT    a header for direct_steps.hpp; MB4_EDGE_NOT_SPLIT if the model is not understood
     --check   now and then the parts whose flags are not set are computed as well: the program ends
               if one of them would change anything
     --count   each group is a part and counts how often it runs: what find_busy.py reads

Verilator computes all that hangs on a clock at each of its edges. Here its statements, unchanged,
are put into groups (a register with the statements that write it), in an order that keeps what
depends on each other. A group that writes a fast variable, one that changes at nearly every clock,
runs always. All others are bundled:

* behind a flag, set when a variable which they read gets another value;
* or, if they read fast variables of a few bits, the key, behind a flag for each value of the key.
  The flags are set when any other variable which they read gets another value, and those of the
  other values of the key when what they compute comes out different. So if a flag is not set,
  then with this value of the key they would compute what is there.

A variable that is only compared with numbers counts as changed when one of the comparisons does."""

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
    """Those statements that depend on any of these variables, and what they need for it."""
    taken = set()
    while True:
        size = len(taken)
        touched = set(names).union(*(rows[i].writes for i in taken))
        needed = {name for i in taken for name in rows[i].reads if "." in name}
        taken |= {i for i, row in enumerate(rows) if row.reads & touched or row.writes & needed}
        if len(taken) == size:
            return [rows[i] for i in sorted(taken)]


def by_host(functions_of, rows_of):
    """What an edge of a host pin can change, while no clock and no reset does."""
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
    # Long functions may be split, modules kept apart: then there are calls of another form.
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
    # Nobody looks for events behind an edge of CLK. The resets of the core only end there.
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
    except (NotUnderstood, LookupError, ValueError) as error:
        print(f"split_edge.py: the model runs whole, at a third of its speed: {error}")
        text = "#define MB4_EDGE_NOT_SPLIT\n"
    output.write_text(text, encoding="utf-8")


main()
