// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The read path in steps, plan by plan: table 69 as one chain, and what follows a fault. Expected
// bytes come from the datasheet (tables 3, 44, 48, 55, 61; page 26).

#include "mb4/cyclic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <new>
#include <string>
#include <vector>

#include "mb4/device.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace cyclic_test {

using mb4::Error;
using mb4test::Bytes;
using mb4test::FakeClock;
using mb4test::hex;
using mb4test::join;
using mb4test::kClearValid1;
using mb4test::kClearValid1AndRelease;
using mb4test::kReadStatus;
using mb4test::StrictBus;
using mb4test::zeros;

const Bytes kAgs{0x07, 0x01};
// What waited in a held bank is old for every slave: SVALID1 to 8 are bits 1, 3, 5, 7 of two bytes.
const Bytes kClearAllValid{0x02, 0xF1, 0x55, 0x55};
const Bytes kHold{0x07, 0x41};
const Bytes kReadWord = join({{0x09}, zeros(8)});
const Bytes kWord = join({mb4test::kData4, {0, 0, 0, mb4test::kCrc6}});
const Bytes kErrorWord = {0, 0xBD, 0x37, 0xAF, 0x0A, 0, 0, 0, 0x1E};  // nE = 0; CRC6 by hand
// What a bad word that was told has instead of its CRC: all bits of the right one but the lowest
// are inverted, and so are the bits that the chip makes 0.
constexpr std::uint8_t kMark = mb4test::kCrc6 ^ 0xFE;
const Bytes kMarkedWord = join({mb4test::kData4, {0, 0, 0, kMark}});
const Bytes kBadWord = join({mb4test::kData4, {0, 0, 0, 0x3F}});

Bytes held(std::uint8_t f0, std::uint8_t valid) { return {0, f0, valid, 0, 0, 0x41}; }
const Bytes kNew = held(0xFA, 0x02);
const Bytes kNone = held(0xFA, 0x00);
const Bytes kProven{0, 0xFA, 0, 0, 0, 0x01};
const Bytes kReadForced = join({kReadStatus, {0}});  // up to 0xF5
const Bytes kBad = held(0x6A, 0x00);                 // nSCDERR = 0, nERR = 0

class CyclicTest : public testing::Test {
 protected:
  // Slave 1, and slaves 2.. with the same word if `slaves` is more than 1.
  void start(mb4::SpiCheck check, unsigned slaves = 1) {
    mb4::Config config = mb4test::encoder26();
    config.spi_check = check;
    Bytes image = mb4test::configuration();
    Bytes answer = mb4test::read_back();
    for (Bytes* bytes : {&image, &answer}) {
      if (check != mb4::SpiCheck::kOff) (*bytes)[0xE7 - 0xC0] = 0x00;  // NOCRC = 0 (table 21)
      if (slaves > 1) {
        (*bytes)[4] = (*bytes)[0];
        (*bytes)[5] = (*bytes)[1];
      }
    }
    if (slaves > 1) config.slaves[1] = config.slaves[0];
    mb4test::expect_image(bus, image, answer);
    ASSERT_TRUE(device.configure(config).ok());
    if (check >= mb4::SpiCheck::kFull) {
      mb4test::expect_start_at_full(bus, kClearValid1, answer);
    } else {
      bus.expect_write(kAgs);
    }
    clock.time_us = 1000;
    clock.step_us = 0;
    ASSERT_TRUE(device.automatic().start().ok());
  }

  // The frames of the plan must be `frames`; then the chip answers with `answers`, one for each
  // read of the plan. Returns finish().
  bool step(const std::vector<Bytes>& frames, const std::vector<Bytes>& answers,
            bool transferred = true) {
    return step(read, frames, answers, transferred);
  }
  template <typename Read>
  bool step(Read& one, const std::vector<Bytes>& frames, const std::vector<Bytes>& answers,
            bool transferred = true) {
    EXPECT_EQ(one.frames(), frames.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < one.frames() && i < frames.size(); ++i) {
      EXPECT_EQ(hex(Bytes(one.tx(i).begin(), one.tx(i).end())), hex(frames[i])) << i;
      if (one.rx(i).empty() || next >= answers.size()) continue;
      EXPECT_EQ(one.rx(i).size(), answers[next].size()) << "slip in the test";
      for (std::size_t k = 0; k < answers[next].size(); ++k) one.rx(i)[k] = answers[next][k];
      ++next;
    }
    return device.automatic().finish(one, transferred, now_us);
  }
  void plan() { ASSERT_TRUE(device.automatic().plan_slave(1, read).ok()); }

  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
  mb4::CyclicRead read;
  std::uint32_t now_us = 1000;
  const std::vector<Bytes> kChain{kHold, kReadWord, kReadStatus, kClearValid1AndRelease};
  const std::vector<Bytes> kFree{kAgs, kClearAllValid, kClearAllValid};
  const std::vector<Bytes> kHeld{kHold, kReadWord, kReadStatus};
};

using Chain = CyclicTest;
using Full = CyclicTest;
using Several = CyclicTest;

// 4 transfers, 23 bytes.
TEST_F(Chain, NewFrame_IsOnePlan) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kNew}));
  ASSERT_TRUE(read.result().ok());
  EXPECT_EQ(read.result()->position, mb4test::kPosition);
  EXPECT_TRUE(read.result()->crc_stored);
  EXPECT_EQ(read.result()->crc, mb4test::kCrc6);
  std::size_t bytes = 0;
  for (const Bytes& frame : kChain) bytes += frame.size();
  EXPECT_EQ(bytes, 23U);
}

// The frames of an old plan are not those of a new configuration.
TEST_F(Chain, ConfiguredAnew_PlanIsNew) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kNew}));
  bus.expect_write({0x07, 0x00});
  ASSERT_TRUE(device.automatic().stop().ok());
  start(mb4::SpiCheck::kOff);
  plan();
  EXPECT_TRUE(step({kHold, join({{0x09}, zeros(4)}), kReadStatus, kClearValid1AndRelease},
                   {join({{0}, Bytes(kWord.begin() + 1, kWord.begin() + 5)}), kNew}));
  ASSERT_TRUE(read.result().ok());
  EXPECT_EQ(read.result()->position, mb4test::kPosition);
  EXPECT_FALSE(read.result()->crc_stored);
}

// A Device that was made anew at the same place, with another configuration of the same count.
TEST_F(Chain, DeviceMadeAnew_PlanIsNew) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kNew}));
  device.~Device();
  new (&device) mb4::Device<StrictBus, FakeClock>(bus, clock);
  start(mb4::SpiCheck::kOff);
  plan();
  EXPECT_TRUE(step({kHold, join({{0x09}, zeros(4)}), kReadStatus, kClearValid1AndRelease},
                   {join({{0}, Bytes(kWord.begin() + 1, kWord.begin() + 5)}), kNew}));
  EXPECT_EQ(read.result()->position, mb4test::kPosition);
}

// finish<>() without a part that plan_slave() had: an error, and the next read releases the bank.
TEST_F(Chain, OtherPartsInFinish_IsUnsupported) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_TRUE(device.automatic().finish<0>(read, true, now_us));
  EXPECT_EQ(read.result().error(), Error::kUnsupported);
  plan();
  EXPECT_FALSE(step({kAgs, kClearAllValid}, {}));
  EXPECT_TRUE(step(kChain, {kWord, kNew}));
  EXPECT_TRUE(read.result().ok());
}

TEST_F(Chain, NothingNew_IsNoData) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kNone}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
}

TEST_F(Chain, WrongUse_IsAnErrorWithoutPlan) {
  EXPECT_EQ(device.automatic().plan_slave(1, read).error(), Error::kInvalidArgument);
  start(mb4::SpiCheck::kCrc);
  EXPECT_EQ(device.automatic().plan_slave(2, read).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.automatic().plan_slave(0, read).error(), Error::kInvalidArgument);
  bus.expect_write({0x07, 0x00});
  ASSERT_TRUE(device.automatic().stop().ok());
  EXPECT_EQ(device.automatic().plan_slave(1, read).error(), Error::kWrongMode);
}

// A build without a part does not read what needs it.
TEST_F(Chain, PartLeftOut_IsUnsupported) {
  start(mb4::SpiCheck::kFull);
  EXPECT_EQ(device.automatic().poll_slave<0>(1).error(), Error::kUnsupported);
  EXPECT_EQ(device.automatic().plan_slave<0>(1, read).error(), Error::kUnsupported);
}

// SVALID = 1, but the stored CRC does not fit: SPI has disturbed the bytes.
TEST_F(Chain, DisturbedData_IsCorrupted) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_TRUE(step(kChain, {kBadWord, kNew}));
  EXPECT_EQ(read.result().error(), Error::kCorrupted);
  // A bit above the data of 28 bits.
  plan();
  Bytes high = kWord;
  high[4] |= 0x10;
  EXPECT_TRUE(step(kChain, {high, kNew}));
  EXPECT_EQ(read.result().error(), Error::kCorrupted);
}

// A bad word is marked while the bank is held, so that it counts once. CRC6 0x43 of page 26 is in
// byte 7.
TEST_F(Chain, BadWord_IsHeldAndMarked) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_FALSE(step(kChain, {kBadWord, kBad}));
  EXPECT_FALSE(step(kHeld, {kBadWord, kBad}));
  EXPECT_TRUE(step({{0x02, 0x07, kMark}, kAgs}, {}));
  EXPECT_EQ(read.result().error(), Error::kCrc);
  plan();
  EXPECT_TRUE(step(kChain, {kMarkedWord, kBad}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
  // A good word that was read before.
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kBad}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
}

// One flipped bit of SVALID must not make a good word of a bad one that was told; nor one more
// flipped bit of the mark, on its way to the chip or back.
TEST_F(Chain, MarkedWordAndFlippedBits_IsNeverGood) {
  start(mb4::SpiCheck::kCrc);
  const Bytes valid = held(0x6A, 0x02);
  for (unsigned bit = 0; bit < 9; ++bit) {
    Bytes word = kMarkedWord;
    word[8] = static_cast<std::uint8_t>(word[8] ^ (bit < 8 ? 1U << bit : 0U));
    plan();
    EXPECT_TRUE(step(kChain, {word, valid}));
    EXPECT_EQ(read.result().error(), Error::kCorrupted) << bit;
  }
}

// With a CRC that fills its byte, and any start value: the mark is neither the CRC that fits nor
// 0xFF, the CRC of a word that is all 0 on the line, even with one more flipped bit of it.
TEST(Mark, EachStartValue_IsNoWordThatTheChipStores) {
  for (const std::uint32_t polynomial : {0x12FU, 0x190D9U}) {
    const unsigned starts = polynomial > 0x1FF ? 0x10000 : 0x100;
    for (unsigned start = 0; start < starts; ++start) {
      mb4_slave_config config{};
      config.data_bits = 28;
      config.crc_polynomial = polynomial;
      config.crc_start = static_cast<std::uint16_t>(start);
      mb4_word word{};
      mb4_word_set(&word, 1, &config, MB4_SPI_CHECK_CRC);
      mb4_slot blank{};
      blank.high = polynomial > 0x1FF ? 0xFFFF0000U : 0xFF000000U;
      if (mb4_slot_good(&word, &blank, MB4_WITH_ALL)) continue;  // here it is a position
      const unsigned mark = mb4_slot_mark(&word, &blank);
      const unsigned fits = (blank.crc >> (polynomial > 0x1FF ? 8U : 0U)) & 0xFFU;
      const unsigned off = mark ^ fits;
      ASSERT_NE(mark, 0xFFU) << start;
      ASSERT_NE(off & (off - 1), 0U) << start;  // two bits or more
    }
  }
}

// BiSS C, all data bits 0 and the CRC's bits 0 on the line, so that the chip stores 0x3F (page 26):
// the slave has sent nothing if its line is at 1 again. In its timeout it is not: one look more.
TEST_F(Chain, AllZero_IsNoWord) {
  const Bytes blank = join({zeros(8), {0x3F}});
  const std::vector<Bytes> look{join({{0x05}, zeros(9)})};
  const auto lines = [](std::uint8_t f8) { return std::vector<Bytes>{join({zeros(9), {f8}})}; };
  start(mb4::SpiCheck::kCrc);
  mb4_counts counts{};
  device.automatic().count(&counts);
  const auto mark = [&] {
    plan();
    EXPECT_FALSE(step(kChain, {blank, kBad}));
    EXPECT_FALSE(step(kHeld, {blank, kBad}));
    EXPECT_FALSE(step({{0x02, 0x07, 0xFE}, kAgs}, {}));
  };
  mark();
  EXPECT_TRUE(step(look, lines(0x01)));
  EXPECT_EQ(read.result().error(), Error::kNoWord);
  // The same word is told once.
  plan();
  EXPECT_TRUE(step(kChain, {join({zeros(8), {0xFE}}), kBad}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
  mark();
  EXPECT_FALSE(step(look, lines(0x00)));
  EXPECT_TRUE(step(look, lines(0x01)));
  EXPECT_EQ(read.result().error(), Error::kNoWord);
  mark();
  EXPECT_FALSE(step(look, lines(0x00)));
  EXPECT_TRUE(step(look, lines(0x04)));  // of the other line
  EXPECT_EQ(read.result().error(), Error::kCrc);
  mark();
  EXPECT_TRUE(step(look, {}, false));
  EXPECT_EQ(read.result().error(), Error::kCrc);
  // A bit of the data, or of the CRC, is 1.
  for (const std::size_t byte : {1U, 4U, 8U}) {
    Bytes word = blank;
    word[byte] ^= 0x02;
    plan();
    EXPECT_FALSE(step(kChain, {word, kBad}));
    EXPECT_FALSE(step(kHeld, {word, kBad}));
    EXPECT_TRUE(device.automatic().finish(read, true, now_us)) << byte;
    EXPECT_EQ(read.result().error(), Error::kCrc) << byte;
  }
  EXPECT_EQ(counts.no_word, 2U);
  EXPECT_EQ(counts.crc, 5U);
  EXPECT_EQ(counts.good, 0U);
}

// Without a stored CRC the chip's word that the CRC is wrong counts. Each read tells it.
TEST_F(Chain, AllZeroWithoutCrc_IsNoWord) {
  const Bytes read_word = mb4test::kReadData4;
  const std::vector<Bytes> look{join({{0x05}, zeros(9)})};
  const auto lines = [](std::uint8_t f8) { return std::vector<Bytes>{join({zeros(9), {f8}})}; };
  start(mb4::SpiCheck::kOff);
  for (int i = 0; i < 2; ++i) {
    plan();
    EXPECT_FALSE(step({kHold, read_word, kReadStatus, kClearValid1AndRelease}, {zeros(5), kBad}));
    EXPECT_TRUE(step(look, lines(0x01)));
    EXPECT_EQ(read.result().error(), Error::kNoWord);
  }
  // Position 0 that was read before: the last frame was good.
  plan();
  EXPECT_TRUE(step({kHold, read_word, kReadStatus, kClearValid1AndRelease}, {zeros(5), kNone}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
  // No more frames end: the alarm says the same, and does not look at SL again, which may be 0 then
  // because a frame runs.
  now_us += 16 * mb4::frame_timeout_us(device.config()) + 34;
  plan();
  EXPECT_FALSE(step({kHold, read_word, kReadStatus, kClearValid1AndRelease}, {zeros(5), kBad}));
  EXPECT_TRUE(step(look, lines(0x01)));
  EXPECT_EQ(read.result().error(), Error::kNoWord);
}

// By table, four bits a step; the longest CRC is checked in crc_test.cpp. A build without the part
// does not pass over it.
TEST_F(Chain, Table_GivesTheSameAndNeedsItsPart) {
  std::array<std::uint32_t, 16> table{};
  EXPECT_EQ(device.automatic().crc_table(1, table).error(), Error::kNotConfigured);
  start(mb4::SpiCheck::kCrc);
  EXPECT_EQ(device.automatic().crc_table(0, table).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.automatic().crc_table(2, table).error(), Error::kInvalidArgument);
  ASSERT_TRUE(device.automatic().crc_table(1, table).ok());
  EXPECT_EQ(table[1], 0x43U << 26);  // the polynomial, left aligned, without its highest bit
  for (const bool good : {true, false}) {
    plan();
    EXPECT_TRUE(step(kChain, {good ? kWord : kBadWord, kNew}));
    EXPECT_EQ(read.error(), good ? Error::kNone : Error::kCorrupted);
  }
  EXPECT_EQ(device.automatic<MB4_WITH_ALL & ~MB4_WITH_TABLE>().plan_slave(1, read).error(),
            Error::kUnsupported);
}

// The parts are chosen with the object; the object that plans also finishes.
TEST_F(Chain, PartsOfTheObject_AreThoseOfItsCalls) {
  start(mb4::SpiCheck::kCrc);
  auto reads = device.automatic<0>();
  ASSERT_TRUE(reads.plan_slave(1, read).ok());
  for (std::size_t k = 0; k < kWord.size(); ++k) read.rx(1)[k] = kWord[k];
  for (std::size_t k = 0; k < kNew.size(); ++k) read.rx(2)[k] = kNew[k];
  EXPECT_TRUE(reads.finish(read, true, now_us));
  EXPECT_EQ(read.position(), mb4test::kPosition);
  mb4::Operation op;
  ASSERT_TRUE(reads.plan_stop(op).ok());
  EXPECT_TRUE(reads.finish(op, true, now_us));
  EXPECT_TRUE(op.result().ok());
  ASSERT_TRUE(device.control().plan_command(op, {}).ok());
  EXPECT_TRUE(device.control().finish(op, false, now_us));
  EXPECT_EQ(op.result().error(), Error::kTransport);
}

// While count() is in force, a read that cannot count is refused; after configure() too.
TEST_F(Chain, CountsWithoutTheirPart_IsUnsupported) {
  mb4_counts counts{};
  start(mb4::SpiCheck::kCrc);
  device.automatic().count(&counts);
  EXPECT_EQ(device.automatic().poll_slave<0>(1).error(), Error::kUnsupported);
  EXPECT_EQ(device.automatic<0>().poll_slave(1).error(), Error::kUnsupported);
  bus.expect_write({0x07, 0x00});
  ASSERT_TRUE(device.automatic().stop().ok());
  start(mb4::SpiCheck::kCrc);
  EXPECT_EQ(device.automatic<0>().plan_slave(1, read).error(), Error::kUnsupported);
  device.automatic().count(nullptr);
  EXPECT_TRUE(device.automatic<0>().plan_slave(1, read).ok());
}

// A bus that reports success and has not stored all bytes of a transfer of the chain: never the old
// word again. kBytes: how many are stored.
TEST_F(Chain, StoresTooLittle_OldWordIsNotNew) {
  for (std::size_t frame = 1; frame <= 2; ++frame) {
    const Bytes& whole = frame == 1 ? kWord : kNew;
    for (std::size_t stored = 0; stored < whole.size(); ++stored) {
      start(mb4::SpiCheck::kCrc);
      plan();
      EXPECT_TRUE(step(kChain, {kWord, kNew}));
      EXPECT_TRUE(read.result().ok());
      for (int again = 0; again < 3; ++again) {
        plan();
        for (const std::size_t i : {1U, 2U}) {
          const Bytes& answer = i == 1 ? kWord : kNew;
          for (std::size_t k = 0; k < (i == frame ? stored : answer.size()); ++k) {
            read.rx(i)[k] = answer[k];
          }
        }
        while (!device.automatic().finish(read, true, now_us)) {
        }
        EXPECT_EQ(read.result().error(), Error::kCorrupted) << frame << ", " << stored;
      }
      bus.expect_write({0x07, 0x00});
      ASSERT_TRUE(device.automatic().stop().ok());
    }
  }
}

// Between the two plans the bank switches to a good word; or to one that was read before.
TEST_F(Chain, BadWordGone_NewOneCounts) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_FALSE(step(kChain, {kBadWord, kBad}));
  EXPECT_FALSE(step(kHeld, {kWord, kNew}));
  EXPECT_TRUE(step({kClearValid1AndRelease}, {}));
  EXPECT_TRUE(read.result().ok());
  plan();
  EXPECT_FALSE(step(kChain, {kBadWord, kBad}));
  EXPECT_FALSE(step(kHeld, {kWord, kBad}));
  EXPECT_TRUE(step({kAgs}, {}));
  EXPECT_EQ(read.result().error(), Error::kCrc);
}

// HOLDBANK must not stay 1 after a fault.
TEST_F(Chain, Faults_ReleaseTheBank) {
  start(mb4::SpiCheck::kCrc);
  const auto ends_with = [this](Error error) {
    EXPECT_TRUE(step({kAgs}, {}));
    EXPECT_EQ(read.result().error(), error);
  };
  plan();
  EXPECT_FALSE(step(kChain, {}, false));
  ends_with(Error::kTransport);
  plan();
  EXPECT_FALSE(step(kChain, {kWord, zeros(6)}));
  ends_with(Error::kNotDetected);
  plan();
  EXPECT_FALSE(step(kChain, {kWord, Bytes(6, 0xFF)}));
  ends_with(Error::kNotDetected);
  plan();
  EXPECT_FALSE(step(kChain, {kWord, {0, 0xFA, 0x02, 0, 0, 0x01}}));  // HOLDBANK = 0
  ends_with(Error::kCorrupted);
  // The release fails too.
  plan();
  EXPECT_FALSE(step(kChain, {}, false));
  EXPECT_TRUE(step({kAgs}, {}, false));
  EXPECT_EQ(read.result().error(), Error::kTransport);
  // Then the next read releases the bank, tries it again if need be, and drops what waited.
  plan();
  EXPECT_TRUE(step({kAgs, kClearAllValid}, {}, false));
  EXPECT_EQ(read.result().error(), Error::kTransport);
  plan();
  EXPECT_FALSE(step({kAgs, kClearAllValid}, {}));
  EXPECT_TRUE(step(kChain, {kWord, kNone}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
  // The marking fails.
  plan();
  EXPECT_FALSE(step(kChain, {kBadWord, kBad}));
  EXPECT_FALSE(step(kHeld, {kBadWord, kBad}));
  EXPECT_FALSE(step({{0x02, 0x07, kMark}, kAgs}, {}, false));
  ends_with(Error::kTransport);
}

// AGS may have ended by an error.
TEST_F(Chain, AgsOff_IsNoFaultOfSpi) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_TRUE(step(kChain, {kWord, {0, 0xFA, 0x02, 0, 0, 0x40}}));
  EXPECT_TRUE(read.result().ok());
}

// No frame for 16 periods; with a frame that was left out (nAGSERR = 0) for two. The timeout of
// this configuration is 218 us, and frames follow back to back.
TEST_F(Chain, FramesStayAway_IsAnAlarm) {
  start(mb4::SpiCheck::kCrc);
  const std::uint32_t pitch_us = mb4::frame_timeout_us(device.config());
  const Bytes omitted = held(0x3A, 0x00);
  const std::vector<Bytes> look{join({{0x05}, zeros(12)}), kReadStatus};
  const auto lines = [](std::uint8_t f8) {
    return std::vector<Bytes>{join({zeros(9), {f8}, zeros(3)}), {0, 0xFA, 0x00, 0, 0, 0x40}};
  };
  plan();
  now_us = 1000 + 2 * pitch_us + 33;
  EXPECT_TRUE(step(kChain, {kWord, omitted}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
  plan();
  ++now_us;
  EXPECT_FALSE(step(kChain, {kWord, omitted}));
  EXPECT_TRUE(step(look, lines(0x01)));  // SL1 = 1
  EXPECT_EQ(read.result().error(), Error::kTimeout);
  plan();
  EXPECT_FALSE(step(kChain, {kWord, omitted}));
  EXPECT_TRUE(step(look, lines(0x00)));
  EXPECT_EQ(read.result().error(), Error::kLineError);
  plan();
  EXPECT_FALSE(step(kChain, {kWord, omitted}));
  EXPECT_TRUE(step(look, {}, false));
  EXPECT_EQ(read.result().error(), Error::kTransport);
  // Without the flag.
  now_us = 1000 + 16 * pitch_us + 33;
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kNone}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
  ++now_us;
  plan();
  EXPECT_FALSE(step(kChain, {kWord, kNone}));
  EXPECT_TRUE(step(look, lines(0x01)));
  EXPECT_EQ(read.result().error(), Error::kTimeout);
  // A good frame ends it.
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kNew}));
  plan();
  EXPECT_TRUE(step(kChain, {kWord, kNone}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
}

// Frames end while the loop holds the bank, each time: SWBANKFAIL = 1, or one ends directly after
// the release. The former is an alarm after 64 periods.
TEST_F(Chain, FramesEndWhileTheBankIsHeld_IsNoAlarmForAWhile) {
  start(mb4::SpiCheck::kCrc);
  const std::uint32_t limit_us = 16 * mb4::frame_timeout_us(device.config()) + 33;
  const std::vector<Bytes> look{join({{0x05}, zeros(12)}), kReadStatus};
  const Bytes idle{0, 0xFA, 0x00, 0, 0, 0x40};
  // 0xF8: SL1 is 0, because a frame runs.
  const auto banks = [](std::uint8_t f0, std::uint8_t fb) {
    return Bytes{0, f0, 0, 0, 0, 0x40, 0, 0, 0, 0x00, 0, 0, fb};
  };
  const auto ends_with = [&](const Bytes& first, const Bytes& second, Error error) {
    plan();
    EXPECT_FALSE(step(kChain, {kWord, kNone}));
    EXPECT_TRUE(step(look, {first, second}));
    EXPECT_EQ(read.result().error(), error);
  };
  now_us = 1000 + limit_us + 1;
  ends_with(banks(0xFA, 1), idle, Error::kNoData);
  ends_with(banks(0xFA, 0), {0, 0xFA, 0x02, 0, 0, 0x40}, Error::kNoData);
  ends_with(banks(0xFA, 0), {0, 0xFA, 0x08, 0, 0, 0x40}, Error::kLineError);  // of another slave
  ends_with(banks(0x3A, 1), idle, Error::kLineError);                         // nAGSERR = 0
  ends_with(banks(0xFA, 0), Bytes(6, 0xFF), Error::kLineError);
  now_us = 1000 + 4 * limit_us;
  ends_with(banks(0xFA, 1), idle, Error::kNoData);
  ++now_us;
  ends_with(banks(0xFA, 1), idle, Error::kLineError);
}

// A build may leave the look at SWBANKFAIL out.
TEST_F(Chain, AlarmWithoutBeats_LooksAtTheLinesAlone) {
  start(mb4::SpiCheck::kCrc);
  clock.time_us = 1000 + 16 * mb4::frame_timeout_us(device.config()) + 33 + 1;
  bus.expect_write(kHold);
  bus.expect_read(kReadWord, kWord);
  bus.expect_read(kReadStatus, kNone);
  bus.expect_write(kAgs);
  bus.expect_read(join({{0x05}, zeros(9)}), join({zeros(9), {0x01}}));
  EXPECT_EQ(device.automatic().poll_slave<0>(1).error(), Error::kTimeout);
}

// A new word is a new sample, whatever the clock says.
TEST_F(Chain, TwoNewWordsAtOneTime_AreTwoSamples) {
  start(mb4::SpiCheck::kCrc);
  mb4_counts counts{};
  device.automatic().count(&counts);
  counts.period_ns = 100'000;
  for (int i = 0; i < 2; ++i) {
    bus.expect_write(kHold);
    bus.expect_read(kReadWord, kWord);
    bus.expect_read(kReadStatus, kNew);
    bus.expect_write(kClearValid1AndRelease);
    EXPECT_TRUE(device.automatic().poll_slave(1).ok());
  }
  EXPECT_EQ(counts.sequence, 2U);
  EXPECT_EQ(counts.lost, 0U);
}

// A build without counts in its Device, and one that ends them.
TEST_F(Chain, CountsNotGiven_ReadsAreTheSame) {
  start(mb4::SpiCheck::kCrc);
  mb4_counts counts{};
  for (mb4_counts* given : {&counts, static_cast<mb4_counts*>(nullptr)}) {
    device.automatic().count(given);
    bus.expect_write(kHold);
    bus.expect_read(kReadWord, kWord);
    bus.expect_read(kReadStatus, kNew);
    bus.expect_write(kClearValid1AndRelease);
    EXPECT_EQ(device.automatic().poll_slave(1)->position, mb4test::kPosition);
    EXPECT_EQ(counts.good, 1U);
  }
}

// Without a period only what the reads have met is counted, and no read is late.
TEST_F(Chain, WithoutPeriod_NothingIsLostOrLate) {
  start(mb4::SpiCheck::kOff);
  mb4_counts counts{};
  device.automatic().count(&counts);
  EXPECT_EQ(counts.period_ns, 0U);
  for (const bool good : {true, true, false, true}) {
    bus.expect_write(kHold);
    bus.expect_read(mb4test::kReadData4, mb4test::kData4);
    bus.expect_read(kReadStatus, good ? kNew : kBad);
    bus.expect_write(good ? kClearValid1AndRelease : kAgs);
    EXPECT_EQ(device.automatic().poll_slave(1).error(), good ? Error::kNone : Error::kCrc);
    clock.time_us += 100;
  }
  EXPECT_EQ(counts.good, 3U);
  EXPECT_EQ(counts.crc, 1U);
  EXPECT_EQ(counts.sequence, 3U);
  EXPECT_EQ(counts.lost, 0U);
  EXPECT_EQ(counts.late, 0U);
}

// A word whose nE is 0 is a new one: it ends the wait for frames, and neither it nor the sample is
// lost, bad or a fault. The frames of the reads are those of good words.
TEST_F(Chain, SlaveError_IsANewWordAndHasItsOwnCount) {
  constexpr std::uint8_t kCounted = MB4_WITH_ALL | MB4_WITH_COUNTS;
  start(mb4::SpiCheck::kCrc);
  mb4_counts counts{};
  device.automatic().count(&counts);
  counts.period_ns = 100'000;
  clock.time_us = 0xFFFF'FFFF - 100;
  // Four reads of 0, 1 (nE = 0), nothing new, 3 (nE = 0), then 16 periods with nE = 0 alone.
  const auto poll = [&](const Bytes& word, const Bytes& answer, const Bytes& end) {
    bus.expect_write(kHold);
    bus.expect_read(kReadWord, word);
    bus.expect_read(kReadStatus, answer);
    bus.expect_write(end);
    const auto reading = device.automatic().poll_slave<kCounted>(1);
    clock.time_us += 100;
    return reading;
  };
  EXPECT_TRUE(poll(kWord, kNew, kClearValid1AndRelease).ok());
  const auto first = poll(kErrorWord, kNew, kClearValid1AndRelease);
  EXPECT_EQ(first.error(), Error::kSlaveError);
  EXPECT_EQ(first.reading().position, mb4test::kPosition);
  EXPECT_TRUE(first.reading().slave_error);
  EXPECT_FALSE(first.reading().slave_warning);
  EXPECT_EQ(poll(kErrorWord, kNone, kAgs).error(), Error::kNoData);
  EXPECT_EQ(counts.sequence, 2U);
  EXPECT_EQ(poll(kErrorWord, kNew, kClearValid1AndRelease).error(), Error::kSlaveError);
  EXPECT_EQ(counts.good, 1U);
  EXPECT_EQ(counts.slave_errors, 2U);
  EXPECT_EQ(counts.sequence, 4U);
  EXPECT_EQ(counts.lost, 1U);
  const std::uint32_t pitch_us = mb4::frame_timeout_us(device.config());
  for (unsigned n = 0; n < 40; ++n) {
    clock.time_us += pitch_us;
    EXPECT_EQ(poll(kErrorWord, kNew, kClearValid1AndRelease).error(), Error::kSlaveError);
    EXPECT_EQ(poll(kErrorWord, kNone, kAgs).error(), Error::kNoData);
  }
  EXPECT_TRUE(poll(kWord, kNew, kClearValid1AndRelease).ok());
  EXPECT_EQ(counts.good, 2U);
  EXPECT_EQ(counts.slave_errors, 42U);
  EXPECT_EQ(counts.sequence, counts.good + counts.slave_errors + counts.lost);
  EXPECT_EQ(counts.crc, 0U);
  EXPECT_EQ(counts.faults, 0U);
}

// One in Gray code: the chip has converted nE with the position.
TEST(SlaveError, EachFlag_IsToldWithAndWithoutGray) {
  for (const bool gray : {false, true}) {
    for (std::uint32_t sent = 0; sent < 32; ++sent) {
      mb4_slave_config config{};
      config.data_bits = 5;
      config.flags = MB4_FLAGS_ERROR_WARNING;
      config.gray = gray;
      mb4_word word{};
      mb4_word_set(&word, 1, &config, MB4_SPI_CHECK_OFF);
      mb4_slot slot{};
      slot.low = sent;
      for (unsigned shift = 1; gray && shift < 5; ++shift) slot.low ^= sent >> shift;
      EXPECT_EQ(mb4_slot_tell(&word, &slot, MB4_WITH_ALL) == MB4_SLAVE_ERROR, (sent & 2U) == 0)
          << gray << ' ' << sent;
      mb4_reading reading{};
      mb4_slot_reading(&word, &slot, &reading, MB4_WITH_ALL);
      EXPECT_EQ(reading.slave_error, (sent & 2U) == 0);
      EXPECT_EQ(reading.slave_warning, (sent & 1U) == 0);
    }
  }
  mb4_slave_config config{};
  config.data_bits = 5;
  config.flags = MB4_FLAGS_NONE;
  mb4_word word{};
  mb4_word_set(&word, 1, &config, MB4_SPI_CHECK_OFF);
  mb4_slot slot{};
  EXPECT_EQ(mb4_slot_tell(&word, &slot, MB4_WITH_ALL), MB4_OK);
  slot.code = MB4_CRC;
  word.flags = true;
  EXPECT_EQ(mb4_slot_tell(&word, &slot, MB4_WITH_ALL), MB4_CRC);
}

// 5 s, more than 2^32 ns, are 50,000 periods of 100 us: 49,999 samples were not read.
TEST_F(Chain, LongPause_IsCountedWhole) {
  start(mb4::SpiCheck::kCrc);
  mb4_counts counts{};
  device.automatic().count(&counts);
  counts.period_ns = 100'000;
  for (int i = 0; i < 2; ++i) {
    bus.expect_write(kHold);
    bus.expect_read(kReadWord, kWord);
    bus.expect_read(kReadStatus, kNew);
    bus.expect_write(kClearValid1AndRelease);
    EXPECT_TRUE(device.automatic().poll_slave(1).ok());
    clock.time_us += 5'000'000;
  }
  EXPECT_EQ(counts.sequence, 50'001U);
  EXPECT_EQ(counts.lost, 49'999U);
  EXPECT_EQ(counts.late, 1U);
}

// With FrameStart::kOnPin only the caller knows when a frame should come.
TEST_F(Chain, FramesOnPinStayAway_IsNoAlarm) {
  mb4::Config config = mb4test::encoder26();
  config.frame_start = mb4::FrameStart::kOnPin;
  mb4test::expect_configure(bus, 0xE8, 0x7D);
  ASSERT_TRUE(device.configure(config).ok());
  bus.expect_write(kAgs);
  ASSERT_TRUE(device.automatic().start().ok());
  now_us = 1'000'000'000;
  plan();
  EXPECT_TRUE(step({kHold, mb4test::kReadData4, kReadStatus, kClearValid1AndRelease},
                   {mb4test::kData4, kNone}));
  EXPECT_EQ(read.result().error(), Error::kNoData);
}

// ---- Parts left out -----------------------------------------------------------------------------

// What a build leaves out changes nothing for a slave that does not need it.
TEST_F(Chain, WithoutParts_ReadsAreTheSame) {
  for (const mb4::SpiCheck check : {mb4::SpiCheck::kCrc, mb4::SpiCheck::kOff}) {
    start(check);
    const bool crc = check == mb4::SpiCheck::kCrc;
    const Bytes read_word = crc ? kReadWord : mb4test::kReadData4;
    const Bytes word = crc ? kWord : mb4test::kData4;
    const std::vector<Bytes> chain{kHold, read_word, kReadStatus, kClearValid1AndRelease};
    const auto finish = [&](const std::vector<Bytes>& frames, const std::vector<Bytes>& answers) {
      ASSERT_EQ(read.frames(), frames.size());
      std::size_t next = 0;
      for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(hex(Bytes(read.tx(i).begin(), read.tx(i).end())), hex(frames[i])) << i;
        for (std::size_t k = 0; k < read.rx(i).size(); ++k) read.rx(i)[k] = answers[next][k];
        next += read.rx(i).empty() ? 0 : 1;
      }
    };
    const auto plan = [&] { ASSERT_TRUE(device.automatic().plan_slave<0>(1, read).ok()); };
    const auto ended = [&] { return device.automatic().finish<0>(read, true, now_us); };
    plan();
    finish(chain, {word, kNew});
    EXPECT_TRUE(ended());
    ASSERT_TRUE(read.result().ok());
    EXPECT_EQ(read.result()->position, mb4test::kPosition);
    EXPECT_EQ(read.result()->raw, mb4test::kRaw);
    EXPECT_EQ(read.result()->crc_stored, crc);
    plan();
    finish(chain, {word, kNone});
    EXPECT_TRUE(ended());
    EXPECT_EQ(read.result().error(), Error::kNoData);
    plan();
    if (crc) {
      finish(chain, {kBadWord, kBad});
      EXPECT_FALSE(ended());
      finish({kHold, read_word, kReadStatus}, {kBadWord, kBad});
      EXPECT_FALSE(ended());
      finish({{0x02, 0x07, kMark}, kAgs}, {});
    } else {
      finish(chain, {word, kBad});
    }
    EXPECT_TRUE(ended());
    EXPECT_EQ(read.result().error(), Error::kCrc);
    // The release of the bank fails; the next read begins with it.
    plan();
    EXPECT_FALSE(device.automatic().finish<0>(read, false, now_us));
    EXPECT_TRUE(device.automatic().finish<0>(read, false, now_us));
    EXPECT_EQ(read.result().error(), Error::kTransport);
    plan();
    finish({kAgs, kClearAllValid}, {});
    EXPECT_FALSE(ended());
    finish(chain, {word, kNew});
    EXPECT_TRUE(ended());
    EXPECT_TRUE(read.result().ok());
    bus.expect_write({0x07, 0x00});
    ASSERT_TRUE(device.automatic().stop().ok());
  }
}

TEST_F(Full, OnlyThisPart_ReadsAreTheSame) {
  start(mb4::SpiCheck::kFull);
  const Bytes read_word = join({{0x09}, Bytes(8, mb4test::kFiller)});
  bus.expect_write(kHold);
  bus.expect_read(kReadStatus, kNew);
  bus.expect_read(read_word, kWord);
  bus.expect_read(kReadStatus, kNew);
  bus.expect_write(kClearValid1);
  bus.expect_read(kReadStatus, kNone);
  bus.expect_write(kAgs);
  EXPECT_EQ(device.automatic().poll_slave<MB4_WITH_FULL>(1)->position, mb4test::kPosition);
}

// The loop meets the end of each frame: SWBANKFAIL = 1 is no alarm, also for one slave alone.
TEST_F(Chain, OnlyBeats_NoAlarmForAWhile) {
  start(mb4::SpiCheck::kCrc);
  clock.time_us = 1000 + 16 * mb4::frame_timeout_us(device.config()) + 33 + 1;
  bus.expect_write(kHold);
  bus.expect_read(kReadWord, kWord);
  bus.expect_read(kReadStatus, kNone);
  bus.expect_write(kAgs);
  bus.expect_read(join({{0x05}, zeros(12)}), {0, 0xFA, 0, 0, 0, 0x40, 0, 0, 0, 0x00, 0, 0, 1});
  bus.expect_read(kReadStatus, {0, 0xFA, 0x00, 0, 0, 0x40});
  EXPECT_EQ(device.automatic().poll_slave<MB4_WITH_BEATS>(1).error(), Error::kNoData);
}

// With a stored CRC a second reading is for words of equal bits only, in all of their bits.
TEST(SecondReading, LongWord_IsNeededWhenAllBitsAreEqual) {
  const mb4_slave_config config{true, 40, MB4_FLAGS_NONE, 0, 0x43, false, false, false};
  mb4_word word{};
  mb4_word_set(&word, 1, &config, MB4_SPI_CHECK_FULL);
  const struct {
    std::uint32_t low, high;
    bool needed;
  } cases[] = {{0, 0, true},           {0xFFFFFFFF, 0xFF, true}, {0xFFFFFFFF, 0x7F, false},
               {0xFFFFFFFF, 0, false}, {0, 0xFF, false},         {0x7FFFFFFF, 0xFF, false}};
  for (const auto& one : cases) {
    mb4_slot slot{};
    slot.low = one.low;
    slot.high = 0x12000000 | one.high;  // with the CRC in the top byte
    EXPECT_EQ(mb4_slot_needs_second(&word, &slot, MB4_WITH_ALL), one.needed) << one.high;
  }
}

// Without a stored CRC nothing tells a bad word from an old one, except that there is no other.
TEST_F(Chain, BadFrameUnchecked_IsCrcUntilAGoodOneComes) {
  start(mb4::SpiCheck::kOff);
  const std::vector<Bytes> chain{kHold, mb4test::kReadData4, kReadStatus, kClearValid1AndRelease};
  for (int i = 0; i < 2; ++i) {
    plan();
    EXPECT_TRUE(step(chain, {mb4test::kData4, kBad}));
    EXPECT_EQ(read.result().error(), Error::kCrc);
  }
  plan();
  EXPECT_TRUE(step(chain, {mb4test::kData4, kNew}));
  EXPECT_TRUE(read.result().ok());
  EXPECT_FALSE(read.result()->crc_stored);
}

// Given up half way: the bank is released.
TEST_F(Chain, GivenUp_EndsWithTransport) {
  start(mb4::SpiCheck::kCrc);
  plan();
  EXPECT_FALSE(device.automatic().finish(read, false, now_us));
  EXPECT_TRUE(device.automatic().finish(read, false, now_us));
  EXPECT_EQ(read.result().error(), Error::kTransport);
}

// Two slaves of one frame in four transfers, 31 bytes; 17 of them bring both words.
const Bytes kReadBoth = join({{0x09}, zeros(16)});
const Bytes kClearBoth{0x02, 0xF1, 0xF5, 0xFF, 0xFF, 0x01};

Bytes both(const Bytes& first, const Bytes& second) {
  return join({Bytes(first.begin(), first.end()), Bytes(second.begin() + 1, second.end())});
}

TEST_F(Several, NewFrame_IsOnePlan) {
  start(mb4::SpiCheck::kCrc, 2);
  mb4::FrameRead all;
  mb4::Frame frame;
  const std::vector<Bytes> chain{kHold, kReadBoth, kReadStatus, kClearBoth};
  for (int i = 0; i < 2; ++i) {  // the second read finds its frames in the plan
    ASSERT_TRUE(device.automatic().plan(all).ok());
    EXPECT_TRUE(step(all, chain, {both(kWord, kWord), held(0xFA, 0x0A)}));
    ASSERT_TRUE(all.result(frame).ok());
    EXPECT_EQ(frame[1]->position, mb4test::kPosition);
    EXPECT_EQ(frame[2]->position, mb4test::kPosition);
    EXPECT_EQ(frame[2]->slave, 2);
    EXPECT_TRUE(all.one_frame());
  }
  // nE = 0 in one, then in both: each word is told as it is.
  const Bytes answer = held(0xFA, 0x0A);
  ASSERT_TRUE(device.automatic().plan(all).ok());
  EXPECT_TRUE(step(all, chain, {both(kErrorWord, kWord), answer}));
  ASSERT_TRUE(all.result(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kSlaveError);
  EXPECT_EQ(frame[1].reading().position, mb4test::kPosition);
  EXPECT_TRUE(frame[2].ok());
  EXPECT_FALSE(frame.good(3));
  EXPECT_TRUE(frame.complete(3));
  EXPECT_TRUE(all.one_frame());
  ASSERT_TRUE(device.automatic().plan(all).ok());
  EXPECT_TRUE(step(all, chain, {both(kErrorWord, kErrorWord), answer}));
  ASSERT_TRUE(all.result(frame).ok());
  EXPECT_EQ(frame[2].error(), Error::kSlaveError);
  // Only one is new.
  ASSERT_TRUE(device.automatic().plan(all).ok());
  EXPECT_TRUE(step(all, chain, {both(kWord, kWord), held(0xFA, 0x08)}));
  ASSERT_TRUE(all.result(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kNoData);
  EXPECT_TRUE(frame[2].ok());
  // One contradicts its CRC.
  ASSERT_TRUE(device.automatic().plan(all).ok());
  EXPECT_TRUE(step(all, chain, {both(kWord, kBadWord), held(0xFA, 0x0A)}));
  ASSERT_TRUE(all.result(frame).ok());
  EXPECT_TRUE(frame[1].ok());
  EXPECT_EQ(frame[2].error(), Error::kCorrupted);
}

// The second try concerns the bad word only: it neither reads nor clears what slave 1 has brought.
TEST_F(Several, OneWordBad_TheOtherIsKept) {
  start(mb4::SpiCheck::kCrc, 2);
  mb4::FrameRead all;
  mb4::Frame frame;
  const std::vector<Bytes> chain{kHold, kReadBoth, kReadStatus, kClearBoth};
  const std::vector<Bytes> again{kHold, join({{0x03, 0x08}, zeros(8)}), kReadStatus};
  const Bytes bad = join({{0}, Bytes(kBadWord.begin(), kBadWord.end())});
  const Bytes good = join({{0}, Bytes(kWord.begin(), kWord.end())});
  for (const bool follows : {false, true}) {
    ASSERT_TRUE(device.automatic().plan(all).ok());
    EXPECT_FALSE(step(all, chain, {both(kWord, kBadWord), held(0x6A, 0x02)}));
    if (follows) {  // a good word of the next frame
      EXPECT_FALSE(step(all, again, {good, held(0xFA, 0x0A)}));
      EXPECT_TRUE(step(all, {{0x02, 0xF1, 0xF7, 0xFF, 0xFF, 0x01}}, {}));
    } else {
      EXPECT_FALSE(step(all, again, {bad, held(0x6A, 0x00)}));
      EXPECT_TRUE(step(all, {{0x02, 0x0F, kMark}, kAgs}, {}));
    }
    ASSERT_TRUE(all.result(frame).ok());
    EXPECT_TRUE(frame[1].ok());
    EXPECT_EQ(frame[2].error(), follows ? Error::kNone : Error::kCrc);
    EXPECT_EQ(all.one_frame(), !follows);
  }
}

// Slave 2 has no CRC, so a bad frame may be its own: told when its last good word is too old. The
// stored CRC of slave 1 says that its word was good.
TEST_F(Several, BadFrameOfOneWithoutCrc_OtherOneIsNotBlamed) {
  mb4::Config config = mb4test::encoder26();
  config.spi_check = mb4::SpiCheck::kCrc;
  config.slaves[1] = config.slaves[0];
  config.slaves[1].crc_polynomial = 0;
  Bytes image = mb4test::configuration();
  Bytes answer = mb4test::read_back();
  for (Bytes* bytes : {&image, &answer}) {
    (*bytes)[0xE7 - 0xC0] = 0x00;  // NOCRC = 0 (table 21)
    (*bytes)[4] = 0x5B;            // slave 2 as slave 1, without CRC
  }
  mb4test::expect_image(bus, image, answer);
  ASSERT_TRUE(device.configure(config).ok());
  bus.expect_write(kAgs);
  clock.time_us = 1000;
  clock.step_us = 0;
  ASSERT_TRUE(device.automatic().start().ok());
  mb4::FrameRead all;
  mb4::Frame frame;
  const std::vector<Bytes> chain{kHold, join({{0x09}, zeros(12)}), kReadStatus, kClearBoth};
  const Bytes words = both(kWord, mb4test::kData4);
  const auto read_all = [&](std::uint32_t time_us, const Bytes& data, const Bytes& after) {
    now_us = time_us;
    ASSERT_TRUE(device.automatic().plan(all).ok());
    EXPECT_TRUE(step(all, chain, {data, after}));
    EXPECT_TRUE(all.result(frame).ok());
  };
  const std::uint32_t limit_us = 2 * mb4::frame_timeout_us(device.config()) + 33;
  read_all(1000, words, kBad);
  EXPECT_EQ(frame[1].error(), Error::kNoData);
  EXPECT_EQ(frame[2].error(), Error::kNoData);
  // A word that SPI has disturbed shows that frames come.
  read_all(1000 + limit_us, both(kBadWord, mb4test::kData4), kNew);
  EXPECT_EQ(frame[1].error(), Error::kCorrupted);
  EXPECT_EQ(frame[2].error(), Error::kNoData);
  for (const bool late : {false, true}) {
    read_all(1000 + limit_us + (late ? 1 : 0), words, kBad);
    EXPECT_EQ(frame[1].error(), Error::kNoData);
    EXPECT_EQ(frame[2].error(), late ? Error::kCrc : Error::kNoData);
  }
}

// What concerns the whole read is no result of a slave.
TEST_F(Several, Faults_LeaveNoReading) {
  start(mb4::SpiCheck::kCrc, 2);
  mb4::FrameRead all;
  mb4::Frame frame;
  const std::vector<Bytes> chain{kHold, kReadBoth, kReadStatus, kClearBoth};
  ASSERT_TRUE(device.automatic().plan(all).ok());
  EXPECT_FALSE(step(all, chain, {both(kWord, kWord), zeros(6)}));
  EXPECT_TRUE(step(all, {kAgs}, {}));
  EXPECT_EQ(all.result(frame).error(), Error::kNotDetected);
  EXPECT_EQ(frame[1].error(), Error::kInvalidArgument);
  bus.expect_write({0x07, 0x00});
  ASSERT_TRUE(device.automatic().stop().ok());
  EXPECT_EQ(device.automatic().plan(all).error(), Error::kWrongMode);
}

// docs/driver.md: one good read, from its planned frames. Opcode 0x03 goes at 5 MHz at most (I204).
TEST(Timing, Table_IsThatOfThePlans) {
  std::ifstream file(MB4_MANUAL);
  const std::string manual((std::istreambuf_iterator<char>(file)), {});
  for (const unsigned slaves : {1U, 2U, 8U}) {
    std::array<mb4_word, 8> words{};
    std::array<mb4_slot, 8> slots{};
    std::array<std::uint32_t, MB4_PLAN_WORDS(8)> tx{};
    std::array<std::uint32_t, MB4_PLAN_WORDS(8)> rx{};
    const mb4_slave_config encoder{true, 28, MB4_FLAGS_ERROR_WARNING, 0, 0x43, false, false, false};
    for (std::uint8_t i = 0; i < 8; ++i) {
      mb4_word_set(&words[i], static_cast<std::uint8_t>(i + 1), &encoder, MB4_SPI_CHECK_CRC);
    }
    mb4_watch watch{};
    mb4_plan plan{};
    mb4_plan_memory(&plan, tx.data(), rx.data());
    mb4_cyclic read{};
    read.words = words.data();
    read.slots = slots.data();
    read.watch = &watch;
    read.count = static_cast<std::uint8_t>(slaves);
    read.spi_check = MB4_SPI_CHECK_CRC;
    read.chain = true;
    mb4_cyclic_plan(&read, &plan, MB4_WITH_ALL);
    unsigned bytes = 0;
    for (std::uint8_t i = 0; i < plan.frames; ++i) {
      EXPECT_LE(plan.size[i], 25);
      EXPECT_EQ(plan.at[i] % 4, 0);
      EXPECT_LE(plan.at[i] + plan.size[i], sizeof(std::uint32_t) * MB4_PLAN_WORDS(slaves));
      bytes += plan.size[i];
    }
    std::string row = "| " + std::to_string(slaves) + " | " + std::to_string(plan.frames) + " | " +
                      std::to_string(bytes) + " |";
    for (const unsigned mhz : {5U, 10U, 20U, 50U}) {
      double us = 0;
      for (std::uint8_t i = 0; i < plan.frames; ++i) {
        us += 8.0 * plan.size[i] / (mb4_plan_tx(&plan, i)[0] == 0x03 ? 5 : mhz);
      }
      std::array<char, 32> cell{};
      std::snprintf(cell.data(), cell.size(), " %.1f |", us);
      row += cell.data();
    }
    EXPECT_NE(manual.find("\n" + row + "\n"), std::string::npos) << row;
  }
}

// With kFull each step decides; a failed step releases the bank.
TEST_F(Full, EachStepFails_ReleasesTheBank) {
  start(mb4::SpiCheck::kFull);
  const Bytes read_word = join({{0x09}, Bytes(8, mb4test::kFiller)});
  const std::vector<std::vector<Bytes>> frames{
      {kHold, kReadStatus}, {read_word, kReadStatus}, {kClearValid1, kReadStatus}, {kAgs}};
  const std::vector<std::vector<Bytes>> answers{{kNew}, {kWord, kNew}, {kNone}, {}};
  for (std::size_t failing = 0; failing < frames.size(); ++failing) {
    plan();
    for (std::size_t i = 0; i < failing; ++i) {
      EXPECT_FALSE(step(frames[i], answers[i])) << failing;
    }
    const bool release_fails = failing + 1 == frames.size();
    EXPECT_EQ(step(frames[failing], {}, false), release_fails) << failing;
    if (!release_fails) {
      EXPECT_TRUE(step({kAgs}, {}));
    }
    EXPECT_EQ(read.result().error(), Error::kTransport) << failing;
  }
  // The clears of the next read are looked at: no register of the page says that one was lost.
  plan();
  EXPECT_FALSE(step({kAgs, kClearAllValid, kClearAllValid}, {}));
  EXPECT_FALSE(step({kReadForced}, {join({kProven, {0x01}})}));
  EXPECT_FALSE(step(frames[0], {kNone}));
}

// A status follows each release: 0xF4 must be AGS alone, or 0 if the chip has ended AGS.
TEST_F(Full, ReleaseProven_IsGood) {
  for (const std::uint8_t f4 : {std::uint8_t{0x01}, std::uint8_t{0x00}}) {
    start(mb4::SpiCheck::kFullAndRelease);
    const Bytes read_word = join({{0x09}, Bytes(8, mb4test::kFiller)});
    const Bytes proven{0, 0xFA, 0, 0, 0, f4};
    plan();
    EXPECT_FALSE(step({kHold, kReadStatus}, {kNew}));
    EXPECT_FALSE(step({read_word, kReadStatus}, {kWord, kNew}));
    EXPECT_FALSE(step({kClearValid1, kReadStatus}, {kNone}));
    EXPECT_FALSE(step({kAgs}, {}));
    EXPECT_TRUE(step({kReadStatus}, {proven}));
    EXPECT_EQ(read.result()->position, mb4test::kPosition);
    plan();
    EXPECT_FALSE(step({kHold, kReadStatus}, {kNone}));
    EXPECT_FALSE(step({kAgs}, {}));
    EXPECT_TRUE(step({kReadStatus}, {proven}));
    EXPECT_EQ(read.result().error(), Error::kNoData);
    bus.expect_write({0x07, 0x00});
    bus.expect_read(kReadStatus, {0, 0xFA, 0, 0, 0, 0});
    ASSERT_TRUE(device.automatic().stop().ok());
  }
}

// Whatever is wrong with 0xF4, the next read begins with a release, as often as it takes, and drops
// what waits. The error of a read comes before that of its release.
TEST_F(Full, ReleaseUnproven_NextReadBeginsWithIt) {
  start(mb4::SpiCheck::kFullAndRelease);
  struct Case {
    Bytes status;
    bool transferred;
    Error error;
  };
  const std::vector<Case> cases{
      {{0, 0xFA, 0, 0, 0, 0x41}, true, Error::kCorrupted},    // lost: HOLDBANK
      {{0, 0xFA, 0, 0, 0, 0x21}, true, Error::kCorrupted},    // SWBANK
      {{0, 0xFA, 0, 0, 0, 0x09}, true, Error::kCorrupted},    // INSTR = 100
      {{0, 0x00, 0, 0, 0, 0x00}, true, Error::kNotDetected},  // MISO at 0
      {{0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}, true, Error::kNotDetected},
      {{}, false, Error::kTransport}};
  plan();
  for (const Case& one : cases) {
    SCOPED_TRACE(hex(one.status));
    const auto prove = [&](bool good) {
      if (good) return step({kReadStatus}, {kProven});
      return one.transferred ? step({kReadStatus}, {one.status}) : step({kReadStatus}, {}, false);
    };
    // Behind clears 0xF5 is looked at too: here no line is forced.
    const auto prove_free = [&](bool good) {
      if (good) return step({kReadForced}, {join({kProven, {0x01}})});
      return one.transferred ? step({kReadForced}, {join({one.status, {0x01}})})
                             : step({kReadForced}, {}, false);
    };
    EXPECT_FALSE(step({kHold, kReadStatus}, {kNone}));
    EXPECT_FALSE(step({kAgs}, {}));
    EXPECT_TRUE(prove(false));
    EXPECT_EQ(read.result().error(), one.error);
    plan();
    EXPECT_FALSE(step(kFree, {}));
    EXPECT_TRUE(prove_free(false));
    EXPECT_EQ(read.result().error(), one.error);
    plan();
    EXPECT_TRUE(step(kFree, {}, false));
    EXPECT_EQ(read.result().error(), Error::kTransport);
    plan();
    EXPECT_FALSE(step(kFree, {}));
    EXPECT_FALSE(prove_free(true));
    EXPECT_FALSE(step({kHold, kReadStatus}, {}, false));
    EXPECT_FALSE(step({kAgs}, {}));
    EXPECT_TRUE(prove(false));
    EXPECT_EQ(read.result().error(), Error::kTransport);
    plan();
    EXPECT_FALSE(step(kFree, {}));
    EXPECT_FALSE(prove_free(true));
    EXPECT_FALSE(step({kHold, kReadStatus}, {kNone}));
    EXPECT_FALSE(step({kAgs}, {}));
    EXPECT_TRUE(prove(true));
    EXPECT_EQ(read.result().error(), Error::kNoData);
    plan();
  }
}

// AGS = 1 that is not in the chip: the start has failed, and the next one begins with BREAK.
TEST_F(Full, StartUnproven_IsCorrupted) {
  start(mb4::SpiCheck::kFullAndRelease);
  bus.expect_write({0x07, 0x00});
  bus.expect_read(kReadStatus, {0, 0xFA, 0, 0, 0, 0});
  ASSERT_TRUE(device.automatic().stop().ok());
  bus.expect_write({0x07, 0x80, 0x00});
  bus.expect_write(kClearValid1);
  bus.expect_read(mb4test::kReadWitness, {0, 0xFB, 0, 0, 0, 0x00, 0});
  bus.expect_write(kAgs);
  bus.expect_write(kClearValid1);
  bus.expect_write(kClearValid1);
  bus.expect_read(mb4test::kReadRest, mb4test::kRestBack);
  bus.expect_read(mb4test::kReadWitness, {0, 0xFA, 0, 0, 0, 0x21, 0});
  EXPECT_EQ(device.automatic().start().error(), Error::kCorrupted);
  EXPECT_FALSE(device.automatic().running());
}

}  // namespace cyclic_test
}  // namespace
