// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The top biss_clb, by its pins only: AXI4-Lite, MA, SL, with an encoder behind a line delay.
#ifndef TESTS_BLOCK_CLB_BISS_CLB_BENCH_HPP_
#define TESTS_BLOCK_CLB_BISS_CLB_BENCH_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "Vbiss_clb.h"
#include "clb_regs.hpp"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/support/model_context.hpp"

namespace mb4test {

class ClbBench {
 public:
  ClbBench() {
    m.clk_i = m.rst_ni = 0;
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    m.s_axi_bready = m.s_axi_rready = 1;
    m.s_axi_wstrb = 0xF;
    m.sl_i = 1;
    m.eval();  // what the first call finds is no edge
    for (int i = 0; i < 3; ++i) clock();
    m.rst_ni = 1;
    for (int i = 0; i < 5; ++i) clock();
    now = 0;
  }

  void clock() {
    m.sl_i = level() ? 1 : 0;
    m.eval();
    m.clk_i = 1;
    m.eval();
    m.clk_i = 0;
    m.eval();
    ++now;
    const bool ma = m.ma_o != 0;
    if (ma != ma_before) {
      (ma ? rises : falls).push_back(now);
      slave.edge(ma, now);
    }
    ma_before = ma;
    slave.step(ma, now);
    if (slave.cdm_level >= 0) {
      // MA at the end of the timeout is the inverse of CDM.
      const bool cdm = slave.cdm_level == 0;
      slave.cdm_level = -1;
      cdms.push_back(cdm);
      if (after_frame) after_frame(cdm);
    }
    history.push_front(slave.out);
    while (history.size() > delay + 1) history.pop_back();
    const bool spi_clock = m.spi_clk_o != 0;
    if (spi_clock && !spi_before) spi_rises.push_back(now);
    spi_before = spi_clock;
    EXPECT_EQ(m.txen_o, 0);
  }
  void clocks(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) clock();
  }
  void write(unsigned address, std::uint32_t data, unsigned strobes = 0xF) {
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
  std::uint32_t read(unsigned address) {
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
    write(reg::kAddrClkLoadEn, 1);
    write(reg::kAddrFsmLoadEn, 1);
    rises.clear();
    falls.clear();
    spi_rises.clear();
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

  Owned<Vbiss_clb> owner;
  Vbiss_clb& m = *owner;
  Slave slave;
  unsigned delay = 0;              // clocks, round trip
  std::function<bool()> drive_sl;  // instead of the encoder
  std::function<void(bool cdm)> after_frame;
  std::vector<bool> cdms;
  std::vector<std::uint64_t> rises, falls, spi_rises;
  std::uint64_t now = 0;
  unsigned load = 9;

 private:
  bool level() { return drive_sl ? drive_sl() : history.back(); }
  std::deque<bool> history{true};
  bool ma_before = true;
  bool spi_before = false;
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_CLB_BISS_CLB_BENCH_HPP_
