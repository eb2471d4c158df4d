# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Puts the parts of the page into one HTML file: page.py MODULE.js MODULE.wasm UPLOT OUTPUT.

UPLOT is the folder of npm's package uplot."""

import base64
import gzip
import html
import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
MASTERS = ("mb4", "axi", "clb", "pru")  # register maps
KEYS = ("label", "ident", "address", "lsb", "width", "access", "codes", "names")  # of a field, what the page uses
DOCUMENT = ROOT / "docs" / "browser.md"


def addresses(header: str) -> dict:
    """{register: address}, as in the Python package (tools/python/openmb4/registers.py)."""
    found = {name: int(number, 16)
             for name, number in re.findall(r"#define \w+?_ADDR_(\w+) (0x\w+)U", header)}
    for name, offset in re.findall(r"#define MB4_(SLAVE_CFG_\w+)_OFFSET (\d+)U", header):
        for channel in range(8):
            found[f"{name}{channel + 1}"] = found["SLAVE_CFG"] + 4 * channel + int(offset)
    found.pop("SLAVE_CFG", None)
    for name in found.keys() & {"SCDATA", "RDATA"}:
        first = found.pop(name)
        found.update({f"{name}_BYTE{i + 1}": first + i for i in range(64)})
    return dict(sorted(found.items(), key=lambda one: one[1]))


def registers(master: str) -> dict:
    """The fields and addresses of a register map."""
    generated = ROOT / "regmap" / "generated" / master
    table = json.loads((generated / f"{master}_regs.json").read_text(encoding="utf-8"))
    fields = table["fields"] + table["alternate_fields"]
    return {"fields": [{key: field[key] for key in KEYS if field.get(key) not in (None, [])} for field in fields],
            "addresses": addresses((generated / f"{master}_regs.h").read_text(encoding="utf-8"))}


def help_text() -> str:
    """The tables and lists of docs/browser.md from "What can be done" on, for the page itself."""
    text = DOCUMENT.read_text(encoding="utf-8").partition("## What can be done\n")[2]
    found = []
    for block in re.split(r"\n\n+", text.strip()):
        block = html.escape(re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", block), quote=False)
        block = re.sub(r"`([^`]*)`", r"<code>\1</code>", block)
        if block.startswith("|"):
            rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines()[2:]]
            cells = ("".join(f"<td>{cell}</td>" for cell in row) for row in rows)
            found.append("<table>" + "".join(f"<tr>{row}</tr>" for row in cells) + "</table>")
        elif block.startswith("* "):
            found.append("<ul>" + "".join(f"<li>{item}</li>" for item in re.split(r"\n?^\* ", block, flags=re.M)[1:])
                         + "</ul>")
        elif block.startswith("## "):
            found.append(f"<h3>{block[3:]}</h3>")
        else:
            found.append(f"<p>{block}</p>")
    return "\n".join(found)


def main() -> None:
    module, wasm, uplot, output = map(Path, sys.argv[1:])
    licence = (uplot / "LICENSE").read_text(encoding="utf-8").strip()
    parts = {
        "uplot.css": (uplot / "dist" / "uPlot.min.css").read_text(encoding="utf-8"),
        "uplot.js": f"/*! uPlot\n{licence}\n*/\n"
                    + (uplot / "dist" / "uPlot.iife.min.js").read_text(encoding="utf-8"),
        "help": help_text(),
        "openmb4.js": module.read_text(encoding="utf-8"),
        "openmb4.wasm": base64.b64encode(gzip.compress(wasm.read_bytes(), 9, mtime=0)).decode(),
        "tables": json.dumps({master: registers(master) for master in MASTERS}, separators=(",", ":")),
    }
    for name in ("style.css", "chip.js", "fields.js", "registers.js", "masters.js", "diagram.js", "files.js", "page.js"):
        parts[name] = (HERE / "page" / name).read_text(encoding="utf-8")
    for name, text in parts.items():
        if name != "openmb4.wasm" and "</script" in text:
            sys.exit(f"page.py: {name} holds </script")
    page = (HERE / "page" / "index.html").read_text(encoding="utf-8")
    page = re.sub(r"/\*\{\{([\w.]+)\}\}\*/|\{\{([\w.]+)\}\}",
                  lambda match: parts[match[1] or match[2]], page)
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(page, encoding="utf-8")
    packed = len(gzip.compress(page.encode(), 9))
    print(f"{output}: {len(page.encode()):,} bytes, {packed:,} with gzip; "
          f"WebAssembly {wasm.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
