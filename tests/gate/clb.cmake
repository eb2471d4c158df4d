# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests of biss_clb on its netlist, at the pins and by the C calls. gate_clb.cpp defines make_clb_model().

foreach(room clb_test clb_pins_test)
  mb4_other_model(gate_${room} gate_clb.cpp ${room} MODELS ${gate_models} FOLDERS ${gate_folders} LIBS mb4::clb_regs)
  add_dependencies(gate_${room} mb4_gate_models_clb)
endforeach()

# ClbRest compares two ways to run the RTL. The share: what takes below some seconds.
mb4_gate_test(ShareOfClbPins gate_clb_pins_test *-*RandomAccesses*:*CableOf0To100*:*EdgeOfSl*:*Watchdog0*:ClbJitter.*)
mb4_gate_test(ShareOfClbTests gate_clb_test *ClbAgainst.Register*)
mb4_gate_test(ClbPins gate_clb_pins_test * CONFIGURATION nightly ENV MB4_CLB_ACCESSES=20000 MB4_CLB_JITTER_FRAMES=2420)
mb4_gate_test(ClbTests gate_clb_test -ClbRest.* CONFIGURATION nightly ENV MB4_CLB_ACCESSES=20000)
