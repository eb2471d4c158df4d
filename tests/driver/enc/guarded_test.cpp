// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The guard against calls that interrupt one another. That it costs nothing when it is off is a
// comparison of machine code (guard.sh).

#include "enc/guarded.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>
#include <type_traits>
#include <vector>

#include "mb4/mb4.hpp"

namespace {

unsigned reentries = 0;
struct Count {
  void operator()() const { ++reentries; }
};

// A device whose call lasts as long as `during`.
class Device {
 public:
  explicit Device(int& made) : made_(made) { ++made_; }
  class Part {
   public:
    explicit Part(Device& device) : device_(device) {}
    int call(const std::function<void()>& during) {
      ++device_.made_;
      if (during) during();
      return device_.made_;
    }

   private:
    Device& device_;
  };
  Part part() { return Part(*this); }

 private:
  int& made_;
};

using Checked = enc::Guarded<Device, Count, true>;
using Unchecked = enc::Guarded<Device, Count, false>;

class Guarded : public testing::Test {
 protected:
  void SetUp() override { reentries = 0; }
  int made = 0;
};

TEST_F(Guarded, CallsOneAfterTheOther_AreRight) {
  Checked device(made);
  for (int i = 2; i < 5; ++i) EXPECT_EQ(device->part().call(nullptr), i);
  EXPECT_EQ(reentries, 0U);
}

// As an interrupt does that comes in the middle of a call.
TEST_F(Guarded, CallInsideACall_IsFoundEachTime) {
  Checked device(made);
  for (unsigned i = 1; i <= 3; ++i) {
    device->part().call([&] { device->part().call(nullptr); });
    EXPECT_EQ(reentries, i);
    device->part().call(nullptr);
    EXPECT_EQ(reentries, i) << "the outer call has ended";
  }
  // The end of the inner call is not the end of the outer one.
  device->part().call([&] {
    device->part().call(nullptr);
    device->part().call(nullptr);
  });
  EXPECT_EQ(reentries, 5U);
}

TEST_F(Guarded, OtherObject_MayBeUsedInside) {
  Checked device(made);
  Checked other(made);
  device->part().call([&] { other->part().call(nullptr); });
  EXPECT_EQ(reentries, 0U);
}

TEST_F(Guarded, Off_FindsNothingAndTakesNoMemory) {
  Unchecked device(made);
  device->part().call([&] { device->part().call(nullptr); });
  EXPECT_EQ(reentries, 0U);
  static_assert(sizeof(Unchecked) == sizeof(Device));
  static_assert(!enc::kCheckReentry);
  static_assert(
      std::is_same_v<enc::Guarded<Device>, enc::Guarded<Device, enc::StopOnReentry, false>>);
}

TEST_F(Guarded, Threads_OneOfTwoIsTold) {
  Checked device(made);
  std::atomic<bool> inside{false};
  std::atomic<bool> leave{false};
  std::thread other([&] {
    device->part().call([&] {
      inside = true;
      while (!leave) std::this_thread::yield();
    });
  });
  while (!inside) std::this_thread::yield();
  device->part().call(nullptr);
  leave = true;
  other.join();
  EXPECT_EQ(reentries, 1U);
  device->part().call(nullptr);
  EXPECT_EQ(reentries, 1U);
}

// The driver itself: a transfer is interrupted by a handler that uses the same device.
struct Bus {
  bool transfer(mb4::Span<const std::uint8_t> /*tx*/, mb4::Span<std::uint8_t> rx) {
    for (std::uint8_t& byte : rx) byte = 0xFF;
    if (interrupt) std::exchange(interrupt, nullptr)();
    return true;
  }
  std::function<void()> interrupt;
};
struct Clock {
  std::uint32_t now_us() { return ++now; }
  std::uint32_t now = 0;
};

TEST_F(Guarded, DriverInterruptedInATransfer_IsFound) {
  Bus bus;
  Clock clock;
  enc::Guarded<mb4::Device<Bus, Clock>, Count, true> device(bus, clock);
  EXPECT_FALSE(device->read_status().ok());
  EXPECT_EQ(reentries, 0U);
  bus.interrupt = [&] { EXPECT_FALSE(device->automatic().poll_slave(1).ok()); };
  EXPECT_FALSE(device->read_status().ok());
  EXPECT_EQ(reentries, 1U);
}

// The trap is SIGILL or, on other processors, SIGTRAP. The handler makes it an exit, because a
// process that a signal ends writes no coverage.
TEST(GuardedDeathTest, StopOnReentry_StopsTheProgram) {
  constexpr int kTrapped = 42;
  int made = 0;
  enc::Guarded<Device, enc::StopOnReentry, true> device(made);
  const auto call_twice = [&] {
    for (const int trap : {SIGILL, SIGTRAP}) std::signal(trap, [](int) { std::exit(kTrapped); });
    device->part().call([&] { device->part().call(nullptr); });
  };
  EXPECT_EXIT(call_twice(), testing::ExitedWithCode(kTrapped), "");
  EXPECT_DEATH(device->part().call([&] { device->part().call(nullptr); }), "");
}

}  // namespace
