#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The VHDL of each top with generics (masters.toml) is analysed and elaborated by GHDL, as is an instance of it in a page
of docs/. The VHDL of each other plain top around the plain Verilog of the release: GHDL turns each example into Verilog,
Icarus and Yosys elaborate it with the module itself in place of GHDL's empty one.

  vhdl_test.py FOLDER    FOLDER is for what the tools leave

Exit status 77: a tool is missing.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import plain_verilog  # noqa: E402
import project  # noqa: E402
import vhdl  # noqa: E402

GENERIC = project.tops("generics")
PLAIN = [top for top in plain_verilog.TOPS if top not in GENERIC]
PACKAGE = {"ghdl": "ghdl", "iverilog": "iverilog", "yosys": "yosys"}


def run(command, folder):
    status, text = project.run(command, cwd=folder)
    # The warnings about ports.
    return text if status != 0 or re.search(r"warning:.* port|Resizing", text, re.I) else ""


def instance(top, folder):
    """The example of a top as Verilog, without the empty module that GHDL puts before it."""
    master = plain_verilog.TOPS[top].master.list.parent
    sources = [master / "vhdl" / f"{master.name}_components.vhd", master / "vhdl" / f"{top}_example.vhd"]
    for path in sources:
        if not path.exists():
            raise SystemExit(f"{path.relative_to(project.ROOT)} is missing; tools/synth/vhdl.py makes it")
    for command in ([project.tool("ghdl"), "-a", "--std=08", *sources],
                    [project.tool("ghdl"), "--synth", "--std=08", "--out=verilog",
                     f"{top}_example"]):
        status, text = project.run(command, cwd=folder)
        if status != 0:
            raise SystemExit(f"{top}: {text}")
    text = text[text.index(f"module {top}\n"):]
    stub, rest = text.split("endmodule\n", 1)
    if f"module {top}_example" not in rest or "assign" in stub:
        raise SystemExit(f"{top}: GHDL's Verilog has another form than this test knows")
    path = folder / f"{top}_example.v"
    path.write_text(rest.split("endmodule\n", 1)[0] + "endmodule\n", encoding="utf-8")
    return path


def elaborate(top, files, folder):
    """What each tool says against it; empty if nothing."""
    files = [str(file) for file in files]
    script = f"read_verilog {' '.join(files)}; hierarchy -check -top {top}_example"
    return {"Icarus": run([project.tool("iverilog"), "-g2005", "-Wall", "-t", "null", "-s",
                           f"{top}_example", *files], folder),
            "Yosys": run([project.tool("yosys"), "-p", script], folder)}


def entity(top, component):
    """An entity with an empty architecture, with the generics and ports of the component."""
    text = component.read_text(encoding="utf-8")
    body = re.search(rf"  component {top.name}\n(.*?)  end component;", text, re.S).group(1)
    return (f"library ieee;\nuse ieee.std_logic_1164.all;\nentity {top.name} is\n" + body +
            f"end entity;\narchitecture empty of {top.name} is\nbegin\nend architecture;\n")


def instances_of_manuals(top):
    """The instances of a top in the pages of docs/."""
    texts = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").glob("*.md"))]
    return [instance for text in texts for instance in re.findall(r"```vhdl\n(.*?)```", text, re.S)
            if re.search(rf"entity work\.{top.name}\b", instance)]


def around(instance, top):
    """A design around an instance: a signal for each name that it uses."""
    widths = {name: width for name, (_, width) in vhdl.generic_ports(top).items()}
    vectors = vhdl.sv_widths.parameter_vectors(top.source)
    declared = []
    for port, name in re.findall(r"(\w+)(?:\(0\))? => (\w+)\b", instance.split("port map", 1)[1]):
        if name not in ("open",) and not name.isdigit():
            scalar = f"{port}(0) =>" in instance or widths[port] == 1 and port not in vectors
            kind = "std_logic" if scalar else f"std_logic_vector({widths[port] - 1} downto 0)"
            declared.append(f"  signal {name} : {kind};")
    return ("library ieee;\nuse ieee.std_logic_1164.all;\nentity manual is\nend entity;\n"
            "architecture rtl of manual is\n" + "\n".join(declared) + "\nbegin\n" + instance +
            "end architecture;\n")


def other_ports(text, fixed):
    """(what, the text with this fault): the last connection with another name, a vector with a bit less. GHDL looks at the
    widths of vectors when it elaborates if they are `fixed`, and at those that follow a generic only in a simulation."""
    port = re.findall(r"^ +(\w+) +=>|(\w+) => ", text, re.M)[-1]
    name = port[0] or port[1]
    place = text.rindex(f"{name} ")
    yield f"another name than {name}", f"{text[:place]}x_{text[place:]}"
    vector = re.search(r"std_logic_vector\((\d+) downto 0\)", text)
    if vector and fixed:
        yield f"a bit less than {vector[0]}", (f"{text[:vector.start()]}std_logic_vector({int(vector[1]) - 1} downto 0)"
                                               f"{text[vector.end():]}")


def generic_findings(top, folder):
    """GHDL's findings about a top with generics; a wrong port name and a wrong width must be among others."""
    component, example = (top.source.parent / "vhdl" / f"{top.name}_{name}.vhd" for name in ("component", "example"))
    stub = folder / f"{top.name}_entity.vhd"
    stub.write_text(entity(top, component), encoding="utf-8")
    units = [(example, f"{top.name}_example")]
    for number, instance in enumerate(instances_of_manuals(top)):
        manual = folder / f"{top.name}_manual{number}.vhd"
        manual.write_text(around(instance, top), encoding="utf-8")
        units.append((manual, "manual"))

    def ghdl(path, unit):
        for command in (["-a", "--std=08", component, stub, path], ["-e", "--std=08", unit]):
            status, text = project.run([project.tool("ghdl"), *command], cwd=folder)
            if status != 0:
                return text
        return ""

    findings = []
    fixed = re.search(r"std_logic_vector\(\d+ downto 0\)", component.read_text(encoding="utf-8")) is not None
    for path, unit in units:
        said = ghdl(path, unit)
        if said:
            findings.append(f"{path.name}: {said}")
        for what, text in other_ports(path.read_text(encoding="utf-8"), fixed):
            wrong = folder / f"wrong_{path.name}"
            wrong.write_text(text, encoding="utf-8")
            if not ghdl(wrong, unit):
                findings.append(f"{path.name}: {what} is not noticed")
    return findings


def wrong_modules(text):
    """(what, plain Verilog with this fault): an input with another name, and one of another width."""
    inputs = re.findall(r"^  input (\[\d+:0\] )?(\w+);$", text, re.M)
    vector, name = next((port for port in inputs if port[0]), inputs[0])
    wider = f"[{int(vector[1:vector.index(':')]) + 1 if vector else 1}:0] "
    yield "name", re.sub(rf"\b{name}\b", f"x_{name}", text)
    yield "width", re.sub(rf"^(  (?:input|wire) ){re.escape(vector)}({name};)$", rf"\g<1>{wider}\2", text, flags=re.M)


def plain_findings(top, folder):
    """What is wrong with the VHDL of a plain top, and with its planted faults."""
    example = instance(top, folder)
    module = plain_verilog.write(top, folder)
    findings = [f"{top}, {tool}: {text}" for tool, text in elaborate(top, [example, module], folder).items() if text]
    # A port with another name must be found, and one of another width.
    good = module.read_text(encoding="utf-8")
    for what, text in wrong_modules(good):
        wrong = folder / f"{top}_{what}.v"
        if text == good:
            findings.append(f"{top}: there is no other {what} to plant")
        wrong.write_text(text, encoding="utf-8")
        findings += [f"{top}: {tool} does not notice the other {what} of a port"
                     for tool, said in elaborate(top, [example, wrong], folder).items() if not said]
    return findings


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    missing = [name for name in PACKAGE if project.shutil.which(name) is None]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (tools/setup.sh test installs it)")
        sys.exit(project.SKIPPED)
    findings = vhdl.stale()
    for top in GENERIC.values():
        findings += generic_findings(top, folder)
    for top in PLAIN:
        findings += plain_findings(top, folder)
    project.finish(findings, f"{', '.join([*PLAIN, *GENERIC])} fit, wrong ports are noticed")


if __name__ == "__main__":
    main()
