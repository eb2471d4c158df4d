#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a cocotb test bench with Icarus Verilog: mb4_core_test.py, mb4_bus_test.py for the tops with
a bus of words, biss_axi_test.py, or dsl_axil_test.py.

  run.py VERILOG FOLDER    VERILOG is mb4_core.v, mb4_axil.v or mb4_wb.v of a release or of
                           tools/synth/plain_verilog.py, or biss_axi.v with two channels in stream
                           mode 1 (tests/python/cocotb_test.py makes it), or dsl_axil.v; FOLDER takes the build

Needs cocotb 2.1 and the openmb4 package; mb4_axil, biss_axi and dsl_axil cocotbext-axi, mb4_wb
cocotbext-wishbone."""

import sys
from pathlib import Path

from cocotb_tools.check_results import get_results
from cocotb_tools.runner import get_runner


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    verilog, folder = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    if not verilog.is_file():
        print(f"run.py: {verilog} is no file", file=sys.stderr)
        return 2
    folder.mkdir(parents=True, exist_ok=True)
    # Icarus takes the unit of time from the source only; a release's Verilog has it.
    top = verilog.stem
    bench = {"mb4_core": "mb4_core_test", "biss_axi": "biss_axi_test", "dsl_axil": "dsl_axil_test"}.get(top, "mb4_bus_test")
    runner = get_runner("icarus")
    runner.build(sources=[verilog.resolve()], hdl_toplevel=top, build_dir=folder, always=True)
    results = runner.test(hdl_toplevel=top, test_module=bench, build_dir=folder,
                          test_dir=Path(__file__).resolve().parent,
                          results_xml=str(folder / "results.xml"))
    tests, failed = get_results(results)
    return 1 if failed or not tests else 0


if __name__ == "__main__":
    sys.exit(main())
