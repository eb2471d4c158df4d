// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Parallel host bus, Intel 8051 or Motorola 68HC11: connects the pins with the host byte bus.
//
// Clock domains: the strobes are the clocks.
//
// - The falling edge of ALE stores the address. It stays for any number of accesses.
// - rd_clk_o rises at the start of a read (NRD falls, E rises). The byte is taken once and is
//   stable while the strobe lasts.
// - wr_clk_o rises at the end of a write (NWR rises, E falls). The data are stable then (I014,
//   I112).
//
// Misuse: with NCS high nothing happens. NRD and NWR low together are a write. NCS or a strobe that
// changes at the wrong time may end an access early; afterwards only the address is kept. NRES
// must rise while the strobes rest: a strobe that ends after NRES has risen writes.
// Datasheet: pages 9, 10, 17, Table 2.

module mb4_par_bus (
  input  logic       rst_ni,
  input  logic       enable_i,    // strap: CFGSPI = 0
  input  logic       int_nmot_i,  // strap: 1 = Intel, 0 = Motorola
  // pins
  input  logic       cs_ni,
  input  logic       ale_i,
  input  logic       nrd_rnw_i,
  input  logic       nwr_e_i,
  input  logic [7:0] db_i,
  // host byte bus
  output logic       wr_clk_o,
  output logic       rd_clk_o,
  output logic [7:0] addr_o,
  // pins
  output logic       db_oe_o      // the chip drives the data bus
);

  logic       cs;
  logic       read, write;
  logic [7:0] addr_q;

  assign cs    = enable_i && !cs_ni;
  assign read  = cs && nwr_e_i && (int_nmot_i ? !nrd_rnw_i : nrd_rnw_i);
  assign write = cs && (int_nmot_i ? !nwr_e_i : nwr_e_i && !nrd_rnw_i);

  always_ff @(negedge ale_i or negedge rst_ni) begin
    if (!rst_ni) addr_q <= '0;
    else if (cs) addr_q <= db_i;
  end

  assign wr_clk_o = !write;
  assign rd_clk_o = read;
  assign addr_o   = addr_q;
  assign db_oe_o  = read;

endmodule
