// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_spi with one channel on a bare iCE40 UP5K, without a crystal: the oscillator of the device
// makes 48 MHz, within 10 %, so SCLK is at most 5.4 MHz and MA deviates as much. Reset: 15 clocks
// after the configuration. Pins: biss_spi_up5k.pcf.

module biss_spi_up5k (
  input  logic ncs_i,
  input  logic mosi_i,
  output logic miso_io,
  input  logic sclk_i,
  output logic ma_o,
  input  logic slo_i,
  output logic error_no,
  output logic warn_no
);

  logic       clk;
  logic       miso, miso_oe, sample_clk, irq, unused;
  logic [3:0] por_q;

  SB_HFOSC #(.CLKHF_DIV("0b00")) u_osc (
    .CLKHFPU (1'b1),
    .CLKHFEN (1'b1),
    .CLKHF   (clk)
  );

  always_ff @(posedge clk) if (por_q != 4'd15) por_q <= por_q + 4'd1;

  biss_spi u_biss (
    .clk_i     (clk),
    .rst_ni    (por_q == 4'd15),
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
