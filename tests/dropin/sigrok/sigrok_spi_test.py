#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A foreign SPI decoder on the waveform of `mb4sim run`: sigrok's must find exactly the bytes that
the driver has sent and received.

  sigrok_spi_test.py MB4SIM SCENARIO

Exit status 77: sigrok-cli or fst2vcd (GTKWave) is not installed.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

DOWNSAMPLE = 5000  # ps: SCLK phases of the scenario are 50 ns
PINS = {"NCS": ("ncs_i", 0), "SCLK": ("ale_i", 0), "MOSI": ("db_i", 0), "MISO": ("db_o", 1)}


def execute(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True,
                          text=True).stdout


def host_pins(vcd):
    """The changes of the host's pins: list of (time, pin, level), from a VCD with all signals."""
    codes, changes, now, scope = {}, [], 0, []
    for line in vcd.splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "$scope":
            scope.append(words[2])
        elif words[0] == "$upscope":
            scope.pop()
        elif words[0] == "$var":
            for pin, (port, _) in PINS.items():
                if words[4].split("[")[0] == port and len(scope) == 1 and pin not in codes:
                    codes[pin] = words[3]
        elif line.startswith("#"):
            now = int(line[1:])
        elif line[0] in "01":
            changes += [(now, pin, line[0]) for pin, code in codes.items() if line[1:] == code]
        elif line[0] == "b":
            value, code = line[1:].split()
            for pin in codes:
                if codes[pin] == code:
                    bit = PINS[pin][1]
                    changes.append((now, pin, value[-1 - bit] if bit < len(value) else "0"))
    if len(codes) != len(PINS):
        raise SystemExit(f"the waveform lacks a host pin: {codes}")
    return changes


def write_vcd(path, changes):
    lines = ["$timescale 1 ps $end", "$scope module host $end"]
    lines += [f"$var wire 1 {pin[0] + pin[1]} {pin} $end" for pin in PINS]
    lines += ["$upscope $end", "$enddefinitions $end"]
    last, level = None, {}
    for time, pin, value in changes:
        if level.get(pin) == value:
            continue
        level[pin] = value
        if time != last:
            lines.append(f"#{time}")
            last = time
        lines.append(f"{value}{pin[0] + pin[1]}")
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def decoded(path, which):
    text = execute("sigrok-cli", "-I", f"vcd:downsample={DOWNSAMPLE}", "-i", path, "-P",
                   "spi:clk=SCLK:mosi=MOSI:miso=MISO:cs=NCS", "-A", f"spi={which}")
    return [int(byte, 16) for byte in re.findall(r"^spi-1: ([0-9A-F]{2})$", text, re.M)]


def main():
    mb4sim, scenario = sys.argv[1:3]
    for tool in ("sigrok-cli", "fst2vcd"):
        if shutil.which(tool) is None:
            print(f"skipped: {tool} is not installed")
            return 77
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        execute(mb4sim, "run", scenario, "--frames", "5", "--trace", folder / "run.fst",
                "--bus-log", folder / "bus.log")
        changes = host_pins(execute("fst2vcd", folder / "run.fst"))
        write_vcd(folder / "host.vcd", changes)
        sent, received, known = [], [], []
        for line in (folder / "bus.log").read_text(encoding="ascii").splitlines():
            tx, rx = (bytes.fromhex(part) for part in line.split(">"))
            sent += tx
            received += rx if rx else tx
            known += [len(rx) > 0] * len(tx)
        mosi = decoded(folder / "host.vcd", "mosi-data")
        miso = decoded(folder / "host.vcd", "miso-data")
        if mosi != sent:
            print(f"MOSI differs: sigrok {bytes(mosi).hex(' ')}, driver {bytes(sent).hex(' ')}")
            return 1
        if len(miso) != len(received) or \
                any(a != b for a, b, there in zip(miso, received, known) if there):
            print(f"MISO differs: sigrok {bytes(miso).hex(' ')}, "
                  f"driver {bytes(received).hex(' ')}")
            return 1
        if sum(known) < 20 or len(sent) < 50:
            print("too few bytes to say anything")
            return 1
        # The comparison must be able to fail: one clock more or less shifts everything.
        first = next(i for i, (_, pin, value) in enumerate(changes)
                     if pin == "SCLK" and value == "1" and changes[i][0] > 0)
        write_vcd(folder / "broken.vcd", changes[:first] + changes[first + 1:])
        if decoded(folder / "broken.vcd", "mosi-data") == sent:
            print("a lost clock edge was not noticed")
            return 1
        print(f"{len(sent)} bytes sent and {sum(known)} received, all as sigrok decodes them")
    return 0


sys.exit(main())
