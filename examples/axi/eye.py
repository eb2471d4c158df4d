# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The eye of a bad line, as biss_axi measures it in every frame, beside SL laid over itself (docs/cable.md).

  python3 examples/axi/eye.py PICTURE.svg
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "eye", "svg.fonttype": "none"})

import openmb4  # noqa: E402
import openmb4.plot  # noqa: E402

if len(sys.argv) != 2:
    raise SystemExit(__doc__)
with openmb4.Simulator(Path(__file__).resolve().parent / "eye.toml") as chip:
    regs = chip.axi_regs
    for name, value in (("SAMPLE_DIVIDER", 1200), ("MA_DIVIDER", 5), ("POSITION_BITS", 26), ("CRC_CHECK", 1),
                        ("CHANNEL_ENABLE", 1)):
        regs[name].register.write(value)
    chip.advance_ns(200_000)
    regs.EYE_WIDTH.register.read()  # begins EYE_SMALLEST anew
    record = chip.record(("ma0", "slo0"), 149_000)
    word = regs.EYE_WIDTH.register.read()
width, point, smallest = word & 0x1F, word >> 8 & 0x1F, word >> 16 & 0x1F
print(f"eye of the last frame {width} of 10 clocks, smallest {smallest}")
axes = openmb4.plot.eye(record, "ma0", "slo0", measured=(width, point, 10.0))
axes.figure.savefig(sys.argv[1], metadata={"Date": None})
