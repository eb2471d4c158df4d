// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One channel of biss_axi with the sampler by frames, and an encoder behind a line that delays,
// jitters, distorts and disturbs. Times are 1/kUnit of a clock. The eye of each frame is computed
// anew from the samples of SLO, as docs/samplers.md tells it.
#ifndef TESTS_BLOCK_AXI_AXI_FRAMES_BENCH_HPP_
#define TESTS_BLOCK_AXI_AXI_FRAMES_BENCH_HPP_

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "places.hpp"
#include "tests/block/biss/edge_slave.hpp"
#include "tests/block/biss/widest_gap.hpp"
#include "tests/support/model_context.hpp"

namespace mb4test {

struct Eye {
  bool valid = false;
  unsigned width = 0, point = 0;
  bool operator==(const Eye&) const = default;
};

// `Model`: axi_channel with or without the sampler by frames.
template <typename Model>
class AxiFrames {
 public:
  static constexpr std::int64_t kUnit = 1024;
  static constexpr unsigned kTimeout = 60;  // clocks of the encoder

  AxiFrames(unsigned bits, unsigned half) : bits_(bits), half_(half) {
    namespace frame = places::axi_pkg::frame_t;
    namespace rule = places::axi_pkg::rule_t;
    m.frame_i = static_cast<std::uint32_t>(frame::kHalfLast(half - 1) | frame::kDataLast(bits + 1) |
                                           frame::kEdges(4 + bits + 2 + 6) | frame::kCheck(true));
    for (auto& word : m.rule_i.m_storage) word = 0;
    rule::kCrcPoly.set(m.rule_i, 0x03);
    rule::kCrcTop.set(m.rule_i, 1U << 5U);
    rule::kCrcLast.set(m.rule_i, 5);
    rule::kTimeoutLast.set(m.rule_i, 4000 - 1);
    m.cdm_i = 0;
    m.clear_i = m.start_i = m.request_i = m.tick_i = 0;
    m.half_next_i = m.slo_i = 1;
    m.enabled_i = 1;
    reset();
  }
  void reset() {
    m.por_ni = m.rst_ni = 0;
    block_.clock();
    m.por_ni = m.rst_ni = 1;
    ma_ = true;
    arrivals_.clear();
    level_ = sent_ = true;
    last_arrival_ = 0;
    slave = {};
    slave.timeout = std::max(kTimeout, 4 * half_);
    for (unsigned i = 0; m.busy_o != 0 && i < 5000; ++i) clock();
    EXPECT_EQ(m.busy_o, 0);
  }
  std::int64_t period() const { return 2 * std::int64_t{half_} * kUnit; }

  // A frame up to the next start that is possible. The word and the eye are those of its end.
  void frame(std::uint64_t position, unsigned flags = 3) {
    const std::string data = bits_of(position, bits_) + bits_of(flags, 2);
    slave.payload = "0" + data + bits_of(~crc_of(data, 0x43) & 0x3FU, 6);
    samples.clear();
    edges.clear();
    rises.clear();
    m.start_i = 1;
    clock();
    const std::uint64_t begun = now_;
    started = now_;
    m.start_i = 0;
    while (m.frame_o != 0 && now_ < begun + 100'000) clock();
    ASSERT_EQ(m.frame_o, 0) << "the frame does not end";
    m.eval();
    answered = now_;
    while (m.busy_o != 0 && now_ < begun + 100'000) clock();
    ASSERT_EQ(m.busy_o, 0);
  }
  bool good() const { return places::axi_pkg::word_t::kGood.of(m.word_o) != 0; }
  bool crc_bad() const { return places::axi_pkg::word_t::kCrcBad.of(m.word_o) != 0; }
  std::uint64_t position() const {
    return places::axi_pkg::word_t::kPosition.of(m.word_o) |
           places::axi_pkg::more_t::kPositionHigh.get(m.more_o) << 32U;
  }
  unsigned delay_told() const {
    return static_cast<unsigned>(places::axi_pkg::result_t::kDelay.of(m.result_o));
  }
  Eye eye() const {
    using namespace places::axi_pkg::eye_t;
    if (kValid.of(m.eye_o) == 0) return {};  // the numbers are older
    return {kValid.of(m.eye_o) != 0, static_cast<unsigned>(kWidth.of(m.eye_o)),
            static_cast<unsigned>(kPoint.of(m.eye_o))};
  }
  // The eye by the samples of the frame.
  Eye expected() const {
    std::vector<bool> levels;  // the median of five samples
    for (std::size_t at = 0; at < samples.size(); ++at) {
      int ones = 0;
      for (std::size_t i = 0; i < 5; ++i) ones += at < i || samples[at - i] ? 1 : 0;
      levels.push_back(ones > 2);
    }
    std::size_t rise = 0;
    while (rise < levels.size() && levels[rise]) ++rise;
    while (rise + 2 < levels.size() && !(levels[rise] && levels[rise + 1] && levels[rise + 2])) {
      ++rise;
    }
    const unsigned period = 2 * half_;
    const std::size_t end = rise + std::size_t{period} * (slave.payload.size() + 1);
    if (end >= levels.size()) return {};
    const Gap gap = widest_gap(levels, rise, end, period);
    return {true, gap.width, gap.last - gap.width / 2};
  }

  void clock() {
    now_ += 1;
    settle();
    if (glitch_from_ <= now_ && now_ < glitch_from_ + glitch_clocks_) {
      m.slo_i = level_ ? 0 : 1;
    } else {
      m.slo_i = level_ || now_ >= cut_at ? 1 : 0;
    }
    m.tick_i = count_ == half_;
    m.half_next_i = !high_;
    samples.push_back(m.slo_i != 0);
    m.eval();
    if (m.start_i != 0) {
      count_ = 1;
      high_ = true;
    } else if (m.tick_i != 0) {
      count_ = 1;
      high_ = !high_;
    } else {
      ++count_;
    }
    block_.clock();
    const bool level = m.ma_o != 0;
    if (level != ma_) {
      slave.edge(level, now_);
      if (level) rises.push_back(now_);
    }
    ma_ = level;
    slave.step(level, now_);
    if (!silent && slave.out != sent_) arrive(slave.out);
    sent_ = slave.out;
  }
  void arrive_now(bool level) { level_ = sent_ = slave.out = level; }
  std::uint64_t now() const { return now_; }
  // SLO is inverted in these clocks.
  void glitch(std::uint64_t from, unsigned clocks) {
    glitch_from_ = from;
    glitch_clocks_ = clocks;
  }

  Block<Model> block_;
  Model& m = block_.model;
  Slave slave;
  bool silent = false;                       // SLO stays 1
  std::uint64_t cut_at = ~std::uint64_t{0};  // SLO is 1 from this clock on
  std::int64_t delay = 0;                    // round trip
  std::int64_t late_rise = 0;                // rising edges come later by this
  std::function<std::int64_t()> jitter;      // added to each edge
  std::vector<bool> samples;                 // SLO of each clock of the frame
  std::vector<std::int64_t> edges;           // instants at which SLO changed
  std::vector<std::uint64_t> rises;          // of MA in the frame
  std::uint64_t started = 0, answered = 0;

 private:
  void arrive(bool level) {
    std::int64_t due = static_cast<std::int64_t>(now_) * kUnit + delay + (level ? late_rise : 0) +
                       (jitter ? jitter() : 0);
    due = std::max(due, last_arrival_ + 1);  // no edge overtakes another
    last_arrival_ = due;
    arrivals_.push_back({due, level});
    edges.push_back(due);
  }
  void settle() {
    while (!arrivals_.empty() && arrivals_.front().at < static_cast<std::int64_t>(now_) * kUnit) {
      level_ = arrivals_.front().level;
      arrivals_.pop_front();
    }
  }
  struct Arrival {
    std::int64_t at;
    bool level;
  };
  unsigned bits_, half_;
  unsigned count_ = 0;
  bool high_ = true, ma_ = true, level_ = true, sent_ = true;
  std::deque<Arrival> arrivals_;
  std::int64_t last_arrival_ = 0;
  std::uint64_t now_ = 0;
  std::uint64_t glitch_from_ = 0;
  unsigned glitch_clocks_ = 0;
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_AXI_AXI_FRAMES_BENCH_HPP_
