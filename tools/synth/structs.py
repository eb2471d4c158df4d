# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The packed structs of a package: fields, their widths and places."""

import re
from typing import NamedTuple


class Field(NamedTuple):
    name: str
    width: int
    lsb: int
    kind: str  # the type's name, if it is a struct or an enum of the package


class Package:
    """structs {name_t: [Field, the highest first]}, constants {NAME: number} of plain numbers."""

    def __init__(self, path):
        self.path = path
        code = re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))
        self.name = re.search(r"\bpackage\s+(\w+)", code).group(1)
        self.constants = {m.group(1): int(m.group(2)) for m in re.finditer(
            r"\blocalparam\s+int\s+unsigned\s+(\w+)\s*=\s*(\d+)\s*;", code)}
        self.enums = {m.group(2): self._width(m.group(1)) for m in re.finditer(
            r"\btypedef\s+enum\s+logic\s*(\[[^\]]*\])?\s*\{[^}]*\}\s*(\w+)\s*;", code)}
        self.structs = {}
        for match in re.finditer(r"\btypedef\s+struct\s+packed\s*\{([^}]*)\}\s*(\w+)\s*;", code):
            self.structs[match.group(2)] = self._fields(match.group(1))

    def _width(self, *dimensions):
        width = 1
        for text in dimensions:
            if text:
                high, low = (self._number(part) for part in text.strip("[]").split(":"))
                width *= high - low + 1
        return width

    def _number(self, text):
        for name, value in self.constants.items():
            text = re.sub(rf"\b{name}\b", str(value), text)
        if not re.fullmatch(r"[\d\s+*-]+", text):
            raise SystemExit(f"{self.path.name}: the width {text} is no number")
        return eval(text)  # noqa: S307: digits and operators only

    def _fields(self, body):
        rows = []
        for text in filter(None, (part.strip() for part in body.split(";"))):
            match = re.fullmatch(r"(logic|\w+_[te])\s*((?:\[[^\]]*\]\s*)*)(\w+)", text)
            if not match:
                raise SystemExit(f"{self.path.name}: the field '{text}' is not understood")
            kind, dimensions, name = match.groups()
            width = self._width(*re.findall(r"\[[^\]]*\]", dimensions))
            if kind in self.structs:
                width *= sum(field.width for field in self.structs[kind])
            elif kind != "logic":
                width *= self.enums[kind]
            rows.append((name, width, kind if kind != "logic" else ""))
        lsb = sum(width for _, width, _ in rows)
        fields = []
        for name, width, kind in rows:
            lsb -= width
            fields.append(Field(name, width, lsb, kind))
        return fields
