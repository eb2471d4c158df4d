#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Changes the version of the project: its line in CMakeLists.txt and each file that repeats it.

  set_version.py X.Y.Z              then makes the register maps again, by regmap/regenerate.sh
  set_version.py X.Y.Z --no-maps    leaves them as they are; Lint.Version_StandsInOneLine names them

CMakeLists.txt is the one line. The command, the libraries, the packages and the release archive take it
from there when they are built. The section of CHANGELOG.md is written by hand.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

import masters  # noqa: E402

VERSION_FILE = "CMakeLists.txt"
VERSION_LINE = r"(?m)^project\(openmb4 VERSION (\d+)\.(\d+)\.(\d+)\b"
# Files that cannot take the version from the line: FuseSoC reads the core files as they stand, and the
# driver works as a copied folder. The register maps' files are checked in; their generator takes it.
VERSION_COPIES = {
    **{master.core: r"(?m)^name: openmb4:ip:\w+:(\d+)\.(\d+)\.(\d+)$" for master in masters.load().values() if master.core},
    "drivers/include/mb4/version.hpp":
        r"VersionMajor = (\d+);[^;]*VersionMinor = (\d+);[^;]*VersionPatch = (\d+);",
    "drivers/esp_idf/openmb4/idf_component.yml": r'(?m)^version: "(\d+)\.(\d+)\.(\d+)"$',
    "drivers/rust/openmb4/Cargo.toml": r'(?m)^version = "(\d+)\.(\d+)\.(\d+)"$',
    "drivers/rust/openmb4/Cargo.lock": r'(?m)^name = "openmb4"\nversion = "(\d+)\.(\d+)\.(\d+)"$',
}


class Fault(Exception):
    """A wrong use or a file that cannot be changed, in one line."""


def changed(name, text, pattern, version):
    """`text` of the file `name` with `version`, a list of three numbers, in the groups of `pattern`."""
    found = re.search(pattern, text)
    if found is None:
        raise Fault(f"{name}: the line with the version is not there: {pattern}")
    for group in (3, 2, 1):
        text = text[:found.start(group)] + version[group - 1] + text[found.end(group):]
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("version", metavar="X.Y.Z")
    parser.add_argument("--no-maps", action="store_true")
    options = parser.parse_args()
    try:
        # Bits of the version register: eight for each number.
        if not re.fullmatch(r"(0|[1-9]\d*)(\.(0|[1-9]\d*)){2}", options.version) or any(
                int(number) > 255 for number in options.version.split(".")):
            raise Fault(f"'{options.version}' is no version X.Y.Z of three numbers from 0 to 255")
        version = options.version.split(".")
        texts = {}
        for name, pattern in {VERSION_FILE: VERSION_LINE, **VERSION_COPIES}.items():
            try:
                texts[name] = changed(name, (ROOT / name).read_text(encoding="utf-8"), pattern, version)
            except OSError as error:
                raise Fault(f"{name}: {error.strerror}") from error
        for name, text in texts.items():
            (ROOT / name).write_text(text, encoding="utf-8")
            print(name)
        if not options.no_maps:
            done = subprocess.run([ROOT / "regmap" / "regenerate.sh"], check=False)
            if done.returncode != 0:
                raise Fault("regmap/regenerate.sh has failed: the register maps have the old version")
            print("register maps")
    except Fault as fault:
        print(f"set_version.py: {fault}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
