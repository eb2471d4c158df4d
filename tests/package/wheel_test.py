# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The wheel of a release: made from the sdist, it is installed in a new environment without a
compiler and reads the position that the README shows.

  wheel_test.py [--released]   --released: optimised as a release is; else its compilation takes a third
"""
import os
import re
import sys
import tempfile
from pathlib import Path

import programs
from release_test import git

SKIPPED = 77
QUICK = {"SKBUILD_CMAKE_BUILD_TYPE": "Debug", "CMAKE_ARGS": "-DCMAKE_CXX_FLAGS_DEBUG=-O0"}
POSITION = 11203451  # README: the table under tools/demo.sh


def example(root):
    """The README's line of Python: the text after -c."""
    text = (root / "README.md").read_text(encoding="utf-8")
    return re.search(r"bin/python -c '([^']+)'", text)[1]


def main():
    if not (programs.ROOT / ".git").exists():
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
        except (AssertionError, OSError) as error:
            print(f"skipped: no environment with packages from PyPI: {str(error)[-300:]}")
            sys.exit(SKIPPED)
        clone = folder / "clone"
        git("clone", "-q", "--no-hardlinks", str(programs.ROOT), str(clone), cwd=folder)
        quick = {} if sys.argv[1:] == ["--released"] else QUICK
        programs.call(clone / "tools" / "release.sh", "--wheel", folder / "out", env=os.environ | quick)
        wheels = list((folder / "out" / "python").glob("*.whl"))
        assert len(wheels) == 1, wheels
        version = re.escape(programs.version())
        assert re.fullmatch(rf"openmb4-{version}-py3-none-manylinux_2_\d+_\w+\.whl",
                            wheels[0].name), wheels
        # The path holds no compiler.
        programs.call(python, "-m", "pip", "install", "-q", wheels[0], env={"PATH": str(new / "bin")})
        said = programs.call(python, "-c", example(programs.ROOT), cwd=programs.ROOT,
                             env={"PATH": str(new / "bin")})
        assert f"position={POSITION}," in said, said


if __name__ == "__main__":
    main()
