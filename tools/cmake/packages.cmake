# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Debian packages of what install.cmake installs, in BUILD/deb: `cmake --build build --target package`.
#   openmb4              the command, its manual, the documents, the examples
#   libmb4sim0           the simulator as a shared library
#   libmb4sim-dev        its header, and the CMake package
#   openmb4-driver-dev   the driver: headers, C binding
#   openmb4-rtl          the RTL

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/deb)
set(CPACK_PACKAGE_CONTACT "The openmb4 authors <maintainers@openmb4.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL tool library dev driver rtl)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)

set(same "(= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TOOL_PACKAGE_NAME openmb4)
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_TOOL_DESCRIPTION "The command mb4sim with its manual, documents and examples.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libmb4sim${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "The simulated chip and its encoders as a shared library.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libmb4sim-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libmb4sim${PROJECT_VERSION_MAJOR} ${same}, openmb4-driver-dev ${same}")
set(CPACK_COMPONENT_DEV_DESCRIPTION "C interface of the simulator and the CMake package.")
set(CPACK_DEBIAN_DRIVER_PACKAGE_NAME openmb4-driver-dev)
set(CPACK_DEBIAN_DRIVER_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DRIVER_DESCRIPTION "Headers of the driver for firmware and its C binding.")
set(CPACK_DEBIAN_RTL_PACKAGE_NAME openmb4-rtl)
set(CPACK_DEBIAN_RTL_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_RTL_DESCRIPTION "The master in SystemVerilog.")
include(CPack)
