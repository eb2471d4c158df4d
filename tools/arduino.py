#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The library for Arduino and PlatformIO: arduino.py FOLDER writes FOLDER/openmb4-arduino-VERSION.zip.

Its headers lie in src/, as both tools expect. The same sources give the same bytes."""

import re
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def files(version):
    """{path in the library: its bytes}."""
    found = {"LICENSE": ROOT / "LICENSE"}
    arduino, headers = ROOT / "drivers/arduino", ROOT / "drivers/include"
    for folder, place in ((arduino, ""), (headers, "src/")):
        for path in folder.rglob("*"):
            if path.is_file() and path.suffix != ".license":
                found[place + str(path.relative_to(folder))] = path
    for name in ("mb4/mb4_regs.h", "mb4/mb4_regs.hpp", "axi/axi_regs.h"):
        found[f"src/{Path(name).name}"] = ROOT / "regmap/generated" / name
    return {name.removesuffix(".in"): path.read_bytes().replace(b"@VERSION@", version.encode())
            for name, path in sorted(found.items())}


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    version = re.search(r"openmb4 VERSION ([\d.]+)",
                        (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"openmb4-arduino-{version}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files(version).items():
            archive.writestr(zipfile.ZipInfo(f"openmb4/{name}"), data, zipfile.ZIP_DEFLATED)
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
