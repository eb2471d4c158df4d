// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The BiSS C master with the memory of TIDEP0022. Paths are relative to this folder; packages come
// first.
-F ../biss/biss.f
pru_pkg.sv
../../regmap/generated/pru/pru_regs_pkg.sv
pru_timebase.sv
pru_average.sv
pru_frame.sv
pru_pace.sv
pru_control.sv
pru_memory.sv
pru_regs.sv
pru_core.sv
biss_pru.sv
