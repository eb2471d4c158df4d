// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The manager's pins of AXI4-Lite and of classic Wishbone cycles at a Verilated model. Both have
//
//   rest(model)            the levels without an access
//   clock(model, level)    the clock of the bus
//   reset(model, active)
//   begin(model, access)   after an edge: the access is on the pins
//   before(model, access)  before a rising edge: what the edge transfers. True: the access is done,
//                          and `access` has the answer
//   after(model)           after that edge
//   drop(model)            the manager gives the access up
#ifndef MB4SIM_MB4_BUS_MANAGERS_HPP_
#define MB4SIM_MB4_BUS_MANAGERS_HPP_

#include <cstdint>
#include <utility>

#include "sim/hosts/word_access.hpp"

namespace mb4::sim {

// Address and data of a write come together. BREADY and RREADY are always 1.
template <typename Model>
class AxiManager {
 public:
  void rest(Model& m) {
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    m.s_axi_bready = m.s_axi_rready = 1;
  }
  void clock(Model& m, bool level) { m.s_axi_aclk = level; }
  void reset(Model& m, bool active) {
    m.s_axi_aresetn = !active;
    taken_ = handed_ = false;
    late_ = 0;
  }
  void begin(Model& m, const WordAccess& access) {
    m.s_axi_awaddr = m.s_axi_araddr = static_cast<std::uint16_t>(access.address);
    m.s_axi_wdata = access.data;
    m.s_axi_wstrb = access.strobe;
    m.s_axi_awvalid = m.s_axi_wvalid = access.write;
    m.s_axi_arvalid = !access.write;
  }
  bool before(const Model& m, WordAccess& access) {
    handed_ = (m.s_axi_awvalid && m.s_axi_awready) || (m.s_axi_arvalid && m.s_axi_arready);
    taken_ = taken_ || handed_;
    if (!m.s_axi_bvalid && !m.s_axi_rvalid) return false;
    if (late_ != 0) {
      --late_;
      return false;
    }
    access.answer = m.s_axi_bvalid ? m.s_axi_bresp : m.s_axi_rresp;
    if (!access.write) access.data = m.s_axi_rdata;
    taken_ = false;
    return true;
  }
  void after(Model& m) {
    if (std::exchange(handed_, false)) {
      m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    }
  }
  void drop(Model& m) {
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    if (taken_) ++late_;
    taken_ = handed_ = false;
  }
  // An answer is still to come.
  bool owed() const { return late_ != 0; }

 private:
  bool handed_ = false;  // the edge that is about to come takes address and data
  bool taken_ = false;   // the running access has been taken
  unsigned late_ = 0;    // answers of accesses that have been given up
};

template <typename Model>
class WishboneManager {
 public:
  void rest(Model& m) { m.wb_cyc_i = m.wb_stb_i = 0; }
  void clock(Model& m, bool level) { m.wb_clk_i = level; }
  void reset(Model& m, bool active) { m.wb_rst_i = active; }
  void begin(Model& m, const WordAccess& access) {
    m.wb_adr_i = static_cast<std::uint16_t>(access.address >> 2U);
    m.wb_we_i = access.write;
    m.wb_dat_i = access.data;
    m.wb_sel_i = access.write ? access.strobe : 0xF;
    m.wb_cyc_i = m.wb_stb_i = 1;
  }
  bool before(const Model& m, WordAccess& access) {
    ended_ = m.wb_ack_o || m.wb_err_o;
    if (!ended_) return false;
    access.answer = m.wb_err_o;
    if (!access.write) access.data = m.wb_dat_o;
    return true;
  }
  void after(Model& m) {
    if (std::exchange(ended_, false)) rest(m);
  }
  void drop(Model& m) { rest(m); }
  bool owed() const { return false; }

 private:
  bool ended_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_BUS_MANAGERS_HPP_
