#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Splits the edges of a Verilated model's clock into parts, of which only those run whose inputs
have changed.

  model_parts.py MODEL.toml FOLDER OUTPUT [--busy COUNTS | --count] [--check] [--namespace NAME]
     MODEL.toml  describes the model (description.py)
     FOLDER      Verilator's output
     OUTPUT      a header; it defines MODEL_RUNS_WHOLE if this program does not understand the model
     --busy      COUNTS says what is busy (busy.py), so the model runs faster. A wrong count costs
                 speed only
     --count     each group is a part and counts how often it runs; the program that includes the
                 header prints the counts when it ends
     --check     at some edges the model also computes the parts whose flags are not set, and after
                 some edges of host pins it runs eval(); the program ends if a variable differs
     --namespace in the place of that of MODEL.toml, for a second header of a model

The header has rise() and fall() for the edges of the clock, host() for edges of host pins, and
`Kept` with the flags: tests/unit/model/parts/parts_sample.cpp shows their use.

Verilator computes all logic of a clock at each of its edges. This program puts Verilator's
statements, unchanged, into groups: a register with the statements that write it. The order of the
groups keeps every dependency. A fast variable is one that changes at nearly every clock. A group
that writes one runs always. Other groups are put into bundles of two kinds:

* One flag controls the bundle. The flag is set when a variable that the bundle reads changes.
* If the bundle reads fast variables of a few bits, these are its key, and each value of the key has
  a flag. A flag that is not set means: with this value of the key the bundle would compute what it
  shows now. So all flags are set when another variable that the bundle reads changes. When a run of
  the bundle changes its result, the flags of the other values of the key are set, and the flag of
  the present value too if the bundle reads its own result.

If a variable is only compared with numbers, it counts as changed when the result of a comparison
changes.

host() has a flag for each group. Each side computes the logic without a clock that depends on its
own changes. So only host() sets a flag of host(), and an edge of a host pin sets only those flags
of rise() that stand for registers and for keys. A register on a clock of the host that reads what
rise() writes is computed again after each edge of the clock."""

import argparse
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import description  # noqa: E402
from busy import Busy, busy_of  # noqa: E402
from description import member, members  # noqa: E402
from generated_model import (LONG, NotUnderstood, constants, functions, places,  # noqa: E402
                             statements, triggers, widths)
from groups import Group, HostKinds, Kinds, Part, groups_of, parts_of  # noqa: E402
from header import Writer  # noqa: E402
from self_check import check, check_host  # noqa: E402

INPUTS = "ico_sequent__TOP__0"  # Verilator's function for logic that depends on the inputs


def started(described, bodies, names):
    """[(function, the events that start it)] in the order of eval_nba()."""
    calls = re.findall(rf"if \(([^{{]*)\) \{{\s*{described.root}___(\w+)\(vlSelf\);",
                       bodies["eval_nba"])
    return [(function, {event for k in re.findall(r"\.at\((\w+?)U\)", condition)
                        for event in names[int(k, 0)]})
            for condition, function in calls]


def behind(rows, names):
    """Those statements that depend on any of these variables, the local variables that they read,
    and all statements that write what they write: a variable may have a default first."""
    taken = set()
    while True:
        size = len(taken)
        written = set().union(*(rows[i].writes for i in taken))
        touched = written | set(names)
        needed = written | {name for i in taken for name in rows[i].reads if "." in name}
        taken |= {i for i, row in enumerate(rows) if row.reads & touched or row.writes & needed}
        if len(taken) == size:
            return [rows[i] for i in sorted(taken)]


def of_host(described, names, functions_of, rows_of):
    """What an edge of a host pin starts: (statements behind the inputs, statements behind events,
    {function: bits of its events}, {variable: bit of its rising edge})."""
    pins = behind(rows_of[INPUTS], members(described.host))
    rows, bits = [], {}
    watched = sorted({event.split()[1] for events in names.values() for event in events})
    while True:
        moved = {name for row in pins + rows for name in row.writes} | set(members(described.host))
        found = [name for name in watched if member(name) in moved]
        if len(found) == len(bits):
            break
        bits = {name: 2 * k for k, name in enumerate(found)}
        when = {function: sum(1 << bits[name] + (edge == "negedge") for edge, name in
                              (event.split() for event in events) if name in bits)
                for function, events in functions_of}
        rows = [row for function, _ in functions_of if when[function] for row in rows_of[function]]
    if bits.keys() & (set(described.clocks) | set(described.released)):
        raise NotUnderstood(f"a host pin moves a clock or a reset: {sorted(bits)}")
    return pins, rows, when if bits else {}, {member(name): bits[name] for name in bits}


def look_for_surprises(described, names, rise, fall):
    """Raises NotUnderstood if an edge of the clock does what the header cannot show."""
    clocks = set(members(described.clocks))
    # No code looks for events after an edge of the clock.
    watched = {member(event.split()[1]) for events in names.values() for event in events}
    moved = {name for row in rise + fall for name in row.writes} & watched - clocks - set(
        members(described.released))
    if moved:
        raise NotUnderstood(f"an edge of the clock makes events: {sorted(moved)}")
    for row in rise:
        if (row.reads | row.writes) & clocks or "__Vtrig" in row.text:
            raise NotUnderstood(f"depends on the clock itself: {row.text[:80]}")


def made(described, folder, busy, count, checked):
    prefix = described.prefix
    bodies, names = functions(folder, prefix), triggers(folder, prefix)
    if "eval_nba" not in bodies:
        raise NotUnderstood("no functions of the model found")
    description.check(described, places(folder, prefix))
    functions_of = started(described, bodies, names)
    # Verilator may split long functions or keep modules apart. Then the calls look different.
    if len(functions_of) != bodies["eval_nba"].count("___nba_") or \
            bodies.get("eval_ico", "").count("___ico_") != (INPUTS in bodies):
        raise NotUnderstood("calls in eval_nba() or eval_ico()")
    types, rows_of = {}, {INPUTS: []}
    clock = described.events("posedge") | described.events("negedge")
    for function, events in [(INPUTS, set())] * (INPUTS in bodies) + functions_of:
        # An edge of a host pin changes little, so it pays to look at each variable there.
        local, rows_of[function] = statements(function, bodies[function],
                                              LONG if events & clock else 0)
        types |= local
    rise, fall = ([row for function, events in functions_of if events & described.events(edge)
                   for row in rows_of[function]] for edge in ("posedge", "negedge"))
    if not rise:
        raise NotUnderstood(f"no rising edge of {' or '.join(described.clocks)} found")
    look_for_surprises(described, names, rise, fall)
    bits = widths(folder, prefix, bodies)
    # What goes into a function and comes out of it stays together: apart it would be kept.
    local = {name for row in rise for name in row.reads if ".__Vfunc_" in name}
    parts, flags = parts_of(groups_of(rise, local), Kinds(busy, bits), count)
    lists = {"rise": parts, "fall": [Part([Group(fall)])] if fall else []}
    by_clock = {name for row in rise + fall for name in row.writes}
    for function, pins in described.follow.items():
        late = behind(rows_of[INPUTS], members(pins))
        lists[function] = [Part([Group(late)])] if late else []
        by_clock |= {name for row in late for name in row.writes} | set(members(pins))
    pins, rows, when, events = of_host(described, names, functions_of, rows_of)
    for name, many in (("pins", pins), ("events", rows)):
        # A local variable may be old in a later run, so all statements that use it share a group.
        local = {name for row in many for name in row.reads if "." in name}
        lists[name], flags = parts_of(groups_of(many, local), HostKinds(when, by_clock), False,
                                      flags + -flags % 64)
    writer = Writer(described, types, bits, constants(folder, prefix), events, lists, flags)
    if not checked:
        return writer.header(count)
    return writer.header(count, check(writer), check_host(writer, places(folder, prefix)))


def main():
    arguments = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("model", "folder", "output"):
        arguments.add_argument(name, type=Path)
    arguments.add_argument("--busy", type=Path)
    arguments.add_argument("--count", action="store_true")
    arguments.add_argument("--check", action="store_true")
    arguments.add_argument("--namespace")
    given = arguments.parse_args()
    described = description.read(given.model)
    described.namespace = given.namespace or described.namespace
    busy = busy_of(given.busy.read_text(encoding="utf-8")) if given.busy else Busy()
    try:
        text = made(described, given.folder, busy, given.count, given.check)
    except Exception as error:  # another Verilator: files are missing, unreadable or different
        print(f"model_parts.py: {described.prefix} runs whole, at a third of its speed: "
              f"{type(error).__name__}: {error}")
        text = "#define MODEL_RUNS_WHOLE\n"
    given.output.write_text(text, encoding="utf-8")


main()
