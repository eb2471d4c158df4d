// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_spi with one channel on an iCEBreaker (iCE40 UP5K): host on Pmod 1A (SPI, Pmod type 2), the
// line's transceiver on Pmod 1B. The PLL makes 45 MHz of the board's 12 MHz, so SCLK is at most
// 5.6 MHz. Pins and clock: biss_spi_icebreaker.pcf.

module biss_spi_icebreaker (
  input  logic clk_i,      // 12 MHz
  input  logic button_ni,  // reset
  // Pmod 1A: host
  input  logic ncs_i,
  input  logic mosi_i,
  output logic miso_io,
  input  logic sclk_i,
  // Pmod 1B: line, error and warning of the encoder, active low
  output logic ma_o,
  input  logic slo_i,
  output logic error_no,
  output logic warn_no
);

  logic       clk, locked, rst_n;
  logic       miso, miso_oe, sample_clk, irq, unused;
  logic [3:0] por_q;

  SB_PLL40_PAD #(
    .FEEDBACK_PATH ("SIMPLE"),
    .DIVR          (4'd0),
    .DIVF          (7'd59),
    .DIVQ          (3'd4),
    .FILTER_RANGE  (3'd1)
  ) u_pll (
    .PACKAGEPIN    (clk_i),
    .PLLOUTGLOBAL  (clk),
    .LOCK          (locked),
    .RESETB        (1'b1),
    .BYPASS        (1'b0)
  );

  // Flops are 0 after the configuration: 15 clocks of reset after the PLL has locked.
  always_ff @(posedge clk) if (locked && por_q != 4'd15) por_q <= por_q + 4'd1;
  assign rst_n = por_q == 4'd15 && button_ni;

  biss_spi u_biss (
    .clk_i     (clk),
    .rst_ni    (rst_n),
    .sclk_i,
    .cs_ni     (ncs_i),
    .mosi_i,
    .miso_o    (miso),
    .miso_oe_o (miso_oe),
    .ma_o,
    .slo_i,
    .ext_sample_clk_i (1'b0),
    .sample_clk_o     (sample_clk),
    .sample_en_i      (1'b0),
    .error_no,
    .warn_no,
    .irq_o     (irq)
  );

  SB_IO #(.PIN_TYPE(6'b1010_01)) u_miso (
    .PACKAGE_PIN   (miso_io),
    .OUTPUT_ENABLE (miso_oe),
    .D_OUT_0       (miso)
  );

  assign unused = sample_clk ^ irq;

endmodule
