// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SPI slave of a word bus (enc_spi), whatever its pins and the word bus do. The bench keeps the
// bytes of a frame apart: opcode, address, data, each taken by its number in the frame, and what
// the word bus has answered. The frame is that of the header of enc_spi.
//
// claim: whatever the pins do, each frame of 56 bits that writes has one write access, with its
//   address and data, and each that reads one read access, taken back only at its end or at its last
//   moment; there is no other access; MISO has the answer of the frame and the word read in it, else
//   0; a write that waits keeps its payload, and the frame that finds it waiting is void; both sticky
//   bits are set and cleared by their conditions
// clocks: one
// depth: 30
// cover: 140
// unbounded: induction 1
// look: dut_sclk = u_dut.u_sclk.sync_q
// look: dut_cs = u_dut.u_cs.sync_q
// look: dut_mosi = u_dut.u_mosi.sync_q
// look: dut_sclk_q = u_dut.sclk_q
// look: dut_cs_q = u_dut.cs_nq
// look: dut_count = u_dut.count_q
// look: dut_shift = u_dut.shift_q
// look: dut_addr = u_dut.addr_q
// look: dut_req = u_dut.req_q
// look: dut_write = u_dut.write_q
// look: dut_clear = u_dut.clear_q
// look: dut_got = u_dut.got_q
// look: dut_blocked = u_dut.blocked_q
// look: dut_late = u_dut.late_q
// look: dut_void = u_dut.void_q
// mutation: common/enc_spi.sv | count_q == FRAME_BITS && ready; | ready;
// mutation: common/enc_spi.sv | (got_q || write_q || clear_q) && !blocked_q; | (got_q || write_q || clear_q);
// mutation: common/enc_spi.sv | count_q == LAST_ADDRESS && !blocked_q; | count_q == LAST_ADDRESS;
// mutation: common/enc_spi.sv | (write_q || !(cs_n || too_late)) | write_q || !too_late
// mutation: common/enc_spi.sv | rise && !hold && !blocked_q) | rise && !blocked_q)
// mutation: common/enc_spi.sv | word_ready_i && !too_late && | word_ready_i &&
// mutation: common/enc_spi.sv | count_q   <= 6'h3F; | count_q   <= '0;
// mutation: common/enc_spi.sv | got_q && count_q[5:4] != 2'd0 && | got_q &&
// mutation: common/enc_spi.sv | 6'(rise && count_q != 6'h3F) | 6'(rise)
// mutation: common/enc_spi.sv | frame_end && count_q != '0 && !accept | frame_end && count_q != '0
// mutation: common/enc_spi.sv | (blocked_q || (rise && waits)) | (rise && waits)
// mutation: common/enc_spi.sv | (too_late && req_q && !write_q) | too_late

module proof (
  input logic        clk_i,
  input logic        rst_ni,
  input logic        sclk_i,
  input logic        cs_ni,
  input logic        mosi_i,
  input logic        word_ready_i,
  input logic [31:0] word_data_i,
  input logic        word_error_i
);

  logic        miso, miso_oe;
  logic        req, write;
  logic [5:2]  addr;
  logic [31:0] data;
  logic [3:0]  be;

  enc_spi #(.AddrW(6)) u_dut (
    .clk_i, .rst_ni, .sclk_i, .cs_ni, .mosi_i, .miso_o(miso), .miso_oe_o(miso_oe),
    .word_req_o(req), .word_write_o(write), .word_addr_o(addr), .word_data_o(data),
    .word_be_o(be), .word_ready_i, .word_data_i, .word_error_i
  );

  wire [1:0]  dut_sclk, dut_cs, dut_mosi;
  wire        dut_sclk_q, dut_cs_q, dut_req, dut_write, dut_clear, dut_got, dut_blocked;
  wire        dut_late, dut_void;
  wire [5:0]  dut_count;
  wire [31:0] dut_shift;
  wire [5:2]  dut_addr;

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  // The pins, two and three clocks late.
  logic [2:0] sclk_n, cs_n;
  logic [1:0] mosi_n;
  always @(posedge clk_i) begin
    sclk_n <= {sclk_n[1:0], sclk_i};
    cs_n   <= {cs_n[1:0], cs_ni};
    mosi_n <= {mosi_n[0], mosi_i};
    if (!rst_ni) {sclk_n, cs_n, mosi_n} <= '0;
  end

  wire selected = !cs_n[1];
  wire edge_now = selected && sclk_n[1] && !sclk_n[2];
  wire end_now  = cs_n[1] && !cs_n[2];

  // The frame: its bits by their number. A frame that has begun before a reset has none.
  logic [6:0]  bits;        // 64: more than count, or no frame
  logic [7:0]  opcode, address;
  logic [31:0] word;
  logic        blocked;     // a write was waiting when the frame began
  // Accesses that must be there.
  logic        wdue, rdue;
  logic [7:0]  waddress;
  logic [31:0] wword;
  // What has been read.
  logic        have;
  logic [31:0] answer;
  logic        late, bad;

  wire writes  = opcode == 8'h02 && !blocked;
  wire reads   = opcode == 8'h03 && !blocked;
  wire clears  = opcode == 8'h04 && !blocked;
  wire good    = end_now && bits == 7'd56 && (writes || clears || (reads && have));
  wire asks    = edge_now && bits == 7'd15 && opcode == 8'h03 && !blocked;
  wire closes  = edge_now && bits == 7'd22;
  wire first_blocked = edge_now && wdue;

  always @(posedge clk_i) begin
    if (!selected)                         bits <= 7'd0;
    else if (edge_now && bits != 7'd64)    bits <= bits == 7'd62 ? 7'd64 : bits + 7'd1;
    if (edge_now && bits < 7'd8)           opcode <= {opcode[6:0], mosi_n[1]};
    if (edge_now && bits >= 7'd8 && bits < 7'd16) address <= {address[6:0], mosi_n[1]};
    if (edge_now && bits >= 7'd24)         word <= {word[30:0], mosi_n[1]};
    blocked <= selected && (blocked || first_blocked);
    wdue    <= (wdue && !word_ready_i) || (good && writes);
    if (good && writes) {waddress, wword} <= {address, word};
    rdue    <= asks || (rdue && !word_ready_i && selected && !closes);
    have    <= !(edge_now && bits == 7'd15 && !blocked) &&
               (have || (rdue && word_ready_i && !word_error_i && !closes));
    if (rdue && word_ready_i) answer <= word_data_i;
    late    <= (late && !(good && clears)) || first_blocked || (closes && rdue);
    bad     <= (bad && !(good && clears)) || (end_now && bits != 7'd0 && !good) ||
               (wdue && word_ready_i && word_error_i);
    if (!rst_ni) begin
      bits <= 7'd64;
      {blocked, wdue, rdue, have, late, bad} <= '0;
    end
  end

  // MISO has the bit that follows the ones so far.
  logic expected, known;
  logic [6:0] next_bit;
  wire [7:0] turn = {4'b0101, late, bad, 1'b0, (writes || clears || (reads && have))};
  assign next_bit = bits + 7'd1;
  always @(posedge clk_i) begin
    if (edge_now) begin
      known <= next_bit < 7'd56;
      if (next_bit < 7'd16)      expected <= 1'b0;
      else if (next_bit < 7'd24) expected <= turn[3'd7 - next_bit[2:0]];
      else                       expected <= reads && have && answer[5'd31 - 5'(next_bit - 7'd24)];
    end
    if (!rst_ni) {known, expected} <= 2'b10;
  end

  // Claims.
  always @* if (rst_ni) begin
    Enable_A:  assert (miso_oe == !cs_ni);
    Write_A:   assert ((req && write) == wdue);
    Read_A:    assert ((req && !write) == rdue);
    Be_A:      assert (be == 4'hF);
    if (wdue) Payload_A: assert (addr == waddress[5:2] && data == wword);
    if (rdue) Address_A: assert (addr == address[5:2]);
    if (known) Miso_A: assert (miso == expected);
    Sticky_A:  assert (dut_late == late && dut_void == bad);
  end else begin
    Reset_A: assert (!req && !miso);
  end

  // Where the block keeps what the bench knows, for the induction.
  wire [31:0] begun = bits < 7'd8 ? {24'd0, opcode}
                                  : ({24'd0, opcode} << (bits - 7'd8)) |
                                    ({24'd0, address} & ~(32'hFFFF_FFFF << (bits - 7'd8)));
  wire [31:0] older = 32'hFFFF_FFFF << bits;
  wire [31:0] data_bits = ~(32'hFFFF_FFFF << (bits - 7'd24));
  always @* if (rst_ni) begin
    Pins_A:  assert (dut_sclk == sclk_n[1:0] && dut_cs == cs_n[1:0] && dut_mosi == mosi_n &&
                     dut_sclk_q == sclk_n[2] && dut_cs_q == cs_n[2]);
    Count_A: assert (bits == 7'd64 ? dut_count == 6'd63 : bits < 7'd63 && dut_count == bits[5:0]);
    Block_A: assert (dut_blocked == blocked && dut_req == (wdue || rdue) && !(wdue && rdue));
    if (wdue) Waits_A: assert (dut_write && (bits == 7'd0 || blocked));
    if (rdue) Asks_A:  assert (reads && !dut_write && bits >= 7'd16 && bits < 7'd23);
    if (!blocked && bits >= 7'd16 && bits <= 7'd62) begin
      Kind_A: assert (dut_write == writes && dut_clear == clears && dut_got == (reads && have) &&
                      dut_got == have && dut_addr == address[5:2]);
    end
    if (blocked) Old_A: assert (!have);
    if (dut_write) Alone_A: assert (!dut_clear && !have);
    Got_A: assert (dut_got == have && !(dut_clear && have));
    // The shift register.
    if (!blocked && !wdue && bits < 7'd16) Begun_A: assert ((dut_shift & ~older) == (begun & ~older));
    if (!blocked && have && bits >= 7'd16 && bits <= 7'd23) Whole_A: assert (dut_shift == answer);
    if (!blocked && have && bits >= 7'd24 && bits <= 7'd55)
      Rest_A: assert (((dut_shift ^ (answer << (bits - 7'd23))) &
                       (32'hFFFF_FFFF << (bits - 7'd23))) == 32'd0);
    if (!blocked && bits >= 7'd24 && bits <= 7'd56)
      Data_A: assert (((dut_shift ^ word) & (bits == 7'd56 ? 32'hFFFF_FFFF : data_bits)) == 32'd0);
    Range_A: assert (bits <= 7'd62 || bits == 7'd64);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Write_C:   cover (good && writes);
    Clear_C:   cover (good && clears);
    Late_C:    cover (closes && rdue);
    Blocked_C: cover (blocked && bits == 7'd2);
    Answer_C:  cover (known && bits == 7'd30 && have && miso);
  end

endmodule
