// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The manager's pins of classic Wishbone cycles at a Verilated model (TwoClockMaster).
#ifndef MB4SIM_MB4_WISHBONE_MANAGER_HPP_
#define MB4SIM_MB4_WISHBONE_MANAGER_HPP_

#include <cstdint>
#include <utility>

#include "sim/hosts/word_access.hpp"

namespace mb4::sim {

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

#endif  // MB4SIM_MB4_WISHBONE_MANAGER_HPP_
