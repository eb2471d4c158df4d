// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Results and errors.

#include "mb4/result.hpp"

#include <gtest/gtest.h>

#include <csetjmp>
#include <csignal>
#include <cstdint>
#include <string>

#include "mb4/reading.hpp"

namespace {
namespace result_test {

using mb4::ConfigField;
using mb4::Error;
using mb4::ErrorInfo;
using mb4::Result;

TEST(Result, Value_IsGivenBack) {
  const Result<std::uint8_t> result = std::uint8_t{7};
  EXPECT_TRUE(result.ok());
  EXPECT_EQ(*result, 7);
  EXPECT_EQ(result.value_or(9), 7);
  EXPECT_EQ(result.error(), Error::kNone);
}

TEST(Result, Failure_CarriesEverything) {
  ErrorInfo info(Error::kInvalidConfig, ConfigField::kDataBits, 3);
  info.detail = 0xA5;
  const Result<std::uint8_t> first = info;
  const Result<void> second = first.failure();
  const Result<std::uint8_t> third = second.failure();
  EXPECT_EQ(third.info().code, Error::kInvalidConfig);
  EXPECT_EQ(third.info().field, ConfigField::kDataBits);
  EXPECT_EQ(third.info().number, 3);
  EXPECT_EQ(third.info().detail, 0xA5);
  EXPECT_EQ(third.value_or(9), 9);
}

// `detail` is an address or a number of registers, never both.
TEST(Result, Detail_MeansWhatTheCodeSays) {
  const ErrorInfo verify = ErrorInfo::at_register(Error::kVerify, 0xE6);
  EXPECT_EQ(verify.address(), 0xE6);
  EXPECT_EQ(verify.bytes(), 0);
  const ErrorInfo access = ErrorInfo::at_register(Error::kRegister, 12);
  EXPECT_EQ(access.address(), 0);
  EXPECT_EQ(access.bytes(), 12);
}

TEST(Result, Names_AreDifferentAndKnown) {
  for (unsigned code = 0; code <= static_cast<unsigned>(Error::kNoWord); ++code) {
    EXPECT_STRNE(to_string(static_cast<Error>(code)), "unknown") << code;
  }
  EXPECT_STREQ(to_string(static_cast<Error>(0xFF)), "unknown");
  EXPECT_STREQ(to_string(static_cast<ConfigField>(0xFF)), "unknown");
}

sigjmp_buf before_the_trap;
void on_trap(int signal) { siglongjmp(before_the_trap, signal); }

template <typename Call>
bool traps(Call call) {
  const int trap_signals[] = {SIGILL, SIGTRAP};  // of x86, and of others
  void (*before[2])(int) = {};
  for (int i = 0; i < 2; ++i) before[i] = std::signal(trap_signals[i], on_trap);
  volatile bool trapped = true;
  if (sigsetjmp(before_the_trap, 1) == 0) {
    call();
    trapped = false;
  }
  for (int i = 0; i < 2; ++i) std::signal(trap_signals[i], before[i]);
  return trapped;
}

// A reading whose nE is 0 comes with its error, and the value is refused.
TEST(Result, SlaveError_IsNoValueButHasItsReading) {
  mb4::Reading sent;
  sent.position = 5;
  sent.slave_error = true;
  const Result<mb4::Reading> result{sent, Error::kSlaveError};
  EXPECT_FALSE(result.ok());
  EXPECT_FALSE(result);
  EXPECT_EQ(result.error(), Error::kSlaveError);
  EXPECT_EQ(result.info().bytes(), 0);
  EXPECT_TRUE(result.has_reading());
  EXPECT_EQ(result.reading().position, 5U);
  EXPECT_EQ(result.value_or(mb4::Reading()).position, 0U);
  EXPECT_TRUE(traps([&] { static_cast<void>(result.value()); }));
  EXPECT_TRUE(traps([&] { static_cast<void>(*result); }));
  EXPECT_TRUE(traps([&] { static_cast<void>(result->position); }));
  // The error alone has no reading, also where it was passed on.
  const Result<mb4::Reading> other = Error::kCrc;
  EXPECT_FALSE(other.has_reading());
  EXPECT_TRUE(traps([&] { static_cast<void>(other.reading()); }));
  const Result<mb4::Reading> passed_on = result.failure();
  EXPECT_EQ(passed_on.error(), Error::kSlaveError);
  EXPECT_TRUE(traps([&] { static_cast<void>(passed_on.reading()); }));
  const Result<mb4::Reading> good = mb4::Reading();
  EXPECT_FALSE(good.reading().slave_error);
}

// What is not there is never handed out: the program stops.
TEST(Result, ValueOfAnError_Traps) {
  const Result<std::uint8_t> result = Error::kCrc;
  EXPECT_TRUE(traps([&] { static_cast<void>(result.value()); }));
}

}  // namespace result_test
}  // namespace
