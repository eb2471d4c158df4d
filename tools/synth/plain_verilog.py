#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Plain Verilog of each top, for tools that do not read SystemVerilog.

  plain_verilog.py FOLDER [PRESET]   writes FOLDER/TOP.v for each top (mb4_core.v ...): one module each, made
                                     by Yosys from the RTL; with the default parameters, or those of a preset
"""

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


def write(top, folder, files=None, parameters=None, preset="full"):
    """FOLDER/TOP.v of the RTL (a top, or a module below one), or of other files with the same modules; its
    `parameters` are integers."""
    path = folder / f"{top}.v"
    values, features = dict(parameters or {}), ""
    if preset != "full":
        values["Features"] = project.presets()[preset]
        features = f"preset {preset}, "
    named = [f"rename -top {top}"] if values else []
    status, text = yosys.execute(
        yosys.read(project.files_of(top) if files is None else files) + yosys.choose(top, values) + [f"hierarchy -check -top {top}", "proc",
                             "flatten", "opt_expr", "opt_clean", "check -assert",
                             *named, f"write_verilog -noattr {path}"], folder, top)
    if status != 0:
        raise SystemExit(f"{top}: {text}")
    head = HEAD.format(top=top, features=features, source=project.rtl_modules()[top].relative_to(project.ROOT))
    path.write_text(head + path.read_text(encoding="utf-8"), encoding="utf-8")
    (folder / f"{top}.ys").unlink()
    return path


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("preset", nargs="?", default="full", choices=project.presets())
    arguments = parser.parse_args()
    for top in TOPS:
        if arguments.preset != "full" and not TOPS[top].master.presets:
            continue
        print(write(top, arguments.folder, preset=arguments.preset))


if __name__ == "__main__":
    main()
