// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What stands at each byte of a channel's 512. Synthesis makes a read-only memory of it, so an
// address costs no logic, and one without a register reads the constant 0.
//
// Clock domain: core. row_o is that of address_i from the next edge on.
// Misuse: none.
// Source: regmap/dsl.rdl, regmap/dsl_page.rdl; the record: docs/dsl.md, "Position".

module dsl_map (
  input  logic       clk_i,
  input  logic [8:0] address_i,
  output dsl_map_pkg::row_t row_o
);

  localparam logic [2:0] FAST        = dsl_map_pkg::MAP_FAST;
  localparam logic [2:0] SAFE1       = dsl_map_pkg::MAP_SAFE1;
  localparam logic [2:0] SAFE2       = dsl_map_pkg::MAP_SAFE2;
  localparam logic [2:0] FAST_WORDS  = dsl_map_pkg::WINDOW_FAST;
  localparam logic [2:0] SAFE1_WORDS = dsl_map_pkg::WINDOW_SAFE1;
  localparam logic [2:0] SAFE2_WORDS = dsl_map_pkg::WINDOW_SAFE2;

  // Added to a row.
  localparam logic [15:0] SDK = 16'h1000, HOLD = 16'h0800, OURS = SDK | HOLD;

  // The first byte of a group copies it, later ones come from the copy.
  function automatic logic [15:0] first(input logic [2:0] group, input logic [7:0] place);
    first = {dsl_map_pkg::RECORD, 1'b0, 1'b1, group, place};
  endfunction
  function automatic logic [15:0] later(input logic [2:0] group, input logic [7:0] place);
    later = {dsl_map_pkg::RECORD, 1'b0, 1'b0, group, place};
  endfunction
  function automatic logic [15:0] copies(input logic [2:0] group);
    copies = {dsl_map_pkg::CONSTANT, 1'b0, 1'b1, group, 8'd0};
  endfunction
  function automatic logic [15:0] status(input logic [2:0] group, input logic [7:0] place);
    status = {dsl_map_pkg::STATUS, 1'b0, 1'b0, group, place};
  endfunction
  function automatic logic [15:0] safe1(input logic [7:0] place);
    safe1 = {dsl_map_pkg::SAFE1_STATE, 1'b0, 1'b0, dsl_map_pkg::WINDOW_SAFE1, place};
  endfunction
  function automatic logic [15:0] safe2(input logic [7:0] place);
    safe2 = {dsl_map_pkg::SAFE2_STATE, 1'b0, 1'b0, dsl_map_pkg::WINDOW_SAFE2, place};
  endfunction
  function automatic logic [15:0] toggles(input logic [7:0] place);
    toggles = {dsl_map_pkg::TOGGLES, 1'b0, 1'b0, dsl_map_pkg::NEWEST, place};
  endfunction
  function automatic logic [15:0] register(input logic [5:0] number);
    register = {dsl_map_pkg::REGISTER, 1'b0, 1'b0, 3'd0, 2'd0, number};
  endfunction
  function automatic logic [15:0] constant(input logic [7:0] value);
    constant = {dsl_map_pkg::CONSTANT, 1'b0, 1'b0, 3'd0, value};
  endfunction

  function automatic logic [15:0] stored(input logic [5:0] place, input logic [1:0] who);
    stored = {dsl_map_pkg::STORED, 1'b0, 1'b0, 3'd0, who, place};
  endfunction
  // A write reaches more than the memory.
  function automatic logic [15:0] store(input logic [2:0] what);
    store = {5'd0, what, 8'd0};
  endfunction

  logic [8:0]  address_q;
  logic [15:0] row;

  always_comb begin
    case (address_q)
      // The map.
      9'(dsl_regs_pkg::ADDR_SYS_CTRL):
        row = register(dsl_map_pkg::SYS_CTRL) | store(dsl_map_pkg::STORE_CTRL);
      9'(dsl_regs_pkg::ADDR_SYNC_CTRL):
        row = stored(dsl_message_pkg::SYNC_CTRL, dsl_map_pkg::ALWAYS);
      9'(dsl_regs_pkg::ADDR_MASTER_QM):                    row = register(dsl_map_pkg::MASTER_QM);
      9'(dsl_regs_pkg::ADDR_EVENT_H):
        row = register(dsl_map_pkg::EVENT_H) | store(dsl_map_pkg::STORE_H);
      9'(dsl_regs_pkg::ADDR_EVENT_L):
        row = register(dsl_map_pkg::EVENT_L) | store(dsl_map_pkg::STORE_L);
      9'(dsl_regs_pkg::ADDR_MASK_H):
        row = stored(dsl_message_pkg::MASK_H, dsl_map_pkg::ALWAYS) | store(dsl_map_pkg::STORE_H);
      9'(dsl_regs_pkg::ADDR_MASK_L):
        row = stored(dsl_message_pkg::MASK_L, dsl_map_pkg::ALWAYS) | store(dsl_map_pkg::STORE_L);
      9'(dsl_regs_pkg::ADDR_MASK_SUM):
        row = stored(dsl_message_pkg::MASK_SUM, dsl_map_pkg::ALWAYS)
              | store(dsl_map_pkg::STORE_SUM);
      9'(dsl_regs_pkg::ADDR_EDGES):                        row = register(dsl_map_pkg::EDGES);
      9'(dsl_regs_pkg::ADDR_DELAY):                        row = register(dsl_map_pkg::DELAY);
      9'(dsl_regs_pkg::ADDR_CODE_VERSION): row = register(dsl_map_pkg::CODE_VERSION);
      9'(dsl_regs_pkg::ADDR_RELEASE): row = constant(dsl_regs_pkg::RESET_RELEASE);
      9'(dsl_regs_pkg::ADDR_ENC_ID2):                      row = register(dsl_map_pkg::ENC_ID2);
      9'(dsl_regs_pkg::ADDR_ENC_ID1):                      row = register(dsl_map_pkg::ENC_ID1);
      9'(dsl_regs_pkg::ADDR_ENC_ID0):                      row = register(dsl_map_pkg::ENC_ID0);
      9'(dsl_regs_pkg::ADDR_POS4):                         row = first(FAST, 8'd4);
      9'(dsl_regs_pkg::ADDR_POS3):                         row = later(FAST, 8'd3);
      9'(dsl_regs_pkg::ADDR_POS2):                         row = later(FAST, 8'd2);
      9'(dsl_regs_pkg::ADDR_POS1):                         row = later(FAST, 8'd1);
      9'(dsl_regs_pkg::ADDR_POS0):                         row = later(FAST, 8'd0);
      9'(dsl_regs_pkg::ADDR_VEL2):                         row = later(FAST, 8'd10);
      9'(dsl_regs_pkg::ADDR_VEL1):                         row = later(FAST, 8'd9);
      9'(dsl_regs_pkg::ADDR_VEL0):                         row = later(FAST, 8'd8);
      9'(dsl_regs_pkg::ADDR_SUMMARY):                      row = first(SAFE1, 8'd37);
      9'(dsl_regs_pkg::ADDR_VPOS4):                        row = later(SAFE1, 8'd36);
      9'(dsl_regs_pkg::ADDR_VPOS3):                        row = later(SAFE1, 8'd35);
      9'(dsl_regs_pkg::ADDR_VPOS2):                        row = later(SAFE1, 8'd34);
      9'(dsl_regs_pkg::ADDR_VPOS1):                        row = later(SAFE1, 8'd33);
      9'(dsl_regs_pkg::ADDR_VPOS0):                        row = later(SAFE1, 8'd32);
      9'(dsl_regs_pkg::ADDR_VPOSCRC_H):                    row = later(SAFE1, 8'd39);
      9'(dsl_regs_pkg::ADDR_VPOSCRC_L):                    row = later(SAFE1, 8'd38);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER0):
        row = stored(dsl_message_pkg::BUFFER + 6'd0, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER1):
        row = stored(dsl_message_pkg::BUFFER + 6'd1, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER2):
        row = stored(dsl_message_pkg::BUFFER + 6'd2, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER3):
        row = stored(dsl_message_pkg::BUFFER + 6'd3, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER4):
        row = stored(dsl_message_pkg::BUFFER + 6'd4, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER5):
        row = stored(dsl_message_pkg::BUFFER + 6'd5, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER6):
        row = stored(dsl_message_pkg::BUFFER + 6'd6, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_BUFFER7):
        row = stored(dsl_message_pkg::BUFFER + 6'd7, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_ADD_H): row = stored(dsl_message_pkg::ADD_H, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_ADD_L): row = stored(dsl_message_pkg::ADD_L, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_OFF_H): row = stored(dsl_message_pkg::OFF_H, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_OFF_L): row = stored(dsl_message_pkg::OFF_L, dsl_map_pkg::NO_LONG);
      9'(dsl_regs_pkg::ADDR_PC_CTRL):
        row = register(dsl_map_pkg::PC_CTRL) | store(dsl_map_pkg::STORE_START);
      9'(dsl_regs_pkg::ADDR_PIPE_S): row = register(dsl_map_pkg::PIPE_S) | OURS;
      9'(dsl_regs_pkg::ADDR_PIPE_D): row = register(dsl_map_pkg::PIPE_D);
      9'(dsl_regs_pkg::ADDR_PC_DATA):
        row = stored(dsl_message_pkg::MAIN_DATA, dsl_map_pkg::NO_SHORT)
              | store(dsl_map_pkg::STORE_ALIAS);
      9'(dsl_regs_pkg::ADDR_S_SLAVE_REG_CTRL):
        row = stored(dsl_message_pkg::SAFE_CTRL, dsl_map_pkg::NO_SHORT) | OURS;
      9'(dsl_regs_pkg::ADDR_SAFE_CTRL):
        row = register(dsl_map_pkg::SAFE_CTRL) | SDK | store(dsl_map_pkg::STORE_CTRL);
      9'(dsl_regs_pkg::ADDR_SAFE_SUM): row = later(dsl_map_pkg::NEWEST, 8'd37) | SDK;
      9'(dsl_regs_pkg::ADDR_S_PC_DATA):
        row = stored(dsl_message_pkg::SAFE_DATA, dsl_map_pkg::NO_SHORT);
      9'(dsl_regs_pkg::ADDR_ACC_ERR_CNT):
        row = register(dsl_map_pkg::ACC_ERR_CNT) | store(dsl_map_pkg::STORE_LIMIT);
      9'(dsl_regs_pkg::ADDR_MAXACC):
        row = stored(dsl_message_pkg::MAXACC, dsl_map_pkg::ALWAYS) | OURS;
      9'(dsl_regs_pkg::ADDR_EVENT_S):
        row = register(dsl_map_pkg::EVENT_S) | store(dsl_map_pkg::STORE_S);
      9'(dsl_regs_pkg::ADDR_MASK_S):
        row = stored(dsl_message_pkg::MASK_S, dsl_map_pkg::ALWAYS) | store(dsl_map_pkg::STORE_S);
      9'(dsl_regs_pkg::ADDR_SLAVE_REG_CTRL):
        row = stored(dsl_message_pkg::MAIN_CTRL, dsl_map_pkg::NO_SHORT)
              | store(dsl_map_pkg::STORE_ALIAS);
      9'(dsl_regs_pkg::ADDR_ACC_ERR_CNT_THRESH):
        row = register(dsl_map_pkg::THRESH) | SDK | store(dsl_map_pkg::STORE_LIMIT);
      9'(dsl_regs_pkg::ADDR_MAXDEV_THRESH_H): row = constant(8'hFF) | SDK;
      9'(dsl_regs_pkg::ADDR_MAXDEV_THRESH_L): row = constant(8'hFF) | SDK;
      9'(dsl_regs_pkg::ADDR_VERSION2): row = copies(SAFE2);
      9'(dsl_regs_pkg::ADDR_STATUS2):                      row = later(SAFE2, 8'd45);
      9'(dsl_regs_pkg::ADDR_VPOS2_4):                      row = later(SAFE2, 8'd44);
      9'(dsl_regs_pkg::ADDR_VPOS2_3):                      row = later(SAFE2, 8'd43);
      9'(dsl_regs_pkg::ADDR_VPOS2_2):                      row = later(SAFE2, 8'd42);
      9'(dsl_regs_pkg::ADDR_VPOS2_1):                      row = later(SAFE2, 8'd41);
      9'(dsl_regs_pkg::ADDR_VPOS2_0):                      row = later(SAFE2, 8'd40);
      9'(dsl_regs_pkg::ADDR_VPOSCRC2_H):                   row = later(SAFE2, 8'd47);
      9'(dsl_regs_pkg::ADDR_VPOSCRC2_L):                   row = later(SAFE2, 8'd46);
      9'(dsl_regs_pkg::ADDR_POSTX): row = register(dsl_map_pkg::POSTX);
      9'(dsl_regs_pkg::ADDR_ONLINE_D_H): row = register(dsl_map_pkg::ONLINE_D_H);
      9'(dsl_regs_pkg::ADDR_ONLINE_D_L): row = register(dsl_map_pkg::ONLINE_D_L);
      9'(dsl_regs_pkg::ADDR_ONLINE_1_H): row = register(dsl_map_pkg::ONLINE_1_H);
      9'(dsl_regs_pkg::ADDR_ONLINE_1_L): row = register(dsl_map_pkg::ONLINE_1_L);
      9'(dsl_regs_pkg::ADDR_ONLINE_2_H): row = register(dsl_map_pkg::ONLINE_2_H);
      9'(dsl_regs_pkg::ADDR_ONLINE_2_L): row = toggles(8'd45);
      // The window.
      9'(dsl_page_regs_pkg::ADDR_STATUS):                  row = register(dsl_map_pkg::STATUS0);
      9'(dsl_page_regs_pkg::ADDR_STATUS) + 9'd1:           row = register(dsl_map_pkg::STATUS1);
      9'(dsl_page_regs_pkg::ADDR_STATUS) + 9'd2:           row = register(dsl_map_pkg::STATUS2);
      9'(dsl_page_regs_pkg::ADDR_STATUS) + 9'd3:           row = register(dsl_map_pkg::STATUS3);
      9'(dsl_page_regs_pkg::ADDR_POS_LO):                  row = first(FAST_WORDS, 8'd56);
      9'(dsl_page_regs_pkg::ADDR_POS_LO) + 9'd1:           row = later(FAST_WORDS, 8'd57);
      9'(dsl_page_regs_pkg::ADDR_POS_LO) + 9'd2:           row = later(FAST_WORDS, 8'd58);
      9'(dsl_page_regs_pkg::ADDR_POS_LO) + 9'd3:           row = later(FAST_WORDS, 8'd59);
      9'(dsl_page_regs_pkg::ADDR_POS_HI):                  row = later(FAST_WORDS, 8'd60);
      9'(dsl_page_regs_pkg::ADDR_POS_HI) + 9'd1:           row = later(FAST_WORDS, 8'd61);
      9'(dsl_page_regs_pkg::ADDR_POS_HI) + 9'd2:           row = later(FAST_WORDS, 8'd62);
      9'(dsl_page_regs_pkg::ADDR_POS_HI) + 9'd3:           row = later(FAST_WORDS, 8'd63);
      9'(dsl_page_regs_pkg::ADDR_VEL):                     row = later(FAST_WORDS, 8'd8);
      9'(dsl_page_regs_pkg::ADDR_VEL) + 9'd1:              row = later(FAST_WORDS, 8'd9);
      9'(dsl_page_regs_pkg::ADDR_VEL) + 9'd2:              row = later(FAST_WORDS, 8'd10);
      9'(dsl_page_regs_pkg::ADDR_VEL) + 9'd3:              row = later(FAST_WORDS, 8'd11);
      9'(dsl_page_regs_pkg::ADDR_FRAME_COUNT):             row = later(FAST_WORDS, 8'd16);
      9'(dsl_page_regs_pkg::ADDR_FRAME_COUNT) + 9'd1:      row = later(FAST_WORDS, 8'd17);
      9'(dsl_page_regs_pkg::ADDR_FRAME_COUNT) + 9'd2:      row = later(FAST_WORDS, 8'd18);
      9'(dsl_page_regs_pkg::ADDR_FRAME_COUNT) + 9'd3:      row = later(FAST_WORDS, 8'd19);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_LO):           row = later(FAST_WORDS, 8'd24);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_LO) + 9'd1:    row = later(FAST_WORDS, 8'd25);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_LO) + 9'd2:    row = later(FAST_WORDS, 8'd26);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_LO) + 9'd3:    row = later(FAST_WORDS, 8'd27);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_HI):           row = later(FAST_WORDS, 8'd28);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_HI) + 9'd1:    row = later(FAST_WORDS, 8'd29);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_HI) + 9'd2:    row = later(FAST_WORDS, 8'd30);
      9'(dsl_page_regs_pkg::ADDR_FRAME_TIME_HI) + 9'd3:    row = later(FAST_WORDS, 8'd31);
      9'(dsl_page_regs_pkg::ADDR_FRAME_STATUS):            row = status(FAST_WORDS, 8'd20);
      9'(dsl_page_regs_pkg::ADDR_FRAME_STATUS) + 9'd1:     row = later(FAST_WORDS, 8'd21);
      9'(dsl_page_regs_pkg::ADDR_FRAME_STATUS) + 9'd2:     row = later(FAST_WORDS, 8'd22);
      9'(dsl_page_regs_pkg::ADDR_FRAME_STATUS) + 9'd3:     row = later(FAST_WORDS, 8'd23);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_LO):                row = first(SAFE1_WORDS, 8'd32);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_LO) + 9'd1:         row = later(SAFE1_WORDS, 8'd33);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_LO) + 9'd2:         row = later(SAFE1_WORDS, 8'd34);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_LO) + 9'd3:         row = later(SAFE1_WORDS, 8'd35);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_HI):                row = later(SAFE1_WORDS, 8'd36);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_CHECK):             row = later(SAFE1_WORDS, 8'd38);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_CHECK) + 9'd1:      row = later(SAFE1_WORDS, 8'd39);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_CHECK) + 9'd2:      row = later(SAFE1_WORDS, 8'd37);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_CHECK) + 9'd3:      row = safe1(8'd20);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_AGE):               row = later(SAFE1_WORDS, 8'd48);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_AGE) + 9'd1:        row = later(SAFE1_WORDS, 8'd49);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_AGE) + 9'd2:        row = later(SAFE1_WORDS, 8'd50);
      9'(dsl_page_regs_pkg::ADDR_SAFE1_AGE) + 9'd3:        row = later(SAFE1_WORDS, 8'd51);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_LO):                row = first(SAFE2_WORDS, 8'd40);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_LO) + 9'd1:         row = later(SAFE2_WORDS, 8'd41);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_LO) + 9'd2:         row = later(SAFE2_WORDS, 8'd42);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_LO) + 9'd3:         row = later(SAFE2_WORDS, 8'd43);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_HI):                row = later(SAFE2_WORDS, 8'd44);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_CHECK):             row = later(SAFE2_WORDS, 8'd46);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_CHECK) + 9'd1:      row = later(SAFE2_WORDS, 8'd47);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_CHECK) + 9'd2:      row = later(SAFE2_WORDS, 8'd45);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_CHECK) + 9'd3:      row = safe2(8'd20);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_AGE):               row = later(SAFE2_WORDS, 8'd52);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_AGE) + 9'd1:        row = later(SAFE2_WORDS, 8'd53);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_AGE) + 9'd2:        row = later(SAFE2_WORDS, 8'd54);
      9'(dsl_page_regs_pkg::ADDR_SAFE2_AGE) + 9'd3:        row = later(SAFE2_WORDS, 8'd55);
      9'(dsl_page_regs_pkg::ADDR_RESTARTS):
        row = stored(dsl_message_pkg::RESTARTS, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_RESTARTS) + 9'd1:
        row = stored(dsl_message_pkg::RESTARTS + 6'd1, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_RESTARTS) + 9'd2:
        row = stored(dsl_message_pkg::ILLEGAL, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_RESTARTS) + 9'd3:
        row = stored(dsl_message_pkg::ILLEGAL + 6'd1, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_SAMPLE_PLACE):            row = register(dsl_map_pkg::PLACE_L);
      9'(dsl_page_regs_pkg::ADDR_SAMPLE_PLACE) + 9'd1:     row = register(dsl_map_pkg::PLACE_H);
      9'(dsl_page_regs_pkg::ADDR_MESSAGES):
        row = stored(dsl_message_pkg::FOREIGN, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_MESSAGES) + 9'd1:
        row = stored(dsl_message_pkg::FOREIGN + 6'd1, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_MESSAGES) + 9'd2:
        row = stored(dsl_message_pkg::RETRIES, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_MESSAGES) + 9'd3:
        row = stored(dsl_message_pkg::RETRIES + 6'd1, dsl_map_pkg::NOBODY);
      9'(dsl_page_regs_pkg::ADDR_SAFE_CHECK):
        row = stored(dsl_message_pkg::SAFE2_BITS, dsl_map_pkg::ALWAYS)
              | store(dsl_map_pkg::STORE_BITS);
      9'(dsl_page_regs_pkg::ADDR_SAFE_CHECK) + 9'd1:
        row = stored(dsl_message_pkg::TOLERANCE, dsl_map_pkg::ALWAYS)
              | store(dsl_map_pkg::STORE_TOLERANCE);
      9'(dsl_page_regs_pkg::ADDR_SAFE_STATUS):             row = register(dsl_map_pkg::CHECKS_L);
      9'(dsl_page_regs_pkg::ADDR_SAFE_STATUS) + 9'd1:      row = register(dsl_map_pkg::CHECKS_H);
      // The page.
      9'(dsl_page_regs_pkg::ADDR_ID): row = constant(dsl_page_regs_pkg::RESET_ID[7:0]);
      9'(dsl_page_regs_pkg::ADDR_ID) + 9'd1: row = constant(dsl_page_regs_pkg::RESET_ID[15:8]);
      9'(dsl_page_regs_pkg::ADDR_ID) + 9'd2: row = constant(dsl_page_regs_pkg::RESET_ID[23:16]);
      9'(dsl_page_regs_pkg::ADDR_ID) + 9'd3: row = constant(dsl_page_regs_pkg::RESET_ID[31:24]);
      9'(dsl_page_regs_pkg::ADDR_VERSION): row = constant(dsl_page_regs_pkg::RESET_VERSION[7:0]);
      9'(dsl_page_regs_pkg::ADDR_VERSION) + 9'd1:
        row = constant(dsl_page_regs_pkg::RESET_VERSION[15:8]);
      9'(dsl_page_regs_pkg::ADDR_VERSION) + 9'd2:
        row = constant(dsl_page_regs_pkg::RESET_VERSION[23:16]);
      9'(dsl_page_regs_pkg::ADDR_VERSION) + 9'd3:
        row = constant(dsl_page_regs_pkg::RESET_VERSION[31:24]);
      9'(dsl_page_regs_pkg::ADDR_FEATURES):                row = register(dsl_map_pkg::FEATURES);
      9'(dsl_page_regs_pkg::ADDR_FEATURES) + 9'd1:
        row = constant(dsl_page_regs_pkg::RESET_FEATURES[15:8]);
      9'(dsl_page_regs_pkg::ADDR_IRQ_STATUS):
        row = register(dsl_map_pkg::IRQ_STATUS) | store(dsl_map_pkg::STORE_IRQ);
      9'(dsl_page_regs_pkg::ADDR_IRQ_ENABLE):
        row = register(dsl_map_pkg::IRQ_ENABLE) | store(dsl_map_pkg::STORE_IRQ);
      9'(dsl_page_regs_pkg::ADDR_TIME_LOW):                row = register(dsl_map_pkg::TIME) | HOLD;
      9'(dsl_page_regs_pkg::ADDR_TIME_LOW) + 9'd1:         row = register(dsl_map_pkg::TIME);
      9'(dsl_page_regs_pkg::ADDR_TIME_LOW) + 9'd2:         row = register(dsl_map_pkg::TIME);
      9'(dsl_page_regs_pkg::ADDR_TIME_LOW) + 9'd3:         row = register(dsl_map_pkg::TIME);
      9'(dsl_page_regs_pkg::ADDR_TIME_HIGH):               row = register(dsl_map_pkg::TIME);
      9'(dsl_page_regs_pkg::ADDR_TIME_HIGH) + 9'd1:        row = register(dsl_map_pkg::TIME);
      9'(dsl_page_regs_pkg::ADDR_TIME_HIGH) + 9'd2:        row = register(dsl_map_pkg::TIME);
      9'(dsl_page_regs_pkg::ADDR_TIME_HIGH) + 9'd3:        row = register(dsl_map_pkg::TIME);
      default: row = constant(8'd0);
    endcase
  end

  always_ff @(posedge clk_i) begin
    address_q <= address_i;
  end

  assign row_o = row;

endmodule
