# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Verilated models of a design that coverage or mutants run (masters.toml, `measured`)."""

import project


def verilate(design, model, folder, files, options):
    """Writes the C++ of a model to FOLDER/MODEL."""
    place = folder / model.name
    place.mkdir(parents=True, exist_ok=True)
    hooks = project.ROOT / "sim" / "model" / "verilated_hooks.h"
    status, text = project.run(
        [project.tool("verilator"), "--cc", "-fno-const-bit-op-tree", *project.verilator_flags(), f"-I{project.INCLUDE}",
         "-CFLAGS", f"-std=c++20 -DVL_USER_STOP -include {hooks}", *options,
         *(f"-G{name}={value}" for name, value in model.parameters.items()),
         "--top-module", model.top, "--prefix", f"Vmeasured_{model.name}", "--Mdir", place,
         *([design.public] if design.public else []), *files], cwd=place)
    if status != 0:
        raise SystemExit(text)


def compile_model(model, folder):
    """Makes FOLDER/MODEL/Vmeasured_MODEL__ALL.a of it."""
    status, text = project.run([project.tool("make"), "-j2", "-f", f"Vmeasured_{model.name}.mk", "OPT_FAST=-O3"],
                               cwd=folder / model.name)
    if status != 0:
        raise SystemExit(text)
