#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Each master of masters.toml also has what its entry alone cannot give. One with RTL: a block on the sign-off page, a
netlist that is compared with the RTL, measured tests, and the keys that its tops call for. The page asks for the nightly
runs of each measured design and for each proof. One that the simulator has: its lines in the lists of masters. A row says
what a master lacks, and why.

  check_masters.py               the masters, tools/signoff/items.toml, tests/formal/, tests/netlist/stimulus.py
  check_masters.py --self-test   planted faults are reported
"""

import copy
import fnmatch
import re
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools" / "synth"))
sys.path.insert(0, str(ROOT / "tests" / "netlist"))

import project  # noqa: E402
import stimulus  # noqa: E402
import sv_widths  # noqa: E402

ITEMS = "tools/signoff/items.toml"
SIMULATOR, COMMANDS = "sim/masters/masters.cpp", "tools/mb4sim/masters/support.cpp"
PROJECTS = "tools/synth/projects/release.tcl"
# (master, what it lacks): why. A row that is not needed is a finding.
WAIVED: dict[tuple[str, str], str] = {
    ("dsl_model", "simulated"): "the commands of dsl are its own too",
    ("mb4", "size"): "the first parts of docs/resources.md, and Nightly.CoreOnHx8k_ReachesFiftyMegahertz"}


def own_modules(master):
    return [path for path in project.listed(master.list) if (master.root / master.room) in path.parents]


def bus_of(top):
    """A port that only a bus of words has, or None."""
    packages = sv_widths.read_packages(project.rtl_packages())
    ports = sv_widths.module_ports(top.source, packages, {name: 2 for name in sv_widths.module_parameters(top.source)})
    return next((port for port in ports if port.lower().endswith(("awvalid", "_cyc_i"))), None)


def lists():
    """{list of masters that is no masters.toml: its text}"""
    return {name: (ROOT / name).read_text(encoding="utf-8") for name in (SIMULATOR, COMMANDS, PROJECTS)}


def simulated(master, texts):
    """The finding about a master of the simulator that a list of masters does not have, or None."""
    folder = f"sim/masters/{master.name}/"
    if not (ROOT / folder).is_dir():
        return None
    wanted = [(SIMULATOR, f'#include "{folder}'), (COMMANDS, f'#include "masters/{master.name}/')]
    if master.switch:
        guard = f"MB4SIM_WITH_{re.sub('[^A-Za-z0-9]', '_', master.name).upper()}"
        wanted += [(SIMULATOR, guard), (SIMULATOR, f"-D{master.switch}=ON"), (COMMANDS, guard)]
    return next((f"{name} has no {text}" for name, text in wanted if text not in texts[name]), None)


def unasked(items, names):
    """Those of the tests that no item of the sign-off page asks for."""
    asked = [test for item in items for test in item.get("tests", []) + sum(item.get("tests_of", {}).values(), [])]
    return [name for name in names if not any(fnmatch.fnmatchcase(name, test) for test in asked)]


def proof_tests(proofs):
    return [name for proof in proofs for name in (f"Formal.{proof}", f"Nightly.Formal_{proof}")]


def design_tests(design):
    of = "" if design == "chip" else f"_{design}"
    return [f"Nightly.RtlCoverage_IsAboveItsGoals{of}", f"Nightly.Mutants_AreCaught{of}"]


def lacks(master, table, compared, proofs, texts):
    """{what a master lacks: the finding}"""
    rooms = [block.get("room", "") for block in table["block"]]
    own = {path.stem for path in own_modules(master)}
    room = master.room.removeprefix("rtl/").rstrip("/")
    found = {}
    if not any(block == room or block.startswith(f"{room}/") for block in rooms):
        found["block"] = f"{ITEMS} has no [[block]] with room = \"{room}\""
    if not master.gates and not own & set(compared):
        found["netlist"] = f"masters.toml has no gates, and tests/netlist/stimulus.py no module of {master.room}"
    if not master.core:
        found["core"] = "masters.toml has no core: no FuseSoC core file, and set_version does not change it"
    pages = (ROOT / "docs" / "README.md").read_text(encoding="utf-8")
    if not any(link in pages for link in (f"({master.name}.md)", f"generated/{master.name}/registers.md)")):
        found["page"] = f"docs/README.md has no link to {master.name}.md"
    if not master.measured:
        found["measured"] = "masters.toml has no measured: no coverage, no planted faults"
    if not any(top.plain or top.generics for top in master.tops.values()):
        found["release"] = "no top has plain or generics: no VHDL, and nothing for other tools in a release"
    if not any(top.size for top in master.tops.values()):
        found["size"] = "no top has size: no test of its size and speed, no row in docs/resources.md"
    for top in master.tops.values():
        if top.clocks and not re.search(rf"\bvariable rooms {{.*\b{top.name} {room}\b", texts[PROJECTS]):
            found["projects"] = f"{PROJECTS}: rooms has no {top.name} {room}"
        if not top.buses and bus_of(top):
            found["buses"] = f"the top {top.name} has the port {bus_of(top)}, and no key buses: no IP-XACT"
    for what, tests in (("proofs", proof_tests(proof for proof, modules in proofs.items() if modules & own)),
                        ("runs", sum(map(design_tests, master.measured), []))):
        missing = unasked(table["item"], tests)
        if missing:
            found[what] = f"no item of {ITEMS} asks for {', '.join(missing)}"
    return found


def findings(masters, table, compared, proofs, waived, texts):
    """`proofs` is {proof: modules in it}, `texts` is that of lists()."""
    found, needed = [], set()
    for name, master in masters.items():
        missing = lacks(master, table, compared, proofs, texts) if master.list else {}
        if simulated(master, texts):
            missing["simulated"] = simulated(master, texts)
        for what, text in missing.items():
            needed.add((name, what))
            if (name, what) not in waived:
                found.append(f"{name}: {what}: {text}")
    found += [f"{master}: {what}: is there, so its row in tests/lint/check_masters.py goes"
              for master, what in waived if (master, what) not in needed]
    own = {path.stem for master in masters.values() if master.list for path in own_modules(master)}
    shared = unasked(table["item"], proof_tests(proof for proof, modules in proofs.items() if not modules & own))
    return found + [f"no item of {ITEMS} asks for {name}" for name in shared]


def self_test(masters, table, compared, proofs):
    """The planted faults that make no finding."""
    missed = []

    def expect(text, masters=masters, table=table, proofs=proofs, waived=WAIVED, texts=lists()):
        said = findings(masters, table, compared, proofs, waived, texts)
        if not any(text in one for one in said):
            missed.append(f"not reported: {text}: {said}")

    without = copy.deepcopy(table)
    without["block"] = [block for block in table["block"] if block["name"] != "axi"]
    expect("axi: block: ", table=without)
    without = copy.deepcopy(table)
    without["item"] = [item for item in table["item"] if "axi" not in item["block"]]
    expect("axi: runs: no item of tools/signoff/items.toml asks for Nightly.RtlCoverage_IsAboveItsGoals_axi", table=without)
    expect("axi: proofs: no item of tools/signoff/items.toml asks for Formal.none", proofs={**proofs, "none": {"axi_core"}})
    expect("no item of tools/signoff/items.toml asks for Formal.none", proofs={**proofs, "none": {"enc_crc"}})
    bare = copy.deepcopy(masters)
    bare["axi"].gates, bare["axi"].measured, bare["axi"].core = {}, {}, None
    for top in bare["axi"].tops.values():
        top.buses, top.generics, top.plain, top.size = [], None, False, None
    for what in ("netlist", "measured", "buses", "release", "core", "size"):
        expect(f"axi: {what}: ", masters=bare)
    unread = copy.deepcopy(masters)
    unread["axi"].name = "nopage"
    expect("axi: page: docs/README.md has no link to nopage.md", masters=unread)
    for file, text in ((SIMULATOR, '#include "sim/masters/axi/'), (SIMULATOR, "-DMB4_AXI=ON"),
                       (COMMANDS, '#include "masters/axi/'), (COMMANDS, "MB4SIM_WITH_AXI")):
        expect(f"axi: simulated: {file} has no {text}", texts={**lists(), file: lists()[file].replace(text, "x")})
    expect("axi: projects: ", texts={**lists(), PROJECTS: lists()[PROJECTS].replace("biss_spi axi", "")})
    expect("mb4: block: is there", waived={**WAIVED, ("mb4", "block"): "planted"})
    return missed


def main():
    masters = project.MASTERS
    table = tomllib.loads((ROOT / ITEMS).read_text(encoding="utf-8"))
    modules = project.rtl_modules()
    proofs = {path.stem: project.instances(sv_widths.strip_comments(path.read_text(encoding="utf-8")), modules)
              for path in sorted((ROOT / "tests" / "formal").glob("*.sv"))}
    if sys.argv[1:] == ["--self-test"]:
        project.finish(self_test(masters, table, stimulus.MODULES, proofs), "each planted fault is reported")
    for (master, what), why in WAIVED.items():
        print(f"left out: {master}: {what}: {why}")
    project.finish(findings(masters, table, stimulus.MODULES, proofs, WAIVED, lists()),
                   f"{len(masters)} masters, {sum(master.list is not None for master in masters.values())} with RTL, {len(proofs)} proofs, "
                   f"{len(WAIVED)} rows")


if __name__ == "__main__":
    main()
