# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The wheel of a release: made from the sdist, it is installed in a new environment without a
compiler; its command and its package read the position that the README shows.

  wheel_test.py [--released]   --released: optimised as a release is; else its compilation takes a third

MB4_CLEAN_ROOT=FOLDER names a Debian made by `debootstrap --variant=minbase`: then the wheel is
installed there too. MB4_WHEEL=FILE: a wheel that is there already is tried; none is made."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

import programs
from release_test import git

SKIPPED = 77
QUICK = {"SKBUILD_CMAKE_BUILD_TYPE": "Debug", "CMAKE_ARGS": "-DCMAKE_CXX_FLAGS_DEBUG=-O0"}
POSITION = 11203451  # README: the table under tools/demo.sh
MOST_SECONDS = 10  # from the installed wheel to a position on the screen
OLDEST = 34  # minor version of the C library that the docs promise
LICENCES = {"gcc-12-base", "libcli11-dev", "libfmt-dev", "libtomlplusplus-dev", "verilator"}
LIBRARIES = {"libc.so.6", "libm.so.6", "libz.so.1", "ld-linux-x86-64.so.2", "libgcc_s.so.1"}
# An example of each master, and what its run says.
EXAMPLES = {"resolute-26": str(POSITION), "axi/one-encoder": "frames good", "clb/reference-frame": "frames good",
            "pru/encoder": "frames good", "dsl/motor": "frames good"}
# What the scenario of examples/simulator/positions.c sends: ramps from 1000 by 3 and from 500.
POSITIONS = "".join(f"SSI {1000 + 3 * i}, BiSS C {500 + i}\n" for i in range(3))


def example(root):
    """The README's line of Python: the text after -c."""
    text = (root / "README.md").read_text(encoding="utf-8")
    return re.search(r"bin/python -c '([^']+)'", text)[1]


def check_contents(wheel, folder):
    """What the wheel holds, what its programs need of a system, and what its metadata say."""
    with zipfile.ZipFile(wheel) as packed:
        names = set(packed.namelist())
        packed.extractall(folder)
    for name in ("bin/mb4sim", "lib/libmb4sim.so", "lib/libmb4sim_spidev.so", "lib/pkgconfig/mb4sim.pc",
                 "lib/cmake/openmb4/openmb4Config.cmake", "include/mb4sim.h",
                 "include/openmb4/mb4/device.hpp", "include/openmb4/mb4_regs.h", "libopenmb4.so",
                 "share/openmb4/rtl/mb4/mb4.f", "share/man/man1/mb4sim.1", "py.typed"):
        assert f"openmb4/{name}" in names, name
    for name in EXAMPLES:
        assert f"openmb4/share/openmb4/examples/{name}.toml" in names, name
    licences = {Path(name).name for name in names if "/licences/" in name and name[-1] != "/"}
    assert licences == LICENCES, licences
    assert not [name for name in names if name.startswith("openmb4.libs/")], "grafted libraries"
    for name in ("bin/mb4sim", "lib/libmb4sim.so", "libopenmb4.so"):
        said = programs.call("readelf", "-d", folder / "openmb4" / name)
        needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", said))
        assert needed <= LIBRARIES, (name, needed)
    metadata, = folder.glob("openmb4-*.dist-info/METADATA")
    text = metadata.read_text(encoding="utf-8")
    for line in ("Summary: ", "Classifier: Topic ::", "Project-URL: Homepage, ", "Requires-Python: ",
                 "Description-Content-Type: text/markdown", "Provides-Extra: pandas"):
        assert f"\n{line}" in text, line


def read_positions(run, where):
    """Command and package read positions in a system that run() calls; its compiler is not there."""
    assert run("sh", "-c", "command -v cc gcc g++ clang cmake || true").strip() == "", "a compiler"
    begin = time.monotonic()
    said = run("mb4sim", "run", f"{where}/share/openmb4/examples/resolute-26.toml", "--frames", "5")
    took = time.monotonic() - begin
    assert len(re.findall(rf"\b{POSITION}\b", said)) >= 5, said
    assert took < MOST_SECONDS, took
    print(f"mb4sim run: a position after {took:.2f} s")
    for name, shown in EXAMPLES.items():
        said = run("mb4sim", "run", f"{where}/share/openmb4/examples/{name}.toml", "--frames", "2")
        assert shown in said, said
    code = example(programs.ROOT).replace('"examples/', f'"{where}/share/openmb4/examples/')
    begin = time.monotonic()
    said = run("python", "-c", code)
    assert f"position={POSITION}," in said, said
    print(f"python: a position after {time.monotonic() - begin:.2f} s")


def check_library(where, folder):
    """A program in C finds header and library by pkg-config."""
    if shutil.which("cc") is None or shutil.which("pkg-config") is None:
        return
    flags = programs.call("pkg-config", "--cflags", "--libs", "mb4sim", "mb4_c",
                          env=os.environ | {"PKG_CONFIG_PATH": str(where / "lib" / "pkgconfig")}).split()
    source = programs.ROOT / "examples" / "simulator" / "positions.c"
    program = folder / "positions"
    programs.call("cc", source, "-o", program, *flags, f"-Wl,-rpath,{where / 'lib'}")
    said = programs.call(program)
    assert said == POSITIONS, said


def check_clean_root(wheel, python, folder):
    """The same in a Debian that has nothing but Python."""
    root = programs.clean_root()
    if root is None:
        print("skipped in a clean Debian: MB4_CLEAN_ROOT names no folder")
        return
    inside = programs.inside(root)
    programs.call(*inside, "apt-get", "install", "-y", "-q", "--no-install-recommends", "python3-venv")
    programs.call(python, "-m", "pip", "download", "-q", "--dest", folder / "all", wheel)
    place = root / "var" / "openmb4-wheel"
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(folder / "all", place / "all")
    try:
        programs.call(*inside, "python3", "-m", "venv", "/var/openmb4-wheel/venv")
        programs.call(*inside, "/var/openmb4-wheel/venv/bin/pip", "install", "-q", "--no-index",
                      "--find-links", "/var/openmb4-wheel/all", "openmb4")
        inside = (*inside[:-1], "PATH=/var/openmb4-wheel/venv/bin:/usr/bin:/bin")
        where = programs.call(*inside, "python", "-c", "import openmb4; print(openmb4.files())").strip()
        read_positions(lambda *words: programs.call(*inside, *words), where)
    finally:
        shutil.rmtree(place, ignore_errors=True)


def make_wheel(folder):
    """The wheel that tools/release.sh makes of the last commit."""
    clone = folder / "clone"
    git("clone", "-q", "--no-hardlinks", str(programs.ROOT), str(clone), cwd=folder)
    quick = {} if sys.argv[1:] == ["--released"] else QUICK
    programs.call(clone / "tools" / "release.sh", "--wheel", folder / "out", env=os.environ | quick)
    wheels = list((folder / "out" / "python").glob("*.whl"))
    assert len(wheels) == 1, wheels
    return wheels[0]


def main():
    given = os.environ.get("MB4_WHEEL")
    if not given and not (programs.ROOT / ".git").exists():
        print("skipped: not a git checkout")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        new = folder / "new"
        python = new / "bin" / "python"
        try:
            programs.call("/usr/bin/python3", "-m", "venv", new)
            programs.call(python, "-m", "pip", "download", "-q", "--no-deps", "--dest", folder / "pypi",
                          "scikit-build-core", timeout=60)
        except (AssertionError, OSError, subprocess.TimeoutExpired) as error:
            print(f"skipped: no environment with packages from PyPI: {str(error)[-300:]}")
            sys.exit(SKIPPED)
        wheel = Path(given).resolve() if given else make_wheel(folder)
        version = re.escape(programs.version())
        found = re.fullmatch(rf"openmb4-{version}-py3-none-manylinux_2_(\d+)_\w+\.whl", wheel.name)
        assert found and int(found[1]) <= OLDEST, wheel
        check_contents(wheel, folder / "contents")
        # The path holds no compiler.
        (folder / "sh").mkdir()
        (folder / "sh" / "sh").symlink_to("/bin/sh")
        path = {"PATH": f"{new / 'bin'}:{folder / 'sh'}"}
        programs.call(python, "-m", "pip", "install", "-q", wheel, env=path)
        where = Path(programs.call(python, "-c", "import openmb4; print(openmb4.files())").strip())
        read_positions(lambda *words: programs.call(*words, env=path, cwd=folder), where)
        check_library(where, folder)
        check_clean_root(wheel, python, folder)
        print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
