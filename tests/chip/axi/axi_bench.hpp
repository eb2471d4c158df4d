// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The BiSS C master on AXI with encoders behind cables, for tests that set its registers directly.
#ifndef TESTS_CHIP_AXI_BENCH_HPP_
#define TESTS_CHIP_AXI_BENCH_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "axi_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/masters/axi/live_axi.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/wave.hpp"

namespace mb4test {

namespace axireg = biss_axi::regs;
namespace sim = mb4::sim;

// An encoder of a channel. Its word has `bits` of position, then nE and nW.
struct AxiEncoder {
  unsigned bits = 26;
  double delay_ns = 0;     // round trip
  std::string keys = "";   // further keys of [[channel]]
  std::string slave = "";  // further keys of [[channel.slave]]
};

inline std::string axi_scenario(const std::vector<AxiEncoder>& encoders,
                                std::uint64_t f_clk_hz = 100'000'000, const std::string& rest = "",
                                const std::string& quirks = "") {
  std::string text = "[master]\ntype = \"axi\"\n[chip]\nf_clk_hz = " + std::to_string(f_clk_hz) +
                     "\n[chip.quirks]\n" + quirks + rest;
  unsigned number = 1;
  for (const AxiEncoder& encoder : encoders) {
    text += "[[channel]]\nnumber = " + std::to_string(number++) +
            "\ndelay_ns = " + std::to_string(encoder.delay_ns) + "\n" + encoder.keys +
            "[[channel.slave]]\nprotocol = \"biss-c\"\ncrc = 0x43\ndata_bits = " +
            std::to_string(encoder.bits + 2) + "\n" + encoder.slave;
  }
  return text;
}

// The same with [chip] features = "full" or "frames".
inline std::string with_features(std::string scenario, const std::string& features) {
  scenario.insert(scenario.find("f_clk_hz"), "features = \"" + features + "\"\n");
  return scenario;
}

// The position with nE = nW = 1 as the encoder sends it.
constexpr std::uint64_t raw_word(std::uint64_t position) { return position << 2U | 3U; }

class AxiBench {
 public:
  static constexpr unsigned kTimeoutLimit = 4000;  // parameter TIMEOUT_LIMIT, clocks

  explicit AxiBench(const std::string& scenario)
      : simulator(sim::parse_scenario(scenario, "test.toml"), mb4test::with_wave()),
        host(simulator.host<sim::AxiHost>("axi")),
        period(sim::kPsPerSecond / simulator.scenario().chip.f_clk_hz) {
    simulator.advance(kTimeoutLimit * period);  // a reset holds starts back
  }

  void write(std::uint8_t address, std::uint32_t data) {
    EXPECT_EQ(host.write(address, data), std::uint8_t{0});
  }
  std::uint32_t read(std::uint8_t address) {
    std::uint32_t data = 0;
    EXPECT_EQ(host.read(address, data), std::uint8_t{0});
    return data;
  }
  // A register of one channel.
  std::uint32_t read(unsigned channel, std::uint8_t address) {
    write(axireg::kAddrChannelIndex, channel);
    return read(address);
  }

  // All channels of the scenario, CRC checked, single-point mode.
  void set_up(unsigned bits, unsigned ma_divider) {
    // Before the channels are enabled: the internal sample clock always runs.
    write(axireg::kAddrMode, 1);
    write(axireg::kAddrPositionBits, bits);
    write(axireg::kAddrMaDivider, ma_divider);
    write(axireg::kAddrCrcCheck, 1);
    write(axireg::kAddrChannelEnable, (1U << simulator.scenario().channels.size()) - 1);
  }
  // A rising edge at 0x0C.
  void request() {
    write(axireg::kAddrRequest, 0);
    write(axireg::kAddrRequest, 1);
  }
  // A request, its frames and the encoders' timeouts. Returns the beat, if there was exactly one.
  std::optional<sim::StreamBeat> frame(sim::Time duration = 100 * sim::kPsPerUs) {
    while (host.next_beat()) {
    }
    request();
    simulator.advance(duration);
    if (host.beats_waiting() != 1) return std::nullopt;
    return host.next_beat();
  }
  bool pin(const char* name) { return simulator.pin(*simulator.pin_by_name(name)); }
  void set_pin(const char* name, bool level) {
    simulator.set_pin(*simulator.pin_by_name(name), level);
  }
  std::uint64_t frames(unsigned slave) { return simulator.slave(slave)->frames(); }

  sim::Simulator simulator;
  sim::AxiHost& host;
  sim::Time period;  // of the clock, ps
};

// A frame of channel 1 whose SL stands at `level` ("0" or "1"): no CRC of a frame before is shown.
inline void expect_frame_without_crc(AxiBench& bench, const std::string& level) {
  bench.simulator.inject(
      "[[fault]]\nkind = \"stuck\"\nchannel = 1\nat_us = 1\nfor_us = 60\nlevel = " + level + "\n");
  bench.simulator.advance(5 * sim::kPsPerUs);
  ASSERT_TRUE(bench.frame()) << level;
  EXPECT_EQ(bench.read(axireg::kAddrReceivedCrc), 0U) << level;
  EXPECT_EQ(bench.read(axireg::kAddrCalculatedCrc), 0U) << level;
}

// The words of a driver.
struct AxiPort {
  AxiBench& bench;
  bool write(std::uint32_t offset, std::uint32_t value) const {
    return bench.host.write(static_cast<std::uint8_t>(offset), value) == std::uint8_t{0};
  }
  bool read(std::uint32_t offset, std::uint32_t& value) const {
    return bench.host.read(static_cast<std::uint8_t>(offset), value) == std::uint8_t{0};
  }
};

}  // namespace mb4test

#endif  // TESTS_CHIP_AXI_BENCH_HPP_
