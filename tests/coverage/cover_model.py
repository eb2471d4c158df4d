#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the Verilated models of a design with coverage counters: FOLDER/MODEL/Vmeasured_MODEL__ALL.a, and
FOLDER/write_counts.cpp, which writes what they have counted to the file MB4_COVERAGE after the last test.

  cover_model.py FOLDER DESIGN   DESIGN is one of those in masters.toml, `measured`

All instances of a model count in the same place, so that no master has to add up those of its chips.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import measured  # noqa: E402
import project  # noqa: E402

WRITER = """// Made by tests/coverage/cover_model.py.
{includes}
#include <gtest/gtest.h>
#include <verilated.h>
#include <verilated_cov.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

namespace {{

// A new instance of a model shows the counters of all that have been.
template <typename Model>
void write(std::ofstream& file, const std::string& path) {{
  VerilatedContext context;
  const auto model = std::make_unique<Model>(&context, "mb4");
  model->eval();
  context.coveragep()->write(path.c_str());
  std::ifstream one(path);
  file << one.rdbuf();
}}

class Counts : public testing::Environment {{
  void TearDown() override {{
    const char* path = std::getenv("MB4_COVERAGE");
    if (path == nullptr) return;
    std::ofstream file(path);
{writes}
  }}
}};

[[maybe_unused]] testing::Environment* const counts = testing::AddGlobalTestEnvironment(new Counts);

}}  // namespace
"""


def changed_once(path, pattern, new):
    text, count = re.subn(pattern, new, path.read_text(encoding="utf-8"))
    if count != 1:
        raise SystemExit(f"{path.name}: Verilator writes its counters in another way: {pattern}")
    path.write_text(text, encoding="utf-8")


def share_counters(model, folder):
    """The counters of a class stand in one place, and a new instance does not clear them."""
    prefix = f"Vmeasured_{model.name}"
    changed_once(folder / f"{prefix}__Syms.h", r"(?m)^( *)(std::atomic<uint32_t> __Vcoverage\[\d+\];)$", r"\1static inline \2")
    # Verilator's library clears a counter that is told to it; each class of the model tells its own.
    classes = [path for path in sorted(folder.glob(f"{prefix}_*__Slow.cpp"))
               if "count32p" in path.read_text(encoding="utf-8")]
    if not classes:
        raise SystemExit(f"{folder.name}: Verilator tells no counters")
    for path in classes:
        changed_once(path, r" \*count32p = 0;", " const uint32_t kept = *count32p;")
        changed_once(path, r"(\n *VL_COVER_INSERT\([^;]*;)", r"\1\n    *count32p = kept;")


def main():
    folder, name = Path(sys.argv[1]).resolve(), sys.argv[2]
    design = project.design(name)
    for model in design.models.values():
        measured.verilate(design, model, folder, [project.WAIVERS, *project.listed(design.master.list)],
                          ["-Wno-fatal", "--coverage-line", "--coverage-toggle"])  # a number of masters.toml has no width
        share_counters(model, folder / model.name)
        measured.compile_model(model, folder)
    (folder / "write_counts.cpp").write_text(WRITER.format(
        includes="\n".join(f"#include <Vmeasured_{model}.h>" for model in design.models),
        writes="\n".join(f'    write<Vmeasured_{model}>(file, path + std::string(".one"));' for model in design.models)),
        encoding="utf-8")


main()
