# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# A Vivado project of a release: RTL, parameters, constraints; synthesis out of context, reports of timing and size.
# Checked by reading and with stand-ins for Vivado's commands; not run in Vivado.
#
#   vivado -mode batch -source vivado.tcl -tclargs openmb4-VERSION.tar.gz TOP PRESET PART FOLDER
#
# TOP and PRESET: mb4_core, mb4_axil or mb4_wb, and full, drive, single or reader; or another top with its parameters in
# the place of PRESET: biss_axi, biss_spi, biss_clb, biss_pru, dsl_axil, and default, or for example
# BISS_CHANNEL_WIDTH=4,EXTRAS=1. PART: for example xc7a35ticsg324-1L. FOLDER takes the unpacked release and the
# project.

if {[llength $argv] != 5} {
  error "usage: vivado.tcl ARCHIVE TOP PRESET PART FOLDER"
}
lassign $argv archive top preset part folder
source [file join [file dirname [file normalize [info script]]] release.tcl]

openmb4::check $top $preset
set release [openmb4::unpack $archive $folder]
create_project -force openmb4 [file join $folder project] -part $part
add_files -norecurse [openmb4::rtl $release $top]
set_property file_type SystemVerilog [get_files *.sv]
set_property include_dirs [list [file join $release rtl common]] [current_fileset]
set generics {}
foreach {name value} [openmb4::parameters $release $top $preset] {
  lappend generics $name=[expr {$name eq "Features" ? "32'd$value" : $value}]
}
set_property generic $generics [current_fileset]
set_property top $top [current_fileset]
add_files -fileset constrs_1 -norecurse [openmb4::constraints $release $top $preset .xdc]
set_property -name {STEPS.SYNTH_DESIGN.ARGS.MORE OPTIONS} -value {-mode out_of_context} -objects [get_runs synth_1]
launch_runs synth_1
wait_on_run synth_1
open_run synth_1
report_timing_summary -file [file join $folder timing.txt]
report_clock_interaction -file [file join $folder clocks.txt]
report_utilization -file [file join $folder size.txt]
