#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""make_harness.py OUTPUT MODULE...: the port lists of the Verilated models for rtl_run.cpp."""

import hashlib
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import sv_widths  # noqa: E402


def module_file(module):
    return project.rtl_modules().get(module) or HERE / "rtl" / f"{module}.sv"


def sources_digest():
    """Tells whether a model was built from the sources as they are now."""
    digest = hashlib.sha256()
    for path in [*project.all_rtl_files(), *sorted((HERE / "rtl").glob("*.sv"))]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def main():
    scope = sv_widths.read_packages(project.rtl_packages())
    output, modules = Path(sys.argv[1]), sys.argv[2:]
    text = ["// Made by tests/netlist/make_harness.py.",
            f'const char* const kSources = "{sources_digest()}";']
    text += [f'#include "V{module}.h"' for module in modules]
    for module in modules:
        ports = sv_widths.module_ports(module_file(module), scope)
        inputs = {name: width for name, (way, width) in ports.items() if way == "input"}
        outputs = {name: width for name, (way, width) in ports.items() if way == "output"}
        text += [f"void apply(V{module}& model, BitReader& reader) {{",
                 f"  reader.skip_to_last({sum(inputs.values())});"]
        text += [f"  reader.take(model.{name}, {width});" for name, width in inputs.items()]
        text += ["}", f"void collect(const V{module}& model, BitWriter& writer) {{"]
        text += [f"  writer.put(model.{name}, {width});" for name, width in outputs.items()]
        text += ["}"]
    text += ["int play_module(const std::string& module) {"]
    text += [f'  if (module == "{module}") return play<V{module}>();' for module in modules]
    text += ["  return -1;", "}"]
    output.write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
