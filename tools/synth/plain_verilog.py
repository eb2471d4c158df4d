#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Plain Verilog of each top, for tools that do not read SystemVerilog.

  plain_verilog.py FOLDER [PRESET]   writes FOLDER/TOP.v for each top (mb4_core.v ...): one module each, made
                                     by Yosys from the RTL; with the default parameters, or those of a preset
  plain_verilog.py FOLDER --top TOP [--set NAME=NUMBER]...   writes that of one top, with these parameters
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import project  # noqa: E402
import yosys  # noqa: E402

TOPS = project.tops("plain")
HEAD = """// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// {top} as plain Verilog (2005), {features}one module, made from the RTL by tools/synth/plain_verilog.py:
// do not edit. Ports: {source}; how to use it: docs/integration.md.
`timescale 1ns/1ps

"""
# What tools ask of synchronisers stays; Yosys' own attributes go.
KEPT = re.findall(r"(\w+) = ", (project.INCLUDE / "enc_sync.svh").read_text(encoding="utf-8").partition("`define")[2])
OTHERS = rf"\(\* \\?(?!(?:{'|'.join(KEPT)}) )[^\n]*?\*\)"
ATTRIBUTE = re.compile(rf"^ *{OTHERS}\n|{OTHERS} ?", re.M)

# In the names of variables of functions: the file stays, its folder goes.
PLACE = re.compile(r"\$func\$/\S*/(?=[\w.]+:\d+\$)")


def write(top, folder, files=None, parameters=None, preset="full"):
    """FOLDER/TOP.v of the RTL (a top, or a module below one), or of other files with the same modules; its
    `parameters` are integers."""
    path = folder / f"{top}.v"
    values, features = dict(parameters or {}), ""
    if values and preset == "full":
        features = ", ".join(f"{name} = {value}" for name, value in values.items()) + ", "
    if preset != "full":
        values["Features"] = project.presets()[preset]
        features = f"preset {preset}, "
    named = [f"rename -top {top}"] if values else []
    status, text = yosys.execute(
        yosys.read(project.files_of(top) if files is None else files) + yosys.choose(top, values) + [f"hierarchy -check -top {top}", "proc",
                             "flatten", "opt_expr", "opt_clean", "check -assert",
                             *named, f"write_verilog {path}"], folder, top)
    if status != 0:
        raise SystemExit(f"{top}: {text}")
    head = HEAD.format(top=top, features=features, source=project.rtl_modules()[top].relative_to(project.ROOT))
    text = PLACE.sub("$func$", ATTRIBUTE.sub("", path.read_text(encoding="utf-8")))
    path.write_text(head + text, encoding="utf-8")
    (folder / f"{top}.ys").unlink()
    return path


def setting(text):
    name, _, value = text.partition("=")
    return name, int(value, 0)


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("preset", nargs="?", default="full", choices=project.presets())
    parser.add_argument("--top", choices=TOPS)
    parser.add_argument("--set", type=setting, action="append", default=[], metavar="NAME=NUMBER")
    arguments = parser.parse_args()
    if arguments.set and not arguments.top:
        parser.error("--set goes with --top")
    for top in [arguments.top] if arguments.top else TOPS:
        if arguments.preset != "full" and not TOPS[top].master.presets:
            continue
        print(write(top, arguments.folder, parameters=dict(arguments.set), preset=arguments.preset))


if __name__ == "__main__":
    main()
