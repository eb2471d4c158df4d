#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands that docs/integration.md gives for a board, up to the bitstream.

  check_board.py FOLDER
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402


def main():
    folder = Path(sys.argv[1]).resolve()
    for program in ("yosys", "nextpnr-ice40", "icepack"):
        project.tool(program)
    manual = (project.ROOT / "docs" / "integration.md").read_text(encoding="utf-8")
    section = manual.split("## Pins of a board")[1]
    commands = re.search(r"```sh\n(.*?)```", section, re.S).group(1)
    commands, programs = re.subn(r" && iceprog board\.bin", "", commands)
    if programs != 1:
        raise SystemExit("docs/integration.md: no command that programs the board")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "board.bin").unlink(missing_ok=True)
    for name in ("rtl", "regmap", "tools"):
        link = folder / name
        if not link.is_symlink():
            link.symlink_to(project.ROOT / name)
    status, text = project.run(["bash", "-euc", commands], cwd=folder)
    if status != 0:
        project.finish([text[-4000:]], "")
    pins = len(re.findall(r"^set_io", (project.ROOT / "tools/synth/boards/icebreaker.pcf")
                          .read_text(encoding="utf-8"), re.M))
    placed = len(re.findall(r"constrained '\w+' to bel", text))
    cells = re.search(r"ICESTORM_LC:\s+(\d+)/\s*(\d+)", text)
    size = (folder / "board.bin").stat().st_size
    findings = [] if placed == pins else [f"{placed} of {pins} pins are where the .pcf has them"]
    if cells is None or size < 100000:
        findings.append(f"no bitstream: {size} bytes")
    clocks = re.findall(r"Max frequency for clock\s+'([^']+)': ([\d.]+) MHz", text)
    last = dict(clocks)  # the values behind routing come last
    project.finish(findings, f"{placed} pins, {cells and cells.group(1)} logic cells, " + ", ".join(
        f"{name.split('$')[0]} {mhz} MHz" for name, mhz in last.items()))


main()
