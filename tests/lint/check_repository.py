#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of every tracked file.

  check_repository.py licences    the two SPDX lines in the file or in FILE.license
  check_repository.py paths       no path of somebody's machine
  check_repository.py verilator   every call of Verilator goes through tools/cmake/mb4.cmake or
                                  carries -fno-const-bit-op-tree
  check_repository.py merged      no marks of an unfinished merge
  check_repository.py lines       no kind of line and no master in the rooms of the simulator that
                                  all share
  check_repository.py runnable    scripts with "#!" have their run bit, nothing else has it
  check_repository.py version     the version stands in project() of CMakeLists.txt; the files that must
                                  repeat it say the same, no other file does
  check_repository.py rooms       README.md names every folder of rtl/, tests/ and tools/, docs/README.md
                                  every page of docs/
  check_repository.py decisions   docs/choices.md has a row for every "decision N"
  check_repository.py masters     the simulator's rooms below the masters name no master of masters.toml beside the
                                  iC-MB4: a master registers what it accepts
  check_repository.py self-test   planted faults are reported
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools"))
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
from set_version import VERSION_COPIES, VERSION_FILE, VERSION_LINE  # noqa: E402

FLAG = "-fno-const-bit-op-tree"
HELPER = "tools/cmake/mb4.cmake"
# Shows what happens without the flag.
CANARY = "tests/canary/"

# Folders that exist on one machine only. Written with gaps, so that this file passes its own check.
MACHINE_PATH = re.compile(
    r"(?<![\w.$}~:-])/(?:" + "home|" "Users" r")/\w|(?<![\w.$}~/-])/(?:" + "root|work|farm"
    r")(?:/\w|\b(?![\w/-]))|(?<![\w.$}~/-])/" + "tmp" r"/\w")

# A mode option says that a line calls Verilator; --version or a mere mention does not.
MODE = re.compile(r"(?<![\w-])--(?:cc|sc|binary|lint-only|xml-only|dpi-hdr-only)\b")

# The files of each register map are checked in; tools/set_version.py has the others.
IPXACT = ".ipxact.xml", r"<ipxact:version>(\d+)\.(\d+)\.(\d+)</ipxact:version>"
# The newest release; a tree before its first release has none.
RELEASE = {"CHANGELOG.md": r"(?m)^## \[(\d+)\.(\d+)\.(\d+)\]"}

CHOICES = "docs/choices.md"
# "decision 8", "decisions 1, 22..24 and 31", also when a comment breaks the line between them.
GAP = r"(?:\s|\n[ \t]*(?://|#|\*))*"
DECISIONS = re.compile(
    rf"\b[Dd]ecisions?{GAP}(\d+(?:{GAP}(?:,|\.\.|and\b){GAP}\d+)*)")


def tracked():
    """Tracked files as {relative name: text or None}."""
    files = {}
    for name in project.tracked():
        path = project.ROOT / name
        if path.is_file():
            try:
                files[name] = path.read_bytes().decode("utf-8")
            except UnicodeDecodeError:
                files[name] = None
    return files


def licence_findings(files):
    findings = []
    for name, text in files.items():
        sidecar = f"{name}.license"
        source = files.get(sidecar) if sidecar in files else (text or "")
        head = "\n".join((source or "").splitlines()[:12])
        for tag in ("SPDX-FileCopyrightText: ", "SPDX-License-Identifier: "):
            if tag not in head and not name.startswith("LICENSES/"):
                findings.append(f"{name}:1: no {tag.strip(': ')}")
    return findings


def path_findings(files):
    findings = []
    for name, text in files.items():
        for number, line in enumerate((text or "").splitlines(), 1):
            for match in MACHINE_PATH.finditer(line):
                findings.append(f"{name}:{number}: path of a machine: {line[match.start():][:40]}")
    return findings


def merge_findings(files):
    findings = []
    for name, text in files.items():
        for number, line in enumerate((text or "").splitlines(), 1):
            if re.match(r"(?:<{7}|>{7}|\|{7})(?: |$)", line):
                findings.append(f"{name}:{number}: mark of a merge: {line[:40]}")
    return findings


def has_run_bit(name):
    return (project.ROOT / name).stat().st_mode & 0o111 != 0


def runnable_findings(files, run_bit=has_run_bit):
    findings = []
    for name, text in files.items():
        script = (text or "").startswith("#!")
        if script != run_bit(name):
            findings.append(f"{name}:1: " + ('"#!" and no run bit' if script else
                                             'run bit and no "#!"'))
    return findings


def statement(text, position):
    """The call around a position: up to the lines with neither continuation nor open bracket. As an
    approximation the lines of the same paragraph."""
    start = text.rfind("\n\n", 0, position) + 1
    end = text.find("\n\n", position)
    return text[start:end if end >= 0 else len(text)]


def verilator_findings(files):
    findings = []
    for name, text in files.items():
        if text is None or name.startswith(CANARY) or name.endswith((".md", ".v", ".sv")):
            continue
        calls = [m for m in MODE.finditer(text) if "verilator" in text.lower()]
        if name.endswith((".cmake", "CMakeLists.txt")):
            code = re.sub(r"#[^\n]*", lambda m: " " * len(m.group(0)), text)
            calls += re.finditer(r"(?<!\w)verilate\s*\(", code)
        for call in calls:
            if FLAG not in statement(text, call.start()):
                line = text.count("\n", 0, call.start()) + 1
                findings.append(f"{name}:{line}: Verilator without {FLAG}; use {HELPER}")
    if not re.search(rf"verilate\([^)]*{FLAG}", files.get(HELPER) or "", re.S):
        findings.append(f"{HELPER}: verilate() without {FLAG}")
    return findings


def version_findings(files):
    line = re.search(VERSION_LINE, files.get(VERSION_FILE) or "")
    if not line:
        return [f"{VERSION_FILE}:1: no line project(openmb4 VERSION x.y.z"]
    version = ".".join(line.groups())
    findings = []
    copies = VERSION_COPIES | {name: IPXACT[1] for name in files if name.endswith(IPXACT[0])}
    for name, pattern in {**copies, **RELEASE}.items():
        copy = re.search(pattern, files.get(name) or "")
        if copy is None and name in RELEASE:
            continue
        if copy is None or copy.groups() != line.groups():
            said = "none" if copy is None else ".".join(copy.groups())
            findings.append(f"{name}:1: version {said}; {VERSION_FILE} says {version}")
    # "==1.2.3" is the version of another project's package.
    literal = re.compile(rf"(?<![\w.=]){re.escape(version)}(?!\w|\.\d)")
    for name in files.keys() - {VERSION_FILE, *copies, *RELEASE}:
        for number, row in enumerate((files[name] or "").splitlines(), 1):
            if literal.search(row):
                findings.append(f"{name}:{number}: repeats the version {version} of {VERSION_FILE}")
    return findings


def room_findings(files):
    findings = set()
    for name in files:
        room, *inside = name.split("/")
        if room in ("rtl", "tests", "tools") and len(inside) > 1:
            page, mention = "README.md", f"`{inside[0]}/`"
        elif room == "docs" and len(inside) == 1 and name.endswith(".md") and name != "docs/README.md":
            page, mention = "docs/README.md", f"({inside[0]})"
        else:
            continue
        if mention not in (files.get(page) or ""):
            findings.add(f"{page}:1: does not name {mention} of {room}/")
    return sorted(findings)


def decision_findings(files):
    rows = set(re.findall(r"(?m)^\| (\d+) \|", files.get(CHOICES) or ""))
    findings = []
    for name, text in files.items():
        for match in DECISIONS.finditer(text or ""):
            line = text.count("\n", 0, match.start()) + 1
            for first, last in re.findall(r"(\d+)(?:\.\.(\d+))?", match[1]):
                findings += [f"{name}:{line}: {CHOICES} has no row {number}"
                             for number in range(int(first), int(last or first) + 1)
                             if str(number) not in rows]
    return findings


def name_of_master():
    """A pattern for the names of the masters, whole ones: a kind of line has the first word of its master's (sim/lines/dsl/).
    A master with the name of a kind of line is left out."""
    names = [name.replace("-", "_") for name in project.MASTERS
             if name != "mb4" and not (project.ROOT / "sim" / "lines" / name).is_dir()]
    words = "|".join(form for name in names for form in (
        name, name.upper(), name.replace("_", "-"), "".join(part.capitalize() for part in name.split("_"))))
    return re.compile(rf"(?<![A-Za-z])(?:{words})(?![a-z])|_(?:{'|'.join(names)})(?![a-z])")


def master_findings(files):
    rooms = ("sim/core/", "sim/lines/", "sim/scenario/", "sim/faults/")
    findings = []
    pattern = name_of_master()
    for name, text in files.items():
        if not name.startswith(rooms) or text is None:
            continue
        for number, line in enumerate(text.splitlines(), 1):
            if pattern.search(line):
                findings.append(f"{name}:{number}: names a master: {line.strip()}")
    return findings


SHARED_ROOMS = ("sim/core/", "sim/scenario/", "sim/faults/", "sim/capi/", "sim/include/", "sim/simulator.cpp")
C_HEADER = "sim/include/mb4sim.h"
WORDS_OF_ONE = {"ma", "mo", "sl", "cdm", "eot", "chain", "biss", "mb4"}
NAMES_OF_ALL = re.compile(r"\bnamespace mb4(?:::sim)?\b|\bmb4::|\bopenmb4|\bmb4sim\w*|\bMB4SIM_\w*")


def words_of(identifier):
    """The identifier and its parts, between underscores or capitals, in small letters."""
    words = {identifier, *identifier.split("_")}
    words.update(re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", identifier))
    return {word.lower() for word in words}


def line_findings(files):
    """A shared room knows no kind of line and no master: it includes nothing of their rooms, and none
    of their words is there. Exempt: the C interface with its names."""
    contract = set(re.findall(r"\w+", files.get(C_HEADER) or ""))
    findings = []
    for name, text in files.items():
        shared = name.startswith(SHARED_ROOMS) or re.fullmatch(r"sim/masters/\w+\.hpp", name)
        if not shared or text is None or name == C_HEADER or not name.endswith((".hpp", ".cpp", ".h")):
            continue
        for number, line in enumerate(text.splitlines(), 1):
            if re.match(r'\s*#\s*include "sim/lines/\w+/', line):
                findings.append(f"{name}:{number}: includes a file of one kind of line: {line.strip()}")
            for identifier in re.findall(r"[A-Za-z_]\w*", NAMES_OF_ALL.sub(" ", line)):
                if name.startswith("sim/capi/") and identifier in contract:
                    continue
                if words := words_of(identifier) & WORDS_OF_ONE:
                    findings.append(f"{name}:{number}: {identifier} has the word '{min(words)}' "
                                    "of one kind of line or master")
    return findings


def self_test():
    findings = []

    def expect(count, found, what):
        if len(found) != count:
            findings.append(f"{what}: expected {count} finding(s), got {found}")

    spdx = "# SPDX-FileCopyrightText: 2026 X\n# SPDX-License-Identifier: Apache-2.0\n"
    expect(0, licence_findings({"a.py": spdx, "b.bin": None, "b.bin.license": spdx}), "licences")
    expect(2, licence_findings({"a.py": "print()\n"}), "no SPDX line")
    expect(1, licence_findings({"a.py": spdx.split("\n", maxsplit=1)[0]}), "one SPDX line")
    expect(2, licence_findings({"b.bin": None}), "no sidecar")

    for path in ("/" "home/joe/x", "/" "root/x", "see /" "work/x", "/" "tmp/build/a", "/" "farm"):
        expect(1, path_findings({"a.md": path}), path)
    for path in ("https://example.org/" "home/joe", "$HOME/" "work/x", "docs/" "root/x",
                 "read/" "work", "mktemp -d /" "tmp", "${dir}/" "tmp/x"):
        expect(0, path_findings({"a.md": path}), path)

    for mark in ("<" * 7 + " HEAD", ">" * 7 + " 0123abc (subject)", "|" * 7 + " base"):
        expect(1, merge_findings({"a.sh": f"x\n{mark}\n"}), mark)
    for text in ("=" * 7, "a " + "<" * 7 + " b", ">" * 8):
        expect(0, merge_findings({"a.md": text}), text)

    for text, bit, count in (("#!/bin/sh\n", True, 0), ("#!/bin/sh\n", False, 1), ("x\n", True, 1),
                             ("x\n", False, 0), (None, True, 1)):
        expect(count, runnable_findings({"a": text}, lambda _, bit=bit: bit), f"run bit of {text}")

    *cores, header, component, manifest, lock = VERSION_COPIES
    core, axi_core, *others = cores
    ipxact, changelog = "any" + IPXACT[0], *RELEASE
    good = {VERSION_FILE: "project(openmb4 VERSION 1.2.3 LANGUAGES C)\n",
            core: "name: openmb4:ip:mb4:1.2.3\n", axi_core: "name: openmb4:ip:biss_axi:1.2.3\n",
            **dict.fromkeys(others, "name: openmb4:ip:other:1.2.3\n"),
            header: "kVersionMajor = 1;\nint kVersionMinor = 2;\nint kVersionPatch = 3;\n",
            component: 'version: "1.2.3"\n', manifest: 'version = "1.2.3"\n',
            lock: 'name = "cc"\nversion = "1.4.0"\n\nname = "openmb4"\nversion = "1.2.3"\n',
            ipxact: "<ipxact:version>1.2.3</ipxact:version>\n",
            changelog: "## [Unreleased]\n\n## [1.2.3] - 2026-01-01\n\n## [1.2.2] - 2025-01-01\n",
            "a.txt": "package==1.2.3 11.2.3 1.2.34 1.2.3.4\n", "b.bin": None}
    expect(0, version_findings(good), "versions")
    expect(0, version_findings({**good, changelog: "## [Unreleased]\n"}), "no release yet")
    for name, text in ((VERSION_FILE, "project(openmb4)"), (core, ""), (header, ""), (component, ""), (ipxact, ""),
                       ("a.txt", "Version 1.2.3."), ("a.h", '"1.2.3"'),
                       *((name, good[name].replace("3", "4", 1))
                         for name in (*cores, header, component, manifest, lock, ipxact, changelog))):
        expect(1, version_findings({**good, name: text}), f"version in {name}: {text}")

    rooms = {"README.md": "`unit/`", "docs/README.md": "[speed](speed.md)", "tests/unit/a.py": "",
             "tests/CMakeLists.txt": "", "docs/speed.md": "", "docs/pictures/a.svg": ""}
    expect(0, room_findings(rooms), "rooms")
    expect(1, room_findings({**rooms, "tests/chip/a.cpp": "", "tests/chip/b.cpp": ""}), "a new room")
    expect(1, room_findings({**rooms, "docs/new.md": ""}), "a new page")

    for text, count in (("maximum axis", 0), ("class AxiHost", 1), ("AXI4-Lite", 1),
                        ('"axi"', 1), ("biss_axi", 1), ("class DslModel", 1), ('"dsl-model"', 1), ("kind dsl", 0)):
        expect(count, master_findings({"sim/core/a.hpp": text}), f"master: {text}")
    expect(0, master_findings({"sim/masters/axi/a.hpp": "AxiHost", "sim/core/b": None}), "its own room")

    for text, count in (("kMaWire", 1), ("ma_check", 1), ("MA is low", 1), ("on SL or MO", 2), ("slow map", 0),
                        ("EOT", 1), ("#include \"sim/lines/biss/x.hpp\"", 2), ("clockedChain", 1),
                        ("#include \"sim/lines/crc.hpp\"", 0), ("namespace mb4::sim {", 0),
                        ("#ifndef MB4SIM_MA_HPP_", 0), ("iC-MB4", 1), ("openmb4", 0)):
        for name in ("sim/core/a.hpp", "sim/masters/a.hpp", "sim/simulator.cpp"):
            expect(count, line_findings({name: text}), f"line: {text}")
    expect(0, line_findings({"sim/masters/mb4/a.hpp": "MA", "sim/lines/biss/a.hpp": "MA", C_HEADER: "MA"}),
           "their own rooms")
    expect(0, line_findings({C_HEADER: "unsigned ma_edges;", "sim/capi/a.cpp": "frame.ma_edges = 1;"}),
           "a name of the C interface")
    expect(1, line_findings({C_HEADER: "", "sim/capi/a.cpp": "frame.ma_edges = 1;"}), "no such name")

    choices = {CHOICES: "| no. | x |\n|---|---|\n| 1 | a |\n| 3 | b |\n| 4 | c |\n| 4 | d |\n| | e |\n"}
    for text, count in (("decision 1", 0), ("Decisions 1, 3 and 4, page 2", 0), ("decision 2", 1),
                        ("decisions 3..5", 1), ("decision\n// 2", 1), ("decisions 1,\n  # 2, 5", 2),
                        ("decision 4: 2 zeros", 0), ("12 decisions. 2", 0)):
        expect(count, decision_findings({**choices, "a.sv": text}), f"decisions: {text}")

    helper = {HELPER: f"verilate(x VERILATOR_ARGS {FLAG})"}
    expect(0, verilator_findings(helper), "helper")
    bare = {HELPER: "verilate(x VERILATOR_ARGS -Wall)"}
    expect(1, verilator_findings(bare)[-1:], "helper's flag")
    script = "t/CMakeLists.txt"
    expect(1, verilator_findings({**helper, script: "verilate(x TOP_MODULE y)"}), "verilate")
    expect(0, verilator_findings({**helper, script: "# verilate() is\nmb4_verilate(x)"}),
           "mb4_verilate")
    expect(1, verilator_findings({**helper, "t.sh": "verilator --" "cc x.sv\n"}), "script")
    expect(0, verilator_findings({**helper, "t.sh": f"verilator --" f"cc {FLAG} x.sv\n"}), "flag")
    expect(0, verilator_findings({**helper, "t.sh": "verilator --version\n"}), "version")
    project.finish(findings, "planted faults, all reported")


def main():
    if sys.argv[1] == "self-test":
        self_test()
    check = {"licences": licence_findings, "paths": path_findings, "merged": merge_findings,
             "runnable": runnable_findings,
             "verilator": verilator_findings, "version": version_findings,
             "rooms": room_findings, "masters": master_findings, "lines": line_findings,
             "decisions": decision_findings}[sys.argv[1]]
    files = tracked()
    project.finish(check(files), f"{len(files)} tracked files")


main()
