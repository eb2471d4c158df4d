#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Wrong parameters of biss_axi stop the elaboration in Verilator and in Yosys, and the text names the right
number. Right ones, also those written out for tools without formulas, pass.

  check_axi_parameters.py FOLDER   FOLDER is for what the tools leave

Exit status 77: a tool is missing.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools" / "synth"))

import project  # noqa: E402
import yosys  # noqa: E402

WIDE = 2  # EXTRAS

# (parameters, what both tools say)
WRONG = [
    ({"S_AXIS_TDATA_WIDTH": 64}, "S_AXIS_TDATA_WIDTH must be 32 here"),
    ({"BISS_CHANNEL_WIDTH": 4, "S_AXIS_TDATA_WIDTH": 32}, "S_AXIS_TDATA_WIDTH must be 128 here"),
    ({"BISS_CHANNEL_WIDTH": 4, "S_AXIS_TUSER_WIDTH": 1}, "S_AXIS_TUSER_WIDTH must be 4 here"),
    ({"EXTRAS": WIDE, "S_AXIS_TDATA_WIDTH": 32}, "S_AXIS_TDATA_WIDTH must be 64 here"),
    ({"BISS_CHANNEL_WIDTH": 15, "EXTRAS": WIDE, "S_AXIS_TDATA_WIDTH": 480},
     "S_AXIS_TDATA_WIDTH must be 960 here"),
    ({"STREAM_MODE": 1, "S_AXIS_TUSER_WIDTH": 1}, "S_AXIS_TUSER_WIDTH must be 16 here"),
    ({"STREAM_MODE": 1, "BISS_CHANNEL_WIDTH": 4, "S_AXIS_TDATA_WIDTH": 128},
     "S_AXIS_TDATA_WIDTH must be 32 here"),
    ({"STREAM_MODE": 1, "STREAM_WIDTH": 64, "S_AXIS_TDATA_WIDTH": 32},
     "S_AXIS_TDATA_WIDTH must be 64 here"),
    ({"STREAM_MODE": 1, "EXTRAS": WIDE}, "STREAM_WIDTH must be 64 here"),
    ({"STREAM_MODE": 1, "STREAM_WIDTH": 48}, "STREAM_WIDTH is 32 or 64"),
    ({"STREAM_MODE": 2}, "STREAM_MODE is 0 or 1"),
    ({"STREAM_MODE": 1, "BISS_CHANNEL_WIDTH": 5, "STREAM_DEPTH": 4},
     "STREAM_DEPTH must be at least BISS_CHANNEL_WIDTH"),
    ({"STREAM_MODE": 1, "STREAM_DEPTH": 12}, "Depth is a power of 2"),
    ({"EXTRAS": 2048}, "EXTRAS has 11 bits"),
    ({"BISS_CHANNEL_WIDTH": 17}, "Channels is 1 to 16"),
    ({"TIMEOUT_LIMIT": 0}, "TimeoutLimit is 1 to 1048575"),
    ({"TIMEOUT_LIMIT": 1_048_576}, "TimeoutLimit is 1 to 1048575"),
    ({"START_LIMIT": 0}, "StartLimit is 1 to 4095"),
    ({"START_LIMIT": 4096}, "StartLimit is 1 to 4095"),
]
RIGHT = [
    {},
    {"BISS_CHANNEL_WIDTH": 4, "S_AXIS_TDATA_WIDTH": 128, "S_AXIS_TUSER_WIDTH": 4},
    {"BISS_CHANNEL_WIDTH": 16, "EXTRAS": WIDE, "S_AXIS_TDATA_WIDTH": 1024, "S_AXIS_TUSER_WIDTH": 16},
    {"BISS_CHANNEL_WIDTH": 16, "STREAM_MODE": 1, "S_AXIS_TDATA_WIDTH": 32, "S_AXIS_TUSER_WIDTH": 16},
    {"STREAM_MODE": 1, "EXTRAS": WIDE, "STREAM_WIDTH": 64},
    {"EXTRAS": WIDE, "STREAM_WIDTH": 32},
]


def said(parameters, folder):
    """{tool: (passed, text)}"""
    files = project.rtl_files("axi")
    status, text = project.run(
        [project.tool("verilator"), "--lint-only",
         *project.verilator_flags(),  # -fno-const-bit-op-tree among them
         f"-I{project.INCLUDE}", "--top-module", "biss_axi", *(f"-G{name}={value}" for name, value in parameters.items()),
         project.WAIVERS, *files])
    found = {"Verilator": (status == 0, text)}
    status, text = yosys.execute(yosys.read(files) + yosys.choose("biss_axi", parameters) +
                                 ["hierarchy -check -top biss_axi"], folder, "elaborate")
    found["Yosys"] = (status == 0, text)
    return found


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    findings = []
    for parameters, wanted in WRONG:
        for tool, (passed, text) in said(parameters, folder).items():
            if passed or wanted not in text:
                findings.append(f"{tool}, {parameters}: '{wanted}' is not said: {text[-300:]}")
    for parameters in RIGHT:
        for tool, (passed, text) in said(parameters, folder).items():
            if not passed:
                findings.append(f"{tool}, {parameters}: {text[-300:]}")
    project.finish(findings, f"{len(WRONG)} wrong sets of parameters are named, {len(RIGHT)} right ones pass")


main()
