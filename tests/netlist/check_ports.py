#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The width of every port: in the synthesised netlist, in the source and in Verilator's eyes.

  check_ports.py packages            pkg::NAME_W is the sum of pkg::name_t's members, pkg::NAME_FIELD the place of
                                     its member field
  check_ports.py netlist FOLDER      FOLDER/all.json (check_synth.py every) against the source,
                                     modules with other than default parameters included
  check_ports.py verilator FOLDER    Verilator against the source
  check_ports.py self-test FOLDER    planted: packed arrays as ports, a wrong constant
"""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import sv_widths  # noqa: E402
import verilator_ports  # noqa: E402
import yosys  # noqa: E402

# Pairs that must be there, so that the rule cannot become empty by a new name.
NEEDED_PAIRS = {"mb4_pkg::SLAVE_CFG_W", "biss_pkg::WORD_W", "biss_pkg::LINE_DATA_W", "axi_pkg::WORD_GOOD",
                "axi_pkg::RESULT_DELAY", "axi_pkg::EVENT_BEGUN"}

# Yosys 0.23 makes the first one too narrow without a message; a struct becomes wrong hardware.
PLANTED = {
    "array_of_struct": ("biss_pkg::word_t [3:0]", 4 * 39),
    "array_of_vector": ("nib_t [7:0]", 8 * 4),
}


def wrong_constants(scope):
    return [f"{name} is {value}, {kind} has {width} bits"
            for name, value, kind, width in sv_widths.width_constants(scope) if value != width] + \
        [f"{name} is {value}, {field} begins at bit {lsb}"
         for name, value, field, lsb in sv_widths.place_constants(scope) if value != lsb]


def differences(module, expected, found, witness):
    texts = []
    for port in sorted(set(expected) | set(found)):
        if expected.get(port) != found.get(port):
            texts.append(f"{module}.{port}: source {expected.get(port)}, "
                         f"{witness} {found.get(port)}")
    return texts


def netlist_ports(module):
    return {name: (port["direction"], len(port["bits"])) for name, port in module["ports"].items()}


def packages():
    scope = sv_widths.read_packages(project.rtl_packages())
    pairs = sv_widths.width_constants(scope) + sv_widths.place_constants(scope)
    findings = wrong_constants(scope)
    findings += [f"{name}: no such pair" for name in NEEDED_PAIRS - {pair[0] for pair in pairs}]
    project.finish(findings, ", ".join(f"{n} = {v} = {k}" for n, v, k, _ in pairs))


def netlist(folder):
    scope = sv_widths.read_packages(project.rtl_packages())
    files = project.rtl_modules()
    modules = json.loads((folder / "all.json").read_text(encoding="utf-8"))["modules"]
    findings, seen, count = [], set(), 0
    for name, module in modules.items():
        source = module["attributes"].get("hdlname", name).lstrip("\\")
        parameters = {parameter: int(bits, 2) for parameter, bits
                      in module.get("parameter_default_values", {}).items()}
        expected = sv_widths.module_ports(files[source], scope, parameters)
        findings += differences(name, expected, netlist_ports(module), "netlist")
        count += len(expected)
        seen.add(source)
    findings += [f"{m}: not in the netlist" for m in sorted(set(files) - seen)]
    project.finish(findings, f"{len(modules)} modules, {count} ports as wide as the source says")


def verilator(folder):
    scope = sv_widths.read_packages(project.rtl_packages())
    findings, count = [], 0
    generics = project.tops("generics")
    for module, path in project.rtl_modules().items():
        # The default of one that follows others is a formula; masters.toml says what it makes.
        defaults = generics[module].generics.defaults if module in generics else {}
        expected = sv_widths.module_ports(path, scope, defaults)
        findings += differences(module, expected, verilator_ports.module_ports(module, folder),
                                "Verilator")
        count += len(expected)
    project.finish(findings, f"{count} ports as wide as Verilator says")


def self_test(folder):
    findings = []
    folder.mkdir(parents=True, exist_ok=True)
    trap = folder / "trap_pkg.sv"
    trap.write_text("""package trap_pkg;
  typedef logic [3:0] nib_t;
  typedef struct packed { logic good; nib_t delay; } word_t;
  typedef struct packed { word_t word; logic [1:0] slave; } offer_t;
  localparam int unsigned WORD_GOOD = 4;
  localparam int unsigned WORD_LIMIT = 99;  // no member: another meaning
  localparam int unsigned OFFER_WORD = 2;
endpackage
""", encoding="utf-8")
    for name, (kind, width) in PLANTED.items():
        kind = kind.replace("nib_t", "trap_pkg::nib_t")
        source = folder / f"{name}.sv"
        source.write_text(f"module {name} (input {kind} a_i, output logic [{width - 1}:0] y_o);\n"
                          f"  assign y_o = a_i;\nendmodule\n", encoding="utf-8")
        files = [project.RTL / "biss/biss_pkg.sv", trap, source]
        expected = sv_widths.module_ports(source, sv_widths.read_packages(files[:2]))
        if expected["a_i"] != ("input", width):
            findings.append(f"{name}: read as {expected['a_i']} from the source, not {width}")
        findings += differences(name, expected,
                                verilator_ports.module_ports(name, folder, files), "Verilator")
        status, text = yosys.execute(
            yosys.read(files) + [f"hierarchy -top {name}", "proc", f"write_json {name}.json"],
            folder, name)
        if status == 0:
            made = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
            reported = differences(name, expected, netlist_ports(made["modules"][name]), "netlist")
            if not reported:
                findings.append(f"{name}: the netlist's ports were not reported; if this Yosys "
                                f"builds them right, the rule against them can be relaxed")
            print("\n".join(f"reported: {line}" for line in reported))
        else:
            print(f"refused by Yosys: {text.strip()}")
    trapped = sv_widths.read_packages([project.RTL / "biss/biss_pkg.sv", trap])
    for name in ("biss_pkg::WORD_W", "trap_pkg::WORD_GOOD", "trap_pkg::OFFER_WORD"):
        if wrong_constants(trapped):
            findings.append(f"right constants were reported: {wrong_constants(trapped)}")
        trapped.values[name] += 1
        if [text.split()[0] for text in wrong_constants(trapped)] != [name]:
            findings.append(f"{name}: wrong by one, and not reported")
        trapped.values[name] -= 1
    project.finish(findings, "planted traps, all reported")


def main():
    mode = sys.argv[1]
    folder = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if mode == "packages":
        packages()
    elif mode == "netlist":
        project.tool("yosys")
        netlist(folder)
    elif mode == "verilator":
        project.tool("verilator")
        verilator(folder)
    else:
        project.tool("yosys")
        project.tool("verilator")
        self_test(folder)


main()
