// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A bus with MO (datasheet pages 15, 25, 31; docs/theory.md, MO and actuators): the master acts as
// one more slave at the far end. It acknowledges with rising edge 2, sends its start bit MO_BUSY
// periods later than a slave could, then CDS = 0, then the words (slave 1 first), then 1.
#include "sim/lines/clocked/actuator.hpp"

#include <gtest/gtest.h>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/unit/lines/clocked/chain_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kPeriod = 200 * kPsPerNs;

BissCSlaveConfig actuator(unsigned data_bits, std::uint32_t polynomial, bool stop_bit = true) {
  BissCSlaveConfig config = constant_slave(data_bits, 0, polynomial);
  config.actuator = true;
  config.stop_bit = stop_bit;
  return config;
}

// A word as it stands on the line: stop bit, data, inverted CRC.
std::string line_word(std::uint64_t word, const BissCSlaveConfig& config) {
  return std::string(config.actuator && config.stop_bit ? "0" : "") +
         binary(word, config.data_bits) +
         binary(config.crc.line_bits(word, config.data_bits), config.crc.width());
}

// A line with a bus connection, driven at the chip's pins.
class BusBench {
 public:
  explicit BusBench(Time round_trip = 0, Time mo_late = 0)
      : line(
            queue, cable(round_trip, mo_late), [](Time, void*, bool) {}, nullptr) {
    line.drive(0, true, true);
  }
  BissCSlave& add(const BissCSlaveConfig& config) {
    auto slave = std::make_unique<BissCSlave>(config, 1);
    BissCSlave& reference = *slave;
    line.add(std::move(slave));
    return reference;
  }
  void run_until(Time time) {
    while (queue.next_time() <= time) queue.run_next();
    now = time;
  }
  // One frame with `words` on MO; returns SL, read `sample_after` each rising edge from the first.
  std::string frame(const std::string& words, unsigned mo_busy = 0, bool cdm = false,
                    unsigned more_edges = 0) {
    const std::string mo = "1" + std::string(1 + mo_busy, '0') + "10" + words + "1";
    const Time start = now + 2 * kPeriod;
    std::string sl;
    run_until(start);
    line.drive(start, false, true);
    const auto edges = static_cast<unsigned>(mo.size()) + more_edges;
    for (unsigned n = 0; n < edges; ++n) {
      const Time rise = start + n * kPeriod + kPeriod / 2;
      run_until(rise);
      queue.post(rise + line.round_trip() + sample_after, [&] { sl += line.sl() ? '1' : '0'; });
      line.drive(rise, true, n >= mo.size() || mo[n] == '1');
      const Time fall = rise + kPeriod / 2;
      run_until(fall);
      if (n + 1 < edges || cdm) line.drive(fall, false, n >= mo.size() || mo[n] == '1');
    }
    run_until(now + 20 * kPeriod + line.round_trip());
    line.drive(now, true, true);
    run_until(now + 20 * kPeriod + line.round_trip());
    EXPECT_TRUE(line.chain().idle());
    EXPECT_TRUE(line.sl());
    return sl;
  }

  static ClockedConfig cable(Time round_trip, Time mo_late) {
    ClockedConfig config;
    config.delay = round_trip;
    config.mo = true;
    config.mo_late = mo_late;
    return config;
  }

  EventQueue queue;
  ClockedLine line;
  Time now = 0;
  Time sample_after = kPeriod - 1;
};

// The word appears in the slave exactly as sent; SL meanwhile shows what it had before.
TEST(Actuator, OneWord_IsTakenAtTheEndOfTheFrame) {
  BusBench bench;
  const BissCSlaveConfig config = actuator(12, 0x43);
  auto& slave = bench.add(config);
  const std::string first = line_word(0xA5C, config);
  const std::string second = line_word(0x3F1, config);
  const std::string old = line_word(0, config);
  // After its own word a slave sends what came in: the stop bit of MO.
  EXPECT_EQ(bench.frame(first), "1010" + old + "0");
  EXPECT_EQ(slave.actuator()->word(), 0xA5CU);
  EXPECT_EQ(bench.frame(second), "1010" + first + "0");
  EXPECT_EQ(slave.actuator()->word(), 0x3F1U);
  EXPECT_EQ(slave.actuator()->words(), 2U);
  EXPECT_EQ(slave.actuator()->crc_errors(), 0U);
  EXPECT_FALSE(slave.is_last());
}

TEST(Actuator, WrongCrcOrStopBit_LeavesTheWord) {
  BusBench bench;
  const BissCSlaveConfig config = actuator(12, 0x43);
  auto& slave = bench.add(config);
  bench.frame(line_word(0xA5C, config));
  for (std::size_t bit = 0; bit < config.channel_bits(); ++bit) {
    std::string word = line_word(0x123, config);
    word[bit] ^= 1;
    bench.frame(word);
    EXPECT_EQ(slave.actuator()->word(), 0xA5CU) << bit;
  }
  EXPECT_EQ(slave.actuator()->stop_errors(), 1U);
  EXPECT_EQ(slave.actuator()->crc_errors(), config.channel_bits() - 1);
}

// Every position in chains of 1 to 8, the other slaves being sensors, and all of them actuators.
TEST(Actuator, EveryPositionInEveryChain_GetsItsWordAndSensorsStayValid) {
  for (unsigned length = 1; length <= 8; ++length) {
    for (unsigned position = 0; position <= length; ++position) {  // length: all are actuators
      BusBench bench;
      std::vector<BissCSlave*> slaves;
      std::string mo;
      std::string sl;
      for (unsigned i = 0; i < length; ++i) {
        const bool is_actuator = position == length || i == position;
        BissCSlaveConfig config = is_actuator ? actuator(5 + 3 * i, 0x43, i % 2 == 0)
                                              : constant_slave(4 + 5 * i, 0x9 + i, 0x25);
        slaves.push_back(&bench.add(config));
        mo += is_actuator ? line_word(0x15 + i, config) : std::string(config.channel_bits(), '0');
        sl += line_word(is_actuator ? 0 : 0x9 + i, config);
      }
      const std::string answer = bench.frame(mo, 3);
      EXPECT_EQ(answer.substr(0, answer.size() - 1), "1000010" + sl) << length << " " << position;
      for (unsigned i = 0; i < length; ++i) {
        if (slaves[i]->actuator() == nullptr) continue;
        EXPECT_EQ(slaves[i]->actuator()->word(), 0x15 + i) << length << " " << position;
        EXPECT_EQ(slaves[i]->actuator()->words(), 1U);
      }
    }
  }
}

// MO has its own delay. The slave reads it correctly if it arrives within its period of MA.
TEST(Actuator, MoLaterThanMa_UpToOnePeriod) {
  for (const Time late : {Time{1}, 50 * kPsPerNs, 100 * kPsPerNs, 199 * kPsPerNs}) {
    for (const Time round_trip : {Time{0}, 330 * kPsPerNs, 5000 * kPsPerNs}) {
      BusBench bench(round_trip, late);
      const BissCSlaveConfig config = actuator(12, 0x43);
      const BissCSlaveConfig sensor_config = constant_slave(9, 0x1A5, 0x43);
      auto& near = bench.add(config);
      bench.add(sensor_config);
      auto& far = bench.add(config);
      const std::string words =
          line_word(0xA5C, config) + std::string(15, '0') + line_word(0x3F1, config);
      EXPECT_EQ(bench.frame(words, 2), "100010" + line_word(0, config) +
                                           line_word(0x1A5, sensor_config) + line_word(0, config) +
                                           "0");
      EXPECT_EQ(near.actuator()->word(), 0xA5CU) << late << " " << round_trip;
      EXPECT_EQ(far.actuator()->word(), 0x3F1U) << late << " " << round_trip;
    }
  }
}

// A master that makes too many clocks is visible: the word has left the shift register.
TEST(Actuator, MoreEdgesThanTheFrameHas_ShiftTheWordOut) {
  BusBench bench;
  const BissCSlaveConfig config = actuator(12, 0x43);
  auto& slave = bench.add(config);
  bench.frame(line_word(0xA5C, config), 0, false, 1);
  EXPECT_EQ(slave.actuator()->word(), 0U);
  EXPECT_EQ(slave.actuator()->crc_errors() + slave.actuator()->stop_errors(), 1U);
}

TEST(Actuator, FrameCutShort_LeavesTheWord) {
  BusBench bench;
  const BissCSlaveConfig config = actuator(12, 0x43);
  auto& slave = bench.add(config);
  bench.frame(std::string(config.channel_bits() - 1, '0'));
  EXPECT_EQ(slave.actuator()->words() + slave.actuator()->crc_errors(), 0U);
}

// CDM and CDS work on a bus as they do without MO.
TEST(Actuator, CdmOnABus_IsTaken) {
  BusBench bench;
  const BissCSlaveConfig config = actuator(12, 0x43);
  auto& slave = bench.add(config);
  bench.frame(line_word(0xA5C, config), 0, true);
  EXPECT_TRUE(slave.last_cdm());
  EXPECT_EQ(slave.actuator()->word(), 0xA5CU);
  bench.frame(line_word(0xA5C, config), 0, false);
  EXPECT_FALSE(slave.last_cdm());
  EXPECT_EQ(slave.cdm_count(), 2U);
}

// Without a bus connection SLI of the last slave is 0 for any level of pin MO.
TEST(Actuator, MoNotConnected_LeavesSliAtZero) {
  EventQueue queue;
  ClockedLine line(
      queue, ClockedConfig(), [](Time, void*, bool) {}, nullptr);
  line.drive(0, true, true);
  EXPECT_FALSE(line.chain().mo());
  BusBench bus;
  EXPECT_TRUE(bus.line.chain().mo());
}

}  // namespace
}  // namespace mb4test
