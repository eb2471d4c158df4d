#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The price of each extra of biss_axi on iCE40, in LUT4 and flops: the table in docs/axi.md.

  axi_extras.py FOLDER [--check]   FOLDER is for what Yosys leaves. --check: only biss_axi as the
                                   document has it, with one channel, in both stream modes against MOST
"""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import project  # noqa: E402
import yosys  # noqa: E402

MOST = {0: (563, 0), 1: (640, 3)}  # stream mode: LUT4, block RAMs
CHANNELS = (1, 4)
# Name and the value of EXTRAS; each of them but ALIGN_LATCH, the parameter of its own, has the page, bit 0.
EXTRAS = {
    "none": 0, "ALIGN_LATCH": 0, "PAGE": 0x001, "WIDE": 0x003, "ANY_CRC": 0x005, "TIMEOUT": 0x009, "COUNTERS": 0x011,
    "STAMP": 0x021, "ALARM": 0x041, "ACCESS": 0x081, "LAST": 0x201, "FRAME_SAMPLER": 0x401, "all": 0x7FF,
}


def size(extras, channels, folder, align=0, stream=0):
    """LUT4, flops and block RAMs."""
    files = project.rtl_files("axi")
    status, text = yosys.execute(
        yosys.read(files) + yosys.choose("biss_axi", {"EXTRAS": extras, "BISS_CHANNEL_WIDTH": channels,
                                                      "ALIGN_LATCH": align, "STREAM_MODE": stream}) +
        ["synth_ice40 -top biss_axi", "check -assert", "tee -q -o stat.json stat -json"], folder, "synth")
    if status != 0:
        raise SystemExit(text)
    cells = json.loads((folder / "stat.json").read_text(encoding="utf-8"))["design"]["num_cells_by_type"]
    return tuple(sum(n for cell, n in cells.items() if cell.startswith(kind)) for kind in ("SB_LUT4", "SB_DFF", "SB_RAM40"))


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    if arguments.check:
        findings, texts = [], []
        for stream, (most_luts, most_rams) in MOST.items():
            luts, _, rams = size(0, 1, arguments.folder / f"check_{stream}", stream=stream)
            texts.append(f"biss_axi with one channel, stream mode {stream}: {luts} LUT4, {rams} block RAM")
            if luts > most_luts or rams > most_rams:
                findings.append(f"{texts[-1]}; wanted {most_luts} and {most_rams} at most")
        project.finish(findings, "\n".join(texts))
    print("| extra | " + " | ".join(f"N = {n}" for n in CHANNELS) + " |", flush=True)
    base = {}
    for name, bits in EXTRAS.items():
        row = []
        for n in CHANNELS:
            luts, flops, _ = size(bits, n, arguments.folder / f"{name}_{n}", int(name == "ALIGN_LATCH"))
            if name in ("none", "PAGE"):
                base[name, n] = luts, flops
            below = base.get(("none" if name in ("PAGE", "ALIGN_LATCH") else "PAGE", n))
            row.append(f"{luts} / {flops}" if name in ("none", "all")
                       else f"{luts - below[0]:+} / {flops - below[1]:+}")
        print(f"| `{name}` | " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
