# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs pytest on a file with the package of a build tree: run.py FOLDER FILE [MODULE...]. Exit status
77: a package that the tests need is missing; MODULEs are those of this file alone."""

import importlib.util
import sys
from pathlib import Path

MISSING = [name for name in ("cffi", "numpy", "pytest", "tqdm", *sys.argv[3:])
           if importlib.util.find_spec(name) is None]
if MISSING:
    print(f"skipped: {sys.executable} has no {', '.join(MISSING)}: tools/setup.sh test")
    sys.exit(77)

import pytest  # noqa: E402


def main():
    folder, file = sys.argv[1:3]
    if not Path(folder, "openmb4", "libopenmb4.so").exists():
        print(f"no library in {folder}: cmake --build build --target openmb4_python")
        return 1
    sys.path.insert(0, folder)
    return pytest.main(["-q", "-p", "no:cacheprovider", file])


if __name__ == "__main__":  # processes that a test starts import this file
    sys.exit(main())
