# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests of biss_pru on its netlists, one for each clock. gate_pru.cpp defines make_pru_model().

mb4_other_model(gate_pru_test gate_pru.cpp pru_test MODELS ${gate_models} FOLDERS ${gate_folders} LIBS mb4::pru_regs)
add_dependencies(gate_pru_test mb4_gate_models_pru)

# A netlist computes every clock of a frame and of the rest behind it: a tenth of a second. PruRest compares two ways to run
# the RTL. The share: what takes some seconds.
mb4_gate_test(ShareOfPruTests gate_pru_test PruControl.Flag*:PruLine.Frequency*)
mb4_gate_test(PruTests gate_pru_test -*PruRest*:*PruTable10*:PruErrors.* CONFIGURATION nightly ENV MB4_PRU_ACCESSES=10000)
