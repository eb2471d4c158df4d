// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Operations in steps, frame by frame: no transfer is made and no time is asked for. Expected bytes
// come from the datasheet (tables 3, 31 to 34, 44 to 47, 54 to 63, 69; pages 27 to 29, 33).

#include "mb4/operation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "mb4/device.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"
#include "tests/driver/mb4/three_slaves.hpp"

namespace {
namespace operation_test {

using mb4::Error;
using mb4test::Bytes;
using mb4test::FakeClock;
using mb4test::hex;
using mb4test::join;
using mb4test::kBreak;
using mb4test::kClearValid1;
using mb4test::kReadRest;
using mb4test::kReadStatus;
using mb4test::kReadWitness;
using mb4test::kRest;
using mb4test::kRestBack;
using mb4test::status;
using mb4test::StrictBus;
using mb4test::witness;
using mb4test::zeros;

const Bytes kAgs{0x07, 0x01};
const Bytes kInit{0x07, 0x10};      // INIT: bit 4 of 0xF4 (table 46)
const Bytes kFrame{0x07, 0x08};     // INSTR = 100
const Bytes kFrameAgs{0x07, 0x09};  // with AGS = 1
const Bytes kRuns = status(0xFA, 0x00, 0x08);
const Bytes kOver = status(0xFB, 0x00);
const Bytes kDone = status(0xFF, 0x00);
const Bytes kRunsAgs = status(0xFB, 0x00, 0x09);
const Bytes kDoneAgs = status(0xFF, 0x00, 0x01);
const Bytes kClearNone{0x02, 0xF1, 0xFF, 0xFF};
const Bytes kClearBoth{0x02, 0xF1, 0xF5, 0xFF};  // of slaves 1 and 2
const Bytes kProven = status(0xFB, 0x00, 0x01);
const Bytes kReadLines = join({{0x05}, zeros(9)});
const Bytes kIdleLines{0, 0xFB, 0, 0, 0, 0, 0, 0, 0, 0x11};  // SL1, SL2 in 0xF8
const Bytes kRequest{0x02, 0xE2, 0x44, 0x01, 0x01, 0xC0};
const Bytes kReadRequest{0x03, 0xE2, 0, 0, 0, 0};
const std::vector<Bytes> kAsk{kRequest, kReadRequest};
const std::vector<Bytes> kAsked{{0, 0, 0x44, 0x01, 0x01, 0xC0}};
// The request at rest: a read of register 0. SpiCheck::kFull reads it back.
const std::vector<Bytes> kAtRest{kRest, kReadRest};
// The request of an access where that at rest is looked for.
const Bytes kAskedBack = join({kAsked[0], Bytes(kRestBack.begin() + 6, kRestBack.end())});
// The end of a read: RDATA1, with which the registers are compared. Then the request at rest.
const std::vector<Bytes> kEnd{{0x03, 0x80, mb4test::kFiller}, kReadWitness};
const std::vector<Bytes> kEnded{{0, 0, 1}, witness(kDoneAgs)};
// SpiCheck::kFull: with a status, which no stuck line makes; and again.
const std::vector<Bytes> kTakeFirst{{0x03, 0x80, mb4test::kFiller, mb4test::kFiller}, kReadWitness};
const std::vector<Bytes> kTakeAgain{{0x03, 0x80, 0, 0}, kReadWitness};

// AGS = 1 at SpiCheck::kFull: no word waits, and nothing else has changed.
const std::vector<Bytes> kStarts{kAgs, kClearValid1, kClearValid1, kReadRest, kReadWitness};

// The slaves' timeout, and the step of the coarsest clock.
constexpr std::uint32_t kPause = 100 + 33;

class OperationTest : public testing::Test {
 protected:
  void configure(mb4::SpiCheck check = mb4::SpiCheck::kOff) {
    mb4::Config config = mb4test::encoder26();
    config.spi_check = check;
    mb4test::expect_configure(bus, 0xE7, check == mb4::SpiCheck::kOff ? 0x02 : 0x00);
    ASSERT_TRUE(device.configure(config).ok());
  }
  void expect_break() {
    bus.expect_write({0x07, 0x80, 0x00});
    bus.expect_write(kClearValid1);
    bus.expect_read(kReadWitness, witness(status(0xFF, 0x00, 0x00)));
  }
  void expect_start(const Bytes& answer = mb4test::answer_at_full()) {
    if (!full()) {
      bus.expect_write(kAgs);
      return;
    }
    const auto& slaves = device.config().slaves;
    const Bytes clear = slaves[0].actuator  ? kClearNone
                        : slaves[1].enabled ? kClearBoth
                                            : kClearValid1;
    mb4test::expect_start_at_full(bus, clear, answer);
  }
  void start(const Bytes& answer = mb4test::answer_at_full()) {
    expect_start(answer);
    ASSERT_TRUE(device.automatic().start().ok());
  }
  // Slave 1 as an actuator, with automatic frames.
  void start_actuator(mb4::SpiCheck check) {
    mb4::Config config = mb4test::encoder26();
    config.mo = config.slaves[0].actuator = true;
    config.spi_check = check;
    Bytes image = mb4test::configuration();
    Bytes answer = mb4test::read_back();
    for (Bytes* bytes : {&image, &answer}) {
      (*bytes)[0] = 0xDB;                                              // LSTOP1 = 1 (table 18)
      (*bytes)[0xE5 - 0xC0] = 0xC2;                                    // EN_MO (table 39)
      if (check != mb4::SpiCheck::kOff) (*bytes)[0xE7 - 0xC0] = 0x00;  // NOCRC = 0 (table 21)
      (*bytes)[0xEF - 0xC0] = 0x01;                                    // ACTnSENS1 (table 17)
    }
    mb4test::expect_image(bus, image, answer);
    ASSERT_TRUE(device.configure(config).ok());
    start(answer);
  }
  bool full() const { return device.config().spi_check >= mb4::SpiCheck::kFull; }
  bool proves() const { return device.config().spi_check == mb4::SpiCheck::kFullAndRelease; }
  // A read of a position sees 0xF4 with INSTR = 100, which nobody has written.
  void read_sees_stray() {
    bus.expect_write({0x07, 0x41});
    bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x49));
    bus.expect_write(kAgs);
    if (proves()) bus.expect_read(kReadStatus, kProven);
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kCorrupted);
  }
  // The step must be `frames`, after `pause_us`; the chip answers with `answers`, one for each
  // frame that reads. Returns finish().
  bool step(const std::vector<Bytes>& frames, const std::vector<Bytes>& answers,
            bool transferred = true, std::uint32_t pause_us = 0) {
    EXPECT_EQ(op.frames(), frames.size());
    EXPECT_EQ(op.pause_us(), pause_us);
    std::size_t next = 0;
    for (std::size_t i = 0; i < op.frames() && i < frames.size(); ++i) {
      EXPECT_EQ(hex(Bytes(op.tx(i).begin(), op.tx(i).end())), hex(frames[i])) << i;
      EXPECT_LE(op.tx(i).size(), mb4::Operation::kMaxFrameBytes);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(op.tx(i).data()) % 4, 0U);
      if (op.rx(i).empty() || next >= answers.size()) continue;
      EXPECT_EQ(op.rx(i).size(), answers[next].size()) << "slip in the test";
      for (std::size_t k = 0; k < answers[next].size(); ++k) op.rx(i)[k] = answers[next][k];
      ++next;
    }
    return device.finish(op, transferred, now_us);
  }
  // initialize() up to SVALID = 0 behind the line's delay, 7; and up to its last frame.
  void to_delays() {
    const bool full = device.config().spi_check == mb4::SpiCheck::kFull;
    const Bytes delay{0x03, 0x00, 0x00};
    ASSERT_TRUE(device.plan_initialize(op).ok());
    EXPECT_FALSE(step({{0x02, 0x00, 0x00}, {0x02, 0x20, 0x00}}, {}));
    const Bytes init{0x07, 0x10};
    const Bytes runs = status(0xFA, 0x00, 0x10);
    EXPECT_FALSE(full ? step({init, kReadStatus}, {runs}) : step({init}, {}));
    EXPECT_FALSE(step({kReadStatus}, {kOver}));
    EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
    EXPECT_FALSE(full ? step({delay, delay}, {{0, 0, 7}, {0, 0, 7}}) : step({delay}, {{0, 0, 7}}));
    EXPECT_FALSE(full ? step({kClearValid1, kReadStatus}, {kOver}) : step({kClearValid1}, {}));
  }
  void to_last_frame() {
    to_delays();
    EXPECT_FALSE(step({mb4test::kStartFrame}, {}));
  }
  // BREAK and a new start before the request.
  void begins_with_break() {
    EXPECT_FALSE(step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness},
                      {witness(status(0xFF, 0x00, 0x00))}));
    EXPECT_FALSE(step(kStarts, {kRestBack, witness(kProven)}, true, kPause));
  }
  // The request of an access at kFull beside automatic frames, behind one that has ended: none
  // runs.
  bool asks_again(const Bytes& behind = kDoneAgs) {
    return step({kRequest, kReadRequest, kReadWitness}, {kAsked[0], witness(behind)});
  }
  // An access at kFull beside automatic frames, up to the two looks at its end.
  void access_ends(bool again = false) {
    EXPECT_FALSE(again ? asks_again() : step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
    EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
    EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  }
  // An access at kFull without automatic frames, up to its second frame.
  void to_second_frame() {
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrame}, {}));
    EXPECT_FALSE(step({kReadStatus}, {kOver}));
    EXPECT_FALSE(step({kReadStatus}, {kOver}));
    EXPECT_FALSE(step({kFrame}, {}));
  }
  // One of the two commands of activate(), by single frames: broadcast 01, or 00 to the slave's ID.
  void activates(bool broadcast, std::uint32_t pause_us) {
    const std::uint8_t ids = broadcast ? 0x00 : 0x80;
    const std::uint8_t ctrl = broadcast ? 0x50 : 0x40;
    EXPECT_FALSE(step({{0x02, 0x80, ids}}, {}));
    EXPECT_FALSE(step({{0x03, 0x80, 0}}, {{0, 0, ids}}));
    EXPECT_FALSE(step({{0x02, 0xE4, 0x01, ctrl}, {0x03, 0xE4, 0, 0}}, {{0, 0, 0x01, ctrl}}));
    EXPECT_FALSE(step({kFrame}, {}));
    EXPECT_FALSE(step({kReadStatus}, {kOver}));
    EXPECT_FALSE(step({kFrame}, {}, true, pause_us));
    EXPECT_FALSE(step({kReadStatus}, {kDone}));
    EXPECT_FALSE(step({kClearValid1, kRest}, {}, true, pause_us));
  }
  // At kFull, after something has read back differently: the operation compares the configuration,
  // which is encoder26() but for `other`; in a blocking call.
  using Others = std::vector<std::pair<std::uint8_t, std::uint8_t>>;
  std::vector<mb4test::Transfer> comparison(const Bytes& end, const Others& other) {
    return comparison(end, other, device.automatic().running());
  }
  static std::vector<mb4test::Transfer> comparison(const Bytes& end, const Others& other,
                                                   bool automatic) {
    const Bytes word{0x34, 0x12, 0, 0, 0, 0, 0, 0x2A};  // in SCDATA1
    Bytes answer = mb4test::read_back();
    answer[0xE7 - 0xC0] = 0x00;  // NOCRC = 0
    for (const auto& [address, value] : other) answer[address - 0xC0U] = value;
    return mb4test::comparison(answer, end, automatic ? word : Bytes{});
  }
  bool step(const std::vector<mb4test::Transfer>& all) {
    std::vector<Bytes> frames;
    std::vector<Bytes> answers;
    for (const auto& one : all) {
      frames.push_back(one.mosi);
      answers.push_back(one.miso);
    }
    return step(frames, answers);
  }
  bool compared(const Bytes& end = kProven, const Others& other = {}) {
    bool ended = false;
    for (const auto& one : mb4test::in_steps(comparison(end, other))) {
      EXPECT_FALSE(ended);
      ended = step(one);
    }
    return ended;
  }
  // In a call that has stopped the frames.
  void expect_compared(const Bytes& end) {
    for (const auto& one : comparison(end, {}, false)) bus.expect_read(one.mosi, one.miso);
  }
  // The request at rest is away: BREAK sends it before the frames start again.
  void restart_after_rest() {
    bus.expect_write({0x07, 0x80, 0x00});
    bus.expect_write(kClearValid1);
    mb4test::expect_rest_at_full(bus);
    bus.expect_read(kReadWitness, witness(status(0xFF, 0x00, 0x00)));
    expect_start();
    EXPECT_TRUE(device.automatic().restart().ok());
  }
  void ends_with(Error error) { EXPECT_EQ(op.result().error(), error); }
  void read(std::size_t count = 2) {
    ASSERT_TRUE(
        device.control().plan_read(op, {1, 0}, 0x44, mb4::Span<std::uint8_t>(out.data(), count)));
  }

  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
  mb4::Operation op;
  std::uint32_t now_us = 5000;
  std::array<std::uint8_t, 64> out{};
};

using Restart = OperationTest;
using Verify = OperationTest;
using Initialize = OperationTest;
using Access = OperationTest;

// ---- Restart: table 69 --------------------------------------------------------------------------

TEST_F(Restart, BreakPauseStart_AreTwoSteps) {
  EXPECT_EQ(device.automatic().plan_restart(op).error(), Error::kNotConfigured);
  configure();
  start();
  ASSERT_TRUE(device.automatic().plan_restart(op).ok());
  EXPECT_FALSE(device.automatic().running());
  EXPECT_FALSE(step({kBreak}, {}));
  EXPECT_TRUE(step({kClearValid1, kAgs}, {}, true, kPause));
  ends_with(Error::kNone);
  EXPECT_TRUE(device.automatic().running());
  EXPECT_EQ(device.automatic().plan_start(op).error(), Error::kWrongMode);
}

TEST_F(Restart, Start_IsOneStepOrRecoversFirst) {
  configure();
  ASSERT_TRUE(device.automatic().plan_start(op).ok());
  EXPECT_TRUE(step({kAgs}, {}, false));
  ends_with(Error::kTransport);
  EXPECT_FALSE(device.automatic().running());
  ASSERT_TRUE(device.automatic().plan_start(op).ok());
  EXPECT_TRUE(step({kBreak}, {}, false));
  ends_with(Error::kTransport);
  ASSERT_TRUE(device.automatic().plan_start(op).ok());
  EXPECT_FALSE(step({kBreak}, {}));
  EXPECT_TRUE(step({kClearValid1, kAgs}, {}, true, kPause));
  EXPECT_TRUE(device.automatic().running());
}

// SpiCheck::kFull writes 0xF5 too.
TEST_F(Restart, Counted_WithCountsOnly) {
  configure(mb4::SpiCheck::kFull);
  start();
  mb4_counts counts{};
  device.automatic().count(&counts);
  ASSERT_TRUE(device.automatic().plan_restart<0>(op).ok());
  EXPECT_EQ(counts.restarts, 0U);
  EXPECT_EQ(device.automatic().plan_restart(op).error(), Error::kBusy);
  EXPECT_EQ(counts.restarts, 0U);
  EXPECT_TRUE(step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness}, {}, false));
  ASSERT_TRUE(device.automatic().plan_restart(op).ok());
  EXPECT_FALSE(
      step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness}, {witness(status(0xFF, 0x00, 0x00))}));
  EXPECT_TRUE(step(kStarts, {kRestBack, witness(kProven)}, true, kPause));
  EXPECT_EQ(counts.restarts, 1U);
  expect_break();
  expect_start();
  ASSERT_TRUE(device.automatic().restart().ok());
  EXPECT_EQ(counts.restarts, 2U);
}

// Nobody has called count().
TEST_F(Restart, WithoutCounts_CountsNothing) {
  configure();
  start();
  mb4_counts counts{};
  device.automatic().count(&counts);
  device.automatic().count(nullptr);
  ASSERT_TRUE(device.automatic().plan_restart(op).ok());
  EXPECT_FALSE(step({kBreak}, {}));
  EXPECT_TRUE(step({kClearValid1, kAgs}, {}, true, kPause));
  ends_with(Error::kNone);
  EXPECT_EQ(counts.restarts, 0U);
}

// Nothing is touched: the frames go on, and no restart is counted.
TEST_F(Restart, NotAllowed_TouchesNothing) {
  configure();
  start();
  mb4_counts counts{};
  device.automatic().count(&counts);
  ASSERT_TRUE(device.plan_verify(op).ok());
  EXPECT_TRUE(step({join({{0x03, 0xE2}, zeros(18)})}, {}));
  EXPECT_FALSE(device.configured());
  EXPECT_EQ(device.automatic().plan_restart(op).error(), Error::kNotConfigured);
  EXPECT_EQ(device.automatic().restart().error(), Error::kNotConfigured);
  EXPECT_FALSE(device.automatic().running());  // the failed comparison has stopped the reads
  EXPECT_EQ(counts.restarts, 0U);
}

TEST_F(Restart, Failed_NextTriesAgain) {
  configure();
  start();
  mb4::Frame frame;
  for (const bool blocking : {false, true}) {
    if (blocking) {
      bus.expect_write(kBreak).fail_last();
      EXPECT_EQ(device.automatic().restart().error(), Error::kTransport);
    } else {
      ASSERT_TRUE(device.automatic().plan_restart(op).ok());
      EXPECT_TRUE(step({kBreak}, {}, false));
      ends_with(Error::kTransport);
    }
    bus.expect_write(kBreak);
    bus.expect_write(kClearValid1);
    bus.expect_write(kAgs);
    bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 1}).fail_last();
    EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
    EXPECT_TRUE(device.automatic().running());
  }
}

// ---- Stop ---------------------------------------------------------------------------------------

using StopUse = OperationTest;

// With SpiCheck::kFull a status follows: 0xF4 is 0. Otherwise all is sent once more.
TEST_F(StopUse, InstructionLost_IsSentAgain) {
  const Bytes runs = status(0xFB, 0x00, 0x01);
  const Bytes no_chip(6, 0x00);
  for (const bool by_break : {false, true}) {
    for (const auto& [first, second, error] :
         {std::tuple{runs, kOver, Error::kNone}, std::tuple{no_chip, kOver, Error::kNone},
          std::tuple{runs, runs, Error::kCorrupted},
          std::tuple{runs, no_chip, Error::kNotDetected}}) {
      configure(mb4::SpiCheck::kFull);
      start();
      const Bytes instruction{0x07, by_break ? std::uint8_t{0x80} : std::uint8_t{0x00}};
      ASSERT_TRUE((by_break ? device.plan_break(op) : device.automatic().plan_stop(op)).ok());
      EXPECT_FALSE(step({instruction, kReadStatus}, {first}));
      EXPECT_TRUE(step({instruction, kReadStatus}, {second}));
      ends_with(error);
      EXPECT_FALSE(device.automatic().running());
    }
  }
  configure(mb4::SpiCheck::kCrc);
  start();
  ASSERT_TRUE(device.automatic().plan_stop(op).ok());
  EXPECT_TRUE(step({{0x07, 0x00}}, {}));
  ends_with(Error::kNone);
}

// ---- Wrong use ----------------------------------------------------------------------------------

class Use : public OperationTest {
 public:
  using OperationTest::bus;
  using OperationTest::configure;
  using OperationTest::device;
};

TEST_F(Use, FinishWithoutOperation_ChangesNothing) {
  EXPECT_TRUE(device.finish(op, true, now_us));
  ends_with(Error::kWrongMode);
  configure();
  ASSERT_TRUE(device.automatic().plan_start(op).ok());
  ends_with(Error::kBusy);
  EXPECT_TRUE(step({kAgs}, {}));
  bus.expect_write({0x07, 0x00});
  ASSERT_TRUE(device.automatic().stop().ok());
  EXPECT_TRUE(device.finish(op, true, now_us));  // a late interrupt
  ends_with(Error::kNone);
  EXPECT_FALSE(device.automatic().running());
}

TEST_F(Use, FinishAfterVerify_KeepsTheConfiguration) {
  configure();
  ASSERT_TRUE(device.plan_verify(op).ok());
  bool ended = false;
  for (const auto& one : mb4test::in_steps(mb4test::comparison(mb4test::read_back(), kOver))) {
    EXPECT_FALSE(ended);
    ends_with(Error::kBusy);
    ended = step(one);
  }
  EXPECT_TRUE(ended);
  EXPECT_TRUE(device.finish(op, true, now_us));
  ends_with(Error::kNone);
  EXPECT_TRUE(device.configured());
}

// The operation that runs goes on to its end, and the next one is possible.
TEST_F(Use, SecondPlan_IsBusy) {
  configure();
  start();
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_EQ(device.plan_verify(op).error(), Error::kBusy);
  ends_with(Error::kBusy);
  EXPECT_FALSE(step({kFrameAgs}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kRest}, {}));
  EXPECT_TRUE(step({{0x03, 0x80, 0, 0}}, {{0, 0, 0x12, 0x34}}));
  ends_with(Error::kNone);
  ASSERT_TRUE(device.plan_verify(op).ok());
  EXPECT_EQ(device.control().plan_read(op, {1, 0}, 0, {out.data(), 1}).error(), Error::kBusy);
  EXPECT_EQ(device.control().plan_write(op, {1, 0}, 0, {out.data(), 1}).error(), Error::kBusy);
  EXPECT_EQ(device.control().plan_command(op, mb4::Command{}).error(), Error::kBusy);
  EXPECT_EQ(device.automatic().plan_restart(op).error(), Error::kBusy);
  EXPECT_EQ(device.automatic().plan_actuator(op, 1, 0).error(), Error::kBusy);
  EXPECT_EQ(device.automatic().plan_stop(op).error(), Error::kBusy);
  EXPECT_EQ(device.plan_configure(op, mb4test::encoder26()).error(), Error::kBusy);
  EXPECT_EQ(device.plan_break(op).error(), Error::kBusy);
  EXPECT_TRUE(device.automatic().running());
  bus.expect_write({0x07, 0x00});
  ASSERT_TRUE(device.automatic().stop().ok());
  mb4::FrameRead frame_read;
  EXPECT_EQ(device.automatic().plan_start(op).error(), Error::kBusy);
  EXPECT_EQ(device.plan_actuator(op, 1, 0).error(), Error::kBusy);
  EXPECT_EQ(device.plan_initialize(op).error(), Error::kBusy);
  EXPECT_EQ(device.plan_read_all(op, frame_read).error(), Error::kBusy);
}

// An operation whose Device has gone on without it plans no other frame.
TEST_F(Use, BreakOrConfigure_EndsTheOperation) {
  const std::vector<void (*)(Use&)> others{[](Use& test) {
                                             test.bus.expect_write(kBreak);
                                             test.bus.expect_write(kRest);
                                             EXPECT_TRUE(test.device.control().abort().ok());
                                           },
                                           [](Use& test) {
                                             test.bus.expect_write(kBreak);
                                             test.bus.expect_write(kRest);
                                             EXPECT_TRUE(test.device.break_transmission().ok());
                                           },
                                           [](Use& test) { test.configure(); }};
  for (const auto other : others) {
    configure();
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrame}, {}));
    EXPECT_FALSE(step({kReadStatus}, {kRuns}));
    other(*this);
    EXPECT_TRUE(step({kReadStatus}, {kOver}));
    ends_with(Error::kWrongMode);
    EXPECT_EQ(op.frames(), 0U);
  }
}

TEST_F(Use, AnotherDevice_EndsTheOperation) {
  configure();
  mb4::Device<StrictBus, FakeClock> other(bus, clock);
  mb4test::expect_configure(bus);
  ASSERT_TRUE(other.configure(mb4test::encoder26()).ok());
  ASSERT_TRUE(device.automatic().plan_start(op).ok());
  EXPECT_TRUE(other.finish(op, true, now_us));
  ends_with(Error::kWrongMode);
  EXPECT_FALSE(other.automatic().running());
  EXPECT_FALSE(device.automatic().running());
}

// The comparison goes on beside an abort, but not without a configuration.
TEST_F(Use, VerifyWithoutConfiguration_IsWrongMode) {
  configure();
  ASSERT_TRUE(device.plan_verify(op).ok());
  bus.expect_write(kBreak);
  EXPECT_TRUE(device.control().abort().ok());
  const Bytes chip = mb4test::read_back();
  EXPECT_FALSE(step({join({{0x03, 0xE2}, zeros(18)})},
                    {join({zeros(2), Bytes(chip.begin() + 0x22, chip.begin() + 0x34)})}));
  bus.expect_write({0x07, 0x80, 0x00}).fail_last();
  EXPECT_EQ(device.reset().error(), Error::kTransport);
  EXPECT_TRUE(step({join({{0x03, 0xC0}, zeros(16)})}, {zeros(18)}));
  ends_with(Error::kWrongMode);
}

// ---- Verify -------------------------------------------------------------------------------------

class VerifySteps : public OperationTest {
 protected:
  static std::size_t size(int from) { return from == 0xC0 ? 16 : 18; }
  // A part; with the last one comes the witness.
  static std::vector<Bytes> part(std::uint8_t from) {
    std::vector<Bytes> frames{join({{0x03, from}, zeros(size(from))})};
    if (from == 0xD0) frames.push_back(kReadWitness);
    return frames;
  }
  std::vector<Bytes> answer(int from) const {
    const auto begin = chip.begin() + from - 0xC0;
    std::vector<Bytes> all{join({zeros(2), Bytes(begin, begin + static_cast<int>(size(from)))})};
    if (from == 0xD0) all.push_back(witness(kOver, chip.back()));
    return all;
  }
  Bytes chip = mb4test::read_back();
};

TEST_F(VerifySteps, Good_IsThreePartsAndAStatus) {
  EXPECT_EQ(device.plan_verify(op).error(), Error::kNotConfigured);
  configure();
  ASSERT_TRUE(device.plan_verify(op).ok());
  // Status and instruction are not compared; nor reserved registers.
  for (const int address : {0xE0, 0xE1, 0xEE, 0xF0, 0xF4}) chip[address - 0xC0] ^= 0xFF;
  EXPECT_FALSE(step(part(0xE2), answer(0xE2)));
  EXPECT_FALSE(step(part(0xC0), answer(0xC0)));
  EXPECT_TRUE(step(part(0xD0), answer(0xD0)));
  ends_with(Error::kNone);
  EXPECT_TRUE(device.configured());
}

TEST_F(VerifySteps, EachWrongRegister_IsNamed) {
  for (const int address : {0xC0, 0xC1, 0xD1, 0xD2, 0xDF, 0xE2, 0xE5, 0xE6, 0xE7, 0xEF, 0xF5}) {
    configure();
    chip = mb4test::read_back();
    chip[address - 0xC0] ^= 0x04;
    ASSERT_TRUE(device.plan_verify(op).ok());
    bool ended = step(part(0xE2), answer(0xE2));
    if (!ended) ended = step(part(0xC0), answer(0xC0));
    if (!ended) ended = step(part(0xD0), answer(0xD0));
    EXPECT_TRUE(ended);
    EXPECT_EQ(op.result().error(), Error::kVerify) << address;
    EXPECT_EQ(op.result().info().address(), address);
    EXPECT_FALSE(device.configured());
  }
}

TEST_F(VerifySteps, NoChipOrFailure_IsReported) {
  configure();
  ASSERT_TRUE(device.plan_verify(op).ok());
  EXPECT_TRUE(step(part(0xE2), {}, false));
  ends_with(Error::kTransport);
  EXPECT_TRUE(device.configured());
  // A bus that stores nothing: nothing of the last answer is taken again.
  ASSERT_TRUE(device.plan_verify(op).ok());
  EXPECT_FALSE(step(part(0xE2), answer(0xE2)));
  EXPECT_TRUE(step(part(0xC0), {}, false));
  ASSERT_TRUE(device.plan_verify(op).ok());
  EXPECT_TRUE(step(part(0xE2), {}));
  ends_with(Error::kNotDetected);
  EXPECT_FALSE(device.configured());
}

// MISO is stuck from some frame on. 0xD0..0xE1 are all 0 in this configuration, so a MISO at 0
// reads what was written; no status is all 0, or all 1.
TEST_F(VerifySteps, MisoStuckFromAnyFrameOn_IsNotDetected) {
  for (const std::uint8_t level : {std::uint8_t{0x00}, std::uint8_t{0xFF}}) {
    for (int good = 0; good < 4; ++good) {
      configure();
      ASSERT_TRUE(device.plan_verify(op).ok());
      int frame = 0;
      bool ended = false;
      for (const std::uint8_t from : {std::uint8_t{0xE2}, std::uint8_t{0xC0}, std::uint8_t{0xD0}}) {
        if (ended) break;
        std::vector<Bytes> answers = answer(from);
        for (Bytes& one : answers) {
          if (frame++ >= good) one.assign(one.size(), level);
        }
        ended = step(part(from), answers);
      }
      EXPECT_TRUE(ended);
      // After VERSION was read a part that differs says so.
      const Error error = op.result().error();
      EXPECT_TRUE(error == Error::kNotDetected || (error == Error::kVerify && good != 0)) << good;
      EXPECT_FALSE(device.configured());
    }
  }
}

// ---- INIT: page 33 ------------------------------------------------------------------------------

const Bytes kZero1{0x02, 0x00, 0x00};
const Bytes kZero5{0x02, 0x20, 0x00};
const Bytes kInitRuns = status(0xFA, 0x00, 0x10);
const Bytes kRunsFrame = status(0xFA, 0x00, 0x04);
const Bytes kBadFrame = status(0x6B, 0x00);  // nSCDERR = 0, SVALID1 = 0
const Bytes kReadWord = join({{0x03, 0x00}, zeros(8)});

TEST_F(Initialize, Good_ReturnsTheDelay) {
  EXPECT_EQ(device.plan_initialize(op).error(), Error::kNotConfigured);
  configure();
  ASSERT_TRUE(device.plan_initialize(op).ok());
  EXPECT_FALSE(step({kZero1, kZero5}, {}));
  EXPECT_FALSE(step({kInit}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kInitRuns}));
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_FALSE(step({kReadLines}, {{0, 0xFB, 0, 0, 0, 0, 0, 0, 0, 0x00}}));  // SL1 = 0 for a while
  EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
  EXPECT_FALSE(step({{0x03, 0x00, 0x00}}, {{0, 0, 7}}));
  EXPECT_FALSE(step({kClearValid1}, {}));
  // One frame that nobody gets: does the slave send a word?
  EXPECT_FALSE(step({mb4test::kStartFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kRunsFrame}));
  EXPECT_FALSE(step({kReadStatus}, {status(0xFB, 0x02)}));
  EXPECT_TRUE(step({kClearValid1}, {}));
  ends_with(Error::kNone);
  EXPECT_EQ(op.line_delay().quarters[0], 7);
  EXPECT_EQ(op.line_delay().quarters[1], 0);
}

TEST_F(Initialize, Full_ReadsTwice) {
  configure(mb4::SpiCheck::kFull);
  for (const int fault : {0, 1, 2}) {
    ASSERT_TRUE(device.plan_initialize(op).ok());
    if (fault == 2) {  // after a failed one
      EXPECT_FALSE(step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness}, {witness(kOver)}));
      EXPECT_FALSE(step({kZero1, kZero5}, {}, true, kPause));
    } else {
      EXPECT_FALSE(step({kZero1, kZero5}, {}));
    }
    EXPECT_FALSE(step({kInit, kReadStatus}, {kInitRuns}));
    EXPECT_FALSE(step({kReadStatus}, {kOver}));
    EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
    const Bytes second{0, 0, static_cast<std::uint8_t>(fault == 1 ? 9 : 7)};
    const bool ended = step({{0x03, 0x00, 0x00}, {0x03, 0x00, 0x00}}, {{0, 0, 7}, second});
    EXPECT_EQ(ended, fault == 1);
    if (fault == 1) {
      ends_with(Error::kCorrupted);
      continue;
    }
    EXPECT_FALSE(step({kClearValid1, kReadStatus}, {status(0xFB, 0x02)}));
    EXPECT_FALSE(step({kReadStatus}, {fault == 0 ? kOver : status(0xFB, 0x02)}));
    if (fault != 0) {
      EXPECT_TRUE(compared(kOver));
    } else {
      EXPECT_FALSE(step({mb4test::kStartFrame}, {}));
      EXPECT_FALSE(step({kReadStatus}, {status(0xFB, 0x02)}));
      EXPECT_TRUE(step({kClearValid1, kReadStatus}, {kOver}));
    }
    ends_with(fault == 0 ? Error::kNone : Error::kCorrupted);
  }
}

// The last frame of initialize(). Only a word that is all 0, whose CRC is wrong, while SL is 1
// again, is an error; it is stored inverted, and not at all with SpiCheck::kOff.
TEST_F(Initialize, WordNotSent_IsNoWord) {
  using mb4::SpiCheck;
  const auto crc_byte = [](std::uint8_t crc) { return join({zeros(9), {crc}}); };
  const struct {
    SpiCheck check;
    Bytes word;
    Error want;
  } cases[] = {{SpiCheck::kOff, zeros(10), Error::kNoWord},
               {SpiCheck::kOff, join({zeros(2), {1}, zeros(7)}), Error::kNone},
               {SpiCheck::kCrc, crc_byte(0x3F), Error::kNoWord},
               {SpiCheck::kCrc, crc_byte(0x3E), Error::kNone},
               {SpiCheck::kCrc, zeros(10), Error::kNone},
               {SpiCheck::kFull, crc_byte(0x3F), Error::kNoWord},
               {SpiCheck::kFull, join({zeros(5), {8}, zeros(3), {0x3F}}), Error::kNone}};
  for (const auto& one : cases) {
    configure(one.check);
    to_last_frame();
    EXPECT_FALSE(step({kReadStatus}, {kBadFrame}));
    EXPECT_FALSE(step({kReadWord}, {one.word}));
    if (one.want != Error::kNone) {
      EXPECT_FALSE(step({kReadLines}, {zeros(10)}));  // the slave's timeout
      EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
    }
    EXPECT_TRUE(one.check == SpiCheck::kFull ? step({kClearValid1, kReadStatus}, {kOver})
                                             : step({kClearValid1}, {}));
    ends_with(one.want);
    // The next frame needs no BREAK.
    ASSERT_TRUE(device.plan_initialize(op).ok());
    EXPECT_TRUE(step({kZero1, kZero5}, {}, false));
  }
}

// What else can happen to the frame is found by the reads: INIT has done its work.
TEST_F(Initialize, LastFrameFails_IsSuccess) {
  for (const int fault : {0, 1, 2}) {
    configure();
    to_last_frame();
    if (fault == 0) {  // refused: SL was low
      EXPECT_FALSE(step({kReadStatus}, {status(0x3B, 0x00)}));
      EXPECT_TRUE(step({kClearValid1}, {}));
    } else if (fault == 1) {  // SL stays low: all bits are 0
      EXPECT_FALSE(step({kReadStatus}, {kBadFrame}));
      EXPECT_FALSE(step({kReadWord}, {zeros(10)}));
      EXPECT_FALSE(step({kReadLines}, {zeros(10)}));
      now_us += 133;
      EXPECT_FALSE(step({kReadLines}, {zeros(10)}));
      EXPECT_FALSE(step({kReadLines}, {zeros(10)}));
      EXPECT_TRUE(step({kClearValid1}, {}));
    } else {  // without an end
      EXPECT_FALSE(step({kReadStatus}, {kRunsFrame}));
      now_us += 2000;
      EXPECT_FALSE(step({kReadStatus}, {kRunsFrame}));
      EXPECT_FALSE(step({kReadStatus}, {kRunsFrame}));
      EXPECT_TRUE(step({kBreak}, {}));
    }
    ends_with(Error::kNone);
    EXPECT_EQ(op.line_delay().quarters[0], 7);
  }
  configure();
  to_last_frame();
  EXPECT_TRUE(step({kReadStatus}, {}, false));
  ends_with(Error::kTransport);
}

// Broadcast 01, then 00 to the slave's ID; then the frame.
TEST_F(Initialize, Activates_WhenAskedTo) {
  mb4::Config config = mb4test::encoder26();
  config.activate_at_initialize = true;
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(config).ok());
  to_delays();
  for (const bool broadcast : {true, false}) {
    activates(broadcast, 0);
  }
  EXPECT_FALSE(step({mb4test::kStartFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {status(0xFB, 0x02)}));
  EXPECT_TRUE(step({kClearValid1}, {}));
  ends_with(Error::kNone);
  EXPECT_EQ(op.line_delay().quarters[0], 7);
  // Not acknowledged.
  to_delays();
  EXPECT_FALSE(step({{0x02, 0x80, 0}}, {}));
  EXPECT_FALSE(step({{0x03, 0x80, 0}}, {zeros(3)}));
  EXPECT_FALSE(step({{0x02, 0xE4, 0x01, 0x50}, {0x03, 0xE4, 0, 0}}, {{0, 0, 0x01, 0x50}}));
  EXPECT_FALSE(step({kFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_FALSE(step({kFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {status(0x77, 0x00)}));
  EXPECT_TRUE(step({kClearValid1, kRest}, {}));
  ends_with(Error::kCommand);
}

// Where the chip refuses a frame before the slaves' timeout is over, an access without automatic
// frames ends with this time: the frame behind it is not refused.
TEST_F(Initialize, ActivatesAndLooks_BehindTheSlavesTimeout) {
  mb4::Config config = mb4test::encoder26();
  config.activate_at_initialize = true;
  config.frame_start = mb4::FrameStart::kRequireIdleLine;
  mb4test::expect_configure(bus, 0xE8, 0x7D);  // table 44: the frame is refused while SL is low
  ASSERT_TRUE(device.configure(config).ok());
  to_delays();
  for (const bool broadcast : {true, false}) {
    activates(broadcast, kPause);
  }
  EXPECT_FALSE(step({mb4test::kStartFrame}, {}));
}

// EOT = 1 alone is not the end: INIT (bit 4 of 0xF4) is still 1.
TEST_F(Initialize, InitStillOne_IsLookedAtAgain) {
  const Bytes idle_with_init = status(0xFB, 0x00, 0x10);
  configure(mb4::SpiCheck::kFull);
  ASSERT_TRUE(device.plan_initialize(op).ok());
  EXPECT_FALSE(step({kZero1, kZero5}, {}));
  EXPECT_FALSE(step({kInit, kReadStatus}, {idle_with_init}));
  EXPECT_FALSE(step({kReadStatus}, {idle_with_init}));
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
  // INIT was seen, so it was not lost: 0 is a line without an answer.
  EXPECT_TRUE(step({{0x03, 0x00, 0x00}, {0x03, 0x00, 0x00}}, {{0, 0, 0}, {0, 0, 0}}));
  ends_with(Error::kNoData);
}

// BiSS B: REGVERS (bit 6 of 0xE5) is written before INIT and compared with SpiCheck::kFull.
TEST_F(Initialize, ProtocolReadsBackDifferently_IsCorrupted) {
  mb4::Config config = mb4test::encoder26();
  config.channels[0].protocol = mb4::Protocol::kBissB;
  config.spi_check = mb4::SpiCheck::kFull;
  Bytes image = mb4test::configuration();
  Bytes answer = mb4test::read_back();
  for (Bytes* bytes : {&image, &answer}) {
    (*bytes)[0xE5 - 0xC0] = 0x80;
    (*bytes)[0xE7 - 0xC0] = 0x00;  // NOCRC = 0
    (*bytes)[0xED - 0xC0] = 0x0C;  // CFGCH1 = 0, BiSS B (table 8)
  }
  mb4test::expect_image(bus, image, answer);
  ASSERT_TRUE(device.configure(config).ok());
  ASSERT_TRUE(device.plan_initialize(op).ok());
  EXPECT_FALSE(step({kZero1, kZero5, {0x02, 0xE5, 0x80}, {0x03, 0xE5, 0x00}}, {{0, 0, 0xC0}}));
  EXPECT_EQ(device.read_frame().error(), Error::kBusy);
  EXPECT_TRUE(compared(kOver, {{0xE5, 0x80}, {0xED, 0x0C}}));
  ends_with(Error::kCorrupted);
}

TEST_F(Initialize, LinesCannotBeRead_IsTransport) {
  configure();
  ASSERT_TRUE(device.plan_initialize(op).ok());
  EXPECT_FALSE(step({kZero1, kZero5}, {}));
  EXPECT_FALSE(step({kInit}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_TRUE(step({kReadLines}, {}, false));
  ends_with(Error::kTransport);
}

// Neither INIT nor a delay was seen: the instruction was lost. A disturbed status is no proof.
TEST_F(Initialize, Lost_IsCorrupted) {
  configure(mb4::SpiCheck::kFull);
  for (const bool disturbed : {false, true}) {
    ASSERT_TRUE(device.plan_initialize(op).ok());
    if (disturbed) {
      EXPECT_FALSE(step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness}, {witness(kOver)}));
      EXPECT_FALSE(step({kZero1, kZero5}, {}, true, kPause));
    } else {
      EXPECT_FALSE(step({kZero1, kZero5}, {}));
    }
    EXPECT_FALSE(step({kInit, kReadStatus}, {disturbed ? zeros(6) : kOver}));
    EXPECT_FALSE(step({kReadStatus}, {kOver}));
    EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
    EXPECT_TRUE(step({{0x03, 0x00, 0x00}, {0x03, 0x00, 0x00}}, {{0, 0, 0}, {0, 0, 0}}));
    ends_with(disturbed ? Error::kNoData : Error::kCorrupted);
  }
}

TEST_F(Initialize, Faults_AreTold) {
  configure();
  const auto to_status = [this](bool recover) {
    ASSERT_TRUE(device.plan_initialize(op).ok());
    if (recover) {
      EXPECT_FALSE(step({kBreak}, {}));
      EXPECT_FALSE(step({kClearValid1, kZero1, kZero5}, {}, true, kPause));
    } else {
      EXPECT_FALSE(step({kZero1, kZero5}, {}));
    }
    EXPECT_FALSE(step({kInit}, {}));
  };
  to_status(false);
  EXPECT_TRUE(step({kReadStatus}, {status(0x3B, 0x00)}));  // nAGSERR = 0
  ends_with(Error::kLineDelay);
  to_status(true);
  EXPECT_TRUE(step({kReadStatus}, {zeros(6)}));
  ends_with(Error::kNotDetected);
  to_status(true);
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_FALSE(step({kReadLines}, {zeros(10)}));
  now_us += 133;  // 100 us and the step of the coarsest clock
  EXPECT_FALSE(step({kReadLines}, {zeros(10)}));
  EXPECT_TRUE(step({kReadLines}, {zeros(10)}));
  ends_with(Error::kLineError);
  to_status(true);
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
  EXPECT_TRUE(step({{0x03, 0x00, 0x00}}, {{0, 0, 0}}));
  ends_with(Error::kNoData);
  // 1343 periods of 0.5 us, 200 us and the clock's step. Then the status is read once more.
  to_status(true);
  EXPECT_FALSE(step({kReadStatus}, {kInitRuns}));
  now_us += 1000;
  EXPECT_FALSE(step({kReadStatus}, {kInitRuns}));
  EXPECT_FALSE(step({kReadStatus}, {kInitRuns}));
  EXPECT_TRUE(step({kBreak}, {}));
  ends_with(Error::kTimeout);
}

// ---- Registers ----------------------------------------------------------------------------------

TEST_F(Access, ReadBesideAutomaticFrames_OneInstruction) {
  configure();
  start();
  read();
  EXPECT_EQ(device.control().plan_read(op, {1, 0}, 0, {out.data(), 1}).error(), Error::kBusy);
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_FALSE(step({kFrameAgs}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kRunsAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kRest}, {}));
  EXPECT_TRUE(step({{0x03, 0x80, 0, 0}}, {{0, 0, 0x12, 0x34}}));
  ends_with(Error::kNone);
  EXPECT_EQ(out[0], 0x12);
  EXPECT_EQ(out[1], 0x34);
  EXPECT_TRUE(device.automatic().running());
}

TEST_F(Access, ReadWithoutAutomaticFrames_OneInstructionAFrame) {
  configure();
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_FALSE(step({kFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kRuns}));
  EXPECT_FALSE(step({kReadStatus}, {kDone}));  // REGEND = 1 of the access before
  EXPECT_FALSE(step({kFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kDone}));
  EXPECT_FALSE(step({kClearValid1, kRest}, {}));
  EXPECT_TRUE(step({{0x03, 0x80, 0, 0}}, {{0, 0, 1, 2}}));
  ends_with(Error::kNone);
  // The next one begins without BREAK; its end fails three times, and then the one after it does
  // not. What the slave has answered stays the result.
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_FALSE(step({kFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_FALSE(step({kFrame}, {}));
  EXPECT_FALSE(step({kReadStatus}, {status(0x77, 0x00)}));  // nREGERR = 0
  EXPECT_FALSE(step({kClearValid1, kRest}, {}, false));
  EXPECT_FALSE(step({kClearValid1, kRest}, {}, false));
  EXPECT_TRUE(step({kClearValid1, kRest}, {}, false));
  ends_with(Error::kRegister);
  read();
  EXPECT_FALSE(step({kBreak, kRest}, {}));
  EXPECT_FALSE(step({kClearValid1, kRequest, kReadRequest}, kAsked, true, kPause));
  EXPECT_FALSE(step({kFrame}, {}));
}

// The access may run when its BREAK was lost. The next one writes nothing before BREAK is sent.
TEST_F(Access, BreakLost_NextOneBeginsWithBreak) {
  const std::array<std::uint8_t, 2> data{9, 10};
  {
    configure();
    start();
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrameAgs}, {}, false));
    EXPECT_TRUE(step({kBreak, kRest}, {}, false));
    ends_with(Error::kTransport);
    ASSERT_TRUE(device.control().plan_write(op, {1, 0}, 0x50, data).ok());
    EXPECT_FALSE(step({kBreak, kRest}, {}));
    EXPECT_FALSE(step({kClearValid1, {0x02, 0x80, 9, 10}}, {}, true, kPause));
    EXPECT_FALSE(step({{0x03, 0x80, 0, 0}}, {{0, 0, 9, 10}}));
    EXPECT_FALSE(step({{0x02, 0xE2, 0xD0, 0x01, 0x01, 0xC0}, kReadRequest},
                      {{0, 0, 0xD0, 0x01, 0x01, 0xC0}}));
    EXPECT_FALSE(step({kFrame}, {}));
    for (int looks = 0; looks < 3; ++looks) EXPECT_FALSE(step({kReadStatus}, {kRuns}, false));
    EXPECT_TRUE(step({kBreak, kRest}, {}));
  }
}

// RDATA holds other bytes then.
TEST_F(Access, AfterAWriteThatFails_NothingIsTaken) {
  const mb4::Span<std::uint8_t> two(out.data(), 2);
  mb4::Command command;
  command.ids = 1;
  for (unsigned kind = 0; kind < 2; ++kind) {
    configure();
    start();
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrameAgs}, {}));
    EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
    EXPECT_FALSE(step({kRest}, {}));
    EXPECT_TRUE(step({{0x03, 0x80, 0, 0}}, {{0, 0, 1, 2}}));
    bus.expect_read({0x03, 0x80, 0, 0}, {0, 0, 1, 2});
    EXPECT_TRUE(mb4_c::PolledAccess(device).take(two).ok());
    if (kind == 0) {
      ASSERT_TRUE(device.control().plan_write(op, {1, 0}, 0x50, two).ok());
      EXPECT_FALSE(step({{0x02, 0x80, 1, 2}}, {}, false));
      EXPECT_TRUE(step({kRest}, {}));
    } else if (kind == 1) {
      ASSERT_TRUE(device.control().plan_command(op, command).ok());
      EXPECT_FALSE(step({{0x02, 0x80, 0x80}}, {}, false));
      EXPECT_TRUE(step({kRest}, {}));
    }
    EXPECT_EQ(mb4_c::PolledAccess(device).take(two).error(), Error::kInvalidArgument) << kind;
  }
}

// The disturbed write may have set 0xF4: without automatic frames BREAK comes first, beside them
// next() starts them again.
TEST_F(Access, DisturbedRequest_IsFollowedByBreak) {
  for (const bool automatic : {false, true}) {
    {
      configure(mb4::SpiCheck::kFull);
      if (automatic) start();
      const Bytes wrong{0, 0, 0x44, 0x01, 0x01, 0xC1};
      read();
      EXPECT_FALSE(step(kAsk, {wrong}));
      EXPECT_FALSE(step(kAtRest, {kRestBack}));
      EXPECT_TRUE(compared(automatic ? kProven : kOver));
      ends_with(Error::kCorrupted);
      bus.expect_write({0x07, 0x80, 0x00}).fail_last();
      if (automatic) {
        mb4::Frame frame;
        EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
      } else {
        EXPECT_EQ(device.read_frame().error(), Error::kTransport);
      }
    }
  }
}

// Parts of eight: each step is short.
TEST_F(Access, Write64_GoesInParts) {
  configure(mb4::SpiCheck::kFull);
  start();
  std::array<std::uint8_t, 64> data{};
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(i + 1);
  ASSERT_TRUE(device.control().plan_write(op, {1, 0}, 0x40, data).ok());
  const auto part = [&data](std::size_t at) {
    const auto from = data.begin() + static_cast<int>(at);
    return Bytes(from, from + 8);
  };
  // All are written before the first one is read back: one wrong bit of an address leads into
  // another part.
  // The first part may reach the SCDATA of the one sensor.
  for (std::size_t at = 0; at < 64; at += 8) {
    std::vector<Bytes> frames{join({{0x02, static_cast<std::uint8_t>(0x80 + at)}, part(at)})};
    if (at == 0) frames.push_back(join({{0x03, 0x00}, Bytes(8, 0x01)}));
    EXPECT_FALSE(step(frames, {join({{0, 0, 0x34}, zeros(7)})}));
  }
  Bytes chip = join({mb4test::read_back(), zeros(10)});
  chip[0xE7 - 0xC0] = 0x00;  // NOCRC = 0
  for (std::size_t at = 0; at < 64; at += 8) {
    // ... or to the registers of a slave.
    const auto kept = chip.begin() + static_cast<int>(at);
    EXPECT_FALSE(step(
        {join({{0x03, static_cast<std::uint8_t>(0x80 + at)}, zeros(8)}),
         join({{0x03, static_cast<std::uint8_t>(0xC0 + at)}, zeros(8)}), kReadWitness},
        {join({zeros(2), part(at)}), join({zeros(2), Bytes(kept, kept + 8)}), witness(kProven)}));
  }
  const Bytes request{0x02, 0xE2, 0xC0, 0x3F, 0x01, 0xC0};
  EXPECT_FALSE(step({request, kReadRequest}, {{0, 0, 0xC0, 0x3F, 0x01, 0xC0}}));
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_TRUE(step(kAtRest, {kRestBack}));
  ends_with(Error::kNone);
}

// What was written differs: nothing begins, and nothing has to be stopped.
TEST_F(Access, DisturbedRequest_IsCorruptedAndBeginsNothing) {
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  EXPECT_FALSE(step(kAsk, {{0, 0, 0x44, 0x01, 0x01, 0xC1}}));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_TRUE(compared());
  ends_with(Error::kCorrupted);
  // The bytes may have started an access.
  read();
  begins_with_break();
  EXPECT_FALSE(step(kAsk, kAsked));
  // The instruction was lost.
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_TRUE(step(kAtRest, {kRestBack}));
  ends_with(Error::kCorrupted);
  // The second reading of the registers differs.
  read();
  access_ends();
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_FALSE(step(kTakeAgain, {{0, 0, 1, 3}, witness(kDoneAgs)}));
  EXPECT_TRUE(compared());
  ends_with(Error::kCorrupted);
  // MISO is stuck from here on.
  read();
  access_ends(true);
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {zeros(4), zeros(7)}));
  EXPECT_TRUE(step({join({{0x03, 0xE2}, zeros(18)})}, {zeros(20)}));
  ends_with(Error::kNotDetected);
  EXPECT_FALSE(device.configured());
}

// The end of a read: a transfer that fails is repeated, and a reading that differs. What stands in
// RDATA1 when the registers are taken is what stood there then.
TEST_F(Access, EndOfARead_IsRepeatedAndCompared) {
  configure(mb4::SpiCheck::kFull);
  start();
  for (const bool other : {false, true}) {
    read();
    access_ends(other);
    EXPECT_FALSE(step(kEnd, {}, false));
    EXPECT_FALSE(step(kEnd, kEnded));
    EXPECT_FALSE(step(kAtRest, {kAskedBack}));
    EXPECT_FALSE(step({kReadRest}, {kRestBack}));  // only its reading was disturbed
    // A disturbed byte has started the request at rest meanwhile: register 0 is in RDATA1.
    const Bytes taken{0, 0, static_cast<std::uint8_t>(other ? 9 : 1), 2};
    EXPECT_FALSE(step(kTakeFirst, {taken, witness(kDoneAgs)}));
    EXPECT_FALSE(step(kTakeAgain, {taken, witness(kDoneAgs)}));
    EXPECT_TRUE(compared());
    ends_with(other ? Error::kCorrupted : Error::kNone);
  }
  // A transfer that fails is made again, twice.
  read();
  access_ends(true);
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {}, false));
  EXPECT_FALSE(step(kAtRest, {}, false));
  EXPECT_TRUE(step(kAtRest, {}, false));
  ends_with(Error::kTransport);
  EXPECT_FALSE(device.automatic().running());
  restart_after_rest();
}

// At kFull something that was read back beside a write differs: the write may have reached the
// configuration (0xE2 becomes 0xC2, 0xE6 or 0xEA, 0x80 becomes 0xC0 by one bit), switch slave 1
// off, and give slave 2 its word. Positions wait until all has been compared.
class Doubt : public OperationTest {
 protected:
  std::uint8_t data_ = 0;

  // A second slave on the line.
  Doubt() {
    mb4::Config config = mb4test::encoder26();
    config.spi_check = mb4::SpiCheck::kFull;
    config.slaves[1] = config.slaves[0];
    Bytes image = mb4test::configuration();
    Bytes answer = mb4test::read_back();
    for (Bytes* bytes : {&image, &answer}) {
      (*bytes)[0xE7 - 0xC0] = 0x00;  // NOCRC = 0
      for (const auto& [address, value] : kSecond) (*bytes)[address - 0xC0U] = value;
    }
    mb4test::expect_image(bus, image, answer);
    EXPECT_TRUE(device.configure(config).ok());
    start();
  }
  void expect_waiting() {
    EXPECT_EQ(device.automatic().poll_slave(2).error(), Error::kBusy);
    mb4::Frame frame;
    EXPECT_EQ(device.automatic().poll(frame).error(), Error::kBusy);
  }
  // Positions are read again; this transfer fails.
  void expect_reading() {
    bus.expect_write({0x07, 0x41}).fail_last();
    bus.expect_write(kAgs);
    EXPECT_EQ(device.automatic().poll_slave(2).error(), Error::kTransport);
  }
  // The same behind a comparison: words that wait are dropped first.
  void expect_dropping() {
    bus.expect_write(kAgs).fail_last();
    EXPECT_EQ(device.automatic().poll_slave(2).error(), Error::kTransport);
  }
  void restart() {
    bus.expect_write({0x07, 0x80, 0x00});
    bus.expect_write(kClearBoth);
    bus.expect_read(kReadWitness, witness(status(0xFF, 0x00, 0x00)));
    expect_start();
    EXPECT_TRUE(device.automatic().restart().ok());
  }
  // A write of one register: `slave` is what the slaves' registers hold, `behind` the witness.
  bool write(std::uint8_t data, std::uint8_t slave, const Bytes& behind) {
    data_ = data;
    EXPECT_TRUE(device.control().plan_write(op, {1, 0}, 0x50, {&data_, 1}).ok());
    constexpr std::uint8_t word = 0x34;  // in SCDATA1
    EXPECT_FALSE(step({{0x02, 0x80, data}, {0x03, 0x00, 0x01}}, {{0, 0, word}}));
    return step({{0x03, 0x80, 0x00}, {0x03, 0xC0, 0x00}, kReadWitness},
                {{0, 0, data}, {0, 0, slave}, behind});
  }
  // The comparison of the whole configuration, in the operation itself.
  bool compares(const Others& changed = {}, const Bytes& end = kProven) {
    Others other = kSecond;
    other.insert(other.end(), changed.begin(), changed.end());
    bool ended = false;
    for (const auto& one : mb4test::in_steps(comparison(end, other))) {
      if (ended) break;
      expect_waiting();
      ended = step(one);
    }
    return ended;
  }
  // The request is not what was written.
  void to_comparison() {
    read();
    EXPECT_FALSE(step(kAsk, {Bytes(kRestBack.begin(), kRestBack.begin() + 6)}));
    expect_waiting();
    EXPECT_FALSE(step(kAtRest, {kRestBack}));
  }

  const Others kSecond{{0xC4, 0x5B}, {0xC5, 0x06}};
};

TEST_F(Doubt, OnlyAReadingWasDisturbed_IsCorruptedAndPositionsGoOn) {
  to_comparison();
  EXPECT_TRUE(compares());
  ends_with(Error::kCorrupted);
  EXPECT_TRUE(device.configured());
  EXPECT_TRUE(device.automatic().running());
  expect_dropping();
}

TEST_F(Doubt, ConfigurationChanged_IsVerifyAndPositionsStop) {
  to_comparison();
  EXPECT_TRUE(compares({{0xEC, 0x11}}));  // SLAVELOC5
  ends_with(Error::kVerify);
  EXPECT_EQ(op.result().info().address(), 0xEC);
  EXPECT_FALSE(device.configured());
  EXPECT_EQ(device.automatic().poll_slave(2).error(), Error::kWrongMode);
  EXPECT_EQ(device.read_frame(2).error(), Error::kNotConfigured);
}

// 0x07 for 0x03: the address of the reading was an instruction, 0xE2 a BREAK that swaps the banks.
TEST_F(Doubt, FramesStopped_NeedsARestart) {
  to_comparison();
  EXPECT_TRUE(compares({}, status(0xFB, 0x00, 0x62)));
  ends_with(Error::kCorrupted);
  EXPECT_TRUE(device.configured());
  EXPECT_FALSE(device.automatic().running());
  EXPECT_EQ(device.automatic().poll_slave(2).error(), Error::kWrongMode);
}

TEST_F(Doubt, FramesStoppedWhereRdataIsReadAtTheEnd_NeedsARestart) {
  read();
  access_ends();
  EXPECT_FALSE(step(kEnd, {{0, 0, 1}, witness(status(0xFB, 0x00, 0x00))}));
  expect_waiting();
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_FALSE(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_TRUE(compares({}, status(0xFB, 0x00, 0x00)));
  ends_with(Error::kCorrupted);
  EXPECT_FALSE(device.automatic().running());
}

// RDATA holds the same bytes from before, so its reading is right: the slaves' registers tell.
TEST_F(Doubt, DataOfAWriteInTheConfiguration_IsSeen) {
  for (const bool changed : {true, false}) {
    EXPECT_FALSE(write(0x12, changed ? 0x12 : 0x5B, witness(kProven)));
    if (!changed) break;
    EXPECT_FALSE(step(kAtRest, {kRestBack}));
    EXPECT_TRUE(compares());
    ends_with(Error::kCorrupted);
    restart();
  }
  expect_reading();
}

TEST_F(Doubt, OperationOfAnotherDevice_IsWrongMode) {
  StrictBus other_bus;
  mb4::Device<StrictBus, FakeClock> other(other_bus, clock);
  mb4test::expect_configure(other_bus);
  ASSERT_TRUE(other.configure(mb4test::encoder26()).ok());
  mb4::Operation of_other;
  ASSERT_TRUE(other.plan_verify(of_other).ok());
  to_comparison();
  EXPECT_TRUE(device.finish(of_other, true, now_us));
  EXPECT_EQ(of_other.result().error(), Error::kWrongMode);
  expect_waiting();
  EXPECT_TRUE(compares());
}

// The read of a 0 has become an instruction, 0x07 for 0x03: RDATA, or the slaves' registers, whose
// address is a BREAK. The byte behind it has reached 0xF5.
TEST_F(Doubt, ZeroOfAnInstruction_IsSeen) {
  EXPECT_FALSE(write(0, 0x5B, witness(status(0xFB, 0x00, 0x00))));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_TRUE(compares({}, status(0xFB, 0x00, 0x00)));
  ends_with(Error::kCorrupted);
  EXPECT_FALSE(device.automatic().running());
}

TEST_F(Doubt, ZeroOfAnInstruction_HasChangedTheClock) {
  EXPECT_FALSE(write(0, 0x5B, witness(kProven, 0x5A)));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_TRUE(compares({{0xF5, 0x5A}}));
  ends_with(Error::kVerify);
  EXPECT_EQ(op.result().info().address(), 0xF5);
  EXPECT_FALSE(device.configured());
}

// The registers of a slave are all 0.
TEST_F(Doubt, ZerosOfARead_NeedAWitness) {
  for (const bool again : {false, true}) {
    read();
    access_ends();
    EXPECT_FALSE(step(kEnd, {{0, 0, 0}, witness(kDoneAgs)}));
    EXPECT_FALSE(step(kAtRest, {kRestBack}));
    const Bytes stopped = witness(status(0xFF, 0x00, 0x00));
    EXPECT_FALSE(step(kTakeFirst, {zeros(4), again ? witness(kDoneAgs) : stopped}));
    if (again) {
      EXPECT_FALSE(step(kTakeAgain, {zeros(4), stopped}));
    }
    EXPECT_TRUE(compares({}, status(0xFF, 0x00, 0x00)));
    ends_with(Error::kCorrupted);
    EXPECT_FALSE(device.automatic().running());
    restart();
  }
}

// Nothing but verify() and configure() is allowed until then.
TEST_F(Doubt, OperationGivenUp_VerifyEndsTheWaiting) {
  to_comparison();
  std::array<std::uint8_t, 1> one{};
  EXPECT_EQ(device.control().read_registers({1, 0}, 0x44, one).error(), Error::kBusy);
  for (const auto& frame : comparison(kProven, kSecond)) bus.expect_read(frame.mosi, frame.miso);
  ASSERT_TRUE(device.verify().ok());
  expect_dropping();
}

// Automatic frames were stopped: success of a comparison alone does not tell it.
TEST_F(Doubt, VerifyEndsTheWaiting_AndSeesThatFramesStopped) {
  to_comparison();
  for (const auto& frame : comparison(kOver, kSecond)) bus.expect_read(frame.mosi, frame.miso);
  EXPECT_EQ(device.verify().error(), Error::kCorrupted);
  EXPECT_FALSE(device.automatic().running());
}

// What it has read may be older than the doubt: it compares once more, and ends the doubt of both.
TEST_F(Doubt, VerifyThatHasBegunBefore_ComparesAgain) {
  mb4::Operation verify;
  ASSERT_TRUE(device.plan_verify(verify).ok());
  to_comparison();
  bool ended = false;
  for (int round = 0; round < 2; ++round) {
    EXPECT_FALSE(ended);
    expect_waiting();
    for (const auto& frames : mb4test::in_steps(comparison(kProven, kSecond))) {
      ASSERT_EQ(verify.frames(), frames.size());
      for (unsigned k = 0; k < frames.size(); ++k) {
        const Bytes& miso = frames[k].miso;
        for (std::size_t i = 0; i < miso.size(); ++i) verify.rx(k)[i] = miso[i];
      }
      ended = device.finish(verify, true, now_us);
    }
  }
  EXPECT_TRUE(ended);
  EXPECT_TRUE(verify.result().ok());
  EXPECT_TRUE(device.finish(op, true, now_us));
  ends_with(Error::kCorrupted);
  expect_dropping();
}

// configure() has ended the doubt: the operation that waits says nothing of the new configuration.
TEST_F(Doubt, ConfigureMeanwhile_StaysConfigured) {
  to_comparison();
  configure();
  EXPECT_TRUE(device.finish(op, false, now_us));
  ends_with(Error::kCorrupted);
  EXPECT_TRUE(device.configured());
}

// A part of a write has gone to the place of another one, 0x80 for 0x88.
TEST_F(Doubt, PartOfAWriteInAnotherOne_IsSeen) {
  std::array<std::uint8_t, 16> data{};
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(i + 1);
  ASSERT_TRUE(device.control().plan_write(op, {1, 0}, 0x40, data).ok());
  EXPECT_FALSE(step({join({{0x02, 0x80}, Bytes(data.begin(), data.begin() + 8)}),
                     join({{0x03, 0x00}, Bytes(8, 0x01)})},
                    {zeros(10)}));
  EXPECT_FALSE(step({join({{0x02, 0x88}, Bytes(data.begin() + 8, data.end())}),
                     join({{0x03, 0x08}, Bytes(8, 0x01)})},
                    {zeros(10)}));
  EXPECT_FALSE(
      step({join({{0x03, 0x80}, zeros(8)}), join({{0x03, 0xC0}, zeros(8)}), kReadWitness},
           {join({zeros(2), Bytes(data.begin() + 8, data.end())}),
            join({zeros(2), Bytes{0x5B, 0x06, 0, 0, 0x5B, 0x06, 0, 0}}), witness(kProven)}));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_TRUE(compares());
  ends_with(Error::kCorrupted);
}

// ... and what an access has read before cannot be taken.
TEST_F(Doubt, ConfigurationChanged_LeavesNothingToTake) {
  read();
  access_ends();
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kAskedBack}));
  EXPECT_FALSE(step({kReadRest}, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_FALSE(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_TRUE(compares({{0xE6, 0x00}}));
  ends_with(Error::kVerify);
  EXPECT_EQ(mb4_c::PolledAccess(device).take(mb4::Span<std::uint8_t>(out.data(), 2)).error(),
            Error::kInvalidArgument);
}

// The request at rest is not in the chip: the write may have reached another register (0xE2 and
// 0xE6, FREQ, differ in one bit). It is written again, and the result says it.
TEST_F(Access, RequestAtRestLost_IsCorrupted) {
  for (const bool once : {true, false}) {
    configure(mb4::SpiCheck::kFull);
    start();
    read();
    access_ends();
    EXPECT_FALSE(step(kEnd, kEnded));
    EXPECT_FALSE(step(kAtRest, {kAskedBack}));
    EXPECT_FALSE(step({kReadRest}, {kAskedBack}));
    EXPECT_FALSE(step(kAtRest, {once ? kRestBack : kAskedBack}));
    EXPECT_TRUE(compared());
    ends_with(Error::kCorrupted);
    EXPECT_EQ(device.automatic().running(), once);
    if (!once) restart_after_rest();
  }
  // The same behind BREAK.
  for (const bool abort : {true, false}) {
    configure(mb4::SpiCheck::kFull);
    start();
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    bus.expect_write({0x07, 0x80});
    bus.expect_write(kRest);
    bus.expect_read(kReadRest, kAskedBack);
    bus.expect_read(kReadStatus, kOver);
    bus.expect_read(kReadRest, kAskedBack);
    mb4test::expect_rest_at_full(bus);
    expect_compared(kOver);
    EXPECT_EQ(abort ? device.control().abort().error() : device.break_transmission().error(),
              Error::kCorrupted);
    EXPECT_TRUE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
    ends_with(Error::kWrongMode);
  }
}

// It was away before a recovery, and is not in the chip behind it.
TEST_F(Access, RequestAtRestLostBehindBreak_IsCorrupted) {
  for (const bool automatic : {true, false}) {
    configure(mb4::SpiCheck::kFull);
    start();
    read();
    access_ends();
    EXPECT_FALSE(step(kEnd, kEnded));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(step(kAtRest, {}, false), i == 2);
    bus.expect_write({0x07, 0x80, 0x00});
    bus.expect_write(kClearValid1);
    bus.expect_write(kRest);
    bus.expect_read(kReadRest, kAskedBack);
    bus.expect_read(kReadWitness, witness(status(0xFF, 0x00, 0x00)));
    expect_compared(kOver);
    EXPECT_EQ(automatic ? device.automatic().restart().error() : device.read_frame().error(),
              Error::kCorrupted);
    restart_after_rest();
  }
}

// Each status of the end may be disturbed: nREGERR, nDELAYERR, REGBYTES, an instruction that is
// not 0. Two that follow each other decide.
TEST_F(Access, DisturbedEnd_IsReadAgain) {
  const Bytes failed = status(0x77, 0x00, 0x01);  // nREGERR = 0
  for (const bool fails : {true, false}) {
    configure(mb4::SpiCheck::kFull);
    start();
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
    EXPECT_FALSE(step({kReadStatus}, {fails ? kDoneAgs : failed}));
    EXPECT_FALSE(step({kReadStatus}, {fails ? failed : kDoneAgs}));
    EXPECT_FALSE(step({kReadStatus}, {fails ? failed : kDoneAgs}));
    if (fails) {
      EXPECT_TRUE(step(kAtRest, {kRestBack}));
      ends_with(Error::kRegister);
      continue;
    }
    EXPECT_FALSE(step(kEnd, kEnded));
    EXPECT_FALSE(step(kAtRest, {kRestBack}));
    EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
    EXPECT_TRUE(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDoneAgs)}));
    ends_with(Error::kNone);
  }
  // No two agree.
  read();
  EXPECT_FALSE(asks_again());
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
  for (const Bytes& look : {kDoneAgs, failed, kDoneAgs, failed}) {
    EXPECT_FALSE(step({kReadStatus}, {look}));
  }
  EXPECT_TRUE(step({kBreak, kRest, kReadRest}, {kRestBack}));
  ends_with(Error::kCorrupted);
}

// 0x08, the instruction of a frame with control communication, and 0x09, which begins automatic
// frames too, differ in one bit.
TEST_F(Access, AutomaticFramesThatNobodyStarted_AreCorrupted) {
  const Bytes with_ags = status(0xFF, 0x00, 0x01);
  configure(mb4::SpiCheck::kFull);
  read();
  to_second_frame();
  EXPECT_FALSE(step({kReadStatus}, {with_ags}));
  EXPECT_FALSE(step({kReadStatus}, {with_ags}));
  EXPECT_TRUE(step({kBreak, kRest, kReadRest}, {kRestBack}));
  ends_with(Error::kCorrupted);
  // The frame at the end of initialize().
  configure(mb4::SpiCheck::kFull);
  to_last_frame();
  EXPECT_TRUE(step({kReadStatus}, {status(0xFB, 0x02, 0x01)}));
  ends_with(Error::kCorrupted);
}

// The frames of an access without automatic frames set SVALID. Where it stays the access is good,
// and the next frame begins with BREAK.
TEST_F(Access, EndWithoutAutomaticFrames_ProvesSvalid) {
  for (const int fault : {0, 1, 2}) {
    const bool stays = fault == 1;
    configure(mb4::SpiCheck::kFull);
    read();
    to_second_frame();
    EXPECT_FALSE(step({kReadStatus}, {kDone}));
    EXPECT_FALSE(step({kReadStatus}, {kDone}));
    EXPECT_FALSE(step(kEnd, {{0, 0, 1}, witness(kDone)}));
    EXPECT_FALSE(step(kAtRest, {kRestBack}));
    const Bytes valid = status(0xFF, 0x02);
    if (fault == 2) {
      EXPECT_FALSE(step({kClearValid1, kReadStatus}, {}, false));
    } else {
      EXPECT_FALSE(step({kClearValid1, kReadStatus}, {valid}));  // it takes some system clocks
      EXPECT_FALSE(step({kReadStatus}, {stays ? valid : kDone}));
    }
    EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDone)}));
    EXPECT_EQ(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDone)}), !stays);
    if (stays) {
      EXPECT_TRUE(compared(kOver));
    }
    ends_with(Error::kNone);
    bus.expect_write(fault != 0 ? Bytes{0x07, 0x80, 0x00} : mb4test::kStartFrame).fail_last();
    EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  }
}

// One disturbed REGEND in the last frame: another frame would run the whole access again.
TEST_F(Access, DisturbedRegend_MakesNoFrameMore) {
  configure(mb4::SpiCheck::kFull);
  read();
  to_second_frame();
  EXPECT_FALSE(step({kReadStatus}, {kOver}));  // REGEND was 1
  EXPECT_FALSE(step({kReadStatus}, {kDone}));
  EXPECT_FALSE(step({kReadStatus}, {kDone}));
  EXPECT_FALSE(step(kEnd, {{0, 0, 1}, witness(kDone)}));
}

// RDATA1 is read with a filler that a disturbed opcode writes while the chip answers 0. After a
// reading that differs the registers are gone.
TEST_F(Access, DisturbedTake_LeavesNothingToTake) {
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  access_ends();
  EXPECT_FALSE(step(kEnd, {{0, 0, 0}, witness(kDoneAgs)}));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, mb4test::kFiller, 2}, witness(kDoneAgs)}));
  EXPECT_FALSE(step(kTakeAgain, {{0, 0, mb4test::kFiller, 2}, witness(kDoneAgs)}));
  EXPECT_TRUE(compared());
  ends_with(Error::kCorrupted);
  EXPECT_EQ(mb4_c::PolledAccess(device).take(mb4::Span<std::uint8_t>(out.data(), 2)).error(),
            Error::kInvalidArgument);
}

// SVALID behind BREAK that stays, a frame that still runs, and 0xF4 that is not 0: the clear has
// gone there, or BREAK was lost.
TEST_F(Access, RecoveryUnproven_IsTold) {
  for (const auto& [first, second, error] :
       {std::tuple{status(0xFB, 0x00, 0x6F), Bytes(), Error::kCorrupted},
        std::tuple{status(0xFB, 0x02), status(0xFB, 0x02), Error::kCorrupted},
        std::tuple{status(0xFA, 0x00), status(0xFA, 0x00), Error::kTimeout},
        std::tuple{status(0xFB, 0x02), kOver, Error::kNone}}) {
    configure(mb4::SpiCheck::kFull);
    start();
    bus.expect_write({0x07, 0x00});
    bus.expect_read(kReadStatus, kOver);
    ASSERT_TRUE(device.automatic().stop().ok());
    bus.expect_write({0x07, 0x80, 0x00});
    bus.expect_write(kClearValid1);
    bus.expect_read(kReadWitness, witness(first));
    if (!second.empty()) bus.expect_read(kReadStatus, second);
    if (error == Error::kNone) bus.expect_write(mb4test::kStartFrame).fail_last();
    EXPECT_EQ(device.read_frame().error(), error == Error::kNone ? Error::kTransport : error);
  }
}

// One bit more in 0xF4: a frame would follow INIT, and the delay would be read in the other bank.
TEST_F(Initialize, AnotherInstructionWithIt_IsCorrupted) {
  configure(mb4::SpiCheck::kFull);
  ASSERT_TRUE(device.plan_initialize(op).ok());
  EXPECT_FALSE(step({kZero1, kZero5}, {}));
  EXPECT_TRUE(step({kInit, kReadStatus}, {status(0xFA, 0x00, 0x18)}));
  ends_with(Error::kCorrupted);
  bus.expect_write({0x07, 0x80, 0x00}).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
}

// A clear whose address is disturbed, 0xF3 for 0xF1, writes 0xF4: the bank is another one.
TEST_F(Initialize, ClearGoesToTheInstruction_IsCorrupted) {
  configure(mb4::SpiCheck::kFull);
  ASSERT_TRUE(device.plan_initialize(op).ok());
  EXPECT_FALSE(step({kZero1, kZero5}, {}));
  EXPECT_FALSE(step({kInit, kReadStatus}, {kInitRuns}));
  EXPECT_FALSE(step({kReadStatus}, {kOver}));
  EXPECT_FALSE(step({kReadLines}, {kIdleLines}));
  EXPECT_FALSE(step({{0x03, 0x00, 0x00}, {0x03, 0x00, 0x00}}, {{0, 0, 7}, {0, 0, 7}}));
  EXPECT_FALSE(step({kClearValid1, kReadStatus}, {status(0xFA, 0x00, 0x6F)}));
  EXPECT_TRUE(compared(kOver));
  ends_with(Error::kCorrupted);
}

// A read of positions whose bytes were disturbed may have changed RDATA while the access ran, or
// before the registers are taken.
TEST_F(Access, CorruptedReadBesideIt_IsCorrupted) {
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
  read_sees_stray();
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_TRUE(step(kAtRest, {kRestBack}));
  ends_with(Error::kCorrupted);
  EXPECT_TRUE(device.automatic().running());
  // The next one begins with BREAK and a new start.
  read();
  begins_with_break();
  access_ends();
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  read_sees_stray();
  EXPECT_TRUE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  ends_with(Error::kCorrupted);
  EXPECT_TRUE(device.automatic().running());
}

// BREAK, a new configuration and another access end an access in its last steps too.
TEST_F(Access, BreakInTheLastSteps_EndsIt) {
  for (const int at : {0, 1, 2, 3}) {
    configure(mb4::SpiCheck::kFull);
    start();
    read();
    access_ends();
    if (at > 0) {
      EXPECT_FALSE(step(kEnd, kEnded));
    }
    if (at > 1) {
      EXPECT_FALSE(step(kAtRest, {kRestBack}));
    }
    if (at > 2) {
      EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
    }
    bus.expect_write({0x07, 0x80});
    if (at < 2) mb4test::expect_rest_at_full(bus);
    bus.expect_read(kReadStatus, kOver);
    EXPECT_TRUE(device.control().abort().ok());
    EXPECT_TRUE(device.finish(op, true, now_us)) << at;
    ends_with(Error::kWrongMode);
  }
}

// nREGERR = 0 at the first look: the instruction was not lost, the access has failed already.
TEST_F(Access, FailedAtOnce_IsRegister) {
  const Bytes failed = status(0x77, 0x00, 0x01);
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {failed}));
  EXPECT_FALSE(step({kReadStatus}, {failed}));
  EXPECT_FALSE(step({kReadStatus}, {failed}));
  EXPECT_TRUE(step(kAtRest, {kRestBack}));
  ends_with(Error::kRegister);
  EXPECT_TRUE(device.automatic().running());
}

// The end counts when it is seen twice, beside reads of positions, which write INSTR = 000, too.
TEST_F(Access, EndBesideReads_IsSeenTwice) {
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
  bus.expect_write({0x07, 0x41});
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x41));
  bus.expect_write(kAgs);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kReadStatus}, {status(0xFB, 0x00, 0x01)}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_TRUE(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  ends_with(Error::kNone);
}

// After an error the access may still run: BREAK is the last step, and the first error the result.
TEST_F(Access, Failures_EndWithBreak) {
  configure();
  for (const bool break_too : {true, false}) {
    start();
    read();
    EXPECT_FALSE(step(kAsk, {}, false));
    EXPECT_TRUE(step({kRest}, {}));  // nothing has begun
    ends_with(Error::kTransport);
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrameAgs}, {}, false));
    EXPECT_TRUE(step({kBreak, kRest}, {}, break_too));
    ends_with(Error::kTransport);
    EXPECT_FALSE(device.automatic().running());
    bus.expect_write(kBreak);
    if (!break_too) bus.expect_write(kRest);
    bus.expect_write(kClearValid1);
    start();
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrameAgs}, {}));
    EXPECT_FALSE(step({kReadStatus}, {kRunsAgs}, false));
    EXPECT_FALSE(step({kReadStatus}, {zeros(6)}));
    EXPECT_FALSE(step({kReadStatus}, {Bytes(6, 0xFF)}));
    EXPECT_TRUE(step({kBreak, kRest}, {}, break_too));
    ends_with(Error::kNotDetected);
    bus.expect_write(kBreak);
    if (!break_too) bus.expect_write(kRest);
    bus.expect_write(kClearValid1);
    bus.expect_write(kAgs);
    ASSERT_TRUE(device.automatic().restart().ok());
    bus.expect_write({0x07, 0x00});
    ASSERT_TRUE(device.automatic().stop().ok());
    bus.expect_write(kBreak);
    bus.expect_write(kClearValid1);
  }
  start();
}

// REGEND was 1 behind the access before and is 0 now: a disturbed byte has begun another one, whose
// end would count. BREAK ends it before the next one.
TEST_F(Access, AnotherOneRuns_NothingBegins) {
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  access_ends();
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_TRUE(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  read();
  EXPECT_FALSE(asks_again(kRunsAgs));
  EXPECT_TRUE(step(kAtRest, {kRestBack}));
  ends_with(Error::kCorrupted);
  read();
  begins_with_break();
}

// Two looks that fail, one after the other, stop neither the access nor the automatic frames.
TEST_F(Access, DisturbedStatus_StopsNothing) {
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {zeros(6)}));
  EXPECT_FALSE(step({kReadStatus}, {kRunsAgs}));
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(step({kReadStatus}, {Bytes(6, 0xFF)}));
    EXPECT_FALSE(step({kReadStatus}, {}, false));
    EXPECT_FALSE(step({kReadStatus}, {kRunsAgs}));
  }
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_FALSE(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  // 0x07 for 0x05 would have written 0xF4 and 0xF5.
  EXPECT_TRUE(compared());
  ends_with(Error::kNone);
  EXPECT_TRUE(device.automatic().running());
  // Twice where only the status tells that the access has begun.
  read();
  EXPECT_FALSE(asks_again());
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {zeros(6)}));
  EXPECT_FALSE(step({kReadStatus}, {zeros(6)}));
  EXPECT_TRUE(step({kBreak, kRest, kReadRest}, {kRestBack}));
  ends_with(Error::kNotDetected);
}

// 0xF4 held something else than HOLDBANK: an access that nobody asked for may run, and BREAK ends
// it before the next one. Then the frames run again.
TEST_F(Access, AfterACorruptedRead_BeginsWithBreakAndANewStart) {
  configure(mb4::SpiCheck::kFull);
  start();
  read_sees_stray();
  for (const bool lost : {true, false}) {
    read();
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kWrongMode);
    EXPECT_EQ(step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness},
                   {witness(status(0xFF, 0x00, 0x00))}, !lost),
              lost);
    if (!lost) continue;
    ends_with(Error::kTransport);  // nothing has begun
    expect_break();
    expect_start();
    ASSERT_TRUE(device.automatic().restart().ok());
    read_sees_stray();
  }
  EXPECT_FALSE(step(kStarts, {kRestBack, witness(kProven)}, true, kPause));
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_TRUE(device.automatic().running());
  EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {kRunsAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kDoneAgs}));
  EXPECT_FALSE(step(kEnd, kEnded));
  EXPECT_FALSE(step(kAtRest, {kRestBack}));
  EXPECT_FALSE(step(kTakeFirst, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  EXPECT_TRUE(step(kTakeAgain, {{0, 0, 1, 2}, witness(kDoneAgs)}));
  ends_with(Error::kNone);
}

// The access that nobody asked for may take the bytes of this one, so this one does not begin.
TEST_F(Access, CorruptedReadBetweenSteps_BeginsNothing) {
  configure(mb4::SpiCheck::kFull);
  start();
  read();
  read_sees_stray();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_TRUE(step(kAtRest, {kRestBack}));
  ends_with(Error::kCorrupted);
  EXPECT_TRUE(device.automatic().running());
  read();
  EXPECT_FALSE(
      step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness}, {witness(status(0xFF, 0x00, 0x00))}));
}

// A read of a position may change the request, which stands in the chip: it waits for the
// instruction.
class ReadBeforeTheInstruction : public Access,
                                 public testing::WithParamInterface<mb4::SpiCheck> {};

TEST_P(ReadBeforeTheInstruction, IsBusy) {
  configure(GetParam());
  start();
  read();
  EXPECT_FALSE(step(kAsk, kAsked));
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kBusy);
  mb4::Frame frame;
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kBusy);
  const std::vector<Bytes> instruction =
      full() ? std::vector<Bytes>{kFrameAgs, kReadStatus} : std::vector<Bytes>{kFrameAgs};
  EXPECT_FALSE(step(instruction, {kRunsAgs}));
  bus.expect_write({0x07, 0x41}).fail_last();
  bus.expect_write(kAgs);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kTransport);
}

INSTANTIATE_TEST_SUITE_P(Checks, ReadBeforeTheInstruction,
                         testing::Values(mb4::SpiCheck::kOff, mb4::SpiCheck::kFull));

// SWBANK = 1 in the instruction of an access: the next read drops what waits. Where a chip allows
// no HOLDBANK beside an access no read can, and BREAK ends the access.
TEST_F(Access, BankSwitchedByTheInstruction_IsReleasedOrEnds) {
  for (const bool hold : {true, false}) {
    mb4::Config config = mb4test::encoder26();
    config.spi_check = mb4::SpiCheck::kFull;
    config.hold_beside_access = hold;
    mb4test::expect_configure(bus, 0xE7, 0x00);
    ASSERT_TRUE(device.configure(config).ok());
    start();
    read();
    EXPECT_FALSE(step(kAsk, kAsked));
    EXPECT_FALSE(step({kFrameAgs, kReadStatus}, {status(0xFB, 0x00, 0x29)}));
    if (!hold) {  // one disturbed status ends no access
      EXPECT_FALSE(step({kReadStatus}, {status(0xFB, 0x00, 0x29)}));
    }
    if (hold) {
      bus.expect_write(kAgs);
      bus.expect_write({0x02, 0xF1, 0x55, 0x55});
      bus.expect_write({0x02, 0xF1, 0x55, 0x55});
      bus.expect_read(join({kReadStatus, {0}}), join({kProven, {0x01}}));
      bus.expect_write({0x07, 0x41});
      bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x41));
      bus.expect_write(kAgs);
      EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
    }
    EXPECT_TRUE(hold ? !step({kReadStatus}, {kRunsAgs})
                     : step({kBreak, kRest, kReadRest}, {kRestBack}));
    if (!hold) ends_with(Error::kCorrupted);
    bus.expect_write(kBreak);
    if (hold) mb4test::expect_rest_at_full(bus);
    bus.expect_read(kReadStatus, kOver);
    ASSERT_TRUE(device.break_transmission().ok());
    EXPECT_TRUE(device.finish(op, false, now_us));
  }
}

// ---- SpiCheck::kFullAndRelease ------------------------------------------------------------------

// After BREAK the frames run again; 0xF4 is proven before the request.
TEST_F(Access, ReleaseProven_NewStartToo) {
  for (const bool proven : {false, true}) {
    configure(mb4::SpiCheck::kFullAndRelease);
    start();
    bus.expect_write({0x07, 0x41});
    bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x41));
    bus.expect_write(kAgs);
    bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x09));
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kCorrupted);
    read();
    EXPECT_TRUE(step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness},
                     {witness(status(0xFB, 0x00, 0x08))}));
    ends_with(Error::kCorrupted);
    EXPECT_FALSE(device.automatic().running());
    expect_break();
    start();
    read_sees_stray();
    read();
    EXPECT_FALSE(step({{0x07, 0x80, 0x00}, kClearValid1, kReadWitness},
                      {witness(status(0xFF, 0x00, 0x00))}));
    EXPECT_NE(step(kStarts, {kRestBack, witness(proven ? kProven : status(0xFB, 0x00, 0x21))}, true,
                   kPause),
              proven);
    if (proven) {
      EXPECT_FALSE(step(kAsk, kAsked));
    }
  }
}

// 50 frames of 220 us, 4096 * 64 periods of MA and a quarter, 200 us.
TEST_F(Access, NeverEnding_IsTimeoutAfterAnotherLook) {
  configure();
  start();
  read(1);
  EXPECT_FALSE(
      step({{0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0}, kReadRequest}, {{0, 0, 0x44, 0x00, 0x01, 0xC0}}));
  EXPECT_FALSE(step({kFrameAgs}, {}));
  now_us += 174'800;
  EXPECT_FALSE(step({kReadStatus}, {kRunsAgs}));
  now_us += 100;
  EXPECT_FALSE(step({kReadStatus}, {kRunsAgs}));
  EXPECT_FALSE(step({kReadStatus}, {kRunsAgs}));
  EXPECT_TRUE(step({kBreak, kRest}, {}));
  ends_with(Error::kTimeout);
  EXPECT_FALSE(device.automatic().running());
  // next() starts the frames again.
  bus.expect_write(kBreak);
  bus.expect_write(kClearValid1);
  bus.expect_write(kAgs);
  bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 1}).fail_last();
  mb4::Frame frame;
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
}

// A clock that stands still: the polls and the frames are counted.
TEST(AccessCounted, ClockStandsStill_IsTimeout) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  mb4::Config config = mb4test::encoder26();
  config.register_busy_us = 39;
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(config).ok());
  mb4::Operation op;
  std::uint8_t out = 0;
  ASSERT_TRUE(device.control().plan_read(op, {1, 0}, 0x10, {&out, 1}).ok());
  std::size_t frames = 0;
  for (bool ended = false; !ended;) {
    frames += op.tx(0)[0] == 0x07 && op.tx(0)[1] == 0x08 ? 1 : 0;
    if (op.frames() == 2 && !op.rx(1).empty()) {  // the request is read back
      for (std::size_t k = 2; k < 6; ++k) op.rx(1)[k] = op.tx(0)[k];
    }
    if (!op.rx(0).empty()) {
      for (std::size_t k = 0; k < 6; ++k) op.rx(0)[k] = kOver[k];
    }
    ended = device.finish(op, true, 0);
    ASSERT_LT(frames, 200U);
  }
  EXPECT_EQ(op.result().error(), Error::kTimeout);
  EXPECT_EQ(frames, 49U + 39U + 1U);
}

TEST_F(Access, ClockStandsStillBesideAutomaticFrames_PollsAreCounted) {
  mb4::Config config = mb4test::encoder26();
  config.register_busy_us = 1;
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(config).ok());
  start();
  read();
  std::size_t polls = 0;
  for (bool ended = false; !ended; ++polls) {
    if (op.frames() == 2 && !op.rx(1).empty()) {  // the request is read back
      for (std::size_t k = 2; k < 6; ++k) op.rx(1)[k] = op.tx(0)[k];
    }
    if (!op.rx(0).empty()) {
      for (std::size_t k = 0; k < 6; ++k) op.rx(0)[k] = kRunsAgs[k];
    }
    ended = device.finish(op, true, 0);
    ASSERT_LT(polls, 100'000U);
  }
  ends_with(Error::kTimeout);
  // At least four for each microsecond of 63 frames of 218 us.
  EXPECT_GT(polls, 4U * 63 * 218);
}

// ---- Commands -----------------------------------------------------------------------------------

TEST_F(Access, Command_HasItsFields) {
  configure();
  start();
  mb4::Command command;
  command.ids = 0x05;
  command.code = 1;
  command.test_acknowledge = true;
  ASSERT_TRUE(device.control().plan_command(op, command).ok());
  EXPECT_FALSE(step({{0x02, 0x80, 0xA0}}, {}));
  EXPECT_FALSE(step({{0x03, 0x80, 0}}, {{0, 0, 0xA0}}));
  EXPECT_FALSE(step({{0x02, 0xE4, 0x01, 0x58}, {0x03, 0xE4, 0, 0}}, {{0, 0, 0x01, 0x58}}));
  EXPECT_FALSE(step({kFrameAgs}, {}));
  EXPECT_FALSE(step({kReadStatus}, {status(0x77, 0x00, 0x01)}));
  EXPECT_TRUE(step({kRest}, {}));
  ends_with(Error::kCommand);
  // nDELAYERR = 0 too: no slave has acknowledged, and a command has no register that is slow.
  ASSERT_TRUE(device.control().plan_command(op, command).ok());
  EXPECT_FALSE(step({{0x02, 0x80, 0xA0}}, {}));
  EXPECT_FALSE(step({{0x03, 0x80, 0}}, {{0, 0, 0xA0}}));
  EXPECT_FALSE(step({{0x02, 0xE4, 0x01, 0x58}, {0x03, 0xE4, 0, 0}}, {{0, 0, 0x01, 0x58}}));
  EXPECT_FALSE(step({kFrameAgs}, {}));
  EXPECT_FALSE(step({kReadStatus}, {status(0x57, 0x00, 0x01)}));
  EXPECT_TRUE(step({kRest}, {}));
  ends_with(Error::kCommand);
  command.code = 4;
  EXPECT_EQ(device.control().plan_command(op, command).error(), Error::kInvalidArgument);
}

// Two chains: broadcast 01 to both channels, then command 00 to each channel's IDs.
TEST(Activate, TwoChannels_EachItsIds) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  EXPECT_EQ(device.control().activate().error(), Error::kNotConfigured);
  mb4test::expect_configure_three(bus);
  ASSERT_TRUE(device.configure(mb4test::three_slaves()).ok());
  const auto expect_command = [&bus](std::uint8_t channels, std::uint8_t ids, std::uint8_t ctrl) {
    bus.expect_proven({0x02, 0x80, ids});
    bus.expect_proven({0x02, 0xE4, channels, ctrl});
    bus.expect_write(kFrame);
    bus.expect_read(kReadStatus, kOver);
    bus.expect_write(kFrame);
    bus.expect_read(kReadStatus, kDone);
    bus.expect_write(mb4test::kThreeClear);
    bus.expect_write(kRest);
  };
  expect_command(3, 0x00, 0x50);
  expect_command(1, 0xC0, 0x40);  // slaves 1 and 2: ID 1 and ID 0, which is bit 7 (table 32)
  expect_command(2, 0x80, 0x40);  // slave 5
  EXPECT_TRUE(device.control().activate().ok());
  expect_command(3, 0x00, 0x50);
  expect_command(1, 0x40, 0x40);
  EXPECT_TRUE(device.control().activate(0x02).ok());
}

// Frames that do not wait for SL = 1 are requested when the slaves' timeout is over.
TEST(Activate, FramesThatDoNotWait_ComeAfterAPause) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  mb4::Config config = mb4test::encoder26();
  config.frame_start = mb4::FrameStart::kOnPin;
  mb4test::expect_configure(bus, 0xE8, 0x7D);
  ASSERT_TRUE(device.configure(config).ok());
  mb4::Operation op;
  ASSERT_TRUE(device.control().plan_activate(op).ok());
  unsigned frames = 0;
  Bytes written;
  while (frames < 4) {
    EXPECT_EQ(op.pause_us() >= 100, op.tx(0)[0] == 0x07 && frames != 0) << frames;
    frames += op.tx(0)[0] == 0x07 ? 1 : 0;
    for (std::size_t i = 0; i < op.frames(); ++i) {
      if (op.rx(i).empty()) {
        written.assign(op.tx(i).begin(), op.tx(i).end());
        continue;
      }
      if (op.tx(i)[0] == 0x03) {  // what was written before
        for (std::size_t k = 2; k < op.tx(i).size(); ++k) op.rx(i)[k] = written.at(k);
      } else {
        for (std::size_t k = 0; k < 6; ++k) op.rx(i)[k] = kOver[k];
      }
    }
    ASSERT_FALSE(device.finish(op, true, 5000));
  }
}

TEST_F(Access, WrongArguments_PlanNothing) {
  EXPECT_EQ(device.control().plan_read(op, {1, 0}, 0, {out.data(), 1}).error(),
            Error::kNotConfigured);
  configure();
  const mb4::Span<std::uint8_t> all(out);
  EXPECT_EQ(device.control().plan_read(op, {1, 0}, 0, all.first(0)).error(),
            Error::kInvalidArgument);
  EXPECT_EQ(device.control().plan_read(op, {1, 8}, 0, all.first(1)).error(),
            Error::kInvalidArgument);
  EXPECT_EQ(device.control().plan_write(op, {1, 0}, 0x41, all).error(), Error::kInvalidArgument);
  EXPECT_EQ(op.frames(), 0U);
  EXPECT_EQ(op.result().error(), Error::kWrongMode);
}

// ---- Actuators ----------------------------------------------------------------------------------

// Beside automatic frames the word goes to both banks; the status behind each look at the other one
// must be a status.
TEST_F(Access, ActuatorWithoutStatus_IsReported) {
  start_actuator(mb4::SpiCheck::kOff);
  const std::vector<Bytes> hold{{0x07, 0x41}, {0x02, 0x00, 0xBF, 0x37, 0xAF, 0x0A}, kAgs};
  const std::vector<Bytes> look{{0x03, 0x00, 0, 0, 0, 0}, kReadStatus};
  const Bytes same{0, 0, 0xBF, 0x37, 0xAF, 0x0A};
  for (const Error error : {Error::kNone, Error::kNotDetected, Error::kTransport}) {
    ASSERT_TRUE(device.plan_actuator(op, 1, mb4test::kRaw).ok());
    EXPECT_FALSE(step(hold, {}));
    EXPECT_FALSE(step(look, {same, status(0xFB, 0x00, 0x01)}));
    if (error == Error::kNone) {
      EXPECT_FALSE(step(look, {{0, 0, 1, 2, 3, 4}, status(0xFB, 0x00, 0x01)}));
      EXPECT_FALSE(step(hold, {}));
      now_us += 10'000;
      EXPECT_FALSE(step(look, {same, status(0xFB, 0x00, 0x01)}));
      EXPECT_TRUE(step(look, {same, status(0xFB, 0x00, 0x01)}));
    } else {
      EXPECT_TRUE(step(look, {same, zeros(6)}, error == Error::kNotDetected));
    }
    ends_with(error);
  }
}

// The release of an actuator's bank is proven too; otherwise the next read drops what waits.
TEST_F(Access, ActuatorsRelease_IsProven) {
  start_actuator(mb4::SpiCheck::kFullAndRelease);
  const Bytes held = status(0xFB, 0x00, 0x41);
  for (const bool proven : {false, true}) {
    const std::uint8_t mark = proven ? 2 : 1;
    ASSERT_TRUE(device.plan_actuator(op, 1, mb4test::kRaw).ok());
    EXPECT_FALSE(step({{0x07, 0x41}, kReadStatus}, {held}));
    EXPECT_FALSE(step(
        {{0x02, 0x00, 0xBF, 0x37, 0xAF, 0x0A, mark}, {0x03, 0x00, 0, 0, 0, 0, 0}, kReadWitness},
        {{0, 0, 0xBF, 0x37, 0xAF, 0x0A, mark}, witness(held)}));
    const bool ended = step({kAgs, kReadStatus}, {proven ? kProven : status(0xFB, 0x00, 0x21)});
    EXPECT_EQ(ended, !proven);
    if (ended) ends_with(Error::kCorrupted);
  }
  // What has waited since the release that was not proven is dropped by the next read.
  bus.expect_write(kAgs).fail_last();
  mb4::Frame frame;
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kTransport);
}

// The mark is not 0, as the bytes behind a shorter word are, and no byte of the word: a write that
// has gone some bytes too far must not look right.
TEST_F(Access, ActuatorsMark_IsAnotherOneInEachCallAndNoByteOfTheWord) {
  start_actuator(mb4::SpiCheck::kFull);
  const Bytes held = status(0xFB, 0x00, 0x41);
  std::uint8_t before = 0;
  for (unsigned i = 0; i < 600; ++i) {
    ASSERT_TRUE(device.automatic().plan_actuator(op, 1, mb4test::kRaw).ok());
    EXPECT_FALSE(step({{0x07, 0x41}, kReadStatus}, {held}));
    const std::uint8_t mark = op.tx(0)[6];
    EXPECT_FALSE(step(
        {{0x02, 0x00, 0xBF, 0x37, 0xAF, 0x0A, mark}, {0x03, 0x00, 0, 0, 0, 0, 0}, kReadWitness},
        {{0, 0, 0xBF, 0x37, 0xAF, 0x0A, mark}, witness(held)}));
    EXPECT_TRUE(step({kAgs, kReadStatus}, {kProven}));
    ends_with(Error::kNone);
    for (const unsigned other : {0x00U, 0xBFU, 0x37U, 0xAFU, 0x0AU, unsigned{before}}) {
      EXPECT_NE(mark, other) << i;
    }
    before = mark;
  }
}

// An actuator's word for both banks, at SpiCheck::kFull.
class BothBanks : public Access {
 protected:
  void begin() {
    start_actuator(mb4::SpiCheck::kFull);
    ASSERT_TRUE(device.plan_actuator(op, 1, mb4test::kRaw).ok());
  }
  // The word and its mark, under HOLDBANK, into the bank that is there.
  void write_word() {
    const Bytes held = status(0xFB, 0x00, 0x41);
    EXPECT_FALSE(step({{0x07, 0x41}, kReadStatus}, {held}));
    EXPECT_FALSE(step({{0x02, 0x00, 0xBF, 0x37, 0xAF, 0x0A, 0x01}, kRead, kReadWitness},
                      {same, witness(held)}));
    EXPECT_FALSE(step({kAgs, kReadStatus}, {kProven}));
  }
  // A look at the bank that is there: two readings.
  bool look(const Bytes& one, const Bytes& two) {
    return step({kRead, kRead, kReadWitness}, {one, two, witness(kProven)});
  }
  const Bytes kRead{0x03, 0x00, 0, 0, 0, 0, 0};
  const Bytes same{0, 0, 0xBF, 0x37, 0xAF, 0x0A, 0x01};
  const Bytes other{0, 0, 0xBE, 0x37, 0xAF, 0x0A, 0x01};
};

// With SpiCheck::kFull one reading that differs is not the other bank: both are read once more. A
// frame may end between the reading and HOLDBANK: then the first bank has got the word again, and
// the other one is looked for once more.
TEST_F(BothBanks, OtherBank_IsSeenTwice) {
  begin();
  write_word();
  EXPECT_FALSE(look(other, same));  // one bit was disturbed, or the banks were switched
  EXPECT_FALSE(look(same, same));
  EXPECT_FALSE(look(other, other));
  write_word();
  EXPECT_FALSE(look(other, other));
  write_word();
  now_us += 10'000;
  EXPECT_FALSE(look(same, same));
  EXPECT_TRUE(look(same, same));
  ends_with(Error::kNone);
}

// A reading of zeros may have been a write to the word of a sensor. Because of the mark the right
// answer is not 0: the next read drops what waits. Two readings with a switch between them cost
// nothing.
TEST_F(BothBanks, ReadingOfZeros_DropsWhatWaits) {
  begin();
  write_word();
  mb4::Frame frame;
  EXPECT_FALSE(look(other, same));
  bus.expect_write({0x07, 0x41}).fail_last();
  bus.expect_write(kAgs);
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kTransport);
  EXPECT_FALSE(look(same, zeros(7)));
  bus.expect_write(kAgs).fail_last();
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kTransport);
}

// The same word in the other bank has another mark, from another call.
TEST_F(BothBanks, SameWordWithAnotherMark_IsTheOtherBank) {
  begin();
  write_word();
  const Bytes before{0, 0, 0xBF, 0x37, 0xAF, 0x0A, 0xFF};
  EXPECT_FALSE(look(before, before));
  write_word();
}

// Readings that never agree.
TEST_F(BothBanks, ReadingsDiffer_IsCorruptedAtLast) {
  begin();
  write_word();
  EXPECT_FALSE(look(other, same));
  EXPECT_FALSE(look(same, other));
  EXPECT_TRUE(look(other, same));
  ends_with(Error::kCorrupted);
}

// A bank that never holds the word.
TEST_F(BothBanks, OneNeverHoldsTheWord_IsCorrupted) {
  begin();
  for (int words = 0; words < 9; ++words) {
    write_word();
    EXPECT_EQ(look(other, other), words == 8);
  }
  ends_with(Error::kCorrupted);
}

}  // namespace operation_test
}  // namespace
