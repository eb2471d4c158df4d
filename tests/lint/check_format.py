#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""C++ that is written by hand is formatted as .clang-format says.

  check_format.py              every tracked .cpp and .hpp but the generated ones
  check_format.py --self-test  planted faults are reported

The versions of clang-format differ in details, so this needs that of Debian 12. A mended file is what
`clang-format -i FILE` writes.
"""

import re
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools" / "synth"))

import project  # noqa: E402

VERSION = "14"
SOURCE = re.compile(r"\.(cpp|hpp)$")
GENERATED = re.compile(r"(^|/)generated/")


def formatter():
    """The program; ends as skipped if its version is not there."""
    for name in (f"clang-format-{VERSION}", "clang-format"):
        if (path := shutil.which(name)) and re.search(
                rf"version {VERSION}\.", project.run([path, "--version"])[1]):
            return path
    print(f"skipped: clang-format {VERSION} is not installed")
    sys.exit(project.SKIPPED)


def findings(program, files, folder=project.ROOT):
    """file:line of each place that would change."""
    status, text = project.run([program, f"--style=file:{project.ROOT / '.clang-format'}", "--dry-run",
                                "-Werror", *files], cwd=folder)
    found = sorted(set(re.findall(r"(?m)^(.+:\d+):\d+: error: code should be clang-formatted", text)))
    if status != 0 and not found:
        found = [text.strip()]
    return [f"{place}: clang-format -i would change it" for place in found]


def self_test(program):
    good = "int f(int a) { return a; }\n"
    cases = {"good.cpp": (good, False), "indented.cpp": ("int f(int a) {\n    return a;\n}\n", True),
             "long.hpp": (f"// {'x ' * 60}\n{good}", True), "brace.cpp": ("int f(int a){ return a; }\n", True)}
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name, (text, bad) in cases.items():
            (Path(folder) / name).write_text(text, encoding="utf-8")
            found = findings(program, [name], folder)
            if bool(found) != bad:
                wrong.append(f"{name}: got {found}")
        if not findings(program, ["absent.cpp"], folder):
            wrong.append("absent.cpp: nothing is said of a file that is not there")
    project.finish(wrong, "planted faults, all reported")


def main():
    arguments = project.Arguments(__doc__)
    arguments.add_argument("--self-test", action="store_true", dest="self_test")
    options = arguments.parse_args()
    program = formatter()
    if options.self_test:
        self_test(program)
    files = [name for name in project.tracked()
             if SOURCE.search(name) and not GENERATED.search(name) and (project.ROOT / name).is_file()]
    project.finish(findings(program, files), f"{len(files)} files are formatted")


main()
