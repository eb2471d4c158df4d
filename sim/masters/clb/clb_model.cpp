// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/clb/clb_model.hpp"

#include <Vclb.h>
#include <Vclb___024root.h>
#include <verilated.h>

// Made by sim/model/signal_list.py.
#include <Vclb_wave.hpp>

#include "sim/masters/clb/verilated_clb.hpp"
#include "sim/model/page_time.hpp"

namespace mb4::sim {
namespace {

// The time of the page moves while the master is at rest, and what a read would take of it.
struct ClbCounts {
  using Root = Vclb___024root;

  template <typename Each>
  static void each(const Root& r, Each each) {
    each(r.biss_clb__DOT__u_page__DOT__u_time__DOT__low_q);
    each(r.biss_clb__DOT__u_page__DOT__u_time__DOT__high_q);
    each(r.biss_clb__DOT__u_page__DOT__u_time__DOT__carry_q);
    each(r.biss_clb__DOT__u_page__DOT__now);
    each(r.biss_clb__DOT__page_data);  // while the address of the last access is that of the time
  }
  // While the clock tile runs, its two counters do; with the same period in what the calls make of
  // them.
  static std::uint64_t period(const Root& r) {
    const unsigned ma = clb_period(r.biss_clb__DOT__u_frame__DOT__u_ma__DOT__period_i).second;
    const unsigned receive =
        clb_period(r.biss_clb__DOT__u_frame__DOT__u_receive__DOT__period_i).second;
    return ma == receive ? ma + 1U : 1U;
  }
  // Any number of clocks.
  static std::uint64_t left(const Root& /*r*/) { return ~std::uint64_t{0}; }
  static void pass(Root& r, std::uint64_t clocks) {
    auto& low = r.biss_clb__DOT__u_page__DOT__u_time__DOT__low_q;
    auto& high = r.biss_clb__DOT__u_page__DOT__u_time__DOT__high_q;
    pass_time(low, high, r.biss_clb__DOT__u_page__DOT__u_time__DOT__carry_q, clocks);
    r.biss_clb__DOT__u_page__DOT__now = time_of(low, high);
  }
};

struct InsideClb {
  using Counts = ClbCounts;

  static std::pair<unsigned, unsigned> ma_period(const Vclb& model) {
    return clb_period(model.rootp->biss_clb__DOT__u_frame__DOT__u_ma__DOT__period_i);
  }
  static std::vector<WaveSignal> signals(const Vclb& model) { return wave_signals(*model.rootp); }
};

}  // namespace

std::unique_ptr<ClbModel> make_clb_model(const ChipConfig& chip, std::uint64_t seed, bool plain) {
  return std::make_unique<VerilatedClb<Vclb, InsideClb>>(chip, seed, plain);
}

}  // namespace mb4::sim
