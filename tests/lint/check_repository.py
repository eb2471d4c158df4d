#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of every tracked file.

  check_repository.py licences    the two SPDX lines in the file or in FILE.license
  check_repository.py paths       no path of somebody's machine
  check_repository.py verilator   every call of Verilator goes through tools/cmake/mb4.cmake or
                                  carries -fno-const-bit-op-tree
  check_repository.py merged      no marks of an unfinished merge
  check_repository.py self-test   planted faults are reported
"""

import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402

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


def tracked():
    """Tracked files as {relative name: text or None}."""
    git = project.tool("git")
    if not (project.ROOT / ".git").exists():
        print("skipped: not a git checkout, tracked files are unknown")
        sys.exit(project.SKIPPED)
    done = subprocess.run([git, "-c", f"safe.directory={project.ROOT}", "ls-files", "-z"],
                          cwd=project.ROOT, capture_output=True, check=True)
    files = {}
    for name in done.stdout.decode("utf-8").split("\0"):
        path = project.ROOT / name
        if name and path.is_file():
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
             "verilator": verilator_findings}[sys.argv[1]]
    files = tracked()
    project.finish(check(files), f"{len(files)} tracked files")


main()
