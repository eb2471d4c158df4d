#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the Verilated models of a design with faults (mutate.py): FOLDER/MODEL/Vmeasured_MODEL__ALL.a.

  mutant_model.py FOLDER DESIGN [--count N] [--seed S]   DESIGN is one of those in masters.toml, `measured`
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import measured  # noqa: E402
import project  # noqa: E402


def main():
    folder, name = Path(sys.argv[1]).resolve(), sys.argv[2]
    design = project.design(name)
    status, text = project.run([sys.executable, "-B", HERE / "mutate.py", folder / "rtl", "--design", name, *sys.argv[3:]])
    print(text.strip())
    if status != 0:
        raise SystemExit(status)
    files = [folder / "rtl" / path.name for path in project.listed(design.master.list)]
    for model in design.models.values():
        # A fault makes a signal idle, a constant wider than what it replaces, or an enum 0 or 1.
        measured.verilate(design, model, folder, files, [
            "-Wno-fatal", "-Wno-lint", "-Wno-style", "-Wno-ENUMVALUE", "-CFLAGS", f"-include {HERE / 'mutant.h'}"])
        measured.compile_model(model, folder)


main()
