#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Plain Verilog of each top, for tools that do not read SystemVerilog.

  plain_verilog.py FOLDER   writes FOLDER/TOP.v for each top (mb4_core.v ...): one module each, with
                            the default parameters, made by Yosys from the RTL
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import project  # noqa: E402
import yosys  # noqa: E402

TOPS = ("mb4_core", "mb4_engine", "mb4_chip", "mb4_axil", "mb4_wb")
HEAD = """// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// {top} as plain Verilog (2005), one module, made from the RTL by tools/synth/plain_verilog.py:
// do not edit. Ports: rtl/mb4/{top}.sv; how to use it: docs/integration.md.
`timescale 1ns/1ps

"""


def write(top, folder, files=None, parameters=None):
    """FOLDER/TOP.v of the RTL, or of other files with the same modules; `parameters` of the top are
    integers."""
    path = folder / f"{top}.v"
    chosen = [f"chparam -set {name} {value} {top}" for name, value in (parameters or {}).items()]
    status, text = yosys.execute(
        yosys.read(files) + chosen + [f"hierarchy -check -top {top}", "proc",
                             "flatten", "opt_expr", "opt_clean", "check -assert",
                             f"write_verilog -noattr {path}"], folder, top)
    if status != 0:
        raise SystemExit(f"{top}: {text}")
    path.write_text(HEAD.format(top=top) + path.read_text(encoding="utf-8"), encoding="utf-8")
    (folder / f"{top}.ys").unlink()
    return path


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    for top in TOPS:
        print(write(top, folder))


if __name__ == "__main__":
    main()
