# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Vivado: constraints of mb4_core with the preset full, made by tools/synth/constraints.py from crossings.toml: do not
# edit. Not run in Vivado. The names of clocks and periods in the first lines are yours to change, as are ports if mb4_core
# is not the top of the design. The lines are point to point: with set_clock_groups the tool would ignore the delays.

set core_period 50.0
create_clock -name core -period $core_period [get_ports clk_i]
set host_period 20.0
create_clock -name host -period $host_period [get_ports sclk_i]
set frame_period 160.0
create_clock -name frame -period $frame_period [get_ports cs_ni]

# SPI mode 0. MOSI is stable 7.5 ns before the rising edge of SCLK (I205) and 7.5 ns after it (I206). MISO changes with
# the falling edge and is taken with the next rising one; the host needs host_setup before it.
set host_setup 2.0
set_input_delay -clock host -max [expr {$host_period - 7.5}] [get_ports mosi_i]
set_input_delay -clock host -min 7.5 [get_ports mosi_i]
set_output_delay -clock host -max $host_setup [get_ports miso_o]
set_output_delay -clock host -min 0.0 [get_ports miso_o]

# configuration (`enscd`, `cfg`)
set_false_path -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_cfg/actnsens_q* || NAME =~ *u_regs/u_cfg/bankcfg_q* || NAME =~ *u_regs/u_cfg/cfgch_q* || NAME =~ *u_regs/u_cfg/ctrl_q* || NAME =~ *u_regs/u_cfg/freq_q* || NAME =~ *u_regs/u_cfg/freqags_q* || NAME =~ *u_regs/u_cfg/mo_busy_q* || NAME =~ *u_regs/u_cfg/regadr_q* || NAME =~ *u_regs/u_cfg/regnum_q* || NAME =~ *u_regs/u_cfg/slaveloc5_q* || NAME =~ *u_regs/u_slave_cfg/gen_rows*enscd_q*}] -to [get_clocks core]

# configuration (`enscd`, `cfg`)
set_false_path -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_cfg/chsel_q*}] -to [get_cells -hierarchical -filter {NAME =~ *u_control/u_comm/access_q*}]

# MA force bits, CHSEL for them
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_cfg/chsel_q* || NAME =~ *u_regs/u_cfg/iface_q*}] -to [get_cells -hierarchical -filter {NAME =~ *u_control/u_force/meta_q*}] $core_period

# configuration of the data channels (`mb4_slave_cfg`)
set_false_path -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_slave_cfg/gen_rows*gen_list*u_list/mem*}] -to [get_clocks core]

# 0xF4 byte, `count`
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_instr/byte_q* || NAME =~ *u_regs/u_instr/count_q*}] -to [get_clocks core] $core_period

# `ack`, held 0xF4 bits, status bits
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_control/u_flags/eot_q* || NAME =~ *u_control/u_flags/fail_q* || NAME =~ *u_control/u_flags/n_agserr_q* || NAME =~ *u_control/u_flags/n_delayerr_q* || NAME =~ *u_control/u_flags/n_regerr_q* || NAME =~ *u_control/u_flags/n_scderr_q* || NAME =~ *u_control/u_flags/ner_low_q* || NAME =~ *u_control/u_flags/regend_q* || NAME =~ *u_control/u_sequencer/held_q* || NAME =~ *u_control/u_sequencer/u_written/ack_q* || NAME =~ *u_control/u_comm/register_q* || NAME =~ *u_control/u_comm/gen_biss_b*u_biss_b/index_q* || NAME =~ *u_control/u_comm/gen_control*u_frame/index_q* || NAME =~ *u_control/u_comm/u_cdm_timeout/zeros_q*}] -to [get_clocks host] $host_period

# posted bytes (SCDATA, RDATA, SVALID)
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_posted/wr_gray_q* || NAME =~ *u_regs/u_posted/u_ram/mem*}] -to [get_clocks core] $core_period

# bytes taken (`taken_q` against the host's count) and `mark`, `marked`
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_posted/taken_q* || NAME =~ *u_regs/u_posted/marked_q*}] -to [get_clocks host] $host_period

# bytes taken (`taken_q` against the host's count) and `mark`, `marked`
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_recent/mark_q*}] -to [get_clocks core] $core_period

# SCDATA, RDATA read data
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_rdata/gen_no_banks*u_host/mem* || NAME =~ *u_regs/u_scd/u_scd_hi/gen_banks*u_host/mem* || NAME =~ *u_regs/u_scd/u_scd_lo/gen_banks*u_host/mem*}] -to [get_clocks host] $host_period

# `base` of the host's bank
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_bank/base_q*}] -to [get_clocks host] $host_period

# SVALID and CDS of both banks
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_scd/u_svalid_hi/bank0_q* || NAME =~ *u_regs/u_scd/u_svalid_hi/bank1_q* || NAME =~ *u_regs/u_scd/u_svalid_lo/bank0_q* || NAME =~ *u_regs/u_scd/u_svalid_lo/bank1_q* || NAME =~ *u_regs/u_cds/bank0_q* || NAME =~ *u_regs/u_cds/bank1_q*}] -to [get_clocks host] $host_period

# `base`, `newest` while 0xF4 is written
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_bank/newest_q*}] -to [get_clocks host] $host_period

# base kept
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_instr/kept_q*}] -to [get_clocks core] $core_period

# memories cleared
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_regs/u_clear/done_q*}] -to [get_clocks host] $host_period

# SL1, SL2
set_false_path -from [get_ports {sl1_i sl2_i}] -to [get_clocks core]

# GETSENS
set_false_path -from [get_ports {getsens_i}] -to [get_clocks core]

# SL1, SL2, NER
set_false_path -from [get_ports {sl1_i sl2_i ner_i}] -to [get_clocks host]

# power-on
set_false_path -from [get_ports {por_ni}] -to [get_clocks core]

# NRES
set_false_path -from [get_ports {rst_ni}] -to [get_clocks core]

# NRES
set_false_path -from [get_ports {rst_ni}] -to [get_clocks host]

# NRES
set_false_path -from [get_ports {rst_ni}] -to [get_clocks frame]

# NCS
set_false_path -from [get_clocks frame] -to [get_clocks host]
