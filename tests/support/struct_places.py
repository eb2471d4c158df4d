#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the places of all fields of the structs of packages: struct_places.py OUT.hpp PACKAGE.sv..."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import structs  # noqa: E402


def camel(names):
    return "k" + "".join(part.capitalize() for name in names for part in name.split("_"))


def places(package, struct, above=(), base=0):
    """(names of the fields down to this one, place, width), structs inside a struct too."""
    for field in package.structs[struct]:
        names = (*above, field.name)
        yield names, base + field.lsb, field.width
        if field.kind in package.structs:
            yield from places(package, field.kind, names, base + field.lsb)


def main():
    out, *paths = map(Path, sys.argv[1:])
    lines = ["// Made by tests/support/struct_places.py.", "#ifndef PLACES_HPP_", "#define PLACES_HPP_", "",
             '#include "tests/support/place.hpp"', "", "namespace mb4test::places {"]
    for package in map(structs.Package, paths):
        for struct in package.structs:
            lines += ["", f"namespace {package.name}::{struct} {{"]
            lines += [f"inline constexpr Place {camel(names)}{{{lsb}, {width}}};"
                      for names, lsb, width in places(package, struct)]
            lines.append("}")
    out.write_text("\n".join([*lines, "", "}  // namespace mb4test::places", "", "#endif", ""]), encoding="utf-8")


main()
