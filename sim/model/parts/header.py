# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the header: functions for the edges of the clock, and the flags of their parts."""

import re
from collections import defaultdict
from functools import reduce
from itertools import groupby

from description import members
from generated_model import NotUnderstood, branches
from groups import KEY_BITS, Part, combinational, look_name, looks

CHECKED = 13  # one of so many rising edges has a check


def one_flag(part):
    return part.bits != 0 and not part.key


# One test leaves out all parts that have one of these in common: the event, runs of flags.
GATES = (lambda part: part.when,
         lambda part: one_flag(part) and part.flag // 64 + 1,
         lambda part: one_flag(part) and part.flag // 8 + 1)


def inside_out(text):
    """An assertion with its own condition first: the others, such as the reset, seldom decide."""
    conditions, body = [], text.strip()
    while parts := branches(body):
        if parts[2]:
            return text
        conditions.insert(0, parts[0])
        body = parts[1].strip()
    # VL_STOP_MT() throws. abort() tells this to the compiler, which then keeps what it knows about
    # the variables.
    end = "std::abort();" if "VL_STOP_MT" in body else ""
    return f"if ({' && '.join(conditions)}) {{ {body} {end} }}"


def mark(readers, seen, part):
    for name, number in seen:
        readers[name][number].add(part)


def mask_of(parts):
    return sum(1 << part.flag % 64 for part in parts)


def marked(parts):
    """Code that sets all flags of these parts. A part with a key has a byte for each value."""
    words = defaultdict(set)
    for part in parts:
        if not part.key:
            words[part.flag // 64].add(part)
    return " ".join(
        [f"kept.changed[{k}] |= {mask_of(some):#x}ULL;" for k, some in sorted(words.items())] +
        [f"std::memset(kept.keyed[{part.flag}], 1, {part.bits});"
         for part in sorted(parts, key=lambda part: part.flag) if part.key])


class Writer:
    """The header: rise() with its parts, fall(), the functions of [follow], host(), and marks for
    changes from outside. `events`: {variable: bit of its rising edge; that of its falling
    edge is the next}."""

    def __init__(self, description, types, widths, tables, events, lists, flags):
        self.described, self.root = description, description.root
        self.types, self.widths, self.tables = types, widths, tables
        self.events, self.lists, self.flags = events, lists, flags
        users = defaultdict(list)
        for parts in lists.values():
            for part in parts:
                for name in (set().union(*(row.reads for row in part.rows)) | part.writes):
                    if name in types:
                        users[name].append(part)
        # Local variables that keep their value from one part to the next or from edge to edge.
        self.kept = {name for name, many in users.items()
                     if any(name in part.reads for part in many)}
        # {name: {number or None: parts that must run when it changes}}, for changes by an edge of
        # the clock and by a host pin. host() itself computes all parts without a clock, of a part
        # with a key only the value that the key has now: the others stay marked. It does not know
        # the kept local variables of rise(), so a part that writes one of them is marked too, for
        # what goes into that variable.
        self.by_clock, self.by_host = (defaultdict(lambda: defaultdict(set)) for _ in range(2))
        self.readers = self.by_clock
        self.always = [part for part in lists["events"] if part.always]
        for part in lists["rise"]:
            if part.bits:
                mark(self.by_clock, part.looks, part)
                mark(self.by_host, part.looks if part.key else looks(self.not_by_host(part)), part)
                if part.key:
                    mark(self.by_host, {(name, None) for name in part.writes}, part)
        for part in lists["pins"] + lists["events"]:
            mark(self.by_host, part.looks, part)
        # A change that an edge of the clock sees sets the last flag.
        self.core = Part([], flags + -flags % 64, 1)
        mark(self.by_host, looks([row for name in lists.keys() - {"pins", "events"}
                                  for part in lists[name] for row in part.rows
                                  if not combinational(row)]), self.core)
        mark(self.by_host, {(name, None) for name in members(description.seen)}, self.core)
        self.moves = []
        self.lines = []
        self.local = {}  # {variable: the local one that stands for it now}

    def not_by_host(self, part):
        """The statements of a part of rise() whose results host() does not make."""
        rows, needed = [], self.kept
        for row in reversed(part.rows):
            if not combinational(row) or row.writes & needed:
                rows.insert(0, row)
                needed = needed | row.reads & self.types.keys()
        return rows

    def opening(self, name, result="void"):
        """The first lines of a function that holds statements of the model."""
        return [f"inline {result} {name}({self.root}* __restrict vlSelf, Kept& __restrict kept) {{",
                f"{self.described.prefix}__Syms* const __restrict vlSymsp = vlSelf->vlSymsp;",
                "(void)vlSymsp;"]

    def variable(self, name):
        if name in self.local:
            return self.local[name]
        if name not in self.types:
            return f"vlSelf->{name}"
        return ("kept." if name in self.kept else "") + name.replace(".", "__")

    def text(self, row):
        """The statement as it stands in the header. A write into an array sets its marks at
        once."""
        text = row.text if row.writes else inside_out(row.text)
        for name in sorted(row.writes - row.defines):
            marks = self.marks([name])
            if marks and name in row.arrays:
                text, found = re.subn(
                    rf"(vlSelf->{name}\s*\[[^;]*?\])(\s*=(?!=)[^;]*;)",
                    rf"{{ const auto was = \1; \1\2 if (was != \1) {{ {marks} }} }}", text)
                if found == 0:
                    raise NotUnderstood(f"{name}: an array written in an unknown way")
        for name in (row.reads | row.writes) & self.local.keys() - self.types.keys():
            text = re.sub(rf"vlSelf->{name}\b", self.local[name], text)
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

    def compare(self, name, old, new, also="", writer=None):
        """Sets the marks of the parts that read a variable, if it has changed from `old` to `new`.
        `also`: code for any change, in the last test. `writer`: the part that has written the
        variable. Its mark is set only if the part also reads the variable."""
        again = writer is None or any(name in row.reads for row in writer.rows)
        for number, parts in sorted(self.readers[name].items(),
                                    key=lambda item: (item[0] is None, str(item[0]))):
            test = f"{old} != {new}" if number is None else \
                f"({old} == {number}U) != ({new} == {number}U)"
            if self.count:
                self.lines.append(f"counts.moves[{len(self.moves)}] += {test};")
                self.moves.append(look_name(name, number))
            seen = parts if again else parts - {writer}
            self.lines.append(f"if ({test}) {{ {marked(seen)} {also if number is None else ''} }}")

    def bits_of(self, part):
        """(variable of the part's key, place of its bits in the key's value), one after the
        other."""
        at = 0
        for name in part.key:
            yield name, at
            at += self.widths[name]

    def flag(self, part, value=None):
        """The flag of the part for a value of its key, or for the present one."""
        if not part.key:
            return f"kept.changed[{part.flag // 64}] & {mask_of([part]):#x}ULL"
        value = value or " + ".join(f"(unsigned{{{self.variable(name)}}} << {at})"
                                    for name, at in self.bits_of(part))
        return f"kept.keyed[{part.flag}][{value}]"

    def lasting(self, part):
        """The variables that a part writes and that keep their value after it, without arrays."""
        return sorted(part.writes - part.arrays - (self.types.keys() - self.kept))

    def declared(self, part):
        """Lines for the local variables that exist only inside a part."""
        return [f"{self.types[name]} {self.variable(name)}{{}};"
                for name in sorted({name for row in part.rows for name in row.reads | row.writes}
                                   & self.types.keys() - self.kept)]

    def part(self, part):
        """The statements of a part. A variable that others look at is computed in a local one. It
        is stored after the last statement that writes it, if it has changed."""
        self.lines += self.declared(part)
        if self.count and part.bits:
            self.lines.append(f"++counts.runs[{part.flag}];")
        told = [name for name in self.lasting(part) if part.key or self.readers[name]]
        last = {name: place for place, row in enumerate(part.rows)
                for name in row.writes.intersection(told)}
        # A result has changed, so it is not known for other values of the key. Neither is it for
        # this value if the part reads its own result, as a shift register does.
        own = {name for name, end in last.items()
               if part.key and any(name in row.reads for row in part.rows[:end + 1])}
        again = f"{marked([part])} here = {'own' if own else 0};"
        if own:
            self.lines.append("std::uint8_t own = 0;")
        for place, row in enumerate(part.rows):
            for name in sorted(row.writes.intersection(told) - self.local.keys()):
                now = f"now{told.index(name)}"
                self.lines.append(f"auto {now} = {self.variable(name)};")
                self.local[name] = now
            self.lines.append(self.text(row))
            for name in sorted(name for name in told if last[name] == place):
                now = self.local.pop(name)
                old = self.variable(name)
                store = f"{old} = {now};"
                also = ("own = 1; " * (name in own) + again) * bool(part.key)
                if None in self.readers[name]:
                    self.compare(name, old, now, f"{also} {store}".strip(), part)
                else:
                    self.compare(name, old, now, writer=part)
                    self.lines.append(f"if ({old} != {now}) {{ {also} {store} }}")
        if self.readers is self.by_host:
            self.look_for(part.writes)

    def some(self, parts):
        for part in parts:
            if part.key:
                self.lines += [f"if (auto& here = {self.flag(part)}; __builtin_expect(here, 0)) {{",
                               "here = 0;"]
            elif part.bits:
                self.lines += [f"if (__builtin_expect(({self.flag(part)}) != 0, 0)) {{",
                               f"kept.changed[{part.flag // 64}] &= ~{mask_of([part]):#x}ULL;"]
            else:
                self.lines.append("{")
            self.part(part)
            self.lines.append("}")

    def gated(self, parts, tests=GATES):
        """One test leaves out many parts."""
        for gate, many in groupby(parts, tests[0]):
            many = list(many)
            when = reduce(int.__or__, (part.when for part in many))
            if tests is GATES:
                self.lines.append(f"if ((now & {when:#x}) != 0) {{" if when else "{")
            else:
                word = f"kept.changed[{many[0].flag // 64}]"
                self.lines.append(f"if (({word} & {mask_of(many):#x}ULL) != 0) {{"
                                  if gate and many[1:] else "{")
            if tests[1:]:
                self.gated(many, tests[1:])
            else:
                self.some(many)
            self.lines.append("}")

    def function(self, name, parts):
        self.lines += [*self.opening(name), "kept.clocked = true;"]
        self.gated(parts)
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
            self.compare(name, "was", self.variable(name))
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
        self.checked, self.count = bool(check), False
        pins = sorted(members(self.described.host))
        self.lines = [
            "// Made from the model by model_parts.py.", "#pragma once",
            "#include <cstddef>", "#include <cstdint>", "#include <cstdio>", "#include <cstdlib>",
            "#include <cstring>", "#include <utility>",
            f"#include <{self.described.prefix}__Syms.h>", *self.tables,
            f"void {self.root}___eval({self.root}*);",
            f"namespace {self.described.namespace} {{",
            "struct Kept {", f"std::uint64_t changed[{self.core.flag // 64 + 1}];",
            f"std::uint8_t keyed[{1 + sum(bool(part.key) for part in self.lists['rise'])}]"
            f"[{1 << KEY_BITS}];", "Kept() { mark_all(); }",
            "void mark_all() {", "std::memset(changed, 0xFF, sizeof changed);",
            "std::memset(keyed, 1, sizeof keyed);", "}",
            f"void all(const {self.root}& root) {{", "mark_all();",
            *(f"{name} = root.{name};" for name in pins), "(void)root; }",
            *(f"decltype({self.root}::{name}) {name}{{}};" for name in pins),
            *(f"{self.types[name]} {name.replace('.', '__')}{{}};" for name in sorted(self.kept)),
            "bool clocked = false;", "std::uint64_t rises = 0, edges = 0;", "};", *check]
        head, self.lines = self.lines, []
        for name in sorted(self.lists.keys() - {"pins", "events"}):
            self.count = count and name == "rise"
            self.function(name, self.lists[name])
        body, self.lines = self.lines, head
        if count:
            self.counts()
        self.lines += body
        for name, changed in self.described.changed.items():
            self.lines.append(f"inline void {name}(Kept& kept) "
                              f"{{ kept.clocked = true; {self.marks(members(changed))} }}")
        self.count = False
        if pins:
            self.host("unchecked_host" if check else "host")
            self.lines += check_host
        return "\n".join([*self.lines, "}", ""])
