# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# model_in_parts(TARGET HEADER MODEL FILE VERILATED SOURCE [BUSY COUNTS] [NAMESPACE NAME] [ARGS ...])
#
# Makes a header of a Verilated model and adds it to a target. SOURCE is the model's main file,
# PREFIX.cpp in Verilator's folder. model_parts.py tells what MODEL, BUSY, NAMESPACE and ARGS are. Each header
# needs a folder of its own. The target has to depend on the model's library.

file(GLOB model_parts_program CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.py)

function(model_in_parts target header)
  cmake_parse_arguments(ARG "" "MODEL;VERILATED;BUSY;NAMESPACE" "ARGS" ${ARGN})
  if(ARG_BUSY)
    list(APPEND ARG_ARGS --busy ${ARG_BUSY})
  endif()
  if(ARG_NAMESPACE)
    list(APPEND ARG_ARGS --namespace ${ARG_NAMESPACE})
  endif()
  cmake_path(GET header PARENT_PATH folder)
  cmake_path(GET ARG_VERILATED PARENT_PATH verilated)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${header}
    COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/model_parts.py
            ${ARG_MODEL} ${verilated} ${header} ${ARG_ARGS}
    DEPENDS ${model_parts_program} ${ARG_MODEL} ${ARG_VERILATED} ${ARG_BUSY}
    COMMENT "A model in parts: ${header}" VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} SYSTEM PRIVATE ${verilated} ${folder}
    ${VERILATOR_ROOT}/include ${VERILATOR_ROOT}/include/vltstd)
endfunction()
