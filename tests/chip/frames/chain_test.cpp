// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Chains of slaves from a scenario file: 1 to 8 on one line, up to 4 on each of two, and the
// largest and smallest frames there are (pages 15, 23..26, Tables 10..16, 20).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"
#include "tests/support/wave.hpp"

namespace {

using mb4test::Chip;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const sim::BissCSlaveConfig& config_of(const sim::SlaveConfig& slave) {
  return slave.device.as<sim::BissCSlaveConfig>();
}

// SELCRCS and SCRCLEN or SCRCPOLY (Tables 13..15) for a full polynomial.
std::uint8_t crc_byte(std::uint32_t polynomial) {
  if (polynomial == 0) return 0;
  if (polynomial == 0x190D9) return 0x10;
  if (polynomial == 0x12F) return 0x08;  // its eight bits have no room in SCRCPOLY
  return static_cast<std::uint8_t>(0x80 | (polynomial >> 1U));
}

std::uint64_t low_bits(std::uint64_t value, unsigned bits) {
  return bits == 64 ? value : value & ((1ULL << bits) - 1);
}

// What the keys of the scenario file say about the word of frame number `frame`, written out from
// sim/README.md. A sine depends on the time at which the slave latches.
std::uint64_t word_of(const sim::BissCSlaveConfig& config, std::uint64_t frame, sim::Time latched) {
  const auto position = [&](std::int64_t count) {
    return low_bits(static_cast<std::uint64_t>(count) << config.flag_bits, config.data_bits) |
           config.flags;
  };
  const sim::DataSource& source = config.source;
  switch (source.kind) {
    case sim::DataSource::Kind::kConstant:
      return source.constant;
    case sim::DataSource::Kind::kRamp:
      return position(source.start + source.step * static_cast<std::int64_t>(frame));
    case sim::DataSource::Kind::kSine: {
      const double turns = static_cast<double>(latched) / static_cast<double>(source.period);
      return position(
          std::llround(source.offset + source.amplitude * std::sin(2 * std::numbers::pi * turns)));
    }
    case sim::DataSource::Kind::kList:
      return source.words[frame % source.words.size()];
  }
  return 0;
}

// A chip with these channels' slaves set up by hand; FREQAGS = AGSMIN.
class ChainBench {
 public:
  explicit ChainBench(const sim::Scenario& scenario)
      : simulator(mb4test::with_test_host(scenario), mb4test::with_wave()), scenario_(scenario) {
    const bool two = scenario.channel(2) != nullptr;
    for (const sim::ChannelConfig& channel : scenario.channels) {
      unsigned x = channel.number == 1 ? 0 : 4;
      for (const sim::SlaveConfig& slave : channel.slaves) {
        const auto& crc = config_of(slave).crc;
        spi({reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(++x),
             static_cast<std::uint8_t>(reg::kEnscdYes | (slave.data_bits() - 1)),
             crc_byte(crc.polynomial), static_cast<std::uint8_t>(crc.start & 0xFF),
             static_cast<std::uint8_t>(crc.start >> 8)});
      }
    }
    spi({reg::kSpiOpcodeWriteRegisters, reg::kAddrCtrl, reg::kRegversBissC, reg::FREQR::of(5),
         reg::kNocrcDropped, reg::kFreqagsAgsMin});
    spi({reg::kSpiOpcodeWriteRegisters, reg::kAddrSlaveloc5,
         static_cast<std::uint8_t>(two ? reg::kResetSlaveloc5 | reg::kSlaveloc5Split
                                       : reg::kResetSlaveloc5),
         static_cast<std::uint8_t>(two ? reg::kCfgch2BissC | reg::kCfgch1BissC
                                       : reg::kCfgch2Unused | reg::kCfgch1BissC)});
  }

  std::vector<std::uint8_t> spi(const std::vector<std::uint8_t>& tx) {
    std::vector<std::uint8_t> rx(tx.size());
    bus.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
    return rx;
  }

  // One frame; compares edges, flags and all words. `frame` counts from 0.
  void check_frame(std::uint64_t frame) {
    spi({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
    simulator.advance(400 * sim::kPsPerNs);
    ASSERT_TRUE(simulator.run_while_waiting([&] { return simulator.pin(sim::Pin::kEot); },
                                            simulator.now() + sim::kPsPerSecond));
    const auto status = spi({reg::kSpiOpcodeReadStatus, 0, 0, 0});
    std::vector<std::uint8_t> memory = spi([] {
      std::vector<std::uint8_t> tx(65, 0);
      tx[0] = reg::kSpiOpcodeReadRegisters0;
      return tx;
    }());
    unsigned valid = 0;
    for (const sim::ChannelConfig& channel : scenario_.channels) {
      unsigned bits = 0;
      unsigned x = channel.number == 1 ? 0 : 4;
      const auto ma = clocked(simulator.line(channel.number))->monitor().last(simulator.now());
      const sim::Time latched = ma.start + 50 * sim::kPsPerNs + channel.cable->delay / 2;
      for (const sim::SlaveConfig& slave : channel.slaves) {
        const sim::BissCSlaveConfig& config = config_of(slave);
        bits += config.data_bits + config.crc.width();
        std::uint64_t word = 0;
        for (unsigned byte = 0; byte < (config.data_bits + 7) / 8; ++byte) {
          word |= std::uint64_t{memory[1 + 8 * x + byte]} << (8 * byte);
        }
        EXPECT_EQ(word, word_of(config, frame, latched))
            << "channel " << channel.number << " slave " << x + 1 << " frame " << frame;
        valid |= 2U << (2 * x);
        ++x;
      }
      // Page 15: N + 5 edges and the processing time of the last slave. If the start bit needs
      // longer for its way than the word, the edges until it is recognised (decision 17), which
      // takes two periods (docs/timing.md).
      const unsigned busy = config_of(channel.slaves.back()).busy_periods;
      const auto way = static_cast<unsigned>(channel.cable->delay / (100 * sim::kPsPerNs));
      if (way <= bits) {
        EXPECT_EQ(ma.rising, bits + 5 + busy) << "channel " << channel.number;
      } else {
        EXPECT_GE(ma.rising, 3 + busy + way) << "channel " << channel.number;
        EXPECT_LE(ma.rising, 3 + busy + way + 2) << "channel " << channel.number;
      }
    }
    EXPECT_EQ(status[1], reg::kResetStatus0);
    EXPECT_EQ(status[2] | status[3] << 8U, valid);
  }

  sim::Simulator simulator;
  mb4::tool::SimBus bus{simulator};

 private:
  sim::Scenario scenario_;
};

sim::Scenario chain_of_eight() { return sim::load_scenario(MB4_SCENARIOS "/chain-8.toml"); }

TEST(ChipChain, OneToEightSlavesOnOneLine_EveryWordIsRight) {
  for (std::size_t count = 1; count <= 8; ++count) {
    sim::Scenario scenario = chain_of_eight();
    scenario.channels[0].slaves.resize(count);
    SCOPED_TRACE(count);
    ChainBench bench(scenario);
    for (std::uint64_t frame = 0; frame < 8; ++frame) bench.check_frame(frame);
  }
}

// With SLAVELOC5 = 1 slaves 5 to 8 are on line 2, which may be the longer or the shorter one.
TEST(ChipChain, UpToFourSlavesOnEachOfTwoLines_EveryWordIsRight) {
  for (std::size_t first = 1; first <= 4; ++first) {
    for (std::size_t second = 1; second <= 4; ++second) {
      sim::Scenario scenario = chain_of_eight();
      sim::ChannelConfig line2 = scenario.channels[0];
      line2.number = 2;
      line2.cable->delay = 700 * sim::kPsPerNs;
      line2.slaves.erase(line2.slaves.begin(), line2.slaves.begin() + 4);
      line2.slaves.resize(second);
      scenario.channels[0].slaves.resize(first);
      scenario.channels.push_back(line2);
      SCOPED_TRACE(std::to_string(first) + "+" + std::to_string(second));
      ChainBench bench(scenario);
      for (std::uint64_t frame = 0; frame < 6; ++frame) bench.check_frame(frame);
    }
  }
}

// Eight sensors of 64 data bits and 16 CRC bits, the most that the registers can say, at
// f_CLK / 2; on one line 640 bits a frame.
TEST(ChipChain, LargestConfiguration_OneLineAndTwo) {
  for (const bool two : {false, true}) {
    std::string text;
    std::uint64_t word = 0x0123456789ABCDEFULL;
    for (unsigned x = 0; x < 8; ++x) {
      if (x == 0 || (two && x == 4)) {
        text += std::string("[[channel]]\ndelay_ns = 250.0\nnumber = ") + (x == 0 ? "1" : "2");
      }
      word = word * 6364136223846793005ULL + 1442695040888963407ULL;
      text += "\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 64\nflag_bits = 0\n";
      text += "crc = 0x190D9\ncrc_start = " + std::to_string(0x1111 * x) + "\ndata = \"" +
              std::to_string(word) + "\"\n";
    }
    ChainBench bench(sim::parse_scenario(text, "largest.toml"));
    for (std::uint64_t frame = 0; frame < 4; ++frame) bench.check_frame(frame);
    // And a fault in the very last bit of each line is seen.
    for (const unsigned line : {1U, two ? 2U : 1U}) {
      clocked(bench.simulator.line(line))->faults().flip_next_frame({two ? 321U : 641U});
      bench.spi({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
      bench.simulator.advance(200 * sim::kPsPerUs);
      const auto status = bench.spi({reg::kSpiOpcodeReadStatus, 0, 0, 0});
      EXPECT_EQ(status[1], reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nSCDERR::kMask));
      EXPECT_EQ(status[2], line == 1 && two ? 0x2A : 0xAA);
      EXPECT_EQ(status[3], line == 1 && two ? 0xAA : 0x2A);
    }
  }
}

// One sensor of one bit without CRC, on one line and on each of two: six edges at f_CLK / 2.
TEST(ChipChain, SmallestConfiguration_OneBit) {
  for (const bool two : {false, true}) {
    for (const char* bit : {"0", "1"}) {
      std::string text;
      for (const char* number : {"1", "2"}) {
        text += std::string("[[channel]]\nnumber = ") + number +
                "\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 1\nflag_bits = 0\n"
                "crc = 0\ndata = " +
                bit + "\n";
        if (!two) break;
      }
      ChainBench bench(sim::parse_scenario(text, "smallest.toml"));
      for (std::uint64_t frame = 0; frame < 4; ++frame) {
        bench.check_frame(frame);
        for (const unsigned line : {1U, two ? 2U : 1U}) {
          EXPECT_EQ(
              clocked(bench.simulator.line(line))->monitor().last(bench.simulator.now()).rising,
              6U);
        }
      }
    }
  }
}

// Table 10: without SLAVELOC5 all data channels are on line 1; line 2 rests for any CFGCH2.
TEST(ChipChain, NoSlaveloc5_Line2Rests) {
  ChainBench bench(chain_of_eight());
  bench.spi({reg::kSpiOpcodeWriteRegisters, reg::kAddrSlaveloc5, reg::kResetSlaveloc5,
             reg::kCfgch2BissC | reg::kCfgch1BissC});
  for (std::uint64_t frame = 0; frame < 4; ++frame) bench.check_frame(frame);
  EXPECT_EQ(ma_check(bench.simulator.line_end(2)).pulses(), 0U);
  EXPECT_TRUE(bench.simulator.pin(sim::Pin::kMa2));
}

}  // namespace
