// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The top biss_clb, by its pins only: AXI4-Lite, MA, SL, with an encoder behind a line delay. Its
// model is the simulator's, or what takes its place there: planted faults, coverage, a netlist.
#ifndef TESTS_BLOCK_CLB_BISS_CLB_BENCH_HPP_
#define TESTS_BLOCK_CLB_BISS_CLB_BENCH_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clb_regs.hpp"
#include "sim/core/time.hpp"
#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/masters/clb/clb_model.hpp"
#include "tests/block/biss/edge_slave.hpp"

namespace mb4test {

namespace sim = mb4::sim;

class ClbPins {
 public:
  ClbPins() {
    clocks(3);
    model_->set_reset(time_, false);
    clocks(5);
    now = 0;
  }

  void clock() {
    model_->set_inputs(time_, 0, level() ? 1 : 0);
    time_ += kClock;
    while (model_->run_clocks(time_) != sim::kNever) {
    }
    ++now;
    if (ma() != ma_before_) {
      (ma() ? rises : falls).push_back(now);
      slave.edge(ma(), now);
    }
    ma_before_ = ma();
    slave.step(ma(), now);
    if (slave.cdm_level >= 0) {
      // MA at the end of the timeout is the inverse of CDM.
      const bool cdm = slave.cdm_level == 0;
      slave.cdm_level = -1;
      cdms.push_back(cdm);
      if (after_frame) after_frame(cdm);
    }
    history_.push_front(slave.out);
    while (history_.size() > delay + 1) history_.pop_back();
    if (spi_clock() != spi_before_) (spi_clock() ? spi_rises : spi_falls).push_back(now);
    spi_before_ = spi_clock();
    EXPECT_FALSE(output(sim::ClbModel::kTxen));
  }
  void clocks(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) clock();
  }
  void write(unsigned address, std::uint32_t data, unsigned strobes = 0xF) {
    access({.write = true,
            .address = address,
            .data = data,
            .strobe = static_cast<std::uint8_t>(strobes),
            .done = false});
  }
  std::uint32_t read(unsigned address) {
    access({.address = address, .done = false});
    return model_->access().data;
  }
  bool ma() const { return output(sim::MasterModel::of_line(0, sim::kMaPin)); }
  bool irq() const { return output(sim::ClbModel::kIrq); }
  bool spi_clock() const { return output(sim::ClbModel::kSpiClk); }
  void reset(bool active) { model_->set_reset(time_, active); }

  // What the encoder sends from now on: CDS, position, nE and nW, inverted CRC.
  void set_word(std::uint64_t position, unsigned bits, unsigned flags = 3, bool cds = false,
                std::uint32_t polynomial = 0x43, std::uint32_t start = 0) {
    const std::string data = bits_of(position, bits) + bits_of(flags, 2);
    unsigned width = 0;
    while (polynomial >> (width + 1) != 0) ++width;
    const std::uint32_t crc = ~crc_of(data, polynomial, start) & ((1U << width) - 1U);
    slave.payload = (cds ? "1" : "0") + data + bits_of(crc, width);
  }
  // Half an MA period of `half` clocks (facts 2.2).
  void set_half(unsigned half) {
    namespace reg = biss_clb::regs;
    write(reg::kAddrClkCounter0Match1, half - 1);
    write(reg::kAddrClkCounter0Match2, 2 * half - 1);
    write(reg::kAddrClkCounter1Match1, half - 1);
    write(reg::kAddrClkCounter1Match2, 2 * half - 1);
    load = half - 1;
  }
  // A frame of `words` words of 12 bits, `after_start` MA clocks from START on; it begins at the
  // end of this call.
  void start(unsigned after_start, unsigned words, bool cdm = false) {
    namespace reg = biss_clb::regs;
    write(reg::kAddrClkLoadEn, 0);
    write(reg::kAddrFsmLoadEn, 0);
    write(reg::kAddrClkGpreg, 0);
    const std::uint32_t end = cdm ? 0 : reg::END_LEVEL::kMask;
    write(reg::kAddrFsmGpreg, end);
    write(reg::kAddrSpiccr, 11);
    write(reg::kAddrSpiffrx, words);
    write(reg::kAddrSpiffrx, 1U << 14U | 1U << 13U | 1U << 6U | 1U << 5U | words);
    write(reg::kAddrSpiccr, 1U << 7U | 11U);
    write(reg::kAddrFsmCounter2Match1, 12 * words);
    write(reg::kAddrFsmHlcR0, after_start);
    write(reg::kAddrClkLoadEn, reg::CLK_GLOBAL_EN::kMask);
    write(reg::kAddrFsmLoadEn, reg::FSM_GLOBAL_EN::kMask);
    rises.clear();
    falls.clear();
    spi_rises.clear();
    spi_falls.clear();
    write(reg::kAddrClkCounter0Load, load);
    write(reg::kAddrFsmGpreg, end | 1U);
    write(reg::kAddrClkGpreg, 1);
  }
  // Waits for the words and reads them; empty after `limit` clocks.
  std::vector<unsigned> words(unsigned count, std::uint64_t limit = 200'000) {
    namespace reg = biss_clb::regs;
    for (std::uint64_t end = now + limit; now < end;) {
      if ((read(reg::kAddrSpiffrx) >> 8U & 0x1FU) >= count) break;
      clocks(20);
    }
    std::vector<unsigned> found;
    while (found.size() < count && (read(reg::kAddrSpiffrx) >> 8U & 0x1FU) != 0)
      found.push_back(read(reg::kAddrSpirxbuf));
    return found;
  }
  // Bits of the words, in the order of the line.
  static std::string line(const std::vector<unsigned>& words) {
    std::string text;
    for (const unsigned word : words) text += bits_of(word, 12);
    return text;
  }
  unsigned state() { return read(biss_clb::regs::kAddrFsmState) & 3U; }

  Slave slave;
  unsigned delay = 0;              // clocks, round trip
  std::function<bool()> drive_sl;  // instead of the encoder
  std::function<void(bool cdm)> after_frame;
  std::vector<bool> cdms;
  std::vector<std::uint64_t> rises, falls, spi_rises, spi_falls;
  std::uint64_t now = 0;
  unsigned load = 9;

 private:
  static constexpr std::uint64_t kHz = 200'000'000;
  static constexpr sim::Time kClock = sim::kPsPerSecond / kHz;

  // The model evaluates every clock.
  static std::unique_ptr<sim::ClbModel> make_model() {
    sim::ChipConfig chip;
    chip.f_clk_hz = kHz;
    return sim::make_clb_model(chip, 1, true);
  }
  bool level() { return drive_sl ? drive_sl() : history_.back(); }
  bool output(sim::MasterModel::Outputs bits) const { return (model_->outputs() & bits) != 0; }
  void access(const sim::WordAccess& wanted) {
    model_->begin(wanted);
    for (int i = 0; i < 20 && !model_->access().done; ++i) clock();
    ASSERT_TRUE(model_->access().done);
    ASSERT_EQ(model_->access().answer, 0);
  }

  std::unique_ptr<sim::ClbModel> model_ = make_model();
  sim::Time time_ = 0;  // of the last falling edge of the clock
  std::deque<bool> history_{true};
  bool ma_before_ = true;
  bool spi_before_ = false;
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_CLB_BISS_CLB_BENCH_HPP_
