# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# The build for the browser, with Debian's emscripten 3.1.6: `emcmake cmake` (tools/web/build.sh).

# The page uses no waveforms, one model of each master, and lines with a clock.
set(MB4_TRACE OFF)
set(MB4_ONE_MODEL ON)
set(MB4_DSL OFF)
set(MB4_PRESETS "")

add_compile_options(-fwasm-exceptions)
add_link_options(-fwasm-exceptions)
add_link_options(-sTOTAL_STACK=8MB)
add_compile_definitions(VL_IGNORE_UNKNOWN_ARCH)  # verilatedos.h knows no VL_CPU_RELAX here

# Programs that run while building, in Debian's node or a newer one.
find_program(MB4_NODE NAMES nodejs node REQUIRED)
set(CMAKE_CROSSCOMPILING_EMULATOR ${MB4_NODE} --no-experimental-fetch)

# Packages of this machine that have headers only, and Verilator, which runs here. Their headers are
# reached by links: /usr/include itself would hide emscripten's.
set(host_headers ${CMAKE_BINARY_DIR}/host-headers)
file(MAKE_DIRECTORY ${host_headers})
foreach(header fast_float/fast_float.h fmt/format.h toml++/toml.h)
  cmake_path(GET header PARENT_PATH package)
  find_path(folder_of_${package} ${header} NO_CMAKE_FIND_ROOT_PATH
    PATHS /usr/include /usr/local/include REQUIRED)
  file(CREATE_LINK ${folder_of_${package}}/${package} ${host_headers}/${package} SYMBOLIC)
endforeach()
set(MB4_TOMLPLUSPLUS_INCLUDE ${host_headers})
add_library(fmt::fmt-header-only INTERFACE IMPORTED)
target_include_directories(fmt::fmt-header-only SYSTEM INTERFACE ${host_headers})
target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY=1)
if(NOT VERILATOR_ROOT)
  find_path(VERILATOR_ROOT verilator-config.cmake NO_CMAKE_FIND_ROOT_PATH
    PATHS /usr/share/verilator /usr/local/share/verilator DOC "Folder of Verilator")
endif()
list(APPEND CMAKE_FIND_ROOT_PATH ${VERILATOR_ROOT})
set(verilator_DIR ${VERILATOR_ROOT})
# find_package(verilator) would compile ten times to find these out.
set(VERILATOR_CFLAGS "")
set(VERILATOR_MT_CFLAGS "")
