// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The manager's pins of AXI4-Lite at a Verilated model, by their names s_axi_...: one access at a
// time, address and data of a write come together, BREADY and RREADY are always 1. Each function
// belongs to a place around a rising edge of the bus; the caller evaluates the model. An access
// that is given up after the model has taken it gets its answer later, which is dropped.
#ifndef MB4SIM_MODEL_AXI_LITE_MANAGER_HPP_
#define MB4SIM_MODEL_AXI_LITE_MANAGER_HPP_

#include <type_traits>

namespace mb4::sim {

template <typename Model>
class AxiLiteManager {
 public:
  // The levels without an access.
  void rest(Model& m) {
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    m.s_axi_bready = m.s_axi_rready = 1;
  }
  // The bus has been reset: no answer is to come.
  void forget() {
    taken_ = handed_ = false;
    late_ = 0;
  }
  // After an edge: the access (WordAccess) is on the pins.
  template <typename Access>
  void begin(Model& m, const Access& access) {
    using Address = std::decay_t<decltype(m.s_axi_awaddr)>;
    m.s_axi_awaddr = m.s_axi_araddr = static_cast<Address>(access.address);
    m.s_axi_wdata = access.data;
    m.s_axi_wstrb = access.strobe;
    m.s_axi_awvalid = m.s_axi_wvalid = access.write ? 1 : 0;
    m.s_axi_arvalid = access.write ? 0 : 1;
  }
  // Before an edge: what it transfers. True: the access is done, and `access` has the answer.
  template <typename Access>
  bool before(const Model& m, Access& access) {
    handed_ = (m.s_axi_awvalid != 0 && m.s_axi_awready != 0) ||
              (m.s_axi_arvalid != 0 && m.s_axi_arready != 0);
    taken_ = taken_ || handed_;
    if (m.s_axi_bvalid == 0 && m.s_axi_rvalid == 0) return false;
    if (late_ != 0) {
      --late_;
      return false;
    }
    taken_ = false;
    access.answer = m.s_axi_bvalid != 0 ? m.s_axi_bresp : m.s_axi_rresp;
    if (!access.write) access.data = m.s_axi_rdata;
    return true;
  }
  // After that edge. True: the pins have changed.
  bool after(Model& m) {
    if (!handed_) return false;
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    handed_ = false;
    return true;
  }
  // Gives the access up.
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

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_AXI_LITE_MANAGER_HPP_
