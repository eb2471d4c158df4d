// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What any encoder master can use. Paths are relative to this folder.
enc_reset_sync.sv
enc_sync_bit.sv
enc_count_rx.sv
enc_ram.sv
enc_ram_pair.sv
enc_ram_row.sv
enc_posted.sv
enc_clk_mux.sv
enc_crc.sv
enc_time.sv
enc_irq.sv
enc_axil.sv
enc_spi.sv
enc_axis_fifo.sv
enc_wb.sv
