#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the Verilated chip with faults (mutate.py): FOLDER/Vmb4_mutant__ALL.a.

  mutant_model.py FOLDER [--count N] [--seed S]
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402


def main():
    folder = Path(sys.argv[1]).resolve()
    status, text = project.run([sys.executable, "-B", HERE / "mutate.py", folder / "rtl",
                                *sys.argv[2:]])
    print(text.strip())
    if status == 0:
        # A fault makes a signal idle, a constant wider than what it replaces, or an enum 0 or 1.
        status, text = project.run(
            [project.tool("verilator"), "--cc", "--build", "-j", "2", "-fno-const-bit-op-tree",
             *project.verilator_flags(), "-Wno-fatal", "-Wno-lint", "-Wno-style",
             "-Wno-ENUMVALUE",
             f"-I{project.INCLUDE}",
             "-MAKEFLAGS", "OPT_FAST=-O3",
             "-CFLAGS", f"-std=c++20 -DVL_USER_STOP -include {HERE / 'mutant.h'} -include "
             f"{project.ROOT / 'sim' / 'model' / 'verilated_hooks.h'}",
             "--top-module", "mb4_chip", "--prefix", "Vmb4_mutant", "--Mdir", folder,
             project.ROOT / "sim/masters/mb4/model/public.vlt",
             *[folder / "rtl" / path.name for path in project.rtl_files()]], cwd=folder)
    if status != 0:
        raise SystemExit(text)


main()
