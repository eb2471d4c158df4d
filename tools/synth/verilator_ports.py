# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Port widths as Verilator resolves them, from its XML output."""

import xml.etree.ElementTree as ElementTree

from project import INCLUDE, WAIVERS, files_of, run, tool, verilator_flags


def data_width(table, number):
    """Bits of one entry of the type table."""
    node = table[number]
    if node.tag == "basicdtype":
        if "left" in node.attrib:
            return abs(int(node.attrib["left"]) - int(node.attrib["right"])) + 1
        return {"logic": 1, "bit": 1, "int": 32, "integer": 32, "byte": 8}[node.attrib["name"]]
    if node.tag == "structdtype":
        return sum(data_width(table, m.attrib["sub_dtype_id"]) for m in node)
    if node.tag in ("refdtype", "enumdtype"):
        return data_width(table, node.attrib["sub_dtype_id"])
    if node.tag == "packarraydtype":
        ends = [int(c.attrib["name"].split("'")[-1].lstrip("sh"), 16) for c in node.iter("const")]
        return data_width(table, node.attrib["sub_dtype_id"]) * (abs(ends[0] - ends[1]) + 1)
    raise SystemExit(f"Verilator's type table: {node.tag} is not understood")


def module_ports(top, folder, files=None):
    """{port: (direction, width)} of one module as top, with its default parameters; by default of the RTL."""
    folder.mkdir(parents=True, exist_ok=True)
    output = folder / f"{top}.xml"
    # verilator_flags() holds -fno-const-bit-op-tree.
    status, text = run([tool("verilator"), "--xml-only", "--xml-output", output, *verilator_flags(),
                        "-Wno-fatal", f"-I{INCLUDE}", "--top-module", top, WAIVERS,
                        *(files_of(top) if files is None else files)], cwd=folder)
    if status != 0:
        raise SystemExit(f"{top}: {text}")
    tree = ElementTree.parse(output).getroot()
    table = {node.attrib["id"]: node for node in tree.find(".//typetable") if "id" in node.attrib}
    module = next(m for m in tree.iter("module") if m.attrib["name"] == top)
    return {var.attrib["name"]: (var.attrib["dir"], data_width(table, var.attrib["dtype_id"]))
            for var in module.findall("var") if "dir" in var.attrib}
