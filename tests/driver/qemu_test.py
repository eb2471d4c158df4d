#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Machine code of a Cortex-M against the RTL: examples/firmware in qemu-system-arm, its UART joined to
`mb4sim bridge`, by the commands of docs/bridge.md.

  qemu_test.py MACHINE CPU MB4SIM ROOT [KIND]   MACHINE: of QEMU; CPU: of the compiler; KIND "dma": the
                                                firmware dma.cpp instead of main.cpp; "slave-error":
                                                both, and the encoder's nE is 0

Exit status 77: a tool is missing.
"""

import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))

import pages  # noqa: E402

SKIPPED = 77
WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"


def commands_of(manual, machine, cpu, dma):
    """The page's commands, for another machine and compiler, with warnings."""
    found = [block.text for block in pages.blocks(manual.read_text(encoding="utf-8"))
             if block.language == "sh" and "qemu-system-arm" in block.text]
    if len(found) != 1:
        raise SystemExit(f"{manual}: {len(found)} blocks of commands for QEMU")
    source = "firmware/dma.cpp" if dma else "firmware/main.cpp"
    for old, new in (("mps2-an385", machine), ("-mcpu=cortex-m3", f"-mcpu={cpu} {WARNINGS}"),
                     ("firmware/main.cpp", source)):
        if found[0].count(old) != 1:
            raise SystemExit(f"{manual}: '{old}' occurs {found[0].count(old)} times")
        found[0] = found[0].replace(old, new)
    return found[0]


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
    # initialize() ends with one frame that it hands to nobody, single frames are requested one by one.
    if positions["single"] != [0x100001, 0x100002, 0x100003]:
        yield f"single positions are {positions['single']}"
    for line in ("revision 20", "serial 00D90132"):
        if line not in lines:
            yield f"no line '{line}'"


def dma_findings(printed):
    lines = printed.splitlines()
    values = [int(line.split()[1], 16) for line in lines if line.startswith("position")]
    if len(values) != 4 or any(value < 0x100000 or value > 0x102000 for value in values):
        yield f"the positions are {values}"
    if values != sorted(set(values)):
        yield f"a position is old: {values}"
    expected = [f"{what}: none" for what in ("configure", "initialize", "verify", "start",
                                             "plan_read", "read", "restart")]
    for line in expected + ["serial 00D90132"]:
        if line not in lines:
            yield f"no line '{line}'"


def refused(printed):
    """With nE = 0: no position, and the word for it."""
    lines = printed.splitlines()
    for line in lines:
        if line.startswith(("single", "automatic", "position")):
            yield f"a position is handed out: {line}"
    if not any(line.endswith("encoder reports an error (nE = 0)") for line in lines):
        yield "nothing says that the encoder reports an error"


def slave_error(machine, cpu, mb4sim, root):
    found = []
    for dma in (False, True):
        with pages.workspace(root, mb4sim) as folder:
            scenario = folder / "examples" / "firmware.toml"
            ramp = 'source = "ramp"\nstart = 0x100000\nstep = 1\n'
            text = scenario.read_text(encoding="utf-8")
            assert text.count(ramp) == 1
            scenario.unlink()  # it may be a link
            scenario.write_text(text.replace(ramp, "data = 0x400001\n"), encoding="utf-8")
            status, printed = pages.shell(
                commands_of(folder / "docs" / "bridge.md", machine, cpu, dma), folder)
        print(printed)
        found += refused(printed)
        if status == 0:
            found.append("the program ends as if it had read its positions")
    for line in found:
        print(line)
    return 1 if found else 0


def main():
    machine, cpu, mb4sim, root = sys.argv[1:5]
    dma = sys.argv[5:] == ["dma"]
    check = dma_findings if dma else findings
    for tool in ("qemu-system-arm", "arm-none-eabi-g++"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            return SKIPPED
    if sys.argv[5:] == ["slave-error"]:
        return slave_error(machine, cpu, mb4sim, root)
    # The check must be able to fail.
    if not list(check("single 0100000\nsingle 0100000\n")):
        print("the check does not notice old positions")
        return 1
    with pages.workspace(root, mb4sim) as folder:
        status, printed = pages.shell(
            commands_of(folder / "docs" / "bridge.md", machine, cpu, dma), folder)
    print(printed)
    found = list(check(printed))
    if status != 0:
        found.append(f"the commands ended with {status}")
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
