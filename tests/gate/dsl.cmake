# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests of dsl_axil on the netlist of dsl_bus. gate_dsl.cpp defines make_dsl_rtl().

mb4_other_model(gate_dsl_rtl_test gate_dsl.cpp dsl_rtl_test MODELS ${gate_models} FOLDERS ${gate_folders}
  LIBS mb4::dsl_regs mb4::dsl_page_regs)
add_dependencies(gate_dsl_rtl_test mb4_gate_models_dsl)

# DslRtl compares two ways to run the RTL. The share: what takes some seconds.
mb4_gate_test(ShareOfDslTests gate_dsl_rtl_test DslRuns.CableOf20Metres*)
mb4_gate_test(DslTests gate_dsl_rtl_test -*DslRtl.* CONFIGURATION nightly)
