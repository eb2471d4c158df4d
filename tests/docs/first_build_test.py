#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Is the time of the README's first command true, within a factor of two?

  first_build_test.py FOLDER

Clones HEAD into FOLDER, runs tools/demo.sh there without a compiler cache, and compares the processor seconds with
"(N processor seconds)" of README.md. The packages have to be there already.
"""

import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MOST_S = 170


def main():
    tree = Path(sys.argv[1])
    said = re.search(r"\((\d+) processor seconds\)", (ROOT / "README.md").read_text(encoding="utf-8"))
    if not said:
        sys.exit("first_build_test.py: README.md names no processor seconds of the first command")
    shutil.rmtree(tree, ignore_errors=True)
    subprocess.run(["git", "-c", f"safe.directory={ROOT}/.git", "clone", "-q", ROOT, tree], check=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    load = os.getloadavg()[0]
    done = subprocess.run([tree / "tools" / "demo.sh"], check=False, text=True, stdout=subprocess.PIPE,
                          env={**os.environ, "CCACHE_DISABLE": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = sum(after[:2]) - sum(before[:2])
    print(f"tools/demo.sh: {seconds:.0f} processor seconds, load {load:.1f} before and {os.getloadavg()[0]:.1f} behind; "
          f"README.md says {said[1]}, at most {MOST_S} on an idle machine")
    if done.returncode != 0:
        sys.exit(f"first_build_test.py: tools/demo.sh: status {done.returncode}")
    if len(re.findall(r"0x\w+ +\d+ .* ok$", done.stdout, re.M)) < 5:
        sys.exit(f"first_build_test.py: no five positions:\n{done.stdout}")
    if not int(said[1]) / 2 <= seconds <= int(said[1]) * 2:
        sys.exit("first_build_test.py: README.md is wrong by more than a factor of two")
    return 0


if __name__ == "__main__":
    sys.exit(main())
