# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Groups of statements that stay together, and the parts of an edge that are made of them. Their
order keeps every dependency."""

import re
from collections import defaultdict
from graphlib import CycleError, TopologicalSorter

from generated_model import NotUnderstood

KEY_BITS = 3


class Group:
    """Statements that stay together: all statements that write a variable."""

    def __init__(self, rows):
        self.rows = rows
        self.writes = set().union(*(row.writes for row in rows))
        self.looks = looks(rows)
        self.arrays = set().union(*(row.arrays for row in rows))
        self.size = sum(len(row.text) for row in rows)
        names = sorted(name.rsplit(".", 1)[-1] for name in self.writes)
        self.name = re.sub(r"^__Vdly(?:v\w+?)?__", "", names[0]) if names else message(rows[0])
        self.module = re.split(r"(?:__DOT__|\.)\w+$", self.name)[0]
        self.before, self.after = set(), set()


def message(row):
    """The place of an assertion, and its name."""
    found = re.search(r"%N([\w.\[\]]+)", row.text)
    if not found:
        raise NotUnderstood(f"neither assignment nor assertion: {row.text[:80]}")
    return found[1]


class Part:
    """Groups that run together. There are three cases: they run always (`bits` is 0); one flag
    controls them; or one flag for each value of the variables in `key` does, `bits` flags in
    place `flag` of a table. `when`: they run only after one of these events (bits); `always`: then
    they run if the clock has had an edge."""

    def __init__(self, groups, flag=0, bits=0, key=(), when=0, always=False):
        self.rows = [row for group in groups for row in group.rows]
        self.name = groups[0].name if groups else ""
        self.flag, self.bits, self.key = flag, bits, key
        self.when, self.always = when, always
        self.reads = inputs(self.rows)
        self.looks = {look for look in looks(self.rows) if look[0] not in key}
        self.writes = set().union(*(row.writes for row in self.rows))
        self.arrays = set().union(*(row.arrays for row in self.rows))


def inputs(rows):
    """Variables that the statements read before they write them, or keep if they do not write
    them."""
    return {name for name, _ in looks(rows)}


def looks(rows):
    """The same variables as (name, None), or as (name, number) for each number if a variable is
    only compared with numbers."""
    found, written = set(), set()
    for row in rows:
        found |= {look for look in row.looks | {(name, None) for name in row.writes - row.defines}
                  if look[0] not in written}
        written |= row.defines
    return {(name, number) for name, number in found
            if number is None or (name, None) not in found}


def order_of(rows):
    """{place of a statement: places of the statements that must come after it}."""
    after = defaultdict(set)
    writer, readers = {}, defaultdict(set)
    for i, row in enumerate(rows):
        for name in row.reads & writer.keys():
            after[writer[name]].add(i)
        for name in row.writes:
            for k in readers[name] | ({writer[name]} if name in writer else set()):
                after[k].add(i)
            writer[name], readers[name] = i, set()
        for name in row.reads - row.writes:
            readers[name].add(i)
    return after


def joined(count, links, after):
    """[group of each statement]. Linked statements share a group, and so do statements that depend
    on each other in a circle."""
    kind = list(range(count))

    def root(i):
        while kind[i] != i:
            kind[i] = kind[kind[i]]
            i = kind[i]
        return i

    for a, b in links:
        kind[root(a)] = root(b)
    while True:
        succ = defaultdict(set)
        for a, many in after.items():
            succ[root(a)] |= {root(b) for b in many} - {root(a)}
        try:
            TopologicalSorter(succ).prepare()
            return [root(i) for i in range(count)]
        except CycleError as circle:
            for node in circle.args[1]:
                kind[root(node)] = root(circle.args[1][0])


def groups_of(rows, linked=()):
    """The groups. Statements that read or write a variable of `linked` share one."""
    after = order_of(rows)
    first = {}
    links = [(i, first.setdefault(name, i)) for i, row in enumerate(rows)
             for name in row.writes | row.reads.intersection(linked)]
    kind = joined(len(rows), links, after)
    members = defaultdict(list)
    for i, k in enumerate(kind):
        members[k].append(i)
    made = {k: Group([rows[i] for i in places]) for k, places in members.items()}
    for a, many in after.items():
        for b in many:
            if kind[a] != kind[b]:
                made[kind[a]].after.add(made[kind[b]])
                made[kind[b]].before.add(made[kind[a]])
    return list(made.values())


class Schedule:
    """Brings groups into an order that keeps every dependency. Runs of one kind are as long as
    possible."""

    def __init__(self, groups):
        self.missing = {group: len(group.before) for group in groups}
        self.open = [group for group in groups if not group.before]
        self.place = {group: k for k, group in enumerate(groups)}

    def take(self, group):
        self.open.remove(group)
        for follower in group.after:
            self.missing[follower] -= 1
            if self.missing[follower] == 0:
                self.open.append(follower)

    def run(self, kind, of):
        """Takes all groups of a kind that can come now, one after the other."""
        taken = []
        while True:
            fit = [group for group in self.open if of(group) == kind]
            if not fit:
                return taken
            group = min(fit, key=self.place.get)
            self.take(group)
            taken.append(group)

    def reach(self, kind, of):
        """Returns how many groups of a kind could come now."""
        missing = dict(self.missing)
        found = [group for group in self.open if of(group) == kind]
        for group in found:
            for follower in group.after:
                missing[follower] -= 1
                if missing[follower] == 0 and of(follower) == kind:
                    found.append(follower)
        return len(found)


def look_name(name, number):
    """A variable, or its comparison with a number, as the counts name it."""
    return name if number is None else f"{name}=={number}"


class Kinds:
    """Decides the kind of part of a group. Groups of one kind read the same fast variables, or they
    have work about equally often."""

    bundle = 1200  # characters of C++ that one flag controls

    def __init__(self, busy, widths):
        self.busy, self.widths = busy, widths

    def __call__(self, group):
        """None: the group runs always. Otherwise the variables of its key and the name of its
        part."""
        if group.writes & self.busy.fast:
            return None
        key = sorted({name for name, number in group.looks
                      if look_name(name, number) in self.busy.fast})
        if not key:
            rate = self.busy.rate.get(group.name, "")
            return (), group.module if rate == "often" else rate
        if sum(self.widths.get(name, KEY_BITS + 1) for name in key) > KEY_BITS or group.arrays:
            return None
        return tuple(key), group.module


class HostKinds:
    """The same for edges of host pins. `events` has the bits of the events of each function. A
    register that reads what an edge of the clock writes is computed after each such edge. The edge
    of the clock itself computes what it writes, and what reads this without a clock."""

    widths = {}
    bundle = 30000  # few, as an edge of a pin changes much of what a byte is made of

    def __init__(self, events, by_clock):
        self.events, self.by_clock = events, by_clock

    def __call__(self, group):
        when, *others = {self.events.get(row.function, 0) for row in group.rows}
        if others:
            raise NotUnderstood(f"{group.name}: more than one kind of event")
        always = not all(map(combinational, group.rows)) and \
            any(name in self.by_clock for name, _ in group.looks)
        return (), ", ".join(sorted({name for name, _ in group.looks} - group.writes)), when, always


def combinational(row):
    """Whether eval() computes the statement again whenever something that it reads has changed."""
    return not row.function.startswith("nba_sequent")


def parts_of(groups, kinds, count, flags=0):
    """(the parts of the edge in their order, number of flags). `flags`: the first flag."""
    schedule = Schedule(groups)
    found, keyed, last = [], 0, ()
    while schedule.open:
        run = schedule.run(None, kinds)
        if run:
            found.append(Part(run))
            continue
        kind = max(sorted({kinds(group) for group in schedule.open}),
                   key=lambda k: (k[2:3] == last, schedule.reach(k, kinds)))
        last = kind[2:3]
        key, _, when, always = (*kind, 0, False)[:4]
        bits = 1 << sum(kinds.widths[name] for name in key)
        bundle = []
        for group in schedule.run(kind, kinds) + [None]:
            if bundle and (group is None or count or
                           sum(one.size for one in bundle) + group.size > kinds.bundle):
                found.append(Part(bundle, keyed if key else flags, bits, key, when, always))
                keyed, flags = keyed + (key != ()), flags + (key == ())
                bundle = []
            bundle.append(group)
    return found, flags
