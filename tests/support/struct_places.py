#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the places of all fields of the structs of packages: struct_places.py OUT.hpp PACKAGE.sv..."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import sv_widths  # noqa: E402


def camel(names):
    return "k" + "".join(part.capitalize() for name in names for part in name.split("_"))


def places(structs, kind, above=(), base=0):
    """(names of the fields down to this one, place, width), structs inside a struct too."""
    for field in structs[kind]:
        names = (*above, field.name)
        yield names, base + field.lsb, field.width
        if field.kind:
            yield from places(structs, field.kind, names, base + field.lsb)


def main():
    out, *paths = map(Path, sys.argv[1:])
    lines = ["// Made by tests/support/struct_places.py.", "#ifndef PLACES_HPP_", "#define PLACES_HPP_", "",
             '#include "tests/support/place.hpp"', "", "namespace mb4test::places {"]
    structs = sv_widths.read_packages(paths).structs
    for kind in structs:
        lines += ["", f"namespace {kind} {{"]
        lines += [f"inline constexpr Place {camel(names)}{{{lsb}, {width}}};" for names, lsb, width in places(structs, kind)]
        lines += [f"inline constexpr unsigned kAllBits = {max(f.lsb + f.width for f in structs[kind])};", "}"]
    out.write_text("\n".join([*lines, "", "}  // namespace mb4test::places", "", "#endif", ""]), encoding="utf-8")


main()
