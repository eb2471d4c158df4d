# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The cocotb examples pass on the release's Verilog, and fail on Verilog with a fault:
cocotb_test.py PACKAGE PYTHON FOLDER TOP. Exit status 77: PYTHON has no cocotb, or not what TOP needs."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
package, python, folder, top = sys.argv[1:]

# Packages of Python; the fault, which fails every test of the bench.
NEEDS = {"mb4_core": "cocotb", "mb4_axil": "cocotbext.axi", "mb4_wb": "cocotbext.wishbone",
         "biss_axi": "cocotbext.axi", "dsl_axil": "cocotbext.axi"}
FAULT = {"mb4_core": (r"(?m)^(\s*assign ma1_o = ).*;$", r"\1 1'b1;"),  # MA never moves
         "mb4_axil": (r"(?m)^(\s*assign s_axi_rdata = )(.*);$", r"\1 (\2) ^ 32'h10;"),
         "mb4_wb": (r"(?m)^(\s*assign wb_dat_o = )(.*);$", r"\1 (\2) ^ 32'h10;"),
         "biss_axi": (r"(?m)^(\s*assign S_AXI_RDATA = )(.*);$", r"\1 (\2) ^ 32'h1;"),
         "dsl_axil": (r"(?m)^(\s*assign s_axi_rdata = )(.*);$", r"\1 (\2) ^ 32'h3;")}
# Two channels; a beat for each, through a short FIFO; the counters and the page.
PARAMETERS = {"biss_axi": {"BISS_CHANNEL_WIDTH": 2, "STREAM_MODE": 1, "STREAM_DEPTH": 4, "EXTRAS": 0x11}}
MASTERS = {"biss_axi": "axi", "dsl_axil": "dsl"}


def main():
    needs = f"import cffi, cocotb, numpy, tqdm, {NEEDS[top]}"
    if not Path(python).exists() or subprocess.run([python, "-c", needs], check=False,
                                                   capture_output=True).returncode:
        print("skipped: no cocotb; python3 -m venv build/cocotb && build/cocotb/bin/pip install "
              "cocotb==2.1.0 cffi numpy tqdm cocotbext-axi==0.1.28 cocotbext-wishbone==2.0.1")
        return 77
    sys.path.insert(0, str(ROOT / "tools/synth"))
    import plain_verilog
    out = Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    if top in MASTERS:
        files = plain_verilog.project.rtl_files(MASTERS[top])
        good = plain_verilog.write(top, out, files, PARAMETERS.get(top, {}))
    else:
        good = plain_verilog.write(top, out)
    text, count = re.subn(*FAULT[top], good.read_text(encoding="utf-8"))
    bad = out / "fault" / good.name
    bad.parent.mkdir(exist_ok=True)
    bad.write_text(text, encoding="utf-8")
    assert count == 1
    for verilog, expected in ((good, 0), (bad, 1)):
        run = subprocess.run([python, "-B", ROOT / "examples/cocotb/run.py", verilog,
                              verilog.parent / "sim"], check=False, text=True, capture_output=True,
                             env={**os.environ, "PYTHONPATH": package})
        if run.returncode != expected or f"{'FAIL' if expected else 'PASS'}=2" not in run.stdout:
            print(run.stdout, run.stderr, f"{verilog}: exit status {run.returncode}")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
