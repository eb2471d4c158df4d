# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests of the whole chip on its netlist (gate_chip.cpp defines make_fast_chip()), and those of the presets.

mb4_chip_programs(gate gate_chip.cpp ${gate_models} mb4_gate_models_mb4)

# A share of each program. Two models side by side need the RTL; the random runs are shorter, the netlist
# is twenty to forty times slower. The share leaves out what takes longest.
set(small MB4_RANDOM_CONFIGS=100 MB4_FAULT_FRAMES=2000 MB4_LINE_FRAMES=1210 MB4_HOST_FRAMES=300)
string(JOIN ":" share ChipFrame.* ChipSpi.* ChipRegisters.* ChipStatus.* ChipInit.* ChipReset.*
  ChipGetsens.* ChipNoClock.* ChipBanks.* ChipChain.* MaForce.* Reference.* Command.*
  ControlByHand.* ControlPlug.* MaHz/* Table15/* Table37Fast/*)
mb4_gate_test(ShareOfChipTests gate_chip_test ${share})
mb4_gate_test(ShareOfProtocolTests gate_protocol_test
  ChipMo.*:ProtocolLines.*:ChipSsi.*:ChipBissBAgs.*:Length/MoChains.*-*LongChain*:*EnMoCleared*:*BothKinds*:*ExtendedSsi*)
mb4_gate_test(ShareOfHostTests gate_chip_host_test
  Hosts/ParallelHostChip.*:Spi2.*:ChipPinsPaired.*)
foreach(part RANGE 7)  # two to three processor hours in all
  mb4_gate_test(ChipTests_Part${part} gate_chip_test -*Lockstep* CONFIGURATION nightly
    ENV ${small} GTEST_TOTAL_SHARDS=8 GTEST_SHARD_INDEX=${part})
endforeach()
mb4_gate_test(HostTests gate_chip_host_test -HostFuzz.* CONFIGURATION nightly ENV ${small})
mb4_gate_test(ProtocolTests gate_protocol_test * CONFIGURATION nightly ENV ${small})

# The presets, in the night: the tests of their features and the chip tests that they can run.
foreach(preset drive single reader)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${preset})
  mb4_gate_model(model mb4 mb4 ${folder} ${preset})
  add_custom_target(mb4_gate_model_${preset} DEPENDS ${model})
  foreach(room chip_test features_test)
    set(program gate_${preset}_${room})
    mb4_other_model(${program} gate_preset_chip.cpp ${room} EXCLUDE_FROM_ALL
      MODELS ${model} FOLDERS ${folder} LIBS mb4::page_regs)
    add_dependencies(${program} mb4_gate_model_${preset})
    target_compile_definitions(${program} PRIVATE MB4_GATE_PRESET="${preset}")
    list(APPEND preset_programs ${program})
  endforeach()
  mb4_gate_test(FeaturesOf_${preset} gate_${preset}_features_test *${preset} CONFIGURATION nightly
    ENV MB4_RANDOM_CONFIGS=100)
  mb4_gate_test(ChipTestsOf_${preset} gate_${preset}_chip_test ${mb4_tests_of_${preset}}
    CONFIGURATION nightly ENV MB4_FEATURES=${preset})
  set_tests_properties(Gate.FeaturesOf_${preset} Gate.ChipTestsOf_${preset} PROPERTIES
    FIXTURES_REQUIRED mb4_gate_presets)
endforeach()
add_test(NAME Gate.Presets_AreBuilt CONFIGURATIONS nightly
  COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target ${preset_programs})
set_tests_properties(Gate.Presets_AreBuilt PROPERTIES
  LABELS nightly TIMEOUT 3600 FIXTURES_SETUP mb4_gate_presets)
