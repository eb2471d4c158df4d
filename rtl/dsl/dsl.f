// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The DSL master, as far as it goes. Paths are relative to this folder; packages come first.
-F ../common/common.f
dsl_pkg.sv
dsl_program_pkg.sv
dsl_map_pkg.sv
dsl_message_pkg.sv
../../regmap/generated/dsl/dsl_regs_pkg.sv
../../regmap/generated/dsl_page/dsl_page_regs_pkg.sv
dsl_code_tx.sv
dsl_code_rx.sv
dsl_phy.sv
dsl_tx.sv
dsl_sample.sv
dsl_learn.sv
dsl_rx.sv
dsl_receiver.sv
dsl_quality.sv
dsl_judge.sv
dsl_link.sv
dsl_line.sv
dsl_crc16.sv
dsl_vertical.sv
dsl_program.sv
dsl_position.sv
dsl_record.sv
dsl_time.sv
dsl_request.sv
dsl_answer.sv
dsl_stored.sv
dsl_work.sv
dsl_message.sv
dsl_events.sv
dsl_map.sv
dsl_regs.sv
dsl_core.sv
dsl_bridge.sv
dsl_bus.sv
dsl_axil.sv
