#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Which room may use which: the directions of includes and of module instances, in one table. No
circles: of includes among rooms, and of imports among Python files.

  check_directions.py              every include of C++ and C, every instance and package of the RTL,
                                   every import of Python
  check_directions.py --self-test  planted faults are reported
"""

import ast
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import sv_widths  # noqa: E402

# The layers of the driver, the lowest first: a header uses its own and lower ones. drivers/README.md
# shows them. Headers in detail/ are for the driver alone.
DRIVER_LAYERS = (
    ("enc/",),
    ("mb4/bus.hpp", "mb4/crc.hpp", "mb4/error.hpp", "mb4/frequency.hpp", "mb4/position.hpp",
     "mb4/result.hpp", "mb4/version.hpp", "mb4_types.h"),
    ("mb4/opcodes.hpp", "mb4/fields.hpp", "mb4/status.hpp", "mb4/parallel_bus.hpp", "mb4/ports/",
     "mb4/words/port.hpp", "mb4/words/memory_bus.hpp", "mb4/detail/spi_frame.hpp", "mb4_cyclic.h"),
    ("mb4/config/", "mb4/config.hpp", "mb4/register_image.hpp", "mb4/slave_address.hpp",
     "mb4/command.hpp", "mb4/detail/control_time.hpp"),
    ("mb4/reading.hpp", "mb4/cyclic.hpp", "mb4/frame.hpp", "mb4/line_delay.hpp", "mb4/safety.hpp",
     "mb4/steps.hpp", "mb4/operation.hpp", "mb4/words/page.hpp", "mb4/words/snapshots.hpp",
     "mb4/detail/time_limit.hpp"),
    ("mb4/detail/chip.hpp", "mb4/detail/chip_state.hpp", "mb4/detail/procedures.hpp"),
    ("mb4/detail/access.hpp", "mb4/detail/actuator.hpp", "mb4/detail/configuration.hpp",
     "mb4/detail/control_checks.hpp", "mb4/detail/initialization.hpp", "mb4/detail/reads.hpp",
     "mb4/detail/single_frame.hpp"),
    ("mb4/detail/blocking.hpp",),
    ("mb4/automatic.hpp", "mb4/control.hpp"),
    ("mb4/device.hpp", "mb4/scan.hpp"),
    ("mb4/mb4.hpp", "mb4.h"),
)
DRIVER_HEADERS = [[f"drivers/include/{name}" for name in layer] for layer in DRIVER_LAYERS]
DRIVER = tuple(name for layer in DRIVER_HEADERS for name in layer if "/detail/" not in name)

# What a master may know of its kind of line: that it is the one, and its pins.
MASTER_CLOCKED = ("sim/lines/clocked/clocked_end", "sim/lines/clocked/clocked_lines")
CLOCKED = ("sim/lines/clocked/", *MASTER_CLOCKED)
LINES = {None: (), "clocked": MASTER_CLOCKED, "duplex": ("sim/lines/duplex/", "sim/lines/duplex/duplex_lines")}

# Rooms of the masters of masters.toml. The iC-MB4 has finer ones below.
MASTERS = project.MASTERS.values()
MASTER_ROOMS = tuple(f"sim/masters/{master.name}/" for master in MASTERS)
OTHER_DRIVERS = tuple(master.driver for master in MASTERS if master.driver and master.name != "mb4")

# Room: the rooms that it may use besides itself. The longest name that a file begins with is its
# room. A name that is no room, "sim/", stands for all rooms that begin with it. Tests may use
# everything.
MAY_USE = {
    "regmap/": (),
    "drivers/c/": (*DRIVER, "regmap/", "drivers/c/mb4_c_access.hpp"),
    # Calls over the Operation of the device, as those of mb4/control.hpp.
    "drivers/c/mb4_c_access.hpp": (*DRIVER, "drivers/include/mb4/detail/", "regmap/"),
    "drivers/arduino/": (*DRIVER, "regmap/"),
    "drivers/zephyr/": (*DRIVER, "regmap/"),
    "drivers/rust/": (*DRIVER, "regmap/"),
    "drivers/include/biss_c.h": (),
    "drivers/include/pm_bissc_include.h": (),
    "drivers/include/biss_pru.h": ("regmap/",),
    "drivers/include/biss_spi.h": ("regmap/",),
    "drivers/c/pm_bissc": ("drivers/include/pm_bissc_include.h", "regmap/"),
    "drivers/include/dsl/": ("drivers/include/enc/", "regmap/"),
    "drivers/include/dsl.h": (),
    "drivers/include/hdsl.h": ("drivers/include/dsl.h", "regmap/"),
    "drivers/c/dsl_c": ("drivers/include/dsl/", "drivers/include/dsl.h", "drivers/include/enc/", "regmap/"),
    "drivers/c/biss_c": ("drivers/include/biss_axi/", "drivers/include/biss_c.h", "regmap/"),
    "sim/core/": (),
    "sim/lines/registers/": ("sim/core/", "sim/lines/"),
    "sim/lines/": ("sim/core/",),
    "sim/lines/clocked/": ("sim/core/", *CLOCKED, "sim/lines/"),
    "sim/lines/clocked/clocked_end": ("sim/core/", "sim/lines/", "sim/lines/clocked/"),
    "sim/lines/clocked/clocked_lines": ("sim/core/", "sim/lines/", "sim/lines/clocked/"),
    "sim/lines/biss/": ("sim/core/", "sim/lines/registers/", "sim/lines/", *CLOCKED),
    "sim/lines/ssi/": ("sim/core/", "sim/lines/registers/", "sim/lines/", *CLOCKED),
    "sim/lines/replay/": ("sim/core/", "sim/lines/registers/", "sim/lines/", *CLOCKED),
    "sim/lines/duplex/": ("sim/core/", "sim/lines/", "sim/lines/duplex/duplex_lines"),
    "sim/lines/duplex/duplex_lines": ("sim/core/", "sim/lines/", "sim/lines/duplex/"),
    "sim/lines/dsl/": ("sim/core/", "sim/lines/", "sim/lines/duplex/", "sim/lines/duplex/duplex_lines"),
    "sim/lines/protocols.cpp": ("sim/lines/", "sim/lines/biss/", "sim/lines/ssi/", "sim/lines/replay/",
                                "sim/lines/dsl/"),
    "sim/hosts/": ("sim/core/",),
    "sim/masters/": ("sim/core/", "sim/hosts/"),
    "sim/masters/mb4/hints/": ("sim/core/", "sim/hosts/", "sim/lines/", "sim/masters/", "sim/masters/mb4/pins",
                               "sim/masters/mb4/ma_frequency", "regmap/"),
    **{f"sim/masters/{master.name}/": ("sim/core/", "sim/hosts/", "sim/lines/", "sim/masters/", "sim/model/", "regmap/",
                                         *LINES[master.line])
       for master in MASTERS},
    # The RTL of a DSL master follows the rules that its model knows.
    "sim/masters/dsl/": ("sim/core/", "sim/hosts/", "sim/lines/", "sim/masters/", "sim/masters/dsl_model/", "sim/model/",
                         *LINES["duplex"]),
    **{master.room: (*master.uses, *(["regmap/"] if master.maps else [])) for master in MASTERS if master.list},
    **{name: ("drivers/include/enc/", "regmap/") for name in OTHER_DRIVERS},
    "sim/masters/mb4/": ("sim/core/", "sim/hosts/", "sim/masters/", "sim/model/", "sim/masters/mb4/model/",
                         "sim/masters/mb4/words/", "sim/masters/mb4/hints/", "sim/masters/mb4/pins", "sim/masters/mb4/ma_frequency",
                         *MASTER_CLOCKED, "regmap/"),
    "sim/masters/mb4/pins": ("sim/hosts/",),
    "sim/masters/mb4/ma_frequency": (),
    "sim/masters/mb4/model/": ("rtl/", "sim/core/", "sim/masters/", "sim/masters/mb4/pins",
                               "sim/masters/mb4/ma_frequency", "sim/model/", *MASTER_CLOCKED),
    "sim/masters/mb4/words/": ("sim/core/", "sim/hosts/", "sim/masters/", "sim/masters/mb4/hints/",
                               "sim/masters/mb4/pins", "sim/masters/mb4/ma_frequency", "sim/model/", *MASTER_CLOCKED),
    "sim/masters/mb4/model/busy_chip.cpp": ("sim/scenario/", "sim/include/"),
    "sim/masters/masters.cpp": ("sim/masters/", *MASTER_ROOMS),
    "sim/model/": ("sim/core/", "sim/include/"),
    "sim/faults/": ("sim/core/", "sim/lines/"),
    "sim/scenario/": ("sim/core/", "sim/lines/", "sim/lines/registers/", "sim/hosts/", "sim/masters/",
                      "sim/faults/"),
    "sim/include/": ("sim/core/", "sim/lines/", "sim/hosts/", "sim/masters/", "sim/faults/",
                     "sim/scenario/"),
    "sim/simulator.cpp": ("sim/core/", "sim/lines/", "sim/hosts/", "sim/masters/", "sim/faults/",
                          "sim/scenario/", "sim/include/"),
    "sim/capi/": ("sim/core/", "sim/include/"),
    "tools/": ("sim/", *DRIVER, "regmap/"),
    # The only place of the commands that names masters: session.hpp is what the others use.
    "tools/mb4sim/masters/": ("tools/", "sim/", *DRIVER, *OTHER_DRIVERS, "regmap/"),
    "tools/mb4sim/workload.cpp": ("tools/", "tools/mb4sim/masters/", "sim/", *DRIVER, "regmap/"),
    # What only the iC-MB4 has.
    **{place: ("tools/", "tools/mb4sim/masters/", "tools/mb4sim/bridge/", "sim/", *DRIVER, "regmap/")
       for place in ("tools/mb4sim/bridge/", "tools/mb4sim/commands/bridge_command.cpp",
                     "tools/mb4sim/commands/spi_command.cpp",
                     "tools/mb4sim/commands/spidev_command.cpp")},
    # Its package has the C binding.
    "tools/python/native/": ("tools/", "tools/mb4sim/masters/", "sim/", *DRIVER, "drivers/c/", "regmap/"),
    "examples/": ("sim/", *DRIVER),
    "examples/clb/": ("sim/", "drivers/include/pm_bissc_include.h"),
    "examples/pru/": ("sim/", "drivers/include/biss_pru.h", "regmap/"),
    "rtl/common/": (),
    "rtl/biss/": ("rtl/common/",),
    "rtl/mb4/mb4_pkg": (),
    "rtl/mb4/host/": ("rtl/common/", "rtl/mb4/mb4_pkg", "regmap/"),
    "rtl/mb4/regs/": ("rtl/common/", "rtl/biss/", "rtl/mb4/mb4_pkg", "regmap/"),
    "rtl/mb4/ctrl/": ("rtl/common/", "rtl/biss/", "rtl/mb4/mb4_pkg", "regmap/"),
    "rtl/mb4/": ("rtl/common/", "rtl/biss/", "regmap/", "rtl/mb4/host/", "rtl/mb4/regs/",
                 "rtl/mb4/ctrl/", "rtl/mb4/mb4_pkg"),
}
for level, layer in enumerate(DRIVER_HEADERS):
    lower = [name for names in DRIVER_HEADERS[:level + 1] for name in names]
    for header in layer:
        MAY_USE[header] = (*lower, "regmap/") if level else ()
# Uses that break the table for the time being. Each of them must still exist.
STILL = {
    ("sim/lines/sensor_keys.hpp", "sim/lines/clocked/slave_timeout.hpp"):
        "read_timeout() is for clocked slaves only",
}
# Folders in which an include in quotes or angle brackets is looked for, after the file's own.
INCLUDE_FOLDERS = ("sim/include/", "drivers/include/",
                   *(f"regmap/generated/{name}/" for master in MASTERS for name in master.maps), "sim/model/",
                   "tools/mb4sim/", "drivers/c/", "")
CPP = (".cpp", ".hpp", ".c", ".h")


def room(name):
    return max((begin for begin in MAY_USE if name.startswith(begin)), key=len, default=None)


def may_use(here, there):
    return there == here or there is not None and any(
        there == other or (other not in MAY_USE and there.startswith(other))
        for other in MAY_USE[here])


def includes(name, text, names):
    """The files of the project that a C++ or C file includes."""
    for line in re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', text, flags=re.M):
        own = name.rpartition("/")[0] + "/"
        for folder in (own, *INCLUDE_FOLDERS):
            parts = []
            for part in (folder + line).split("/"):
                parts = parts[:-1] if part == ".." else parts + [part] * (part not in ("", "."))
            if "/".join(parts) in names:
                yield "/".join(parts)
                break


def used_by_rtl(text, modules):
    """The files of the modules and packages that an RTL file uses."""
    text = sv_widths.without_comments(text)
    packages = set(re.findall(r"(\w+_pkg)::", text)) & modules.keys()
    return {modules[word] for word in project.instances(text, modules) | packages}


def uses(files):
    """(file, file that it uses) of {name: text}."""
    names = set(files)
    modules = {name.rpartition("/")[2][:-3]: name for name in files if name.endswith(".sv")}
    for name, text in files.items():
        if name.endswith(CPP):
            used = includes(name, text, names)
        elif name.startswith("rtl/") and name.endswith(".sv"):
            used = used_by_rtl(text, modules)
        else:
            continue
        for other in used:
            if other != name:
                yield name, other


def findings_of(files, still):
    findings = []
    needed = set()
    homeless = set()
    for name, other in uses(files):
        here, there = room(name), room(other)
        if here is None:
            if not name.startswith("tests/"):
                homeless.add(name)
            continue
        if not may_use(here, there):
            if (name, other) in still:
                needed.add((name, other))
            else:
                entry = " (`uses` of its entry in masters.toml)" if here.startswith("rtl/") else ""
                findings.append(f"{name} uses {other}: {here} may use "
                                f"{', '.join(MAY_USE[here]) or 'nothing'}{entry}")
    findings += [f"{name}: no room of MAY_USE in {Path(__file__).name}" +
                 ("; RTL of a master needs its `list` in masters.toml" if name.startswith("rtl/") else "")
                 for name in sorted(homeless)]
    findings += [f"{name} uses {other}: no longer so, take it out of STILL in {Path(__file__).name}"
                 for name, other in still if (name, other) not in needed]
    return findings


def imports(name, text, names):
    """The files beside it, and in packages beside it, that a Python file imports, for its types
    too."""
    here = name.rpartition("/")[0]

    def file_of(folder, module):
        path = "/".join(filter(None, (folder, *module.split("."))))
        return next((file for file in (f"{path}.py", f"{path}/__init__.py") if file in names), None)

    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (file_of(here, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            folder = "/".join(here.split("/")[:len(here.split("/")) - max(node.level - 1, 0)])
            for alias in node.names:  # a module of the package, or something inside it
                inner = file_of(folder, f"{node.module}.{alias.name}" if node.module else alias.name)
                yield inner or file_of(folder, node.module or "__init__")


def circle_of(graph):
    """A circle of {node: {node: why}}, the first node again at its end; none: []."""
    done, path = set(), []

    def walk(node):
        if node in path:
            return [*path[path.index(node):], node]
        if node in done:
            return []
        path.append(node)
        found = next(filter(None, (walk(other) for other in sorted(graph.get(node, ())))), [])
        path.pop()
        done.add(node)
        return found

    return next(filter(None, (walk(node) for node in sorted(graph))), [])


def circles(files):
    """A folder without folders is one knot, each file of any other folder and of a header library
    too. So a list of what stands in the folders below, as masters.cpp, is no circle."""
    names = set(files)
    above = {folder.rpartition("/")[0] for folder in {name.rpartition("/")[0] for name in names}}

    def knot(name):
        folder = name.rpartition("/")[0]
        alone = name.endswith(".py") or folder in above or folder.startswith("drivers/include/")
        return name if alone else f"{folder}/"

    graph = {}
    for name, text in files.items():
        if name.endswith(CPP):
            used = includes(name, text, names)
        elif name.endswith(".py"):
            used = filter(None, imports(name, text, names))
        else:
            continue
        for other in used:
            if name.startswith("tests/") == other.startswith("tests/") and knot(name) != knot(other):
                graph.setdefault(knot(name), {}).setdefault(knot(other), f"{name} uses {other}")
    findings = []
    while circle := circle_of(graph):
        steps = list(zip(circle, circle[1:]))
        findings.append("circle: " + "; ".join(graph[here][there] for here, there in steps))
        del graph[steps[-1][0]][steps[-1][1]]
    return findings


def project_files():
    files = {}
    for folder in ("regmap", "drivers", "sim", "tools", "examples", "rtl", "tests"):
        for path in sorted((project.ROOT / folder).rglob("*")):
            if path.suffix in (*CPP, ".sv", ".py"):
                files[str(path.relative_to(project.ROOT))] = path.read_text(encoding="utf-8")
    return files


def self_test():
    files = {
        "sim/include/mb4sim/a.hpp": "", "sim/lines/l.hpp": "", "sim/lines/biss/b.hpp": "",
        "sim/lines/clocked/clocked_end.hpp": "", "sim/lines/clocked/c.hpp": "",
        "tools/mb4sim/t.hpp": "", "drivers/include/mb4/device.hpp": "",
        "drivers/include/mb4/detail/chip.hpp": "", "drivers/include/mb4/result.hpp": "",
        "drivers/include/enc/span.hpp": "", "regmap/generated/mb4/mb4_regs.hpp": "",
        "rtl/biss/biss_frame.sv": "  enc_ram #(.Width(8)) u_a (\n", "rtl/common/enc_ram.sv": "",
        "rtl/mb4/regs/mb4_bank.sv": "", "regmap/generated/mb4/mb4_regs_pkg.sv": "",
    }
    cases = (
        ("sim/capi/a.cpp", '#include "mb4sim/a.hpp"\n', 0),
        ("sim/core/a.cpp", '#include "t.hpp"\n', 1),
        ("sim/core/a.cpp", '#include "mb4/device.hpp"\n', 1),
        ("sim/core/a.cpp", '#include "sim/lines/l.hpp"\n', 1),
        ("sim/lines/a.cpp", '#include "sim/lines/biss/b.hpp"\n', 1),
        ("sim/lines/biss/a.cpp", '#include "sim/lines/l.hpp"\n', 0),
        ("sim/lines/a.cpp", '#include "sim/lines/clocked/c.hpp"\n', 1),
        ("sim/lines/biss/a.cpp", '#include "sim/lines/clocked/c.hpp"\n', 0),
        ("sim/masters/axi/a.cpp", '#include "sim/lines/clocked/c.hpp"\n', 1),
        ("sim/masters/axi/a.cpp", '#include "sim/lines/clocked/clocked_end.hpp"\n', 0),
        ("tools/mb4sim/a.cpp", '#include "sim/lines/biss/b.hpp"\n', 0),
        ("drivers/c/a.cpp", "#include <mb4sim/a.hpp>\n", 1),
        ("drivers/c/a.cpp", "#include <vector>\n", 0),
        ("tools/mb4sim/a.cpp", '#include "mb4sim/a.hpp"\n#include "mb4/device.hpp"\n', 0),
        ("tools/mb4sim/a.cpp", '#include "mb4/detail/chip.hpp"\n', 1),
        ("examples/firmware/a.cpp", '#include "mb4/detail/chip.hpp"\n', 1),
        ("drivers/c/a.cpp", '#include "mb4/detail/chip.hpp"\n#include "mb4/device.hpp"\n', 1),
        ("drivers/include/enc/a.hpp", '#include "mb4/result.hpp"\n#include "enc/span.hpp"\n', 1),
        ("drivers/include/enc/a.hpp", '#include "mb4_regs.hpp"\n', 1),
        ("drivers/include/mb4/opcodes.hpp", '#include "mb4/device.hpp"\n', 1),
        ("drivers/include/mb4/opcodes.hpp", '#include "mb4_regs.hpp"\n#include "mb4/result.hpp"\n', 0),
        ("drivers/include/mb4/ports/a.hpp", '#include "mb4/detail/chip.hpp"\n', 1),
        ("drivers/include/mb4/device.hpp", '#include "mb4/detail/chip.hpp"\n', 0),
        ("drivers/include/mb4/new.hpp", '#include "mb4/result.hpp"\n', 1),
        ("tests/unit/a.cpp", '#include "t.hpp"\n', 0),
        ("rtl/common/mb4_a.sv", "  mb4_bank u_bank (\n", 1),
        ("rtl/biss/mb4_a.sv", "  enc_ram #(\n", 0),
        ("rtl/biss/mb4_a.sv", "  assign a = b == mb4_regs_pkg::ADDR;\n", 1),
        ("rtl/biss/mb4_a.sv", "  // mb4_regs_pkg::ADDR, mb4_bank u_bank (\n", 0),
        ("rtl/mb4/mb4_core.sv", "  mb4_bank u_bank (\n  biss_frame u_frame (\n", 0),
    )
    findings = []
    for name, text, expected in cases:
        found = findings_of({**files, name: text}, {})
        if len(found) != expected:
            findings.append(f"{name}, {text!r}: expected {expected} finding(s), got {found}")
    if len(findings_of(files, {("rtl/biss/biss_frame.sv", "rtl/mb4/regs/mb4_bank.sv"): ""})) != 1:
        findings.append("an exception that is not needed: no finding")
    return findings + circles_self_test()


def circles_self_test():
    cases = (
        # Through a third room, and of two files of a folder that has folders.
        ({"sim/a/a.hpp": '#include "sim/b/b.hpp"\n', "sim/b/b.hpp": '#include "sim/c/c.hpp"\n',
          "sim/c/d.cpp": '#include "sim/a/a.hpp"\n', "sim/c/c.hpp": ""}, 1),
        ({"sim/a.hpp": '#include "sim/b.hpp"\n', "sim/b.hpp": '#include "sim/a.hpp"\n',
          "sim/a/a.hpp": ""}, 1),
        # Inside a room; the list of the rooms below.
        ({"sim/a/a.hpp": '#include "b.hpp"\n', "sim/a/b.hpp": '#include "a.hpp"\n'}, 0),
        ({"sim/a.hpp": "", "sim/a.cpp": '#include "sim/a.hpp"\n#include "sim/b/b.hpp"\n',
          "sim/b/b.hpp": '#include "sim/a.hpp"\n'}, 0),
        # Two circles with an edge in common.
        ({"sim/a/a.hpp": '#include "sim/b/b.hpp"\n', "sim/b/b.hpp": '#include "sim/a/a.hpp"\n'
          '#include "sim/c/c.hpp"\n', "sim/c/c.hpp": '#include "sim/a/a.hpp"\n'}, 2),
        ({"p/a.py": "from . import b\n", "p/b.py": "from .a import A\n"}, 1),
        ({"p/a.py": "from .b import B\n", "p/b.py": "if TYPE_CHECKING:\n    from .a import A\n"}, 1),
        ({"p/a.py": "import b\n", "p/b.py": "def f():\n    import a\n"}, 1),
        ({"p/q/a.py": "from ..b import B\n", "p/b.py": "from .q.a import A\n"}, 1),
        ({"p/__init__.py": "from .a import A\n", "p/a.py": "from .b import B\n", "p/b.py": ""}, 0),
    )
    return [f"{files}: expected {expected} circle(s), got {circles(files)}"
            for files, expected in cases if len(circles(files)) != expected]


def main():
    arguments = project.Arguments(__doc__)
    arguments.add_argument("--self-test", action="store_true", dest="self_test")
    if arguments.parse_args().self_test:
        project.finish(self_test(), "planted faults are reported")
    files = project_files()
    if len(list(uses(files))) < 300:
        project.finish(["fewer uses than there must be: is the tree whole?"], "")
    project.finish(findings_of(files, STILL) + circles(files),
                   "every include and instance follows the directions, and none goes in a circle")


main()
