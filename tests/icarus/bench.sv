// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4_core in Icarus, a second simulator: SPI, registers, a BiSS C frame, a register access. It is
// plain SystemVerilog. No expected value comes from the RTL: the CRC is that of the table in
// docs/theory.md, the control frame that of the BiSS C protocol description. With +speed=N the
// bench runs workload A for N clocks.
`timescale 1ns/1ps

module bench;

  localparam logic [27:0] WORD = 28'b1010101011110011011110111111;  // 0x2ABCDEF, nE = nW = 1
  localparam logic [5:0]  CRC  = 6'h18;                             // of WORD, polynomial 0x43

  logic clk = 1'b0, rst_n = 1'b1, por_n = 1'b1, sclk = 1'b0, cs_n = 1'b1, mosi = 1'b0;
  wire  miso, miso_oe, eot, ner_low, ma1, ma2, mo1, mo2, clkeni, paired;
  logic sl = 1'b1;

  mb4_core dut (
    .clk_i(clk), .rst_ni(rst_n), .por_ni(por_n), .sclk_i(sclk), .cs_ni(cs_n), .mosi_i(mosi),
    .miso_o(miso), .miso_oe_o(miso_oe), .eot_o(eot), .ner_low_o(ner_low), .ner_i(!ner_low),
    .clkeni_o(clkeni), .paired_o(paired), .getsens_i(1'b0), .ma1_o(ma1), .sl1_i(sl), .mo1_o(mo1),
    .ma2_o(ma2), .sl2_i(1'b1), .mo2_o(mo2), .quirks_i(6'b000100)
  );

  always #25 clk = !clk;  // 20 MHz

  integer failures = 0;
  integer checks = 0;

  task expect_eq(input [63:0] found, input [63:0] wanted, input [8*40-1:0] what);
    begin
      checks = checks + 1;
      if (found !== wanted) begin
        failures = failures + 1;
        $display("FAILED: %0s: found %h, expected %h, at %0t", what, found, wanted, $time);
      end
    end
  endtask

  // ---- the slave: one encoder, 28 bits, timeout 2 us ------------------------------------------

  localparam integer TIMEOUT = 2000;  // ns
  integer rises = 0, frames = 0, slot = -1, zeros = 0;
  time    last_edge = 0;
  logic   cdm, idle = 1'b1;
  logic   answers = 1'b0;
  logic [0:33] cds = 34'b0, cdm_seen = 34'b0;  // by slot
  logic [33:0] line;                            // data, inverted CRC

  always @(ma1) begin
    last_edge = $time;
    if (!ma1) idle = 1'b0;
    if (ma1 && !idle) begin
      rises = rises + 1;
      case (rises)
        1: line = {WORD, ~CRC};
        2: sl <= #15 1'b0;                      // acknowledge
        3: sl <= #15 1'b1;                      // start bit: no processing time
        4: sl <= #15 answers && slot >= 0 && slot <= 33 && cds[slot];
        default: if (rises <= 38) begin
          sl <= #15 line[33];
          line = {line[32:0], 1'b0};
        end else begin
          sl <= #15 1'b0;                       // until the timeout is over
        end
      endcase
    end
  end

  // The timeout: MA has rested. CDM is the inverse of its level.
  always begin
    #100;
    if (!idle && $time - last_edge >= TIMEOUT) begin
      idle = 1'b1;
      cdm = !ma1;
      frames = frames + 1;
      if (slot < 0 && cdm && zeros >= 14) slot = 0;
      if (slot >= 0 && slot <= 33) begin
        cdm_seen[slot] = cdm;
        slot = slot + 1;
      end
      zeros = cdm ? 0 : zeros + 1;
      rises = 0;
      sl <= 1'b1;
    end
  end

  // ---- host ----------------------------------------------------------------------------------

  logic [7:0] rx;

  task spi_byte(input [7:0] tx);
    integer i;
    begin
      for (i = 7; i >= 0; i = i - 1) begin
        mosi = tx[i];
        #50 sclk = 1'b1;
        rx[i] = miso;
        #50 sclk = 1'b0;
      end
    end
  endtask

  task select(input on);
    begin
      #60 cs_n = !on;
      #60;
    end
  endtask

  task write1(input [7:0] addr, input [7:0] data);
    begin
      select(1); spi_byte(8'h02); spi_byte(addr); spi_byte(data); select(0);
    end
  endtask

  task read1(input [7:0] addr, output [7:0] data);
    begin
      select(1); spi_byte(8'h03); spi_byte(addr); spi_byte(8'h00); select(0);
      data = rx;
    end
  endtask

  task instruction(input [7:0] code);
    begin
      select(1); spi_byte(8'h07); spi_byte(code); select(0);
    end
  endtask

  task status(output [7:0] s0, output [7:0] s1);
    begin
      select(1); spi_byte(8'h05); spi_byte(8'h00); s0 = rx; spi_byte(8'h00); s1 = rx; select(0);
    end
  endtask

  task reset;
    begin
      #100 begin rst_n = 1'b0; por_n = 1'b0; end
      #500 begin rst_n = 1'b1; por_n = 1'b1; end
      #8000;  // memories are cleared
      // Flops that NCS resets by its level want an edge in a simulator.
      select(1);
      select(0);
    end
  endtask

  // Channel 1: 28 bits, CRC 6; BiSS C on line 1; f_MA = 10 MHz, AGSMIN.
  task configure;
    begin
      write1(8'hC0, 8'h5B);
      write1(8'hC1, 8'h06);
      select(1);
      spi_byte(8'h02); spi_byte(8'hE5); spi_byte(8'h40); spi_byte(8'hA0); spi_byte(8'h00);
      spi_byte(8'h7C);
      select(0);
      write1(8'hEC, 8'h01);
      write1(8'hED, 8'h0D);
    end
  endtask

  logic [7:0]  s0, s1, value;
  logic [63:0] data;
  integer      i, limit, first;

  task check_registers;
    begin
      // Written and read back, in one burst and one by one; an incomplete byte does nothing.
      select(1);
      spi_byte(8'h02); spi_byte(8'hC0);
      for (i = 0; i < 32; i = i + 1) spi_byte(i * 7 + 3);
      select(0);
      for (i = 0; i < 32; i = i + 1) begin
        read1(8'hC0 + i, value);
        expect_eq(value, (i * 7 + 3) & 8'hFF, "configuration read back");
      end
      select(1);
      spi_byte(8'h02); spi_byte(8'hC3);
      mosi = 1'b1;
      #50 sclk = 1'b1;
      #50 sclk = 1'b0;
      select(0);
      read1(8'hC3, value);
      expect_eq(value, 3 * 7 + 3, "aborted byte");
      expect_eq(miso_oe, 1'b0, "MISO with NCS = 1");
      // Data memories through the queue.
      select(1);
      spi_byte(8'h0B);
      for (i = 0; i < 64; i = i + 1) spi_byte(8'hFF - i);
      select(0);
      #2000;
      select(1);
      spi_byte(8'h09);
      for (i = 0; i < 64; i = i + 1) begin
        spi_byte(8'h00);
        expect_eq(rx, (8'hFF - i) & 8'hFF, "SCDATA written by the host");
      end
      select(0);
      for (i = 0; i < 32; i = i + 1) write1(8'hC0 + i, 8'h00);
    end
  endtask

  task check_frame;
    begin
      configure;
      instruction(8'h80);  // BREAK
      first = frames;
      instruction(8'h04);  // INSTR = 010
      status(s0, s1);
      expect_eq(s0[0], 1'b0, "EOT while the frame runs");
      limit = 0;
      while (!eot && limit < 1000) begin #100; limit = limit + 1; end
      status(s0, s1);
      expect_eq(s0, 8'hFB, "STATUS0 behind the frame");
      expect_eq(s1, 8'h02, "SVALID1");
      select(1);
      spi_byte(8'h09);
      for (i = 0; i < 8; i = i + 1) begin spi_byte(8'h00); data[8*i +: 8] = rx; end
      select(0);
      expect_eq(data[27:0], WORD, "data");
      expect_eq(data[31:28], 4'h0, "upper bits of the last byte");
      expect_eq(data[63:56], {2'b00, CRC}, "CRC in the highest byte");
      #3000 expect_eq(frames - first, 1, "one frame");
    end
  endtask

  // Read register 0x67 of ID 0, value 0x5F: the control frame of the protocol description, bit by
  // bit. CDS: ID lock in slot 1, R echo in 17, S in 19, data and inverted CRC after it.
  task check_register_access;
    begin
      write1(8'hE2, 8'h67);
      write1(8'hE3, 8'h00);
      write1(8'hE4, 8'h01);
      write1(8'hE5, 8'hC0);
      answers  = 1'b1;
      slot     = -1;
      cds      = 34'b0;
      cds[1]   = 1'b1;
      cds[17]  = 1'b1;
      cds[19]  = 1'b1;
      cds[20:27] = 8'h5F;
      cds[28:31] = 4'b1111;
      instruction(8'h09);  // INSTR = 100, AGS
      limit = 0;
      s0 = 8'h00;
      while (!s0[2] && limit < 300) begin
        #5000 status(s0, s1);
        limit = limit + 1;
      end
      expect_eq({s0[7:2], 2'b00}, 8'hFC, "STATUS0: REGEND, no error");
      expect_eq(cdm_seen[0:18], 19'b1100011001110010101, "CDM of header");
      expect_eq(cdm_seen[20:31], 12'b0, "CDM while the slave sends");
      read1(8'h80, value);
      expect_eq(value, 8'h5F, "RDATA");
      instruction(8'h80);
      answers = 1'b0;
    end
  endtask

  integer speed;

  initial begin
    reset;
    if ($value$plusargs("speed=%d", speed)) begin
      configure;
      instruction(8'h01);  // AGS: frames one after the other
      first = frames;
      #(50.0 * speed);
      $display("%0d clocks, %0d frames", speed, frames - first);
      if (frames - first < speed / 400) $display("FAILED: too few frames");
      else $display("passed");
      $finish;
    end
    check_registers;
    check_frame;
    check_register_access;
    check_frame;
    if (failures == 0 && checks > 100) $display("passed: %0d checks", checks);
    $finish;
  end

  initial begin
    #20000000 $display("FAILED: no end");
    $finish;
  end

endmodule
