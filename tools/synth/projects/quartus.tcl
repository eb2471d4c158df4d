# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# A Quartus project of a release: RTL, parameters, constraints; compilation with pins where the tool likes them.
# Checked by reading and with stand-ins for Quartus' commands; not run in Quartus.
#
#   quartus_sh -t quartus.tcl openmb4-VERSION.tar.gz TOP PRESET FAMILY DEVICE FOLDER
#
# TOP and PRESET: mb4_core, mb4_axil or mb4_wb, and full, drive, single or reader; or another top with its parameters in
# the place of PRESET: biss_axi, biss_spi, biss_clb, biss_pru, dsl_axil, and default, or for example
# BISS_CHANNEL_WIDTH=4,EXTRAS=1. FAMILY and DEVICE: for example "Cyclone V" 5CEBA4F23C7. FOLDER takes the
# unpacked release and the project.

if {[llength $argv] != 6} {
  error "usage: quartus.tcl ARCHIVE TOP PRESET FAMILY DEVICE FOLDER"
}
lassign $argv archive top preset family device folder
source [file join [file dirname [file normalize [info script]]] release.tcl]

openmb4::check $top $preset
set release [openmb4::unpack $archive $folder]
load_package flow
project_new -overwrite [file join $folder openmb4]
set_global_assignment -name FAMILY $family
set_global_assignment -name DEVICE $device
set_global_assignment -name TOP_LEVEL_ENTITY $top
set_global_assignment -name SEARCH_PATH [file join $release rtl common]
foreach file [openmb4::rtl $release $top] {
  set_global_assignment -name SYSTEMVERILOG_FILE $file
}
foreach {name value} [openmb4::parameters $release $top $preset] {
  set_parameter -name $name $value
}
set_global_assignment -name SDC_FILE [openmb4::constraints $release $top $preset _quartus.sdc]
execute_flow -compile
project_close
