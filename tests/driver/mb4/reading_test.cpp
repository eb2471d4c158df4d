// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Decoding of SCDATAx: table 20 and page 26.

#include "mb4/reading.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "mb4/frame.hpp"
#include "tests/driver/mb4/encoder26.hpp"

namespace {
namespace reading_test {

using mb4::Config;
using mb4::Error;
using mb4::Reading;
using mb4::Result;
using Word = std::array<std::uint8_t, 8>;

Result<Reading> decode(const Config& config, const Word& bytes) {
  return mb4::decode_reading(config, 1, bytes);
}

TEST(Reading, GoldenWord_SplitsIntoPositionAndFlags) {
  const Result<Reading> reading =
      decode(mb4test::encoder26(), Word{0xBF, 0x37, 0xAF, 0x0A, 0x99, 0x99, 0x99, 0x99});
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading->raw, mb4test::kRaw);
  EXPECT_EQ(reading->position, mb4test::kPosition);
  EXPECT_FALSE(reading->slave_error);
  EXPECT_FALSE(reading->slave_warning);
  EXPECT_FALSE(reading->crc_stored);
  EXPECT_EQ(reading->slave, 1);
}

// The last two bits are nE, nW, active low.
TEST(Reading, FlagBits_AreActiveLow) {
  for (unsigned flags = 0; flags < 4; ++flags) {
    const Word bytes{static_cast<std::uint8_t>(0xBC | flags), 0x37, 0xAF, 0x0A};
    const Result<Reading> reading = decode(mb4test::encoder26(), bytes);
    const bool error = flags == 0 || flags == 1;
    EXPECT_EQ(reading.error(), error ? mb4::Error::kSlaveError : mb4::Error::kNone);
    EXPECT_EQ(reading.reading().position, mb4test::kPosition);
    EXPECT_EQ(reading.reading().slave_error, error);
    EXPECT_EQ(reading.reading().slave_warning, flags == 0 || flags == 2);
    EXPECT_EQ(reading.value_or(Reading()).position, error ? 0 : mb4test::kPosition);
  }
}

TEST(Reading, WithoutFlags_PositionIsTheWholeWord) {
  Config config = mb4test::encoder26();
  config.slaves[0].flags = mb4::Flags::kNone;
  const Result<Reading> reading = decode(config, Word{0xBC, 0x37, 0xAF, 0x0A});
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading->position, 0xAAF37BCU);
  EXPECT_FALSE(reading->slave_error);
  EXPECT_FALSE(reading->slave_warning);
}

// Page 26: bytes that the data does not need remain unchanged, so they must not count.
TEST(Reading, EveryLength_TakesItsBytesOnly) {
  const Word ones{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
  for (unsigned data_bits = 1; data_bits <= 64; ++data_bits) {
    Config config = mb4test::encoder26();
    config.slaves[0].flags = mb4::Flags::kNone;
    config.slaves[0].data_bits = static_cast<std::uint8_t>(data_bits);
    const unsigned data_bytes = (data_bits + 7) / 8;
    EXPECT_EQ(mb4::reading_bytes(config, 1), data_bytes);
    Word bytes = ones;
    if (data_bits % 8 != 0) {
      bytes[data_bytes - 1] = static_cast<std::uint8_t>((1U << (data_bits % 8)) - 1);
    }
    const Result<Reading> reading = decode(config, bytes);
    ASSERT_TRUE(reading.ok()) << data_bits;
    EXPECT_EQ(reading->raw, ~std::uint64_t{0} >> (64 - data_bits)) << data_bits;
  }
}

// Page 26: "unused bits are set to zero".
TEST(Reading, UnusedBitSet_IsCorrupted) {
  EXPECT_EQ(decode(mb4test::encoder26(), Word{0xBF, 0x37, 0xAF, 0x1A}).error(), Error::kCorrupted);
  EXPECT_EQ(decode(mb4test::encoder26(), Word{0xFF, 0xFF, 0xFF, 0xFF}).error(), Error::kCorrupted);
}

Config with_stored_crc(std::uint8_t data_bits, std::uint32_t polynomial) {
  Config config = mb4test::encoder26();
  config.spi_check = mb4::SpiCheck::kCrc;
  config.slaves[0].data_bits = data_bits;
  config.slaves[0].crc_polynomial = polynomial;
  return config;
}

// Table 22: the CRC is right aligned in the top byte.
TEST(Reading, StoredCrc6_IsReturnedFromTheTopByte) {
  const Config config = with_stored_crc(28, 0x43);
  EXPECT_EQ(mb4::reading_bytes(config, 1), 8U);
  const Result<Reading> reading =
      decode(config, Word{0xBF, 0x37, 0xAF, 0x0A, 0x99, 0x99, 0x99, mb4test::kCrc6});
  ASSERT_TRUE(reading.ok());
  EXPECT_TRUE(reading->crc_stored);
  EXPECT_EQ(reading->crc, mb4test::kCrc6);
}

// Table 22, slave 3: CRC16 at bytes 6 (low) and 7 (high). 0x13F8 is the golden value.
TEST(Reading, StoredCrc16_IsReturnedFromTheTopTwoBytes) {
  const Result<Reading> reading =
      decode(with_stored_crc(28, 0x190D9), Word{0xBF, 0x37, 0xAF, 0x0A, 0x99, 0x99, 0xF8, 0x13});
  ASSERT_TRUE(reading.ok());
  EXPECT_TRUE(reading->crc_stored);
  EXPECT_EQ(reading->crc, 0x13F8);
}

TEST(Reading, StoredCrcOfOtherData_IsCorrupted) {
  for (unsigned bit = 0; bit < 28; ++bit) {
    Word bytes{0xBF, 0x37, 0xAF, 0x0A, 0x00, 0x00, 0x00, mb4test::kCrc6};
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_EQ(decode(with_stored_crc(28, 0x43), bytes).error(), Error::kCorrupted) << bit;
  }
}

TEST(Reading, UnusedBitBesideStoredCrc_IsCorrupted) {
  const Word bytes{0xBF, 0x37, 0xAF, 0x0A, 0x00, 0x00, 0x00, mb4test::kCrc6 | 0x80};
  EXPECT_EQ(decode(with_stored_crc(28, 0x43), bytes).error(), Error::kCorrupted);
}

TEST(Reading, NoRoomForCrc_IsReadWithoutIt) {
  EXPECT_TRUE(mb4::crc_is_stored(with_stored_crc(56, 0x43), with_stored_crc(56, 0x43).slaves[0]));
  EXPECT_FALSE(mb4::crc_is_stored(with_stored_crc(57, 0x43), with_stored_crc(57, 0x43).slaves[0]));
  EXPECT_TRUE(
      mb4::crc_is_stored(with_stored_crc(48, 0x190D9), with_stored_crc(48, 0x190D9).slaves[0]));
  EXPECT_FALSE(
      mb4::crc_is_stored(with_stored_crc(49, 0x190D9), with_stored_crc(49, 0x190D9).slaves[0]));
  const Result<Reading> reading = decode(with_stored_crc(64, 0x43), Word{3, 2, 3, 4, 5, 6, 7, 8});
  ASSERT_TRUE(reading.ok());
  EXPECT_FALSE(reading->crc_stored);
  EXPECT_EQ(reading->raw, 0x0807060504030203U);
}

// No byte is read outside the configuration and outside the caller's bytes.
TEST(Reading, SlaveOrBytesOutOfRange_IsInvalidArgument) {
  const Config config = mb4test::encoder26();
  const Word bytes{0xBF, 0x37, 0xAF, 0x0A};
  for (const unsigned slave : {0U, 9U, 32U, 255U}) {
    EXPECT_EQ(mb4::decode_reading(config, static_cast<std::uint8_t>(slave), bytes).error(),
              Error::kInvalidArgument)
        << slave;
  }
  const mb4::Span<const std::uint8_t> all(bytes);
  EXPECT_EQ(mb4::decode_reading(config, 1, all.first(3)).error(), Error::kInvalidArgument);
  EXPECT_TRUE(mb4::decode_reading(config, 1, all.first(4)).ok());
}

TEST(Frame, SlaveOutOfRange_IsInvalidArgument) {
  mb4::Frame frame;
  for (const std::size_t slave : {std::size_t{0}, std::size_t{9}, ~std::size_t{0}}) {
    frame.set(slave, Result<Reading>(Reading()));
    EXPECT_EQ(frame[slave].error(), Error::kInvalidArgument) << slave;
  }
  frame.set(8, Result<Reading>(Reading()));
  EXPECT_TRUE(frame[8].ok());
  EXPECT_TRUE(frame.good(0x80));
}

TEST(Result, ValueOfAnError_StopsTheProgram) {
  const Result<int> failed = Error::kCrc;
  EXPECT_FALSE(failed.ok());
  EXPECT_EQ(failed.value_or(7), 7);
  EXPECT_DEATH({ [[maybe_unused]] const int value = failed.value(); }, "");
}

}  // namespace reading_test
}  // namespace
