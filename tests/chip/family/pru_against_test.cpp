// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The same encoder on the same cable, read by biss_pru and by the three other masters.
#include <string>

#include "sim/lines/crc.hpp"
#include "tests/chip/family/readers.hpp"
#include "tests/chip/pru/pru_sim.hpp"

namespace mb4test::family {
namespace {

constexpr unsigned kTail = 8;

Words through_pru(const Line& line) {
  PruSim pru(pru_scenario(line.text()));
  PruFrame frame = pru.start(line.bits, kTail, line.mhz);
  Words words;
  while (true) {
    if ((frame.flags() & ~kPruAverage) != 0) break;
    words[pru.simulator.slave(1)->frames()] = frame.word();
    if (words.size() == kFrames) break;
    frame = pru.frame();
  }
  return words;
}

class PruAgainst : public testing::TestWithParam<std::pair<const char*, unsigned>> {};

TEST_P(PruAgainst, TheThreeOthers_TheWordsAreTheSame) {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    for (unsigned metres = 0; metres <= 100; metres += 10) {
      const Line line{GetParam().first, GetParam().second, metres, mhz};
      SCOPED_TRACE(std::to_string(mhz) + " MHz, " + std::to_string(metres) + " m");
      const Words mb4 = through_mb4(line);
      const Words pru = through_pru(line);
      ASSERT_EQ(pru.size(), kFrames);
      ASSERT_EQ(pru, through_axi(line));
      ASSERT_EQ(pru, through_clb(line));
      ASSERT_GE(mb4.size(), 3U);
      for (const auto& [frame, word] : mb4) ASSERT_EQ(word, pru.at(frame)) << "frame " << frame;
      // The ramp itself, without errors.
      for (const auto& [frame, word] : pru) ASSERT_EQ(word, line.word(frame));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, PruAgainst,
                         testing::Values(std::pair{"resolute-26", 26U}, std::pair{"lika-sma1", 24U},
                                         std::pair{"wachendorff-wdgf58m", 12U}),
                         [](const auto& test) {
                           return "Bits" + std::to_string(test.param.second);
                         });

// CDM bits of an access to one register of ID 0, behind START (protocol facts, 3.1).
class PruWay final : public Way {
 public:
  PruWay() { pru_.start(24, kTail, 5); }
  bool write(std::uint8_t address, std::uint8_t value) override {
    const std::uint32_t data = std::uint32_t{value} << 6U | crc4(value, 8) << 2U;
    return pru_.access(header(address) | 3U << 14U | data) == value;
  }
  std::optional<std::uint8_t> read(std::uint8_t address) override {
    return pru_.access(header(address) | 5U << 14U);
  }
  sim::Simulator& simulator() override { return pru_.simulator; }

 private:
  static std::uint32_t crc4(std::uint32_t value, unsigned bits) {
    return sim::Crc{.polynomial = 0x13}.line_bits(value, bits);
  }
  static std::uint32_t header(std::uint8_t address) {
    const std::uint32_t bits = 1U << 10U | address;
    return bits << 21U | crc4(bits, 11) << 17U;
  }
  PruSim pru_{pru_scenario(kRegisters)};
};

TEST(PruAgainst, RegisterWrittenThroughOneMaster_ReadsTheSameThroughEach) {
  Mb4Way mb4;
  AxiWay axi;
  ClbWay clb;
  PruWay pru;
  exchange_registers(std::array<Way*, 4>{&mb4, &axi, &clb, &pru});
}

}  // namespace
}  // namespace mb4test::family
