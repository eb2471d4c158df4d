#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Text check of the RTL: the written subset that Yosys 0.23 reads right, and the style of a file.

  check_subset.py [FILE...]    default: rtl/**/*.sv and the packages of rtl/mb4/mb4.f
  check_subset.py --self-test  a bad snippet for every rule, and good ones

One line `file:line: message` per finding, exit status 1. The rules marked W name constructs of
which Yosys 0.23 builds wrong hardware without a message; most of the others it refuses.
"""

import bisect
import functools
import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
from sv_widths import module_header, split_commas  # noqa: E402

MAX_COLUMNS = 100
USER_TYPE = r"(?:\w+::)?\w+_[te]\b"
PLAIN_TYPE = r"(?:logic|bit|reg|wire|byte|int|integer|shortint|longint|genvar)\b"
STRUCT = r"\b(?:\w+::)?\w+_t\b"
DIMENSION = r"\[[^\]\n]*\]"

# Constructs that a pattern finds anywhere outside comments, strings and FORMAL sections.
PATTERNS = [
    (r"\bimport\b", "import: write pkg::name out"),
    (r"\breturn\b", "return: assign the function's name"),
    (r"'\{", "assignment pattern '{...}: assign field by field"),
    (rf"{USER_TYPE}\s*(?:un)?(?:signed\b)?\s*\[", "W packed array of a user type"),
    (rf"{USER_TYPE}\s+\w+(?:\s*,\s*\w+)*\s*\[", "W unpacked array of a user type"),
    (r"\binside\b", "inside"),
    (r"\b(?:unique0?|priority)\s+if\b", "unique/priority if: use a case"),
    (rf"\$bits\s*\(\s*(?:{USER_TYPE}|{PLAIN_TYPE})", "$bits of a type: use the width's constant"),
    (rf"(?:{USER_TYPE}|\b(?:int|integer|byte|logic|bit))\s*'\s*\(", "cast to a type"),
    (r"\b(?:break|continue)\s*;", "break/continue"),
    (r"\.\*", ".* connection"),
    (r"\b(?:assert|assume|cover|restrict|expect)\b(?:\s+property\b)?|\b(?:sequence|property)\b",
     "assertion: use the macros of enc_check.svh"),
    (r"\b(?:interface|modport|virtual)\b", "interface"),
    (r"\binitial\b", "initial outside FORMAL"),
    (r"(?<![\w`])#\s*(?:\d|[A-Za-z_])", "delay"),
    (r"\{\s*(?:<<|>>)", "streaming operator"),
    (r"[!=]=\?", "wildcard equality: use casez"),
    (r"\bparameter\s+(?:type|string|real)\b", "type, string or real parameter"),
    (r"\bassign\s+\w+\.\w+\.\w", "assignment to a member of a member: Icarus 11 refuses it"),
    (r"\balways\b(?!_)", "plain always: use always_comb or always_ff"),
]


def blank(text, pattern):
    """Replaces what matches by spaces, so that positions stay."""
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group(0)), text,
                  flags=re.S | re.M)


def code_only(text):
    """Source without comments, strings, attributes, directives and what only FORMAL sees."""
    text = blank(text, r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"')
    text = blank(text, r"\(\*(?!\)).*?\*\)")
    text = blank(text, r"^\s*`ifdef\s+FORMAL\b.*?^\s*`(?:else|endif)\b")
    text = blank(text, r"^\s*`(?:include|define|undef|ifdef|ifndef|else|elsif|endif)\b[^\n]*")
    return blank(text, r"`ENC_(?:ASSERT|COVER|ASSUME)\w*\s*\([^;]*?\)\s*$")


class File:
    def __init__(self, path, name=None):
        self.path = path
        self.name = name or path.name
        self.raw = path.read_bytes()
        self.text = self.raw.decode("utf-8", errors="replace")
        self.code = code_only(self.text)
        self.starts = [0] + [m.end() for m in re.finditer("\n", self.text)]
        self.findings = []

    def report(self, position, message):
        self.findings.append((bisect.bisect_right(self.starts, position), message))

    def matches(self, pattern, flags=0):
        return re.finditer(pattern, self.code, flags)


def structs(file):
    return [m.span() for m in file.matches(r"\b(?:struct|union)\b[^{;]*\{[^}]*\}")]


def functions(file):
    """(name, start, end of the header, end) of each function and task."""
    return [(m.group(1), m.start(), m.start(2), m.end()) for m in file.matches(
        r"\b(?:function|task)\b[^;(]*?\b(\w+)\s*([;(].*?)\bend(?:function|task)\b", re.S)]


def inside_block(file):
    """A test: does a position lie between begin and end, or inside a function?"""
    places, depths, depth = [0], [0], 0
    for match in file.matches(r"\b(?:begin|end)\b"):
        depth += 1 if match.group(0) == "begin" else -1
        places.append(match.start())
        depths.append(depth)
    spans = [(header, end) for _, _, header, end in functions(file)]

    def test(position):
        return depths[bisect.bisect_right(places, position) - 1] > 0 or \
            any(start <= position < end for start, end in spans)
    return test


def check_patterns(file):
    for pattern, message in PATTERNS:
        for match in file.matches(pattern):
            if "packed array" in message and any(a <= match.start() < b for a, b in structs(file)):
                continue  # reported as such by the member's own rule
            file.report(match.start(), message)


def check_structs(file):
    for start, end in structs(file):
        for match in re.finditer(rf"{USER_TYPE}\s*\[|{USER_TYPE}\s+\w+\s*\[", file.code[start:end]):
            file.report(start + match.start(), "W array of a user type as struct member")


def check_declarations(file):
    in_block = inside_block(file)
    in_struct = structs(file)
    for match in file.matches(rf"(?:\b\w+::)?\b\w+_t\s+\w+\s*(?=[;,=)])"):
        before = file.code[:match.start()].rstrip()
        if in_block(match.start()) and not before.endswith("function"):
            file.report(match.start(), "W variable or argument of a struct type inside a block "
                                       "or function: declare it in the module")
    for match in file.matches(rf"^[ ]*(automatic\s+)?(?:{PLAIN_TYPE}|{USER_TYPE})"
                              rf"[^;=()\n]*(=(?!=))?[^;\n]*;", re.M):
        if any(a <= match.start() < b for a, b in in_struct):
            continue
        if match.group(1):
            file.report(match.start(), "automatic variable")
        elif match.group(2):
            file.report(match.start(), "variable initialised at its declaration")
    for match in file.matches(rf"\b(?:logic|bit|reg|wire)\b[^;,()\n\[]*{DIMENSION}\s*\["):
        if not any(a <= match.start() < b for a, b in in_struct):
            file.report(match.start(), "two packed dimensions outside a struct")


def check_functions(file):
    for name, start, _, end in functions(file):
        for match in re.finditer(rf"\b{name}\s*\.\s*\w+\s*(?:\[[^]]*\]\s*)?=(?!=)",
                                 file.code[start:end]):
            file.report(start + match.start(), "W member assignment to the function's name")


def check_enum_methods(file):
    enums = {name for m in file.matches(r"\b\w+_e\s+(\w+(?:\s*,\s*\w+)*)\s*[;,)]")
             for name in re.split(r"\s*,\s*", m.group(1))}
    for match in file.matches(r"\b(\w+)\.(?:first|last|next|prev|num|name)\b(\s*\(\s*\d*\s*\))?"):
        if match.group(1) in enums or match.group(2):
            file.report(match.start(), "enum method")


def check_ports(file):
    header = re.search(r"\bmodule\s+\w+\s*(?:import[^;]*;)?\s*(?:#\s*\(.*?\)\s*)?\(([^;]*)\)\s*;",
                       file.code, re.S)
    if not header:
        return
    position = header.start(1)
    for part in split_commas(header.group(1)):
        at = position + len(part) - len(part.lstrip())
        position += len(part) + 1
        if re.search(rf"\w\s*{DIMENSION}\s*$", part) and not re.search(USER_TYPE, part):
            file.report(at, "unpacked array as port")


def check_connections(file):
    """Instances: `module name (`, parameters and ports by name."""
    for match in file.matches(r"^[ ]*([a-z]\w*_\w+)\s*(#\s*\()?", re.M):
        rest = file.code[match.end():]
        if match.group(2):
            depth, end = 1, 0
            while depth and end < len(rest):
                depth += (rest[end] == "(") - (rest[end] == ")")
                end += 1
            parts, rest = split_commas(rest[:end - 1]), rest[end:]
            if any(not part.strip().startswith(".") for part in parts):
                file.report(match.start(1), "parameter connected by position")
        instance = re.match(r"\s*(u_\w+)\s*\(", rest)
        if not instance:
            continue
        depth, end = 1, instance.end()
        while depth and end < len(rest):
            depth += (rest[end] == "(") - (rest[end] == ")")
            end += 1
        parts = split_commas(rest[instance.end():end - 1])
        if any(not part.strip().startswith(".") for part in parts):
            file.report(match.start(1), "port connected by position")


def struct_names(code):
    """Variables and ports of a struct type."""
    return {name for m in re.finditer(rf"{STRUCT}\s+(\w+(?:\s*,\s*\w+)*)\s*(?=[;,)])", code)
            for name in re.split(r"\s*,\s*", m.group(1))}


@functools.cache
def struct_ports():
    """{module: its ports of a struct type} of all RTL."""
    return {module: {port for part in split_commas(module_header(path)[1]) if re.search(STRUCT, part)
                     for port in re.findall(r"(\w+)\s*$", part)}
            for module, path in project.rtl_modules().items()}


def check_fields(file):
    """A struct is filled and read by its fields, never by their order."""
    names = struct_names(file.code)
    for match in file.matches(r"\b(\w+)\s*<?=\s*\{"):
        if match.group(1) in names:
            file.report(match.start(), f"concatenation into the struct {match.group(1)}: assign field by field")
    for match in file.matches(r"\{([^{}=;]*)\}\s*<?=(?!=)"):
        if names & set(re.split(r"\s*,\s*", match.group(1).strip())):
            file.report(match.start(), "struct in a concatenation on the left: take slices, one for each")
    for match in file.matches(r"^[ ]*([a-z]\w*_\w+)\s*(?:#\s*\((?:[^()]|\([^()]*\))*\)\s*)?u_\w+\s*\(", re.M):
        ports = struct_ports().get(match.group(1), ())
        end = file.code.find(";", match.end())
        for port in re.finditer(r"\.(\w+)\s*\(\s*\{", file.code[match.end():end]):
            if port.group(1) in ports:
                file.report(match.end() + port.start(),
                            f"concatenation into the struct port {port.group(1)}: assign field by field")


# Falling edges of clocks: SL is sampled twice a clock, clocks are switched while they are low, SPI
# sends after them, the bus latches the address. Everything else takes the rising edge.
FALLING = {"biss_sl_capture.sv", "enc_clk_mux.sv", "mb4_spi_shift.sv", "mb4_spi.sv",
           "mb4_par_bus.sv"}


def check_falling_edges(file):
    """The first event of a process; resets come behind it."""
    for match in file.matches(r"@\s*\(\s*negedge\b"):
        if file.name not in FALLING:
            file.report(match.start(), "falling edge of a clock")


def check_packages(file):
    package = re.search(r"\bpackage\s+(\w+)", file.code)
    if package:
        for match in file.matches(r"\b(\w+)::"):
            if match.group(1) != package.group(1):
                file.report(match.start(), "a package refers to another one")


def check_style(file, generated):
    lines = file.text.split("\n")
    head = lines[:4]
    if not any("SPDX-FileCopyrightText: " in line for line in head) or \
            not any(line.endswith("SPDX-License-Identifier: Apache-2.0") for line in head):
        file.report(0, "the two SPDX lines are missing")
    for start, line in zip(file.starts, lines):
        if len(line) > MAX_COLUMNS:
            file.report(start, f"{len(line)} columns, at most {MAX_COLUMNS}")
        if "\t" in line:
            file.report(start, "tab")
        if line.endswith((" ", "\r")):
            file.report(start, "white space at the end of the line")
        if not line.isascii():
            file.report(start, "not ASCII")
    units = list(file.matches(r"\b(?<!end)(module|package|program|class)\s+(?:automatic\s+)?(\w+)"))
    if not units:
        file.report(0, "no module or package")
    for unit in units[1:]:
        file.report(unit.start(), "second module in the file")
    if units and units[0].group(2) != Path(file.name).stem:
        file.report(units[0].start(), f"{units[0].group(2)}: not the name of the file")


def check(path, name=None, generated=False):
    """Findings of one file as (line, message)."""
    file = File(path, name)
    check_patterns(file)
    check_structs(file)
    check_declarations(file)
    check_functions(file)
    check_enum_methods(file)
    check_ports(file)
    check_connections(file)
    check_fields(file)
    check_falling_edges(file)
    check_packages(file)
    check_style(file, generated)
    return sorted(file.findings)


# ---- Self-test -----------------------------------------------------------------------------------

SPDX = ("// SPDX-FileCopyrightText: 2026 The openmb4 authors\n"
        "// SPDX-License-Identifier: Apache-2.0\n")
HEADER = "module mb4_x (\n  input  logic clk_i,\n  output logic y_o\n);\n"

# (part of the message, lines inside a module); each gives exactly this finding in its last line
# but `lines after` many.
BAD_BODIES = [
    ("import:", "import mb4_pkg::cfg_t;"),
    ("return:", "function logic f(input logic a);\n  return a;", "endfunction"),
    ("assignment pattern", "assign y_o = '{default: 1'b0};"),
    ("member of a member", "assign offer_o.word.stop = 1'b0;"),
    ("W packed array", "mb4_pkg::instr_t [3:0] four;"),
    ("W packed array", "state_e [1:0] states;"),
    ("W unpacked array", "mb4_pkg::instr_t four [0:3];"),
    ("W unpacked array", "mb4_pkg::instr_t one, four [0:3];"),
    ("W variable or argument", "always_comb begin\n  mb4_pkg::instr_t both;", "end"),
    ("W variable or argument", "for (genvar i = 0; i < 2; i++) begin : gen_x\n  pair_t both;",
     "end"),
    ("W variable or argument", "function logic f(input mb4_pkg::instr_t a);",
     "f = a.brk;\nendfunction"),
    ("W variable or argument", "function logic f(input logic a);\n  pair_t both;",
     "f = a;\nendfunction"),
    ("W member assignment", "function mb4_pkg::instr_t f(input logic a);\n  f.brk = a;",
     "endfunction"),
    ("W array of a user type as struct member",
     "typedef struct packed {\n  nib_t [1:0] both;", "} many_t;"),
    ("inside", "assign y_o = a inside {1, 2};"),
    ("unique/priority if", "always_comb begin\n  unique if (a) y_o = 1'b0;", "end"),
    ("$bits", "localparam int unsigned W = $bits(mb4_pkg::cfg_t);"),
    ("cast", "assign a = mb4_pkg::instr_t'(b);"),
    ("cast", "assign a = state_e'(b);"),
    ("cast", "assign a = int'(b);"),
    ("enum method", "state_e state_q;\nassign a = state_q.next();"),
    ("enum method", "state_e state_q;\nassign a = state_q.first;"),
    ("break", "always_comb begin\n  for (int i = 0; i < 2; i++) break;", "end"),
    ("break", "always_comb begin\n  for (int i = 0; i < 2; i++) continue;", "end"),
    ("automatic", "always_comb begin\n  automatic logic a;", "end"),
    ("automatic", "always_comb begin\n  automatic logic a = b;", "end"),
    ("initialised", "always_comb begin\n  logic a = b;", "end"),
    ("initialised", "logic a = 1'b0;"),
    ("two packed dimensions", "logic [1:0][3:0] a;"),
    (".* connection", "mb4_y u_y (.*);"),
    ("assertion", "assert property (@(posedge clk_i) y_o);"),
    ("assertion", "always_comb begin\n  assert (y_o);", "end"),
    ("assertion", "property p;", ""),
    ("interface", "interface bus;", ""),
    ("initial", "initial y = 1'b0;"),
    ("delay", "assign #1 y_o = a;"),
    ("delay", "always_ff @(posedge clk_i) y_q <= #DELAY a;"),
    ("streaming", "assign a = {<<{b}};"),
    ("wildcard", "assign a = b ==? 4'b1xx0;"),
    ("type, string", "parameter type T = logic;"),
    ("plain always", "always @* y_o = a;"),
    ("falling edge", "always_ff @(negedge clk_i or negedge rst_ni) y_q <= a;"),
    ("parameter connected", "mb4_y #(8) u_y (.clk_i);"),
    ("port connected", "mb4_y #(.W(8)) u_y (clk_i);"),
    ("port connected", "mb4_y u_y (.clk_i, a);"),
    ("concatenation into the struct both", "pair_t both;\nassign both = {a, b};"),
    ("concatenation into the struct held_q", "mb4_pkg::instr_t held_q;\nalways_ff @(posedge clk_i) held_q <= {a, b};"),
    ("struct in a concatenation", "pair_t one, two;\nassign {two, one} = a;"),
    ("concatenation into the struct port", "mb4_memory u_y (.clear_i ({a, b}));"),
    ("tab", "\tlogic a;"),
    ("white space", "logic a; "),
    ("columns", "// " + "x" * 100),
    ("not ASCII", "// \u00b5s"),
]

BAD_FILES = [
    ("unpacked array as port", 4, SPDX + "module mb4_x (\n  input logic [7:0] a_i [0:3]\n);\n"
                                         "endmodule\n"),
    ("W packed array", 4, SPDX + "module mb4_x (\n  input mb4_pkg::instr_t [3:0] a_i\n);\n"
                                 "endmodule\n"),
    ("two packed dimensions", 4, SPDX + "module mb4_x (\n  input logic [3:0][7:0] a_i\n);\n"
                                        "endmodule\n"),
    ("SPDX", 1, HEADER + "endmodule\n"),
    ("SPDX", 1, SPDX.split("\n", maxsplit=1)[0] + "\n" + HEADER + "endmodule\n"),
    ("not the name", 3, SPDX + HEADER.replace("mb4_x", "mb4_z") + "endmodule\n"),
    ("second module", 8, SPDX + HEADER + "endmodule\nmodule mb4_y;\nendmodule\n"),
    ("no module", 1, SPDX),
    ("a package refers", 4, SPDX + "package mb4_x;\n  localparam int unsigned A = mb4_z::B;\n"
                                   "endpackage\n"),
]

GOOD = SPDX + r"""
// import, return, '{, inside, initial: words in a comment are free.
`include "enc_check.svh"

module mb4_x #(
  parameter int unsigned Width = 8,
  parameter logic        Start = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic [Width-1:0] a_i,
  input  logic [2*mb4_pkg::SLAVE_CFG_W-1:0] cfg_i,
  output mb4_pkg::instr_t  y_o
);

  typedef enum logic [1:0] {
    IDLE,
    NEXT
  } state_e;

  typedef struct packed {
    logic [1:0][3:0] nibbles;
    logic            last;
  } pair_t;

  state_e          state_d, state_q;
  pair_t           both;
  mb4_pkg::instr_t held_q;
  logic [7:0]      mem [0:3];
  logic            next;

  localparam logic [3:0] START = 4'd1;

  function automatic logic [3:0] twice(input logic [3:0] value);
    twice = {value[2:0], 1'b0};
  endfunction

  always_comb begin
    state_d = state_q;
    next    = both.last;
    for (int i = 0; i < 4; i++) begin
      if (mem[i] == 8'h00) next = 1'b1;
    end
    unique case (state_q)
      IDLE:    state_d = NEXT;
      default: state_d = IDLE;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) held_q <= '0;
    else         held_q <= a_i[7:0];
  end

  for (genvar i = 0; i < 2; i++) begin : gen_y
    logic [7:0] local_data;
    mb4_y #(.Width(8), .Start(1'b1)) u_y (
      .clk_i,
      .last_i (both.last),
      .cfg_i  (cfg_i[i*mb4_pkg::SLAVE_CFG_W +: mb4_pkg::SLAVE_CFG_W]),
      .data_o (local_data)
    );
  end

  if (Width < 8) begin : gen_width
    $error("Width is at least 8; return or inside in a string is free");
  end

  assign both.nibbles = {twice(START), 4'(a_i[3:0])};
  assign both.last    = signed'(next);
  assign y_o  = held_q;

`ifdef FORMAL
  initial assume (!rst_ni);
`endif

  `ENC_ASSERT(StateInRange_A, clk_i, rst_ni, state_q <= NEXT)
  `ENC_ASSERT_IF(LongOne_A, clk_i, rst_ni, next,
                 both.last)

endmodule
"""


def self_test():
    problems = []
    cases = []
    for message, body, *after in BAD_BODIES:
        text = SPDX + HEADER + "  " + body.replace("\n", "\n  ") + "\n"
        line = text.count("\n")
        cases.append((message, line, text + "".join(a + "\n" for a in after) + "endmodule\n"))
    cases += BAD_FILES
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mb4_x.sv"
        for message, line, text in cases:
            path.write_text(text, encoding="utf-8")
            found = check(path)
            if len(found) != 1 or message not in found[0][1] or found[0][0] != line:
                problems.append(f"expected line {line}: {message}; found {found} in:\n{text}")
        path.write_text(GOOD, encoding="utf-8")
        problems += [f"good file, line {line}: {message}" for line, message in check(path)]
    rules = {message for _, message in PATTERNS}
    tested = {rule for rule in rules if any(message in rule for message, *_ in cases)}
    problems += [f"no bad snippet for: {rule}" for rule in sorted(rules - tested)]
    project.finish(problems, f"{len(cases)} bad snippets, each reported once, and a good one")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    paths = [Path(name).resolve() for name in sys.argv[1:]]
    if not paths:
        paths = sorted(set(project.RTL.rglob("*.sv")) | set(project.all_rtl_files()))
    findings = []
    for path in paths:
        generated = "generated" in path.parts
        name = path.relative_to(project.ROOT) if path.is_relative_to(project.ROOT) else path
        findings += [f"{name}:{line}: {message}" for line, message in check(path, None, generated)]
    project.finish(findings, f"{len(paths)} files keep to the subset")


main()
