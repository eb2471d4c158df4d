// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The iC-MB4. Paths are relative to this folder; packages come first.
-F ../biss/biss.f
mb4_pkg.sv
../../regmap/generated/mb4/mb4_regs_pkg.sv
../../regmap/generated/mb4_page/mb4_page_regs_pkg.sv
host/mb4_spi_shift.sv
host/mb4_spi_cmd.sv
host/mb4_spi.sv
host/mb4_spi2.sv
host/mb4_par_bus.sv
host/mb4_host.sv
host/mb4_bridge.sv
host/mb4_page.sv
regs/mb4_cfg_regs.sv
regs/mb4_crc_code.sv
regs/mb4_crc_decode.sv
regs/mb4_slave_cfg.sv
regs/mb4_instr_reg.sv
regs/mb4_recent.sv
regs/mb4_host_read.sv
regs/mb4_read_port2.sv
regs/mb4_ram_clear.sv
regs/mb4_memory.sv
regs/mb4_svalid.sv
regs/mb4_bank_ctrl.sv
regs/mb4_cds_bank.sv
regs/mb4_scd_store.sv
regs/mb4_reg_file.sv
ctrl/mb4_word_list.sv
ctrl/mb4_frame_request.sv
ctrl/mb4_frame_kind.sv
ctrl/mb4_sequencer.sv
ctrl/mb4_status_flags.sv
ctrl/mb4_cdm_select.sv
ctrl/mb4_reg_watchdog.sv
ctrl/mb4_control_comm.sv
ctrl/mb4_ma_force.sv
ctrl/mb4_control.sv
mb4_lines.sv
mb4_engine.sv
mb4_core.sv
mb4_chip.sv
mb4_bus.sv
mb4_axil.sv
mb4_wb.sv
