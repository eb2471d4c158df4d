#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The rising edge of CLK in parts, of which only those run whose inputs have changed.

  split_edge.py FOLDER BUSY_TXT OUTPUT [--count]
     FOLDER    what Verilator has made of mb4_chip
     BUSY_TXT  which groups run `always`, and which `often`, by a variable that they write; a name
               that is not there costs speed, nothing else
     OUTPUT    a header for direct_steps.hpp; MB4_EDGE_NOT_SPLIT if the model is not understood
     --count   each group is a part and counts how often it runs: what find_busy.py reads

Verilator computes all that hangs on a clock at each of its edges. Here its statements, unchanged,
are put into groups (a register with the statements that write it), in an order that keeps what
depends on each other. Groups that nearly always have something to do stand alone (busy); all others
are bundled, behind a flag that is set when a variable which they read gets another value."""

import re
import sys
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from generated_model import NotUnderstood, constants, functions, statements, triggers  # noqa: E402

PREFIX = "Vmb4_chip"
ROOT = f"{PREFIX}___024root"
BUNDLE = 8000  # characters of C++ behind one flag
# Changed from outside between edges: function name of the header, variables.
OUTSIDE = {
    "sl_has_changed": ["sl1_i", "sl2_i"],
    "time_has_changed": ["mb4_chip__DOT__u_engine__DOT__u_control__DOT__u_request__DOT__pre_q",
                         "mb4_chip__DOT__u_engine__DOT__u_control__DOT__u_request__DOT__step_q"]}
CLOCKS = {"clk_i", "mb4_chip__DOT__clk"}
EDGES = {"rise": {"posedge clk_i", "posedge mb4_chip.clk"},
         "fall": {"negedge clk_i", "negedge mb4_chip.clk"}}


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


class Writer:
    """The header: rise() with its parts, fall(), follow_sl(), marks for what changes outside."""

    def __init__(self, types, tables, arrays, by_host, lists):
        self.types, self.tables, self.arrays = types, tables, arrays
        self.by_host, self.lists = by_host, lists
        self.readers = defaultdict(set)
        for part in lists["rise"]:
            if part.flag is not None:
                for name in part.reads:
                    self.readers[name].add(part.flag)
        users = defaultdict(list)
        for parts in lists.values():
            for part in parts:
                for name in (set().union(*(row.reads for row in part.rows)) | part.writes):
                    if name in types:
                        users[name].append(part)
        # Local variables that keep their value from part to part, or from edge to edge.
        self.kept = {name for name, many in users.items()
                     if len(many) > 1 or any(name in part.reads for part in many)}
        self.lines = []

    def variable(self, name):
        if name not in self.types:
            return f"vlSelf->{name}"
        return ("kept." if name in self.kept else "") + name.replace(".", "__")

    def text(self, row):
        """The statement as it stands in the header; who writes into an array tells at once."""
        text = row.text
        for name in sorted(row.writes - row.defines):
            marks = self.marks([name])
            if marks and name in row.arrays:
                text, found = re.subn(rf"(vlSelf->{name}\s*\[[^;]*?\]\s*=(?!=)[^;]*;)",
                                      rf"\1 {marks}", text)
                if found == 0:
                    raise NotUnderstood(f"{name}: an array written in an unknown way")
        for name in sorted((row.reads | row.writes) & self.types.keys(), key=len, reverse=True):
            text = re.sub(rf"(?<![\w>.]){re.escape(name.split('.', 1)[1])}\b",
                          lambda _, name=name: self.variable(name), text)
        return text

    def marks(self, names):
        masks = defaultdict(int)
        for name in names:
            for flag in self.readers[name]:
                masks[flag // 64] |= 1 << (flag % 64)
        return " ".join(f"kept.changed[{k}] |= {mask:#x}ULL;" for k, mask in sorted(masks.items()))

    def part(self, part, count):
        for name in sorted({name for row in part.rows for name in row.reads | row.writes}
                           & self.types.keys() - self.kept):
            self.lines.append(f"{self.types[name]} {self.variable(name)} = 0;")
        arrays = set().union(*(row.arrays for row in part.rows))
        told = sorted(name for name in part.writes - arrays if self.marks([name]))
        for k, name in enumerate(told):
            self.lines.append(f"const auto before{k} = {self.variable(name)};")
        if count and part.flag is not None:
            self.lines.append(f"++counts.runs[{part.flag}];")
        self.lines += [self.text(row) for row in part.rows]
        alike = defaultdict(list)
        for k, name in enumerate(told):
            alike[self.marks([name])].append(f"(before{k} != {self.variable(name)})")
        self.lines += [f"if ({' | '.join(tests)}) {{ {marks} }}" for marks, tests in alike.items()]

    def function(self, name, parts, count):
        self.lines += [f"inline void {name}({ROOT}* __restrict vlSelf, Kept& __restrict kept) {{",
                       f"{PREFIX}__Syms* const __restrict vlSymsp = vlSelf->vlSymsp;",
                       "(void)vlSymsp;"]
        for part in parts:
            word, bit = divmod(part.flag or 0, 64)
            mark = f"kept.changed[{word}]"
            self.lines += ["{"] if part.flag is None else [
                f"if (__builtin_expect({mark} & {1 << bit:#x}ULL, 0)) {{", f"{mark} &= ~{1 << bit:#x}ULL;"]
            self.part(part, count)
            self.lines.append("}")
        self.lines.append("}")

    def header(self, flags, count):
        words = flags // 64 + 1
        self.lines = [
            "// Made from the model by split_edge.py.", "#pragma once",
            "#include <cstdint>", "#include <cstdio>",
            f"#include <{PREFIX}__Syms.h>", *self.tables,
            "namespace mb4::sim::edge {",
            "struct Kept {", f"std::uint64_t changed[{words}];",
            "Kept() { all(); }",
            "void all() { for (auto& word : changed) word = ~std::uint64_t{0}; }"]
        self.lines += [f"{self.types[name]} {name.replace('.', '__')}{{}};"
                       for name in sorted(self.kept)] + ["};"]
        if count:
            self.lines += ["inline struct Counts {", f"std::uint64_t runs[{flags}] = {{}};",
                           f"static constexpr const char* kNames[{flags}] = {{"]
            self.lines += [f'"{part.name}",' for part in self.lists["rise"]] + [
                "};", "~Counts() {", f"for (int k = 0; k < {flags}; ++k)",
                'std::fprintf(stderr, "%llu %s\\n", static_cast<unsigned long long>(runs[k]), '
                "kNames[k]);", "}", "} counts;"]
        for name, parts in self.lists.items():
            self.function(name, parts, count)
        for name, changed in OUTSIDE.items():
            self.lines.append(f"inline void {name}(Kept& kept) {{ {self.marks(changed)} }}")
        arrays = {name for name in self.by_host if name in self.arrays}
        watched = sorted(name for name in self.by_host - arrays if name not in self.types
                         and self.marks([name]))
        self.lines += ["// What the host's pins can change.", "struct Host {"]
        self.lines += [f"decltype({ROOT}::{name}) v{k};" for k, name in enumerate(watched)]
        self.lines += [f"explicit Host(const {ROOT}& root) :"]
        self.lines += [", ".join(f"v{k}(root.{name})" for k, name in enumerate(watched)), "{}",
                       f"void compare(const {ROOT}& root, Kept& kept) const {{",
                       self.marks(arrays)]
        alike = defaultdict(list)
        for k, name in enumerate(watched):
            alike[self.marks([name])].append(f"(v{k} != root.{name})")
        self.lines += [f"if ({' | '.join(tests)}) {{ {marks} }}" for marks, tests in alike.items()]
        self.lines += ["}", "};"]
        return "\n".join([*self.lines, "}", ""])


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
    written = {name for row in rows for name in row.writes}
    pins = {name for row in rows for name in row.reads if name.endswith("_i")
            and "__DOT__" not in name and name not in written} - CLOCKS
    return pins | first | {name for row in behind(rows, pins | first) for name in row.writes}


def made(folder, busy, count):
    bodies, names = functions(folder, PREFIX), triggers(folder, PREFIX)
    if not {"eval_nba", "ico_sequent__TOP__0"} <= bodies.keys():
        raise NotUnderstood("no functions of the model found")
    functions_of = started(bodies, names)
    types, rows_of = {}, {}
    for function in ["ico_sequent__TOP__0", *(name for name, _ in functions_of)]:
        local, rows_of[function] = statements(function, bodies[function])
        types |= local
    rise, fall = ([row for function, events in functions_of if events & EDGES[kind]
                   for row in rows_of[function]] for kind in ("rise", "fall"))
    if not rise or not fall:
        raise NotUnderstood("no edges of CLK found")
    for row in rise:
        if (row.reads | row.writes) & CLOCKS or "__Vtrig" in row.text:
            raise NotUnderstood(f"depends on CLK itself: {row.text[:80]}")
    parts, flags = parts_of(groups_of(rise), busy, count)
    behind_sl = Group(behind(rows_of["ico_sequent__TOP__0"], ["sl1_i", "sl2_i"]))
    arrays = {name for rows in rows_of.values() for row in rows for name in row.arrays}
    return Writer(types, constants(folder, PREFIX), arrays, by_host(functions_of, rows_of), {
        "rise": parts, "fall": [Part([Group(fall)], None)],
        "follow_sl": [Part([behind_sl], None)]}).header(flags, count)


def main():
    arguments = [value for value in sys.argv[1:] if value != "--count"]
    folder, listing, output = map(Path, arguments)
    busy = {} if "--count" in sys.argv else {
        name: often for often, name in
        (line.split() for line in listing.read_text(encoding="utf-8").splitlines()
         if line and not line.startswith("#"))}
    try:
        text = made(folder, busy, "--count" in sys.argv)
    except NotUnderstood as error:
        print(f"split_edge.py: the model runs whole, at a third of its speed: {error}")
        text = "#define MB4_EDGE_NOT_SPLIT\n"
    output.write_text(text, encoding="utf-8")


main()
