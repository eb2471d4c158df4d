#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""masters.toml: what tools/masters.py reads, what it refuses, and a master that is added by one entry.

  masters_test.py faults   wrong entries, each refused in one line with file, master and key
  masters_test.py toy      a copy of the tree with one more entry: each check lists the master
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import masters  # noqa: E402
import project  # noqa: E402

# (text of the file, what is said after the file's name)
WRONG = (
    ('[toy]\n', "toy: the key 'what' is missing"),
    ('[toy]\nwhat = 1\n', "toy: what: is not a text"),
    ('[toy]\nwhat = "a"\ntopps = 1\n', "toy: topps: no such key; there are what, line, list"),
    ('[toy]\nwhat = "a"\nline = "bus"\n', "toy: line: 'bus' is none of clocked, duplex"),
    ('[toy]\nwhat = "a"\nlist = "toy.x"\n', "toy: list: 'toy.x' does not exist"),
    ('[toy]\nwhat = "a"\nmaps = ["none"]\n', "toy: maps: 'regmap/generated/none' does not exist"),
    ('[toy]\nwhat = "a"\nmaps = [1]\n', "toy: maps: is not a list of texts"),
    ('[toy]\nwhat = "a"\ndriver = "toy.f"\n', "toy: driver: 'toy.f' is no folder with / at its end"),
    ('[toy]\nwhat = "a"\ncore = "none.core"\n', "toy: core: 'none.core' does not exist"),
    ('[toy]\nwhat = "a"\nuses = ["rtl/common/"]\n', "toy: uses: the master has no list"),
    ('[toy]\nwhat = "a"\nswitch = {A = "a", B = "b"}\n', "toy: switch: has more than one option"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.none = {}\n', "toy: tops.none: the list has no such module"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {plain = 1}\n', "toy: tops.toy: plain: is not true or false"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {clocks = {core = ["clk_i"]}}\n',
     "toy: tops.toy: clocks.core: is not [port, number]"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {parameters = {A = "1"}}\n', "toy: tops.toy: parameters.A: is not a number"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {buses = [{name = "a", kind = "can"}]}\n',
     "toy: tops.toy.buses[0]: kind: 'can' is none of axi4-lite"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {buses = [{name = "a", kind = "wishbone"}]}\n',
     "toy: tops.toy.buses[0]: the key 'prefix' is missing"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ngates.one = {top = "none"}\n', "toy: gates.one.top: the list has no module none"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmeasured.one = {maker = "toy.f", programs = []}\n',
     "toy: measured.one: programs: names no program"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmeasured.one = {maker = "toy.f", programs = ["a"], models.a = {top = "none"}}\n',
     "toy: measured.one.models.a.top: the list has no module none"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmeasured.one = {maker = "toy.f", programs = ["a"], blocks = ["b"], models.a = {top = "toy"}}\n',
     "toy: measured.one: blocks: goes with models that have `takes`"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmeasured.one = {maker = "toy.f", programs = ["a"], goals = {toggle = 1}}\n',
     "toy: measured.one: goals.toggle: is none of line, branch, mutants"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {}\n[other]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {}\n',
     "other: tops.toy: toy has one of this name"),
    ('[toy]\nwhat = "a"\nlist = "gone.f"\n',
     "toy: list: gone.f names 'none.sv', which does not exist"),
    ('[toy]\nwhat = "a"\nlist = "lower.f"\n',
     "toy: list: lower.f names 'none.f': No such file or directory"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {clocks = {core = ["clk", 10]}}\n',
     "toy: tops.toy.clocks.core: toy.sv has no port clk"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {clocks = {core = ["clk_i", 10]}}\n',
     "toy: tops.toy.clocks: 'constraints/crossings.toml' does not exist"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {parameters = {NONE = 1}}\n',
     "toy: tops.toy.parameters.NONE: toy.sv has no such parameter"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ngates.one = {top = "toy", parameters = {NONE = 1}}\n',
     "toy: gates.one.parameters.NONE: toy.sv has no such parameter"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}]}\n',
     "toy: tops.toy.buses: needs one or two maps, there are 0"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmaps = ["a", "b", "c"]\ntops.toy = {buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}]}\n',
     "toy: tops.toy.buses: needs one or two maps, there are 3"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmaps = ["b"]\ntops.toy = {buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}]}\n',
     "toy: tops.toy.buses: 'regmap/generated/b/b.ipxact.xml' does not exist"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {generics = {limits = {WIDTH = [1, 8]}}}\n',
     "toy: tops.toy.generics: needs buses"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmaps = ["a"]\ntops.toy = {buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}], generics = {}}\n',
     "toy: tops.toy.generics.limits.WIDTH: is missing: each int unsigned parameter has limits"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmaps = ["a"]\ntops.toy = {buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}], generics = {limits = {NONE = [1, 8]}}}\n',
     "toy: tops.toy.generics.limits.NONE: toy.sv has no such parameter"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmaps = ["a"]\ntops.toy = {buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}], generics = {limits = {WIDTH = [1, 8]}, example = {NONE = 1}}}\n',
     "toy: tops.toy.generics.example.NONE: toy.sv has no such parameter"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmaps = ["a"]\n[toy.tops.toy]\nbuses = [{name = "bus", kind = "wishbone", prefix = "wb_"}]\n'
     '[toy.tops.toy.generics.derived.WIDTH]\ndefault = 1\nxpath = "{NONE} + 1"\n',
     "toy: tops.toy.generics.derived.WIDTH.xpath: {NONE}: toy.sv has no such parameter"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {size = {page = "toy.md", note = "a", lut4 = 1}}\n',
     "toy: tops.toy.size: the key 'mhz' is missing"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {size = {page = "none.md#a", note = "a", lut4 = 1, mhz = 1}}\n',
     "toy: tops.toy.size.page: 'docs/none.md' does not exist"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {size = {page = "toy.md", note = "a", lut4 = 1, mhz = 1, seeds = 0}}\n',
     "toy: tops.toy.size: seeds: is less than 1"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {size = {page = "toy.md", note = "a", lut4 = 1, mhz = 1, parameters = {NONE = 1}}}\n',
     "toy: tops.toy.size.parameters.NONE: toy.sv has no such parameter"),
    ('[Toy]\nwhat = "a"\n', "Toy: a name begins with a small letter"),
    ('toy = 1\n', "toy: is no table"),
    ('[toy]\nwhat = \n', "Invalid value (at line 2, column 8)"),
)
# A model without RTL, as small as an entry can be, and a master with all that a check reads.
RIGHT = ('[dsl-model]\nwhat = "a"\nline = "duplex"\n',
         '[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {}\n',
         '[toy]\nwhat = "a"\nlist = "toy.f"\nmaps = ["a"]\n[toy.tops.toy]\ngenerics = {limits = {WIDTH = [1, 8]}}\n'
         'buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}]\n')
# What these files name.
PLACES = {
    "docs/toy.md": "", "toy.f": "toy.sv\n", "gone.f": "none.sv\n", "lower.f": "-F none.f\n",
    "toy.sv": "module toy #(\n  parameter int unsigned WIDTH = 1  // bits\n) (\n  input logic clk_i\n);\nendmodule\n",
    "regmap/generated/a/a.ipxact.xml": "", "regmap/generated/b/b_regs_pkg.sv": "", "regmap/generated/c/c_regs_pkg.sv": "",
}

TOY = """
[toy]
what = "a toy"
line = "duplex"
list = "rtl/toy/toy.f"
uses = ["rtl/common/"]
maps = ["toy"]
driver = "drivers/include/toy/"
core = "openmb4-toy.core"
switch = {MB4_TOY = "The simulator has the toy"}

[toy.tops.toy_bus]
ice40 = true
plain = true
clocks = {host = ["wb_clk_i", 10]}
size = {page = "README.md", note = "as it is", lut4 = 100, mhz = 50}
buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}]

[toy.tops.toy_ip]
generics = {limits = {WIDTH = [1, 32]}, example = {WIDTH = 4}}
buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}, {name = "sense_i", kind = "interrupt"}]

[toy.gates.toy_gates]
top = "toy_bus"

[toy.measured.toy_run]
maker = "rtl/toy/toy.f"
programs = ["toy_test"]
models = {toy = {top = "toy_bus"}}
"""
WISHBONE = """  input  logic wb_clk_i,
  input  logic wb_rst_i,
  input  logic wb_cyc_i,
  input  logic wb_stb_i,
  input  logic wb_we_i,
  input  logic [7:2] wb_adr_i,
  input  logic [31:0] wb_dat_i,
  input  logic [3:0] wb_sel_i,
  output logic [31:0] wb_dat_o,
  output logic wb_ack_o,
  output logic wb_err_o,
  output logic wb_stall_o,
"""
INSIDE = """
  assign {wb_stall_o, wb_err_o} = 2'b00;
  always_ff @(posedge wb_clk_i) begin
    wb_ack_o <= wb_cyc_i && wb_stb_i && !wb_rst_i;
    wb_dat_o <= wb_dat_i ^ {32{wb_we_i ^ sense_i ^ (^wb_adr_i) ^ (^wb_sel_i)}};
  end
"""
FILES = {
    "rtl/toy/toy.f": "-F ../common/common.f\n../../regmap/generated/toy/toy_regs_pkg.sv\ntoy_bus.sv\ntoy_ip.sv\n",
    "rtl/toy/toy_bus.sv": f"module toy_bus (\n{WISHBONE}  input  logic sense_i\n);\n{INSIDE}endmodule\n",
    "rtl/toy/toy_ip.sv": "module toy_ip #(\n  parameter int unsigned WIDTH = 1  // bits\n) (\n"
                         f"{WISHBONE}  output logic sense_i,\n  output logic [WIDTH-1:0] value_o\n);\n"
                         f"{INSIDE}  assign sense_i = 1'b0;\n  assign value_o = WIDTH'(wb_dat_o);\nendmodule\n",
    "rtl/toy/constraints/crossings.toml":
        '[[line]]\nrow = "sense"\nfrom = ["port:sense_i"]\nto = "host"\nrule = "stable"\n',
    "regmap/generated/toy/toy_regs_pkg.sv": "package toy_regs_pkg;\n  localparam logic [7:0] ADDR_ID = 8'h04;\nendpackage\n",
    "regmap/generated/toy/toy.ipxact.xml":
        '<ipxact:component xmlns:ipxact="http://www.accellera.org/XMLSchema/IPXACT/1685-2014">'
        "<ipxact:version>VERSION</ipxact:version><ipxact:memoryMaps><ipxact:memoryMap><ipxact:addressBlock>"
        "<ipxact:name>toy</ipxact:name><ipxact:baseAddress>'h0</ipxact:baseAddress><ipxact:range>'h100</ipxact:range>"
        "<ipxact:width>32</ipxact:width><ipxact:register><ipxact:name>ID</ipxact:name>"
        "<ipxact:addressOffset>'h4</ipxact:addressOffset><ipxact:size>32</ipxact:size></ipxact:register>"
        "</ipxact:addressBlock></ipxact:memoryMap></ipxact:memoryMaps></ipxact:component>",
    "drivers/include/toy/toy.hpp": "",
    "openmb4-toy.core": "CAPI=2:\nname: openmb4:ip:toy:VERSION\n",
}


def faults():
    findings = []
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "masters.toml"
        for name, text in PLACES.items():
            (Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
            (Path(folder) / name).write_text(text, encoding="utf-8")
        for text, wanted in WRONG:
            file.write_text(text, encoding="utf-8")
            done = subprocess.run([sys.executable, "-B", ROOT / "tools/masters.py", "--file", file],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 1 or not done.stderr.startswith(f"masters.toml: {wanted}") or done.stderr.count("\n") != 1:
                findings.append(f"expected '{wanted}', got {done.returncode}: {done.stderr or done.stdout}\n{text}")
        for text in RIGHT:
            file.write_text(text, encoding="utf-8")
            try:
                masters.read(file)
            except masters.Fault as fault:
                findings.append(f"refused: {fault}\n{text}")
    project.finish(findings, f"{len(WRONG)} wrong files, each refused with its key, and {len(RIGHT)} right ones")


def run(folder, *command):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
    return done.returncode, done.stdout + done.stderr


# Prints what the checks that import this know of the toy, and what they say of it; run in the copy.
LISTS = """
import shutil, sys
from pathlib import Path
sys.path[:0] = ["tools", "tools/synth", "tests/lint", "tests/package", "tests/mutation"]
sys.argv = ["x", "--self-test"]
import project, report, plain_verilog, ipxact, constraints, vhdl, vivado_ip, set_version, mutate, ipxact_test, vhdl_test
modules = project.rtl_modules()
def tell(what, known):
    print(what, "has the toy" if known else "LACKS THE TOY")
def right(what, findings):
    print(what, f"LACKS THE TOY: {findings}" if findings else "has the toy")
tell("netlist, every module", "toy_bus" in modules)
tell("port widths", any(path.stem == "toy_regs_pkg" for path in project.rtl_packages()))
tell("proofs", any("toy_bus" == path.stem for path in project.all_rtl_files()))
tell("gates", "toy_gates" in project.all_of("gates"))
tell("size and speed", "toy_bus" in report.SIBLINGS)
tell("set_version", "openmb4-toy.core" in set_version.VERSION_COPIES)
codes = {module: mutate.blank_comments(path.read_text()) for module, path in modules.items()}
design = project.design("toy_run")
tell("mutants", {row[0] for row in mutate.pool_of(design, codes)} <= {"toy_bus", "toy_ip"})
tell("coverage", design.counts(modules["toy_bus"]))

out = Path("made")
out.mkdir()
bus, ip = (project.tops("buses")[name] for name in ("toy_bus", "toy_ip"))
for path, text in {**vhdl.plain_texts(project.MASTERS["toy"]), **vhdl.generic_texts(ip)}.items():
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8")
tell("VHDL", Path("rtl/toy/vhdl/toy_bus_example.vhd").exists() and Path("rtl/toy/vhdl/toy_ip_component.vhd").exists())
for top in (bus, ip):
    (out / f"{top.name}.xml").write_text(ipxact.text(top.name), encoding="utf-8")
    right(f"IP-XACT of {top.name}", ipxact_test.ipxact_wrong(top, out, None))
vivado_ip.write(ip, out / "vivado")
right("Vivado", ipxact_test.vivado_wrong(ip, out / "vivado", None, out))
for name in ("ghdl", "iverilog", "yosys"):
    if shutil.which(name) is None:
        print(f"left out: VHDL and constraints of the toy: {name} is not installed")
        break
else:
    right("plain Verilog", vhdl_test.plain_findings("toy_bus", out.resolve()))
    right("VHDL with generics", vhdl_test.generic_findings(ip, out.resolve()))
    table = constraints.tables()
    netlists = {core[:2]: constraints.Netlist("toy_bus", constraints.netlist("toy_bus", core[2], out.resolve() / "netlist"))
                for core in constraints.cores() if core[1] == "toy_bus"}
    made = constraints.files(table, netlists)
    tell("constraints", len(made) == 3)
    right("crossings", constraints.table_findings(table, netlists["full", "toy_bus"]) + [
        finding for path, (tool, netlist, text) in made.items()
        for finding in constraints.file_findings(path, tool, text, netlist, table)])
    tell("a crossing without its line", all(
        constraints.file_findings(path, tool, text.replace("set_false_path", "#"), netlist, table)
        for path, (tool, netlist, text) in made.items()))
# A bus whose ports the module does not have.
bus.buses[0].prefix = "bus_"
wrong = ipxact_test.findings(bus, ipxact.text("toy_bus").replace(">wb_", ">bus_"), Path("ipxact").resolve(),
                             ipxact_test.ports_outside(bus, out))
tell("a port that does not exist", any("the module has no port bus_clk_i" in one for one in wrong))
print("all asked")
"""
# The CMake files of the rooms that ask for masters, with their functions replaced: what they would make.
CMAKE = """
cmake_minimum_required(VERSION 3.25)
get_filename_component(MB4_ROOT "${CMAKE_CURRENT_LIST_DIR}" ABSOLUTE)
execute_process(COMMAND python3 -B tools/masters.py --cmake OUTPUT_VARIABLE masters RESULT_VARIABLE status)
cmake_language(EVAL CODE "${masters}")
foreach(master IN LISTS MB4_MASTERS)
  foreach(key LIST SWITCH TOPS ICE40 SIZE GATES MEASURED)
    message("${master} ${key} ${MB4_MASTER_${master}_${key}}")
  endforeach()
endforeach()
"""


def toy():
    findings = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name in project.tracked():
            if (ROOT / name).is_file() and not name.startswith(("docs/pictures", "tests/unit", "tools/web")):
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, folder / name)
        version = ".".join(re.search(r"project\(openmb4 VERSION (\d+)\.(\d+)\.(\d+)", (ROOT / "CMakeLists.txt").read_text()).groups())
        for name, text in FILES.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text.replace("VERSION", version), encoding="utf-8")
        # Without the entry, the lint names the files that no master has.
        lint = [sys.executable, "-B", "tests/lint/check_verilator.py", "list"]
        status, text = run(folder, *lint)
        if status == 0 or "rtl/toy/toy_bus.sv: no master" not in text:
            findings.append(f"RTL of no master is not named: {text[-300:]}")

        with (folder / "masters.toml").open("a", encoding="utf-8") as file:
            file.write(TOY)
        wanted = {
            (sys.executable, "-B", "-c", LISTS): r"\A(?:(?!LACKS)[\s\S])*set_version has the toy(?:(?!LACKS)[\s\S])*all asked\n\Z",
            tuple(lint): r"(?m)^toy_bus$",
            (sys.executable, "-B", "tests/lint/check_masters.py"): r"(?m)^toy: block: .*\[\[block\]\] with room = \"toy\"$",
            (sys.executable, "-B", "tools/masters.py", "--master", "toy"): r"toy: gates: toy_gates\n",
            (sys.executable, "-B", "tests/package/check_core.py", "names"): r"openmb4-toy.core: toy\n",
            ("cmake", "-P", "toy.cmake"): r"toy SWITCH MB4_TOY\ntoy TOPS toy_bus;toy_ip\ntoy ICE40 toy_bus\ntoy SIZE toy_bus\ntoy GATES toy_gates\n"
                                          r"toy MEASURED toy_run\n",
            (sys.executable, "-B", "tests/mutation/run_mutants.py", "--master", "toy"): r"mutant_toy_run_toy_test is missing",
        }
        (folder / "toy.cmake").write_text(CMAKE, encoding="utf-8")
        for command, pattern in wanted.items():
            _, text = run(folder, *command)
            if not re.search(pattern, text):
                findings.append(f"{' '.join(command)[:80]}: the toy is not there: {text[-600:]}")

        # Its rooms have their directions: no other master, and no other kind of line.
        for name, line in (("rtl/toy/toy_x.sv", "  axi_core u_core (\n"), ("sim/masters/toy/a.cpp", '#include "sim/masters/axi/axi_model.hpp"\n'),
                           ("drivers/include/toy/a.hpp", '#include "mb4/device.hpp"\n')):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(line, encoding="utf-8")
            _, text = run(folder, sys.executable, "-B", "tests/lint/check_directions.py")
            if f"{name} uses" not in text:
                findings.append(f"{name}: a use of another master is not reported: {text[-300:]}")
            (folder / name).unlink()
    project.finish(findings, "a master of one entry is in each check")


if __name__ == "__main__":
    {"faults": faults, "toy": toy}[sys.argv[1]]()
