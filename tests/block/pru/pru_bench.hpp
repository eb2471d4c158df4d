// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// pru_core by its pins: AXI4-Lite, trigger, MA, SL, with an encoder behind a line that delays,
// jitters and disturbs. MA and SL are recorded for the judge of tests/reference/pru. Times are
// picoseconds.
#ifndef TESTS_BLOCK_PRU_PRU_BENCH_HPP_
#define TESTS_BLOCK_PRU_PRU_BENCH_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "Vpru_core_200.h"
#include "Vpru_core_80.h"
#include "pru_regs.hpp"
#include "tests/block/biss/edge_slave.hpp"
#include "tests/reference/pru/judge.hpp"
#include "tests/support/model_context.hpp"

namespace mb4test {

using pru_judge::Time;

template <typename Model, std::uint32_t Hz>
class PruBench {
 public:
  static constexpr std::uint32_t kHz = Hz;
  static constexpr Time kClock = 1'000'000'000'000 / Hz;

  // `quirks`: SMA_WRAP, FIRST_LOW, EXTRA_10 as bits 2 to 0.
  explicit PruBench(unsigned quirks = 1) {
    m.quirks_i = static_cast<std::uint8_t>(quirks);
    m.clk_i = 0;
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    m.s_axi_bready = m.s_axi_rready = 1;
    m.s_axi_wstrb = 0xF;
    m.sl_i = 1;
    m.trigger_i = 0;
    pulse_reset(m);
    clocks(5);
  }

  void clock() {
    now += kClock;
    settle_sl();
    m.sl_i = sl_level_ ? 1 : 0;
    m.eval();
    m.clk_i = 1;
    m.eval();
    m.clk_i = 0;
    m.eval();
    const bool level = m.ma_o != 0;
    if (level != ma_before_) {
      ma.edge(now, level);
      encoder.edge(level, static_cast<std::uint64_t>(now));
    }
    ma_before_ = level;
    encoder.step(level, static_cast<std::uint64_t>(now));
    if (!silent && encoder.out != sent_) arrive(now, sent_ = encoder.out);
  }
  void clocks(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) clock();
  }
  void write(std::uint32_t address, std::uint32_t data, unsigned strobes = 0xF) {
    m.s_axi_awaddr = static_cast<std::uint16_t>(address);
    m.s_axi_wdata = data;
    m.s_axi_wstrb = static_cast<std::uint8_t>(strobes);
    m.s_axi_awvalid = m.s_axi_wvalid = 1;
    bool taken = false;
    for (int i = 0; i < 20 && !taken; ++i) {
      m.eval();
      taken = m.s_axi_awready != 0 && m.s_axi_wready != 0;
      clock();
    }
    m.s_axi_awvalid = m.s_axi_wvalid = 0;
    for (int i = 0; i < 20 && m.s_axi_bvalid == 0; ++i) clock();
    ASSERT_EQ(m.s_axi_bvalid, 1);
    ASSERT_EQ(m.s_axi_bresp, 0);
    clock();
  }
  std::uint32_t read(std::uint32_t address) {
    m.s_axi_araddr = static_cast<std::uint16_t>(address);
    m.s_axi_arvalid = 1;
    bool taken = false;
    for (int i = 0; i < 20 && !taken; ++i) {
      m.eval();
      taken = m.s_axi_arready != 0;
      clock();
    }
    m.s_axi_arvalid = 0;
    for (int i = 0; i < 20 && m.s_axi_rvalid == 0; ++i) clock();
    EXPECT_EQ(m.s_axi_rvalid, 1);
    EXPECT_EQ(m.s_axi_rresp, 0);
    const std::uint32_t data = m.s_axi_rdata;
    clock();
    return data;
  }

  // A pulse on SL that inverts it, from `at` on.
  void glitch(Time at, Time width) {
    schedule({at, false, true});
    schedule({at + width, false, true});
  }

  Owned<Model> owner;
  Model& m = *owner;
  Time now = 0;
  Slave encoder;                 // its timeout is in picoseconds
  bool silent = false;           // the encoder follows MA and says nothing
  Time delay = 0;                // round trip
  Time skew = 0;                 // rising edges of SL come later by this
  std::function<Time()> jitter;  // added to each edge of SL
  pru_judge::Trace ma{true};
  pru_judge::Trace sl{true};
  std::optional<bool> stuck;  // level of SL whatever the encoder says

 private:
  struct Event {
    Time at;
    bool level;
    bool glitch;
  };
  void arrive(Time at, bool level) {
    Time due = at + delay + (level ? skew : 0) + (jitter ? jitter() : 0);
    if (due < last_arrival_) due = last_arrival_;  // no edge overtakes another
    last_arrival_ = due;
    schedule({due, level, false});
  }
  void schedule(const Event& event) {
    auto place = events_.end();
    while (place != events_.begin() && (place - 1)->at > event.at) --place;
    events_.insert(place, event);
  }
  // SL up to the instant of this clock edge, what comes at this very instant not included.
  void settle_sl() {
    while (!events_.empty() && events_.front().at < now) {
      const Event event = events_.front();
      events_.pop_front();
      if (event.glitch) {
        inverted_ = !inverted_;
      } else {
        answer_ = event.level;
      }
      show(event.at);
    }
    show(now - 1);
  }
  void show(Time at) {
    const bool level = stuck ? *stuck : answer_ != inverted_;
    if (level == sl_level_) return;
    sl_level_ = level;
    sl.edge(at, level);
  }

  std::deque<Event> events_;
  Time last_arrival_ = 0;
  bool sent_ = true;  // by the encoder
  bool answer_ = true;
  bool inverted_ = false;
  bool sl_level_ = true;
  bool ma_before_ = true;
};

using PruBench200 = PruBench<Vpru_core_200, 200'000'000>;
using PruBench80 = PruBench<Vpru_core_80, 80'000'000>;

}  // namespace mb4test

#endif  // TESTS_BLOCK_PRU_PRU_BENCH_HPP_
