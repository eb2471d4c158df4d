#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Generate the maps of regmap/ and of the tests anew, twice, and compare with the files that are checked in.

Runs with this Python if it has the packages of regmap/generator/requirements.txt, else with that of the virtual
environment that regmap/regenerate.sh makes (argument, or MB4_REGMAP_VENV). Exit status 77: neither has them.
"""

import filecmp
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
REGMAP = HERE.parents[1] / "regmap"
SKIPPED = 77


def installed(python):
    """Versions of the three packages, or None."""
    code = (
        "import jinja2, systemrdl, peakrdl_html, peakrdl_ipxact; from importlib.metadata import version;"
        "print(*(p + '==' + version(p) for p in ('systemrdl-compiler', 'peakrdl-html', 'peakrdl-ipxact')))"
    )
    try:
        run = subprocess.run([python, "-c", code], capture_output=True, text=True, check=False)
    except OSError:
        return None
    return run.stdout.split() if run.returncode == 0 else None


def main():
    venvs = [Path(p) for p in (*sys.argv[1:], os.environ.get("MB4_REGMAP_VENV", "")) if p]
    pythons = [sys.executable, *(str(v / "bin" / "python3") for v in venvs)]
    usable = [(p, v) for p in pythons if (v := installed(p))]
    if not usable:
        print("skipped: the packages of regmap/generator/requirements.txt are not installed (see regmap/regenerate.sh)")
        return SKIPPED
    pinned = (REGMAP / "generator" / "requirements.txt").read_text(encoding="utf-8").split()
    exact = [(p, v) for p, v in usable if all(package in pinned for package in v)]
    if not exact:
        print(f"skipped: {', '.join(usable[0][1])} are not the versions of regmap/generator/requirements.txt")
        return SKIPPED
    python, versions = exact[0]

    problems, count = [], 0
    for maps, kept_in in (([], REGMAP / "generated"), ([str(HERE / "sample.rdl")], HERE / "generated")):
        with tempfile.TemporaryDirectory() as scratch:
            outs = [Path(scratch) / name for name in ("first", "second")]
            for out in outs:
                subprocess.run([python, str(REGMAP / "generator" / "generate.py"), *maps, "--out", str(out)], check=True)
            made, kept = (
                {f.relative_to(folder).as_posix() for f in folder.rglob("*") if f.is_file()}
                for folder in (outs[0], kept_in)
            )
            count += len(made)
            problems += [f"{name}: only generated, not checked in" for name in sorted(made - kept)]
            problems += [f"{name}: checked in, but not generated" for name in sorted(kept - made)]
            for name in sorted(made & kept):
                if not filecmp.cmp(outs[0] / name, kept_in / name, shallow=False):
                    problems.append(f"{name}: differs from what generate.py makes; run regmap/regenerate.sh")
                if not filecmp.cmp(outs[0] / name, outs[1] / name, shallow=False):
                    problems.append(f"{name}: two runs of generate.py differ")
    for problem in problems:
        print(problem)
    print(f"{count} files compared, made by {', '.join(versions)}; {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
