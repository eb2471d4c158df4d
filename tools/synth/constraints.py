#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Timing constraints of the tops with clocks in masters.toml for Vivado, Quartus and Diamond, from crossings.toml of their
rooms.

  constraints.py FOLDER                       writes rtl/ROOM/constraints/TOP.xdc, TOP_quartus.sdc, TOP_diamond.sdc; those of
                                              a master with presets are for the full one. FOLDER is for the netlists, which
                                              Yosys makes from the RTL
  constraints.py FOLDER --features FEATURES   writes FOLDER/TOP.xdc ... for the tops with presets, with these features: a
                                              preset (drive), or the word FEATURES as a number (0x2347)
  constraints.py FOLDER --check               the files are what it would write; each register and port that a file names
                                              exists in the netlist of its preset; each path between two clocks, and from an
                                              asynchronous port, has exactly one line there; the tables have each row of
                                              docs/crossings.md, and no other. The same of the files of each preset
"""

import fnmatch
import json
import re
import sys
import tempfile
import tomllib
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import project  # noqa: E402
import yosys  # noqa: E402

PAGE = project.ROOT / "docs" / "crossings.md"
# The tops with clocks of masters.toml. Those of a master with presets have files for each preset.
CLOCKED = project.tops("clocks")
CLOCKS = {name: top.clocks for name, top in CLOCKED.items()}
TOPS = {name: top.clocks for name, top in CLOCKED.items() if top.master.presets}
# Folder of a master's RTL: its tops.
ROOMS = {}
for clocked in CLOCKED.values():
    ROOMS.setdefault(clocked.master.list.parent, []).append(clocked.name)
FILES = {"Vivado": "{}.xdc", "Quartus": "{}_quartus.sdc", "Diamond": "{}_diamond.sdc"}
PREFIX = re.compile(r"^(u_bus\.)?(u_engine\.)?")
CONSTANTS = {"port:quirks_i"}
HEAD = """# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# {tool}: constraints of {top} with {features}, made by tools/synth/constraints.py from crossings.toml: do not
# edit. Not run in {tool}. The names of clocks and periods in the first lines are yours to change, as are ports if {top}
# is not the top of the design. The lines are point to point: with set_clock_groups the tool would ignore the delays.
"""


def folder_of(room):
    return room / "constraints"


def room_of(top):
    return next(room for room, tops in ROOMS.items() if top in tops)


def tables():
    """The lines of all rooms, each with its tops."""
    return [{"tops": list(tops), **line} for room, tops in ROOMS.items()
            for line in tomllib.loads((folder_of(room) / "crossings.toml").read_text(encoding="utf-8"))["line"]]


def cores():
    """(preset, top, parameters) of each netlist. One without presets is "full"."""
    return [(preset, top, {"Features": features}) for preset, features in project.presets().items() for top in TOPS] + \
        [("full", name, top.parameters) for name, top in CLOCKED.items() if name not in TOPS]


def lines_of(top, table):
    return [line for line in table if "none" not in line and top in line["tops"]]


def pattern(name):
    """A name of the table as an expression for names of the netlist without PREFIX."""
    return re.compile("^" + re.escape(name).replace(r"\*", ".*") + "$")


def matches(names, register):
    return any(pattern(name).match(register) for name in names)


# ---- netlist -------------------------------------------------------------------------------------


def netlist(top, parameters, folder):
    folder.mkdir(parents=True, exist_ok=True)
    status, text = yosys.execute(
        yosys.read(project.listed(CLOCKED[top].master.list)) + yosys.choose(top, parameters) + [f"hierarchy -check -top {top}", "proc", "flatten",
                        "opt_expr", "opt_clean", "memory -nomap", "opt_clean", f"rename -top {top}",
                        f"write_json {top}.json"], folder, top)
    if status != 0:
        raise SystemExit(f"{top}: {text}")
    return json.loads((folder / f"{top}.json").read_text(encoding="utf-8"))["modules"][top]


class Netlist:
    """Paths and names of one top with one preset."""

    def __init__(self, top, module):
        self.top = top
        self.clocks = CLOCKS[top]
        self.ports = set(module["ports"])
        self.registers = set()   # with their whole names, memories among them
        # {(from, domain of the receiver): registers that receive}. A port is "port:NAME".
        self.paths = {}
        self.domains = {}        # of a source that has one: a register, or the port of a clock
        self._read(module)

    def _read(self, module):
        names = {}
        for name, net in sorted(module["netnames"].items(), key=lambda item: (not item[0].endswith("_q"), item[0])):
            for bit in net["bits"]:
                names.setdefault(bit, name)
        domain = {module["ports"][port]["bits"][0]: kind for kind, (port, _) in self.clocks.items()}
        sources, drivers, sinks = {}, {}, []   # of a bit; of a bit; (register, domain, input bits)
        for port, what in module["ports"].items():
            if what["direction"] == "input":
                for bit in what["bits"]:
                    sources[bit] = (f"port:{port}", domain.get(bit))
        for name, cell in module["cells"].items():
            pins = cell["connections"]
            if "Q" in pins:
                clock = domain[pins["CLK"][0]]
                self.registers |= {names[bit] for bit in pins["Q"]}
                for bit in pins["Q"]:
                    sources[bit] = (names[bit], clock)
                sinks.append((names[pins["Q"][0]], clock, pins["D"] + pins.get("EN", []) + pins.get("ARST", [])))
            elif cell["type"].startswith("$mem") and not pins["WR_CLK"]:
                for bit in pins["RD_DATA"]:   # a read-only memory is logic
                    drivers[bit] = (pins["RD_ADDR"], None)
            elif cell["type"].startswith("$mem"):
                clock = domain[pins["WR_CLK"][0]]
                self.registers.add(name)
                # A memory is a register in the clock of its write port; its read port is a path.
                for bit in pins["RD_DATA"]:
                    drivers[bit] = (pins["RD_ADDR"], (name, clock))
                sinks.append((name, clock, pins["WR_ADDR"] + pins["WR_EN"] + pins["WR_DATA"]))
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
        self.domains = {source: of for source, of in sources.values() if of}
        for register, clock, bits in sinks:
            for source, of in frozenset().union(*(cone(bit) for bit in bits)):
                if of != clock:
                    self.paths.setdefault((source, clock), set()).add(register)

    def crossings(self, asynchronous):
        """(from, domain, receiver) of each path that needs a line."""
        for (source, clock), receivers in sorted(self.paths.items()):
            if source.startswith("port:") and not matches(asynchronous, source) and (
                    clock == "host" or source in CONSTANTS):
                continue   # a port of the host's own interface, or a constant
            for receiver in sorted(receivers):
                yield source, clock, receiver


    def has(self, names, source):
        """A source is one of the names of a table, which may have a clock's (clock:NAME)."""
        return matches(names, PREFIX.sub("", source)) or f"clock:{self.domains.get(source)}" in names


def asynchronous_ports(top, table):
    """Those of a top: a port of this name at another top may be one of its host's interface."""
    return {name for line in lines_of(top, table) for name in line["from"] if name.startswith("port:")}


def present(line, netlist):
    """The line with those names only that a path of the netlist has; None if it has none."""
    def used(names, key):
        return [name for name in names if any(
            netlist.has([name], source) if key == "from" else matches([name], PREFIX.sub("", receiver))
            for (source, clock), receivers in netlist.paths.items() if clock == line["to"]
            and netlist.has(line["from"], source) for receiver in receivers)]

    starts = used(line["from"], "from")
    ends = used(line["into"], "into") if "into" in line else None
    if not starts or ends == []:
        return None
    return {**line, "from": starts, **({"into": ends} if ends else {})}


def table_findings(table, netlist):
    """Names of the table that the full chip has on no path."""
    findings = []
    for line in lines_of(netlist.top, table):
        if line.get("smaller"):
            continue
        found = present(line, netlist) or {"from": [], "into": []}
        findings += [f"{netlist.top}: {name} is on no path of the row '{line['row']}'" for key in ("from", "into")
                     for name in line.get(key, []) if name not in found.get(key, [])]
    return findings


# ---- what a file says ----------------------------------------------------------------------------

COLLECTION = re.compile(r"\[get_(\w+) ([^\]]*)\]")
WORDS = {"-hierarchical", "-filter", "NAME", "=~", "||"}


def tool_names(tool, name):
    """The forms that a tool gives to the name of a register: Vivado and Diamond put a dot behind a generate block,
    Quartus Standard puts the name of the module before that of an instance."""
    *path, register = name.split(".")
    memory = register == "mem"
    result = []
    for module in ("", "module:") if tool == "Quartus" else ("",):
        text, start = "", True
        for part in path:
            text += (module if start else "") + part
            start = not part.startswith("gen_")
            text += ("|" if tool == "Quartus" else "/") if start else "."
        end = {"Quartus": ("altsyncram:mem_rtl_0|ram_block1a0" if memory else f"{register}[0]"),
               "Diamond": ("mem_0_0" if memory else f"{register}_0")}
        result.append(text + end.get(tool, "mem_reg_0" if memory else f"{register}_reg[0]"))
    return result


def collection(text):
    """(kind, patterns) of what stands between [ and ]."""
    kind, body = COLLECTION.fullmatch(text).groups()
    return kind, [word for word in body.replace("{", " ").replace("}", " ").split() if word not in WORDS]


def fits(tool, thing, clock, name):
    """A register or port of a clock is in a collection."""
    kind, patterns = thing
    if kind == "clocks":
        return patterns == [clock]
    if name.startswith("port:"):
        return kind == "ports" and any(fnmatch.fnmatchcase(name.removeprefix("port:"), pattern) for pattern in patterns)
    return kind != "ports" and any(
        all(fnmatch.fnmatchcase(form, pattern) for form in tool_names(tool, name)) for pattern in patterns)


def file_findings(name, tool, text, netlist, table):
    """Registers and ports that do not exist, paths without a line or with two."""
    findings, lines = [], []
    for command in text.splitlines():
        if command.startswith("#"):
            continue
        things = [collection(found.group(0)) for found in COLLECTION.finditer(command)]
        for kind, patterns in things:
            for pattern in patterns:
                if kind == "ports" and not fnmatch.filter(netlist.ports, pattern):
                    findings.append(f"{name}: there is no port {pattern}")
                elif kind == "clocks" and pattern not in netlist.clocks:
                    findings.append(f"{name}: there is no clock {pattern}")
                elif kind in ("cells", "registers") and not any(
                        fits(tool, (kind, [pattern]), None, register) for register in netlist.registers):
                    findings.append(f"{name}: there is no register {pattern}")
        if re.match(r"set_(false_path|max_delay) ", command) and " -hold " not in command:
            lines.append(things)
    for source, clock, receiver in netlist.crossings(asynchronous_ports(netlist.top, table)):
        of = netlist.domains.get(source)
        number = sum(fits(tool, start, of, source) and fits(tool, end, clock, receiver) for start, end in lines)
        if number != 1:
            findings.append(f"{name}: {source} to {receiver} ({clock}) has {number} lines")
    return findings


# ---- files ---------------------------------------------------------------------------------------


def cells(tool, names):
    """A collection of registers and memories. A star stands for what a tool puts behind a generate block, and Quartus
    before an instance."""
    quartus = tool == "Quartus"
    paths = []
    for name in names:
        *path, register = name.split(".")
        text = "".join("*" * quartus + part + ("*" if part.startswith("gen_") else "|" if quartus else "/")
                       for part in path)
        paths.append(re.sub(r"\*+", "*", f"*{text}{'' if quartus and register == 'mem' else register}*"))
    if tool == "Vivado":
        return "[get_cells -hierarchical -filter {" + " || ".join(f"NAME =~ {path}" for path in paths) + "}]"
    return ("[get_registers {" if quartus else "[get_cells -hierarchical {") + " ".join(paths) + "}]"


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


def sampled_spi(tool):
    """MISO of an SPI slave that samples SCLK: its delay is part of the margin."""
    alone = "-datapath_only " if tool == "Vivado" else ""
    return f"""
# SPI: MISO is a flop of clk_i. What its way to the pin takes is taken from the margin of the host (docs/axi.md).
set_max_delay {alone}-from [get_clocks host] -to [get_ports miso_o] $host_period
"""


def beginning(tool, names):
    """A collection of what a line has as `from`: all ports, all registers, or one clock."""
    kind, _, first = names[0].partition(":")
    if kind == "clock":
        return f"[get_clocks {first}]"
    if kind == "port":
        return f"[get_ports {{{' '.join(name.removeprefix('port:') for name in names)}}}]"
    return cells(tool, names)


def text(tool, top, preset, lines):
    features = (f"the preset {preset}" if preset in project.presets() else f"FEATURES {preset}") if top in TOPS else \
        "any parameters"
    out = [HEAD.format(tool=tool, top=top, features=features)]
    for kind, (port, period) in CLOCKS[top].items():
        out += [f"set {kind}_period {float(period)}",
                f"create_clock -name {kind} -period ${kind}_period [get_ports {port}]"]
    if top == "mb4_core":
        out.append(spi(tool).rstrip("\n"))
    if top == "biss_spi":
        out.append(sampled_spi(tool).rstrip("\n"))
    for line in lines:
        start = beginning(tool, line["from"])
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


def files(table, netlists):
    """{path: (tool, netlist, what stands in it)}; the path of a preset's file is that in a release."""
    found = {}
    for (preset, top), module in netlists.items():
        folder = folder_of(room_of(top)) / ("" if preset == "full" else preset)
        for name, (tool, what) in files_of(table, preset, module).items():
            found[folder / name] = (tool, module, what)
    return found


def files_of(table, preset, module):
    """{name: (tool, what stands in it)} of one netlist."""
    lines = [line for line in (present(line, module) for line in lines_of(module.top, table)) if line]
    return {name.format(module.top): (tool, text(tool, module.top, preset, lines)) for tool, name in FILES.items()}


def write_features(table, features, folder):
    """The files of the tops with presets with these features."""
    word = project.presets().get(features)
    word = int(features, 0) if word is None else word
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as place:
        for top in TOPS:
            module = Netlist(top, netlist(top, {"Features": word}, Path(place)))
            for name, (_, what) in files_of(table, features, module).items():
                (folder / name).write_text(what, encoding="utf-8")
                print(folder / name)


# ---- page ----------------------------------------------------------------------------------------


def page_findings(table, page):
    """Rows of the page that the table does not have, and the other way round."""
    rows = Counter(row for row in re.findall(r"^\| ([^|]+) \|[^|]*\|[^|]*\|[^|]*\|[^|]*\|$", page, re.M)
                   if row != "signal")
    said = {}
    for line in table:
        said.setdefault(line["row"], set()).add(line.get("to"))
    return [f"no line for the row '{row}'" for row, number in rows.items() if len(said.get(row, ())) < number] + \
        [f"the page has no row '{row}'" for row in sorted(said.keys() - rows.keys())]


def self_test(table, made, netlists):
    """The planted faults that make no finding."""
    page = PAGE.read_text(encoding="utf-8")
    missed = []
    for path, (tool, module, good) in made.items():
        if path.name.startswith("mb4_core"):
            line = next(line for line in good.splitlines() if "kept_q" in line and "-hold" not in line)
            planted = {"a line that is missing": good.replace(line, ""), "two lines": f"{good}{line}\n",
                       "a register that does not exist": good.replace("kept_q", "keeps_q"),
                       "a port that does not exist": good.replace("sl1_i", "sl_i"),
                       "a port of SPI that does not exist": good.replace("mosi_i", "mosi"),
                       "a clock that does not exist": good.replace("get_clocks frame", "get_clocks frames")}
            missed += [f"{path}: not noticed: {what}" for what, wrong in planted.items()
                       if wrong == good or not file_findings(path, tool, wrong, module, table)]
    first = next(line for line in table if line["row"] == "base kept")
    others = [line for line in table if line is not first]
    wrong = [*others, {**first, "from": [*first["from"], "u_regs.u_none_q"]}]
    if not table_findings(wrong, netlists["full", "mb4_core"]):
        missed.append("not noticed: a name of the table that does not exist")
    without = [line for line in table if (line["row"], line.get("to")) != ("NRES", "host")]
    if not page_findings(others, page) or not page_findings(without, page) or not page_findings(
            [*table, {**first, "row": "none"}], page):
        missed.append("not noticed: a row that is missing on one side")
    return missed


def features_argument(text):
    if text not in project.presets():
        int(text, 0)
    return text


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--features", type=features_argument)
    arguments = parser.parse_args()
    table = tables()
    if arguments.features:
        write_features(table, arguments.features, arguments.folder)
        return
    presets = cores() if arguments.check else [core for core in cores() if core[0] == "full"]
    netlists = {(preset, top): Netlist(top, netlist(top, parameters, arguments.folder / preset))
                for preset, top, parameters in presets}
    made = files(table, netlists)
    if not arguments.check:
        for path, (_, _, what) in made.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(what, encoding="utf-8")
        return
    findings = page_findings(table, PAGE.read_text(encoding="utf-8"))
    for top in CLOCKS:
        findings += table_findings(table, netlists["full", top])
    kept = {folder_of(room) / name.format(top) for room, tops in ROOMS.items() for top in tops for name in FILES.values()}
    for path, (tool, module, what) in made.items():
        name = path.relative_to(project.RTL)
        if path in kept:
            there = path.read_text(encoding="utf-8") if path.exists() else ""
            if there != what:
                findings.append(f"{name}: is not what tools/synth/constraints.py writes")
        findings += file_findings(name, tool, what, module, table)
    others = {path for room in ROOMS for path in folder_of(room).rglob("*.*dc") if path not in kept}
    findings += [f"{path.relative_to(project.RTL)}: no tool reads it" for path in sorted(others)]
    if not findings:   # the planted faults need a table and files without one
        findings = self_test(table, made, netlists)
    project.finish(findings, f"{len(made)} files: each name exists, each path between clocks has one line, planted "
                             "faults are noticed")


if __name__ == "__main__":
    main()
