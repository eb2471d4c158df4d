#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The deviations in docs/misra.md with a star are all that a search of the driver's text finds.

  check_misra.py            the driver against the table: a file too many and a file too few
  check_misra.py self-test  planted faults are reported

The search knows lines and words, no types. It is no checker of the rules.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TYPE = r"(?:const )?(?:std::)?(?:u?int\d*(?:_t)?|unsigned|char|bool|size_t|void|mb4_\w+)"
PATTERNS = {
    "4.1.1": r"__builtin_\w+|__atomic_\w+|__attribute__|\[\[(?:\w+, )?gnu::",
    "8.2.2": rf"(?<!sizeof)\({TYPE} ?\*?\)\s*[\w(&*~-]",
    "8.2.3": r"\bconst_cast\b",
    "8.2.5": r"\breinterpret_cast\b",
    "8.2.11": r"\bioctl\(|\bva_list\b|,\s*\.\.\.\)",
    "9.6.1": r"\bgoto\b",
    "10.1.2": r"\bvolatile\b",
    "10.2.2": r"\benum (?!class)",
    "10.4.1": r"\basm\b",
    "11.3.1": rf"^\s*(?:static |constexpr |inline )*{TYPE} \*?\w+\[[^\]]*\]|\(&\w+\)\[",
    "12.3.1": r"\bunion\b",
    "19.0.2": r"^\s*#\s*define\s+\w+\(",
    "19.6.1": r"^\s*#\s*pragma|\b_Pragma\b",
    "21.6.1": r"\bnew\b|\bmalloc\b|\bcalloc\b|\bfree\(|\bdelete\b(?!;)",
}


def code(text):
    """The text without comments and strings; lines stay lines."""
    text = re.sub(r"/\*.*?\*/", lambda found: "\n" * found.group().count("\n"), text, flags=re.S)
    text = re.sub(r'"(\\.|[^"\\\n])*"', '""', text)
    return re.sub(r"//[^\n]*", "", text)


def listed(page):
    """{rule: files} of the rows of the page that have a star."""
    rules = {}
    for rule, files in re.findall(r"^\| ([\d.]+) \* \|[^|]*\|([^|]*)\|", page, flags=re.M):
        rules[rule] = set(re.findall(r"`([\w/.]+)`", files))
    return rules


def findings(sources, page):
    table = listed(page)
    for rule in sorted(table.keys() - PATTERNS.keys()):
        yield f"docs/misra.md: rule {rule} has a star and no search"
    for rule, pattern in PATTERNS.items():
        here = set()
        for name, text in sources.items():
            for number, line in enumerate(code(text).splitlines(), 1):
                if re.search(pattern, line):
                    here.add(name)
                    if name not in table.get(rule, ()):
                        yield f"{name}:{number}: rule {rule}: {line.strip()}"
        for name in sorted(table.get(rule, set()) - here):
            yield f"docs/misra.md: rule {rule}: nothing found in {name}"


def driver():
    """{name as on the page: text}"""
    sources = {}
    for folder, base in ((ROOT / "drivers/include", ROOT / "drivers/include"),
                         (ROOT / "drivers/c", ROOT / "drivers")):
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".hpp", ".h", ".cpp", ".c"):
                sources[str(path.relative_to(base))] = path.read_text()
    return sources


def self_test():
    page = "| rule | |\n| 9.6.1 * | no goto | `a.hpp` | why |\n| 8.2.5 | x | `b.hpp` | y |\n"
    assert list(findings({"a.hpp": "goto x;\n"}, page)) == []
    assert list(findings({"a.hpp": "goto x;", "b.hpp": "\ngoto y;"}, page)) == [
        "b.hpp:2: rule 9.6.1: goto y;"]
    assert list(findings({"a.hpp": '// goto\nf("goto"); /* goto\ngoto */\n'}, page)) == [
        "docs/misra.md: rule 9.6.1: nothing found in a.hpp"]
    assert list(findings({"a.hpp": "goto x;\nreinterpret_cast<A>(b);"}, page)) == [
        "a.hpp:2: rule 8.2.5: reinterpret_cast<A>(b);"]
    assert list(findings({}, "| 1.1 * | x | `a` | y |\n")) == [
        "docs/misra.md: rule 1.1 has a star and no search"]
    for rule, line in (("4.1.1", "__builtin_trap();"), ("8.2.2", "x = (uint8_t)y;"),
                       ("8.2.11", "void f(int a, ...);"), ("10.2.2", "enum Old { kA };"),
                       ("11.3.1", "  uint8_t bytes[4];"), ("19.0.2", "#define F(x) x"),
                       ("21.6.1", "p = new int;"), ("10.1.2", "volatile int x;")):
        assert [line for line in findings({"a": line}, "") if f"rule {rule}:" in line], rule
    print("planted faults, all reported")
    return 0


def main():
    if sys.argv[1:] == ["self-test"]:
        return self_test()
    found = list(findings(driver(), (ROOT / "docs" / "misra.md").read_text()))
    print("\n".join(found) if found else f"{len(PATTERNS)} rules, as the page says")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
