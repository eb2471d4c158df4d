#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Where bits of a vector are computed from other bits of it, Verilator 5.006 may leave outputs
stale. Only its warning UNOPTFLAT protects from that, so -Wall must give it: as an error, for a
module of seven lines."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402


def main():
    status, text = project.run([project.tool("verilator"), "--lint-only",
                                *project.verilator_flags(), HERE / "vector_from_itself.sv"])
    findings = []
    if "UNOPTFLAT" not in text:
        findings.append("this Verilator does not name UNOPTFLAT any more; does it compute right?")
    if status == 0:
        findings.append("UNOPTFLAT is not an error with the project's flags")
    if findings:
        print(text)
    project.finish(findings, "UNOPTFLAT is reported and stops Verilator")


main()
