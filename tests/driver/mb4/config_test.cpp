// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Validation of a Config, and its encoding into registers.

#include "mb4/config.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mb4/detail/control_time.hpp"
#include "mb4/device.hpp"
#include "mb4/register_image.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace config_test {

using mb4::Config;
using mb4::ConfigField;
using mb4::Error;
using mb4::ErrorInfo;
using mb4test::Bytes;
using mb4test::encoder26;
using mb4test::FakeClock;
using mb4test::hex;
using mb4test::StrictBus;

// A Config can be checked by the compiler.
static_assert(mb4::validate(encoder26()).ok());
constexpr Config without_slave() {
  Config config = encoder26();
  config.slaves[0].enabled = false;
  return config;
}
static_assert(mb4::validate(without_slave()).info().field == ConfigField::kSlaveEnabled);

// ---- Impossible values --------------------------------------------------------------------------

struct BadConfig {
  const char* name;
  Config (*make)();
  Error error;
  ConfigField field;
  unsigned number;
};

template <typename Change>
Config changed(Change change) {
  Config config = encoder26();
  change(config);
  return config;
}

Config periodic(std::uint32_t period_clk) {
  return changed([=](Config& c) {
    c.frame_start = mb4::FrameStart::kPeriodic;
    c.frame_period_clk = period_clk;
  });
}

Config biss_b(std::uint16_t register_divider) {
  return changed([=](Config& c) {
    c.channels[0].protocol = mb4::Protocol::kBissB;
    c.register_divider = register_divider;
  });
}

const BadConfig kBadConfigs[] = {
    {"DefaultConfig", [] { return Config(); }, Error::kInvalidConfig, ConfigField::kMaHz, 0},
    {"NoSystemClock", [] { return changed([](Config& c) { c.f_clk_hz = 0; }); },
     Error::kInvalidConfig, ConfigField::kClkHz, 0},
    {"ClkAbove25MHz", [] { return changed([](Config& c) { c.f_clk_hz = 25'000'001; }); },
     Error::kInvalidConfig, ConfigField::kClkHz, 0},
    {"InternalClkBelow10MHz",
     [] {
       return changed([](Config& c) {
         c.clock_source = mb4::ClockSource::kInternal;
         c.f_clk_hz = 8'000'000;
       });
     },
     Error::kInvalidConfig, ConfigField::kClkHz, 0},
    {"UnknownClockSource",
     [] { return changed([](Config& c) { c.clock_source = static_cast<mb4::ClockSource>(2); }); },
     Error::kInvalidConfig, ConfigField::kClockSource, 0},
    {"MaZero", [] { return changed([](Config& c) { c.ma_hz = 0; }); }, Error::kInvalidConfig,
     ConfigField::kMaHz, 0},
    {"MaNotInTable35", [] { return changed([](Config& c) { c.ma_hz = 3'000'000; }); },
     Error::kInvalidConfig, ConfigField::kMaHz, 0},
    // f_CLK / 2 / (0x10 + 1), as if the first rule of the table went on to the forbidden code.
    {"MaOfForbiddenCode", [] { return changed([](Config& c) { c.ma_hz = 588'235; }); },
     Error::kInvalidConfig, ConfigField::kMaHz, 0},
    {"MaAboveHalfClk", [] { return changed([](Config& c) { c.ma_hz = 20'000'000; }); },
     Error::kInvalidConfig, ConfigField::kMaHz, 0},
    {"MaRoundedUp", [] { return changed([](Config& c) { c.ma_hz = 3'333'334; }); },
     Error::kInvalidConfig, ConfigField::kMaHz, 0},
    {"UnknownInterface",
     [] {
       return changed([](Config& c) { c.line_interface = static_cast<mb4::LineInterface>(4); });
     },
     Error::kInvalidConfig, ConfigField::kLineInterface, 0},
    {"UnknownFrameStart",
     [] { return changed([](Config& c) { c.frame_start = static_cast<mb4::FrameStart>(3); }); },
     Error::kInvalidConfig, ConfigField::kFrameStart, 0},
    {"TimeoutTooLong", [] { return changed([](Config& c) { c.frame_timeout_us = 1'000'001; }); },
     Error::kInvalidConfig, ConfigField::kFrameTimeoutUs, 0},
    {"Channel1Unused",
     [] { return changed([](Config& c) { c.channels[0].protocol = mb4::Protocol::kUnused; }); },
     Error::kInvalidConfig, ConfigField::kChannelProtocol, 1},
    {"Channel1UnknownProtocol",
     [] {
       return changed([](Config& c) { c.channels[0].protocol = static_cast<mb4::Protocol>(4); });
     },
     Error::kInvalidConfig, ConfigField::kChannelProtocol, 1},
    {"Channel2BissCWithoutSlave",
     [] { return changed([](Config& c) { c.channels[1].protocol = mb4::Protocol::kBissC; }); },
     Error::kInvalidConfig, ConfigField::kSlaveEnabled, 5},
    {"Channel2SsiWithoutSlave",
     [] { return changed([](Config& c) { c.channels[1].protocol = mb4::Protocol::kSsi; }); },
     Error::kInvalidConfig, ConfigField::kSlaveEnabled, 5},
    {"SlaveOnUnusedChannel1",
     [] {
       return changed([](Config& c) {
         c.channels[0].protocol = mb4::Protocol::kUnused;
         c.channels[1].protocol = mb4::Protocol::kBissC;
         c.slaves[4] = c.slaves[0];
       });
     },
     Error::kInvalidConfig, ConfigField::kSlaveEnabled, 1},
    {"Channel2UnknownProtocol",
     [] {
       return changed([](Config& c) { c.channels[1].protocol = static_cast<mb4::Protocol>(9); });
     },
     Error::kInvalidConfig, ConfigField::kChannelProtocol, 2},
    {"NoSlave", without_slave, Error::kInvalidConfig, ConfigField::kSlaveEnabled, 1},
    {"Slave2WithoutLength", [] { return changed([](Config& c) { c.slaves[1].enabled = true; }); },
     Error::kInvalidConfig, ConfigField::kDataBits, 2},
    {"Slave8WithEvenPolynomial",
     [] {
       return changed([](Config& c) {
         c.slaves[7] = c.slaves[0];
         c.slaves[7].crc_polynomial = 0x42;
       });
     },
     Error::kInvalidConfig, ConfigField::kCrcPolynomial, 8},
    {"PeriodWithoutPeriodicFrames",
     [] { return changed([](Config& c) { c.frame_period_clk = 1000; }); }, Error::kInvalidConfig,
     ConfigField::kFramePeriodClk, 0},
    {"PeriodicFramesWithoutPeriod",
     [] { return changed([](Config& c) { c.frame_start = mb4::FrameStart::kPeriodic; }); },
     Error::kInvalidConfig, ConfigField::kFramePeriodClk, 0},
    {"PeriodNotInTable37", [] { return periodic(1010); }, Error::kInvalidConfig,
     ConfigField::kFramePeriodClk, 0},
    // 39 + 0.55 periods of 10 clocks are 395.5 clocks; 380 is in the table.
    {"PeriodShorterThanFrame", [] { return periodic(380); }, Error::kInvalidConfig,
     ConfigField::kFramePeriodClk, 0},
    {"RegisterBusyTooLong",
     [] { return changed([](Config& c) { c.register_busy_us = 10'000'001; }); },
     Error::kInvalidConfig, ConfigField::kRegisterBusyUs, 0},
    {"NoDataBits", [] { return changed([](Config& c) { c.slaves[0].data_bits = 0; }); },
     Error::kInvalidConfig, ConfigField::kDataBits, 1},
    {"DataBits65", [] { return changed([](Config& c) { c.slaves[0].data_bits = 65; }); },
     Error::kInvalidConfig, ConfigField::kDataBits, 1},
    {"FlagsWithoutPosition", [] { return changed([](Config& c) { c.slaves[0].data_bits = 2; }); },
     Error::kInvalidConfig, ConfigField::kFlags, 1},
    {"UnknownFlags",
     [] { return changed([](Config& c) { c.slaves[0].flags = static_cast<mb4::Flags>(2); }); },
     Error::kInvalidConfig, ConfigField::kFlags, 1},
    {"CrcPolynomialEven",
     [] { return changed([](Config& c) { c.slaves[0].crc_polynomial = 0x42; }); },
     Error::kInvalidConfig, ConfigField::kCrcPolynomial, 1},
    {"CrcPolynomialOne",
     [] { return changed([](Config& c) { c.slaves[0].crc_polynomial = 0x1; }); },
     Error::kInvalidConfig, ConfigField::kCrcPolynomial, 1},
    {"CrcPolynomialOfDegree8",
     [] { return changed([](Config& c) { c.slaves[0].crc_polynomial = 0x11D; }); },
     Error::kInvalidConfig, ConfigField::kCrcPolynomial, 1},
    {"CrcPolynomialOfDegree16",
     [] { return changed([](Config& c) { c.slaves[0].crc_polynomial = 0x18005; }); },
     Error::kInvalidConfig, ConfigField::kCrcPolynomial, 1},
    {"UnknownSpiCheck",
     [] { return changed([](Config& c) { c.spi_check = static_cast<mb4::SpiCheck>(4); }); },
     Error::kInvalidConfig, ConfigField::kSpiCheck, 0},
    // Table 19: an SSI encoder's.
    {"GrayWithBissC", [] { return changed([](Config& c) { c.slaves[0].gray = true; }); },
     Error::kInvalidConfig, ConfigField::kGray, 1},
    {"ActuatorWithoutMo", [] { return changed([](Config& c) { c.slaves[0].actuator = true; }); },
     Error::kInvalidConfig, ConfigField::kActuator, 1},
    {"ActuatorOnSsi",
     [] {
       return changed([](Config& c) {
         c.mo = true;
         c.channels[0].protocol = mb4::Protocol::kSsi;
         c.slaves[0].actuator = true;
       });
     },
     Error::kInvalidConfig, ConfigField::kActuator, 1},
    {"MoBusyWithoutMo", [] { return changed([](Config& c) { c.mo_busy = 1; }); },
     Error::kInvalidConfig, ConfigField::kMoBusy, 0},
    {"RegisterTimeoutTooLong",
     [] { return changed([](Config& c) { c.register_timeout_us = 1'000'001; }); },
     Error::kInvalidConfig, ConfigField::kRegisterTimeoutUs, 0},
    {"PinPeriodTooLong",
     [] {
       return changed([](Config& c) {
         c.frame_start = mb4::FrameStart::kOnPin;
         c.pin_period_us = 1'000'001;
       });
     },
     Error::kInvalidConfig, ConfigField::kPinPeriodUs, 0},
    // 26 bits, a CRC of 6 and 5 periods of MA at 1 MHz are 37 us.
    {"PinPeriodShorterThanAFrame",
     [] {
       return changed([](Config& c) {
         c.frame_start = mb4::FrameStart::kOnPin;
         c.ma_hz = 1'000'000;
         c.pin_period_us = 36;
       });
     },
     Error::kInvalidConfig, ConfigField::kPinPeriodUs, 0},
    {"PinPeriodWithoutPin", [] { return changed([](Config& c) { c.pin_period_us = 1; }); },
     Error::kInvalidConfig, ConfigField::kPinPeriodUs, 0},
    // Table 36: 2 to 256 in powers of two, FREQR = 5 with BiSS C.
    {"RegisterDividerOne", [] { return biss_b(1); }, Error::kInvalidConfig,
     ConfigField::kRegisterDivider, 0},
    {"RegisterDivider48", [] { return biss_b(48); }, Error::kInvalidConfig,
     ConfigField::kRegisterDivider, 0},
    {"RegisterDivider512", [] { return biss_b(512); }, Error::kInvalidConfig,
     ConfigField::kRegisterDivider, 0},
    {"RegisterDivider32WithBissC",
     [] { return changed([](Config& c) { c.register_divider = 32; }); }, Error::kInvalidConfig,
     ConfigField::kRegisterDivider, 0},
    {"CrcStartWithoutCrc",
     [] {
       return changed([](Config& c) {
         c.slaves[0].crc_polynomial = 0;
         c.slaves[0].crc_start = 1;
       });
     },
     Error::kInvalidConfig, ConfigField::kCrcStart, 1},
};

class ConfigValidation : public testing::TestWithParam<BadConfig> {};

// StrictBus fails the test on any transfer.
TEST_P(ConfigValidation, ImpossibleValue_NamesMemberWithoutTransfer) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  const ErrorInfo info = device.configure(GetParam().make()).info();
  EXPECT_EQ(info.code, GetParam().error);
  EXPECT_EQ(info.field, GetParam().field) << mb4::to_string(info.field);
  EXPECT_EQ(info.number, GetParam().number);
  EXPECT_FALSE(device.configured());
}

INSTANTIATE_TEST_SUITE_P(Table, ConfigValidation, testing::ValuesIn(kBadConfigs),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Config, BoundaryValues_AreValid) {
  for (const unsigned data_bits : {1U, 2U, 3U, 63U, 64U}) {
    Config config = encoder26();
    config.slaves[0].data_bits = static_cast<std::uint8_t>(data_bits);
    config.slaves[0].flags = data_bits < 3 ? mb4::Flags::kNone : mb4::Flags::kErrorWarning;
    EXPECT_TRUE(mb4::validate(config).ok()) << data_bits;
  }
  for (const std::uint32_t f_clk_hz : {1'000'000U, 25'000'000U}) {
    Config config = encoder26();
    config.f_clk_hz = f_clk_hz;
    config.ma_hz = f_clk_hz / 2;
    EXPECT_TRUE(mb4::validate(config).ok()) << f_clk_hz;
  }
}

// An actuator delivers no flags, so a word of two bits is long enough.
TEST(Config, FlagsOfAnActuator_AreNotLookedAt) {
  Config config = encoder26();
  config.slaves[0].data_bits = 2;
  EXPECT_EQ(mb4::validate(config).info().field, ConfigField::kFlags);
  config.mo = config.slaves[0].actuator = true;
  EXPECT_TRUE(mb4::validate(config).ok());
}

// Page 26: the top byte, for a CRC of 16 bits two of them; if the data leaves them free.
TEST(Config, StoredCrc_NeedsACrcACheckAndRoom) {
  Config config = encoder26();
  const auto is_stored = [&config] { return mb4::crc_is_stored(config, config.slaves[0]); };
  EXPECT_FALSE(is_stored());  // SpiCheck::kOff
  config.spi_check = mb4::SpiCheck::kCrc;
  for (const std::uint32_t polynomial : {0x43U, 0x190D9U}) {
    config.slaves[0].crc_polynomial = polynomial;
    const unsigned longest = polynomial == 0x43 ? 56 : 48;
    config.slaves[0].data_bits = static_cast<std::uint8_t>(longest);
    EXPECT_TRUE(is_stored());
    config.slaves[0].data_bits = static_cast<std::uint8_t>(longest + 1);
    EXPECT_FALSE(is_stored());
  }
  config.slaves[0].data_bits = 28;
  config.slaves[0].crc_polynomial = 0;
  EXPECT_FALSE(is_stored());
}

TEST(Config, WithoutChannel_LeavesTheOther) {
  Config config = encoder26();
  config.channels[1].protocol = mb4::Protocol::kBissC;
  config.slaves[4] = config.slaves[0];
  for (const unsigned channel : {0U, 1U, 2U, 3U}) {
    const Config left = mb4::without_channel(config, static_cast<std::uint8_t>(channel));
    EXPECT_EQ(left.channels[0].protocol == mb4::Protocol::kBissC, channel != 1);
    EXPECT_EQ(left.channels[1].protocol == mb4::Protocol::kBissC, channel != 2);
    EXPECT_EQ(left.slaves[0].enabled, channel != 1);
  }
  EXPECT_FALSE(mb4::without_channel(config, 2).slaves[4].enabled);
}

TEST(Config, MembersOfDisabledSlave_AreNotLookedAt) {
  Config config = encoder26();
  config.slaves[1].data_bits = 99;
  config.slaves[1].crc_polynomial = 0x42;
  EXPECT_TRUE(mb4::validate(config).ok());
}

// ---- FREQS: table 35, page 30 -------------------------------------------------------------------

// f_CLK / f_MA by code, from the table: 2 for 0x00; 2 * (code + 1) for 0x01..0x0F; 0x10 not
// permitted; 40 for 0x11; 20 * (code - 15) for 0x12..0x1F.
constexpr std::array<std::uint32_t, 32> kTable35 = {
    2, 4,  6,  8,  10,  12,  14,  16,  18,  20,  22,  24,  26,  28,  30,  32,
    0, 40, 60, 80, 100, 120, 140, 160, 180, 200, 220, 240, 260, 280, 300, 320};

class Freqs : public testing::TestWithParam<unsigned> {};

TEST_P(Freqs, LegalCode_IsFoundFromItsFrequency) {
  const std::uint8_t code = static_cast<std::uint8_t>(GetParam());
  EXPECT_EQ(mb4::ma_divider(code), kTable35[code]);
  for (const std::uint32_t f_clk_hz : {1'000'000U, 12'500'000U, 20'000'000U, 24'999'999U}) {
    const mb4::Result<std::uint8_t> found = mb4::freqs_code(f_clk_hz, f_clk_hz / kTable35[code]);
    ASSERT_TRUE(found.ok()) << f_clk_hz;
    EXPECT_EQ(*found, code) << f_clk_hz;
  }
  Config config = encoder26();
  config.ma_hz = config.f_clk_hz / kTable35[code];
  ASSERT_TRUE(mb4::validate(config).ok());
  // Table 36: FREQR = 5 in bits 7:5 beside it.
  EXPECT_EQ(mb4::encode_registers(config)[0xE6 - 0xC0], 0xA0 | code);
}

std::vector<unsigned> legal_codes() {
  std::vector<unsigned> codes;
  for (unsigned code = 0; code < 32; ++code) {
    if (code != 0x10) {
      codes.push_back(code);
    }
  }
  return codes;
}

INSTANTIATE_TEST_SUITE_P(All, Freqs, testing::ValuesIn(legal_codes()),
                         [](const auto& test) { return "Code" + std::to_string(test.param); });

TEST(FreqsCode, IllegalCodes_HaveNoDivider) {
  EXPECT_EQ(mb4::ma_divider(0x10), 0U);
  EXPECT_EQ(mb4::ma_divider(32), 0U);
  EXPECT_EQ(mb4::ma_divider(255), 0U);
}

// Less than 1 Hz is no frequency, although it rounds down to the 0 of a member that is not set.
TEST(FreqsCode, Zero_IsNoFrequency) {
  EXPECT_EQ(mb4::freqs_code(1, 0).info().field, ConfigField::kMaHz);
  EXPECT_EQ(mb4::freqs_code(20'000'000, 0).info().field, ConfigField::kMaHz);
}

TEST(MaHzAtMost, BetweenTwoFrequencies_TakesTheLower) {
  EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 3'000'000), 2'500'000U);  // / 8
  EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 600'000), 500'000U);      // / 40, / 34 is forbidden
  EXPECT_EQ(mb4::ma_hz_at_most(25'000'000, 1'000'000), 961'538U);    // / 26 = 961538.46
}

TEST(MaHzAtMost, ExactLimit_IsMet) {
  EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 10'000'000), 10'000'000U);
  EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 62'500), 62'500U);
}

TEST(MaHzAtMost, LimitBelowAFraction_DoesNotExceedIt) {
  // 20 MHz / 6 = 3333333.3 Hz exceeds 3333333 Hz, so the next slower one is taken.
  EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 3'333'333), 2'500'000U);
  EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 3'333'334), 3'333'333U);
}

TEST(MaHzAtMost, AboveEverything_IsHalfTheClock) {
  EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 0xFFFFFFFF), 10'000'000U);
}

TEST(MaHzAtMost, BelowEverything_IsZero) { EXPECT_EQ(mb4::ma_hz_at_most(20'000'000, 62'499), 0U); }

// ---- Register image -----------------------------------------------------------------------------

std::string image_text(const Config& config) {
  const mb4::RegisterImage image = mb4::encode_registers(config);
  return hex(Bytes(image.begin(), image.end()));
}

TEST(RegisterImage, Encoder26_MatchesHandWorkedBytes) {
  EXPECT_EQ(image_text(encoder26()),
            hex(mb4test::join({mb4test::configuration(), {0x00, 0x00, 0x00}})));
}

std::uint8_t image_byte(const Config& config, std::uint8_t address) {
  return mb4::encode_registers(config)[address - 0xC0U];
}

// Table 12: code + 1 bits; ENSCD is bit 6.
TEST(RegisterImage, DataBits_BecomeLengthMinusOne) {
  for (unsigned data_bits = 1; data_bits <= 64; ++data_bits) {
    Config config = encoder26();
    config.slaves[0].flags = mb4::Flags::kNone;
    config.slaves[0].data_bits = static_cast<std::uint8_t>(data_bits);
    EXPECT_EQ(image_byte(config, 0xC0), 0x40 + data_bits - 1) << data_bits;
  }
}

// Tables 13 to 15; 0x43 as 0x21 is the datasheet's own example of an individual polynomial, which
// is not needed for it because it is predefined. 0x97 is stored as 0x4B.
TEST(RegisterImage, CrcPolynomial_SelectsLengthOrPolynomial) {
  const struct {
    std::uint32_t polynomial;
    unsigned byte;
  } cases[] = {{0x0, 0x00},  {0xB, 0x03},  {0x13, 0x04},  {0x25, 0x05},
               {0x43, 0x06}, {0x89, 0x07}, {0x12F, 0x08}, {0x190D9, 0x10},
               {0x97, 0xCB}, {0x3, 0x81},  {0xFF, 0xFF},  {0xD, 0x86}};
  for (const auto& one : cases) {
    Config config = encoder26();
    config.slaves[0].crc_polynomial = one.polynomial;
    ASSERT_TRUE(mb4::validate(config).ok()) << one.polynomial;
    EXPECT_EQ(image_byte(config, 0xC1), one.byte) << std::hex << one.polynomial;
  }
}

// Table 16: low byte at 0xC2, high byte at 0xC3.
TEST(RegisterImage, CrcStart_IsLowByteFirst) {
  Config config = encoder26();
  config.slaves[0].crc_start = 0xABCD;
  EXPECT_EQ(image_byte(config, 0xC2), 0xCD);
  EXPECT_EQ(image_byte(config, 0xC3), 0xAB);
}

// Table 21: NOCRC is bit 1 of 0xE7.
TEST(RegisterImage, StoreCrc_ClearsNocrc) {
  Config config = encoder26();
  config.spi_check = mb4::SpiCheck::kCrc;
  EXPECT_EQ(image_byte(config, 0xE7), 0x00);
}

// Table 8: CFGCH1 in bits 1:0, CFGCH2 in 3:2 of 0xED; table 24: CTS, bit 7 of 0xE5, is 1 at rest;
// table 26: REGVERS, bit 6 of 0xE5, is 0 for
// BiSS B registers; table 36: FREQR in bits 7:5 of 0xE6.
TEST(RegisterImage, Protocols_AreCfgchRegversFreqr) {
  const struct {
    mb4::Protocol first, second;
    unsigned cfgch, ctrl;
  } cases[] = {{mb4::Protocol::kBissB, mb4::Protocol::kUnused, 0x0C, 0x80},
               {mb4::Protocol::kSsi, mb4::Protocol::kUnused, 0x0E, 0xC0},
               {mb4::Protocol::kSsi, mb4::Protocol::kBissB, 0x02, 0x80},
               {mb4::Protocol::kBissB, mb4::Protocol::kBissC, 0x04, 0xC0}};
  for (const auto& one : cases) {
    Config config = encoder26();
    config.channels[0].protocol = one.first;
    config.channels[1].protocol = one.second;
    config.slaves[4] = config.slaves[0];
    config.slaves[4].enabled = one.second != mb4::Protocol::kUnused;
    ASSERT_TRUE(mb4::validate(config).ok());
    EXPECT_EQ(image_byte(config, 0xED), one.cfgch);
    EXPECT_EQ(image_byte(config, 0xE5), one.ctrl);
  }
  for (unsigned freqr = 0; freqr < 8; ++freqr) {
    const Config config = biss_b(static_cast<std::uint16_t>(2U << freqr));
    ASSERT_TRUE(mb4::validate(config).ok());
    EXPECT_EQ(image_byte(config, 0xE6), freqr << 5 | 4);
  }
}

// Table 19: GRAYS1 is bit 7 of 0xC0.
TEST(RegisterImage, Gray_IsBit7) {
  Config config = encoder26();
  config.channels[0].protocol = mb4::Protocol::kSsi;
  EXPECT_EQ(image_byte(config, 0xC0), 0x5B);
  config.slaves[0].gray = true;
  ASSERT_TRUE(mb4::validate(config).ok());
  EXPECT_EQ(image_byte(config, 0xC0), 0xDB);
}

// Tables 17, 18, 39, 40: ACTnSENS in 0xEF, LSTOPx bit 7 of 0xC0 + 4 (x - 1), EN_MO bit 1 of 0xE5,
// MO_BUSY in 0xE9.
TEST(RegisterImage, Actuators_AreActnsensLstopEnmoMobusy) {
  Config config = encoder26();
  config.mo = true;
  config.mo_busy = 0xA5;
  config.slaves[3] = config.slaves[2] = config.slaves[0];
  config.slaves[2].actuator = config.slaves[3].actuator = true;
  config.slaves[3].stop_bit = false;
  ASSERT_TRUE(mb4::validate(config).ok());
  EXPECT_EQ(image_byte(config, 0xEF), 0x0C);
  EXPECT_EQ(image_byte(config, 0xC0), 0x5B);
  EXPECT_EQ(image_byte(config, 0xC8), 0xDB);
  EXPECT_EQ(image_byte(config, 0xCC), 0x5B);
  EXPECT_EQ(image_byte(config, 0xE5), 0xC2);
  EXPECT_EQ(image_byte(config, 0xE9), 0xA5);
  EXPECT_EQ(mb4::sensors(config), 0x01);
}

// Page 32: AGSMIN (0x7C) waits for SL; any other FREQAGS makes SL = 0 an error.
TEST(RegisterImage, RequireIdleLine_IsNotAgsMin) {
  Config config = encoder26();
  config.frame_start = mb4::FrameStart::kRequireIdleLine;
  EXPECT_EQ(image_byte(config, 0xE8), 0x7D);
}

// Tables 7 and 9: CLKENI is bit 0, CFGIF bits 3:2 of 0xF5; everything else stays 0.
TEST(RegisterImage, InterfaceByte_HoldsClockSourceAndLevels) {
  Config config = encoder26();
  EXPECT_EQ(mb4::encode_interface(config), 0x00);
  config.clock_source = mb4::ClockSource::kInternal;
  EXPECT_EQ(mb4::encode_interface(config), 0x01);
  config.line_interface = mb4::LineInterface::kRs422;
  EXPECT_EQ(mb4::encode_interface(config), 0x09);
  config.line_interface = mb4::LineInterface::kLvds;
  config.clock_source = mb4::ClockSource::kExternal;
  EXPECT_EQ(mb4::encode_interface(config), 0x0C);
}

// ---- Derived figures ----------------------------------------------------------------------------

TEST(FrameTimeout, Configured_IsTakenAsItIs) {
  Config config = encoder26();
  config.frame_timeout_us = 77;
  EXPECT_EQ(mb4::frame_timeout_us(config), 77U);
}

// 5 + 28 + 6 periods of 0.5 us = 19.5 us, and the margin.
TEST(FrameTimeout, Zero_IsCalculatedFromTheFrame) {
  EXPECT_EQ(mb4::frame_timeout_us(encoder26()), 20U + mb4::kFrameMarginUs);
}

// 5 + 64 + 16 periods of 16 us = 1360 us: no overflow, not shorter than the frame.
TEST(FrameTimeout, LongestSlowestFrame_IsCovered) {
  Config config = encoder26();
  config.ma_hz = 62'500;
  config.slaves[0].data_bits = 64;
  config.slaves[0].crc_polynomial = 0x190D9;
  EXPECT_EQ(mb4::frame_timeout_us(config), 1361U + mb4::kFrameMarginUs);
}

// BiSS B has no CDS, SSI L + 1 edges; an actuator's stop bit and MO_BUSY count.
TEST(FrameTimeout, EveryProtocol_HasItsPeriods) {
  Config config = encoder26();
  EXPECT_EQ(mb4::frame_periods(config), 39U);
  config.channels[0].protocol = mb4::Protocol::kBissB;
  EXPECT_EQ(mb4::frame_periods(config), 38U);
  config.channels[0].protocol = mb4::Protocol::kSsi;
  EXPECT_EQ(mb4::frame_periods(config), 35U);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.mo = config.slaves[0].actuator = true;
  config.mo_busy = 20;
  EXPECT_EQ(mb4::frame_periods(config), 60U);
}

// D05: the oscillator may be 2.5 times slower than stated.
TEST(FrameTimeout, InternalClock_AllowsForItsSpread) {
  Config config = encoder26();
  config.clock_source = mb4::ClockSource::kInternal;
  EXPECT_EQ(mb4::frame_timeout_us(config), 59U + mb4::kFrameMarginUs);
}

// IDs count from the far end, on each channel for itself.
TEST(SlaveAddress, ThreeOnChannel1AndOneOnChannel2_CountFromTheFarEnd) {
  Config config = encoder26();
  config.slaves[1] = config.slaves[2] = config.slaves[4] = config.slaves[0];
  config.channels[1].protocol = mb4::Protocol::kBissC;
  for (std::uint8_t slave = 1; slave <= 3; ++slave) {
    EXPECT_EQ(mb4::slave_address(config, slave).channel, 1);
    EXPECT_EQ(mb4::slave_address(config, slave).id, 3 - slave);
  }
  EXPECT_EQ(mb4::slave_address(config, 5).channel, 2);
  EXPECT_EQ(mb4::slave_address(config, 5).id, 0);
}

// Page 16: ID 0 of BiSS B is unused where MO is in use.
TEST(SlaveAddress, WithMo_BissBCountsFrom1) {
  Config config = encoder26();
  for (const bool mo : {false, true}) {
    config.mo = mo;
    config.channels[0].protocol = mb4::Protocol::kBissC;
    EXPECT_EQ(mb4::slave_address(config, 1).id, 0);
    config.channels[0].protocol = mb4::Protocol::kBissB;
    EXPECT_EQ(mb4::slave_address(config, 1).id, mo ? 1 : 0);
  }
}

// The frames of activate() would send words that nobody has written; and they are those of BiSS C.
TEST(Validate, ActivateAtInitialize_NeedsBissCAndNoActuator) {
  Config config = encoder26();
  config.activate_at_initialize = true;
  EXPECT_TRUE(mb4::validate(config).ok());
  config.mo = config.slaves[0].actuator = true;
  EXPECT_EQ(mb4::validate(config).info().field, ConfigField::kActivateAtInitialize);
  config = encoder26();
  config.activate_at_initialize = true;
  config.channels[0].protocol = mb4::Protocol::kSsi;
  EXPECT_EQ(mb4::validate(config).info().code, Error::kInvalidConfig);
  EXPECT_EQ(mb4::validate(config).info().field, ConfigField::kActivateAtInitialize);
}

TEST(Names, EveryErrorAndField_HasOne) {
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(Error::kNoWord); ++i) {
    EXPECT_STRNE(mb4::to_string(static_cast<Error>(i)), "unknown");
  }
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(ConfigField::kPinPeriodUs); ++i) {
    EXPECT_STRNE(mb4::to_string(static_cast<ConfigField>(i)), "unknown");
  }
  EXPECT_STREQ(mb4::to_string(static_cast<Error>(250)), "unknown");
  EXPECT_STREQ(mb4::to_string(static_cast<ConfigField>(250)), "unknown");
}

// Actuators of 28 and 27 bits on the two channels.
Config two_actuators() {
  Config config = mb4test::encoder26();
  config.mo = true;
  config.channels[1].protocol = mb4::Protocol::kBissC;
  config.slaves[0].actuator = true;
  config.slaves[4] = config.slaves[0];
  config.slaves[4].data_bits = 27;
  return config;
}

// Table 68, entry 2: actuators on both channels with different SCD length, before revision Y.
TEST(Revision, ActuatorsOnBothChannelsOfDifferentLength_NeedRevisionY) {
  Config config = two_actuators();
  const mb4::ErrorInfo wrong = mb4::validate(config, 0x11).info();
  EXPECT_EQ(wrong.code, Error::kInvalidConfig);
  EXPECT_EQ(wrong.field, ConfigField::kActuator);
  EXPECT_EQ(wrong.number, 5);
  EXPECT_EQ(mb4::validate(config, 0x10).error(), Error::kInvalidConfig);
  EXPECT_TRUE(mb4::validate(config, 0x20).ok());
  EXPECT_TRUE(mb4::validate(config).ok());
  config.slaves[4].data_bits = 28;
  EXPECT_TRUE(mb4::validate(config, 0x11).ok());
  config.slaves[4].data_bits = 27;
  config.slaves[4].actuator = false;
  EXPECT_TRUE(mb4::validate(config, 0x11).ok());
  config.slaves[4].actuator = true;
  config.slaves[0].actuator = false;
  EXPECT_TRUE(mb4::validate(config, 0x11).ok());
  config.slaves[0].actuator = true;
  config.channels[1].protocol = mb4::Protocol::kUnused;  // both on channel 1
  EXPECT_TRUE(mb4::validate(config, 0x11).ok());
  config.ma_hz = 0;
  EXPECT_EQ(mb4::validate(config, 0x20).info().field, ConfigField::kMaHz);
}

// configure() asks the chip before it writes.
TEST(Revision, ConfigureOnAnOldChip_IsRefusedBeforeAnyWrite) {
  Config config = two_actuators();
  for (const unsigned revision : {0x10U, 0x11U}) {
    mb4test::StrictBus bus;
    mb4test::FakeClock clock;
    mb4::Device<mb4test::StrictBus, mb4test::FakeClock> device(bus, clock);
    mb4test::expect_configure(bus);
    ASSERT_TRUE(device.configure(mb4test::encoder26()).ok());
    bus.expect_read({0x03, 0xEA, 0x00, 0x00},
                    {0x00, 0x00, static_cast<std::uint8_t>(revision), 0x84});
    EXPECT_EQ(device.configure(config).info().field, ConfigField::kActuator);
    EXPECT_FALSE(device.configured());
  }
  mb4test::StrictBus bus;
  mb4test::FakeClock clock;
  mb4::Device<mb4test::StrictBus, mb4test::FakeClock> device(bus, clock);
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(mb4test::encoder26()).ok());
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x11, 0x83});
  EXPECT_EQ(device.configure(config).error(), Error::kNotDetected);
  EXPECT_FALSE(device.configured());
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x20, 0x84});
  bus.expect_write({0x07, 0x80, 0x00}).fail_last();
  EXPECT_EQ(device.configure(config).error(), Error::kTransport);
}

}  // namespace config_test
}  // namespace
