// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// examples/zephyr/rtio.cpp on stand-ins of Zephyr's RTIO, which run a chain later on the Verilated
// chip: restart and positions without a blocking transfer. It has not run on Zephyr.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "examples/zephyr/rtio.cpp"
#include "tests/support/chip_fixture.hpp"

namespace {

namespace sim = mb4::sim;

// One submission; `entry` is what the example sees.
struct Submitted {
  rtio_sqe entry{};
  const std::uint8_t* tx = nullptr;
  std::uint8_t* rx = nullptr;
  std::uint32_t size = 0;
  rtio_callback_t callback = nullptr;
  void* argument = nullptr;
};

std::deque<Submitted> queue;  // addresses stay
std::size_t room = 0;

Submitted& submitted(rtio_sqe* entry) { return *reinterpret_cast<Submitted*>(entry); }

const std::string kScenario =
    "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n"
    "data = 0xAAF37BF\ncontrol = true\nregisters = { 0x44 = [0x00, 0xD9, 0x01, 0x32] }\n";

struct Board {
  mb4test::Chip chip{kScenario};
  mb4::Operation operation;
  mb4::CyclicRead read;
  bool reads = false;
  bool ended = false;
  std::uint32_t pauses = 0;
  rtio fake{};
  rtio_iodev fast{};
  rtio_iodev slow{};
  mb4_rtio::Context context{};

  Board();
  // Runs what was submitted, and what follows.
  void run_all() {
    ended = false;
    mb4_rtio::begin(context);
    while (!queue.empty()) {
      const Submitted next = queue.front();
      queue.pop_front();
      ++room;
      if (next.callback != nullptr) {
        EXPECT_EQ(next.entry.flags & RTIO_SQE_CHAINED, 0);
        next.callback(&fake, &next.entry, next.argument);
        continue;
      }
      EXPECT_NE(next.entry.flags & RTIO_SQE_CHAINED, 0);
      EXPECT_EQ(next.entry.iodev == &slow, next.tx[0] == 0x03);
      chip.bus.transfer({next.tx, next.size}, {next.rx, next.rx == nullptr ? 0 : next.size});
    }
    EXPECT_TRUE(ended);
  }
};
Board* board = nullptr;

Board::Board() {
  board = this;
  context.queue = &fake;
  context.device = &fast;
  context.read_device = &slow;
  context.now_us = [] { return board->chip.clock.now_us(); };
  context.pause = [](mb4_rtio::Context& paused, std::uint32_t us) {
    ++board->pauses;
    board->chip.simulator.advance(us * sim::kPsPerUs);
    EXPECT_TRUE(mb4_rtio::submit(paused));
  };
  context.finish = [](void*, bool transferred, std::uint32_t now_us) {
    return board->reads ? board->chip.device.automatic().finish(board->read, transferred, now_us)
                        : board->chip.device.finish(board->operation, transferred, now_us);
  };
  context.ended = [](void*) { board->ended = true; };
  mb4::Config config = mb4test::config26(5'000'000);
  config.spi_check = mb4::SpiCheck::kCrc;
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = 2000;
  EXPECT_TRUE(chip.device.configure(config).ok());
  queue.clear();
  room = 8;
}

TEST(DriverRtio, RestartPositionAndRegister_InChains) {
  Board one;
  one.context.steps = &one.operation;
  ASSERT_TRUE(one.chip.device.automatic().plan_restart(one.operation).ok());
  one.run_all();
  ASSERT_TRUE(one.operation.result().ok());
  EXPECT_EQ(one.pauses, 1U);
  one.chip.simulator.advance(250 * sim::kPsPerUs);

  one.context.steps = &one.read;
  one.reads = true;
  ASSERT_TRUE(one.chip.device.automatic().plan_slave(1, one.read).ok());
  one.run_all();
  ASSERT_EQ(one.read.error(), mb4::Error::kNone);
  EXPECT_EQ(one.read.position(), 0xAAF37BFU >> 2U);

  one.context.steps = &one.operation;
  one.reads = false;
  std::array<std::uint8_t, 4> serial{};
  ASSERT_TRUE(one.chip.device.control().plan_read(one.operation, {1, 0}, 0x44, serial).ok());
  one.run_all();
  ASSERT_TRUE(one.operation.result().ok());
  EXPECT_EQ(serial, (std::array<std::uint8_t, 4>{0x00, 0xD9, 0x01, 0x32}));
}

// A queue that is too short: an error, and nothing is left in it.
TEST(DriverRtio, QueueTooShort_IsTransport) {
  Board one;
  room = 2;
  one.context.steps = &one.operation;
  ASSERT_TRUE(one.chip.device.automatic().plan_start(one.operation).ok());
  one.run_all();
  ASSERT_TRUE(one.operation.result().ok());
  one.context.steps = &one.read;
  one.reads = true;
  ASSERT_TRUE(one.chip.device.automatic().plan_slave(1, one.read).ok());
  one.run_all();
  EXPECT_EQ(one.read.error(), mb4::Error::kTransport);
}

}  // namespace

extern "C" {

rtio_sqe* rtio_sqe_acquire(rtio*) {
  if (room == 0) return nullptr;
  --room;
  queue.emplace_back();
  return &queue.back().entry;
}
void rtio_sqe_drop_all(rtio*) {
  room += queue.size();
  queue.clear();
}
void rtio_sqe_prep_transceive(rtio_sqe* sqe, const rtio_iodev* iodev, std::int8_t,
                              const std::uint8_t* tx, std::uint8_t* rx, std::uint32_t size, void*) {
  Submitted& one = submitted(sqe);
  one.entry.iodev = iodev;
  one.tx = tx;
  one.rx = rx;
  one.size = size;
}
void rtio_sqe_prep_write(rtio_sqe* sqe, const rtio_iodev* iodev, std::int8_t priority,
                         const std::uint8_t* tx, std::uint32_t size, void* userdata) {
  rtio_sqe_prep_transceive(sqe, iodev, priority, tx, nullptr, size, userdata);
}
void rtio_sqe_prep_callback(rtio_sqe* sqe, rtio_callback_t callback, void* argument, void*) {
  submitted(sqe).callback = callback;
  submitted(sqe).argument = argument;
}
int rtio_submit(rtio*, std::uint32_t) { return 0; }

}  // extern "C"
