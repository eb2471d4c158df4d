// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The top biss_axi, by its pins only: AXI4-Lite, stream, MA and SLO, with an encoder on each
// channel.
#ifndef TESTS_BLOCK_AXI_BISS_AXI_BENCH_HPP_
#define TESTS_BLOCK_AXI_BISS_AXI_BENCH_HPP_

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "axi_regs.hpp"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/support/model_context.hpp"

namespace mb4test {

struct AxiBeat {
  std::vector<std::uint64_t> words;  // mode 0: one for each channel
  std::uint32_t user = 0;
  bool last = false;
};

template <typename Model, unsigned kChannels>
class BissAxiBench {
 public:
  enum class Wire { kEncoder, kHigh, kLow };
  static constexpr unsigned kLongestLimit = 8000;  // TIMEOUT_LIMIT of the tops here

  struct Encoder {
    Slave slave;
    unsigned delay = 0;  // clocks, round trip
    Wire wire = Wire::kEncoder;
    std::deque<bool> history{true};
    bool ma = true;
    std::vector<std::uint64_t> rises, falls;
  };

  BissAxiBench() {
    m.axi_aclk = 0;
    m.axi_aresetn = m.por_n = 0;
    m.S_AXI_AWVALID = m.S_AXI_WVALID = m.S_AXI_ARVALID = 0;
    m.S_AXI_BREADY = m.S_AXI_RREADY = 1;
    m.S_AXI_WSTRB = 0xF;
    m.s_axis_tready = 1;
    m.ext_sample_clk = 0;
    m.sample_en = 1;
    m.slo = (1U << kChannels) - 1;
    m.eval();  // what the first call finds is no edge
    // The reset reaches the flops with the first clock.
    m.contextp()->assertOn(false);
    clocks(3);
    m.contextp()->assertOn(true);
    beats.clear();
    m.axi_aresetn = m.por_n = 1;
    clocks(kLongestLimit + 10);  // a reset holds starts back
  }

  void clock() {
    unsigned slo = 0;
    for (unsigned c = 0; c < kChannels; ++c) {
      const Encoder& encoder = encoders[c];
      const bool level =
          encoder.wire == Wire::kHigh || (encoder.wire == Wire::kEncoder && encoder.history.back());
      slo |= (level ? 1U : 0U) << c;
    }
    m.slo = static_cast<std::uint8_t>(slo);
    m.eval();
    if (m.s_axis_tvalid != 0 && m.s_axis_tready != 0) take_beat();
    m.axi_aclk = 1;
    m.eval();
    m.axi_aclk = 0;
    m.eval();
    ++now;
    for (unsigned c = 0; c < kChannels; ++c) {
      Encoder& encoder = encoders[c];
      const bool level = (m.ma >> c & 1U) != 0;
      if (level != encoder.ma) {
        (level ? encoder.rises : encoder.falls).push_back(now);
        encoder.slave.edge(level, now);
      }
      encoder.ma = level;
      encoder.slave.step(level, now);
      encoder.history.push_front(encoder.slave.out);
      while (encoder.history.size() > encoder.delay + 1) encoder.history.pop_back();
    }
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  void write(unsigned address, std::uint32_t data) {
    m.S_AXI_AWADDR = static_cast<std::uint8_t>(address);
    m.S_AXI_WDATA = data;
    m.S_AXI_AWVALID = m.S_AXI_WVALID = 1;
    for (int i = 0; i < 20 && (m.S_AXI_AWVALID != 0 || m.S_AXI_WVALID != 0); ++i) {
      m.eval();
      const bool address_taken = m.S_AXI_AWREADY != 0;
      const bool data_taken = m.S_AXI_WREADY != 0;
      clock();
      if (address_taken) m.S_AXI_AWVALID = 0;
      if (data_taken) m.S_AXI_WVALID = 0;
    }
    for (int i = 0; i < 20 && m.S_AXI_BVALID == 0; ++i) clock();
    ASSERT_EQ(m.S_AXI_BVALID, 1);
    ASSERT_EQ(m.S_AXI_BRESP, 0);
    clock();
  }
  std::uint32_t read(unsigned address) {
    m.S_AXI_ARADDR = static_cast<std::uint8_t>(address);
    m.S_AXI_ARVALID = 1;
    for (int i = 0; i < 20 && m.S_AXI_ARVALID != 0; ++i) {
      m.eval();
      const bool taken = m.S_AXI_ARREADY != 0;
      clock();
      if (taken) m.S_AXI_ARVALID = 0;
    }
    for (int i = 0; i < 20 && m.S_AXI_RVALID == 0; ++i) clock();
    EXPECT_EQ(m.S_AXI_RVALID, 1);
    const std::uint32_t data = m.S_AXI_RDATA;
    clock();
    return data;
  }
  std::uint32_t read(unsigned channel, unsigned address) {
    write(biss_axi::regs::kAddrChannelIndex, channel);
    return read(address);
  }
  // Position and flags (nE, nW) that the encoder sends from now on, with their CRC.
  void set_word(unsigned channel, std::uint64_t position, unsigned bits, unsigned flags = 3,
                std::uint32_t polynomial = 0x43, std::uint32_t start = 0, bool cds = false) {
    std::string data = bits_of(position, bits) + bits_of(flags, 2);
    unsigned width = 0;
    while (polynomial >> (width + 1) != 0) ++width;
    const std::uint32_t crc = ~crc_of(data, polynomial, start) & ((1U << width) - 1U);
    encoders[channel].slave.payload = (cds ? "1" : "0") + data + bits_of(crc, width);
  }
  // Single-point mode, all channels, CRC checked.
  void set_up(unsigned bits, unsigned divider, unsigned timeout) {
    namespace reg = biss_axi::regs;
    write(reg::kAddrMode, 1);
    write(reg::kAddrMaDivider, divider);
    write(reg::kAddrPositionBits, bits);
    write(reg::kAddrCrcCheck, 1);
    write(reg::kAddrChannelEnable, (1U << kChannels) - 1U);
    for (Encoder& encoder : encoders) encoder.slave.timeout = timeout;
  }
  void request() {
    write(biss_axi::regs::kAddrRequest, 0);
    write(biss_axi::regs::kAddrRequest, 1);
  }
  // A request and `duration` clocks. The beats are those that come then.
  void frame(unsigned duration) {
    beats.clear();
    request();
    clocks(duration);
  }

  Owned<Model> owner;
  Model& m = *owner;
  std::array<Encoder, kChannels> encoders;
  std::vector<AxiBeat> beats;
  std::uint64_t now = 0;

 private:
  void take_beat() {
    AxiBeat& beat = beats.emplace_back();
    beat.user = m.s_axis_tuser;
    beat.last = m.s_axis_tlast != 0;
    if constexpr (requires { m.s_axis_tdata.m_storage; }) {
      for (const std::uint32_t word : m.s_axis_tdata.m_storage) beat.words.push_back(word);
    } else {
      beat.words.push_back(m.s_axis_tdata);
    }
  }
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_AXI_BISS_AXI_BENCH_HPP_
