#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Timing constraints of mb4_core, mb4_axil and mb4_wb for Vivado, Quartus and Diamond.

  constraints.py FOLDER             writes rtl/mb4/constraints/TOP.xdc, TOP_quartus.sdc, TOP_diamond.sdc from
                                    rtl/mb4/constraints/crossings.toml
  constraints.py FOLDER --check     the files are what it would write; every name of the table exists; every path
                                    between two clocks in the netlist has exactly one line; the table has each row of
                                    docs/crossings.md, and no other

FOLDER is for the netlists, which Yosys makes from the RTL.
"""

import json
import re
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import project  # noqa: E402
import yosys  # noqa: E402

FOLDER = project.RTL / "mb4" / "constraints"
TABLE = FOLDER / "crossings.toml"
PAGE = project.ROOT / "docs" / "crossings.md"
# Top: {domain: (clock port, default period in ns)}
TOPS = {"mb4_core": {"core": ("clk_i", 50), "host": ("sclk_i", 20)},
        "mb4_axil": {"core": ("clk_i", 50), "host": ("s_axi_aclk", 10)},
        "mb4_wb": {"core": ("clk_i", 50), "host": ("wb_clk_i", 10)}}
PREFIX = re.compile(r"^(u_bus\.)?(u_engine\.)?")
HEAD = """# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# {tool}: constraints of {top}, made by tools/synth/constraints.py from crossings.toml: do not edit.
# Not run in {tool}. The names of clocks and periods in the first lines are yours to change, as are ports if {top} is
# not the top of the design. The lines are point to point: with set_clock_groups the tool would ignore the delays.
"""


def lines_of(top, table):
    return [line for line in table if "none" not in line and top in line.get("tops", TOPS)]


def pattern(name):
    """A name of the table as an expression for names of the netlist without PREFIX."""
    return re.compile("^" + re.escape(name).replace(r"\*", ".*") + "$")


def matches(names, register):
    return any(pattern(name).match(register) for name in names)


# ---- netlist -------------------------------------------------------------------------------------


def netlist(top, folder):
    folder.mkdir(parents=True, exist_ok=True)
    status, text = yosys.execute(
        yosys.read() + [f"hierarchy -check -top {top}", "proc", "flatten", "opt_expr", "opt_clean", "memory -nomap",
                        "opt_clean", f"write_json {top}.json"], folder, top)
    if status != 0:
        raise SystemExit(f"{top}: {text}")
    return json.loads((folder / f"{top}.json").read_text(encoding="utf-8"))["modules"][top]


def crossings(module, clocks):
    """{(from, domain of the receiver): names of receiving registers} of all paths between two domains.

    A memory counts as a register in the clock of its write port; its read port is a path.
    """
    names = {}
    for name, net in sorted(module["netnames"].items(), key=lambda item: (not item[0].endswith("_q"), item[0])):
        for bit in net["bits"]:
            names.setdefault(bit, name)
    domain = {module["ports"][port]["bits"][0]: kind for kind, (port, _) in clocks.items()}
    sources, drivers, sinks = {}, {}, []   # of a bit; of a bit; (register, domain, input bits)
    for port, what in module["ports"].items():
        if what["direction"] == "input":
            for bit in what["bits"]:
                if bit not in domain:
                    sources[bit] = (f"port:{port}", None)
    for name, cell in module["cells"].items():
        pins = cell["connections"]
        if "Q" in pins:
            clock = domain.get(pins["CLK"][0], "NCS")
            register = PREFIX.sub("", names[pins["Q"][0]])
            for bit in pins["Q"]:
                sources[bit] = (PREFIX.sub("", names[bit]), clock)
            sinks.append((register, clock, pins["D"] + pins.get("EN", [])))
        elif cell["type"].startswith("$mem"):
            memory, clock = PREFIX.sub("", name), domain[pins["WR_CLK"][0]]
            for bit in pins["RD_DATA"]:
                drivers[bit] = (pins["RD_ADDR"], (memory, clock))
            sinks.append((memory, clock, pins["WR_ADDR"] + pins["WR_EN"] + pins["WR_DATA"]))
        else:
            ways = cell["port_directions"]
            into = [bit for pin, bits in pins.items() if ways[pin] == "input" for bit in bits]
            for pin, bits in pins.items():
                if ways[pin] == "output":
                    for bit in bits:
                        drivers[bit] = (into, None)
    cones = {}

    def cone(bit):
        if bit in sources:
            return frozenset([sources[bit]])
        if bit not in cones:
            cones[bit] = frozenset()
            into, memory = drivers.get(bit, ((), None))
            cones[bit] = frozenset([memory] if memory else []).union(*(cone(other) for other in into))
        return cones[bit]

    sys.setrecursionlimit(100_000)
    found = {}
    for register, clock, bits in sinks:
        for source, of in frozenset().union(*(cone(bit) for bit in bits)):
            if of != clock:
                found.setdefault((source, clock), set()).add(register)
    return found


def netlist_findings(top, table, folder):
    """Paths without a line or with two, and names that no path has."""
    module = netlist(top, folder)
    found = crossings(module, TOPS[top])
    asynchronous = {name for line in table if "none" not in line for name in line["from"] if name.startswith("port:")}
    findings, used = [], set()
    for (source, clock), receivers in sorted(found.items()):
        if source.startswith("port:") and source not in asynchronous:
            continue   # a port of the clock's own interface, or a constant
        for receiver in sorted(receivers):
            fits = [number for number, line in enumerate(table)
                    if line in lines_of(top, table) and line["to"] == clock and matches(line["from"], source) and
                    ("into" not in line or matches(line["into"], receiver))]
            used |= {(number, name) for number in fits for name in table[number]["from"] if matches([name], source)}
            used |= {(number, name) for number in fits for name in table[number].get("into", ())
                     if matches([name], receiver)}
            if len(fits) != 1:
                findings.append(f"{top}: {source} to {receiver} ({clock}) has {len(fits)} lines")
    for number, line in enumerate(table):
        if line in lines_of(top, table):
            for name in line["from"] + line.get("into", []):
                port = name.removeprefix("port:")
                if port != name and port in module["ports"]:
                    continue   # also those of asynchronous resets
                if (number, name) not in used:
                    findings.append(f"{top}: {name} is on no path of the row '{line['row']}'")
    return findings


# ---- files ---------------------------------------------------------------------------------------


def cells(tool, names):
    """A collection of registers and memories."""
    if tool == "Quartus":
        return "[get_registers {" + " ".join(
            "*" + name.removesuffix(".mem").replace(".", "|") + ("|*" if name.endswith(".mem") else "*")
            for name in names) + "}]"
    paths = " ".join("*" + name.removesuffix(".mem").replace(".", "/") +
                     ("/mem*" if name.endswith(".mem") else "*") for name in names)
    return f"[get_cells -hierarchical {{{paths}}}]" if tool == "Diamond" else \
        "[get_cells -hierarchical -filter {" + " || ".join(f"NAME =~ {path}" for path in paths.split()) + "}]"


def spi(tool):
    """Set-up and clock-to-pin of SPI: I205, and half a period less the host's set-up."""
    return f"""
# SPI mode 0. MOSI is stable 7.5 ns before the rising edge of SCLK (I205) and 7.5 ns after it (I206). MISO changes with
# the falling edge and is taken with the next rising one; the host needs host_setup before it.
set host_setup 2.0
set_input_delay -clock host -max [expr {{$host_period - 7.5}}] [get_ports mosi_i]
set_input_delay -clock host -min 7.5 [get_ports mosi_i]
set_output_delay -clock host -max $host_setup [get_ports miso_o]
set_output_delay -clock host -min 0.0 [get_ports miso_o]
"""


def text(tool, top, table):
    out = [HEAD.format(tool=tool, top=top)]
    for kind, (port, period) in TOPS[top].items():
        out += [f"set {kind}_period {period}.0",
                f"create_clock -name {kind} -period ${kind}_period [get_ports {port}]"]
    if top == "mb4_core":
        out.append(spi(tool).rstrip("\n"))
    for line in lines_of(top, table):
        ports = [name.removeprefix("port:") for name in line["from"] if name.startswith("port:")]
        registers = [name for name in line["from"] if not name.startswith("port:")]
        start = f"[get_ports {{{' '.join(ports)}}}]" if ports else cells(tool, registers)
        end = cells(tool, line["into"]) if "into" in line else f"[get_clocks {line['to']}]"
        if line["rule"] == "stable":
            command = f"set_false_path -from {start} -to {end}"
        elif tool == "Vivado":
            command = f"set_max_delay -datapath_only -from {start} -to {end} ${line['to']}_period"
        else:
            # A path between unrelated clocks has no hold.
            command = (f"set_max_delay -from {start} -to {end} ${line['to']}_period\n"
                       f"set_false_path -hold -from {start} -to {end}")
        out += ["", f"# {line['row']}", command]
    return "\n".join(out) + "\n"


def files(table):
    """{path: what stands in it}"""
    names = {"Vivado": "{}.xdc", "Quartus": "{}_quartus.sdc", "Diamond": "{}_diamond.sdc"}
    return {FOLDER / name.format(top): text(tool, top, table) for top in TOPS for tool, name in names.items()}


# ---- page ----------------------------------------------------------------------------------------


def page_findings(table, page):
    """Rows of the page that the table does not have, and the other way round."""
    rows = re.findall(r"^\| ([^|]+) \|[^|]*\|[^|]*\|[^|]*\|[^|]*\|$", page, re.M)
    rows = {row for row in rows if row != "signal"}
    said = {line["row"] for line in table}
    return [f"no line for the row '{row}'" for row in sorted(rows - said)] + \
        [f"the page has no row '{row}'" for row in sorted(said - rows)]


def self_test(table, folder):
    """The planted faults that make no finding."""
    page = PAGE.read_text(encoding="utf-8")
    missed = []
    first = next(line for line in table if line["row"] == "base kept")
    others = [line for line in table if line is not first]
    planted = {"a line that is missing": others, "two lines": [*table, dict(first)],
               "a name that does not exist": [*others, {**first, "from": [*first["from"], "u_regs.u_none_q"]}]}
    for what, wrong in planted.items():
        if not netlist_findings("mb4_core", wrong, folder):
            missed.append(f"not noticed: {what}")
    if not page_findings(others, page) or not page_findings([*table, {**first, "row": "none"}], page):
        missed.append("not noticed: a row that is missing on one side")
    return missed


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))["line"]
    if not arguments.check:
        for path, what in files(table).items():
            path.write_text(what, encoding="utf-8")
        return
    findings = [f"{path.name}: is not what tools/synth/constraints.py writes" for path, what in files(table).items()
                if not path.exists() or path.read_text(encoding="utf-8") != what]
    findings += page_findings(table, PAGE.read_text(encoding="utf-8"))
    for top in TOPS:
        findings += netlist_findings(top, table, arguments.folder)
    findings += self_test(table, arguments.folder)
    project.finish(findings, f"{len(TOPS)} tops: each path between clocks has one line, planted faults are noticed")


if __name__ == "__main__":
    main()
