#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What examples/ci and tools/Containerfile call exists: scripts, presets, targets, options of mb4sim.
Nothing is run. ci_test.py MB4SIM BUILD; exit status 77: no PyYAML."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

try:
    import yaml
except ImportError:
    print(f"skipped: {sys.executable} has no yaml: tools/setup.sh test")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[2]
MB4SIM, BUILD = sys.argv[1:]
OURS = re.compile(r"^(tools|build/bin)/")


def lines_of(text):
    """Commands of a workflow, wherever they stand: under `run`, `script` or `before_script`."""
    def walk(value, script):
        if isinstance(value, dict):
            for key, inner in value.items():
                yield from walk(inner, key in ("run", "script", "before_script"))
        elif isinstance(value, list):
            for inner in value:
                yield from walk(inner, script)
        elif script:
            yield from value.strip().splitlines()
    return list(walk(yaml.safe_load(text), False))


def fault_of(line, presets, targets):
    """What is wrong with a command of ours, or None."""
    for part in line.split(" && "):
        words = shlex.split(part)
        if words[0] == "cmake":
            if "--preset" in words and words[words.index("--preset") + 1] not in presets:
                return f"{part}: no such preset"
            if "--target" in words and words[words.index("--target") + 1] not in targets:
                return f"{part}: no such target"
        elif words[0] == "build/bin/mb4sim":
            said = subprocess.run([MB4SIM, words[1], "--help"], check=False, text=True,
                                  capture_output=True)
            unknown = [word for word in words if word.startswith("--") and word not in said.stdout]
            if said.returncode or unknown:
                return f"{part}: {unknown or words[1]} unknown"
        elif OURS.match(words[0]) and not os.access(ROOT / words[0], os.X_OK):
            return f"{part}: no such script"
    return None


def main():
    presets = {one["name"] for one in
               json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}
    said = subprocess.run(["ninja", "-C", BUILD, "-t", "targets", "all"], check=True, text=True,
                          capture_output=True).stdout
    targets = {Path(line.split(":")[0]).name for line in said.splitlines()}
    assert fault_of("tools/tset.sh", presets, targets), "a planted fault is not found"
    assert fault_of("cmake --build build --target mb4sm", presets, targets), "the same"
    assert fault_of("build/bin/mb4sim regress --sed 1", presets, targets), "the same"

    found = {path: lines_of(path.read_text()) for path in (ROOT / "examples/ci").glob("*.yml")}
    image = ROOT / "tools/Containerfile"
    found[image] = re.findall(r"^RUN (.*)$", image.read_text().replace("\\\n", ""), re.M)
    assert len(found) == 3 and all(len(lines) >= 3 for lines in found.values())
    faults = [f"{path.relative_to(ROOT)}: {fault}" for path, lines in found.items()
              for line in lines if (fault := fault_of(line, presets, targets))]
    print("\n".join(faults) or f"{sum(map(len, found.values()))} commands")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
