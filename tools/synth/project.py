# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What the scripts in tools/ and tests/ know about the project: the file lists, Verilator's flags,
and how a missing tool is reported.

  project.py   prints the RTL files in their order, for a tool's command line
"""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import masters  # noqa: E402

listed = masters.listed
MASTERS = masters.load()
RTL = ROOT / "rtl"
INCLUDE = RTL / "common"          # enc_check.svh
WAIVERS = RTL / "waivers.vlt"     # of Verilator's lint
SKIPPED = 77


class Arguments(argparse.ArgumentParser):
    """Of a script with the text of its head as help; a wrong use ends with one line."""

    def __init__(self, text):
        super().__init__(description=text, allow_abbrev=False,
                         formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}; --help tells more\n")

    def folder(self, text):
        path = Path(text).resolve()
        if path.exists() and not path.is_dir():
            raise argparse.ArgumentTypeError(f"{text} is no folder")
        return path


def rtl_files(master="mb4"):
    """The files that the list of a master names, itself or by the lists of lower rooms, as absolute paths."""
    return listed(MASTERS[master].list)


def all_rtl_files():
    """The files of all masters, each once."""
    files = []
    for master in MASTERS.values():
        files += [path for path in (listed(master.list) if master.list else ()) if path not in files]
    return files


def files_of(module):
    """The files of the first master whose list has a module."""
    for master in MASTERS.values():
        files = listed(master.list) if master.list else []
        if any(path.stem == module for path in files):
            return files
    raise SystemExit(f"{module}: no list of {masters.FILE} has this module")


def rtl_lists():
    """The lists of all masters, and the lower ones on their lines -F."""
    found = [master.list for master in MASTERS.values() if master.list]
    for path in found:  # grows
        below = re.findall(r"(?m)^-F +(\S+)", path.read_text(encoding="utf-8"))
        found += [lower for lower in ((path.parent / name).resolve() for name in below) if lower not in found]
    return found


def tops(key):
    """{name: top} of all masters that have the key: those with plain = true, with clocks, ..."""
    return {name: top for master in MASTERS.values() for name, top in master.tops.items() if getattr(top, key)}


def all_of(key):
    """{name: design} of all masters: gates, measured."""
    return {name: design for master in MASTERS.values() for name, design in getattr(master, key).items()}


def design(name):
    """The measured design of this name; ends the script if there is none."""
    designs = all_of("measured")
    if name not in designs:
        raise SystemExit(f"{masters.FILE}: no design '{name}' in `measured` of a master; there are {', '.join(designs)}")
    return designs[name]


def master_argument(parser, has="list"):
    """Adds --master NAME to a parser; NAME is one that has RTL, or what `has` says."""
    names = [name for name, master in MASTERS.items() if getattr(master, has)]
    parser.add_argument("--master", choices=names, metavar="NAME", help=f"of masters.toml: {', '.join(names)}")


def rtl_modules():
    """Module name to file, of all masters, without the packages."""
    return {path.stem: path for path in all_rtl_files() if not path.stem.endswith("_pkg")}


def instances(code, modules):
    """Those of the modules that SystemVerilog code without comments instantiates."""
    return {word for word in re.findall(r"^\s*(\w+)\s*(?:#\s*\(|u_\w+\s*\()", code, re.M) if word in modules}


def rtl_packages():
    return [path for path in all_rtl_files() if path.stem.endswith("_pkg")]


def presets(master="mb4"):
    """Preset name to its value of the parameter Features, as the register map of the master's presets has them."""
    text = MASTERS[master].presets.read_text(encoding="utf-8")
    return {name.lower(): int(value, 16) for name, value in
            re.findall(r'"FEATURES_(\w+)", value: (0x[0-9A-F]{4})', text)}


def tracked():
    """The tracked files' names; ends as skipped where there is no git checkout."""
    git = tool("git")
    if not (ROOT / ".git").exists():
        print("skipped: not a git checkout, tracked files are unknown")
        sys.exit(SKIPPED)
    done = subprocess.run([git, "-c", f"safe.directory={ROOT}", "ls-files", "-z"], cwd=ROOT,
                          capture_output=True, check=True)
    return [name for name in done.stdout.decode("utf-8").split("\0") if name]


def verilator_flags():
    """The flags that tools/cmake/mb4.cmake gives to every model, the one against wrong XOR trees
    (-fno-const-bit-op-tree) among them."""
    text = (ROOT / "tools" / "cmake" / "mb4.cmake").read_text(encoding="utf-8")
    flags = re.search(r"VERILATOR_ARGS([^)]*)\)", text).group(1).replace("${ARG_ARGS}", "").split()
    if "-Wall" not in flags or "-fno-const-bit-op-tree" not in flags:
        raise SystemExit("tools/cmake/mb4.cmake: -Wall or -fno-const-bit-op-tree has gone")
    return flags


def tool(name):
    """Path of a program; ends the test as skipped if it is not installed."""
    path = shutil.which(name)
    if path is None:
        print(f"skipped: {name} is not installed")
        sys.exit(SKIPPED)
    return path


def run(command, **options):
    """Exit status and all text of a command."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False, **options)
    return done.returncode, done.stdout


def finish(findings, passed):
    """Prints findings and ends: exit status 1 if there is one, else the sentence `passed`."""
    for finding in findings:
        print(finding)
    if findings:
        print(f"{len(findings)} finding(s)")
        sys.exit(1)
    print(passed)
    sys.exit(0)


if __name__ == "__main__":
    print(*rtl_files(*sys.argv[1:2]))   # of a master; without its name those of the iC-MB4
