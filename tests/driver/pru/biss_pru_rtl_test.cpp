// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The calls of biss_pru.h on the Verilated biss_pru, with an encoder behind a cable.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "biss_pru.h"
#include "tests/chip/pru/pru_sim.hpp"

namespace {

namespace sim = mb4::sim;

constexpr std::uint64_t kStart = 1000;
constexpr std::uint64_t kStep = 7;
constexpr unsigned kBits = 12;

// TIDEP0022, 1.5 of the facts: 148 ns and 16 ns for a metre, out and back.
std::string scenario(const std::string& slave, const std::string& channel = "",
                     unsigned clock_mhz = 80, unsigned metres = 2) {
  return mb4test::pru_scenario(
      "[[channel]]\nnumber = 1\ntransceiver_ns = 74\nns_per_m = 8.0\ncable_m = " +
          std::to_string(metres) + ".0\n" + channel +
          "\n[[channel.slave]]\nprotocol = \"biss-c\"\nsource = \"ramp\"\nstart = " +
          std::to_string(kStart) + "\nstep = " + std::to_string(kStep) + "\n" + slave + "\n",
      clock_mhz * 1'000'000ULL);
}

const std::string kWachendorff = "preset = \"wachendorff-wdgf58m\"";  // 12 bits
const std::string kPlain = "data_bits = 14";                          // 12 bits, nE, nW

biss_pru_config usual() {
  biss_pru_config config{};
  config.position_bits = kBits;
  config.crc_err_war = 8;
  config.mhz = 5;
  config.period_us = 60;
  return config;
}

// The frames of the ramp count as those of the master, as long as each of them has an acknowledge.
std::uint64_t ramp(std::uint64_t frame) {
  return (kStart + kStep * (frame - 1)) & ((1U << kBits) - 1);
}

class PruRig : public mb4test::PruSim {
 public:
  using PruSim::PruSim;
  biss_pru_result start(const biss_pru_config& config) {
    const biss_pru_port port = {this, port_read, port_write, port_now_us};
    return biss_pru_start(&pru, &port, &config);
  }
  biss_pru_result position() { return biss_pru_position(&pru, &reading); }
  // The next frame: the calls that find none are not counted.
  biss_pru_result next() {
    for (;;) {
      const biss_pru_result result = position();
      if (result != BISS_PRU_NO_NEW_FRAME) return result;
      pass_us(7);
    }
  }
  biss_pru_result read_register(std::uint8_t address, std::uint8_t id = 0) {
    return biss_pru_read_register(&pru, id, address, &data);
  }
  biss_pru_result write_register(std::uint8_t address, std::uint8_t value) {
    return biss_pru_write_register(&pru, 0, address, value);
  }
  std::uint32_t now_us() const {
    return static_cast<std::uint32_t>(simulator.now() / sim::kPsPerUs);
  }
  void pass_us(std::uint64_t us) { simulator.advance(us * sim::kPsPerUs); }
  bool pin(const char* name) { return simulator.pin(*simulator.pin_by_name(name)); }
  void set_pin(const char* name, bool level) {
    simulator.set_pin(*simulator.pin_by_name(name), level);
  }
  void reset() {
    set_pin("rst_ni", false);
    pass_us(1);
    set_pin("rst_ni", true);
    pass_us(1);
  }
  void action(const char* name) {
    simulator.inject("[[channel]]\nnumber = 1\n[[channel.event]]\nat_us = 0\naction = \"" +
                     std::string(name) + "\"\n");
    pass_us(1);
  }
  std::uint8_t in_encoder(std::uint8_t address) { return simulator.slave(1)->reg_read(address); }

  biss_pru_master pru{};
  biss_pru_reading reading{};
  std::uint8_t data = 0xEE;

 private:
  // An access without an answer reads 0.
  static std::uint32_t port_read(void* self, std::uint32_t offset) {
    std::uint32_t word = 0;
    static_cast<PruRig*>(self)->host.read(offset, word);
    return word;
  }
  static void port_write(void* self, std::uint32_t offset, std::uint32_t word) {
    static_cast<PruRig*>(self)->host.write(offset, word, 0xF);
  }
  static std::uint32_t port_now_us(void* self) { return static_cast<PruRig*>(self)->now_us(); }
};

// ---- Positions ---------------------------------------------------------------------------------

struct Rate {
  unsigned clock_mhz, mhz, metres, frames;
};

void PrintTo(const Rate& rate, std::ostream* out) { *out << rate.mhz << " MHz"; }

class BissPruRates : public testing::TestWithParam<Rate> {};

// Each frame is told once, with its own word.
TEST_P(BissPruRates, Ramp_IsReadFrameByFrame) {
  const Rate& rate = GetParam();
  PruRig rig(scenario(kPlain, "", rate.clock_mhz, rate.metres));
  biss_pru_config config = usual();
  config.mhz = static_cast<std::uint8_t>(rate.mhz);
  config.period_us = rate.mhz == 1 ? 70 : 50;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  for (unsigned frame = 1; frame <= rate.frames; ++frame) {
    ASSERT_EQ(rig.next(), BISS_PRU_OK) << frame;
    ASSERT_EQ(rig.reading.frame, frame);
    ASSERT_EQ(rig.reading.frames, 1U);
    ASSERT_EQ(rig.reading.position, ramp(frame)) << frame;
    ASSERT_FALSE(rig.reading.warning);
    ASSERT_EQ(rig.reading.proc_time, 0U);
  }
  EXPECT_EQ(rig.reading.crc_errors, 0U);
  EXPECT_EQ((rig.reading.flags & BISS_PRU_SMA_FLAG) != 0, rate.mhz != 10);
}

std::vector<Rate> rates() {
  std::vector<Rate> all;
  for (const unsigned clock_mhz : {80U, 200U}) {
    for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
      all.push_back({clock_mhz, mhz, 2, clock_mhz == 80 ? 3000U : 1000U});
      all.push_back({clock_mhz, mhz, mhz == 10 ? 10U : 27U, 1000});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Each, BissPruRates, testing::ValuesIn(rates()), [](const auto& test) {
  const Rate& rate = test.param;
  return "Clock" + std::to_string(rate.clock_mhz) + "Ma" + std::to_string(rate.mhz) + "Metres" +
         std::to_string(rate.metres);
});

// TIDEP0022, Table 10, rows 3, 8, 13 (25 m and 2 m of cable): 1, 2 and 3 periods.
TEST(BissPruRtl, SetFrequency_ActsFromTheFrameItNames) {
  PruRig rig(scenario(kPlain, "", 80, 27));
  biss_pru_config config = usual();
  config.mhz = 1;
  config.period_us = 100;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  unsigned before = 1;
  for (const auto& [mhz, delay] : std::map<std::uint8_t, unsigned>{{2, 2}, {5, 3}}) {
    ASSERT_EQ(rig.next(), BISS_PRU_OK);
    std::uint16_t first = 0;
    ASSERT_EQ(biss_pru_set_frequency(&rig.pru, mhz, &first), BISS_PRU_OK);
    EXPECT_EQ(first, rig.reading.frame + 2);
    ASSERT_EQ(rig.next(), BISS_PRU_OK);
    EXPECT_EQ(rig.reading.line_delay, before) << "the frame before";
    ASSERT_EQ(rig.next(), BISS_PRU_OK);
    EXPECT_EQ(rig.reading.frame, first);
    EXPECT_EQ(rig.reading.line_delay, delay);
    before = delay;
    for (int i = 0; i < 10; ++i) {
      ASSERT_EQ(rig.next(), BISS_PRU_OK);
      EXPECT_EQ(rig.reading.position, ramp(rig.reading.frame));
    }
  }
}

TEST(BissPruRtl, LongestPosition_IsReadWhole) {
  PruRig rig(scenario("data_bits = 57"));
  biss_pru_config config = usual();
  config.position_bits = 55;
  config.period_us = 200;
  rig.simulator.slave(1)->set_data(0x1'5555'6666'7777ULL << 8U | 3U);
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  ASSERT_EQ(rig.next(), BISS_PRU_OK);
  EXPECT_EQ(rig.reading.position, 0x1'5555'6666'7777ULL << 6U);
}

TEST(BissPruRtl, ProcessingTime_IsToldAndLimited) {
  PruRig rig(scenario(kPlain + "\nbusy_periods = 20"));
  biss_pru_config config = usual();
  config.proc_time_max = 20;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  ASSERT_EQ(rig.next(), BISS_PRU_OK);
  EXPECT_EQ(rig.reading.proc_time, 20U);
  config.proc_time_max = 19;
  EXPECT_EQ(rig.start(config), BISS_PRU_PROCESSING);
  EXPECT_EQ(rig.next(), BISS_PRU_PROCESSING);
  EXPECT_EQ(rig.reading.proc_time, 20U) << "limit + 1";
  EXPECT_EQ(rig.reading.position, 0U);
}

TEST(BissPruRtl, FlippedBits_AreCrcErrorsOfTheirFrames) {
  PruRig rig(scenario(kPlain, "flips = [[5, 3], [9, 2, 9], [10, 17]]"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  for (unsigned frame = 1; frame <= 20; ++frame) {
    const bool bad = frame == 5 || frame == 9 || frame == 10;
    EXPECT_EQ(rig.next(), bad ? BISS_PRU_CRC : BISS_PRU_OK) << frame;
    EXPECT_EQ(rig.reading.position, bad ? 0 : ramp(frame));
  }
  EXPECT_EQ(rig.reading.crc_errors, 3U);
}

TEST(BissPruRtl, EncoderError_IsNoPosition) {
  PruRig rig(scenario(kPlain + "\nflags = 1"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.next(), BISS_PRU_ENCODER_ERROR);
  EXPECT_EQ(rig.reading.position, ramp(1));
  EXPECT_FALSE(rig.reading.warning);
}

TEST(BissPruRtl, EncoderWarning_IsAFlag) {
  PruRig rig(scenario(kPlain + "\nflags = 2"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.next(), BISS_PRU_OK);
  EXPECT_TRUE(rig.reading.warning);
}

TEST(BissPruRtl, EncoderWithoutCrc_IsReadWhenTheConfigSaysSo) {
  PruRig rig(scenario(kPlain + "\ncrc = 0", "flips = [[3, 13]]"));
  biss_pru_config config = usual();
  config.crc_err_war = 2;
  EXPECT_EQ(rig.start(config), BISS_PRU_UNCHECKED);
  config.unchecked = true;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  for (unsigned frame = 1; frame <= 5; ++frame) {
    EXPECT_EQ(rig.next(), BISS_PRU_OK);
    EXPECT_EQ(rig.reading.position, frame == 3 ? ramp(frame) ^ 1U : ramp(frame))
        << "nobody sees it";
  }
}

// Only with the pin: the frame of RUN, then one a pulse.
TEST(BissPruRtl, FramesByThePin_AreRead) {
  PruRig rig(scenario(kPlain));
  biss_pru_config config = usual();
  config.period_us = 0;
  config.frame_limit_us = 1000;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  ASSERT_EQ(rig.next(), BISS_PRU_OK);
  for (unsigned frame = 2; frame < 6; ++frame) {
    rig.pass_us(300);
    EXPECT_EQ(rig.position(), BISS_PRU_NO_NEW_FRAME);
    rig.set_pin("trigger_i", true);
    rig.pass_us(1);
    rig.set_pin("trigger_i", false);
    ASSERT_EQ(rig.next(), BISS_PRU_OK);
    EXPECT_EQ(rig.reading.frame, frame);
  }
  rig.pass_us(1001);
  EXPECT_EQ(rig.position(), BISS_PRU_NO_FRAMES);
}

TEST(BissPruRtl, Interrupt_ComesWithEachFrame) {
  PruRig rig(scenario(kPlain));
  biss_pru_config config = usual();
  config.interrupt = true;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  for (unsigned frame = 1; frame < 50; ++frame) {
    ASSERT_TRUE(rig.simulator.run_while_waiting([&] { return rig.pin("irq_o"); },
                                                rig.simulator.now() + 200 * sim::kPsPerUs));
    ASSERT_EQ(rig.position(), BISS_PRU_OK);
    ASSERT_EQ(rig.reading.frame, frame);
    ASSERT_FALSE(rig.pin("irq_o"));
  }
}

// ---- Lines that fail ---------------------------------------------------------------------------

struct Fault {
  const char* name;
  const char* begin;
  const char* end;
  const char* channel;
  bool written;  // a write during the fault is done: the encoder sees MA
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class BissPruLine : public testing::TestWithParam<Fault> {};

TEST_P(BissPruLine, Fault_IsNoSlaveUntilItEnds) {
  const Fault& fault = GetParam();
  PruRig rig(scenario(kPlain, fault.channel));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  ASSERT_EQ(rig.next(), BISS_PRU_OK);
  rig.action(fault.begin);
  (void)rig.next();  // the fault may have come in this frame
  for (int i = 0; i < 30; ++i) {
    ASSERT_EQ(rig.next(), BISS_PRU_NO_SLAVE) << i;
    ASSERT_EQ(rig.reading.position, 0U);
    ASSERT_EQ(rig.reading.frames, 1U);
  }
  rig.action(fault.end);
  (void)rig.next();
  for (int i = 0; i < 30; ++i) ASSERT_EQ(rig.next(), BISS_PRU_OK) << i;
}

TEST_P(BissPruLine, FaultAtTheStart_IsToldAndTheMasterRunsOn) {
  const Fault& fault = GetParam();
  PruRig rig(scenario(kPlain, fault.channel));
  rig.action(fault.begin);
  ASSERT_EQ(rig.start(usual()), BISS_PRU_NO_SLAVE);
  EXPECT_EQ(rig.next(), BISS_PRU_NO_SLAVE);
  rig.action(fault.end);
  (void)rig.next();
  (void)rig.next();
  EXPECT_EQ(rig.next(), BISS_PRU_OK);
}

// A write must not be told as done, and later accesses must work.
TEST_P(BissPruLine, FaultDuringAnAccess_IsTold) {
  const Fault& fault = GetParam();
  PruRig rig(scenario(kPlain, fault.channel));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  ASSERT_EQ(biss_pru_begin_write(&rig.pru, 0, 0x60, 0x5A), BISS_PRU_OK);
  for (int i = 0; i < 10; ++i) (void)rig.next();
  EXPECT_EQ(biss_pru_poll(&rig.pru, &rig.data), BISS_PRU_PENDING);
  rig.action(fault.begin);
  EXPECT_EQ(biss_pru_wait(&rig.pru, &rig.data), BISS_PRU_NO_SLAVE);
  EXPECT_EQ(rig.in_encoder(0x60), fault.written ? 0x5AU : 0U);
  rig.action(fault.end);
  biss_pru_result result = BISS_PRU_BUSY;
  for (int i = 0; i < 50 && result == BISS_PRU_BUSY; ++i) {
    (void)rig.next();
    result = biss_pru_begin_write(&rig.pru, 0, 0x61, 0xA5);
  }
  ASSERT_EQ(result, BISS_PRU_OK);
  EXPECT_EQ(biss_pru_wait(&rig.pru, &rig.data), BISS_PRU_OK);
  EXPECT_EQ(rig.in_encoder(0x61), 0xA5U);
}

INSTANTIATE_TEST_SUITE_P(
    Each, BissPruLine,
    testing::Values(Fault{"UnpluggedReads1", "unplug", "plug", "open_level = 1", false},
                    Fault{"UnpluggedReads0", "unplug", "plug", "open_level = 0", false},
                    Fault{"SlLow", "sl-low", "sl-free", "", false},
                    Fault{"SlHigh", "sl-high", "sl-free", "", true},
                    Fault{"MaLow", "ma-low", "ma-free", "", false},
                    Fault{"MaHigh", "ma-high", "ma-free", "", false}),
    [](const auto& test) { return std::string(test.param.name); });

// ---- Registers ---------------------------------------------------------------------------------

// TIDEP0022, Table 11.
const std::map<std::uint8_t, std::uint8_t> kTable11 = {
    {0x44, 0x00}, {0x45, 0xD9}, {0x46, 0x01}, {0x47, 0x32}, {0x60, 0x0B},
    {0x67, 0x5F}, {0x68, 0x00}, {0x78, 0x46}, {0x79, 0x3A}, {0x7A, 0xC0},
    {0x7B, 0x0C}, {0x7C, 0x00}, {0x7D, 0x01}, {0x7E, 0x57}, {0x7F, 0x41}};

class BissPruRegisters : public testing::TestWithParam<unsigned> {};

TEST_P(BissPruRegisters, Table11_IsReadAndOtherBytesAreWritten) {
  PruRig rig(scenario(kWachendorff));
  biss_pru_config config = usual();
  config.mhz = static_cast<std::uint8_t>(GetParam());
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  for (const auto& [address, value] : kTable11) {
    ASSERT_EQ(rig.read_register(address), BISS_PRU_OK) << int{address};
    EXPECT_EQ(rig.data, value) << int{address};
  }
  for (const std::uint8_t address : std::vector<std::uint8_t>{0x48, 0x55, 0x6A}) {
    for (const unsigned value : {0x00U, 0xFFU, 0xA5U}) {
      const auto byte = static_cast<std::uint8_t>(value ^ address);
      ASSERT_EQ(rig.write_register(address, byte), BISS_PRU_OK);
      EXPECT_EQ(rig.in_encoder(address), byte);
      ASSERT_EQ(rig.read_register(address), BISS_PRU_OK);
      EXPECT_EQ(rig.data, byte);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Mhz, BissPruRegisters, testing::Values(1U, 2U, 5U, 10U),
                         [](const auto& test) { return std::to_string(test.param); });

// A drive's loop: each position is read once, in its frame, whatever the access does.
TEST(BissPruRtl, LoopOfADrive_ReadsEachPositionWhileRegistersAreAccessed) {
  PruRig rig(scenario(kPlain));
  biss_pru_config config = usual();
  config.interrupt = true;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  unsigned frame = 0;
  unsigned accesses = 0;
  bool pending = false;
  while (accesses < 40) {
    ASSERT_TRUE(rig.simulator.run_while_waiting([&] { return rig.pin("irq_o"); },
                                                rig.simulator.now() + 200 * sim::kPsPerUs));
    ASSERT_EQ(rig.position(), BISS_PRU_OK);
    ++frame;
    ASSERT_EQ(rig.reading.frame, frame);
    ASSERT_EQ(rig.reading.position, ramp(frame));
    const auto value = static_cast<std::uint8_t>(accesses / 2 * 11);
    if (!pending) {
      ASSERT_EQ(accesses % 2 == 0 ? biss_pru_begin_write(&rig.pru, 0, 0x60, value)
                                  : biss_pru_begin_read(&rig.pru, 0, 0x60),
                BISS_PRU_OK);
      pending = true;
      continue;
    }
    const biss_pru_result result = biss_pru_poll(&rig.pru, &rig.data);
    if (result == BISS_PRU_PENDING) continue;
    ASSERT_EQ(result, BISS_PRU_OK) << accesses;
    ASSERT_EQ(rig.data, value);
    ASSERT_EQ(rig.in_encoder(0x60), value);
    pending = false;
    ++accesses;
  }
  EXPECT_EQ(frame, 40 * 48U) << "47 frames, and one more until the next access begins";
}

TEST(BissPruRtl, OtherIdAndMissingRegister_GiveNoAnswer) {
  PruRig rig(scenario(kPlain + "\nmissing = [0x50]\nregisters = { 0x44 = [0x12] }"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.read_register(0x44, 1), BISS_PRU_NO_ANSWER);
  EXPECT_EQ(rig.read_register(0x50), BISS_PRU_NO_ANSWER);
  EXPECT_EQ(rig.write_register(0x50, 3), BISS_PRU_NO_ANSWER);
  EXPECT_EQ(rig.data, 0xEEU);
  EXPECT_EQ(rig.read_register(0x44), BISS_PRU_OK);
  EXPECT_EQ(rig.data, 0x12U);
}

TEST(BissPruRtl, EncoderWithTwoIds_IsReachedByEach) {
  PruRig rig(scenario(kPlain + "\nids = 2\nregisters = { 0x44 = [0x12], 0xC4 = [0x34] }"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.read_register(0x44, 0), BISS_PRU_OK);
  const std::uint8_t first = rig.data;
  EXPECT_EQ(rig.read_register(0x44, 1), BISS_PRU_OK);
  EXPECT_EQ((std::set<std::uint8_t>{first, rig.data}), (std::set<std::uint8_t>{0x12, 0x34}));
}

// R-P17: S is not repeated, so an encoder that waits cannot be read.
TEST(BissPruRtl, BusyEncoder_IsNoAnswerOrABadOne) {
  PruRig rig(scenario(kPlain + "\nread_busy_frames = 1\nregisters = { 0x44 = [0x12] }"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  const biss_pru_result result = rig.read_register(0x44);
  EXPECT_TRUE(result == BISS_PRU_BAD_ANSWER || result == BISS_PRU_NO_ANSWER) << result;
  EXPECT_EQ(rig.data, 0xEEU);
}

TEST(BissPruRtl, UnidirectionalEncoder_GivesNoAnswer) {
  PruRig rig(scenario(kPlain + "\ncontrol = false"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.read_register(0x44), BISS_PRU_NO_ANSWER);
}

// What the header says: nothing confirms that the encoder has stored the byte.
TEST(BissPruRtl, WriteProtectedRegister_EchoesAsAnyOther) {
  PruRig rig(scenario(kPlain + "\nwrite_protected = [0x60]"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.write_register(0x60, 0x33), BISS_PRU_OK);
  EXPECT_EQ(rig.read_register(0x60), BISS_PRU_OK);
  EXPECT_EQ(rig.data, 0U);
}

// Frame 1 is the one of RUN. The word goes with the end of frame 2, START with frame 17, data with
// frames 37 to 44, its CRC with 45 to 48. Bit 1 of a frame is CDS.
class BissPruFlips : public testing::TestWithParam<unsigned> {};

TEST_P(BissPruFlips, FlippedCds_IsABadAnswer) {
  PruRig rig(scenario(kPlain + "\nregisters = { 0x44 = [0x12] }",
                      "flips = [[" + std::to_string(GetParam()) + ", 1]]"));
  biss_pru_config config = usual();
  config.period_us = 100;
  ASSERT_EQ(rig.start(config), BISS_PRU_OK);
  const bool counts = GetParam() >= 37 && GetParam() <= 48;
  EXPECT_EQ(rig.read_register(0x44), counts ? BISS_PRU_BAD_ANSWER : BISS_PRU_OK);
  ASSERT_EQ(rig.next(), BISS_PRU_OK);
  EXPECT_EQ(rig.reading.frame, 48U);
  EXPECT_EQ(rig.reading.crc_errors, 0U) << "the CRC of the position does not cover CDS";
}

INSTANTIATE_TEST_SUITE_P(Frame, BissPruFlips, testing::Values(36U, 37U, 40U, 44U, 45U, 48U, 49U),
                         [](const auto& test) { return std::to_string(test.param); });

// SL is low for some frames of the access: a frame without MA takes no bit.
TEST(BissPruRtl, ShortFaultDuringAnAccess_OnlyDelaysIt) {
  PruRig rig(scenario(kPlain + "\nregisters = { 0x44 = [0x12] }"));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  ASSERT_EQ(biss_pru_begin_read(&rig.pru, 0, 0x44), BISS_PRU_OK);
  for (int i = 0; i < 10; ++i) (void)rig.next();
  // Between two frames: a frame itself must not be hit.
  rig.simulator.inject(
      "[[channel]]\nnumber = 1\n[[channel.event]]\nat_us = 1\naction = \"sl-low\"\n"
      "[[channel.event]]\nat_us = 600\naction = \"sl-free\"\n");
  EXPECT_EQ(biss_pru_wait(&rig.pru, &rig.data), BISS_PRU_OK);
  EXPECT_EQ(rig.data, 0x12U);
  ASSERT_EQ(rig.next(), BISS_PRU_OK);
  EXPECT_GT(rig.reading.frame, 48U);
}

// ---- Resets ------------------------------------------------------------------------------------

TEST(BissPruRtl, ResetBehindTheDriver_IsToldAndStartHelps) {
  PruRig rig(scenario(kPlain));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  for (int i = 0; i < 10; ++i) ASSERT_EQ(rig.next(), BISS_PRU_OK);
  ASSERT_EQ(biss_pru_begin_read(&rig.pru, 0, 0x44), BISS_PRU_OK);
  rig.reset();
  rig.reading.position = 99;
  EXPECT_EQ(rig.position(), BISS_PRU_NOT_RUNNING);
  EXPECT_EQ(rig.reading.position, 99U);
  EXPECT_EQ(biss_pru_poll(&rig.pru, &rig.data), BISS_PRU_NOT_RUNNING);
  EXPECT_EQ(biss_pru_set_frequency(&rig.pru, 1, nullptr), BISS_PRU_NOT_RUNNING);
  EXPECT_EQ(biss_pru_begin_read(&rig.pru, 0, 0x44), BISS_PRU_NOT_RUNNING);
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.next(), BISS_PRU_OK);
  EXPECT_EQ(rig.reading.frame, 1U);
  EXPECT_EQ(rig.read_register(0x44), BISS_PRU_OK);
}

TEST(BissPruRtl, MasterHeldInReset_IsTold) {
  PruRig rig(scenario(kPlain));
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  rig.set_pin("rst_ni", false);
  EXPECT_EQ(rig.position(), BISS_PRU_NOT_RUNNING);
  EXPECT_EQ(rig.start(usual()), BISS_PRU_NO_MASTER);
}

// At any time, with a frame that runs or without.
TEST(BissPruRtl, StopAndStart_WorkInAnyPhaseOfAFrame) {
  PruRig rig(scenario(kPlain));
  for (unsigned phase = 0; phase < 60; ++phase) {
    ASSERT_EQ(rig.start(usual()), BISS_PRU_OK) << phase;
    ASSERT_EQ(rig.next(), BISS_PRU_OK);
    ASSERT_EQ(biss_pru_begin_write(&rig.pru, 0, 0x60, 0x77), BISS_PRU_OK);
    for (unsigned i = 0; i < phase % 4 * 10; ++i) ASSERT_EQ(rig.next(), BISS_PRU_OK);
    rig.pass_us(phase);
    biss_pru_stop(&rig.pru);
    EXPECT_EQ(rig.position(), BISS_PRU_NOT_RUNNING);
    EXPECT_EQ(biss_pru_poll(&rig.pru, &rig.data), BISS_PRU_NO_ACCESS);
  }
  EXPECT_EQ(rig.in_encoder(0x60), 0U) << "no access came to its end";
  ASSERT_EQ(rig.start(usual()), BISS_PRU_OK);
  EXPECT_EQ(rig.write_register(0x60, 0x78), BISS_PRU_OK);
  EXPECT_EQ(rig.in_encoder(0x60), 0x78U);
}

}  // namespace
