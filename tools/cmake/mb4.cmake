# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Helpers used by every room: its models and tests get Verilator's flags, warnings and sanitizers
# here. Only tests/canary calls verilate() itself.

get_filename_component(MB4_ROOT "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)

# The masters (masters.toml): MB4_MASTERS, and of each MB4_MASTER_NAME_LIST and so on (cmake() in tools/masters.py).
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${MB4_ROOT}/masters.toml ${MB4_ROOT}/tools/masters.py)
execute_process(COMMAND ${Python3_EXECUTABLE} -B ${MB4_ROOT}/tools/masters.py --cmake
  RESULT_VARIABLE status OUTPUT_VARIABLE masters ERROR_VARIABLE wrong)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${wrong}")
endif()
cmake_language(EVAL CODE "${masters}")

find_program(MB4_CCACHE ccache)
if(MB4_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # With paths relative to the build tree, what is the same in two trees is compiled once.
  # The sloppiness is what it needs for precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${MB4_ROOT} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${MB4_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

if(MB4_SANITIZE)
  # Sanitizers are meant for what users run. What Verilator writes and the code of tests is the same in the build without
  # them. The time to compile counts here, so -O1, and only line numbers as debug information.
  set(flags -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_options("$<$<NOT:$<BOOL:$<TARGET_PROPERTY:MB4_PLAIN>>>:${flags}>")
  add_link_options(-fsanitize=address,undefined)
endif()

# mb4_warnings(TARGET): the warning set of hand-written code.
function(mb4_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
    $<$<BOOL:${MB4_WERROR}>:-Werror>)
endfunction()

# mb4_add_test(NAME LABELS label... SOURCES file... [LIBS lib...] [ENV "VAR=value"...]
#              [HEADERS header...])
# One GoogleTest program; every TEST becomes a CTest entry of the same name. HEADERS: what most of
# its many files include, read once.
function(mb4_add_test name)
  cmake_parse_arguments(ARG "" "" "LABELS;SOURCES;LIBS;ENV;HEADERS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} GTest::gtest GTest::gtest_main)
  mb4_warnings(${name})
  if(ARG_HEADERS)
    target_precompile_headers(${name} PRIVATE <gtest/gtest.h> ${ARG_HEADERS})
  endif()
  # The libraries take the time at run time, so the tests' own code has -O1. With -O1 the compiler
  # does not see that an optional has been set.
  target_compile_options(${name} PRIVATE -O1 -Wno-maybe-uninitialized)
  # No sanitizers in the tests' own code, but for tests of the driver: most of its code is in headers. They
  # have AddressSanitizer only, as UBSan costs a third of the time to compile.
  if(NOT driver IN_LIST ARG_LABELS)
    set_target_properties(${name} PROPERTIES MB4_PLAIN ON)
  elseif(MB4_SANITIZE)
    target_compile_options(${name} PRIVATE -fno-sanitize=undefined)
  endif()
  include(GoogleTest)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES
    PROPERTIES LABELS "${ARG_LABELS}" ENVIRONMENT "${ARG_ENV}" TIMEOUT 600)
endfunction()

# mb4_rooms_as_units(TARGET [GROUP folder...]): compiles the sources of each folder as one unit, and those of the folders
# in the list together. Names in a folder's anonymous namespaces then have to differ.
function(mb4_rooms_as_units target)
  set(group ${ARGV1})
  set(together ${ARGN})
  list(POP_FRONT together)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(IS_ABSOLUTE source absolute)
    if(folder IN_LIST together)
      set(folder ${group})
    endif()
    if(NOT absolute)
      string(MAKE_C_IDENTIFIER "room_${folder}" name)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# mb4_rtl_sources(OUT [LIST]): the absolute paths that a list of files names, by default
# rtl/mb4/mb4.f. Its line -F LIST stands for the files of another list.
function(mb4_rtl_sources out)
  set(list ${MB4_MASTER_mb4_LIST})
  if(ARGC GREATER 1)
    set(list ${ARGV1})
  endif()
  cmake_path(GET list PARENT_PATH folder)
  file(STRINGS ${list} lines)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  set(files)
  foreach(line IN LISTS lines)
    string(STRIP "${line}" line)
    if(line MATCHES "^-F +(.*)")
      cmake_path(ABSOLUTE_PATH CMAKE_MATCH_1 BASE_DIRECTORY ${folder} NORMALIZE
                 OUTPUT_VARIABLE lower)
      mb4_rtl_sources(lower_files ${lower})
      list(APPEND files ${lower_files})
    elseif(NOT line MATCHES "^//" AND NOT line STREQUAL "")
      cmake_path(ABSOLUTE_PATH line BASE_DIRECTORY ${folder} NORMALIZE)
      list(APPEND files ${line})
    endif()
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# mb4_all_rtl_sources(OUT): those of the lists of all masters, each once.
function(mb4_all_rtl_sources out)
  set(files)
  foreach(master IN LISTS MB4_MASTERS)
    if(MB4_MASTER_${master}_LIST)
      mb4_rtl_sources(more ${MB4_MASTER_${master}_LIST})
      list(APPEND files ${more})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES files)
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# mb4_forget_old_model(LIST): removes a list of Verilator that names a source which has gone, so that
# verilate() runs Verilator now.
function(mb4_forget_old_model list)
  if(NOT EXISTS ${list})
    return()
  endif()
  file(STRINGS ${list} read REGEX "_DEPS ")
  string(REGEX MATCHALL "\"[^\"]+\"" read "${read}")
  foreach(source IN LISTS read)
    string(REPLACE "\"" "" source "${source}")
    if(NOT EXISTS ${source})
      file(REMOVE ${list})
      return()
    endif()
  endforeach()
endfunction()

# mb4_verilate(TARGET TOP module [PREFIX class] [TRACE] [QUICK] [WHOLE_LIST] [LIST file.f]
#              [SOURCES extra...] [ARGS arg...])
# Adds the Verilated model of one RTL module to a library. LIST names the RTL, by default
# rtl/mb4/mb4.f. The model is compiled as one unit, because most of the time goes into Verilator's
# headers. QUICK: with MB4_QUICK, which takes half of the time, for a model whose speed does not count.
# WHOLE_LIST: Verilator reads every file of the list, whose order has an influence on how it sorts
# the model (up to 7 % of its instructions).
#
# -fno-const-bit-op-tree is not an optimisation choice: without it Verilator 5.006 computes wrong
# values for XOR trees with inversions (tests/canary shows it).
function(mb4_verilate target)
  cmake_parse_arguments(ARG "TRACE;QUICK;WHOLE_LIST" "TOP;PREFIX;LIST" "SOURCES;ARGS" ${ARGN})
  if(NOT ARG_PREFIX)
    set(ARG_PREFIX V${ARG_TOP})
  endif()
  # Otherwise Verilator gets packages and top, and finds the other modules in the folders by the names of their files. So it reads
  # and depends on what is in the model, and a build tree that was made before a file was added finds it.
  mb4_rtl_sources(rtl ${ARG_LIST})
  set(folders)
  set(sources)
  foreach(source IN LISTS rtl)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET source STEM name)
    list(APPEND folders ${folder})
    if(ARG_WHOLE_LIST OR name MATCHES "_pkg$" OR name STREQUAL ARG_TOP)
      list(APPEND sources ${source})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES folders)
  set(trace)
  if(ARG_TRACE)
    set(trace TRACE_FST)
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/${ARG_PREFIX}.dir)
  mb4_forget_old_model(${folder}/${ARG_PREFIX}_copy.cmake)
  set(VERILATOR_BIN ${MB4_VERILATOR})
  verilate(${target} ${trace}
    TOP_MODULE ${ARG_TOP} PREFIX ${ARG_PREFIX}
    SOURCES ${MB4_ROOT}/rtl/waivers.vlt ${sources} ${ARG_SOURCES}
    INCLUDE_DIRS ${folders}
    VERILATOR_ARGS -Wall --assert --x-assign unique --x-initial unique -fno-const-bit-op-tree
                   --no-timing ${ARG_ARGS})

  get_target_property(written ${target} SOURCES)
  # Verilator's runtime does little while a model runs; most of a waveform's time is zlib's.
  set(runtime ${written})
  list(FILTER runtime INCLUDE REGEX "/verilated(_[a-z_]+)?[.]cpp$")
  set_source_files_properties(${runtime} PROPERTIES COMPILE_OPTIONS ${MB4_QUICK})
  list(FILTER written INCLUDE REGEX "/${ARG_PREFIX}[.]dir/.*[.]cpp$")
  list(REMOVE_ITEM written ${folder}/${ARG_PREFIX}__lines.cpp)
  set_source_files_properties(${written} PROPERTIES HEADER_FILE_ONLY ON)
  set(unit ${folder}/unit/${ARG_PREFIX}_unit.cpp)
  list(SORT written)
  list(TRANSFORM written REPLACE ".*/(.*)" "#include \"../\\1\"\n")
  list(JOIN written "" text)
  file(CONFIGURE OUTPUT ${unit} CONTENT "${text}" @ONLY)
  target_sources(${target} PRIVATE ${unit})
  if(ARG_QUICK)
    set_source_files_properties(${unit} PROPERTIES COMPILE_OPTIONS ${MB4_QUICK})
  endif()
endfunction()

# mb4_verilated_library(TARGET): an empty static library to which mb4_verilate() adds models.
# Assertion stops and messages go through sim/model/verilated_hooks.{h,cpp}.
function(mb4_verilated_library target)
  add_library(${target} STATIC ${MB4_ROOT}/sim/model/verilated_hooks.cpp)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_definitions(${target} PRIVATE VL_USER_STOP VL_PRINTF=mb4sim_vl_printf)
  set_target_properties(${target} PROPERTIES MB4_PLAIN ON)
  target_compile_options(${target} PRIVATE
    "SHELL:-include ${MB4_ROOT}/sim/model/verilated_hooks.h" -Wno-sign-compare)
  target_include_directories(${target} PUBLIC ${MB4_ROOT}/sim/model)
  # This project does not write Verilator's headers, so their warnings do not count.
  target_include_directories(${target} SYSTEM PUBLIC
    ${VERILATOR_ROOT}/include ${VERILATOR_ROOT}/include/vltstd)
endfunction()

set(MB4_TRACE ON)  # the simulator can write waveform files
foreach(master IN LISTS MB4_MASTERS)
  if(MB4_MASTER_${master}_SWITCH)
    option(${MB4_MASTER_${master}_SWITCH} "${MB4_MASTER_${master}_SWITCH_TEXT}" ON)
  endif()
endforeach()
# mb4_has_master(OUT NAME): 1 if this build has the master, else 0.
function(mb4_has_master out master)
  set(has 1)
  if(MB4_MASTER_${master}_SWITCH AND NOT ${MB4_MASTER_${master}_SWITCH})
    set(has 0)
  endif()
  set(${out} ${has} PARENT_SCOPE)
endfunction()
# mb4_tell_masters(TARGET VISIBILITY): defines MB4SIM_WITH_NAME as 1 or 0 for each master that has a switch, and
# MB4SIM_ONE_MODEL.
function(mb4_tell_masters target visibility)
  foreach(master IN LISTS MB4_MASTERS)
    if(MB4_MASTER_${master}_SWITCH)
      mb4_has_master(has ${master})
      string(MAKE_C_IDENTIFIER "${master}" name)
      string(TOUPPER "${name}" name)
      target_compile_definitions(${target} ${visibility} MB4SIM_WITH_${name}=${has})
    endif()
  endforeach()
  target_compile_definitions(${target} ${visibility} MB4SIM_ONE_MODEL=$<BOOL:${MB4_ONE_MODEL}>)
endfunction()
# mb4_leave_out(): leaves out every master that has a switch.
macro(mb4_leave_out)
  foreach(master IN LISTS MB4_MASTERS)
    if(MB4_MASTER_${master}_SWITCH)
      set(${MB4_MASTER_${master}_SWITCH} OFF)
    endif()
  endforeach()
endmacro()
option(MB4_FIRST "The shortest build: no AXI, no Wishbone, no smaller chips; slow waveforms, and 6 % slower runs" OFF)
# Chips with fewer features that the simulator has beside the full one: drive, single, reader.
set(MB4_PRESETS single CACHE STRING "Smaller chips of the simulator")
option(MB4_ONE_MODEL "One model of each master: the chip without buses of words, biss_axi with one channel and without extras, biss_pru at 200 MHz" OFF)
# For what needs no speed.
set(MB4_QUICK -O1)
if(MB4_FIRST)
  mb4_leave_out()
  set(MB4_PRESETS "")
  set(MB4_QUICK -O0)
endif()
if(EMSCRIPTEN)
  include(${CMAKE_CURRENT_LIST_DIR}/emscripten.cmake)
endif()
# The cache keeps VERILATOR_ROOT of the environment, because CMake may configure again without it.
if(DEFINED ENV{VERILATOR_ROOT})
  set(VERILATOR_ROOT $ENV{VERILATOR_ROOT} CACHE PATH "Folder of Verilator")
endif()
if(VERILATOR_ROOT AND NOT EXISTS ${VERILATOR_ROOT}/verilator-config.cmake)
  include(${CMAKE_CURRENT_LIST_DIR}/verilate.cmake)
else()
  find_package(verilator 5.006 REQUIRED HINTS ${VERILATOR_ROOT})
endif()
# What Verilator writes goes through a script, see there.
set(MB4_VERILATOR ${CMAKE_BINARY_DIR}/verilator)
set(steady ${MB4_ROOT}/tools/cmake/steady_model.py)
file(SHA256 ${steady} steady_hash)  # with another script each model is made anew
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${steady})
file(CONFIGURE OUTPUT ${MB4_VERILATOR} CONTENT
  "#!/bin/sh\nexec \"${Python3_EXECUTABLE}\" -B \"${steady}\" \"${VERILATOR_BIN}\" \"$@\"\n# ${steady_hash}\n" @ONLY)
file(CHMOD ${MB4_VERILATOR} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
