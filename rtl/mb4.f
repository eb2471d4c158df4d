// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The only list of RTL files: paths relative to this folder, packages first.
mb4_pkg.sv
../regmap/generated/mb4_regs_pkg.sv
common/mb4_reset_sync.sv
common/mb4_sync_bit.sv
common/mb4_toggle_rx.sv
common/mb4_posted.sv
common/mb4_ram.sv
common/mb4_clk_mux.sv
host/mb4_spi_shift.sv
host/mb4_spi_cmd.sv
host/mb4_spi.sv
regs/mb4_cfg_regs.sv
regs/mb4_instr_reg.sv
regs/mb4_host_read.sv
regs/mb4_ram_clear.sv
regs/mb4_scd_bank.sv
regs/mb4_svalid.sv
regs/mb4_bank_ctrl.sv
regs/mb4_rx_router.sv
regs/mb4_reg_file.sv
ctrl/mb4_freqs_dec.sv
ctrl/mb4_crc_decode.sv
ctrl/mb4_word_list.sv
ctrl/mb4_sequencer.sv
line/mb4_timebase.sv
line/mb4_sl_sampler.sv
line/mb4_crc.sv
line/mb4_rx_word.sv
line/mb4_frame_biss.sv
line/mb4_channel.sv
mb4_core.sv
mb4_chip.sv
