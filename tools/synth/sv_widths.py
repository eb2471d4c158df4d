# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Port widths computed from the SystemVerilog source, by neither Yosys nor Verilator.

Understands what the written subset allows in packages and module headers: integer and vector
constants, packed structs, enums, vectors with any number of packed dimensions. Anything else raises
an error, so that a construct this reader does not know never passes as checked."""

import re
from typing import NamedTuple

TYPE_WORDS = {"logic": 1, "bit": 1, "wire": 1, "reg": 1, "int": 32, "integer": 32, "byte": 8}


class WidthError(Exception):
    pass


class Field(NamedTuple):
    """A member of a packed struct, and the place of its lowest bit."""
    name: str
    width: int
    lsb: int
    kind: str  # the struct that it is, or ""


def without_comments(text):
    """Source without comments; line breaks stay."""
    text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m.group(0).count("\n"), text, flags=re.S)
    return re.sub(r"//[^\n]*", "", text)


def strip_comments(text):
    """Source without comments and compiler directives; line breaks stay."""
    return re.sub(r"^\s*`[^\n]*", "", without_comments(text), flags=re.M)


def clog2(value):
    return max(value - 1, 0).bit_length()


def literal(match):
    base = {"h": 16, "d": 10, "b": 2, "o": 8}[match.group(1).lower()]
    return str(int(match.group(2).replace("_", ""), base))


class Scope:
    """Names with a value or a width: packages, and one module's parameters and types."""

    def __init__(self):
        self.values = {}
        self.types = {}
        self.structs = {}  # name of the type: its fields, the highest first

    def value(self, text, prefix=""):
        """An integer constant expression."""
        source = text.strip()
        source = re.sub(r"(?:\d+\s*)?'s?([hdbo])\s*([0-9a-f_]+)", literal, source, flags=re.I)
        source = re.sub(r"'([01])\b", r"\1", source)
        source = re.sub(r"\b(\w+(?:::\w+)?)\[([^]]+)\]", r"((\1 >> (\2)) & 1)", source)  # one bit
        choice = re.fullmatch(r"([^?]+)\?([^:]+):(.+)", re.sub(r"::", "\0", source), re.S)
        if choice:
            test, yes, no = (part.replace("\0", "::") for part in choice.groups())
            return self.value(yes if self.value(test, prefix) else no, prefix)
        source = source.replace("$clog2", "clog2_")

        def name(match):
            word = match.group(0)
            if word == "clog2_":
                return word
            for key in (word, prefix + word):
                if key in self.values:
                    return f"({self.values[key]})"
            raise WidthError(f"no constant {word} in: {text.strip()}")

        source = re.sub(r"[A-Za-z_][\w]*(?:::\w+)?", name, source).replace("/", "//")
        source = source.replace("&&", " and ").replace("||", " or ")
        if not re.fullmatch(r"[\d\s()+\-*/%<>=&|^,]*(?:(?:clog2_|and|or)[\d\s()+\-*/%<>=&|^,]*)*",
                            source):
            raise WidthError(f"expression not understood: {text.strip()}")
        return int(eval(source, {"__builtins__": {}}, {"clog2_": clog2}))  # digits and operators

    def width(self, text, prefix=""):
        """Bits of a type: base word or typedef, signing, packed dimensions."""
        match = re.fullmatch(r"\s*(?:(\w+(?:::\w+)?)\s*)?(?:(?:un)?signed\b)?\s*"
                             r"((?:\[[^]]*\]\s*)*)", text)
        if not match:
            raise WidthError(f"type not understood: {text.strip()}")
        base, dimensions = match.group(1) or "logic", match.group(2)
        if base in ("signed", "unsigned"):
            base = "logic"
        for key in (base, prefix + base):
            if key in TYPE_WORDS or key in self.types:
                bits = TYPE_WORDS.get(key) or self.types[key]
                break
        else:
            raise WidthError(f"no type {base}")
        for dimension in re.findall(r"\[([^]]*)\]", dimensions):
            ends = re.split(r"(?<!:):(?!:)", dimension)
            if len(ends) != 2:
                raise WidthError(f"dimension not understood: {text.strip()}")
            bits *= abs(self.value(ends[0], prefix) - self.value(ends[1], prefix)) + 1
        return bits

    def read_declarations(self, text, prefix=""):
        """localparam and typedef statements, in their order."""
        pattern = re.compile(
            r"\blocalparam\b\s*(?P<decl>[^;]*);"
            r"|\btypedef\s+struct\s+packed\s*\{(?P<members>[^}]*)\}\s*(?P<struct>\w+)\s*;"
            r"|\btypedef\s+enum\s*(?P<base>[^{]*)\{[^}]*\}\s*(?P<enum>\w+)\s*;"
            r"|\btypedef\s+(?P<plain>[^;{]*?)\s*\b(?P<alias>\w+)\s*;"
            r"|\b(?P<other>typedef)\b")
        for match in pattern.finditer(text):
            if match["decl"]:
                self.constant(match["decl"], prefix)
            elif match["struct"]:
                fields = self.fields(match["members"], prefix)
                self.structs[prefix + match["struct"]] = fields
                self.types[prefix + match["struct"]] = sum(field.width for field in fields)
            elif match["enum"]:
                self.types[prefix + match["enum"]] = self.width(match["base"] or "int", prefix)
            elif match["alias"]:
                self.types[prefix + match["alias"]] = self.width(match["plain"], prefix)
            else:
                raise WidthError(f"typedef not understood: {text[match.start():][:60]!r}")

    def fields(self, text, prefix):
        """The members of a struct, the highest first; several names in a line allowed."""
        rows = []
        for member in filter(str.strip, text.split(";")):
            match = re.fullmatch(r"\s*(.*?)((?:\b\w+\s*,\s*)*\b\w+)\s*", member, re.S)
            if not match:
                raise WidthError(f"struct member not understood: {member.strip()}")
            kind = match.group(1).strip()
            kind = next((key for key in (kind, prefix + kind) if key in self.structs), "")
            rows += [(name.strip(), self.width(match.group(1), prefix), kind) for name in match.group(2).split(",")]
        lsb = sum(width for _, width, _ in rows)
        fields = []
        for name, width, kind in rows:
            lsb -= width
            fields.append(Field(name, width, lsb, kind))
        return fields

    def constant(self, text, prefix, given=None):
        """One parameter or localparam; `given` replaces its value."""
        match = re.fullmatch(r"\s*(.*?)\b(\w+)\s*=\s*(.*)", text, re.S)
        if not match:
            raise WidthError(f"constant not understood: {text.strip()}")
        name = prefix + match.group(2)
        value = (given or {}).get(match.group(2))
        self.values[name] = self.value(match.group(3), prefix) if value is None else value


def read_packages(paths):
    scope = Scope()
    for path in paths:
        text = strip_comments(path.read_text(encoding="utf-8"))
        package = re.search(r"\bpackage\s+(\w+)\s*;(.*)\bendpackage\b", text, re.S)
        scope.read_declarations(package.group(2), package.group(1) + "::")
    return scope


def width_constants(scope):
    """(constant, its value, type, its width) for each pair pkg::NAME_W, pkg::name_t."""
    pairs = []
    for name, value in scope.values.items():
        kind = re.sub(r"(\w+)_W$", lambda m: m.group(1).lower() + "_t", name)
        if kind in scope.types:
            pairs.append((name, value, kind, scope.types[kind]))
    return pairs


def place_constants(scope):
    """(constant, its value, field, its place) for each pair pkg::NAME_FIELD, pkg::name_t.field."""
    pairs = []
    for kind, fields in scope.structs.items():
        for field in fields:
            package, _, name = kind.removesuffix("_t").rpartition("::")
            constant = f"{package}::{name.upper()}_{field.name.upper()}"
            if constant in scope.values:
                pairs.append((constant, scope.values[constant], f"{kind}.{field.name}", field.lsb))
    return pairs


def split_commas(text):
    """Parts of a list, commas inside brackets not counted."""
    parts, depth = [""], 0
    for char in text:
        depth += (char in "([{") - (char in ")]}")
        if char == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += char
    return [part for part in parts if part.strip()]


def module_header(path):
    """Texts of the parameters and of the ports of the module in a file."""
    text = strip_comments(path.read_text(encoding="utf-8"))
    header = re.search(r"\bmodule\s+(\w+)\s*(?:#\s*\((.*?)\)\s*)?\(([^;]*)\)\s*;", text, re.S)
    if not header:
        raise WidthError(f"{path.name}: module header not understood")
    return header.group(2) or "", header.group(3)


def parameter_names(path):
    """The parameters of the module in a file."""
    return [re.search(r"(\w+)\s*=", part)[1] for part in split_commas(module_header(path)[0])
            if part.split()[0] == "parameter"]


def port_names(path):
    return [part.split()[-1] for part in split_commas(module_header(path)[1])]


def module_ports(path, packages, parameters=None):
    """{port: (direction, width)} of the module in a file, with the given parameter values."""
    given, listed = module_header(path)
    scope = Scope()
    scope.values = dict(packages.values)
    scope.types = dict(packages.types)
    for part in split_commas(given):
        words = part.strip()
        local = words.startswith("localparam")
        try:
            scope.constant(re.sub(r"^(parameter|localparam)\b", "", words), "",
                           None if local else parameters)
        except WidthError:
            pass  # a port whose width needs this one is an error
    ports = {}
    for part in split_commas(listed):
        port = re.fullmatch(r"\s*(input|output|inout)\b(.*?)\b(\w+)\s*", part, re.S)
        if not port:
            raise WidthError(f"{path.name}: port not understood: {part.strip()}")
        ports[port.group(3)] = (port.group(1), scope.width(port.group(2)))
    return ports


def module_parameters(path):
    """{name: (type, default, comment)} of a module's parameters, with the texts of the source."""
    head = path.read_text(encoding="utf-8").split(") (\n")[0]
    return {name: (kind, " ".join(value.split()), said) for kind, name, value, said in re.findall(
        r"^  parameter (int unsigned|bit) +(\w+) *=\s*([^/]*?),?(?: *// (.*))?$", head, re.M)}


def parameter_vectors(path):
    """{port: text of its highest bit} of the ports whose width depends on a parameter."""
    return {name: left for left, name in re.findall(
        r"^  (?:input|output) +logic \[(\w*[A-Z]\w*-1):0\] *(\w+)", path.read_text(encoding="utf-8"),
        re.M)}


def lowest_bits(path):
    """{port: its lowest bit} of the ports that do not begin with bit 0."""
    return {name: int(low) for low, name in re.findall(
        r"^  (?:input|output) +logic \[[^]:]+:([1-9]\d*)\] *(\w+)", path.read_text(encoding="utf-8"), re.M)}
