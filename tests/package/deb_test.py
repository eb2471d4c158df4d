#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The Debian packages: together they hold what `cmake --install` installs, they install into a clean
root, the command runs there, and their removal leaves nothing.

  deb_test.py BUILD CMAKE [TEST...]     exit status 77: no dpkg-shlibdeps, or not root

MB4_DEBS=FOLDER names packages that are there already, such as deb/ of a release; else the build makes them.
MB4_CLEAN_ROOT=FOLDER names a Debian made by `debootstrap --variant=minbase`: then apt installs the
packages there with what they depend on. Without it dpkg installs them into an empty folder, without
what they depend on, and the command runs on this machine's libraries."""

import os
import re
import shutil
import sys
import tempfile
import time
import unittest
from pathlib import Path

from programs import call, clean_root, inside

BUILD, CMAKE = Path(sys.argv[1]).resolve(), sys.argv[2]
NAMES = {"openmb4", "libmb4sim0", "libmb4sim-dev", "openmb4-driver-dev", "openmb4-rtl"}
MOST_SECONDS = 10  # from the installed packages to positions on the screen
SCENARIO = "usr/share/openmb4/examples/resolute-26.toml"


def files_of(folder):
    """Files and links below a folder, as text relative to it."""
    return {str(Path(place, name).relative_to(folder)) for place, folders, names in os.walk(folder)
            for name in names + [one for one in folders if Path(place, one).is_symlink()]}


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = Path(cls.folder.name)
        place = cls.work
        if os.environ.get("MB4_DEBS"):
            place = Path(os.environ["MB4_DEBS"])
        else:
            call(Path(CMAKE).parent / "cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake",
                 "-B", cls.work, cwd=BUILD)
        cls.debs = {call("dpkg-deb", "-f", deb, "Package").strip(): deb
                    for deb in place.glob("*.deb")}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def contents(self, name):
        folder = self.work / f"contents-{name}"
        call("dpkg-deb", "-x", self.debs[name], folder)
        return files_of(folder)

    def test_packages_hold_all_that_is_installed_once(self):
        self.assertEqual(set(self.debs), NAMES)
        whole = self.work / "whole"
        call(CMAKE, "--install", BUILD, "--prefix", whole / "usr")
        parts = {name: self.contents(name) for name in NAMES}
        self.assertEqual(set().union(*parts.values()), files_of(whole))
        self.assertEqual(sum(map(len, parts.values())), len(files_of(whole)))
        self.assertIn("usr/lib/libmb4sim.so", parts["libmb4sim-dev"])
        self.assertEqual({Path(file).name.split(".so")[0] for file in parts["libmb4sim0"]},
                         {"libmb4sim"})

    def test_programs_depend_on_their_libraries(self):
        for name in ("openmb4", "libmb4sim0"):
            depends = call("dpkg-deb", "-f", self.debs[name], "Depends")
            self.assertRegex(depends, r"libc6 \(>= [\d.]+\).*libstdc\+\+6")
        version = call("dpkg-deb", "-f", self.debs["libmb4sim-dev"], "Version").strip()
        self.assertEqual(call("dpkg-deb", "-f", self.debs["libmb4sim-dev"], "Depends").strip(),
                         f"libmb4sim0 (= {version}), openmb4-driver-dev (= {version})")

    def try_root(self, root, install, remove, program):
        before = files_of(root / "usr")
        install()
        try:
            self.assertTrue((root / SCENARIO).exists())
            begin = time.monotonic()
            self.assertIn("frames good 3, bad 0", program("run", SCENARIO, "--frames", "3"))
            self.assertLess(time.monotonic() - begin, MOST_SECONDS)
        finally:
            remove()
        self.assertEqual(files_of(root / "usr"), before)

    def test_installed_and_removed_in_an_empty_root(self):
        root = self.work / "root"
        (root / "var/lib/dpkg/info").mkdir(parents=True)
        (root / "var/lib/dpkg/updates").mkdir()
        (root / "var/lib/dpkg/status").touch()
        (root / "usr").mkdir()
        dpkg = ("dpkg", f"--root={root}", "--force-depends", "--force-script-chrootless")
        self.try_root(root, lambda: call(*dpkg, "-i", *self.debs.values()),
                      lambda: call(*dpkg, "--purge", *NAMES),
                      lambda *arguments: call(root / "usr/bin/mb4sim", *arguments, cwd=root))

    @unittest.skipUnless(clean_root(), "MB4_CLEAN_ROOT names no folder")
    def test_installed_and_removed_in_a_clean_debian(self):
        root = clean_root()
        place = root / "var/openmb4"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        for deb in self.debs.values():
            shutil.copy(deb, place)
        there = inside(root)
        # The libraries that they need stay; so they come first.
        needed = set(re.findall(r"\b(libc6|libfmt\d+|libgcc-s1|libstdc\+\+6|zlib1g)\b", " ".join(
            call("dpkg-deb", "-f", deb, "Depends") for deb in self.debs.values())))
        call(*there, "apt-get", "install", "-y", "-q", *needed)
        self.try_root(root, lambda: call(*there, "apt-get", "install", "-y", "-q", *(
                          f"/var/openmb4/{Path(deb).name}" for deb in self.debs.values())),
                      lambda: call(*there, "apt-get", "purge", "-y", "-q", *NAMES),
                      lambda *arguments: call(*there, "mb4sim", *arguments))


if __name__ == "__main__":
    if shutil.which("dpkg-shlibdeps") is None or os.geteuid() != 0:
        print("skipped: needs dpkg-shlibdeps (package dpkg-dev), and root to install")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
