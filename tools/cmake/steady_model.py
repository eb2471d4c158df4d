#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs Verilator so that a comment in the RTL changes no C++ that takes long to compile.

  steady_model.py VERILATOR ARGUMENT...

The arguments are Verilator's own, with --Mdir, --prefix and --make. An assertion names its line, so
a comment above it would change the model. Here the line numbers stand in a file of their own,
PREFIX__lines.cpp, and the names of sources are relative to the project. A file that says what it
said before keeps its time: nothing that includes it is compiled again."""

import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STOP = re.compile(r'VL_STOP_MT\("([^"]*)", (\d+), ')
TEXT = re.compile(r"(%%(?:Error|Warning|Info|Fatal)[^:\"]*: [\w.]+):\d+: ")


def argument(name):
    return sys.argv[sys.argv.index(name) + 1]


def without_lines(text, table, lines):
    """The text with its line numbers in a table; they are appended to `lines`."""
    def index(found):
        lines.append(found[2])
        path = os.path.relpath(found[1], ROOT) if os.path.isabs(found[1]) else found[1]
        return f'VL_STOP_MT("{path}", {table}[{len(lines) - 1}], '

    changed = TEXT.sub(r"\1: ", STOP.sub(index, text))
    if changed == text:
        return text
    return changed.replace("\n#include", f"\nextern const int {table}[];\n#include", 1)


def add_to_list(folder, prefix, name):
    """One more source in Verilator's own list, for CMake."""
    path = folder / f"{prefix}.{argument('--make')}"
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".json":
        listing = json.loads(text)
        listing["sources"]["classes_slow"].append(name)
        text = json.dumps(listing, indent=1) + "\n"
    else:
        text = text.replace(f"set({prefix}_CLASSES_SLOW", f'set({prefix}_CLASSES_SLOW "{name}"', 1)
    path.write_text(text, encoding="utf-8")


def state(folder, prefix):
    """Arguments, this script, the files that Verilator has read, and what has come out of them; empty
    if that cannot be told."""
    depends = folder / f"{prefix}__ver.d"
    if not depends.is_file():
        return ""
    read = [Path(name) for name in depends.read_text(encoding="utf-8").partition(":")[2].split()]
    if not all(path.is_file() for path in read):  # a name with a space, or a file that has gone
        return ""
    written = sorted(path for path in folder.glob("*") if path.suffix in (".cpp", ".h", ".cmake", ".json"))
    digest = hashlib.sha256("\n".join(sys.argv[1:]).encode())
    for path in [Path(__file__), *read, *(path for path in written if not path.stem.endswith("_copy"))]:
        digest.update(str(path).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def main():
    folder, prefix = Path(argument("--Mdir")), argument("--prefix")
    stamp = folder / f"{prefix}__steady.txt"
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == state(folder, prefix) != "":
        return 0
    stamp.unlink(missing_ok=True)
    before = {path: (path.read_bytes(), path.stat()) for path in folder.glob("*") if path.is_file()}
    # Otherwise Verilator does nothing where it finds its own last output.
    (folder / f"{prefix}__verFiles.dat").unlink(missing_ok=True)
    status = subprocess.run(sys.argv[1:], check=False).returncode
    if status != 0:
        return status
    lines = []
    table = f"{prefix}__lines"
    for path in sorted(folder.glob("*.cpp")):
        if path.name != f"{table}.cpp":
            path.write_text(without_lines(path.read_text(encoding="utf-8"), table, lines),
                            encoding="utf-8")
    (folder / f"{table}.cpp").write_text(
        f"extern const int {table}[] = {{{', '.join(lines or ['0'])}}};\n", encoding="utf-8")
    add_to_list(folder, prefix, str(folder / f"{table}.cpp"))
    same = {path for path, (content, _) in before.items()
            if path.is_file() and path.read_bytes() == content}
    # The main file is the one that rules of the build name: its time says that any file is new.
    main_file = folder / f"{prefix}.cpp"
    code = {path for path in folder.glob("*") if path.suffix in (".cpp", ".h")}
    if not code - {folder / f"{table}.cpp"} <= same:
        same.discard(main_file)
    for path in same:
        times = before[path][1]
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    stamp.write_text(state(folder, prefix), encoding="utf-8")
    return 0


sys.exit(main())
