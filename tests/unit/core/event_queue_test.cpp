// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/event_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mb4test {

using namespace mb4::sim;

namespace {

TEST(EventQueue, EventsOutOfOrder_RunInOrderOfTime) {
  EventQueue queue;
  std::vector<int> order;
  queue.post(30, [&] { order.push_back(3); });
  queue.post(10, [&] { order.push_back(1); });
  queue.post(20, [&] { order.push_back(2); });
  EXPECT_EQ(queue.next_time(), 10U);
  while (!queue.empty()) queue.run_next();
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(queue.next_time(), kNever);
}

TEST(EventQueue, SameTime_RunsInOrderOfPosting) {
  EventQueue queue;
  std::vector<int> order;
  for (int i = 0; i < 100; ++i) queue.post(5, [&order, i] { order.push_back(i); });
  while (!queue.empty()) queue.run_next();
  for (int i = 0; i < 100; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

TEST(EventQueue, HandlerPostsAtItsOwnTime_RunsAfterThoseAlreadyThere) {
  EventQueue queue;
  std::vector<int> order;
  queue.post(5, [&] {
    order.push_back(1);
    queue.post(5, [&] { order.push_back(3); });
  });
  queue.post(5, [&] { order.push_back(2); });
  while (!queue.empty()) queue.run_next();
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3}));
}

// Posts more events than the row holds, in every order, two for each time.
TEST(EventQueue, ManyEvents_RunInOrderOfTimeAndPosting) {
  EventQueue queue;
  std::vector<std::pair<Time, unsigned>> order;
  constexpr unsigned kEvents = 200;
  for (unsigned i = 0; i < kEvents; ++i) {
    const Time time = 10 + i * 37 % 100;
    queue.post(time, [&order, time, i] { order.emplace_back(time, i); });
    if (i == kEvents / 2) queue.run_next();
  }
  EXPECT_EQ(queue.size(), kEvents - 1);
  while (!queue.empty()) queue.run_next();
  ASSERT_EQ(order.size(), kEvents);
  // The event that ran early was the first at 10; the second one at 10 came after it.
  EXPECT_EQ(order.front(), std::make_pair(Time{10}, 0U));
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(EventQueue, PlainHandler_GetsTimeReceiverAndWord) {
  struct Seen {
    Time time = 0;
    std::uint64_t word = 0;
  } seen;
  EventQueue queue;
  queue.post(
      77,
      [](Time now, void* receiver, std::uint64_t word) {
        *static_cast<Seen*>(receiver) = {now, word};
      },
      &seen, 42);
  queue.run_next();
  EXPECT_EQ(seen.time, 77U);
  EXPECT_EQ(seen.word, 42U);
}

}  // namespace
}  // namespace mb4test
