# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Quartus: constraints of mb4_core with the preset full, made by tools/synth/constraints.py from crossings.toml: do not
# edit. Not run in Quartus. The names of clocks and periods in the first lines are yours to change, as are ports if mb4_core
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
set_false_path -from [get_registers {*u_regs|*u_cfg|actnsens_q* *u_regs|*u_cfg|bankcfg_q* *u_regs|*u_cfg|cfgch_q* *u_regs|*u_cfg|ctrl_q* *u_regs|*u_cfg|freq_q* *u_regs|*u_cfg|freqags_q* *u_regs|*u_cfg|mo_busy_q* *u_regs|*u_cfg|regadr_q* *u_regs|*u_cfg|regnum_q* *u_regs|*u_cfg|slaveloc5_q* *u_regs|*u_slave_cfg|*gen_rows*enscd_q*}] -to [get_clocks core]

# configuration (`enscd`, `cfg`)
set_false_path -from [get_registers {*u_regs|*u_cfg|chsel_q*}] -to [get_registers {*u_control|*u_comm|access_q*}]

# MA force bits, CHSEL for them
set_max_delay -from [get_registers {*u_regs|*u_cfg|chsel_q* *u_regs|*u_cfg|iface_q*}] -to [get_registers {*u_control|*u_force|meta_q*}] $core_period
set_false_path -hold -from [get_registers {*u_regs|*u_cfg|chsel_q* *u_regs|*u_cfg|iface_q*}] -to [get_registers {*u_control|*u_force|meta_q*}]

# configuration of the data channels (`mb4_slave_cfg`)
set_false_path -from [get_registers {*u_regs|*u_slave_cfg|*gen_rows*gen_list*u_list|*}] -to [get_clocks core]

# 0xF4 byte, `count`
set_max_delay -from [get_registers {*u_regs|*u_instr|byte_q* *u_regs|*u_instr|count_q*}] -to [get_clocks core] $core_period
set_false_path -hold -from [get_registers {*u_regs|*u_instr|byte_q* *u_regs|*u_instr|count_q*}] -to [get_clocks core]

# `ack`, held 0xF4 bits, status bits
set_max_delay -from [get_registers {*u_control|*u_flags|eot_q* *u_control|*u_flags|fail_q* *u_control|*u_flags|n_agserr_q* *u_control|*u_flags|n_delayerr_q* *u_control|*u_flags|n_regerr_q* *u_control|*u_flags|n_scderr_q* *u_control|*u_flags|ner_low_q* *u_control|*u_flags|regend_q* *u_control|*u_sequencer|held_q* *u_control|*u_sequencer|*u_written|ack_q* *u_control|*u_comm|register_q* *u_control|*u_comm|*gen_biss_b*u_biss_b|index_q* *u_control|*u_comm|*gen_control*u_frame|index_q* *u_control|*u_comm|*u_cdm_timeout|zeros_q*}] -to [get_clocks host] $host_period
set_false_path -hold -from [get_registers {*u_control|*u_flags|eot_q* *u_control|*u_flags|fail_q* *u_control|*u_flags|n_agserr_q* *u_control|*u_flags|n_delayerr_q* *u_control|*u_flags|n_regerr_q* *u_control|*u_flags|n_scderr_q* *u_control|*u_flags|ner_low_q* *u_control|*u_flags|regend_q* *u_control|*u_sequencer|held_q* *u_control|*u_sequencer|*u_written|ack_q* *u_control|*u_comm|register_q* *u_control|*u_comm|*gen_biss_b*u_biss_b|index_q* *u_control|*u_comm|*gen_control*u_frame|index_q* *u_control|*u_comm|*u_cdm_timeout|zeros_q*}] -to [get_clocks host]

# posted bytes (SCDATA, RDATA, SVALID)
set_max_delay -from [get_registers {*u_regs|*u_posted|wr_gray_q* *u_regs|*u_posted|*u_ram|*}] -to [get_clocks core] $core_period
set_false_path -hold -from [get_registers {*u_regs|*u_posted|wr_gray_q* *u_regs|*u_posted|*u_ram|*}] -to [get_clocks core]

# bytes taken (`taken_q` against the host's count) and `mark`, `marked`
set_max_delay -from [get_registers {*u_regs|*u_posted|taken_q* *u_regs|*u_posted|marked_q*}] -to [get_clocks host] $host_period
set_false_path -hold -from [get_registers {*u_regs|*u_posted|taken_q* *u_regs|*u_posted|marked_q*}] -to [get_clocks host]

# bytes taken (`taken_q` against the host's count) and `mark`, `marked`
set_max_delay -from [get_registers {*u_regs|*u_recent|mark_q*}] -to [get_clocks core] $core_period
set_false_path -hold -from [get_registers {*u_regs|*u_recent|mark_q*}] -to [get_clocks core]

# SCDATA, RDATA read data
set_max_delay -from [get_registers {*u_regs|*u_rdata|*gen_no_banks*u_host|* *u_regs|*u_scd|*u_scd_hi|*gen_banks*u_host|* *u_regs|*u_scd|*u_scd_lo|*gen_banks*u_host|*}] -to [get_clocks host] $host_period
set_false_path -hold -from [get_registers {*u_regs|*u_rdata|*gen_no_banks*u_host|* *u_regs|*u_scd|*u_scd_hi|*gen_banks*u_host|* *u_regs|*u_scd|*u_scd_lo|*gen_banks*u_host|*}] -to [get_clocks host]

# `base` of the host's bank
set_max_delay -from [get_registers {*u_regs|*u_bank|base_q*}] -to [get_clocks host] $host_period
set_false_path -hold -from [get_registers {*u_regs|*u_bank|base_q*}] -to [get_clocks host]

# SVALID and CDS of both banks
set_max_delay -from [get_registers {*u_regs|*u_scd|*u_svalid_hi|bank0_q* *u_regs|*u_scd|*u_svalid_hi|bank1_q* *u_regs|*u_scd|*u_svalid_lo|bank0_q* *u_regs|*u_scd|*u_svalid_lo|bank1_q* *u_regs|*u_cds|bank0_q* *u_regs|*u_cds|bank1_q*}] -to [get_clocks host] $host_period
set_false_path -hold -from [get_registers {*u_regs|*u_scd|*u_svalid_hi|bank0_q* *u_regs|*u_scd|*u_svalid_hi|bank1_q* *u_regs|*u_scd|*u_svalid_lo|bank0_q* *u_regs|*u_scd|*u_svalid_lo|bank1_q* *u_regs|*u_cds|bank0_q* *u_regs|*u_cds|bank1_q*}] -to [get_clocks host]

# `base`, `newest` while 0xF4 is written
set_max_delay -from [get_registers {*u_regs|*u_bank|newest_q*}] -to [get_clocks host] $host_period
set_false_path -hold -from [get_registers {*u_regs|*u_bank|newest_q*}] -to [get_clocks host]

# base kept
set_max_delay -from [get_registers {*u_regs|*u_instr|kept_q*}] -to [get_clocks core] $core_period
set_false_path -hold -from [get_registers {*u_regs|*u_instr|kept_q*}] -to [get_clocks core]

# memories cleared
set_max_delay -from [get_registers {*u_regs|*u_clear|done_q*}] -to [get_clocks host] $host_period
set_false_path -hold -from [get_registers {*u_regs|*u_clear|done_q*}] -to [get_clocks host]

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
