#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Each RTL module that decides something has a block test, or a row that says what tests it instead.

  check_blocks.py               every module of rtl/ with an always_ff, or an always_comb with a case
  check_blocks.py --self-test   planted faults are reported

The test of rtl/ROOM/MODULE.sv is tests/block/ROOM/MODULE_test.cpp, and a program of tests/block has it.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import sv_widths  # noqa: E402

BUILD = "tests/block/CMakeLists.txt"
# proof NAME: tests/formal/NAME.sv is about the module. through PARENT: PARENT uses the module, and has
# a block test or a row here. test FILE: tests of the whole chip, for a module that connects others and
# has few flops of its own.
INSTEAD = {
    "axi_word": "through axi_channel",
    "axi_core": "test tests/chip/axi/axi_frame_test.cpp",          # pins error and warn
    "biss_frame": "through biss_line",
    "clb_counter": "through clb_frame",
    "clb_frame": "through biss_clb",
    "clb_page": "through biss_clb",
    "clb_regs": "through biss_clb",
    "biss_sl_capture": "through biss_sl_sampler",
    "enc_axis_fifo": "proof axis",
    "enc_ram": "through mb4_memory",
    "enc_ram_pair": "through mb4_memory",
    "enc_ram_row": "through mb4_slave_cfg",
    "enc_reset_sync": "through mb4_engine",
    "enc_sync_bit": "through enc_count_rx",
    "enc_time": "through mb4_page",
    "dsl_answer": "through dsl_message",
    "dsl_crc16": "through dsl_vertical",
    "dsl_events": "test tests/block/dsl/dsl_regs_test.cpp",  # with the registers
    "dsl_judge": "through dsl_line",
    "dsl_learn": "through dsl_receiver",
    "dsl_bridge": "test tests/block/dsl/dsl_axil_test.cpp",  # two clocks
    "dsl_map": "through dsl_regs",
    "dsl_program": "through dsl_position",
    "dsl_link": "through dsl_line",
    "dsl_request": "through dsl_message",
    "dsl_rx": "through dsl_receiver",
    "dsl_sample": "through dsl_receiver",
    "dsl_stored": "through dsl_message",
    "dsl_work": "through dsl_message",
    "mb4_control": "test tests/chip/control/control_fault_test.cpp",  # time base between frames
    "mb4_engine": "test tests/chip/registers/register_test.cpp",   # resets
    "mb4_lines": "test tests/chip/registers/config_change_test.cpp",   # actuators from one flop
    "mb4_spi_cmd": "through mb4_spi",
    "mb4_spi_shift": "through mb4_spi",
    "pru_control": "through pru_core",
    "pru_frame": "through pru_core",
    "pru_memory": "through pru_core",
    "pru_pace": "through pru_core",
    "pru_regs": "through pru_core",
    "pru_timebase": "through pru_frame",
}


def decides(text):
    return "always_ff" in text or "always_comb" in text and re.search(r"\bcase\b", text)


def uses(text, module, name=r"\w+"):
    """The text has an instance `name` of the module."""
    return re.search(rf"^\s*{module}\s*(?:#\s*\(.*\)\s*)?{name}\s*\(|^\s*{module}\s*#\s*\($", text, re.M)


def evidence(row, module, files, modules, tested, instead):
    """What is wrong with a row, or None."""
    kind, _, name = row.partition(" ")
    if kind == "proof":
        path = f"tests/formal/{name}.sv"
        if path not in files or not uses(files[path], module, "u_dut"):
            return f"{path} is no proof of it"
    elif kind == "through":
        if name not in modules or not uses(files[modules[name]], module):
            return f"{name} does not use it"
        if name not in tested and name not in instead:
            return f"{name} itself has neither a block test nor a row"
    elif kind == "test":
        if not re.search(r"^TEST", files.get(name, ""), re.M):
            return f"{name} holds no test"
    else:
        return f"'{kind}' is none of proof, through, test"
    return None


def findings_of(files, instead):
    found = []
    modules = {Path(name).stem: name for name in files
               if name.startswith("rtl/") and not name.endswith("_pkg.sv")}
    tested = set()
    for module, name in modules.items():
        test = re.sub(r"^rtl/(.*)\.sv$", r"tests/block/\1_test.cpp", name)
        if test in files:
            tested.add(module)
            if test.removeprefix("tests/block/") not in files[BUILD].split():
                found.append(f"{test}: {BUILD} does not build it")
    for module, name in modules.items():
        if decides(files[name]) and module not in tested and module not in instead:
            found.append(f"{name} has no block test, and no row in {Path(__file__).name}")
    for module, row in instead.items():
        if module not in modules or module in tested or not decides(files[modules[module]]):
            found.append(f"{module}: a row in {Path(__file__).name} that is not needed")
        elif wrong := evidence(row, module, files, modules, tested, instead):
            found.append(f"{module}, row '{row}': {wrong}")
    return found


def project_files():
    files = {}
    for pattern in ("rtl/**/*.sv", "tests/block/**/*_test.cpp", "tests/chip/**/*_test.cpp",
                    "tests/formal/*.sv", BUILD):
        for path in sorted(project.ROOT.glob(pattern)):
            text = path.read_text(encoding="utf-8")
            files[str(path.relative_to(project.ROOT))] = (
                sv_widths.without_comments(text) if path.suffix == ".sv" else text)
    return files


def self_test():
    flop = "always_ff @(posedge clk_i) a <= b;\n"
    files = {
        "rtl/a/top.sv": "  part u_part (\n  ram #(.W(1)) u_ram (\n", "rtl/a/part.sv": flop, "rtl/a/ram.sv": flop,
        "rtl/a/core.sv": flop, "rtl/a/wires.sv": "assign a = b;\n", "rtl/a/proven.sv": flop,
        "rtl/a/a_pkg.sv": flop, "tests/block/a/top_test.cpp": "TEST(A, B) {\n",
        "tests/chip/core_test.cpp": "TEST(A, B) {\n", "tests/formal/one.sv": "  proven u_dut (\n",
        BUILD: "    a/top_test.cpp\n"}
    rows = {"part": "through top", "ram": "through top", "core": "test tests/chip/core_test.cpp",
            "proven": "proof one"}
    cases = {
        "the good tree": ({}, {}, 0),
        "a module without a test": ({"rtl/a/new.sv": flop}, {}, 1),
        "one with a case": ({"rtl/a/new.sv": "always_comb begin\n  unique case (a)\n"}, {}, 1),
        "one with a test": ({"rtl/a/new.sv": flop, "tests/block/a/new_test.cpp": "",
                             BUILD: "a/top_test.cpp a/new_test.cpp"}, {}, 0),
        "one with a test of another room": ({"rtl/a/new.sv": flop, "tests/block/b/new_test.cpp": "",
                                             BUILD: "a/top_test.cpp b/new_test.cpp"}, {}, 1),
        "a test that is not built": ({BUILD: ""}, {}, 1),
        "a row of a module with a test": ({}, {"top": "proof one"}, 1),
        "a row of no module": ({}, {"gone": "proof one"}, 1),
        "a row of wires": ({}, {"wires": "proof one"}, 1),
        "a proof of another module": ({}, {"core": "proof one"}, 1),
        "a proof that is gone": ({}, {"proven": "proof two"}, 1),
        "a parent that does not use it": ({}, {"core": "through top"}, 1),
        "a parent without a test": ({"rtl/a/core.sv": flop + "  wires u_wires (\n  part u_part (\n",
                                     "rtl/a/wires.sv": "  part u_part (\n"}, {"part": "through wires"}, 1),
        "a file without a test": ({"tests/chip/core_test.cpp": ""}, {}, 1),
        "another kind": ({}, {"core": "luck"}, 1),
    }
    return [f"{what}: expected {count} finding(s), got {found}" for what, (text, row, count) in cases.items()
            if len(found := findings_of(files | text, rows | row)) != count]


def main():
    arguments = project.Arguments(__doc__)
    arguments.add_argument("--self-test", action="store_true", dest="self_test")
    if arguments.parse_args().self_test:
        project.finish(self_test(), "planted faults are reported")
    files = project_files()
    if sum(name.startswith("rtl/") for name in files) < 50:
        project.finish(["fewer modules than there must be: is the tree whole?"], "")
    project.finish(findings_of(files, INSTEAD), "every module that decides has its test")


main()
