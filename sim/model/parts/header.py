# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the header: functions for the edges of the clock, and the flags of their parts."""

import re
from collections import defaultdict
from functools import reduce
from itertools import groupby

from description import members
from generated_model import NotUnderstood
from groups import Part, combinational, look_name, looks

CHECKED = 13  # one of so many rising edges has a check
# What the parts have in common that one test of host() leaves out: the event, runs of flags.
GATES = (lambda part: part.section, lambda part: part.when, lambda part: part.flag // 64,
         lambda part: part.flag // 8)


def mask_of(part):
    return ((1 << part.bits) - 1) << part.flag % 64


def mark(readers, seen, part):
    for name, number in seen:
        readers[name][number].add(part)


def marked(parts):
    masks = defaultdict(int)
    for part in parts:
        masks[part.flag // 64] |= mask_of(part)
    return " ".join(f"kept.changed[{k}] |= {mask:#x}ULL;" for k, mask in sorted(masks.items()))


class Writer:
    """The header: rise() with its parts, fall(), the functions of [follow], host(), and marks for
    changes from outside. `events`: {variable: bit of its rising edge; that of its falling
    edge is the next}."""

    def __init__(self, description, types, widths, tables, events, lists, flags):
        self.described, self.root = description, description.root
        self.types, self.widths, self.tables = types, widths, tables
        self.events, self.lists, self.flags = events, lists, flags
        # {name: {number or None: parts that must run when it changes}}, for changes by an edge of
        # the clock and by a host pin. host() leaves nothing to compute that has no clock. But the
        # other values of a key are not computed there.
        self.by_clock, self.by_host = (defaultdict(lambda: defaultdict(set)) for _ in range(2))
        self.readers = self.by_clock
        self.always = [part for part in lists["events"] if part.always]
        for part in lists["rise"]:
            if part.bits:
                mark(self.by_clock, part.looks, part)
                clocked = looks([row for row in part.rows if not combinational(row)])
                mark(self.by_host, part.looks | {(name, None) for name in part.writes}
                     if part.key else clocked, part)
        for part in lists["pins"] + lists["events"]:
            mark(self.by_host, part.looks, part)
        # A change that an edge of the clock sees sets the last flag.
        self.core = Part([], flags + -flags % 64, 1)
        mark(self.by_host, looks([row for name in lists.keys() - {"pins", "events"}
                                  for part in lists[name] for row in part.rows
                                  if not combinational(row)]), self.core)
        mark(self.by_host, {(name, None) for name in members(description.seen)}, self.core)
        self.moves = []
        users = defaultdict(list)
        for parts in lists.values():
            for part in parts:
                for name in (set().union(*(row.reads for row in part.rows)) | part.writes):
                    if name in types:
                        users[name].append(part)
        # Local variables that keep their value from one part to the next or from edge to edge.
        self.kept = {name for name, many in users.items()
                     if len(many) > 1 or any(name in part.reads for part in many)}
        self.lines = []

    def opening(self, name, result="void"):
        """The first lines of a function that holds statements of the model."""
        return [f"inline {result} {name}({self.root}* __restrict vlSelf, Kept& __restrict kept) {{",
                f"{self.described.prefix}__Syms* const __restrict vlSymsp = vlSelf->vlSymsp;",
                "(void)vlSymsp;"]

    def variable(self, name):
        if name not in self.types:
            return f"vlSelf->{name}"
        return ("kept." if name in self.kept else "") + name.replace(".", "__")

    def text(self, row):
        """The statement as it stands in the header. A write into an array sets its marks at
        once."""
        text = row.text
        for name in sorted(row.writes - row.defines):
            marks = self.marks([name])
            if marks and name in row.arrays:
                text, found = re.subn(
                    rf"(vlSelf->{name}\s*\[[^;]*?\])(\s*=(?!=)[^;]*;)",
                    rf"{{ const auto was = \1; \1\2 if (was != \1) {{ {marks} }} }}", text)
                if found == 0:
                    raise NotUnderstood(f"{name}: an array written in an unknown way")
        for name in sorted((row.reads | row.writes) & self.types.keys(), key=len, reverse=True):
            text = re.sub(rf"(?<![\w>.]){re.escape(name.split('.', 1)[1])}\b",
                          lambda _, name=name: self.variable(name), text)
        return text

    def reading(self, name):
        """The parts that read the variable in any way."""
        return set().union(*self.readers[name].values())

    def marks(self, names):
        """Code that makes all parts run that read one of the variables."""
        return marked(set().union(*(self.reading(name) for name in names)))

    def compare(self, names, before, now, count=False):
        """Sets the marks of the parts that read a changed variable. Variables with the same readers
        share one test."""
        alike = defaultdict(list)
        for k, name in enumerate(names):
            for number, parts in sorted(self.readers[name].items(), key=str):
                old, new = before(k), now(name)
                test = f"({old} != {new})" if number is None else \
                    f"(({old} == {number}U) != ({new} == {number}U))"
                alike[marked(parts)].append(test)
                if count:
                    self.lines.append(f"counts.moves[{len(self.moves)}] += {test};")
                    self.moves.append(look_name(name, number))
        self.lines += [f"if ({' | '.join(tests)}) {{ {marks} }}" for marks, tests in alike.items()]

    def bits_of(self, part):
        """(variable of the part's key, place of its bits in the key's value), one after the
        other."""
        at = 0
        for name in part.key:
            yield name, at
            at += self.widths[name]

    def key(self, part):
        """The place of the flag for the present value of the part's key."""
        return " + ".join([str(part.flag % 64),
                           *(f"(static_cast<unsigned>({self.variable(name)}) << {at})"
                             for name, at in self.bits_of(part))])

    def lasting(self, part):
        """The variables that a part writes and that keep their value after it, without arrays."""
        return sorted(part.writes - part.arrays - (self.types.keys() - self.kept))

    def declared(self, part):
        """Lines for the local variables that exist only inside a part."""
        return [f"{self.types[name]} {self.variable(name)}{{}};"
                for name in sorted({name for row in part.rows for name in row.reads | row.writes}
                                   & self.types.keys() - self.kept)]

    def part(self, part, count):
        self.lines += self.declared(part)
        told = [name for name in self.lasting(part) if part.key or self.marks([name])]
        for k, name in enumerate(told):
            self.lines.append(f"const auto before{k} = {self.variable(name)};")
        if count and part.bits:
            self.lines.append(f"++counts.runs[{part.flag}];")
        self.lines += [self.text(row) for row in part.rows]
        if part.key:
            # The result has changed, so it is not known for other values of the key.
            word, mask = f"kept.changed[{part.flag // 64}]", mask_of(part)
            tests = " | ".join(f"(before{k} != {self.variable(name)})"
                               for k, name in enumerate(told))
            self.lines.append(f"if ({tests or 'false'}) {{ {word} |= {mask:#x}ULL & ~here; }}")
        self.compare(told, lambda k: f"before{k}", self.variable, count)
        if self.readers is self.by_host:
            self.look_for(part.writes)

    def some(self, parts, count=False):
        for part in parts:
            if not part.bits:
                self.lines.append("{")
            else:
                word = f"kept.changed[{part.flag // 64}]"
                self.lines += [f"if (const unsigned at = {self.key(part)};",
                               f"__builtin_expect(({word} >> at & 1) != 0, 0)) {{",
                               "const auto here = std::uint64_t{1} << at;", f"{word} &= ~here;"]
            self.part(part, count)
            self.lines.append("}")

    def gated(self, parts, tests=GATES):
        """Parts of host(): one test leaves out many of them."""
        for gate, many in groupby(parts, tests[0]):
            many = list(many)
            masks = sum(mask_of(part) for part in many)
            when = reduce(int.__or__, (part.when for part in many))
            if tests[2:]:
                self.lines.append(f"if ((now & {when:#x}) != 0) {{" if when else "{")
            else:
                self.lines.append(f"if ((kept.changed[{many[0].flag // 64}] & {masks:#x}) != 0) {{"
                                  if len(many) > 1 else "{")
            if tests[1:]:
                self.gated(many, tests[1:])
            else:
                self.some(many)
            self.lines.append("}")

    def function(self, name, parts, count):
        self.lines += [*self.opening(name), "kept.clocked = true;"]
        self.some(parts, count)
        if self.checked and name == "rise":
            self.lines.append(f"if (++kept.rises % {CHECKED} == 0) check(vlSelf, kept);")
        self.lines.append("}")

    def counts(self):
        names = [part.name for part in self.lists["rise"]]
        self.lines += ["inline struct Counts {"]
        for kind, many in (("runs", names), ("moves", self.moves)):
            self.lines += [f"std::uint64_t {kind}[{len(many)}] = {{}};",
                           f"static constexpr const char* k_{kind}[{len(many)}] = {{",
                           *(f'"{name}",' for name in many), "};"]
        self.lines.append("~Counts() {")
        for kind, many in (("runs", names), ("moves", self.moves)):
            self.lines += [f"for (int k = 0; k < {len(many)}; ++k)",
                           f'std::printf("{kind} %llu %s\\n", '
                           f"static_cast<unsigned long long>({kind}[k]), k_{kind}[k]);"]
        self.lines += ["}", "} counts;"]

    def host(self, name):
        """host(): an edge of a host pin. It follows eval(): first what depends on the inputs, then
        what the events start, as long as there are events."""
        self.readers = self.by_host
        core, pins = self.core, sorted(members(self.described.host))
        self.lines += [*self.opening(name, "bool"), f"kept.changed[{core.flag // 64}] = 0;",
                       "unsigned next = 0;",
                       f"if (std::exchange(kept.clocked, false)) {{ {marked(self.always)} }}"]
        for name in pins:
            self.lines.append(f"if (const auto was = kept.{name}; was != vlSelf->{name}) {{")
            self.compare([name], lambda _: "was", self.variable)
            self.look_for([name])
            self.lines += [f"kept.{name} = vlSelf->{name};", "}"]
        self.gated(self.lists["pins"])
        self.lines += ["while (next != 0) {", "const unsigned now = std::exchange(next, 0);"]
        self.gated(self.lists["events"])
        self.lines += ["}", f"return kept.changed[{core.flag // 64}] != 0;", "}"]

    def look_for(self, names):
        """Code that adds the events of these variables to `next`."""
        for name, bit in self.events.items():
            old = f"vlSelf->__Vtrigrprev__TOP__{name}"
            if name in names:
                self.lines += [f"if (vlSelf->{name} != {old}) {{",
                               f"next |= vlSelf->{name} != 0 ? {1 << bit:#x} : {2 << bit:#x};",
                               f"{old} = vlSelf->{name};", "}"]

    def header(self, count, check=(), check_host=()):
        """`check`: lines of a function check(), called after some of the edges. `check_host`: those
        of a host() that calls unchecked_host()."""
        self.checked = bool(check)
        pins = sorted(members(self.described.host))
        self.lines = [
            "// Made from the model by model_parts.py.", "#pragma once",
            "#include <cstddef>", "#include <cstdint>", "#include <cstdio>", "#include <cstring>",
            "#include <utility>",
            f"#include <{self.described.prefix}__Syms.h>", *self.tables,
            f"void {self.root}___eval({self.root}*);",
            f"namespace {self.described.namespace} {{",
            "struct Kept {", f"std::uint64_t changed[{self.core.flag // 64 + 1}];",
            "Kept() { std::memset(changed, 0xFF, sizeof changed); }",
            f"void all(const {self.root}& root) {{",
            "std::memset(changed, 0xFF, sizeof changed);",
            *(f"{name} = root.{name};" for name in pins), "(void)root; }",
            *(f"decltype({self.root}::{name}) {name}{{}};" for name in pins),
            *(f"{self.types[name]} {name.replace('.', '__')}{{}};" for name in sorted(self.kept)),
            "bool clocked = false;", "std::uint64_t rises = 0, edges = 0;", "};", *check]
        head, self.lines = self.lines, []
        for name in sorted(self.lists.keys() - {"pins", "events"}):
            self.function(name, self.lists[name], count and name == "rise")
        body, self.lines = self.lines, head
        if count:
            self.counts()
        self.lines += body
        for name, changed in self.described.changed.items():
            self.lines.append(f"inline void {name}(Kept& kept) "
                              f"{{ kept.clocked = true; {self.marks(members(changed))} }}")
        if pins:
            self.host("unchecked_host" if check else "host")
            self.lines += check_host
        return "\n".join([*self.lines, "}", ""])
