#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The driver's quick starts as printed in the manual and examples/spidev, compiled for Linux and run on
the simulated chip: driver, spidev and chip together.

  quick_start_test.py MB4SIM ROOT COMPILER
"""

import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs"))

import pages  # noqa: E402

MB4SIM, ROOT, COMPILER = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
POSITION = 0x2ABCDEF  # of golden.toml
REFUSED = "encoder reports an error (nE = 0)"


def run(page, work, scenario):
    text = page.read_text(encoding="utf-8")
    source, program = work / "unit.cpp", work / "unit"
    if page.suffix == ".md":
        text = "".join(block.text for block in pages.blocks(text) if block.language == "cpp")
    source.write_text(text, encoding="utf-8")
    subprocess.run([COMPILER, "-std=c++17", "-O2", f"-I{ROOT}/drivers/include",
                    f"-I{ROOT}/regmap/generated/mb4", str(source), "-o", str(program)], check=True,
                   timeout=120)
    return subprocess.run([MB4SIM, "spidev", "--scenario", str(scenario), "--",
                           str(program)], capture_output=True, text=True, timeout=60, check=False)


def main():
    failed = False
    for page, positions in ((ROOT / "docs" / "driver.md", 1), (ROOT / "drivers" / "README.md", 1),
                            (ROOT / "examples" / "spidev" / "chain.cpp", 3)):
        with tempfile.TemporaryDirectory() as folder:
            golden = ROOT / "tests" / "dropin" / "golden.toml"
            done = run(page, Path(folder), golden)
            # The same encoder with nE = 0: no position, but a word for it.
            word = f"data = 0x{POSITION << 2 | 3:X}"
            text = golden.read_text(encoding="utf-8")
            assert text.count(word) == 1, word
            error = Path(folder) / "error.toml"
            error.write_text(text.replace(word, f"data = {POSITION << 2 | 1}"), encoding="utf-8")
            refused = run(page, Path(folder), error)
        print(f"{page.name}, nE = 0: {refused.stdout.strip()} (status {refused.returncode})")
        failed |= (refused.returncode, refused.stdout, refused.stderr) != (1, REFUSED + "\n", "")
        print(f"{page.name}: {done.stdout.strip()} (status {done.returncode}) {done.stderr}")
        # Nothing on standard error: no limit of the chip's for its host has been broken.
        failed |= (done.returncode, done.stdout, done.stderr) != (0, f"{POSITION}\n" * positions, "")
    return 1 if failed else 0


sys.exit(main())
