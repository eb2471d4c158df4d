#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Reads masters.toml, the one list of the masters.

  masters.py                 prints what each check has of each master, one line for each
  masters.py --master NAME   the same of one master
  masters.py --cmake         the commands that tell it to CMake; of the files that entries name it asks for the lists of
                             RTL only, as the Python package has no others
  masters.py --measured DESIGN   programs and tests of a design for coverage and mutants, a line each
  masters.py --file FILE     reads another file; the paths of its entries are looked for beside it

A fault in the file ends the program with one line that names the file, the master and the key.
"""

import argparse
import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FILE = "masters.toml"
BUS_KINDS = {"axi4-lite": ("prefix", "clock", "reset"), "axi4-stream": ("prefix", "clock", "reset"), "wishbone": ("prefix",),
             "spi": (), "clock": (), "reset": (), "interrupt": ()}
LINES = ("clocked", "duplex")


class Fault(Exception):
    """What is wrong with the file, in one line."""


class Entry:
    """A table of the file: reads its keys one by one and refuses those that nobody has read."""

    def __init__(self, where, values):
        self.where, self.values = where, values
        if not isinstance(values, dict):
            raise Fault(f"{where}: is no table")
        self.known = []

    def take(self, key, kind, default=None):
        self.known.append(key)
        if key not in self.values:
            return default
        value = self.values[key]
        names = {str: "a text", bool: "true or false", list: "a list", dict: "a table", int: "a number"}
        if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
            self.wrong(key, f"is not {names[kind]}")
        return value

    def need(self, key, kind):
        value = self.take(key, kind)
        if value is None:
            raise Fault(f"{self.where}: the key '{key}' is missing")
        return value

    def texts(self, key):
        """A list of texts."""
        values = self.take(key, list, [])
        if not all(isinstance(value, str) for value in values):
            self.wrong(key, "is not a list of texts")
        return values

    def table(self, key, kind):
        """{name: value of a kind}"""
        values = self.take(key, dict, {})
        for name, value in values.items():
            if not isinstance(value, kind) or isinstance(value, bool):
                self.wrong(f"{key}.{name}", f"is not {'a number' if kind is int else 'a text'}")
        return values

    def pairs(self, key, first):
        """{name: [first, number]}"""
        values = self.take(key, dict, {})
        second = (int, float) if first is str else int
        for name, value in values.items():
            if not isinstance(value, list) or [isinstance(one, kind) for one, kind in zip(value, (first, second))] != [True] * 2 \
                    or len(value) != 2:
                self.wrong(f"{key}.{name}", f"is not [{'port' if first is str else 'number'}, number]")
        return {name: tuple(value) for name, value in values.items()}

    def tables(self, key):
        """{name: Entry}"""
        return {name: Entry(f"{self.where}: {key}.{name}", values) for name, values in self.take(key, dict, {}).items()}

    def wrong(self, key, what):
        raise Fault(f"{self.where}: {key}: {what}")

    def end(self):
        for key in self.values:
            if key not in self.known:
                raise Fault(f"{self.where}: {key}: no such key; there are {', '.join(self.known)}")


class Bus:
    def __init__(self, entry):
        self.name = entry.need("name", str)
        self.kind = entry.need("kind", str)
        if self.kind not in BUS_KINDS:
            entry.wrong("kind", f"'{self.kind}' is none of {', '.join(BUS_KINDS)}")
        needed = BUS_KINDS[self.kind]
        self.prefix, self.clock, self.reset = (
            entry.need(key, str) if key in needed else None for key in ("prefix", "clock", "reset"))
        self.values = entry.table("values", str)
        entry.end()


class Generics:
    def __init__(self, entry):
        self.limits = entry.pairs("limits", int)
        self.example = entry.table("example", int)
        self.defaults, self.formulas = {}, {}   # of the parameters that follow others
        for name, one in entry.tables("derived").items():
            self.defaults[name] = one.need("default", int)
            self.formulas[name] = one.need("xpath", str)
            one.end()
        entry.end()


class Size:
    def __init__(self, entry):
        self.page, self.note = entry.need("page", str), entry.need("note", str)
        self.lut4, self.mhz = entry.need("lut4", int), entry.need("mhz", int)
        self.median = entry.take("median", int, 0)
        self.seeds = entry.take("seeds", int, 3)
        self.parameters = entry.table("parameters", int)
        self.flags = entry.take("flags", str, "")
        self.up5k = entry.take("up5k", bool, False)
        if self.seeds < 1:
            entry.wrong("seeds", "is less than 1")
        entry.end()


class Top:
    def __init__(self, name, master, entry):
        self.name, self.master = name, master
        self.smaller = entry.texts("smaller")
        self.ice40 = entry.take("ice40", bool, False)
        self.plain = entry.take("plain", bool, False)
        self.clocks = entry.pairs("clocks", str)
        self.parameters = entry.table("parameters", int)
        buses = entry.take("buses", list, [])
        self.buses = [Bus(Entry(f"{entry.where}.buses[{place}]", values)) for place, values in enumerate(buses)]
        size = entry.take("size", dict)
        self.size = Size(Entry(f"{entry.where}.size", size)) if size is not None else None
        generics = entry.take("generics", dict)
        self.generics = Generics(Entry(f"{entry.where}.generics", generics)) if generics is not None else None
        entry.end()

    @property
    def source(self):
        return next(path for path in listed(self.master.list) if path.stem == self.name)


class Gate:
    def __init__(self, name, master, entry):
        self.name, self.master = name, master
        self.top = entry.need("top", str)
        self.parameters = entry.table("parameters", int)
        self.probes = entry.table("probes", str)
        entry.end()


class Model:
    def __init__(self, name, entry):
        self.name = name
        self.top = entry.need("top", str)
        self.parameters = entry.table("parameters", int)
        self.takes = entry.take("takes", str)
        entry.end()


class Measured:
    def __init__(self, name, master, entry):
        self.name, self.master = name, master
        self.maker = master.path(entry, "maker", entry.need("maker", str))
        self.programs = entry.texts("programs")
        self.blocks = entry.texts("blocks")
        self.tests = entry.take("tests", str)
        self.only = entry.texts("only")
        for one in self.only:
            master.path(entry, "only", one)
        self.public = master.path(entry, "public", entry.take("public", str))
        self.goals = entry.table("goals", int)
        for goal in self.goals.keys() - {"line", "branch", "mutants"}:
            entry.wrong(f"goals.{goal}", "is none of line, branch, mutants")
        self.models = {model: Model(model, one) for model, one in entry.tables("models").items()}
        if not self.programs:
            entry.wrong("programs", "names no program")
        if not self.models:
            entry.wrong("models", "there is none")
        if bool(self.blocks) != any(model.takes for model in self.models.values()):
            entry.wrong("blocks", "goes with models that have `takes`")
        entry.end()

    def counts(self, path):
        """The file of the RTL is one of those that count."""
        if not path.is_relative_to(self.master.root / "rtl"):
            return False
        name = path.relative_to(self.master.root).as_posix()
        return not self.only or any(name == one or (one.endswith("/") and name.startswith(one)) for one in self.only)


class Master:
    """An entry; what it does not have is None or empty."""

    def __init__(self, name, entry, root, whole):
        self.name, self.root, self.whole = name, root, whole
        self.what = entry.need("what", str)
        self.line = entry.take("line", str)
        if self.line is not None and self.line not in LINES:
            entry.wrong("line", f"'{self.line}' is none of {', '.join(LINES)}")
        self.list = self.path(entry, "list", entry.take("list", str))
        self.uses = entry.texts("uses")
        self.maps = entry.texts("maps")
        for one in self.maps:
            self.path(entry, "maps", f"regmap/generated/{one}")
        self.driver = entry.take("driver", str)
        if self.driver is not None and (not self.driver.endswith("/") or not (root / self.driver).is_dir()):
            entry.wrong("driver", f"'{self.driver}' is no folder with / at its end")
        self.core = entry.take("core", str)
        self.path(entry, "core", self.core)
        switch = entry.table("switch", str)
        if len(switch) > 1:
            entry.wrong("switch", "has more than one option")
        self.switch, self.switch_text = next(iter(switch.items()), (None, None))
        self.presets = self.path(entry, "presets", entry.take("presets", str))
        self.tops = {top: Top(top, self, one) for top, one in entry.tables("tops").items()}
        self.gates = {design: Gate(design, self, one) for design, one in entry.tables("gates").items()}
        self.measured = {design: Measured(design, self, one) for design, one in entry.tables("measured").items()}
        entry.end()
        self.check_modules(entry)

    def path(self, entry, key, name):
        """The file of a key that names one."""
        if name is not None and (self.whole or key == "list") and not (self.root / name).exists():
            entry.wrong(key, f"'{name}' does not exist")
        return self.root / name if name is not None else None

    def check_modules(self, entry):
        """What needs RTL has it."""
        try:
            modules = {path.stem: path for path in (listed(self.list) if self.list else ())}
        except OSError as error:
            entry.wrong("list", f"{self.list.name} names '{Path(error.filename).name}': {error.strerror}")
        for key in ("uses", "core"):
            if getattr(self, key) and not self.list:
                entry.wrong(key, "the master has no list")
        for top in self.tops:
            if top not in modules:
                entry.wrong(f"tops.{top}", "the list has no such module")
        models = {f"measured.{design.name}.models.{model.name}": model
                  for design in self.measured.values() for model in design.models.values()}
        for name, model in {**{f"gates.{name}": gate for name, gate in self.gates.items()}, **models}.items():
            if model.top not in modules:
                entry.wrong(f"{name}.top", f"the list has no module {model.top}")
        if self.whole:
            for path in modules.values():
                if not path.exists():
                    entry.wrong("list", f"{self.list.name} names '{path.name}', which does not exist")
            for name, top in self.tops.items():
                self.check_top(top, modules[name], lambda key, what, name=name: entry.wrong(f"tops.{name}.{key}", what))
            for name, model in {**{f"gates.{name}": gate for name, gate in self.gates.items()}, **models}.items():
                self.check_parameters(modules[model.top], model.parameters,
                                      lambda key, what, name=name: entry.wrong(f"{name}.parameters.{key}", what))

    @staticmethod
    def check_parameters(path, names, wrong):
        known = widths().parameter_names(path)
        for name in names:
            if name not in known:
                wrong(name, f"{path.name} has no such parameter")

    def check_top(self, top, path, wrong):
        """What a top's keys need of its module, of the register maps and of other files."""
        ports = widths().port_names(path)
        for domain, (port, _) in top.clocks.items():
            if port not in ports:
                wrong(f"clocks.{domain}", f"{path.name} has no port {port}")
        crossings = path.parent / "constraints" / "crossings.toml"
        if top.clocks and not crossings.exists():
            wrong("clocks", f"'{crossings.relative_to(self.root).as_posix()}' does not exist")
        self.check_parameters(path, top.parameters, lambda name, what: wrong(f"parameters.{name}", what))
        if top.size is not None:
            self.check_parameters(path, top.size.parameters, lambda name, what: wrong(f"size.parameters.{name}", what))
            page = f"docs/{top.size.page.partition('#')[0]}"
            if not (self.root / page).exists():
                wrong("size.page", f"'{page}' does not exist")
        if top.buses:
            if not 1 <= len(self.maps) <= 2:
                wrong("buses", f"needs one or two maps, there are {len(self.maps)}")
            for name in self.maps:
                file = f"regmap/generated/{name}/{name}.ipxact.xml"
                if not (self.root / file).exists():
                    wrong("buses", f"'{file}' does not exist")
        if top.generics is not None:
            self.check_generics(top, path, wrong)

    def check_generics(self, top, path, wrong):
        if not top.buses:
            wrong("generics", "needs buses")
        generics = top.generics
        for key, names in (("limits", generics.limits), ("example", generics.example), ("derived", generics.formulas)):
            self.check_parameters(path, names, lambda name, what, key=key: wrong(f"generics.{key}.{name}", what))
        for follower, formula in generics.formulas.items():
            self.check_parameters(path, re.findall(r"\{(\w+)\}", formula), lambda name, what, follower=follower: wrong(
                f"generics.derived.{follower}.xpath", f"{{{name}}}: {what}"))
        for name, (kind, *_) in widths().module_parameters(path).items():
            if kind == "int unsigned" and name not in generics.limits and name not in generics.formulas:
                wrong(f"generics.limits.{name}", "is missing: each int unsigned parameter has limits, or follows others")

    @property
    def room(self):
        """Folder of its RTL with / at the end, or None."""
        return f"{self.list.parent.relative_to(self.root).as_posix()}/" if self.list else None


def widths():
    """The reader of module headers. The Python package, which has no other files than the lists of RTL, has it not."""
    sys.path.insert(0, str(ROOT / "tools" / "synth"))
    import sv_widths
    sys.path.pop(0)
    return sv_widths


def listed(path):
    """The files that a list of RTL names. Its line -F LIST stands for those of another list."""
    files = []
    for line in path.read_text(encoding="utf-8").splitlines():
        line = line.strip()
        if line.startswith("-F "):
            files += listed((path.parent / line[3:].strip()).resolve())
        elif line and not line.startswith("//"):
            files.append((path.parent / line).resolve())
    return files


def read(path=ROOT / FILE, whole=True):
    """{name: Master} in the order of the file. Throws Fault. In a tree that is not whole, such as that of the Python
    package, only the lists of RTL have to be there."""
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise Fault(f"{path.name}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise Fault(f"{path.name}: {error}") from error
    found = {}
    for name, table in values.items():
        where = f"{path.name}: {name}"
        if not re.fullmatch(r"[a-z]\w*(-\w+)*", name):
            raise Fault(f"{where}: a name begins with a small letter, and has letters, digits, '_' and '-'")
        found[name] = Master(name, Entry(where, table), path.resolve().parent, whole)
    for key in ("tops", "gates", "measured"):
        owner = {}
        for master in found.values():
            for one in getattr(master, key):
                if one in owner:
                    raise Fault(f"{path.name}: {master.name}: {key}.{one}: {owner[one]} has one of this name")
                owner[one] = master.name
    return found


def load():
    """The same of this repository, for a script: a fault ends it with one line."""
    try:
        return read()
    except Fault as fault:
        raise SystemExit(str(fault)) from fault


def cmake(masters):
    """Variables for CMake: MB4_MASTERS, and MB4_MASTER_NAME_KEY of each; designs by their own names."""
    def put(name, *values):
        return f'set({name} "{";".join(map(str, values))}")'

    lines = [put("MB4_MASTERS", *masters)]
    for master in masters.values():
        own = f"MB4_MASTER_{master.name}"
        lines += [put(f"{own}_LIST", *([master.list] if master.list else [])),
                  put(f"{own}_SWITCH", *([master.switch] if master.switch else [])),
                  put(f"{own}_SWITCH_TEXT", *([master.switch_text] if master.switch else [])),
                  put(f"{own}_TOPS", *master.tops),
                  put(f"{own}_ICE40", *[name for name, top in master.tops.items() if top.ice40]),
                  put(f"{own}_SIZE", *[name for name, top in master.tops.items() if top.size]),
                  put(f"{own}_GATES", *master.gates), put(f"{own}_MEASURED", *master.measured)]
        # What a model is made from: it is made again when this changes.
        for gate in master.gates.values():
            lines.append(put(f"MB4_GATE_{gate.name}_SAYS", gate.top, gate.parameters, gate.probes))
        for design in master.measured.values():
            models = [(model.name, model.top, model.parameters) for model in design.models.values()]
            lines += [put(f"MB4_MEASURED_{design.name}_SAYS", models, design.only)]
            lines += [put(f"MB4_MEASURED_{design.name}_MASTER", master.name),
                      put(f"MB4_MEASURED_{design.name}_PROGRAMS", *design.programs),
                      put(f"MB4_MEASURED_{design.name}_BLOCKS", *design.blocks),
                      put(f"MB4_MEASURED_{design.name}_TAKES",
                          *[f"{model.name}={model.takes}" for model in design.models.values() if model.takes]),
                      put(f"MB4_MEASURED_{design.name}_MAKER", design.maker),
                      put(f"MB4_MEASURED_{design.name}_PUBLIC", *([design.public] if design.public else [])),
                      put(f"MB4_MEASURED_{design.name}_MODELS", *design.models)]
    return "\n".join(lines) + "\n"


def checks(master):
    """(check, what it has of the master) for each check, in a fixed order."""
    tops = master.tops.values()
    return [
        ("build", f"sim/masters/{master.name}/CMakeLists.txt, switch {master.switch or 'none'}"),
        ("directions", " ".join([f"sim/masters/{master.name}/", *filter(None, [master.room, master.driver])])),
        ("lint", " ".join(master.tops)),
        ("netlist", master.list.relative_to(master.root) if master.list else ""),
        ("netlist ice40", " ".join(top.name for top in tops if top.ice40)),
        ("size and speed", " ".join(top.name for top in tops if top.size)),
        ("formal", master.room or ""),
        ("gates", " ".join(master.gates)),
        ("mutants", " ".join(master.measured)),
        ("coverage", " ".join(master.measured)),
        ("constraints", " ".join(top.name for top in tops if top.clocks)),
        ("plain Verilog", " ".join(top.name for top in tops if top.plain)),
        ("VHDL", " ".join(top.name for top in tops if top.plain or top.generics)),
        ("IP-XACT", " ".join(top.name for top in tops if top.buses)),
        ("Vivado", " ".join(top.name for top in tops if top.generics)),
        ("core file, set_version", master.core or ""),
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--master", metavar="NAME")
    parser.add_argument("--cmake", action="store_true")
    parser.add_argument("--measured", metavar="DESIGN")
    parser.add_argument("--file", type=Path, default=ROOT / FILE)
    options = parser.parse_args()
    try:
        masters = read(options.file, whole=not options.cmake)
        if options.master is not None and options.master not in masters:
            raise Fault(f"{options.file.name}: no master '{options.master}'; there are {', '.join(masters)}")
    except Fault as fault:
        print(fault, file=sys.stderr)
        return 1
    if options.measured:
        design = {name: one for master in masters.values() for name, one in master.measured.items()}.get(options.measured)
        if design is None:
            print(f"{options.file.name}: no design '{options.measured}' in `measured` of a master", file=sys.stderr)
            return 1
        print(" ".join(design.programs + design.blocks), design.tests or "-", sep="\n")
        return 0
    if options.cmake:
        print(cmake(masters), end="")
        return 0
    for master in masters.values():
        if options.master in (None, master.name):
            for check, what in checks(master):
                print(f"{master.name}: {check}: {what or '-'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
