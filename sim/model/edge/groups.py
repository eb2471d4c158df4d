# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Groups of statements that stay together, and parts of an edge made of them, in an order that
keeps what depends on each other."""

import re
from collections import defaultdict

from generated_model import NotUnderstood

BUNDLE = 8000  # characters of C++ behind one flag


class Group:
    """Statements that stay together: all that write a variable."""

    def __init__(self, rows):
        self.rows = rows
        self.reads, self.writes = inputs(rows), set().union(*(row.writes for row in rows))
        self.size = sum(len(row.text) for row in rows)
        names = sorted(name.rsplit(".", 1)[-1] for name in self.writes)
        self.name = re.sub(r"^__Vdly(?:v\w+?)?__", "", names[0]) if names else message(rows[0])
        self.module = re.split(r"(?:__DOT__|\.)\w+$", self.name)[0]
        self.before, self.after = set(), set()


def message(row):
    """Where an assertion stands, and its name."""
    found = re.search(r"%N([\w.\[\]]+)", row.text)
    if not found:
        raise NotUnderstood(f"neither assignment nor assertion: {row.text[:80]}")
    return found[1]


class Part:
    def __init__(self, groups, flag):
        self.rows = [row for group in groups for row in group.rows]
        self.name = groups[0].name if groups else ""
        self.flag = flag  # None: runs always
        self.reads = inputs(self.rows)
        self.writes = set().union(*(row.writes for row in self.rows))


def inputs(rows):
    """What statements read that they have not written before, or keep if they do not write it."""
    found, written = set(), set()
    for row in rows:
        found |= (row.reads | (row.writes - row.defines)) - written
        written |= row.defines
    return found


def order_of(rows):
    """{statement: those that must come after it}, by their places."""
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
    """[group of each statement]: linked ones, and those that depend on each other in a circle."""
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
        circle = circle_in(succ)
        if not circle:
            return [root(i) for i in range(count)]
        for node in circle[1:]:
            kind[root(node)] = root(circle[0])


def circle_in(succ):
    done, path, on = set(), [], set()
    for start in list(succ):
        if start in done:
            continue
        stack = [(start, iter(succ[start]))]
        path.append(start)
        on.add(start)
        while stack:
            node, rest = stack[-1]
            follower = next(rest, None)
            if follower is None:
                stack.pop()
                done.add(path.pop())
                on.discard(node)
            elif follower in on:
                return path[path.index(follower):]
            elif follower not in done:
                stack.append((follower, iter(succ.get(follower, ()))))
                path.append(follower)
                on.add(follower)
    return []


def groups_of(rows):
    after = order_of(rows)
    first = {}
    links = [(i, first.setdefault(name, i)) for i, row in enumerate(rows) for name in row.writes]
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
    """Groups in an order that keeps dependencies: runs of one kind as long as they can be."""

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
        """All groups of a kind that can come now, one after the other."""
        taken = []
        while True:
            fit = [group for group in self.open if of(group) == kind]
            if not fit:
                return taken
            group = min(fit, key=self.place.get)
            self.take(group)
            taken.append(group)

    def reach(self, kind, of):
        """How many groups of a kind could come now."""
        missing = dict(self.missing)
        found = [group for group in self.open if of(group) == kind]
        for group in found:
            for follower in group.after:
                missing[follower] -= 1
                if missing[follower] == 0 and of(follower) == kind:
                    found.append(follower)
        return len(found)


def parts_of(groups, busy, count):
    """Parts of the edge in their order."""
    schedule = Schedule(groups)
    found, flags = [], 0

    def of(group):
        often = busy.get(group.name, "")
        return None if often == "always" else group.module if often else ""

    while schedule.open:
        run = schedule.run(None, of)
        if run:
            found.append(Part(run, None))
            continue
        kind = max(sorted({of(group) for group in schedule.open}),
                   key=lambda k: schedule.reach(k, of))
        bundle = []
        for group in schedule.run(kind, of) + [None]:
            if bundle and (group is None or count or
                           sum(one.size for one in bundle) + group.size > BUNDLE):
                found.append(Part(bundle, flags))
                flags += 1
                bundle = []
            bundle.append(group)
    return found, flags
