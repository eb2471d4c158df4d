# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# `cmake --install`: command, shared library with its C interface, header-only driver and its C
# binding, RTL, manual page, shell completions, pkg-config files, CMake package openmb4 (targets
# mb4::mb4sim, mb4::driver, mb4::c, mb4::regs). Only for openmb4 as the top project. Everything is
# found relative to where it lies, so that the tree can be moved. The components tool, library, dev,
# driver and rtl are the Debian packages of packages.cmake.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/openmb4)
set(data ${CMAKE_INSTALL_DATADIR}/openmb4)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/openmb4)

target_include_directories(mb4_driver INTERFACE $<INSTALL_INTERFACE:${headers}>)
target_include_directories(mb4_driver_c INTERFACE $<INSTALL_INTERFACE:${headers}>)
set_target_properties(mb4_driver PROPERTIES EXPORT_NAME driver)
set_target_properties(mb4_driver_c PROPERTIES EXPORT_NAME c EXCLUDE_FROM_ALL OFF)
set_target_properties(mb4sim_shared PROPERTIES EXPORT_NAME mb4sim)

install(TARGETS mb4sim_shared EXPORT openmb4
  LIBRARY COMPONENT library NAMELINK_COMPONENT dev
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS mb4_driver mb4_driver_c EXPORT openmb4
  LIBRARY COMPONENT driver ARCHIVE COMPONENT driver
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS mb4sim COMPONENT tool)
# Where `mb4sim spidev` looks for it.
install(TARGETS mb4sim_spidev DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT tool)
install(FILES ${MB4_ROOT}/sim/include/mb4sim.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
install(DIRECTORY ${MB4_ROOT}/drivers/include/ DESTINATION ${headers} COMPONENT driver)

# The licences of what programs and libraries hold besides, from Debian's packages.
foreach(name gcc-12-base libcli11-dev libfmt-dev libtomlplusplus-dev verilator)
  if(EXISTS /usr/share/doc/${name}/copyright)
    install(FILES /usr/share/doc/${name}/copyright
      DESTINATION ${CMAKE_INSTALL_DOCDIR}/licences RENAME ${name} COMPONENT tool)
  endif()
endforeach()

# Each register map: headers, package, manual.
get_property(maps GLOBAL PROPERTY MB4_REGISTER_MAPS)
foreach(map ${maps})
  target_include_directories(${map}_regs INTERFACE $<INSTALL_INTERFACE:${headers}>)
  install(TARGETS ${map}_regs EXPORT openmb4)
  set(folder ${MB4_ROOT}/regmap/generated/${map})
  install(FILES ${folder}/${map}_regs.hpp ${folder}/${map}_regs.h DESTINATION ${headers}
    COMPONENT driver)
  install(FILES ${folder}/${map}_regs_pkg.sv DESTINATION ${data}/regmap/generated/${map}
    COMPONENT rtl)
  install(FILES ${folder}/registers.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/regmap/generated/${map}
    COMPONENT tool)
endforeach()

# The RTL in the folders of the repository, because mb4.f names its files relative to itself.
install(DIRECTORY ${MB4_ROOT}/rtl DESTINATION ${data} COMPONENT rtl
  FILES_MATCHING PATTERN "*.sv" PATTERN "*.svh" PATTERN "*.f" PATTERN "*.vlt")
# The programs of examples/clb compile drivers/c/pm_bissc.c, which is not installed: an application takes it into its own
# build. Those of examples/pru are made of two files each, one of them a port.
install(DIRECTORY ${MB4_ROOT}/examples DESTINATION ${data} COMPONENT tool
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.edges" PATTERN "*.c" PATTERN "*.h" PATTERN "firmware" EXCLUDE
  REGEX "/(clb|pru)/[a-z_]*[.][ch]$" EXCLUDE)
install(DIRECTORY ${MB4_ROOT}/tools/sigrok DESTINATION ${data} COMPONENT tool
  PATTERN __pycache__ EXCLUDE)

# The documents in the folders of the repository, because they refer to each other.
install(FILES ${MB4_ROOT}/LICENSE ${MB4_ROOT}/README.md ${MB4_ROOT}/CHANGELOG.md
              ${MB4_ROOT}/CONTRIBUTING.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool)
install(DIRECTORY ${MB4_ROOT}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool)
foreach(folder sim drivers drivers/arduino drivers/rust/openmb4)
  file(GLOB pages CONFIGURE_DEPENDS ${MB4_ROOT}/${folder}/*.md)
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT tool)
endforeach()

# Manual page and completions are what the command prints.
set(pages ${CMAKE_BINARY_DIR}/pages)
add_custom_command(
  OUTPUT ${pages}/mb4sim.1 ${pages}/mb4sim ${pages}/_mb4sim
  COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}
  COMMAND mb4sim man > ${pages}/mb4sim.1
  COMMAND mb4sim completion bash > ${pages}/mb4sim
  COMMAND mb4sim completion zsh > ${pages}/_mb4sim
  DEPENDS mb4sim VERBATIM)
add_custom_target(mb4sim_pages ALL DEPENDS ${pages}/mb4sim.1)
install(FILES ${pages}/mb4sim.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
install(FILES ${pages}/mb4sim DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT tool)
install(FILES ${pages}/_mb4sim DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
  COMPONENT tool)

file(RELATIVE_PATH prefix_from_pkgconfig
  ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(component dev)
foreach(name mb4sim mb4driver mb4_c)
  configure_file(${MB4_ROOT}/tools/cmake/${name}.pc.in ${CMAKE_BINARY_DIR}/package/${name}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/package/${name}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
  set(component driver)
endforeach()

configure_package_config_file(${MB4_ROOT}/tools/cmake/openmb4Config.cmake.in
  ${CMAKE_BINARY_DIR}/package/openmb4Config.cmake INSTALL_DESTINATION ${package} PATH_VARS data)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/openmb4ConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/openmb4Config.cmake
              ${CMAKE_BINARY_DIR}/package/openmb4ConfigVersion.cmake DESTINATION ${package}
  COMPONENT dev)
install(EXPORT openmb4 NAMESPACE mb4:: DESTINATION ${package} FILE openmb4Targets.cmake
  COMPONENT dev)

include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
