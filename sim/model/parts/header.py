# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the header: functions for the edges of the clock, and the flags of their parts."""

import re
from collections import defaultdict

from description import members
from generated_model import NotUnderstood
from groups import look_name

CHECKED = 13  # one of so many rising edges has a check
BLOCK = 48  # neighbouring variables that one comparison of memory covers
HOST = """private:
static const std::byte* bytes(const void* p) { return static_cast<const std::byte*>(p); }
template <typename F, typename L>
void copy(const ROOT& root, const F& first, const L& last) {
std::memcpy(copy_ + (bytes(&first) - bytes(&root)), &first,
static_cast<std::size_t>(bytes(&last + 1) - bytes(&first)));
}
template <typename F, typename L>
bool same(const ROOT& root, const F& first, const L& last) const {
return std::memcmp(copy_ + (bytes(&first) - bytes(&root)), &first,
static_cast<std::size_t>(bytes(&last + 1) - bytes(&first))) == 0;
}
template <typename T>
T then(const ROOT& root, const T& member) const {
T value;
std::memcpy(&value, copy_ + (bytes(&member) - bytes(&root)), sizeof value);
return value;
}
std::byte copy_[sizeof(ROOT)];"""


def mask_of(part):
    return ((1 << part.bits) - 1) << part.flag % 64


def marked(parts):
    masks = defaultdict(int)
    for part in parts:
        masks[part.flag // 64] |= mask_of(part)
    return " ".join(f"kept.changed[{k}] |= {mask:#x}ULL;" for k, mask in sorted(masks.items()))


class Writer:
    """The header: rise() with its parts, fall(), the functions of [follow], and marks for changes
    from outside."""

    def __init__(self, description, types, widths, places, tables, arrays, pins, by_host, lists):
        self.described, self.root, self.input_pins = description, description.root, pins
        self.types, self.widths, self.places = types, widths, places
        self.tables, self.arrays = tables, arrays
        self.by_host, self.lists = by_host, lists
        self.readers = defaultdict(lambda: defaultdict(set))  # {name: {number or None: parts}}
        self.writers = defaultdict(set)  # {name: parts that write it}
        for part in lists["rise"]:
            if part.bits:
                for name, number in part.looks:
                    self.readers[name][number].add(part)
                for name in part.writes:
                    self.writers[name].add(part)
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

    def opening(self, name):
        """The first lines of a function that holds statements of the model."""
        return [f"inline void {name}({self.root}* __restrict vlSelf, Kept& __restrict kept) {{",
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
                text, found = re.subn(rf"(vlSelf->{name}\s*\[[^;]*?\]\s*=(?!=)[^;]*;)",
                                      rf"\1 {marks}", text)
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

    def marks_behind_eval(self, name):
        """Code for a variable that eval() has changed. The parts that read it must run. The parts
        that write it must run too, because their result is no longer there. (eval() has local
        variables of its own. A variable may have changed because of one whose value the parts never
        see.)"""
        return marked(self.reading(name) | self.writers[name])

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
        return [f"{self.types[name]} {self.variable(name)} = 0;"
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

    def function(self, name, parts, count):
        self.lines += self.opening(name)
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

    def pins(self):
        """Marks for the host's pins. A pin changes before the comparison, so Pins keeps its old
        level."""
        late = {name for pins in self.described.follow.values() for name in members(pins)}
        names = sorted(name for name in self.by_host & self.input_pins - late
                       if self.marks([name]))
        self.lines += ["struct Pins {",
                       *(f"decltype({self.root}::{name}) {name}{{}};" for name in names),
                       f"void compare(const {self.root}& root, Kept& kept) {{"]
        self.compare(names, names.__getitem__, lambda name: f"root.{name}")
        self.lines += [*(f"{name} = root.{name};" for name in names), "}", "};"]

    def host(self):
        """Copies of the variables that the host's pins can change, for a later comparison."""
        watched = sorted((name for name in self.by_host - self.input_pins - self.types.keys()
                          if self.marks_behind_eval(name)),
                         key=lambda name: self.places[name])
        blocks = []
        for name in watched:
            if not blocks or self.places[name] - self.places[blocks[-1][0]] >= BLOCK or \
                    name in self.arrays or blocks[-1][0] in self.arrays:
                blocks.append([])
            blocks[-1].append(name)
        self.lines += [
            "class Host {", "public:", f"void take(const {self.root}& root) {{",
            *(f"copy(root, root.{block[0]}, root.{block[-1]});" for block in blocks), "}",
            f"void compare(const {self.root}& root, Kept& kept) const {{"]
        for block in blocks:
            self.lines.append(f"if (!same(root, root.{block[0]}, root.{block[-1]})) {{")
            for name in block:
                changed = f"if (then(root, root.{name}) != root.{name}) "
                self.lines.append("" if name in self.arrays else changed)
                self.lines.append(f"{{ {self.marks_behind_eval(name)} }}")
            self.lines.append("}")
        self.lines += ["}", HOST.replace("ROOT", self.root), "};"]

    def header(self, flags, count, check=()):
        """`check`: lines of a function check(), called after some of the edges."""
        self.checked = bool(check)
        words = flags // 64 + 1
        self.lines = [
            "// Made from the model by model_parts.py.", "#pragma once",
            "#include <cstddef>", "#include <cstdint>", "#include <cstdio>", "#include <cstring>",
            f"#include <{self.described.prefix}__Syms.h>", *self.tables,
            f"namespace {self.described.namespace} {{",
            "struct Kept {", f"std::uint64_t changed[{words}];",
            "Kept() { all(); }",
            "void all() { for (auto& word : changed) word = ~std::uint64_t{0}; }",
            *(f"{self.types[name]} {name.replace('.', '__')}{{}};" for name in sorted(self.kept)),
            *(["std::uint64_t rises = 0;"] if check else []), "};", *check]
        head, self.lines = self.lines, []
        for name, parts in self.lists.items():
            self.function(name, parts, count)
        body, self.lines = self.lines, head
        if count:
            self.counts()
        self.lines += body
        for name, changed in self.described.changed.items():
            self.lines.append(f"inline void {name}(Kept& kept) "
                              f"{{ {self.marks(members(changed))} }}")
        self.pins()
        self.host()
        return "\n".join([*self.lines, "}", ""])
