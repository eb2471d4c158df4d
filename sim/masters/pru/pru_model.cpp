// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/pru/pru_model.hpp"

#include <Vpru_200.h>
#include <Vpru_200___024root.h>
#include <verilated.h>

// Made by sim/model/signal_list.py.
#include <Vpru_200_wave.hpp>
#if !MB4SIM_ONE_MODEL
#include <Vpru_80.h>
#include <Vpru_80___024root.h>

#include <Vpru_80_wave.hpp>
#endif
#include <algorithm>
#include <type_traits>

// Some packages of Verilator leave this number empty. The headers hold what 5.006 writes.
#if VERILATOR_VERSION_INTEGER + 0 == 5006000
#include <Vpru_200_edge.hpp>
#if !MB4SIM_ONE_MODEL
#include <Vpru_80_edge.hpp>
#endif
#ifndef MODEL_RUNS_WHOLE
#define MB4_PRU_IN_PARTS
#endif
#endif

#include "sim/masters/pru/pru_master.hpp"
#include "sim/masters/pru/verilated_pru.hpp"
#include "sim/model/page_time.hpp"
#include "sim/model/whole_models.hpp"

namespace mb4::sim {
namespace {

// What moves while the master is at rest: the time of the page, the trigger's timer, and the count
// of the 40 us behind RUN and of OVERHEAD. Both of these count down from all ones (pru_pace).
template <typename Root, std::uint64_t Hz>
struct PruCounts {
  template <typename Each>
  static void each(const Root& r, Each each) {
    each(r.pru_core__DOT__u_regs__DOT__u_time__DOT__low_q);
    each(r.pru_core__DOT__u_regs__DOT__u_time__DOT__high_q);
    each(r.pru_core__DOT__u_regs__DOT__u_time__DOT__carry_q);
    each(r.pru_core__DOT__u_regs__DOT__now);
    each(r.pru_core__DOT__data);  // while the address of the last access is that of the time
    each(r.pru_core__DOT__u_pace__DOT__timer_q);
    each(r.pru_core__DOT__u_pace__DOT__count_q);
  }
  static std::uint64_t period(const Root& /*r*/) { return 1; }
  static std::uint64_t left(const Root& r) {
    const std::uint64_t least = std::min(timer_left(r), count_left(r));
    return least > kBefore ? least - kBefore : 0;
  }
  static void pass(Root& r, std::uint64_t clocks) {
    auto& low = r.pru_core__DOT__u_regs__DOT__u_time__DOT__low_q;
    auto& high = r.pru_core__DOT__u_regs__DOT__u_time__DOT__high_q;
    pass_time(low, high, r.pru_core__DOT__u_regs__DOT__u_time__DOT__carry_q, clocks);
    r.pru_core__DOT__u_regs__DOT__now = time_of(low, high);
    auto& timer = r.pru_core__DOT__u_pace__DOT__timer_q;
    if (timer_runs(r))
      timer = static_cast<std::remove_reference_t<decltype(timer)>>(timer - clocks);
    auto& count = r.pru_core__DOT__u_pace__DOT__count_q;
    if (r.pru_core__DOT__u_pace__DOT__counts != 0)
      count = static_cast<std::remove_reference_t<decltype(count)>>(count - clocks);
  }

 private:
  static constexpr std::uint64_t kEver = ~std::uint64_t{0};
  static constexpr std::uint64_t kBefore = 4;  // clocks before a count has an effect
  // pru_pace::state_e.
  static constexpr unsigned kSettle = 1;
  static constexpr unsigned kOverhead = 4;

  static unsigned state(const Root& r) { return r.pru_core__DOT__u_pace__DOT__state_q; }
  static bool timer_runs(const Root& r) { return r.pru_core__DOT__u_pace__DOT__timer_goes != 0; }
  // Up to the clock in which the sum with the period has no carry.
  static std::uint64_t timer_left(const Root& r) {
    constexpr std::uint64_t kCarry = std::uint64_t{1} << 24U;
    const std::uint64_t sum = std::uint64_t{r.pru_core__DOT__u_pace__DOT__period_i} +
                              r.pru_core__DOT__u_pace__DOT__timer_q;
    if (!timer_runs(r)) return kEver;
    return sum < kCarry ? 0 : sum - kCarry;
  }
  static std::uint64_t count_left(const Root& r) {
    constexpr std::uint64_t kCarry = std::uint64_t{1} << 16U;
    const std::uint64_t count = r.pru_core__DOT__u_pace__DOT__count_q;
    if (state(r) == kSettle) {
      const std::uint64_t gone = kCarry - 1 - count;
      constexpr std::uint64_t kSettleClocks = Hz / 25'000;
      return gone < kSettleClocks ? kSettleClocks - gone : 0;
    }
    if (state(r) != kOverhead) return kEver;
    const std::uint64_t sum = std::uint64_t{r.pru_core__DOT__u_pace__DOT__overhead_i} + count;
    return sum < kCarry ? 0 : sum - kCarry;
  }
};

template <typename Model, std::uint64_t Hz>
struct InsidePru {
  using Counts = PruCounts<std::remove_pointer_t<decltype(Model::rootp)>, Hz>;

  static unsigned mhz(const Model& model) {
    return pru_mhz(model.rootp->pru_core__DOT__plan_mhz_q);
  }
  static std::vector<WaveSignal> signals(const Model& model) { return wave_signals(*model.rootp); }
};

#ifdef MB4_PRU_IN_PARTS
#define MB4_PRU_STEPS(mhz)                                                              \
  struct Edge##mhz {                                                                    \
    using Root = Vpru_##mhz##___024root;                                                \
    using Kept = pru_##mhz::Kept;                                                       \
    static void rise(Root* root, Kept& kept) { pru_##mhz::rise(root, kept); }           \
    static void fall(Root* root, Kept& kept) { pru_##mhz::fall(root, kept); }           \
    static void line(Root* /*root*/, Kept& kept) { pru_##mhz::line_has_changed(kept); } \
    static void time(Kept& kept) { pru_##mhz::counts_have_changed(kept); }              \
  };                                                                                    \
  using Steps##mhz = PartSteps<Vpru_##mhz, Edge##mhz>
#else
#define MB4_PRU_STEPS(mhz) using Steps##mhz = WholeSteps<Vpru_##mhz>
const WholeModel kPruIsWhole("biss_pru");
#endif
MB4_PRU_STEPS(200);
#if !MB4SIM_ONE_MODEL
MB4_PRU_STEPS(80);
#endif

template <typename Model, typename Steps, std::uint64_t Hz>
std::unique_ptr<PruModel> make(const ChipConfig& chip, std::uint64_t seed, bool plain) {
  using Inside = InsidePru<Model, Hz>;
  if (plain) {
    return std::make_unique<VerilatedPru<Model, WholeSteps<Model>, Inside>>(chip, seed, true);
  }
  return std::make_unique<VerilatedPru<Model, Steps, Inside>>(chip, seed, false);
}

}  // namespace

std::unique_ptr<PruModel> make_pru_model(const ChipConfig& chip, std::uint64_t seed, bool plain) {
#if !MB4SIM_ONE_MODEL
  if (chip.f_clk_hz != kPruFastHz) return make<Vpru_80, Steps80, kPruSlowHz>(chip, seed, plain);
#endif
  return make<Vpru_200, Steps200, kPruFastHz>(chip, seed, plain);
}

}  // namespace mb4::sim
