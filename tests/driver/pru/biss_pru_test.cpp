// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The calls of biss_pru.h on registers without a line.
#include "biss_pru.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "fake_pru.hpp"

namespace {

using mb4test::FakePru;
using mb4test::PruAnswer;

std::pair<std::uint32_t, std::uint32_t> access(std::uint32_t offset, std::uint32_t value) {
  return {offset, value};
}

// ---- Control words -----------------------------------------------------------------------------

struct Word {
  std::uint8_t address;
  std::uint32_t word;
};

// TIDEP0022, Table 7, and the two words that it lacks (0x7E, 0x7F; Table 11 reads these registers).
TEST(BissPruWords, Reads_AreThoseOfTable7) {
  const Word words[] = {{0x44, 0x889B4000}, {0x45, 0x88BD4000}, {0x46, 0x88D74000},
                        {0x47, 0x88F14000}, {0x60, 0x8C174000}, {0x67, 0x8CE54000},
                        {0x68, 0x8D014000}, {0x78, 0x8F0B4000}, {0x79, 0x8F2D4000},
                        {0x7A, 0x8F474000}, {0x7B, 0x8F614000}, {0x7C, 0x8F934000},
                        {0x7D, 0x8FB54000}, {0x7E, 0x8FDF4000}, {0x7F, 0x8FF94000}};
  for (const Word& row : words) {
    EXPECT_EQ(biss_pru_read_word(0, row.address), row.word) << std::hex << int{row.address};
  }
}

// Row 6 is printed 0x8C13C194: its CRC of the address and its RWS are not those of a write.
TEST(BissPruWords, Write_IsRow6WithoutItsMisprint) {
  EXPECT_EQ(biss_pru_write_word(0, 0x60, 0x06), 0x8C16C194U);
}

// Protocol facts 3.8: CRC of the header as sent, and of data.
TEST(BissPruWords, OtherIds_HaveTheirCrc) {
  EXPECT_EQ(biss_pru_read_word(1, 0x40) >> 17, 0b1'001'1000000'1111U);
  EXPECT_EQ(biss_pru_read_word(3, 0x00) >> 17, 0b1'011'0000000'0111U);
  EXPECT_EQ(biss_pru_read_word(7, 0x7F) >> 17, 0b1'111'1111111'0000U);
  EXPECT_EQ(biss_pru_write_word(0, 0x40, 0) >> 14, 0b1'000'1000000'0001'011U);
}

TEST(BissPruWords, DataCrcs_AreThoseOfTheFacts) {
  const std::pair<std::uint32_t, std::uint32_t> rows[] = {{0x00, 0xF}, {0x01, 0xC}, {0x06, 0x5},
                                                          {0x4C, 0xF}, {0x57, 0x4}, {0x5F, 0xF},
                                                          {0x69, 0xA}, {0xA5, 0x4}, {0xFF, 0xB}};
  for (const auto& [data, crc] : rows) EXPECT_EQ(biss_pru_crc4(data, 8), crc) << data;
}

TEST(BissPruWords, EveryResult_HasItsText) {
  std::set<std::string> texts;
  for (int i = BISS_PRU_OK; i <= BISS_PRU_BAD_REGISTER; ++i)
    texts.insert(biss_pru_text(static_cast<biss_pru_result>(i)));
  EXPECT_EQ(texts.size(), static_cast<std::size_t>(BISS_PRU_BAD_REGISTER) + 1);
  EXPECT_EQ(texts.count("not a result"), 0U);
}

// ---- Start -------------------------------------------------------------------------------------

biss_pru_config usual() {
  biss_pru_config config{};
  config.position_bits = 12;
  config.crc_err_war = 8;
  config.mhz = 5;
  config.period_us = 100;
  return config;
}

class BissPru : public testing::Test {
 protected:
  // The first frame ends so many us after RUN.
  void first_frame_after(std::uint32_t us, std::function<void()> frame) {
    first_us_ = us;
    first_ = std::move(frame);
    fake.before = [this] { maybe_first(); };
  }
  biss_pru_result start(const biss_pru_config& config) {
    const biss_pru_port port = fake.port();
    return biss_pru_start(&pru, &port, &config);
  }
  void run(biss_pru_config config = usual()) {
    first_frame_after(90, [this] { fake.good(1); });
    ASSERT_EQ(start(config), BISS_PRU_OK);
    fake.before = nullptr;
    fake.writes.clear();
    ASSERT_EQ(biss_pru_position(&pru, &reading), BISS_PRU_OK);
  }
  void pass(std::uint32_t us) { fake.now_us += us; }
  biss_pru_result position() { return biss_pru_position(&pru, &reading); }
  biss_pru_result poll() { return biss_pru_poll(&pru, &data); }

  FakePru fake;
  biss_pru_master pru{};
  biss_pru_reading reading{};
  std::uint8_t data = 0xEE;

 private:
  void maybe_first() {
    if (!fake.runs()) {
      run_us_ = fake.now_us;
    } else if (first_ && fake.now_us - run_us_ >= first_us_) {
      const auto frame = std::move(first_);
      first_ = nullptr;
      frame();
    }
  }
  std::uint32_t first_us_ = 0, run_us_ = 0;
  std::function<void()> first_;
};

TEST_F(BissPru, Start_WritesAllThatTheMasterNeedsAt200Mhz) {
  run();
  EXPECT_EQ(fake.regs[PRU_ADDR_LENGTHS], 0x05080CU);
  EXPECT_EQ(fake.regs[PRU_ADDR_TRIGGER_PERIOD], 20'000U);
  EXPECT_EQ(fake.regs[PRU_ADDR_OVERHEAD], 5'400U);
  EXPECT_EQ(fake.regs[PRU_ADDR_PROC_TIME_MAX], 0U);
  EXPECT_EQ(fake.regs[PRU_ADDR_RUN], 1U);
  EXPECT_EQ(fake.regs[PRU_ADDR_IRQ_ENABLE], 0U);
}

TEST_F(BissPru, Start_CountsTheClocksOf80Mhz) {
  fake.regs[PRU_ADDR_FEATURES] = PRU_CLOCK_80_MASK;
  biss_pru_config config = usual();
  config.overhead_us = 50;
  config.proc_time_max = 1023;
  run(config);
  EXPECT_EQ(fake.regs[PRU_ADDR_TRIGGER_PERIOD], 8'000U);
  EXPECT_EQ(fake.regs[PRU_ADDR_OVERHEAD], 4'000U);
  EXPECT_EQ(fake.regs[PRU_ADDR_PROC_TIME_MAX], 1023U);
}

TEST_F(BissPru, PeriodInClocks_IsWrittenAsItIs) {
  biss_pru_config config = usual();
  config.period_us = 0;
  config.period_clk = 0xFFFFFF;
  run(config);
  EXPECT_EQ(fake.regs[PRU_ADDR_TRIGGER_PERIOD], 0xFFFFFFU);
}

// The order: the lengths are taken when RUN rises, and an old word must not be taken.
TEST_F(BissPru, Start_StopsFirstAndRunsLast) {
  fake.regs[PRU_ADDR_RUN] = 1;
  fake.regs[PRU_ADDR_CTRL] = 0x12345678;
  fake.regs[PRU_ADDR_IRQ_STATUS] = PRU_CTRL_ENDED_MASK;
  first_frame_after(90, [this] { fake.good(1); });
  ASSERT_EQ(start(usual()), BISS_PRU_OK);
  ASSERT_GT(fake.writes.size(), 3U);
  EXPECT_EQ(fake.writes.front(), access(PRU_ADDR_RUN, 0));
  EXPECT_EQ(fake.writes[1], access(PRU_ADDR_CTRL, 0));
  EXPECT_EQ(fake.writes.back(), access(PRU_ADDR_RUN, 1));
  EXPECT_TRUE(fake.words.empty());
  EXPECT_EQ(fake.regs[PRU_ADDR_IRQ_STATUS] & PRU_CTRL_ENDED_MASK, 0U);
}

struct Wrong {
  biss_pru_result code;
  void (*change)(biss_pru_config&);
};

TEST_F(BissPru, WrongConfig_HasItsCodeAndWritesNothing) {
  const Wrong rows[] = {
      {BISS_PRU_BAD_POSITION_BITS, [](biss_pru_config& c) { c.position_bits = 0; }},
      {BISS_PRU_BAD_POSITION_BITS, [](biss_pru_config& c) { c.position_bits = 56; }},
      {BISS_PRU_BAD_CRC_ERR_WAR, [](biss_pru_config& c) { c.crc_err_war = 33; }},
      {BISS_PRU_UNCHECKED, [](biss_pru_config& c) { c.crc_err_war = 5; }},
      {BISS_PRU_UNCHECKED, [](biss_pru_config& c) { c.crc_err_war = 0; }},
      {BISS_PRU_BAD_FREQUENCY, [](biss_pru_config& c) { c.mhz = 0; }},
      {BISS_PRU_BAD_FREQUENCY, [](biss_pru_config& c) { c.mhz = 8; }},
      {BISS_PRU_BAD_PERIOD, [](biss_pru_config& c) { c.period_clk = 1; }},
      {BISS_PRU_BAD_PERIOD, [](biss_pru_config& c) { c.period_us = 83'887; }},
      {BISS_PRU_BAD_PERIOD,
       [](biss_pru_config& c) {
         c.period_us = 0;
         c.period_clk = 0x1000000;
       }},
      {BISS_PRU_BAD_OVERHEAD, [](biss_pru_config& c) { c.overhead_us = 328; }},
      {BISS_PRU_BAD_PROC_TIME_MAX, [](biss_pru_config& c) { c.proc_time_max = 1024; }},
      {BISS_PRU_BAD_FRAME_LIMIT, [](biss_pru_config& c) { c.frame_limit_us = 60'000'001; }},
      {BISS_PRU_BAD_FRAME_LIMIT, [](biss_pru_config& c) { c.period_us = 0; }},
  };
  for (const Wrong& row : rows) {
    biss_pru_config config = usual();
    row.change(config);
    EXPECT_EQ(start(config), row.code) << &row - rows;
    EXPECT_TRUE(fake.writes.empty()) << &row - rows;
  }
}

TEST_F(BissPru, LargestConfig_IsTaken) {
  biss_pru_config config = usual();
  config.position_bits = 55;
  config.period_us = 83'886;
  config.overhead_us = 327;
  config.proc_time_max = 1023;
  config.frame_limit_us = 60'000'000;
  run(config);
  EXPECT_EQ(fake.regs[PRU_ADDR_TRIGGER_PERIOD], 16'777'200U);
  EXPECT_EQ(fake.regs[PRU_ADDR_OVERHEAD], 65'400U);
}

TEST_F(BissPru, FewBitsOfCrc_AreTakenWhenTheConfigSaysSo) {
  biss_pru_config config = usual();
  config.crc_err_war = 2;
  config.unchecked = true;
  run(config);
  EXPECT_EQ(fake.regs[PRU_ADDR_LENGTHS], 0x05020CU);
}

TEST_F(BissPru, PortWithoutFunction_IsNotUsed) {
  const biss_pru_config config = usual();
  for (int i = 0; i < 3; ++i) {
    biss_pru_port port = fake.port();
    if (i == 0) port.read = nullptr;
    if (i == 1) port.write = nullptr;
    if (i == 2) port.now_us = nullptr;
    EXPECT_EQ(biss_pru_start(&pru, &port, &config), BISS_PRU_BAD_PORT);
  }
  EXPECT_EQ(fake.accesses, 0U);
}

TEST_F(BissPru, OtherMaster_IsRefused) {
  fake.regs[PRU_ADDR_ID] = 0x454E4304;
  EXPECT_EQ(start(usual()), BISS_PRU_NO_MASTER);
  fake.regs[PRU_ADDR_ID] = PRU_RESET_ID;
  fake.regs[PRU_ADDR_FEATURES] = PRU_SUCCESSOR_MASK;
  EXPECT_EQ(start(usual()), BISS_PRU_NO_MASTER);
  EXPECT_TRUE(fake.writes.empty());
}

TEST_F(BissPru, BadFirstFrame_IsToldAndTheMasterRunsOn) {
  const std::pair<biss_pru_result, std::function<void()>> rows[] = {
      {BISS_PRU_NO_SLAVE, [this] { fake.no_slave(false); }},
      {BISS_PRU_CRC, [this] { fake.bad_crc(); }},
      {BISS_PRU_PROCESSING, [this] { fake.processing(); }},
  };
  for (const auto& [code, frame] : rows) {
    first_frame_after(90, frame);
    EXPECT_EQ(start(usual()), code);
    EXPECT_EQ(fake.regs[PRU_ADDR_RUN], 1U);
    fake.good(7);
    EXPECT_EQ(position(), BISS_PRU_OK);
    EXPECT_EQ(reading.position, 7U);
    fake.before = nullptr;
    biss_pru_stop(&pru);
  }
}

// 40 us, 2 + 2 * 23 periods, 40 us of processing, 27 us, 100 us.
TEST_F(BissPru, FirstFrameThatStaysAway_StopsTheMaster) {
  const std::uint32_t limit = 40 + 48 + 40 + 27 + 100;
  first_frame_after(limit, [this] { fake.good(1); });
  EXPECT_EQ(start(usual()), BISS_PRU_OK);
  first_frame_after(limit + 10, [this] { fake.good(1); });
  EXPECT_EQ(start(usual()), BISS_PRU_NO_FRAMES);
  EXPECT_EQ(fake.regs[PRU_ADDR_RUN], 0U);
}

TEST_F(BissPru, ThreadThatSleepsDuringStart_MissesNothing) {
  unsigned asked = 0;
  fake.before_time = [&] {
    if (++asked != 2) return;  // after the begin of the waiting
    fake.now_us += 100'000;
    fake.good(1);
  };
  EXPECT_EQ(start(usual()), BISS_PRU_OK);
}

TEST_F(BissPru, LongProcessingTime_IsWaitedFor) {
  biss_pru_config config = usual();
  config.proc_time_max = 1023;
  first_frame_after(40 + 1023 + 25 + 27, [this] { fake.good(1); });
  EXPECT_EQ(start(config), BISS_PRU_OK);
}

TEST_F(BissPru, ResetDuringStart_IsTold) {
  first_frame_after(10, [this] { fake.regs[PRU_ADDR_RUN] = 0; });
  EXPECT_EQ(start(usual()), BISS_PRU_NOT_RUNNING);
}

TEST_F(BissPru, Stop_ClearsRunAndTheWaitingWord) {
  run();
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  biss_pru_stop(&pru);
  EXPECT_EQ(fake.regs[PRU_ADDR_RUN], 0U);
  EXPECT_EQ(fake.regs[PRU_ADDR_CTRL], 0U);
  EXPECT_EQ(poll(), BISS_PRU_NO_ACCESS);
  EXPECT_EQ(position(), BISS_PRU_NOT_RUNNING);
}

// R-P5: FREQUENCY is read with the end of a frame, so the frame after the next end has it.
TEST_F(BissPru, SetFrequency_SaysFromWhichFrameOnItActs) {
  run();
  std::uint16_t first = 0;
  ASSERT_EQ(biss_pru_set_frequency(&pru, 10, &first), BISS_PRU_OK);
  EXPECT_EQ(fake.regs[PRU_ADDR_LENGTHS], 0x0A080CU);
  EXPECT_EQ(first, reading.frame + 2);
  EXPECT_EQ(biss_pru_set_frequency(&pru, 1, nullptr), BISS_PRU_OK);
  EXPECT_EQ(fake.regs[PRU_ADDR_LENGTHS], 0x01080CU);
  fake.writes.clear();
  EXPECT_EQ(biss_pru_set_frequency(&pru, 3, &first), BISS_PRU_BAD_FREQUENCY);
  fake.regs[PRU_ADDR_RUN] = 0;
  EXPECT_EQ(biss_pru_set_frequency(&pru, 2, &first), BISS_PRU_NOT_RUNNING);
  EXPECT_TRUE(fake.writes.empty());
}

// ---- Positions ---------------------------------------------------------------------------------

TEST_F(BissPru, Position_HasAllOfItsFrame) {
  run();
  fake.regs[PRU_ADDR_STATUS] = PRU_SMA_FLAG_MASK | PRU_CMD_CRC_ERR_MASK | 0x1234;
  fake.regs[PRU_ADDR_RECEIVED] = 0xF50A2B;
  fake.regs[PRU_ADDR_TIMES] = 0x070123;
  fake.good(0x0123456789ABCDEF);
  fake.good(0x0123456789ABCDEF, true, false);
  ASSERT_EQ(position(), BISS_PRU_OK);
  EXPECT_EQ(reading.position, 0x0123456789ABCDEFU);
  EXPECT_EQ(reading.frame, 3U);
  EXPECT_EQ(reading.frames, 2U);
  EXPECT_EQ(reading.flags, BISS_PRU_SMA_FLAG | BISS_PRU_CMD_CRC_ERR);
  EXPECT_EQ(reading.crc_errors, 0x1234U);
  EXPECT_EQ(reading.raw_data, 0xF5U);
  EXPECT_EQ(reading.crc, 0x2BU);
  EXPECT_EQ(reading.line_delay, 7U);
  EXPECT_EQ(reading.proc_time, 0x123U);
  EXPECT_TRUE(reading.warning);
}

TEST_F(BissPru, OldFrame_IsNotNew) {
  run();
  fake.good(5);
  ASSERT_EQ(position(), BISS_PRU_OK);
  reading.position = 99;
  EXPECT_EQ(position(), BISS_PRU_NO_NEW_FRAME);
  EXPECT_EQ(reading.position, 99U);
}

TEST_F(BissPru, BadFrame_HasNoPosition) {
  run();
  const std::pair<biss_pru_result, std::function<void()>> rows[] = {
      {BISS_PRU_NO_SLAVE, [this] { fake.no_slave(false); }},
      {BISS_PRU_NO_SLAVE, [this] { fake.no_slave(true); }},
      {BISS_PRU_CRC, [this] { fake.bad_crc(); }},
      {BISS_PRU_PROCESSING, [this] { fake.processing(); }},
  };
  for (const auto& [code, frame] : rows) {
    fake.good(5, false, false);
    ASSERT_EQ(position(), BISS_PRU_ENCODER_ERROR);
    frame();
    EXPECT_EQ(position(), code);
    EXPECT_EQ(reading.position, 0U);
    EXPECT_FALSE(reading.warning);
    EXPECT_EQ(reading.frames, 1U);
    EXPECT_EQ(position(), BISS_PRU_NO_NEW_FRAME);
  }
}

TEST_F(BissPru, EncoderError_ComesWithTheReading) {
  run();
  fake.good(5, false, false);
  EXPECT_EQ(position(), BISS_PRU_ENCODER_ERROR);
  EXPECT_EQ(reading.position, 5U);
  EXPECT_TRUE(reading.warning);
  fake.good(6, false, true);
  EXPECT_EQ(position(), BISS_PRU_ENCODER_ERROR);
  EXPECT_FALSE(reading.warning);
}

// A frame ends before each single access of a read, and changes everything.
TEST_F(BissPru, FrameDuringTheRead_NeverMixes) {
  run();
  const auto frame = [this](std::uint32_t n) {
    fake.regs[PRU_ADDR_TIMES] = n << 16 | n;
    fake.regs[PRU_ADDR_RECEIVED] = n << 16 | n;
    fake.good(std::uint64_t{n} << 32 | n, true, n % 2 == 0);
  };
  unsigned mixed_chances = 0;
  for (std::uint32_t at = 1; at <= 9; ++at) {
    frame(2 * at);
    const unsigned before = fake.accesses;
    fake.before = [&] {
      if (fake.accesses == before + at) frame(2 * at + 1);
    };
    ASSERT_EQ(position(), BISS_PRU_OK);
    fake.before = nullptr;
    const std::uint32_t n = static_cast<std::uint32_t>(reading.position);
    EXPECT_EQ(n, 2 * at + 1) << "the frame ended before the last look at FRAME_COUNT";
    EXPECT_EQ(reading.position >> 32, n);
    EXPECT_EQ(reading.line_delay, n);
    EXPECT_EQ(reading.proc_time, n);
    EXPECT_EQ(reading.raw_data, n);
    EXPECT_EQ(reading.crc, n);
    EXPECT_EQ(reading.warning, n % 2 != 0);
    EXPECT_EQ(reading.frames, 2U);
    if (fake.accesses - before > 9) ++mixed_chances;
  }
  EXPECT_EQ(mixed_chances, 8U) << "all but the frame before the first access need a second read";
}

TEST_F(BissPru, SlowPort_IsTold) {
  run();
  fake.good(5);
  fake.before = [this] { fake.good(6); };
  reading.position = 99;
  EXPECT_EQ(position(), BISS_PRU_TORN);
  EXPECT_EQ(reading.position, 99U);
  fake.before = nullptr;
  EXPECT_EQ(position(), BISS_PRU_OK);
  EXPECT_GT(reading.frames, 30U) << "the frames of the torn reads were not told";
}

// Twice the longest frame at 1 MHz, 2 + 2 * 23 + 40 + 27 us, and 100 us.
TEST_F(BissPru, FramesThatStayAway_AreTold) {
  run();
  const std::uint32_t limit = 2 * 115 + 100;
  const std::uint32_t begin = pru.seen_us;
  fake.now_us = begin + limit;
  EXPECT_EQ(position(), BISS_PRU_NO_NEW_FRAME);
  fake.now_us = begin + limit + 1;
  EXPECT_EQ(position(), BISS_PRU_NO_FRAMES);
  EXPECT_EQ(position(), BISS_PRU_NO_FRAMES);
  fake.good(8);
  EXPECT_EQ(position(), BISS_PRU_OK);
  EXPECT_EQ(position(), BISS_PRU_NO_NEW_FRAME);
}

TEST_F(BissPru, FrameLimitOfTheConfig_IsUsed) {
  biss_pru_config config = usual();
  config.period_us = 0;
  config.frame_limit_us = 5'000;
  run(config);
  EXPECT_EQ(fake.regs[PRU_ADDR_TRIGGER_PERIOD], 0U) << "frames by the pin";
  const std::uint32_t begin = pru.seen_us;
  fake.now_us = begin + 5'000;
  EXPECT_EQ(position(), BISS_PRU_NO_NEW_FRAME);
  fake.now_us = begin + 5'001;
  EXPECT_EQ(position(), BISS_PRU_NO_FRAMES);
}

TEST_F(BissPru, ThreadThatSleepsInPosition_RaisesNoAlarm) {
  run();
  fake.before = [this] { fake.now_us += 100'000; };
  EXPECT_EQ(position(), BISS_PRU_NO_NEW_FRAME);
}

TEST_F(BissPru, Clock_MayWrap) {
  fake.now_us = 0xFFFFFFFF - 120;
  run();
  fake.good(5);
  EXPECT_EQ(position(), BISS_PRU_OK);
  EXPECT_EQ(position(), BISS_PRU_NO_NEW_FRAME);
}

TEST_F(BissPru, FrameCount_MayWrap) {
  run();
  fake.regs[PRU_ADDR_FRAME_COUNT] = 0xFFFF;
  pru.told = 0xFFFF;
  fake.good(5);
  ASSERT_EQ(position(), BISS_PRU_OK);
  EXPECT_EQ(reading.frame, 0U);
  EXPECT_EQ(reading.frames, 1U);
}

// Before each access of a call: no old position may look like a new one.
TEST_F(BissPru, ResetAtAnyAccess_IsTold) {
  for (unsigned at = 1; at <= 10; ++at) {
    fake.reset();
    run();
    fake.good(5);
    const unsigned before = fake.accesses;
    fake.before = [this, before, at] {
      if (fake.accesses == before + at) fake.reset();
    };
    const biss_pru_result result = position();
    fake.before = nullptr;
    if (at == 10) {
      EXPECT_EQ(result, BISS_PRU_OK) << "it came after the call";
    } else {
      EXPECT_EQ(result, BISS_PRU_NOT_RUNNING) << at;
    }
    if (result == BISS_PRU_OK) {
      fake.reset();
    }
    EXPECT_EQ(position(), BISS_PRU_NOT_RUNNING);
  }
}

TEST_F(BissPru, ResetWithFrameCount0_IsTold) {
  run();
  fake.regs[PRU_ADDR_FRAME_COUNT] = 0xFFFF;
  fake.good(5);
  ASSERT_EQ(position(), BISS_PRU_OK);
  fake.reset();
  EXPECT_EQ(position(), BISS_PRU_NOT_RUNNING);
}

TEST_F(BissPru, Interrupt_IsEnabledAndClearedBeforeTheRead) {
  biss_pru_config config = usual();
  config.interrupt = true;
  fake.regs[PRU_ADDR_IRQ_ENABLE] = PRU_ERROR_ENABLE_MASK;
  run(config);
  EXPECT_EQ(fake.regs[PRU_ADDR_IRQ_ENABLE], PRU_ERROR_ENABLE_MASK | PRU_FRAME_ENDED_ENABLE_MASK);
  fake.regs[PRU_ADDR_IRQ_STATUS] = PRU_WMASK_IRQ_STATUS;
  fake.good(5);
  ASSERT_EQ(position(), BISS_PRU_OK);
  EXPECT_EQ(fake.regs[PRU_ADDR_IRQ_STATUS], PRU_WMASK_IRQ_STATUS & ~PRU_FRAME_ENDED_MASK);
  ASSERT_EQ(fake.writes.back(), access(PRU_ADDR_IRQ_STATUS, PRU_FRAME_ENDED_MASK));
  // A frame that ends during the call interrupts again.
  const unsigned before = fake.accesses;
  fake.before = [&] {
    if (fake.accesses == before + 2) fake.good(6);
  };
  ASSERT_EQ(position(), BISS_PRU_OK);
  EXPECT_NE(fake.regs[PRU_ADDR_IRQ_STATUS] & PRU_FRAME_ENDED_MASK, 0U);
}

// ---- Registers of the encoder ------------------------------------------------------------------

PruAnswer byte(std::uint8_t value) { return {value, biss_pru_crc4(value, 8), false}; }

class BissPruAccess : public BissPru {
 protected:
  void SetUp() override { run(); }
  // Frames with a position until the access ends, at most `most`.
  biss_pru_result frames(unsigned most = 100) {
    for (ended_after = 1; ended_after <= most; ++ended_after) {
      pass(100);
      fake.good(ended_after);
      const biss_pru_result result = poll();
      if (result != BISS_PRU_PENDING) return result;
    }
    return BISS_PRU_PENDING;
  }
  unsigned ended_after = 0;
};

TEST_F(BissPruAccess, Read_EndsWithTheValueAfter47Frames) {
  fake.answer = [](std::uint32_t word) {
    return word == 0x8CE54000 ? byte(0x5F) : PruAnswer{};  // TIDEP0022, Tables 7 and 11
  };
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x67), BISS_PRU_OK);
  EXPECT_EQ(poll(), BISS_PRU_PENDING);
  EXPECT_EQ(frames(), BISS_PRU_OK);
  EXPECT_EQ(ended_after, 47U);
  EXPECT_EQ(data, 0x5FU);
  EXPECT_EQ(poll(), BISS_PRU_NO_ACCESS);
}

TEST_F(BissPruAccess, ValueOf0_IsAValue) {
  fake.answer = [](std::uint32_t) { return byte(0); };
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_OK);
  EXPECT_EQ(data, 0U);
}

TEST_F(BissPruAccess, Write_EndsWithItsEcho) {
  fake.answer = [](std::uint32_t word) { return byte(static_cast<std::uint8_t>(word >> 6)); };
  ASSERT_EQ(biss_pru_begin_write(&pru, 0, 0x60, 6), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_OK);
  EXPECT_EQ(fake.words, std::vector<std::uint32_t>{0x8C16C194});
  EXPECT_EQ(data, 6U);
}

TEST_F(BissPruAccess, OtherEcho_IsTold) {
  fake.answer = [](std::uint32_t) { return byte(7); };
  ASSERT_EQ(biss_pru_begin_write(&pru, 0, 0x60, 6), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_BAD_ECHO);
  EXPECT_EQ(data, 0xEEU);
  // A read after it is no write.
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x60), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_OK);
}

TEST_F(BissPruAccess, NoAnswer_IsNoWrongCrc) {
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_NO_ANSWER);
  EXPECT_EQ(data, 0xEEU);
}

TEST_F(BissPruAccess, WrongCrc_IsTold) {
  fake.answer = [](std::uint32_t) { return PruAnswer{0x5F, 0xE, true}; };
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_BAD_ANSWER);
  // The driver looks for itself too, should a bit of the access to FLAGS be lost.
  fake.answer = [](std::uint32_t) { return PruAnswer{0x5F, 0xE, false}; };
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_BAD_ANSWER);
  fake.answer = [](std::uint32_t) { return PruAnswer{0x5F, 0xF, true}; };
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  EXPECT_EQ(frames(), BISS_PRU_BAD_ANSWER);
}

// The receiver reads 1: frames run, and none has an acknowledge.
TEST_F(BissPruAccess, UnpluggedEncoder_IsTold) {
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  biss_pru_result result = BISS_PRU_PENDING;
  unsigned frame = 0;
  for (; frame < 47 && result == BISS_PRU_PENDING; ++frame) {
    pass(100);
    fake.no_slave(true);
    result = poll();
  }
  EXPECT_EQ(result, BISS_PRU_NO_SLAVE);
  EXPECT_EQ(frame, 47U);
}

TEST_F(BissPruAccess, SecondAccess_HasToWait) {
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  for (unsigned frame = 0; frame < 46; ++frame) {
    EXPECT_EQ(biss_pru_begin_write(&pru, 0, 0x45, 1), BISS_PRU_BUSY) << frame;
    EXPECT_EQ(frames(1), BISS_PRU_PENDING);
  }
  EXPECT_EQ(frames(), BISS_PRU_NO_ANSWER);
  EXPECT_EQ(fake.words, std::vector<std::uint32_t>{0x889B4000});
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x45), BISS_PRU_OK);
}

TEST_F(BissPruAccess, WordOfSomebodyElse_IsLeftAlone) {
  fake.regs[PRU_ADDR_CTRL] = 0x12345678;
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_BUSY);
  EXPECT_EQ(fake.regs[PRU_ADDR_CTRL], 0x12345678U);
  fake.regs[PRU_ADDR_CTRL] = 0;
  fake.regs[PRU_ADDR_STATUS] |= PRU_CMD_START_FLAG_MASK;
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_BUSY);
  EXPECT_TRUE(fake.writes.empty());
}

TEST_F(BissPruAccess, WrongRegister_WritesNothing) {
  EXPECT_EQ(biss_pru_begin_read(&pru, 8, 0x44), BISS_PRU_BAD_REGISTER);
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x80), BISS_PRU_BAD_REGISTER);
  EXPECT_EQ(biss_pru_write_register(&pru, 8, 0x44, 1), BISS_PRU_BAD_REGISTER);
  EXPECT_TRUE(fake.writes.empty());
  EXPECT_EQ(poll(), BISS_PRU_NO_ACCESS);
}

TEST_F(BissPruAccess, EndOfAnEarlierOne_IsNotItsEnd) {
  fake.regs[PRU_ADDR_IRQ_STATUS] |= PRU_CTRL_ENDED_MASK;
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  EXPECT_EQ(poll(), BISS_PRU_PENDING);
}

TEST_F(BissPruAccess, StoppedMaster_IsTold) {
  ASSERT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
  EXPECT_EQ(frames(20), BISS_PRU_PENDING);
  fake.reset();
  EXPECT_EQ(poll(), BISS_PRU_NOT_RUNNING);
  EXPECT_EQ(poll(), BISS_PRU_NO_ACCESS);
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_NOT_RUNNING);
}

// No frame ends, so the word was not taken, and it must not go to the encoder later.
TEST_F(BissPruAccess, FramesThatStayAway_TakeTheWordBack) {
  ASSERT_EQ(biss_pru_begin_write(&pru, 0, 0x60, 6), BISS_PRU_OK);
  const std::uint32_t limit = 48 * 330;
  fake.now_us = pru.begin_us + limit;
  EXPECT_EQ(poll(), BISS_PRU_PENDING);
  fake.now_us = pru.begin_us + limit + 1;
  EXPECT_EQ(poll(), BISS_PRU_NO_FRAMES);
  EXPECT_EQ(fake.regs[PRU_ADDR_CTRL], 0U);
  fake.good(1);
  EXPECT_TRUE(fake.words.empty());
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK) << "nothing is left behind";
}

// SL is 0: frames end, and the control frame that was taken takes no bit of them.
TEST_F(BissPruAccess, AbandonedControlFrame_KeepsTheMasterBusyUntilItHasEnded) {
  ASSERT_EQ(biss_pru_begin_write(&pru, 0, 0x60, 6), BISS_PRU_OK);
  biss_pru_result result = BISS_PRU_PENDING;
  while (result == BISS_PRU_PENDING) {
    pass(100);
    fake.no_slave(false);
    result = poll();
  }
  EXPECT_EQ(result, BISS_PRU_NO_SLAVE);
  EXPECT_GE(fake.now_us - pru.begin_us, 48U * 330U);
  for (unsigned i = 0; i < 46; ++i) {
    EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_BUSY) << i;
    fake.good(1);
  }
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_OK);
}

// The word is taken between the two looks at it: it may have been sent.
TEST_F(BissPruAccess, WordTakenInTheLastMoment_KeepsTheMasterBusy) {
  ASSERT_EQ(biss_pru_begin_write(&pru, 0, 0x60, 6), BISS_PRU_OK);
  fake.now_us = pru.begin_us + 48 * 330 + 1;
  unsigned looks = 0;
  fake.before = [&] {
    if (pru.access == BISS_PRU_ABANDONED && ++looks == 2) fake.good(1);
  };
  // Frames have ended, and with a position: it is only the control frame that has not.
  pru.access_frame = static_cast<std::uint16_t>(pru.access_frame - 1);
  EXPECT_EQ(poll(), BISS_PRU_TIMEOUT);
  fake.before = nullptr;
  ASSERT_EQ(fake.words.size(), 1U);
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_BUSY);
  biss_pru_stop(&pru);
  EXPECT_EQ(biss_pru_begin_read(&pru, 0, 0x44), BISS_PRU_NOT_RUNNING);
}

TEST_F(BissPruAccess, BlockingCalls_WaitForTheEnd) {
  std::uint32_t last = 0;
  fake.before = [&] {
    if (fake.now_us - last < 100) return;
    last = fake.now_us;
    fake.good(1);
  };
  fake.answer = [](std::uint32_t word) {
    return byte((word >> 14 & 7U) == 3U ? static_cast<std::uint8_t>(word >> 6) : 0x57);
  };
  EXPECT_EQ(biss_pru_read_register(&pru, 0, 0x7E, &data), BISS_PRU_OK);
  EXPECT_EQ(data, 0x57U);
  EXPECT_EQ(biss_pru_write_register(&pru, 0, 0x60, 0x06), BISS_PRU_OK);
  EXPECT_EQ(fake.words, (std::vector<std::uint32_t>{0x8FDF4000, 0x8C16C194}));
}

// biss_pru_position() interrupts the calls for registers before each of their accesses.
TEST_F(BissPruAccess, PositionInAnInterrupt_DisturbsNothing) {
  fake.answer = [](std::uint32_t word) { return byte(static_cast<std::uint8_t>(word >> 6)); };
  bool inside = false;
  unsigned told = 0;
  std::uint32_t n = 0;
  fake.before = [&] {
    if (inside) return;
    inside = true;
    fake.good(++n);
    pass(50);
    if (position() == BISS_PRU_OK && reading.position == n && reading.frames == 1) ++told;
    inside = false;
  };
  EXPECT_EQ(biss_pru_write_register(&pru, 0, 0x60, 0x06), BISS_PRU_OK);
  EXPECT_EQ(told, n);
  EXPECT_GE(n, 47U);
}

}  // namespace
