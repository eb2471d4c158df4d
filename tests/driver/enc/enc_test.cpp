// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The shared parts as the driver of another master uses them: with errors of its own, without mb4.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "enc/bus.hpp"
#include "enc/crc.hpp"
#include "enc/position.hpp"
#include "enc/result.hpp"
#include "enc/span.hpp"

#ifdef MB4_SPAN_HPP_
#error "enc includes mb4"
#endif

namespace other {

enum class Error : std::uint8_t { kNone = 0, kInvalidArgument = 7, kJump = 9, kLink = 200 };

struct ErrorInfo {
  Error code = Error::kNone;
  std::uint16_t place = 0;

  constexpr ErrorInfo() = default;
  constexpr explicit ErrorInfo(Error error, std::uint16_t where = 0) : code(error), place(where) {}
  static constexpr std::uint32_t pack(ErrorInfo info) {
    return static_cast<std::uint32_t>(info.code) | std::uint32_t{info.place} << 8U;
  }
  static constexpr ErrorInfo unpack(std::uint32_t word) {
    return ErrorInfo(static_cast<Error>(word & 0xFFU), static_cast<std::uint16_t>(word >> 8U));
  }
};

template <typename T>
using Result = enc::Result<T, ErrorInfo>;

struct AnotherInfo : ErrorInfo {};

static_assert(!std::is_convertible_v<enc::Failure<AnotherInfo>, Result<int>>,
              "the failure of one driver is none of another");

}  // namespace other

namespace {

TEST(EncResult, ErrorOfAnotherDriver_IsKeptWhole) {
  constexpr other::Result<int> kFailed = other::ErrorInfo(other::Error::kLink, 0xBEEF);
  EXPECT_FALSE(kFailed.ok());
  EXPECT_EQ(kFailed.error(), other::Error::kLink);
  EXPECT_EQ(kFailed.info().place, 0xBEEF);
  const other::Result<void> passed_on = kFailed.failure();
  EXPECT_EQ(passed_on.error(), other::Error::kLink);
  EXPECT_EQ(passed_on.info().place, 0xBEEF);
  EXPECT_EQ(other::Result<int>(5).value(), 5);
  EXPECT_TRUE(other::Result<void>().ok());
}

TEST(EncPosition, ErrorsOfAnotherDriver_AreReported) {
  const auto turns = enc::split_turns<other::ErrorInfo>(0x12345, 8, 12);
  EXPECT_EQ(turns->multi, 0x12U);
  EXPECT_EQ(turns->single, 0x345U);
  EXPECT_EQ(enc::split_turns<other::ErrorInfo>(0, 0, 64).error(), other::Error::kInvalidArgument);
  enc::PositionTracker<other::ErrorInfo> tracker(8, 10);
  EXPECT_EQ(tracker.update(250).value(), 250);
  EXPECT_EQ(tracker.update(2).value(), 258);
  EXPECT_EQ(tracker.update(100).error(), other::Error::kJump);
}

TEST(EncBus, PlainFunctions_AreBusAndClock) {
  static_assert(enc::kIsBus<enc::FunctionBus> && enc::kIsClock<enc::FunctionClock>);
  static_assert(!enc::kIsBus<enc::FunctionClock> && !enc::kIsClock<enc::FunctionBus>);
  enc::FunctionBus bus(
      [](void*, const std::uint8_t* tx, std::uint8_t* rx, std::size_t size) {
        for (std::size_t i = 0; rx != nullptr && i < size; ++i) {
          rx[i] = static_cast<std::uint8_t>(tx[i] + 1);
        }
        return true;
      },
      nullptr);
  const std::uint8_t sent[] = {1, 2};
  std::uint8_t received[2] = {};
  EXPECT_TRUE(bus.transfer(sent, received));
  EXPECT_EQ(received[1], 3);
  EXPECT_TRUE(bus.transfer(sent, enc::Span<std::uint8_t>()));
}

// CRC-16-IBM of "123456789", most significant bit first, start 0: 0xFEE8, as catalogues of CRCs
// give it for CRC-16/UMTS.
TEST(EncCrc, CatalogueValue_IsFound) {
  enc::CrcShift shift(0x18005, 0);
  for (const char byte : {'1', '2', '3', '4', '5', '6', '7', '8', '9'}) {
    for (int bit = 7; bit >= 0; --bit) {
      shift.shift(static_cast<unsigned>(byte) >> bit & 1U);
    }
  }
  EXPECT_EQ(shift.value(), 0xFEE8);
}

}  // namespace
