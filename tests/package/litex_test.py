# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The SoCs of examples/litex, the chip on both buses, biss_axi, biss_clb and dsl_axil, made by LiteX without a network and run in Icarus
around the plain Verilog; Yosys reads them around the RTL. Planted faults are reported.

  litex_test.py PYTHON FOLDER    PYTHON has LiteX; FOLDER is for what the tools leave

Exit status 77: PYTHON has no LiteX, or a tool is missing.
"""

import csv
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import plain_verilog  # noqa: E402
import project  # noqa: E402

# Name: master, bus, top, preset or None, bench, identity.
SOCS = {"wishbone": ("mb4", "wishbone", "mb4_wb", "single", "litex_bench.v", 0x454E4301),
        "axi-lite": ("mb4", "axi-lite", "mb4_axil", "reader", "litex_bench.v", 0x454E4301),
        "axi": ("axi", "axi-lite", "biss_axi", None, "litex_axi_bench.v", 0x454E4302),
        "clb": ("clb", "axi-lite", "biss_clb", None, "litex_clb_bench.v", 0x454E4304),
        "dsl": ("dsl", "axi-lite", "dsl_axil", None, "litex_dsl_bench.v", 0x454E4305)}
FEATURES = {"axi": 0x10201,   # one channel, a request clears the valid flag, the page
            "clb": 1,      # the watchdog
            "dsl": 0x127}  # one line, tracking, strict code, recovery, messages
# Of the plain Verilog, as soc.py has them for the RTL.
PARAMETERS = {"axi": {"EXTRAS": 1}}
# Of the device, as black boxes.
CELLS = "read_verilog -lib +/ecp5/cells_sim.v +/ecp5/cells_bb.v"
# A port with another name, and data with a wrong bit.
FAULTS = (("name of a port", r"\b(?:sl1?_i|dsl_in_i|slo)\b", "sl3_i"),
          ("bit of the data", r"(?mi)^(\s*assign (?:wb_dat_o|s_axi_rdata) = )(.*);$", r"\1 (\2) ^ 32'h10;"))


def soc(python, folder, name, *arguments):
    master, bus, _, preset, _, _ = SOCS[name]
    chosen = ["--master", master, "--bus", bus, *(["--features", preset] if preset else []), *arguments]
    status, text = project.run([python, "-B", ROOT / "examples/litex/soc.py", folder, *chosen], cwd=folder.parent)
    if status != 0:
        raise SystemExit(f"{name}: {text[-3000:]}")
    with open(folder / "csr.csv", encoding="utf-8") as file:
        rows = {row[1]: row[2] for row in csv.reader(file) if len(row) > 2 and not row[0].startswith("#")}
    return int(rows[master], 0), int(rows[f"{master}_ev_status"], 0)


def run(name, folder, verilog, origin, status):
    """What Icarus says; "good" at the end if nothing is wrong."""
    _, _, _, preset, bench, identity = SOCS[name]
    features = project.presets()[preset] if preset else FEATURES[name]
    words = {"Origin": origin, "EvStatus": status, "Identity": identity, "Features": features}
    # LiteX writes processes that read what they write by <=: Icarus would never end one, Yosys takes them apart.
    script = (f"{CELLS}; read_verilog soc.v {verilog}; hierarchy -check -top soc; proc; opt_clean; write_verilog -noattr plain.v")
    code, text = project.run([project.tool("yosys"), "-p", script], cwd=folder / "gateware")
    if code != 0 or "Resizing" in text:
        return text
    chosen = [f"-Plitex_bench.{name}={value}" for name, value in words.items()]
    program = folder / "bench"
    code, text = project.run([project.tool("iverilog"), "-g2012", "-s", "litex_bench", "-I", HERE, "-o", program, *chosen,
                              HERE / bench, "plain.v"], cwd=folder / "gateware")
    if code != 0:
        return text
    return project.run([project.tool("vvp"), "-n", program], cwd=folder / "gateware", timeout=900)[1]


def main():
    python, folder = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    if not python.exists() or subprocess.run([python, "-c", "import litex, requests, packaging"], check=False,
                                             capture_output=True).returncode:
        print("skipped: no LiteX; python3 -m venv build/litex && build/litex/bin/pip install "
              "litex==2024.12 requests setuptools packaging")
        sys.exit(project.SKIPPED)
    for program in ("yosys", "iverilog", "vvp"):
        project.tool(program)
    findings = []
    for name, (_, _, top, preset, _, _) in SOCS.items():
        place = folder / name
        place.mkdir(parents=True, exist_ok=True)
        module = plain_verilog.write(top, place, parameters=PARAMETERS.get(name), **({"preset": preset} if preset else {}))
        origin, status = soc(python, place / "plain", name, "--verilog", module, "--baud", "5000000")  # Icarus is slow
        text = run(name, place / "plain", module, origin, status)
        if not text.endswith("good\n"):
            findings.append(f"{name}: {text[-2000:]}")
        for what, pattern, new in FAULTS:
            wrong, count = re.subn(pattern, new, module.read_text(encoding="utf-8"))
            bad = place / "wrong.v"
            bad.write_text(wrong, encoding="utf-8")
            if count == 0 or run(name, place / "plain", bad, origin, status).endswith("good\n"):
                findings.append(f"{name}: not noticed: another {what}")
        # The RTL itself, by the script that LiteX writes for Yosys, up to the hierarchy.
        soc(python, place / "rtl", name)
        gateware = place / "rtl" / "gateware"
        script = (gateware / "soc.ys").read_text(encoding="utf-8")
        (gateware / "check.ys").write_text(re.sub(r"(?ms)^synth_ecp5.*", f"{CELLS}\nhierarchy -check -top soc\n", script),
                                           encoding="utf-8")
        code, text = project.run([project.tool("yosys"), "-q", "check.ys"], cwd=gateware)
        if code != 0 or "synth_ecp5" not in script:
            findings.append(f"{name}, Yosys: {text[-2000:]}")
    project.finish(findings, f"{len(SOCS)} SoCs: words, pins, interrupt; planted faults are noticed")


if __name__ == "__main__":
    main()
