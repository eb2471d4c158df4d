#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Does `tools/test.sh --changed` find a failing test for each fault of faults.toml, and how fast?

  seeded_faults.py FOLDER [PLACE...]

FOLDER becomes a clone of this repository's HEAD with a build of its own, which is made and tested once; FOLDER-kept is
a copy of that build. Then one fault after the other is put in, and taken out again. A PLACE is a part of a file's name:
only those. The processor seconds are of the whole command, build and tests, without a compiler cache. The exit status
is 1 if a fault was not found or took more than 180 of them.
"""

import os
import re
import resource
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MOST_S = 180


def run(command, folder, **environment):
    """Exit status, output, and processor seconds of a command and all that it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(list(map(str, command)), cwd=folder, check=False, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env={**os.environ, **environment})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.returncode, done.stdout, sum(after[:2]) - sum(before[:2])


def must(command, folder, **environment):
    status, text, seconds = run(command, folder, **environment)
    if status != 0:
        sys.exit(f"seeded_faults.py: {' '.join(map(str, command))}: status {status}\n{text[-3000:]}")
    return seconds


def keep_build(tree):
    """A copy of the build with everything built, which costs less than to build it again."""
    kept = tree.parent / f"{tree.name}-kept"
    must(["cmake", "--build", "build"], tree)
    must(["rm", "-rf", kept], tree)
    must(["cp", "-a", "build", kept], tree)
    return kept


def attempt(tree, kept, fault):
    """The failing tests, and the processor seconds. Afterwards the tree is as it was, and built."""
    path = tree / fault["file"]
    text, times = path.read_text(encoding="utf-8"), path.stat()
    if text.count(fault["text"]) != 1:
        sys.exit(f"seeded_faults.py: {fault['file']}: '{fault['text']}' does not stand there once")
    path.write_text(text.replace(fault["text"], fault["fault"]), encoding="utf-8")
    status, printed, seconds = run(["tools/changed_tests.py", "build"], tree, CCACHE_DISABLE="1")
    path.write_text(text, encoding="utf-8")
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    must(["rm", "-rf", "build"], tree)
    must(["cp", "-a", kept, "build"], tree)
    found = re.findall(r"^\[  FAILED  \] ([\w/.]+)", printed, re.M) + re.findall(r"^changed: failed: (.+)", printed, re.M)
    if status != 0 and not found:  # the fault does not compile: no test was asked
        sys.exit(f"seeded_faults.py: {fault['file']}: no test has failed, but status {status}\n{printed[-3000:]}")
    return found, seconds


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tree = Path(sys.argv[1]).resolve()
    faults = tomllib.loads((Path(__file__).parent / "faults.toml").read_text(encoding="utf-8"))["fault"]
    faults = [one for one in faults if not sys.argv[2:] or any(place in one["file"] for place in sys.argv[2:])]
    if not (tree / ".git").exists():
        must(["git", "-c", f"safe.directory={ROOT}/.git", "clone", "-q", ROOT, tree], ROOT)
        must(["cmake", "--preset", "default"], tree)
        must(["cmake", "--build", "build"], tree)
        print(f"all tests once: {must(['tools/changed_tests.py', 'build'], tree):.0f} processor seconds", flush=True)
    kept = keep_build(tree)
    missed = 0
    for fault in faults:
        found, seconds = attempt(tree, kept, fault)
        good = bool(found) and seconds <= MOST_S
        missed += not good
        print(f"{fault['file']:44} {seconds:4.0f} s  {found[0] if found else 'not found'}{'' if good else '  <-'}",
              flush=True)
    print(f"{len(faults) - missed} of {len(faults)} faults found in at most {MOST_S} processor seconds")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
