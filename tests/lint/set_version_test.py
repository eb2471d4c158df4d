# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""tools/set_version.py on a copy of the tree: each tracked file that has a version has the new one.

  set_version_test.py VENV    VENV: the generator's packages (regmap/regenerate.sh). Without them the
                              register maps are left out, and the check must name exactly those.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import project  # noqa: E402
import set_version  # noqa: E402

NEW = ".".join(("47", "11", "8"))  # in parts: this file is in the copy too


def run(folder, *command, **environment):
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True,
                          check=False, env={**os.environ, **environment})


def refused(folder):
    """Wrong uses are told in one line and change nothing."""
    for version in ("1.2", "1.2.x", "1.2.3.4", "01.2.3", "1.2.256", "v1.2.3"):
        done = run(folder, sys.executable, "-B", "tools/set_version.py", version)
        assert done.returncode == 1 and f"'{version}' is no version" in done.stderr, done
        assert done.stderr.count("\n") == 1, done.stderr
    core = folder / "openmb4-axi.core"
    kept = core.read_text()
    core.write_text(kept.replace("name: ", "title: "))
    done = run(folder, sys.executable, "-B", "tools/set_version.py", NEW)
    assert done.returncode == 1 and "openmb4-axi.core: the line with the version" in done.stderr, done
    core.write_text(kept)
    assert NEW not in (folder / "CMakeLists.txt").read_text(), "changed although a file was refused"


def main():
    venv = Path(sys.argv[1])
    maps = (venv / "bin" / "python3").exists()
    line = re.search(set_version.VERSION_LINE, (ROOT / set_version.VERSION_FILE).read_text())
    old = ".".join(line.groups())
    names = project.tracked()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name in names:
            if (ROOT / name).is_file():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, folder / name)
        refused(folder)
        done = run(folder, sys.executable, "-B", "tools/set_version.py", NEW,
                   *([] if maps else ["--no-maps"]), MB4_REGMAP_VENV=str(venv))
        assert done.returncode == 0, done.stderr

        assert run(folder, "git", "init", "-q").returncode == 0
        assert run(folder, "git", "add", "-A").returncode == 0
        check = run(folder, sys.executable, "-B", "tests/lint/check_repository.py", "version").stdout
        # A released changelog waits for its new section.
        findings = {row.split(":", maxsplit=1)[0] for row in check.splitlines()
                    if " tracked files" not in row and not row.endswith(" finding(s)")}
        findings.discard("CHANGELOG.md")
        assert check, "the check of the copy has said nothing"
        expected = set() if maps else {name for name in names if name.endswith(".ipxact.xml")}
        assert findings == expected, check

        # The check knows the files of the table; here is every other file with the old version.
        literal = re.compile(rf"(?<![\w.=]){re.escape(old)}(?!\w|\.\d)")
        for name in names:
            if name not in expected | {"CHANGELOG.md"} and (folder / name).is_file():
                text = (folder / name).read_bytes().decode("utf-8", errors="ignore")
                assert not literal.search(text), f"{name} still says {old}"
        header = (folder / "drivers/include/mb4/version.hpp").read_text()
        assert re.findall(r"Version\w+ = (\d+);", header) == NEW.split("."), header
        if maps:
            package = (folder / "regmap/generated/mb4_page/mb4_page_regs.json").read_text()
            for field, number in zip(("MAJOR", "MINOR", "PATCH"), NEW.split(".")):
                assert re.search(rf'"name": "{field}".*"reset": {number},', package), f"field {field}"
    print(f"{old} changed to {NEW} by one command" if maps else
          f"{old} changed to {NEW}, but for the register maps: their generator is not installed")


main()
