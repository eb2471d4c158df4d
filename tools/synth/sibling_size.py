#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The size of a small master on iCE40 in LUT4 and flops, and its speed on an HX8K.

  sibling_size.py TOP FOLDER [--check|--route]   TOP is biss_clb or biss_pru, FOLDER is for what the tools leave.
                                                 --check: the size against its limit; --route: also the speed
"""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import project  # noqa: E402
import report  # noqa: E402
import yosys  # noqa: E402

# top: room, parameters, most LUT4, least MHz
LIMITS = {"biss_clb": ("clb", {}, 650, 100), "biss_pru": ("pru", {"ClockHz": 80_000_000}, 1100, 80)}


def size(top, folder):
    """LUT4, flops, block RAMs."""
    room, parameters, *_ = LIMITS[top]
    files = project.listed(project.RTL / room / f"{room}.f")
    status, text = yosys.execute(
        yosys.read(files) + [f"chparam -set {name} {value} {top}" for name, value in parameters.items()] +
        [f"synth_ice40 -top {top} -json top.json", "check -assert", "tee -q -o stat.json stat -json"], folder, "synth")
    if status != 0:
        raise SystemExit(text)
    cells = json.loads((folder / "stat.json").read_text(encoding="utf-8"))["design"]["num_cells_by_type"]
    return cells.get("SB_LUT4", 0), report.count(cells, "^SB_DFF"), report.count(cells, "^SB_RAM40")


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("top", choices=LIMITS)
    parser.add_argument("folder", type=parser.folder)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", action="store_true")
    what.add_argument("--route", action="store_true")
    arguments = parser.parse_args()
    top = arguments.top
    *_, most, least = LIMITS[top]
    luts, flops, rams = size(top, arguments.folder)
    findings = [] if luts <= most else [f"{top}: {luts} LUT4, wanted {most} at most"]
    text = f"{top}: {luts} LUT4, {flops} flops, {rams} block RAM"
    if arguments.route:
        found = [report.route(top, arguments.folder, "HX8K", seed)["core"] for seed in report.SEEDS]
        text += f"; HX8K {min(found):.0f}..{max(found):.0f} MHz"
        if min(found) < least:
            findings.append(f"{top}: {min(found):.0f} MHz, wanted {least}")
    project.finish(findings, text)


main()
