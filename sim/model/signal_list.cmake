# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# mb4_wave_signals(MASTER MODEL...)
#
# Headers MODEL_wave.hpp for mb4sim_objects: the pins of masters/MASTER/MASTER_wave.toml and the registers of these
# Verilated models, for waveforms (signal_list.py). They are in a folder that all masters share.

function(mb4_wave_signals master)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" PINS "")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/waves)
  file(MAKE_DIRECTORY ${folder})
  mb4_rtl_sources(rtl ${MB4_MASTER_${master}_LIST})
  set(program ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/signal_list.py)
  set(pins ${CMAKE_CURRENT_SOURCE_DIR}/masters/${master}/${master}_wave.toml)
  if(DEFINED arg_PINS)
    set(pins ${CMAKE_CURRENT_SOURCE_DIR}/masters/${master}/${arg_PINS})
  endif()
  target_include_directories(mb4sim_objects SYSTEM PRIVATE ${folder})
  foreach(model IN LISTS arg_UNPARSED_ARGUMENTS)
    set(list ${folder}/${model}_wave.hpp)
    add_custom_command(OUTPUT ${list}
      COMMAND ${Python3_EXECUTABLE} -B ${program} ${pins} ${verilated}/${model}.dir/${model}___024root.h ${list} ${rtl}
      DEPENDS ${program} ${pins} ${rtl} ${verilated}/${model}.dir/${model}.cpp
      COMMENT "Signals of ${model} for waveforms" VERBATIM)
    target_sources(mb4sim_objects PRIVATE ${list})
    target_include_directories(mb4sim_objects SYSTEM PRIVATE ${verilated}/${model}.dir)
  endforeach()
endfunction()
