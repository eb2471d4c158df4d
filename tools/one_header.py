#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The driver as one header: one_header.py FILE [HEADER...] writes mb4/mb4.hpp, mb4/safety.hpp, enc/snapshot.hpp and the
HEADERs of drivers/include/, with what they include, to FILE. It needs the standard library alone.

The same sources give the same bytes. Each part keeps its include guard, so FILE may stand beside the headers."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = (ROOT / "drivers/include", ROOT / "regmap/generated/mb4", ROOT / "regmap/generated/mb4_page")
HEADERS = ("mb4/mb4.hpp", "mb4/safety.hpp", "enc/snapshot.hpp")
ONLY_C = ("mb4_regs.h",)  # of mb4_cyclic.h, where the compiler is one of C
INCLUDE = re.compile(r'^#include "([^"]+)"\n', re.MULTILINE)
LICENCE = re.compile(r"^// SPDX-.*\n|(?<=\A/\*) SPDX-.*\n \* SPDX-.*\n(?: \*\n)?", re.MULTILINE)


def read(name):
    """The text of a header, without its licence, which FILE names once."""
    found = [folder / name for folder in FOLDERS if (folder / name).is_file()]
    if not found:
        raise SystemExit(f"{name}: there is no such header of the driver")
    return LICENCE.sub("", found[0].read_text(encoding="utf-8"))


def parts(names):
    """The headers and what they include, each once, in the place where it is included first."""
    seen = set()

    def part(name):
        if name in seen or name in ONLY_C:
            return ""
        seen.add(name)
        text = INCLUDE.sub(lambda found: part(found.group(1)), read(name))
        return f"// ---- {name} ----\n\n{text.strip()}\n\n"

    return "".join(part(name) for name in names)


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    version = re.search(r"openmb4 VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    Path(sys.argv[1]).write_text(
        "// SPDX-FileCopyrightText: 2026 The openmb4 authors\n// SPDX-License-Identifier: Apache-2.0\n\n"
        f"// The driver of openmb4 {version} for the iC-MB4 in one header, for C++17. Made by tools/one_header.py of the\n"
        "// headers in drivers/include/: change those.\n\n" + parts((*HEADERS, *sys.argv[2:])).rstrip() + "\n",
        encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
