// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Snapshot between contexts. Preemption is made at a known word: the memory of the snapshot calls
// back before each access. Threads of the host, which run at the same time, come last.

#include "enc/snapshot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <iostream>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace {

// Calls `before` with the number of the access, from 0 on, before each access of a context.
struct Preempted {
  static std::uint32_t load(const std::uint32_t& word) {
    step();
    return stamp != 0 ? std::exchange(stamp, 0) : word;
  }
  static void store(std::uint32_t& word, std::uint32_t value) {
    step();
    word = value;
  }
  static void acquire() {}
  static void release() {}

  static void step() {
    if (!before || inside) return;
    inside = true;
    before(steps++);
    inside = false;
  }
  static void watch(std::function<void(unsigned)> call) {
    before = std::move(call);
    steps = 0;
  }
  static unsigned unwatch() {
    before = nullptr;
    return steps;
  }

  static inline std::function<void(unsigned)> before;
  static inline bool inside = false;
  static inline unsigned steps = 0;
  static inline std::uint32_t stamp = 0;  // what the next load finds instead
};

constexpr std::size_t kWords = 7;
struct Value {
  std::array<std::uint32_t, kWords> words{};
  std::uint8_t last = 0;  // a size that is no multiple of a word
};

Value value_of(std::uint32_t number) {
  Value value;
  for (std::size_t i = 0; i < kWords; ++i) {
    value.words[i] = number * 2'654'435'761U + static_cast<std::uint32_t>(i);
  }
  value.last = static_cast<std::uint8_t>(number);
  return value;
}

// The number of the value; kTorn if its parts are not of one.
constexpr std::uint32_t kTorn = 0xFFFF'FFFF;
std::uint32_t number_of(const Value& value) {
  constexpr std::uint32_t kInverse = 244'002'641;  // of 2654435761 modulo 2^32
  static_assert(2'654'435'761U * kInverse == 1U);
  const std::uint32_t number = value.words[0] * kInverse;
  const Value whole = value_of(number);
  return whole.words == value.words && whole.last == value.last ? number : kTorn;
}

using Shared = enc::Snapshot<Value, Preempted>;

TEST(Snapshot, NothingWritten_IsNoValue) {
  const enc::Snapshot<Value> snapshot;
  Value value = value_of(5);
  EXPECT_FALSE(snapshot.try_read(value));
  EXPECT_FALSE(snapshot.read(value));
  EXPECT_EQ(number_of(value), 5U) << "unchanged";
  EXPECT_EQ(snapshot.writes(), 0U);
}

TEST(Snapshot, EachValue_IsReadAsItWasWritten) {
  enc::Snapshot<Value> snapshot;
  for (std::uint32_t number = 0; number < 10; ++number) {
    snapshot.write(value_of(number));
    for (unsigned i = 0; i < 2; ++i) {
      Value value;
      ASSERT_TRUE(snapshot.try_read(value));
      EXPECT_EQ(number_of(value), number);
      ASSERT_TRUE(snapshot.read(value));
      EXPECT_EQ(number_of(value), number);
    }
    EXPECT_EQ(snapshot.writes(), number + 1);
  }
}

TEST(Snapshot, StampsGoRound_EachValueIsRead) {
  Shared snapshot;
  Preempted::stamp = 0xFFFF'FF00;
  for (std::uint32_t number = 0; number < 300; ++number) {
    snapshot.write(value_of(number));
    Value value;
    ASSERT_TRUE(snapshot.try_read(value)) << number;
    EXPECT_EQ(number_of(value), number);
  }
}

// The writer comes 0 to 4 times before one access of the reader: each access, each count.
TEST(Snapshot, ReaderPreemptedAtEachAccess_GetsWholeValues) {
  for (unsigned at = 0; at < kWords + 6; ++at) {
    for (unsigned writes = 0; writes <= 4; ++writes) {
      Shared snapshot;
      std::uint32_t newest = 100;
      snapshot.write(value_of(newest));
      Preempted::watch([&](unsigned step) {
        for (unsigned i = 0; step == at && i < writes; ++i) snapshot.write(value_of(++newest));
      });
      Value value;
      const bool good = snapshot.try_read(value);
      Preempted::unwatch();
      EXPECT_TRUE(good || writes >= 2) << at << ", " << writes;
      if (good) {
        const std::uint32_t number = number_of(value);
        EXPECT_TRUE(number == 100 || number == newest) << at << ", " << writes << ": " << number;
      }
      // read() goes on until it has one.
      Preempted::watch([&](unsigned step) {
        for (unsigned i = 0; step == at && i < writes; ++i) snapshot.write(value_of(++newest));
      });
      const std::uint32_t oldest = newest;
      ASSERT_TRUE(snapshot.read(value));
      Preempted::unwatch();
      EXPECT_GE(number_of(value), oldest) << at << ", " << writes;
      EXPECT_LE(number_of(value), newest) << at << ", " << writes;
    }
  }
}

// A reader that interrupts the writer never has to wait.
TEST(Snapshot, WriterPreemptedAtEachAccess_ReaderAlwaysSucceeds) {
  Shared snapshot;
  snapshot.write(value_of(1));
  std::uint32_t number = 1;
  unsigned accesses = kWords + 4;
  for (unsigned at = 0; at < accesses; ++at) {
    std::uint32_t seen = kTorn;
    Preempted::watch([&](unsigned step) {
      if (step != at) return;
      Value value;
      ASSERT_TRUE(snapshot.try_read(value)) << "access " << at;
      seen = number_of(value);
    });
    snapshot.write(value_of(number + 1));
    accesses = Preempted::unwatch();
    EXPECT_EQ(seen, number) << "access " << at << ": the value before";
    ++number;
  }
  EXPECT_EQ(accesses, kWords + 4) << "done, begun, eight words, done";
}

// 10^6 preemptions: readers by the writer, and writers by readers, at random accesses. The stamps
// begin shortly before they go round.
TEST(Snapshot, MillionPreemptions_NoneIsTorn) {
  constexpr unsigned kPreemptions = 1'000'000;
  constexpr unsigned kSeed = 1;
  std::mt19937 generator(kSeed);
  const auto random = [&] { return static_cast<unsigned>(generator()); };
  Shared snapshot;
  std::uint32_t newest = 0;
  Preempted::stamp = 0xFFFF'FF00;
  snapshot.write(value_of(newest));
  unsigned preemptions = 0;
  unsigned torn = 0;
  unsigned again = 0;
  const auto check = [&](std::uint32_t number, std::uint32_t oldest) {
    if (number == kTorn || number < oldest || number > newest) ++torn;
  };
  while (preemptions < kPreemptions) {
    const std::uint32_t before = newest;
    const unsigned at = random() % (kWords + 5);
    if (random() % 2 == 0) {
      const unsigned writes = 1 + random() % 4;
      const unsigned second = random() % (kWords + 5);
      Preempted::watch([&](unsigned step) {
        if (step != at && step != second) return;
        ++preemptions;
        for (unsigned i = 0; i < writes; ++i) snapshot.write(value_of(++newest));
      });
      Value value;
      const bool good = snapshot.try_read(value);
      Preempted::unwatch();
      again += good ? 0 : 1;
      if (good) check(number_of(value), before);
    } else {
      Preempted::watch([&](unsigned step) {
        if (step != at) return;
        ++preemptions;
        Value value;
        if (snapshot.try_read(value)) {
          check(number_of(value), before);
        } else {
          ++torn;
        }
      });
      snapshot.write(value_of(newest + 1));
      Preempted::unwatch();
      ++newest;
    }
  }
  std::cout << "preemptions " << preemptions << ", torn " << torn << ", read again " << again
            << ", seed " << kSeed << "\n";
  EXPECT_EQ(torn, 0U);
  EXPECT_GT(again, 1000U);
}

// The writer runs on another core, without a pause and with short ones.
TEST(Snapshot, ThreadsAtTheSameTime_NoneIsTorn) {
  enc::Snapshot<Value> snapshot;
  constexpr unsigned kReaders = 3;
  constexpr std::uint32_t kWrites = 20'000;
  constexpr std::uint64_t kReads = 10'000;
  std::atomic<bool> ended{false};
  std::atomic<unsigned> torn{0};
  std::atomic<unsigned> old{0};
  std::atomic<std::uint64_t> reads{0};
  std::vector<std::thread> readers;
  for (unsigned i = 0; i < kReaders; ++i) {
    readers.emplace_back([&] {
      std::uint32_t last = 0;
      while (!ended) {
        Value value;
        if (!snapshot.try_read(value)) continue;
        const std::uint32_t number = number_of(value);
        torn += number == kTorn ? 1 : 0;
        old += number < last ? 1 : 0;
        last = number;
        ++reads;
      }
    });
  }
  // On a busy machine the readers may begin late: the writer goes on until they have read enough.
  std::uint32_t number = 0;
  while (number < kWrites || reads < kReads) {
    snapshot.write(value_of(++number));
    if (number % 64 == 0) std::this_thread::yield();
  }
  ended = true;
  for (std::thread& reader : readers) reader.join();
  Value value;
  ASSERT_TRUE(snapshot.read(value));
  EXPECT_EQ(number_of(value), number);
  std::cout << "writes " << number << ", reads " << reads << ", torn " << torn << "\n";
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(old, 0U) << "a reader never goes back";
}

}  // namespace
