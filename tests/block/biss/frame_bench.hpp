// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Drives frame_top (one line without registers) and acts as a BiSS C slave behind a line delay.
#ifndef TESTS_BLOCK_BISS_FRAME_BENCH_HPP_
#define TESTS_BLOCK_BISS_FRAME_BENCH_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "Vframe_top.h"
#include "sim/lines/clocked/ma_pulse_check.hpp"
#include "tests/block/biss/edge_slave.hpp"
#include "tests/support/model_context.hpp"

namespace mb4test {

// Model: frame_top, or a smaller instance of it.
template <typename Model>
class FrameBenchOf {
 public:
  static constexpr std::uint64_t kSub = 16;  // time steps in a clock

  FrameBenchOf() {
    model->clk_i = 0;
    model->rst_ni = 0;
    model->freqs_i = 0;
    model->nocrc_i = 0;
    model->start_i = 0;
    model->init_i = 0;
    model->protocol_i = 1;  // BiSS C
    model->cdm_i = 0;
    model->hold_cdm_i = 0;
    model->abort_i = 0;
    model->sl_i = 1;
    for (int i = 0; i < 8; ++i) model->slave_cfg_i[i] = 0;
    clocks(2);
    model->rst_ni = 1;
    clocks(2);
  }

  // Datasheet 0xC0..0xC3 of one data channel: SCDLEN = bits - 1, ENSCD, CRC code, start value.
  void configure(unsigned slave, unsigned data_bits, std::uint32_t crc_byte,
                 std::uint32_t crc_start = 0) {
    model->slave_cfg_i[slave] = (crc_start << 16) | (crc_byte << 8) | 0x40U | (data_bits - 1);
  }

  struct Result {
    std::vector<std::uint64_t> rises;  // time of MA edges in sixteenths of a clock
    std::vector<std::uint64_t> falls;
    std::uint64_t end_time = 0;  // of line_end_o
    bool ended = false;
    bool idle = false;
    int ma_in_timeout = -1;
    bool cds = false;
    std::uint8_t memory[8][8];
    bool written[8][8];
    unsigned words = 0;
    unsigned good = 0;
  };

  // Starts a frame and runs until idle or `max_clocks`.
  Result run(Slave& slave, std::uint64_t delay_sub, std::uint64_t max_clocks = 400000) {
    result_ = Result{};
    for (auto& row : result_.written)
      for (bool& w : row) w = false;
    slave_ = &slave;
    delay_out_ = delay_sub / 2;
    delay_back_ = delay_sub - delay_out_;
    recording_ = true;
    model->start_i = 1;
    clocks(1);
    model->start_i = 0;
    for (std::uint64_t i = 0; i < max_clocks && !(model->idle_o != 0); ++i) clocks(1);
    result_.idle = model->idle_o != 0;
    result_.cds = model->cds_o != 0;
    recording_ = false;
    slave_ = nullptr;
    return result_;
  }

  void clocks(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      half_clock(1);
      half_clock(0);
    }
  }

  std::uint64_t now() const { return time_; }
  Owned<Model> model;

 private:
  void half_clock(int level) {
    // Line and slave first: SL before the edge is what the edge samples.
    for (std::uint64_t i = 0; i < kSub / 2; ++i) {
      ++time_;
      if (slave_ == nullptr) continue;
      while (!to_slave_.empty() && to_slave_.front().first <= time_) {
        slave_ma_ = to_slave_.front().second;
        slave_->edge(slave_ma_, time_);
        to_slave_.pop_front();
      }
      slave_->step(slave_ma_, time_);
      if (slave_->out != last_out_) {
        last_out_ = slave_->out;
        to_master_.push_back({time_ + delay_back_, last_out_});
      }
      while (!to_master_.empty() && to_master_.front().first <= time_) {
        model->sl_i = to_master_.front().second ? 1 : 0;
        to_master_.pop_front();
      }
    }
    if (level == 1 && recording_) sample();
    if (level == 1) ++clocks_;
    model->clk_i = static_cast<std::uint8_t>(level);
    model->eval();
    if (model->ma_o != last_ma_) {
      last_ma_ = model->ma_o;
      const auto complaint = ma_check_.edge(time_, last_ma_ != 0, clocks_, half_clocks(), kSub);
      if (complaint) ADD_FAILURE() << *complaint << " (16 steps a clock)";
      if (recording_) (last_ma_ != 0 ? result_.rises : result_.falls).push_back(time_);
      if (slave_ != nullptr) to_slave_.push_back({time_ + delay_out_, last_ma_ != 0});
    }
  }

  // Table 35 (0x10 is not permitted).
  unsigned half_clocks() {
    return model->freqs_i < 0x10 ? model->freqs_i + 1U : 10U * (model->freqs_i - 15U);
  }

  // Outputs are combinational: taken just before the rising edge, as the registers do.
  void sample() {
    model->eval();
    if (model->wr_en_o != 0) {
      result_.memory[model->slave_o][model->wr_byte_o] = model->wr_data_o;
      result_.written[model->slave_o][model->wr_byte_o] = true;
    }
    if (model->word_done_o != 0) {
      ++result_.words;
      if (model->word_ok_o != 0) ++result_.good;
    }
    if (model->line_end_o != 0) {
      result_.ended = true;
      result_.end_time = time_;
    }
    if (model->timeout_o != 0 && model->idle_o == 0 && model->sl_i == 0) {
      result_.ma_in_timeout = model->ma_o;
    }
  }

  Slave* slave_ = nullptr;
  std::uint64_t time_ = 0;
  std::uint64_t delay_out_ = 0;
  std::uint64_t delay_back_ = 0;
  std::deque<std::pair<std::uint64_t, bool>> to_slave_;
  std::deque<std::pair<std::uint64_t, bool>> to_master_;
  bool slave_ma_ = true;
  bool last_out_ = true;
  std::uint8_t last_ma_ = 1;
  std::uint64_t clocks_ = 0;
  mb4::sim::MaPulseCheck ma_check_;
  bool recording_ = false;
  Result result_{};
};

using FrameBench = FrameBenchOf<Vframe_top>;

}  // namespace mb4test

#endif  // TESTS_BLOCK_BISS_FRAME_BENCH_HPP_
