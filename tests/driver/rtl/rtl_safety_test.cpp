// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// BiSS Safety on the chip: the simulator's two words, read by the driver with automatic frames and
// checked by Safety. What is right is what the slaves say that they have sent.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mb4/safety.hpp"
#include "sim/lines/biss/biss_c_faults.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::ConfigField;
using mb4::SafetyCheck;
using mb4::SafetyVerdict;
using mb4test::Chip;

namespace sim = mb4::sim;
namespace slave_fault = sim::slave_fault;
using sim::SlaveFault;

constexpr std::uint8_t kControl = 1;
constexpr std::uint8_t kSafety = 2;
constexpr std::uint16_t kControlStart = 0x2A;
constexpr std::uint16_t kSafetyStart = 0x1234;
// Bits of a frame as in SlFaults: start bit, CDS, then data and CRC of each slave.
constexpr unsigned kControlBits = 28 + 6;
constexpr unsigned kControlFirst = 2;
constexpr unsigned kSafetyBits = 34 + 16;
constexpr unsigned kSafetyFirst = kControlFirst + kControlBits;

std::string encoder() {
  const auto word = [](const char* preset, unsigned start) {
    return "[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"" + std::string(preset) +
           "\"\nsource = \"ramp\"\nstart = 1000\ncrc_start = " + std::to_string(start) + "\n";
  };
  return "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\ncable_m = 5\n" +
         word("bp3-cpw", kControlStart) + word("bp3-spw", kSafetyStart);
}

constexpr mb4::Config config() {
  mb4::Config config;
  config.ma_hz = 10'000'000;
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.spi_check = mb4::SpiCheck::kCrc;
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 100'000);
  mb4::SlaveConfig& control = config.slaves[kControl - 1];
  control.enabled = true;
  control.data_bits = 28;
  control.crc_start = kControlStart;
  mb4::SlaveConfig& safety = config.slaves[kSafety - 1];
  safety.enabled = true;
  safety.data_bits = 34;
  safety.flags = mb4::Flags::kNone;
  safety.crc_polynomial = 0x190D9;
  safety.crc_start = kSafetyStart;
  return config;
}
constexpr mb4::SafetyConfig kWords = mb4::bp3_safety(26, 26, kControlStart, kSafetyStart);
static_assert(mb4::validate(config()).ok());
static_assert(mb4::safety_fits(config(), kControl, kSafety, kWords).ok());

std::string failures(const SafetyVerdict& verdict) {
  std::string text;
  for (unsigned i = 0; i <= static_cast<unsigned>(SafetyCheck::kSafetyError); ++i) {
    const auto check = static_cast<SafetyCheck>(i);
    if (verdict.failed(check)) text += (text.empty() ? "" : ", ") + std::string(to_string(check));
  }
  return text;
}

// Reads each frame before the next one begins.
struct Drive {
  Drive() : Drive(kWords) {}
  explicit Drive(const mb4::SafetyConfig& words) : chip(encoder()) {
    EXPECT_TRUE(chip.device.configure(config()).ok());
    EXPECT_EQ(safety.configure(words), mb4::SafetyField::kNone);
    EXPECT_TRUE(chip.device.automatic().start().ok());
    period = config().frame_period_clk * (sim::kPsPerSecond / config().f_clk_hz);
    while (slave(kControl).frames() == 0) chip.simulator.advance(sim::kPsPerUs);
    tick = chip.simulator.now() + period / 4;
    mb4::Frame frame;
    chip.simulator.run_until(tick);
    EXPECT_EQ(failures(check()), "life counter not comparable");
  }
  sim::Slave& slave(unsigned number) { return *chip.simulator.slave(number); }
  // The verdict on the next frame.
  SafetyVerdict next() {
    tick += period;
    chip.simulator.run_until(tick);
    return check();
  }
  SafetyVerdict check() {
    mb4::Frame frame;
    const mb4::Result<void> read = chip.device.automatic().poll(frame);
    EXPECT_TRUE(read.ok()) << mb4::to_string(read.error());
    return safety.check(mb4::safety_sample(frame[kControl], frame[kSafety]));
  }
  // The verdict on the next frame with a fault that the slave has for this frame.
  SafetyVerdict next_with(unsigned number, const SlaveFault& fault) {
    slave(number).set_fault(fault, true);
    const SafetyVerdict verdict = next();
    slave(number).set_fault(fault, false);
    return verdict;
  }
  SafetyVerdict next_with(const std::vector<unsigned>& bits) {
    clocked(chip.simulator.line(1))->faults().flip_next_frame(bits);
    return next();
  }
  bool is_what_was_sent(const SafetyVerdict& verdict) {
    const auto control = slave(kControl).sent_in(slave(kControl).frames());
    const auto word = slave(kSafety).sent_in(slave(kSafety).frames());
    return control && word && verdict.position == *control >> 2U &&
           verdict.safety_position == *word >> 8U && verdict.life == *word % 64 &&
           (*control & 3U) == 3 && (*word >> 6U & 3U) == 3;
  }

  Chip chip;
  mb4::Safety safety;
  sim::Time period = 0;
  sim::Time tick = 0;
};

TEST(DriverSafety, All64LifeValues_AreRight) {
  Drive drive;
  std::uint64_t seen = 0;
  for (unsigned frame = 1; frame <= 70; ++frame) {
    const SafetyVerdict verdict = drive.next();
    ASSERT_TRUE(verdict.ok()) << failures(verdict);
    EXPECT_TRUE(drive.is_what_was_sent(verdict));
    EXPECT_EQ(verdict.position, 1000 + frame);
    EXPECT_EQ(verdict.life, frame % 64);
    seen |= std::uint64_t{1} << verdict.life;
  }
  EXPECT_EQ(seen, ~std::uint64_t{0});
}

TEST(DriverSafety, StuckCounter_IsFoundInOneFrameAtEachValue) {
  Drive drive;
  for (unsigned i = 0; i < 64; ++i) {
    const SafetyVerdict stuck = drive.next_with(kSafety, slave_fault::kStuckCounter);
    EXPECT_EQ(failures(stuck), "life counter stuck") << i;
    EXPECT_EQ(stuck.life, i);
    EXPECT_TRUE(drive.next().ok()) << i;
  }
}

TEST(DriverSafety, EachFaultOfTheEncoder_HasItsName) {
  Drive drive;
  for (unsigned i = 0; i < 2; ++i) {
    EXPECT_EQ(failures(drive.next_with(kSafety, slave_fault::kSkippedWord)),
              "safety word left out");
    EXPECT_TRUE(drive.next().ok());
    EXPECT_EQ(failures(drive.next_with(kControl, slave_fault::kStuckWord)), "positions differ");
    EXPECT_TRUE(drive.next().ok());
    EXPECT_EQ(failures(drive.next_with(kSafety, slave_fault::kStuckWord)),
              "life counter stuck, positions differ");
    EXPECT_EQ(failures(drive.next()), "safety word left out") << "the sensor has gone on";
    EXPECT_TRUE(drive.next().ok());
    EXPECT_EQ(failures(drive.next_with(kControl, slave_fault::kWrongCrc)),
              "CRC error of the control word");
    EXPECT_TRUE(drive.next().ok());
    EXPECT_EQ(failures(drive.next_with(kSafety, slave_fault::kWrongCrc)),
              "CRC error of the safety word");
    EXPECT_TRUE(drive.next().ok());
    EXPECT_EQ(failures(drive.next_with(kControl, slave_fault::kSwappedWords)),
              "CRC error of the control word, CRC error of the safety word");
    EXPECT_TRUE(drive.next().ok());
  }
  // nE = 0 and another position in the control word.
  ASSERT_TRUE(drive.slave(kControl).set_data(0b01));
  EXPECT_EQ(failures(drive.next()), "positions differ, error flag of the control word");
}

// A frame that nobody has read: the counter tells, unless the caller has counted it.
TEST(DriverSafety, FrameThatWasNotRead_IsFound) {
  Drive drive;
  drive.tick += drive.period;
  EXPECT_EQ(failures(drive.next()), "safety word left out");
  EXPECT_TRUE(drive.next().ok());
  drive.tick += 2 * drive.period;
  drive.chip.simulator.run_until(drive.tick);
  mb4::Frame frame;
  ASSERT_TRUE(drive.chip.device.automatic().poll(frame).ok());
  EXPECT_TRUE(drive.safety.check(mb4::safety_sample(frame[kControl], frame[kSafety]), 2).ok());
  // Nothing new since.
  ASSERT_TRUE(drive.chip.device.automatic().poll(frame).ok());
  EXPECT_EQ(failures(drive.safety.check(mb4::safety_sample(frame[kControl], frame[kSafety]))),
            "no control word, no safety word");
}

// The encoder has another start value than the check: the chip finds the word good, Safety does
// not.
TEST(DriverSafety, StartValue_IsCheckedAgain) {
  mb4::SafetyConfig words = kWords;
  words.safety.crc_start ^= 0x8000U;
  Chip chip(encoder());
  ASSERT_TRUE(chip.device.configure(config()).ok());
  mb4::Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  ASSERT_TRUE(frame.good(0b11));
  mb4::Safety safety;
  ASSERT_EQ(safety.configure(words), mb4::SafetyField::kNone);
  EXPECT_EQ(failures(safety.check(mb4::safety_sample(frame[kControl], frame[kSafety]))),
            "CRC error of the safety word");
}

TEST(DriverSafety, ReadingWithoutAStoredCrc_IsMissing) {
  Chip chip(encoder());
  mb4::Config unchecked = config();
  unchecked.spi_check = mb4::SpiCheck::kOff;
  ASSERT_TRUE(chip.device.configure(unchecked).ok());
  mb4::Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  ASSERT_TRUE(frame.good(0b11));
  mb4::Safety safety;
  ASSERT_EQ(safety.configure(kWords), mb4::SafetyField::kNone);
  EXPECT_EQ(failures(safety.check(mb4::safety_sample(frame[kControl], frame[kSafety]))),
            "no control word, no safety word");
}

TEST(DriverSafety, ConfigurationThatDoesNotFit_IsNamed) {
  struct Bad {
    ConfigField field;
    std::uint8_t number;
    void (*change)(mb4::Config& config, mb4::SafetyConfig& words);
  };
  using C = mb4::Config&;
  using S = mb4::SafetyConfig&;
  const Bad bad[] = {
      {ConfigField::kSlaveEnabled, 1, [](C c, S /*w*/) { c.slaves[0].enabled = false; }},
      {ConfigField::kSlaveEnabled, 2, [](C c, S /*w*/) { c.slaves[1].actuator = true; }},
      {ConfigField::kSlaveEnabled, 1,
       [](C c, S /*w*/) { c.channels[0].protocol = mb4::Protocol::kBissB; }},
      {ConfigField::kDataBits, 2, [](C c, S /*w*/) { c.slaves[1].data_bits = 33; }},
      {ConfigField::kCrcPolynomial, 1, [](C c, S /*w*/) { c.slaves[0].crc_polynomial = 0x25; }},
      {ConfigField::kCrcStart, 2, [](C c, S /*w*/) { c.slaves[1].crc_start = 0; }},
      {ConfigField::kFlags, 2, [](C c, S /*w*/) { c.slaves[1].flags = mb4::Flags::kErrorWarning; }},
      {ConfigField::kFlags, 1,
       [](C /*c*/, S w) {
         w.control.error_place = 0;
         w.control.warning_place = 1;
       }},
      {ConfigField::kSpiCheck, 1, [](C c, S /*w*/) { c.spi_check = mb4::SpiCheck::kOff; }},
      {ConfigField::kDataBits, 2,
       [](C c, S w) {
         // 49 bits and a CRC of 16 bits take nine bytes.
         c.slaves[1].data_bits = w.safety.data_bits = 49;
       }},
  };
  for (const Bad& one : bad) {
    mb4::Config changed = config();
    mb4::SafetyConfig words = kWords;
    one.change(changed, words);
    const mb4::Result<void> fits = mb4::safety_fits(changed, kControl, kSafety, words);
    EXPECT_EQ(fits.error(), mb4::Error::kUnsupported);
    EXPECT_EQ(fits.info().field, one.field) << mb4::to_string(fits.info().field);
    EXPECT_EQ(fits.info().number, one.number);
  }
  for (const auto& [control, safety] : {std::pair{0, 2}, {9, 2}, {1, 9}, {2, 2}}) {
    EXPECT_EQ(mb4::safety_fits(config(), static_cast<std::uint8_t>(control),
                               static_cast<std::uint8_t>(safety), kWords)
                  .error(),
              mb4::Error::kInvalidArgument);
  }
}

// Faults of the line within the guarantees of the CRCs (docs/safety.md) and faults of the encoder,
// each in one frame of three. 3,000 faults, or 10^6 in the night (MB4_ALL_FAULTS).
TEST(DriverSafetyFaults, NoneIsUndetected) {
  const unsigned faults = std::getenv("MB4_ALL_FAULTS") != nullptr ? 1'000'000 : 3'000;
  constexpr unsigned kSeed = 1;
  std::mt19937 random(kSeed);
  const auto up_to = [&](unsigned most) {
    return std::uniform_int_distribution<unsigned>(0, most)(random);
  };
  const auto some = [&](unsigned first, unsigned length, unsigned count) {
    std::vector<unsigned> bits;
    while (bits.size() < count) {
      const unsigned bit = first + up_to(length - 1);
      if (std::find(bits.begin(), bits.end(), bit) == bits.end()) bits.push_back(bit);
    }
    return bits;
  };
  const auto burst = [&](unsigned first, unsigned length, unsigned size) {
    const unsigned begin = first + up_to(length - size);
    std::vector<unsigned> bits{begin};
    for (unsigned i = 1; i < size; ++i) {
      if (i + 1 == size || up_to(1) == 1) bits.push_back(begin + i);
    }
    return bits;
  };
  constexpr SlaveFault kOfSlaves[] = {slave_fault::kStuckCounter, slave_fault::kSkippedWord,
                                      slave_fault::kStuckWord, slave_fault::kWrongCrc};
  Drive drive;
  unsigned undetected = 0;
  for (unsigned done = 0; done < faults && undetected < 10; ++done) {
    std::string what;
    const SafetyVerdict verdict = [&] {
      switch (done % 8) {
        case 0:
          return drive.next_with(some(kControlFirst, kControlBits, 1 + up_to(1)));
        case 1:
          return drive.next_with(burst(kControlFirst, kControlBits, 1 + up_to(5)));
        case 2:
          return drive.next_with(some(kSafetyFirst, kSafetyBits, 1 + up_to(4)));
        case 3:
          return drive.next_with(burst(kSafetyFirst, kSafetyBits, 1 + up_to(15)));
        case 4:
          return drive.next_with(some(kSafetyFirst, kSafetyBits, 1 + 2 * up_to(9)));
        case 5:
          return drive.next_with(kSafety, kOfSlaves[up_to(3)]);
        case 6:
          return drive.next_with(kControl,
                                 up_to(1) == 0 ? slave_fault::kStuckWord : slave_fault::kWrongCrc);
        default:
          return drive.next_with(kControl, slave_fault::kSwappedWords);
      }
    }();
    if (verdict.ok()) {
      ++undetected;
      ADD_FAILURE() << "seed " << kSeed << ", fault " << done << " of kind " << done % 8;
    }
    static_cast<void>(drive.next());  // a word that the sensor has left out is told here
    const SafetyVerdict good = drive.next();
    ASSERT_TRUE(good.ok()) << failures(good) << " after fault " << done;
    ASSERT_TRUE(drive.is_what_was_sent(good)) << "fault " << done;
  }
  std::cout << "faults injected " << faults << ", undetected " << undetected << "\n";
}

}  // namespace
