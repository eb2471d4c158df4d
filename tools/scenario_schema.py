#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""docs/scenario.schema.json: the keys as the reader asks for them (`mb4sim schema`), each with its sentence of
sim/README.md. The manual and the reader must name the same keys.

  scenario_schema.py MB4SIM ROOT            says what differs; exit status 1 if anything does
  scenario_schema.py MB4SIM ROOT --write    writes the file
"""

import json
import re
import subprocess
import sys
from pathlib import Path

SCHEMA = "docs/scenario.schema.json"
MANUAL = "sim/README.md"
SLAVE = "[[channel.slave]]"
# Tables of the manual that name no section in their rows: begin of the heading, section.
SECTIONS = (("protocol ", SLAVE), ("Control communication", SLAVE), ("A line of one wire", "[[channel]]"),
            ("Faults", "[[fault]]"))
# Keys that the manual describes by a prefix.
PREFIXES = {"[[channel]]": "out_"}


def plain(text):
    """A cell without Markdown."""
    text = re.sub(r"\[([^\]]+)\]\([^)]+\)", r"\1", text.strip())
    return text.replace("`", "").replace("\\|", "|")


def rows(manual):
    """(section, keys, cells) of each row that begins with keys."""
    section, head = "", []
    for line in manual.splitlines():
        if line.startswith("#"):
            heading = line.lstrip("#").strip()
            section = next((name for begin, name in SECTIONS if heading.startswith(begin)), "")
            head = []
        if not line.startswith("|"):
            head = [] if not line else head
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if not head:
            head = cells
            continue
        if head[0] != "key" and "further keys" not in head:
            continue
        words = re.findall(r"`([^`]+)`", cells[head.index("further keys")] if head[0] == "kind" else cells[0])
        if head[0] == "key" and words and (begin := re.match(r"(\[+[\w.]+\]+) ?(\w*)", words[0])):
            section = begin[1]
            words[0] = begin[2]
        keys = [word for word in words if re.fullmatch(r"\w+", word)]
        if keys:
            yield section, keys, dict(zip(head, cells))


def tables_of(schema, title=""):
    """(title, properties) of each table of the schema."""
    node = schema.get("items", schema)
    properties = node.get("properties")
    if properties is None:
        return
    yield title, properties
    path = title.strip("[]")
    for key, value in properties.items():
        brackets = "[[{}]]" if value.get("type") == "array" else "[{}]"
        yield from tables_of(value, brackets.format(f"{path}.{key}" if path else key))


def describe(schema, manual):
    """Puts the sentences of the manual into the schema. Returns what is in one of them only."""
    tables = dict(tables_of(schema))
    findings = []
    for section, keys, cells in rows(manual):
        for key in keys:
            node = tables.get(section, {}).get(key)
            if node is None:
                findings.append(f"{MANUAL}: {section} {key}: the reader does not ask for it")
                continue
            text = plain(cells.get("meaning") or cells.get("what happens") or "")
            default = plain(cells.get("default") or "")
            if default and default != "required":
                text += f" Default: {default}."
            if text and "description" not in node:
                node["description"] = text[0].upper() + text[1:]
    named = set(re.findall(r"`(?:\[+[\w.]+\]+ )?(\w+)(?: = [^`]*)?`", manual))
    named |= set(re.findall(r"`\[+[\w.]*?(\w+)\]+[ `]", manual))  # tables
    for title, properties in tables.items():
        for key in properties:
            prefix = PREFIXES.get(title, "")
            if key not in named and not (prefix and key.removeprefix(prefix) in named) and title:
                findings.append(f"{title} {key}: the reader asks for it, {MANUAL} does not name it")
    return findings


def made(mb4sim, root):
    """(text of the file, findings)"""
    printed = subprocess.run([mb4sim, "schema"], capture_output=True, text=True, check=True).stdout
    schema = json.loads(printed)
    findings = describe(schema, (Path(root) / MANUAL).read_text(encoding="utf-8"))
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n", findings


def main():
    mb4sim, root = sys.argv[1:3]
    text, findings = made(mb4sim, root)
    path = Path(root) / SCHEMA
    if "--write" in sys.argv:
        path.write_text(text, encoding="utf-8")
    elif not path.exists() or path.read_text(encoding="utf-8") != text:
        findings.append(f"{SCHEMA}: is not what tools/scenario_schema.py makes; --write makes it")
    for finding in findings:
        print(finding)
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
