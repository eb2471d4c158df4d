#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The files of a release that need no build: tools/release.sh --all makes them of the last commit, and
wheel and packages read positions in a Debian that holds nothing else.

  release_files_test.py BUILD CMAKE     exit status 77: not root, or nothing that makes a clean Debian

MB4_CLEAN_ROOT=FOLDER names that Debian; without it debootstrap makes one. MB4_RELEASE=FOLDER: the files
are there already."""

import os
import shutil
import sys
import tempfile
from pathlib import Path

from programs import ROOT, call, clean_root, version
from release_test import git

HERE = Path(__file__).resolve().parent
MIRROR = "http://deb.debian.org/debian"


def make_files(folder):
    """The files of a release, and what its script has skipped."""
    clone, out = folder / "clone", folder / "out"
    git("clone", "-q", "--no-hardlinks", str(ROOT), str(clone), cwd=folder)
    call(clone / "tools" / "release.sh", "--all", out, timeout=5000)
    return out


def main():
    if os.geteuid() != 0 or (clean_root() is None and shutil.which("debootstrap") is None):
        print("skipped: needs root, and debootstrap or MB4_CLEAN_ROOT")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        root = clean_root()
        if root is None:
            root = folder / "root"
            call("debootstrap", "--variant=minbase", "--include=python3-venv", "bookworm", root, MIRROR)
        given = os.environ.get("MB4_RELEASE")
        out = Path(given).resolve() if given else make_files(folder)
        wheel, = (out / "python").glob("*.whl")
        page = out / f"openmb4-{version()}.html"
        print(f"{page.name}: {page.stat().st_size / 1e3:.0f} kB" if page.exists() else "skipped: no page")
        call("sha256sum", "--quiet", "-c", "SHA256SUMS", cwd=out)
        environment = os.environ | {"MB4_CLEAN_ROOT": str(root), "MB4_WHEEL": str(wheel),
                                    "MB4_DEBS": str(out / "deb")}
        print(call(sys.executable, "-B", HERE / "wheel_test.py", env=environment))
        print(call(sys.executable, "-B", HERE / "deb_test.py", *sys.argv[1:], "Packages.test_programs_depend_on_their_libraries",
                   "Packages.test_installed_and_removed_in_a_clean_debian", env=environment))


if __name__ == "__main__":
    main()
