#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The RTL in Verilator against Yosys' gate netlist in Icarus: the same random inputs, every output
bit compared after every step. Two readers of the source, two simulators, nothing in common.

  compare_sim.py RTL_RUN FOLDER MODULE [--seed N] [--expect-difference] [--invert-gates COUNT]

Unknown bits of the netlist count as different. Every output bit must have been 0 and 1.
--invert-gates breaks COUNT gates, one at a time, and demands that nine in ten are reported. Not all
can be: one gate of biss_frame only changes the values of a counter on its way from 0 to 2.
"""

import argparse
import random
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import stimulus  # noqa: E402
import sv_widths  # noqa: E402
import yosys  # noqa: E402
from make_harness import module_file, sources_digest  # noqa: E402

DEFAULT_SEED = 20260101


def make_steps(module, inputs, seed):
    """The stimulus as lines of hexadecimal digits, and the first step that is compared."""
    steps = stimulus.Steps(random.Random(f"{seed} {module}"), inputs)
    {**stimulus.MODULES, **stimulus.PLANTED}[module](steps)
    digits = (sum(inputs.values()) + 3) // 4
    lines = []
    for step in steps.steps:
        word = 0
        for port, width in inputs.items():
            if step[port] >> width:
                raise SystemExit(f"{module}: stimulus of {port} does not fit")
            word = word << width | step[port]
        lines.append(f"{word:0{digits}x}")
    return lines, steps.compare_from


def synthesise(module, folder):
    known = module in project.rtl_modules()
    files = project.files_of(module) if known else [*project.rtl_files(), module_file(module)]
    commands = yosys.read(files) + [f"synth -flatten -top {module}", "check -assert",
                                    "write_verilog -noattr netlist.v"]
    status, text = yosys.execute(commands, folder, "netlist")
    if status != 0:
        raise SystemExit(text)
    return (folder / "netlist.v").read_text(encoding="utf-8")


def testbench(module, inputs, outputs, count):
    """Verilog for Icarus: plays steps.hex and prints the outputs after each step."""
    bits_in, bits_out = sum(inputs.values()), sum(outputs.values())
    text = ["module bench;",
            f"  reg [{bits_in - 1}:0] steps [0:{count - 1}];",
            f"  reg [{bits_in - 1}:0] step;",
            f"  wire [{bits_out - 1}:0] results;",
            "  integer i;"]
    pins, high = [], bits_in - 1
    for port, width in inputs.items():
        pins.append(f".{port}(step[{high}:{high - width + 1}])")
        high -= width
    high = bits_out - 1
    for port, width in outputs.items():
        pins.append(f".{port}(results[{high}:{high - width + 1}])")
        high -= width
    text += [f"  {module} dut ({', '.join(pins)});",
             "  initial begin",
             '    $readmemh("steps.hex", steps);',
             f"    for (i = 0; i < {count}; i = i + 1) begin",
             "      step = steps[i];",
             "      #1;",
             '      $display("%b", results);',
             "    end",
             "    $finish;",
             "  end",
             "endmodule", ""]
    return "\n".join(text)


def run_netlist(netlist, bench, folder, name):
    (folder / f"{name}.v").write_text(netlist, encoding="utf-8")
    (folder / "bench.v").write_text(bench, encoding="utf-8")
    program = folder / f"{name}.vvp"
    status, text = project.run([project.tool("iverilog"), "-g2005", "-o", program, "-s", "bench",
                                folder / "bench.v", folder / f"{name}.v"])
    if status == 0:
        status, text = project.run([project.tool("vvp"), "-n", program], cwd=folder)
    if status != 0:
        raise SystemExit(text)
    return re.findall(r"^[01xz]+$", text, re.M)


def run_rtl(program, module, lines):
    status, text = project.run([program, module], input="\n".join(lines) + "\n")
    if status != 0:
        raise SystemExit(text)
    return text.split()


def bit_names(outputs):
    return [f"{port}[{bit}]" if width > 1 else port
            for port, width in outputs.items() for bit in range(width - 1, -1, -1)]


def differences(names, rtl, netlist, first):
    """One line for each output bit that differs, with its first step."""
    found = {}
    for number, (left, right) in enumerate(zip(rtl, netlist)):
        if number < first or left == right:
            continue
        for name, one, other in zip(names, left, right):
            if one != other and name not in found:
                found[name] = f"{name}: RTL {one}, netlist {other} after step {number}"
    return list(found.values())


def still(names, module, rtl):
    """Output bits that never changed, so that nothing was compared."""
    constant = stimulus.CONSTANT.get(module, [])
    columns = zip(names, zip(*rtl))
    return [f"{name}: always {column[0]}, the stimulus is too weak" for name, column in columns
            if len(set(column)) == 1 and name not in constant]


def inverted(netlist, count, rng):
    """The netlist with one gate inverted, `count` times another one."""
    gates = list(re.finditer(r"^  assign ([^=]+) = ([^;]*[&|^~?][^;]*);$", netlist, re.M))
    for gate in rng.sample(gates, min(count, len(gates))):
        yield (f"{gate.group(1)} = {gate.group(2)}",
               f"{netlist[:gate.start(2)]}~({gate.group(2)}){netlist[gate.end(2):]}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("module")
    parser.add_argument("--seed", type=int, default=DEFAULT_SEED)
    parser.add_argument("--expect-difference", action="store_true")
    parser.add_argument("--invert-gates", type=int, default=0)
    arguments = parser.parse_args()
    module, folder = arguments.module, arguments.folder
    for name in ("yosys", "iverilog", "vvp"):
        project.tool(name)

    status, text = project.run([arguments.program, "--sources"])
    if status != 0 or text.strip() != sources_digest():
        raise SystemExit("the RTL has changed since the models were built: build first")

    ports = sv_widths.module_ports(module_file(module),
                                   sv_widths.read_packages(project.rtl_packages()))
    inputs = {name: width for name, (way, width) in ports.items() if way == "input"}
    outputs = {name: width for name, (way, width) in ports.items() if way == "output"}
    names = bit_names(outputs)
    lines, first = make_steps(module, inputs, arguments.seed)
    print(f"seed {arguments.seed}, {len(lines)} steps, compared from {first}, "
          f"{len(names)} output bits")
    netlist = synthesise(module, folder)
    (folder / "steps.hex").write_text("\n".join(lines) + "\n", encoding="utf-8")
    bench = testbench(module, inputs, outputs, len(lines))
    rtl = run_rtl(arguments.program, module, lines)

    def compare(text, name):
        gates = run_netlist(text, bench, folder, name)
        if len(rtl) != len(lines) or len(gates) != len(lines):
            raise SystemExit(f"{len(lines)} steps, RTL {len(rtl)}, netlist {len(gates)} results")
        return differences(names, rtl, gates, first)

    findings = still(names, module, rtl[first:]) + compare(netlist, "intact")
    if arguments.expect_difference:
        print("\n".join(findings))
        project.finish([] if findings else ["no difference: Yosys builds this right now"],
                       f"{len(findings)} output bits reported")
    reported = []
    for gate, text in inverted(netlist, arguments.invert_gates,
                               random.Random(f"{arguments.seed} gates")):
        found = compare(text, "broken")
        reported.append(bool(found))
        print(f"inverted {gate}: {found[0] if found else 'not reported'}")
    if len(reported) != arguments.invert_gates:
        findings.append(f"only {len(reported)} gates found in the netlist")
    if sum(reported) < 0.9 * len(reported):
        findings.append(f"only {sum(reported)} of {len(reported)} inverted gates were reported")
    project.finish(findings, f"{module}: netlist and RTL agree" if not reported else
                   f"{module}: {sum(reported)} of {len(reported)} inverted gates reported")


main()
