#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Every public call of the driver has a test on the RTL, for success and for each of its errors.

  check_calls.py BUILD_DIR      compares tests/driver/calls.toml with the headers and with CTest
  check_calls.py self-test      planted gaps are reported

A public call is a function of Device, Automatic, Control, Fields or Opcodes that returns a Result,
scan_bus, and a call of C that is more than one of these. Its errors are those that the comment above it names. Every function
of mb4.h is called by c_binding_test.c. docs/locking.md says of each public call where it may run.
"""

import fnmatch
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
HEADERS = HERE.parents[1] / "drivers" / "include" / "mb4"
CLASSES = {"Device": "device.hpp", "Automatic": "automatic.hpp", "Control": "control.hpp",
           "Fields": "fields.hpp", "Opcodes": "opcodes.hpp",
           "PolledAccess": "../../c/mb4_c_access.hpp"}
IN_C = {"PolledAccess": "mb4_slave_"}  # its calls have names of mb4.h


def error_names(text):
    body = text[text.index("enum class Error"):]
    return set(re.findall(r"^  (k\w+) = \d+,", body[:body.index("};")], re.M)) - {"kNone"}


def public_calls(name, text, errors):
    """{call: errors that its comment names} of one class."""
    begin = re.search(rf"^class {name}\b[^;]*?\{{", text, re.M | re.S)
    body = text[begin.end():]
    body = body[:body.index("\n};")]
    public = "".join(part.partition("\n private:")[0].partition("\n protected:")[0]
                     for part in body.split("\n public:")[1:])
    calls = {}
    comment = []
    for line in public.splitlines():
        if line.startswith("  //"):
            comment.append(line)
            continue
        found = re.match(r"  (?:\[\[nodiscard\]\] )?(?:mb4::)?Result<[\w:]+> (\w+)\(", line)
        if found:
            named = set(re.findall(r"\bk[A-Z]\w+", " ".join(comment))) & errors
            calls.setdefault(IN_C.get(name, f"{name}::") + found.group(1), set()).update(named)
        if not line.startswith("  template"):
            comment = []
    return calls


def findings(calls, table, errors, tests):
    def missing(test):
        return not any(fnmatch.fnmatchcase(known, test) for known in tests)

    for call, named in sorted(calls.items()):
        row = table.get(call)
        if row is None:
            yield f"{call}: no row"
            continue
        for error in sorted(named - row.get("errors", {}).keys()):
            yield f"{call}: the header names {error}, no test is given"
    for call, row in sorted(table.items()):
        if call not in calls:
            yield f"{call}: there is no such public call"
        if set(row) != {"success", "errors"}:
            yield f"{call}: a row has 'success' and 'errors'"
        for error, test in row.get("errors", {}).items():
            if error not in errors:
                yield f"{call}: there is no error {error}"
            if missing(test):
                yield f"{call}: {error}: there is no test '{test}'"
        if missing(row.get("success", "")):
            yield f"{call}: success: there is no test '{row.get('success')}'"
    unused = errors - {error for row in table.values() for error in row.get("errors", {})}
    # Of the arithmetic in position.hpp, which needs no chip.
    for error in sorted(unused - {"kJump"}):
        yield f"{error}: no call has a test of it"


def uncalled(header, test):
    for name in sorted(set(re.findall(r"\bmb4_\w+(?=\()", header))):
        if not re.search(rf"\b{name}\(", test):
            yield f"mb4.h: {name}() is not called"


def unplaced(calls, page):
    for call in sorted(calls):
        if f"`{call}`" not in page:
            yield f"{call}: no row says where it may run"


def self_test():
    assert list(unplaced({"A::go", "A::goes"}, "| `A::goes` |")) == [
        "A::go: no row says where it may run"]
    assert list(uncalled("void mb4_a(int x);\nint mb4_ab(void);\n", "mb4_a(1); mb4_abc();")) == [
        "mb4.h: mb4_ab() is not called"]
    text = ("class A {\n public:\n  // kOne; kTwo.\n  Result<void> go() {\n  }\n"
            " private:\n  Result<void> hidden() {\n  }\n};\n")
    calls = public_calls("A", text, {"kOne", "kTwo"})
    assert calls == {"A::go": {"kOne", "kTwo"}}, calls
    good = {"A::go": {"success": "T.a", "errors": {"kOne": "T.b", "kTwo": "T.*"}}}
    tests = {"T.a", "T.b"}
    assert not list(findings(calls, good, {"kOne", "kTwo"}, tests))
    assert list(findings(calls, {}, set(), tests)) == ["A::go: no row"]
    assert list(findings(calls, good, {"kOne", "kTwo"}, {"T.a"}))
    assert list(findings(calls, good, {"kOne", "kTwo", "kThree"}, tests))
    less = {"A::go": {"success": "T.a", "errors": {"kOne": "T.b"}}}
    assert list(findings(calls, less, {"kOne"}, tests))
    print("planted gaps, all reported")
    return 0


def main():
    if sys.argv[1] == "self-test":
        return self_test()
    errors = error_names((HEADERS / "error.hpp").read_text())
    calls = {}
    for name, header in CLASSES.items():
        calls.update(public_calls(name, (HEADERS / header).read_text(), errors))
    calls["scan_bus"] = set()
    listing = subprocess.run(["ctest", "--test-dir", sys.argv[1], "--show-only=json-v1"],
                             check=True, capture_output=True, text=True).stdout
    tests = {test["name"] for test in json.loads(listing)["tests"]}
    table = tomllib.loads((HERE / "calls.toml").read_text())
    found = list(findings(calls, table, errors, tests))
    found = [f"calls.toml: {line}" for line in found]
    found += [f"c_binding_test.c: {line}" for line in uncalled(
        (HEADERS.parent / "mb4.h").read_text(), (HERE / "c" / "c_binding_test.c").read_text())]
    found += [f"locking.md: {line}" for line in unplaced(
        calls, (HERE.parents[1] / "docs" / "locking.md").read_text())]
    for line in found:
        print(line)
    if not found:
        print(f"{len(calls)} calls, {sum(len(row['errors']) for row in table.values())} errors")
    return 1 if found else 0


sys.exit(main())
