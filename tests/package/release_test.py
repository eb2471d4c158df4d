# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The release archive: the committed files and plain Verilog of the tops, no others; the same bytes
each time."""
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
from pathlib import Path

import programs
from programs import ROOT

sys.path.insert(0, str(ROOT / "tools" / "synth"))

import constraints  # noqa: E402
import project  # noqa: E402

SKIPPED = 77


def git(*arguments, cwd):
    safe = f"safe.directory={ROOT}"
    return subprocess.run(["git", "-c", safe, "-c", f"safe.directory={cwd}", *arguments], cwd=cwd,
                          capture_output=True, text=True, timeout=100, check=True).stdout


def check_sdist(folder, version):
    """CMake configures it as pip does: no file is missing that the build names."""
    with tarfile.open(folder / "b" / "python" / f"openmb4-{version}.tar.gz") as tar:
        tar.extractall(folder)
    top = folder / f"openmb4-{version}"
    settings = tomllib.loads((top / "pyproject.toml").read_text())["tool"]["scikit-build"]
    for package in settings["wheel"]["packages"]:
        assert (top / package / "__init__.py").exists(), settings
    project = tomllib.loads((top / "pyproject.toml").read_text())["project"]
    assert (top / project["readme"]).exists() and project["scripts"]["mb4sim"], project
    assert (top / settings["metadata"]["version"]["input"]).exists(), settings
    assert (top / "PKG-INFO").exists()
    done = subprocess.run(["cmake", "-S", top / settings["cmake"]["source-dir"], "-B", folder / "pip",
                           "-G", "Ninja", "-DSKBUILD=2", "-DBUILD_TESTING=OFF"],
                          capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    done = subprocess.run(["ninja", "-n", *settings["build"]["targets"]], cwd=folder / "pip",
                          capture_output=True, text=True, timeout=100, check=False)
    assert done.returncode == 0 and str(ROOT) not in done.stdout, done.stdout[-500:]


def without_compilers(folder):
    """An environment in which nothing can be compiled: the programs on its path are links to those that
    tools/release.sh and the scripts below it need for the archives."""
    path = folder / "path"
    path.mkdir()
    for name in ("bash", "berkeley-abc", "cat", "cp", "dirname", "env", "find", "git", "gzip", "mkdir", "mktemp", "mv",
                 "python3", "rm", "sed", "sha256sum", "sh", "sort", "tail", "tar", "tee", "xargs", "yosys",
                 "yosys-abc"):
        if found := shutil.which(name):
            (path / name).symlink_to(found)
    return {**os.environ, "PATH": str(path)}


def check_all(out, said):
    """What --all has made where nothing can be compiled, and what it says of the rest."""
    for what in ("the wheel: cmake", "the packages: cmake", "the page for a browser: emcmake"):
        assert f"release: skipped {what} is missing" in said, said
    assert (out / "Containerfile").read_bytes() == (ROOT / "tools" / "Containerfile").read_bytes()
    sums = dict(reversed(line.split(maxsplit=1))
                for line in (out / "SHA256SUMS").read_text().splitlines())
    assert {name.rstrip(".0123456789").split("-")[0] for name in sums} >= {"Containerfile", "openmb4"}, sums
    for name, checksum in sums.items():
        assert hashlib.sha256((out / name).read_bytes()).hexdigest() == checksum, name
    files = {str(file.relative_to(out)) for file in out.rglob("*") if file.is_file()}
    assert set(sums) == {name for name in files if not name.endswith((".sha256", "SHA256SUMS"))}, files


def main():
    if not (ROOT / ".git").exists():
        print("skipped: not a git checkout")
        sys.exit(SKIPPED)
    if shutil.which("yosys") is None:
        print("skipped: yosys is not installed")
        sys.exit(SKIPPED)
    version = programs.version()
    with tempfile.TemporaryDirectory() as folder:
        # A clone: the working tree at hand may be in the middle of something.
        clone = Path(folder) / "clone"
        git("clone", "-q", "--no-hardlinks", str(ROOT), str(clone), cwd=folder)
        script = clone / "tools" / "release.sh"
        if not script.exists():
            script.write_bytes((ROOT / "tools" / "release.sh").read_bytes())
            script.chmod(0o755)
        sums = []
        for name, options in (("a", []), ("b", ["--all"])):
            out = Path(folder) / name
            done = subprocess.run([script, *options, out], capture_output=True, text=True, timeout=700,
                                  check=True, env=without_compilers(Path(folder)) if options else None)
            archive = Path(done.stdout.strip())
            assert archive == out / f"openmb4-{version}.tar.gz", archive
            sums.append(hashlib.sha256(archive.read_bytes()).hexdigest())
            assert (out / (archive.name + ".sha256")).read_text().split() == [sums[-1], archive.name]
        assert sums[0] == sums[1], "two archives of one commit differ"
        check_all(out, done.stderr)
        tracked = set(git("ls-files", cwd=clone).splitlines())
        with tarfile.open(archive) as tar:
            packed = {member.name for member in tar.getmembers() if not member.isdir()}
            plain = tar.extractfile(f"openmb4-{version}/verilog/mb4_chip.v").read().decode()
        tracked |= {f"verilog/{top}.v" for top in project.tops("plain")}
        tracked |= {f"rtl/mb4/constraints/{preset}/{name.format(top)}" for preset in list(project.presets())[1:]
                    for top in constraints.TOPS for name in constraints.FILES.values()}
        tracked |= {f"ipxact/{top}.xml" for top in project.tops("buses")}
        for place, top in enumerate(project.tops("generics")):
            vivado = f"ipxact/vivado{f'-{top}' if place else ''}"
            tracked |= {f"{vivado}/component.xml", f"{vivado}/xgui/{top}.tcl"}
        assert {"verilog/mb4_core.v", "ipxact/biss_axi.xml", "ipxact/vivado/component.xml"} <= tracked
        assert packed == {f"openmb4-{version}/{name}" for name in tracked}, (
            f"other files, {sorted(packed ^ {f'openmb4-{version}/{name}' for name in tracked})[:5]}: the archive is of the "
            "last commit, masters.toml of the working tree")
        sdists = [Path(folder, out, "python", archive.name).read_bytes() for out in ("a", "b")]
        assert sdists[0] == sdists[1], "two sdists of one commit differ"
        check_sdist(Path(folder), version)
        # tests/icarus shows that the plain file works.
        assert 'ASYNC_REG = "TRUE"' in plain and "src =" not in plain and str(clone) not in plain, plain[:500]
        assert "`timescale" in plain and len(re.findall(r"^module ", plain, re.M)) == 1, plain[:500]
        (clone / "README.md").write_text("changed")
        done = subprocess.run([script, Path(folder) / "c"], capture_output=True, text=True,
                              timeout=100, check=False)
        assert done.returncode == 1 and "not committed" in done.stderr, done
    print(f"{len(tracked)} files")


if __name__ == "__main__":
    main()
