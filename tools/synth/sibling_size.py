#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The size of a small master on iCE40 in LUT4 and flops, and its speed on an HX8K.

  sibling_size.py TOP FOLDER [--check|--route]   TOP has `size` in masters.toml, FOLDER is for what the tools leave.
                                                 --check: the size against its limit; --route: also the speed
"""

import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import project  # noqa: E402
import report  # noqa: E402


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("top", choices=report.SIBLINGS)
    parser.add_argument("folder", type=parser.folder)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", action="store_true")
    what.add_argument("--route", action="store_true")
    arguments = parser.parse_args()
    top, one = arguments.top, report.SIBLINGS[arguments.top].size
    luts, flops, rams = report.sibling_size(top, arguments.folder)
    findings = [] if luts <= one.lut4 else [f"{top}: {luts} LUT4, wanted {one.lut4} at most"]
    text = f"{top}: {luts} LUT4, {flops} flops, {rams} block RAM"
    if arguments.route:
        found = report.sibling_speed(top, arguments.folder)
        text += f"; HX8K {min(found):.0f}..{max(found):.0f} MHz"
        if min(found) < one.mhz:
            findings.append(f"{top}: {min(found):.1f} MHz, wanted {one.mhz}")
        if statistics.median(found) < one.median:
            findings.append(f"{top}: {statistics.median(found):.1f} MHz in the middle of the seeds, wanted {one.median}")
    project.finish(findings, text)


main()
