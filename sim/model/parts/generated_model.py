# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the C++ that Verilator 5.006 writes for a model: its statements, and what each of them
reads and writes.

This module understands only these forms: functions of assignments and conditionals without loops,
over members of the model (vlSelf->NAME) and local variables. Any other form raises
NotUnderstood."""

import re
from collections import defaultdict
from dataclasses import dataclass, field

TYPE = re.compile(r"^(CData|SData|IData|QData|VlWide<\d+>)/\*(\d+):\d+\*/ (\w+);$")
STRING = re.compile(r'"(?:\\.|[^"\\])*"')
NAME = re.compile(r"vlSelf->([A-Za-z_]\w*)|(?<![\w>.])([A-Za-z_]\w*)")
# These functions change no variable. Their result depends on their arguments (up to 64 bits) alone.
PURE = re.compile(r"VL_(?:WRITEF|STOP_MT|UNLIKELY|LIKELY|TIME_UNITED_Q|REDXOR_\w+|"
                  r"(?:ONEHOT0?|COUNTONES|SHIFT\w+|[GL]TE?S?|EXTENDS?)_[IQ]+)$|"
                  r"\w+__(?:ConstPool__\w+|lines)$")
COMPARED = re.compile(r"\((0x[0-9a-f]+|\d+)U\s*[!=]=\s*"
                      r"(?:\(IData\)\(vlSelf->(\w+)\)|vlSelf->(\w+))\)")
KNOWN = {"if", "else", "U", "IData", "QData", "CData", "SData", "vlSelf", "vlSymsp", "Verilated"}
LONG = 1500  # characters; a longer conditional is taken apart


class NotUnderstood(Exception):
    pass


@dataclass
class Statement:
    text: str
    function: str
    reads: set = field(default_factory=set)
    looks: set = field(default_factory=set)  # (name read, None or a number to compare with)
    writes: set = field(default_factory=set)
    defines: set = field(default_factory=set)  # written completely in every case
    arrays: set = field(default_factory=set)  # written, but only in some elements


def sources(folder, prefix):
    """The model's files of functions. Verilator's last list counts, so older files are left out."""
    named = (folder / f"{prefix}.cmake").read_text(encoding="utf-8")
    return [folder / name for name in sorted(set(
        re.findall(rf'/({prefix}___024root__DepSet_\w+\.cpp)"', named)))]


def functions(folder, prefix):
    """{name: body} of all functions of the model without arguments."""
    pattern = re.compile(rf"^(?:VL_INLINE_OPT )?void {prefix}___024root___(\w+)"
                         rf"\({prefix}___024root\* vlSelf\) \{{\n(.*?)^\}}", re.M | re.S)
    found = {}
    for path in sources(folder, prefix):
        if not path.name.endswith("__Slow.cpp"):
            found.update((name, in_words(body))
                         for name, body in pattern.findall(path.read_text(encoding="utf-8")))
    return found


def in_words(body):
    """A body in which a wide local variable is one variable for each word, if it is only used by
    words of constant number."""
    for words, name in re.findall(r"^\s*VlWide<(\d+)>/\*\d+:\d+\*/ (\w+);$", body, re.M):
        head, _, rest = body.partition("// Body\n")
        if re.search(rf"(?<!>)\b{name}\b(?!\[\d+U\])", rest):
            continue
        head = re.sub(rf"^(\s*)VlWide<\d+>/\*\d+:\d+\*/ {name};$",
                      lambda row: "\n".join(f"{row[1]}IData/*31:0*/ {name}__{word};"
                                            for word in range(int(words))), head, flags=re.M)
        head = re.sub(rf"^\s*VL_ZERO_W\(\d+, {name}\);\n", "", head, flags=re.M)
        body = head + "// Body\n" + re.sub(rf"(?<!>)\b{name}\[(\d+)U\]", rf"{name}__\1", rest)
    return body


def constants(folder, prefix):
    """Declarations of the model's tables."""
    pattern = re.compile(r"^extern const [^;]*__(?:ConstPool__\w+|lines\[\]);$", re.M)
    return sorted({line for path in sources(folder, prefix)
                   for line in pattern.findall(path.read_text(encoding="utf-8"))})


def triggers(folder, prefix):
    """{index: [events]} of the model, as its debug output lists them."""
    pattern = re.compile(r"'act' region trigger index (\d+) is active: @\((.*?)\)\\n")
    found = {int(index): events.split(" or ")
             for path in sources(folder, prefix) if path.name.endswith("__Slow.cpp")
             for index, events in pattern.findall(path.read_text(encoding="utf-8"))}
    for event in sum(found.values(), []):
        if not re.match(r"(?:pos|neg)edge [\w.]+$", event):
            raise NotUnderstood(f"event {event}")
    return found


def widths(folder, prefix, bodies):
    """{name: bits} of the model's variables and of the local ones."""
    text = (folder / f"{prefix}___024root.h").read_text(encoding="utf-8")
    rows = [("", row) for row in text.splitlines()]
    rows += [(f"{name}.", row) for name, body in bodies.items() for row in body.splitlines()]
    found = {scope + row[3]: int(row[2]) + 1
             for scope, row in ((scope, TYPE.match(row.strip())) for scope, row in rows) if row}
    return found | {name: int(bits) + 1 for name, bits in
                    re.findall(r"^\s+VL_(?:IN|OUT)(?:8|16)?\((\w+),(\d+),0\);", text, re.M)}


def places(folder, prefix):
    """{name: place} of the model's variables in the order of their declarations."""
    text = (folder / f"{prefix}___024root.h").read_text(encoding="utf-8")
    names = re.findall(r"^\s+(?:VL_(?:IN|OUT)\w*\((\w+),\d+,\d+\)|\S.* (\w+));$", text, re.M)
    return {pin or name: place for place, (pin, name) in enumerate(names)}


def after_string(text, at):
    return STRING.match(text, at).end()


def closing(text, at):
    """Place of the bracket that closes the one at `at`."""
    depth = 0
    while True:
        if text[at] == '"':
            at = after_string(text, at)
            continue
        depth += (text[at] in "({[") - (text[at] in ")}]")
        if depth == 0:
            return at
        at += 1


def split(body):
    """The statements of a body, one after the other."""
    at = 0
    skip = re.compile(r"(?:\s+|//[^\n]*\n)+")
    otherwise = re.compile(r"\s*else\b")
    while True:
        blank = skip.match(body, at)
        at = blank.end() if blank else at
        if at >= len(body):
            return
        start = at
        while True:
            if body[at] == '"':
                at = after_string(body, at)
            elif body.startswith("/*", at):
                at = body.index("*/", at) + 2
            elif body.startswith("//", at):
                at = body.index("\n", at)
            elif body[at] in "([{":
                block = body[at] == "{"
                at = closing(body, at) + 1
                more = otherwise.match(body, at)
                if block and not more:
                    break
                at = more.end() if block else at
            elif body[at] == ";":
                at += 1
                break
            else:
                at += 1
        yield body[start:at]


def branches(text):
    """(condition, statements, statements of the else branch) of a conditional; None otherwise."""
    if not text.startswith("if ("):
        return None
    end = closing(text, 3)
    opening = text.index("{", end)
    close = closing(text, opening)
    rest = text[close + 1:].strip()
    if rest:
        rest = rest.removeprefix("else").strip()
        if rest.startswith("{"):
            rest = rest[1:-1]
    return text[3:end + 1], text[opening + 1:close], rest


def subscripts_end(text, at):
    """(place after the subscripts that follow a name, whether there are any)."""
    some = False
    while True:
        found = re.compile(r"\s*(?:\[|\.at\()").match(text, at)
        if not found:
            return at, some
        at = closing(text, found.end() - 1) + 1
        some = True


def analyse(text, function, local):
    """The statement with its names. A local variable is FUNCTION.NAME."""
    statement = Statement(text, function)
    bare = re.sub(r"/\*.*?\*/|//[^\n]*", "", STRING.sub('""', text))
    if re.search(r"vlSymsp->(?!_vm_contextp__|name\(\))", bare):
        raise NotUnderstood(f"{function}: another scope: {bare[:80]}")
    numbers = {found.start(found.lastindex) - len("vlSelf->"): int(found[1], 0)
               for found in COMPARED.finditer(bare)}
    for found in NAME.finditer(bare):
        member, word = found.groups()
        if member is None and word not in local:
            if word not in KNOWN and not PURE.match(word):
                raise NotUnderstood(f"{function}: {word}")
            continue
        name = member or f"{function}.{word}"
        end, some = subscripts_end(bare, found.end())
        if re.compile(r"\s*=(?!=)").match(bare, end):
            statement.writes.add(name)
            if some:
                statement.arrays.add(name)
            if not some and found.start() == 0:
                statement.defines.add(name)
        else:
            if re.compile(r"\s*(?:[-+*/%&|^]=|\+\+|--|<<=|>>=)").match(bare, end):
                raise NotUnderstood(f"{function}: {bare[found.start():end + 4]}")
            statement.reads.add(name)
            statement.looks.add((name, numbers.get(found.start())))
    if parts := branches(text):
        statement.defines = set.intersection(*(
            set().union(*(analyse(piece, function, local).defines for piece in split(side)))
            for side in parts[1:]))
    return statement


def apart(text, function, local, long=LONG):
    """Splits a long conditional into several ones that do not depend on each other."""
    parts = branches(text) if len(text) > long and "VL_WRITEF" not in text else None
    if not parts:
        return [text]
    condition, *sides = parts
    rows = [(side, piece, analyse(piece, function, local)) for side, body in enumerate(sides)
            for inner in split(body) for piece in apart(inner, function, local, long)]
    if analyse(f"if {condition} {{}}", function, local).reads & {
            name for _, _, row in rows for name in row.writes}:
        return [text]
    kind = list(range(len(rows)))
    for i, (side, _, one) in enumerate(rows):
        for j in range(i):
            other = rows[j][2]
            linked = one.writes & other.writes
            if rows[j][0] == side:
                linked = linked or one.writes & other.reads or one.reads & other.writes
            if linked:
                kind = [kind[i] if k == kind[j] else k for k in kind]
    classes = defaultdict(lambda: ("", ""))
    for k, (side, piece, _) in zip(kind, rows):
        both = list(classes[k])
        both[side] += piece + "\n"
        classes[k] = tuple(both)
    return [f"if {condition} {{ {yes} }}" + (f" else {{ {no} }}" if no else "")
            for yes, no in classes.values()]


def statements(name, body, long=LONG):
    """({local variable: type}, [statements]) of a function."""
    head, body = body.split("// Body\n", 1)
    local = {row[3]: row[1] for row in map(TYPE.match, map(str.strip, head.splitlines())) if row}
    found = [analyse(piece, name, local) for text in split(body)
             for piece in apart(text, name, local, long)]
    # Local variables start at zero. This matters only if they are read, or written in part, first.
    for variable, kind in local.items():
        wide = "{}" if kind.startswith("VlWide") else 0
        first = next((row for row in found if f"{name}.{variable}" in row.reads | row.writes), None)
        if first and f"{name}.{variable}" not in first.defines - first.reads:
            found.insert(0, analyse(f"{variable} = {wide};", name, local))
    return {f"{name}.{key}": kind for key, kind in local.items()}, found
