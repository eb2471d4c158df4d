#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Debian's spi-tools, unmodified, on the simulated chip: spi-config and spi-pipe bring an encoder
into operation and read it. Register values: datasheet Rev D2.

  spi_tools_test.py MB4SIM SCENARIO

Exit status 77: spi-tools are not installed.
"""

import shutil
import subprocess
import sys

MB4SIM, SCENARIO = sys.argv[1:3]
SKIPPED = 77
# One SPI frame for each line: what is sent, and what must come back at its end.
FRAMES = (
    ("03 EA 00 00 00", "20 84 01"),              # revision, version, fixed bits
    ("02 C0 5B 06 00 00", None),                 # slave 1: 28 bits, CRC6
    ("02 ED 01", None),                          # channel 1: BiSS C
    ("02 E5 40 A0", None),                       # REGVERS, MA 10 MHz
    ("03 C0 00 00", "5B 06"),
    ("07 04", None),                             # a frame
    ("05 00 00 00 00 00 00 00 00", None),        # as long as it takes
    ("05 00 00 00 00 00 00 00 00", None),
    ("05 00 00", "FB 02"),                       # EOT, no error; SVALID1
    ("03 00" + " 00" * 8, "BF 37 AF 0A 00 00 00 18"),  # golden.toml: the word, its CRC
)


def main():
    for tool in ("spi-pipe", "spi-config"):
        if shutil.which(tool) is None:
            print(f"skipped: {tool} is not installed (package spi-tools)")
            return SKIPPED
    script = ["spi-config -d /dev/spidev0.0 -q >&2", "spi-config -d /dev/spidev0.0 -s 1000000 -w &",
              "sleep 0.5; spi-config -d /dev/spidev0.0 -q >&2; kill $!"]
    for sent, _ in FRAMES:
        octal = "".join(f"\\{int(byte, 16):03o}" for byte in sent.split())
        script.append(f"printf '{octal}' | spi-pipe -d /dev/spidev0.0 -b {len(sent.split())} -n 1")
    script.append("spi-config -d /dev/spidev0.0 -m 1; spi-config -d /dev/spidev0.0 -q >&2")
    done = subprocess.run([MB4SIM, "spidev", "--scenario", SCENARIO, "--", "sh", "-c",
                           "\n".join(script)], capture_output=True, timeout=100, check=False)
    messages = done.stderr.decode()
    answers, failed = done.stdout, done.returncode != 0
    for sent, expected in FRAMES:
        count = len(sent.split())
        answer, answers = answers[:count], answers[count:]
        print(f"{sent} -> {answer.hex(' ')}")
        if len(answer) != count or \
                (expected is not None and not answer.hex(" ").upper().endswith(expected)):
            print(f"  expected {expected}")
            failed = True
    for line in ("mode=0, lsb=0, bits=8, speed=5000000", "mode=0, lsb=0, bits=8, speed=1000000",
                 "mode=1, lsb=0, bits=8"):
        if line not in messages:
            print(f"spi-config does not say: {line}")
            failed = True
    if failed:
        print(messages)
    return 1 if failed else 0


sys.exit(main())
