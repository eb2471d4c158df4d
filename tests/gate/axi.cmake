# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests of biss_axi and biss_spi on their netlists. gate_axi.cpp defines make_axi_model() and make_axi_spi_model().

mb4_other_model(gate_axi_test gate_axi.cpp axi_test MODELS ${gate_models} FOLDERS ${gate_folders} LIBS mb4::axi_regs)
add_dependencies(gate_axi_test mb4_gate_models_axi)

# Left out: what needs biss_axi with 1 or 16 channels, and what compares two ways to run the RTL.
string(JOIN ":" not_with_four_channels *Sixteen* *AlignLatchOf* *AxiAlign*document AxiSteps.*
  AxiExtras.Identity_* AxiEye.Identity_* AxiEye.BehindSpi_* *AxiEyeOfLines*/1*
  Axi.F1EveryRegister_* Axi.ChannelsThatDoNotAnswer_*)
# The share: what takes below some seconds.
string(JOIN ":" axi_share Axi.F* Axi.CrcRegisters_* Axi.NoStartBit* Axi.LineStuckLow* Axi.Debug*
  Axi.Zero* AxiDriver.ReadSingle_* AxiDriver.Switches* AxiDriver.CallsOfTheManual_* AxiDriver.Page_*
  AxiExtras.PageRegisters_* AxiExtras.Timeout* AxiExtras.Counters_* AxiExtras.SampleTime_*
  AxiExtras.Interrupts_* AxiExtras.DelayAlarm_* *AxiAlign* AxiEye.Narrow* AxiEye.Unplugged*
  AxiEye.RegisterAccess_*)
# All of biss_spi.
mb4_gate_test(BissSpiTests gate_axi_test AxiSpi.*)
mb4_gate_test(ShareOfAxiTests gate_axi_test ${axi_share}:-${not_with_four_channels})
mb4_gate_test(AxiTests gate_axi_test -${not_with_four_channels} CONFIGURATION nightly)
