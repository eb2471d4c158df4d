#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The size of biss_clb on iCE40 in LUT4 and flops, and its speed on an HX8K.

  clb_size.py FOLDER [--check|--route]   FOLDER is for what the tools leave. --check: the size against
                                         MOST_LUT4; --route: also the speed against LEAST_MHZ
"""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import project  # noqa: E402
import report  # noqa: E402
import yosys  # noqa: E402

MOST_LUT4 = 650
LEAST_MHZ = 100


def size(folder):
    """LUT4, flops, block RAMs."""
    files = project.listed(project.RTL / "clb" / "clb.f")
    status, text = yosys.execute(
        yosys.read(files) + ["synth_ice40 -top biss_clb -json top.json", "check -assert",
                             "tee -q -o stat.json stat -json"], folder, "synth")
    if status != 0:
        raise SystemExit(text)
    cells = json.loads((folder / "stat.json").read_text(encoding="utf-8"))["design"]["num_cells_by_type"]
    return cells.get("SB_LUT4", 0), report.count(cells, "^SB_DFF"), report.count(cells, "^SB_RAM40")


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", action="store_true")
    what.add_argument("--route", action="store_true")
    arguments = parser.parse_args()
    luts, flops, rams = size(arguments.folder)
    findings = [] if luts <= MOST_LUT4 else [f"biss_clb: {luts} LUT4, wanted {MOST_LUT4} at most"]
    text = f"biss_clb: {luts} LUT4, {flops} flops, {rams} block RAM"
    if arguments.route:
        found = [report.route("biss_clb", arguments.folder, "HX8K", seed)["core"] for seed in report.SEEDS]
        text += f"; HX8K {min(found):.0f}..{max(found):.0f} MHz"
        if min(found) < LEAST_MHZ:
            findings.append(f"biss_clb: {min(found):.0f} MHz, wanted {LEAST_MHZ}")
    project.finish(findings, text)


main()
