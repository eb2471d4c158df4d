# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the tests of the page: run.py PACKAGE PAGE MB4SIM [ARGUMENT of pytest...]. Exit status 77: what they need is missing."""

import importlib.util
import os
import shutil
import sys
from pathlib import Path

MISSING = [name for name in ("cffi", "numpy", "pytest", "selenium", "tqdm")
           if importlib.util.find_spec(name) is None]
MISSING += [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]


def main() -> int:
    package, page, mb4sim = map(Path, sys.argv[1:4])
    if MISSING:
        print(f"skipped: no {', '.join(MISSING)}: tools/setup.sh test and tools/setup.sh web")
        return 77
    if not page.exists():
        print(f"skipped: no page {page}: tools/web/build.sh")
        return 77
    if not Path(package, "openmb4", "libopenmb4.so").exists():
        print(f"no library in {package}: cmake --build build --target openmb4_python")
        return 1
    import pytest
    sys.path.insert(0, str(package))
    os.environ["MB4_WEB_PAGE"] = str(page.resolve())
    os.environ["MB4_WEB_MB4SIM"] = str(mb4sim.resolve())
    return pytest.main(["-q", "-p", "no:cacheprovider", str(Path(__file__).parent / "page_test.py"),
                        *sys.argv[4:]])


if __name__ == "__main__":
    sys.exit(main())
