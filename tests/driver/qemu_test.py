#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Machine code of a Cortex-M against the RTL: examples/firmware in qemu-system-arm, its UART joined to
`mb4sim bridge`.

  qemu_test.py MACHINE CPU MB4SIM ROOT     MACHINE: of QEMU; CPU: of the compiler

The encoder is a ramp, so that old or torn positions show. Exit status 77: a tool is missing.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
FLAGS = ("-std=c++17 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -Os -mthumb "
         "-ffunction-sections -fdata-sections -Wall -Wextra -Wpedantic -Wconversion -Wshadow "
         "-Werror -nostartfiles --specs=nano.specs -Wl,--gc-sections").split()
SCENARIO = """\
[[channel]]
number = 1
cable_m = 10.0
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
source = "ramp"
start = 0x100000
step = 1
control = true
registers = { 0x44 = [0x00, 0xD9, 0x01, 0x32] }
"""


def run_firmware(machine, image, mb4sim, scenario):
    """(exit status of QEMU, of mb4sim, what the firmware has printed)"""
    path = str(Path(scenario).with_name("bridge"))
    simulator = subprocess.Popen([mb4sim, "bridge", scenario, "--unix", path, "--once"],
                                 stdout=subprocess.PIPE, text=True)
    emulator = None
    try:
        if simulator.stdout.readline() != f"listening on unix:{path}\n":
            return None, simulator.wait(timeout=10), "mb4sim does not listen"
        emulator = subprocess.Popen(
            ["qemu-system-arm", "-M", machine, "-display", "none", "-monitor", "none",
             "-chardev", f"socket,id=chip,path={path}", "-serial", "chardev:chip",
             "-semihosting", "-kernel", image],
            stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        printed = emulator.communicate(timeout=100)[1]
        return emulator.returncode, simulator.wait(timeout=10), printed
    finally:
        if emulator is not None:
            emulator.kill()
        simulator.kill()


def findings(printed):
    lines = printed.splitlines()
    positions = {kind: [int(line.split()[1], 16) for line in lines if line.startswith(kind)]
                 for kind in ("single", "automatic")}
    for kind, values in positions.items():
        if len(values) != 3:
            yield f"{len(values)} {kind} positions instead of 3"
        if any(value < 0x100000 or value > 0x101000 for value in values):
            yield f"a {kind} position is not of the ramp: {values}"
    every = positions["single"] + positions["automatic"]
    if every != sorted(set(every)):
        yield f"a position is old: {every}"
    # INIT is no frame, single frames are requested one by one.
    if positions["single"] != [0x100000, 0x100001, 0x100002]:
        yield f"single positions are {positions['single']}"
    for line in ("revision 20", "serial 00D90132"):
        if line not in lines:
            yield f"no line '{line}'"


def main():
    machine, cpu, mb4sim, root = sys.argv[1:]
    for tool in ("qemu-system-arm", "arm-none-eabi-g++"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            return SKIPPED
    # The check must be able to fail.
    if not list(findings("single 0100000\nsingle 0100000\n")):
        print("the check does not notice old positions")
        return 1
    folder = Path(root) / "examples" / "firmware"
    with tempfile.TemporaryDirectory() as work:
        scenario = Path(work) / "ramp.toml"
        scenario.write_text(SCENARIO)
        image = Path(work) / "firmware.elf"
        built = subprocess.run(
            ["arm-none-eabi-g++", f"-mcpu={cpu}", *FLAGS, f"-I{root}/drivers/include",
             f"-I{root}/regmap/generated", "-T", folder / "mps2.ld", folder / "startup.cpp",
             folder / "main.cpp", "-o", image], capture_output=True, text=True)
        if built.returncode != 0:
            print(built.stderr)
            return 1
        status, simulator, printed = run_firmware(machine, image, mb4sim, scenario)
    print(printed)
    found = list(findings(printed))
    if status != 0 or simulator != 0:
        found.append(f"QEMU ended with {status}, mb4sim with {simulator}")
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
