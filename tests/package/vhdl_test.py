#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The VHDL of rtl/axi/vhdl is analysed and elaborated by GHDL, as is the instance in docs/axi.md. The VHDL
of rtl/mb4/vhdl around the plain Verilog of the release: GHDL turns each example into Verilog,
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

BISS_AXI = project.tops("generics")["biss_axi"]
PACKAGE = {"ghdl": "ghdl", "iverilog": "iverilog", "yosys": "yosys"}


def run(command, folder):
    status, text = project.run(command, cwd=folder)
    # The warnings about ports.
    return text if status != 0 or re.search(r"warning:.* port|Resizing", text, re.I) else ""


def instance(top, folder):
    """The example of a top as Verilog, without the empty module that GHDL puts before it."""
    master = plain_verilog.TOPS[top].master.list.parent
    sources = [master / "vhdl" / f"{master.name}_components.vhd", master / "vhdl" / f"{top}_example.vhd"]
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


def entity(component):
    """An entity with an empty architecture, with the generics and ports of the component."""
    text = component.read_text(encoding="utf-8")
    body = re.search(r"  component biss_axi\n(.*?)  end component;", text, re.S).group(1)
    return ("library ieee;\nuse ieee.std_logic_1164.all;\nentity biss_axi is\n" + body +
            "end entity;\narchitecture empty of biss_axi is\nbegin\nend architecture;\n")


def instance_of_the_manual(widths):
    """A design around the instance of docs/axi.md: a signal for each name that it uses."""
    text = (ROOT / "docs/axi.md").read_text(encoding="utf-8")
    instance = re.search(r"```vhdl\n(.*?)```", text, re.S).group(1)
    vectors = vhdl.sv_widths.parameter_vectors(BISS_AXI.source)
    declared = []
    for port, name in re.findall(r"(\w+)(?:\(0\))? => (\w+)\b", instance.split("port map", 1)[1]):
        if name not in ("open",) and not name.isdigit():
            scalar = f"{port}(0) =>" in instance or widths[port] == 1 and port not in vectors
            kind = "std_logic" if scalar else f"std_logic_vector({widths[port] - 1} downto 0)"
            declared.append(f"  signal {name} : {kind};")
    return ("library ieee;\nuse ieee.std_logic_1164.all;\nentity manual is\nend entity;\n"
            "architecture rtl of manual is\n" + "\n".join(declared) + "\nbegin\n" + instance +
            "end architecture;\n")


def axi_findings(folder):
    """GHDL's findings about biss_axi; a wrong port name and a wrong width must be among others."""
    component, example = (BISS_AXI.source.parent / "vhdl" / f"biss_axi_{name}.vhd" for name in ("component", "example"))
    stub = folder / "biss_axi_entity.vhd"
    stub.write_text(entity(component), encoding="utf-8")
    manual = folder / "biss_axi_manual.vhd"
    manual.write_text(instance_of_the_manual(
        {name: width for name, (_, width) in vhdl.generic_ports(BISS_AXI).items()}), encoding="utf-8")

    def ghdl(path, unit):
        for command in (["-a", "--std=08", component, stub, path], ["-e", "--std=08", unit]):
            status, text = project.run([project.tool("ghdl"), *command], cwd=folder)
            if status != 0:
                return text
        return ""

    findings = []
    for path, unit in ((example, "biss_axi_example"), (manual, "manual")):
        said = ghdl(path, unit)
        if said:
            findings.append(f"{unit}: {said}")
        for old, new in (("s_axis_tuser", "s_axis_user"), ("S_AXI_WSTRB ", "S_AXI_WSTRBS "),
                         ("std_logic_vector(7 downto 0)", "std_logic_vector(6 downto 0)")):
            wrong = folder / f"wrong_{unit}.vhd"
            text = path.read_text(encoding="utf-8")
            place = text.rindex(old) if "std_logic" not in old else text.index(old)
            wrong.write_text(text[:place] + new + text[place + len(old):], encoding="utf-8")
            if not ghdl(wrong, unit):
                findings.append(f"{unit}: {old} as {new} is not noticed")
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
    findings = vhdl.stale() + axi_findings(folder)
    for top in plain_verilog.TOPS:
        example = instance(top, folder)
        module = plain_verilog.write(top, folder)
        for tool, text in elaborate(top, [example, module], folder).items():
            if text:
                findings.append(f"{top}, {tool}: {text}")
        # A port with another name must be found, and one of another width.
        for what, new in (("name", "quirk_i"), ("width", "[6:0]")):
            wrong = folder / f"{top}_{what}.v"
            text = module.read_text(encoding="utf-8")
            changed = [re.sub(r"\bquirks_i\b", new, line) if what == "name" else
                       re.sub(r"^(  (?:input|wire) )\[5:0\] (quirks_i;)$", rf"\1{new} \2", line)
                       for line in text.splitlines()]
            if changed == text.splitlines():
                findings.append(f"{top}: no port quirks_i to change")
            wrong.write_text("\n".join(changed) + "\n", encoding="utf-8")
            for tool, said in elaborate(top, [example, wrong], folder).items():
                if not said:
                    findings.append(f"{top}: {tool} does not notice the other {what} of a port")
    project.finish(findings, f"{len(plain_verilog.TOPS)} tops and biss_axi fit, wrong ports are noticed")


if __name__ == "__main__":
    main()
