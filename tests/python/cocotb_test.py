# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The cocotb example passes on the release's Verilog, and fails where MA is stuck:
cocotb_test.py PACKAGE PYTHON FOLDER. Exit status 77: PYTHON has no cocotb."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
package, python, folder = sys.argv[1:]


def main():
    if not Path(python).exists() or subprocess.run([python, "-c", "import cocotb, cffi, numpy, tqdm"],
                                                   check=False, capture_output=True).returncode:
        print("skipped: no cocotb; python3 -m venv build/cocotb && "
              "build/cocotb/bin/pip install cocotb==2.1.0 cffi numpy tqdm")
        return 77
    out = Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, "-B", ROOT / "tools/synth/plain_verilog.py", out], check=True,
                   stdout=subprocess.DEVNULL)
    good = out / "mb4_core.v"
    # MA that never moves: both tests must fail.
    text, count = re.subn(r"(?m)^(\s*assign ma1_o = ).*;$", r"\1 1'b1;",
                          good.read_text(encoding="utf-8"))
    bad = out / "stuck" / "mb4_core.v"
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
