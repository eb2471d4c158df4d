# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Each SystemVerilog instance of a top in a page of docs/ has all of its ports with their widths: Verilator without a
message, Yosys without a warning about a port. An instance whose ports are left out by dots is none. Planted faults are
reported.

  instances_test.py FOLDER    FOLDER is for what the tools leave

Exit status 77: a tool is missing.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import project  # noqa: E402
import sv_widths  # noqa: E402
import yosys  # noqa: E402

# Each top that has an instance in a page.
WANTED = {"mb4_core", "biss_axi", "biss_spi"}


def instances():
    """(page, top, text) of each instance."""
    tops = project.tops("clocks")
    for page in sorted((ROOT / "docs").glob("*.md")):
        for block in re.findall(r"```systemverilog\n(.*?)```", page.read_text(encoding="utf-8"), re.S):
            top = re.match(r"\w+", block).group(0)
            if top in tops and "(...)" not in block:
                yield page.name, tops[top], block


def around(top, instance):
    """A design around an instance: a port for each name that it uses, as wide as that of the top."""
    packages = sv_widths.read_packages(project.rtl_packages())
    chosen = {name: int(value) for name, value in re.findall(r"\.([A-Z_]\w*)\s*\((\d+)\)", instance.split("u_", 1)[0])}
    ports = sv_widths.module_ports(top.source, packages, {**(top.generics.defaults if top.generics else {}), **chosen})
    declared = []
    for port, name in re.findall(r"\.(\w+)\s*\(([a-z]\w*)\)", instance.split("u_", 1)[1]):
        way, width = ports.get(port, ("input", 1))
        declared.append(f"  {way} logic {f'[{width - 1}:0] ' if width > 1 else ''}{name}")
    return "module page_example (\n" + ",\n".join(dict.fromkeys(declared)) + "\n);\n" + instance + "endmodule\n"


def said(top, instance, folder):
    """What the tools say against an instance; empty if nothing."""
    source = folder / "page_example.sv"
    source.write_text(around(top, instance), encoding="utf-8")
    files = project.listed(top.master.list)
    # Outputs that the design does not use are open.
    _, text = project.run([project.tool("verilator"), "--lint-only", "-fno-const-bit-op-tree",
                           *project.verilator_flags(), "-Wno-DECLFILENAME",
                           "-Wno-PINCONNECTEMPTY", f"-I{project.INCLUDE}", "--top-module", "page_example", project.WAIVERS, *files, source])
    status, more = yosys.execute(yosys.read([*files, source]) + ["hierarchy -check -top page_example", "proc", "check -assert"],
                                 folder, "design")
    return text + (more if status != 0 or re.search(r"port|Resizing", more) else "")


def wrong(instance):
    """(what, text with this fault)"""
    line = re.findall(r"^ +\.\w+ +\([^\n]*\n", instance.split("u_", 1)[1], re.M)[1]
    yield "a port that is left out", instance.replace(line, "", 1)
    yield "another name", instance.replace(line, line.replace(".", ".x_", 1), 1)


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    findings, seen = [], set()
    for page, top, instance in instances():
        seen.add(top.name)
        text = said(top, instance, folder)
        if text:
            findings.append(f"{page}: {top.name}: {text[-1500:]}")
        findings += [f"{page}: {top.name}: {what} is not noticed" for what, bad in wrong(instance)
                     if bad == instance or not said(top, bad, folder)]
    findings += [f"no page has an instance of {name}" for name in sorted(WANTED - seen)]
    project.finish(findings, f"the instances of {', '.join(sorted(seen))} fit, wrong ones are noticed")


if __name__ == "__main__":
    main()
