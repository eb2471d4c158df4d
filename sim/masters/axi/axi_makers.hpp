// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How make_axi_model() makes a model of a width. The models in parts and the whole ones stand in
// files of their own, because together they take long to compile.
#ifndef MB4SIM_MASTERS_AXI_AXI_MAKERS_HPP_
#define MB4SIM_MASTERS_AXI_AXI_MAKERS_HPP_

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/masters/axi/axi_model.hpp"
#include "sim/masters/axi/verilated_axi.hpp"
#include "sim/model/page_time.hpp"

namespace mb4::sim {

// What moves while the master is at rest: the count of the internal sample clock, and with all
// extras the time of the page.
struct AxiCounts {
  template <typename Root, typename Each>
  static void each(const Root& r, Each each) {
    each(r.axi_core__DOT__u_start__DOT__left_q);
    if constexpr (kHasPage<Root>) {
      each(r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__low_q);
      each(r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__high_q);
      each(r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__carry_q);
      each(r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__now);
    }
  }
  // The time base of MA always runs.
  template <typename Root>
  static std::uint64_t period(const Root& r) {
    return 2 * (((r.axi_core__DOT__u_start__DOT__frame_q >> kAxiHalfLastLsb) & 0xFFU) + 1U);
  }
  // The sample clock changes when as many clocks have passed as sample_divider says.
  template <typename Root>
  static std::uint64_t left(const Root& r) {
    const std::uint64_t end = (r.axi_core__DOT__u_regs__DOT__cfg_q >> kDividerLsb) & kCount;
    const std::uint64_t passed = ~r.axi_core__DOT__u_start__DOT__left_q & kCount;
    return end > passed + kMargin ? end - passed - kMargin : 0;
  }
  template <typename Root>
  static void pass(Root& r, std::uint64_t clocks) {
    r.axi_core__DOT__u_start__DOT__left_q -= static_cast<IData>(clocks);
    if constexpr (kHasPage<Root>) {
      pass_time(r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__low_q,
                r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__high_q,
                r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__carry_q,
                clocks);
      r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__now =
          time_of(r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__low_q,
                  r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__u_time__DOT__high_q);
    }
  }

 private:
  template <typename Root>
  static constexpr bool kHasPage = requires(Root r) {
    r.axi_core__DOT__u_extras__DOT__gen_page__DOT__u_page__DOT__now;
  };
  static constexpr unsigned kDividerLsb = 17;  // place of sample_divider in axi_pkg::cfg_t
  static constexpr std::uint64_t kCount = 0xFFF'FFFF;
  static constexpr std::uint64_t kMargin = 4;  // the last clocks before the change are computed
};

struct InsideAxi {
  using Counts = AxiCounts;
  template <typename Model>
  static unsigned frame(const Model& model) {
    return model.rootp->axi_core__DOT__u_start__DOT__frame_q;
  }
  template <typename Model>
  static std::vector<WaveSignal> signals(const Model& model) {
    return wave_signals(*model.rootp);
  }
};

// One or four channels without extras, of which an edge evaluates only what it changes.
std::unique_ptr<AxiModel> make_axi_in_parts(const ChipConfig& chip, unsigned channels,
                                            std::uint64_t seed);
// The model whole: any configuration. `plain`: no clock is left out.
std::unique_ptr<AxiModel> make_axi_whole(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool plain);

}  // namespace mb4::sim

#endif  // MB4SIM_MASTERS_AXI_AXI_MAKERS_HPP_
