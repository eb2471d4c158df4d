// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The calls of pm_bissc_include.h on the Verilated biss_clb, with an encoder that answers control
// frames (protocol facts 3.1 and 3.2), and that can alter chosen bits of an answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "pm_bissc_program.h"
#include "tests/block/clb/biss_clb_bench.hpp"
#include "tests/support/dice.hpp"

namespace {

using mb4test::bits_of;
using mb4test::crc_of;

// The bits of CDM since the last 14 zeros decide what the next CDS is.
class Registers {
 public:
  // CDS of the next frame, after a frame with this CDM.
  bool step(bool cdm) {
    zeros_ = cdm ? 0 : zeros_ + 1;
    all.push_back(cdm);
    if (zeros_ >= 14) sent_.clear();
    const bool idle = sent_.empty();
    if (idle && !(cdm && before_ >= 14)) {
      before_ = zeros_;
      return false;
    }
    before_ = zeros_;
    sent_ += cdm ? '1' : '0';
    const std::size_t slot = sent_.size();  // of the CDS
    if (slot == 32) words.push_back(number(0, 32));
    return answer(slot) != (flips.count(slot) != 0);
  }
  std::map<unsigned, unsigned> bytes;
  std::map<std::size_t, bool> flips;  // slots of CDS that are inverted
  std::vector<std::uint32_t> words;   // control frames, START in bit 31
  std::vector<bool> all;
  bool busy = false;

 private:
  std::uint32_t number(std::size_t begin, std::size_t count) const {
    std::uint32_t value = 0;
    for (std::size_t i = begin; i < begin + count; ++i)
      value = value << 1U | (sent_[i] == '1' ? 1U : 0U);
    return value;
  }
  bool answer(std::size_t slot) {
    if (slot == 1) return true;  // ID 0
    if (slot < 17 || slot > 31) return false;
    const bool fits = (~crc_of(sent_.substr(1, 11), 0x13) & 0xFU) == number(12, 4);
    if (!fits) return false;
    const bool read = sent_[16] == '1';
    if (slot == 17) return read;
    if (slot == 18) return sent_[17] == '1';
    if (slot == 19) return !busy;
    if (busy) return false;
    const unsigned address = number(5, 7);
    if (read) {
      const std::string data = bits_of(bytes[address], 8);
      return (data + bits_of(~crc_of(data, 0x13) & 0xFU, 4)).at(slot - 20) == '1';
    }
    if (slot == 31) {
      const std::string data = sent_.substr(19, 8);
      if ((~crc_of(data, 0x13) & 0xFU) == number(27, 4)) bytes[address] = number(19, 8);
    }
    return sent_.at(slot - 1) == '1';
  }
  std::string sent_;
  unsigned zeros_ = 0, before_ = 0;
};

mb4test::ClbPins* bench_now = nullptr;

class PmBissc : public testing::Test {
 protected:
  static constexpr unsigned kHalf = 10;
  PmBissc() {
    bench_now = &bench;
    scd = {};
    cd = {};
    reg = {};
    encoder = {};
    bench.slave.timeout = 400;
    bench.after_frame = [this](bool cdm) {
      cds_ = registers.step(cdm);
      send();
    };
  }
  ~PmBissc() override { bench_now = nullptr; }
  void position(std::uint64_t value, unsigned bits, unsigned flags = 3) {
    value_ = value;
    bits_ = bits;
    flags_ = flags;
    send();
  }
  void send() { bench.set_word(value_, bits_, flags_, cds_, polynomial, start); }

  std::uint32_t polynomial = 0x43, start = 0;
  Registers registers;
  mb4test::ClbPins bench;

 private:
  std::uint64_t value_ = 0;
  unsigned bits_ = 0, flags_ = 3;
  bool cds_ = false;
};

struct Widths {
  unsigned mt, st;
};
class PmBisscWidths : public PmBissc, public testing::WithParamInterface<Widths> {};

TEST_P(PmBisscWidths, Positions_AreReadRight) {
  const Widths& widths = GetParam();
  const unsigned bits = widths.mt + widths.st;
  program_begin(static_cast<std::uint16_t>(widths.mt), static_cast<std::uint16_t>(widths.st), 6, 3,
                0, kHalf);
  mb4test::Dice dice;
  for (int round = 0; round < 40; ++round) {
    std::uint64_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 16U | dice.below(0x10000);
    if (bits < 64) value &= (std::uint64_t{1} << bits) - 1;
    const unsigned flags = dice.below(4);
    bench.delay = dice.below(200);
    bench.slave.busy = dice.below(8);
    position(value, bits, flags);
    ASSERT_EQ(program_frame(kHalf), PM_BISSC_PASS) << round;
    EXPECT_EQ(encoder.position, value);
    EXPECT_EQ(encoder.positionST,
              widths.st >= 64 ? 0 : value & ((std::uint64_t{1} << widths.st) - 1) & 0xFFFF'FFFF);
    EXPECT_EQ(encoder.positionMT, widths.mt == 0 ? 0 : value >> widths.st);
    EXPECT_EQ(encoder.error, flags >> 1U) << "nE comes first";
    EXPECT_EQ(encoder.warning, flags & 1U);
    bench.clocks(1000);  // no frame begins in the encoder's timeout
  }
  EXPECT_EQ(program_rest(), 0);
}

INSTANTIATE_TEST_SUITE_P(Encoders, PmBisscWidths,
                         testing::Values(Widths{0, 18}, Widths{12, 20}, Widths{16, 12},
                                         Widths{32, 32}, Widths{0, 1}, Widths{31, 30}),
                         [](const auto& test) {
                           return "Mt" + std::to_string(test.param.mt) + "St" +
                                  std::to_string(test.param.st);
                         });

// 5 bits with 5 and 16 bits with 0x90D9 are those of the library; start values of any kind.
TEST_F(PmBissc, OtherCrcs_AreChecked) {
  mb4test::Dice dice;
  for (const unsigned bits : {1U, 4U, 5U, 6U, 7U, 8U, 9U, 12U, 16U}) {
    for (int round = 0; round < 6; ++round) {
      const std::uint32_t poly = bits == 5 ? 5 : bits == 16 ? 0x90D9 : dice.below(1U << bits) | 1U;
      polynomial = 1U << bits | poly;
      start = round == 0 ? 0 : dice.below(1U << bits);
      const unsigned width = 10 + dice.below(20);
      program_begin(0, static_cast<std::uint16_t>(width), static_cast<std::uint16_t>(bits),
                    static_cast<std::uint16_t>(poly), static_cast<std::uint16_t>(start), kHalf);
      const std::uint64_t value = dice.below(1U << width);
      position(value, width);
      ASSERT_EQ(program_frame(kHalf), PM_BISSC_PASS) << bits << ' ' << poly << ' ' << start;
      EXPECT_EQ(encoder.position, value);
      bench.clocks(1000);
      char& bit = bench.slave.payload.at(1 + dice.below(width + 2));
      bit = bit == '1' ? '0' : '1';
      EXPECT_EQ(program_frame(kHalf), PM_BISSC_SCD_CRC_FAIL);
      EXPECT_EQ(encoder.position, value) << "keeps its values";
      bench.clocks(1000);
    }
  }
}

TEST_F(PmBissc, FrameWithoutStart_EndsByTheWatchdog) {
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  bench.drive_sl = [] { return true; };
  bench.write(biss_clb::regs::kAddrWatchdog, 400);
  EXPECT_EQ(program_frame(kHalf), PM_BISSC_DATA_INVALID);
  EXPECT_EQ(bench.rises.size(), 400U);
  bench.drive_sl = nullptr;
  bench.clocks(1000);
  EXPECT_EQ(program_frame(kHalf), PM_BISSC_PASS);
  EXPECT_EQ(encoder.position, 0x12345U);
  EXPECT_EQ(PM_bissc_receivePosition(&scd, &cd, &encoder), PM_BISSC_DATA_INVALID) << "once";
}

TEST_F(PmBissc, HaltOperation_ClearsBothTiles) {
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  PM_bissc_setupSCDTransaction(&scd);
  PM_bissc_startOperation(&scd, kHalf);
  bench.clocks(100);
  EXPECT_NE(bench.state(), 0U);
  PM_bissc_haltOperation();
  EXPECT_EQ(bench.state(), 0U);
  EXPECT_TRUE(bench.ma());
  for (const unsigned address : {0x40U, 0x44U, 0xC4U}) EXPECT_EQ(bench.read(address), 0U);
  EXPECT_EQ(bench.read(0xC0), 0x80U) << "CDM = 0";
  bench.clocks(1000);
  EXPECT_FALSE(scd.dataReady);
  EXPECT_EQ(program_frame(kHalf), PM_BISSC_PASS);
}

// The watchdog has ended a frame while interrupts were off, and a halt follows: the event is no
// frame's any more, and a level interrupt must not come for ever.
TEST_F(PmBissc, HaltWithAnEventThatWaits_InterruptGoesAway) {
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  bench.drive_sl = [] { return true; };
  bench.write(biss_clb::regs::kAddrWatchdog, 100);
  PM_bissc_setupSCDTransaction(&scd);
  PM_bissc_startOperation(&scd, kHalf);
  bench.clocks(200 * 2 * kHalf);
  ASSERT_TRUE(bench.irq());
  PM_bissc_haltOperation();
  bissc_spiRxISR();
  EXPECT_FALSE(bench.irq());
  EXPECT_FALSE(scd.dataReady);
  bench.drive_sl = nullptr;
  bench.clocks(1000);
  EXPECT_EQ(program_frame(kHalf), PM_BISSC_PASS);
}

// No pause between frames: the calls wait for the encoder.
TEST_F(PmBissc, FramesBackToBack_WaitForTheTimeout) {
  program_begin(12, 20, 6, 3, 0, kHalf);
  bench.slave.timeout = 3000;
  for (unsigned i = 0; i < 30; ++i) {
    bench.delay = 7 * i;
    position(0x1234'5670U + i, 32);
    ASSERT_EQ(program_frame(kHalf), PM_BISSC_PASS) << i;
    EXPECT_EQ(encoder.position, 0x1234'5670U + i);
  }
}

TEST_F(PmBissc, Register40_ReturnsWhatWasWrittenAndTheWordsAreOnTheLine) {
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  for (const unsigned value : {1U, 3U, 5U}) {
    EXPECT_EQ(
        program_access(PM_BISSC_REGISTER_WRITE, 0x40, static_cast<std::uint16_t>(value), kHalf),
        PM_BISSC_CD_WRITE_PASS);
    EXPECT_EQ(registers.bytes[0x40], value);
    EXPECT_EQ(program_access(PM_BISSC_REGISTER_READ, 0x40, 0, kHalf), PM_BISSC_CD_READ_PASS);
    EXPECT_EQ(reg.rxData, value);
    EXPECT_EQ(encoder.position, 0x12345U);
  }
  const std::vector<std::uint32_t> wanted{0xC4016038, 0xC401A000, 0xC4016074,
                                          0xC401A000, 0xC40160A0, 0xC401A000};
  EXPECT_EQ(registers.words, wanted);
}

// To the encoder a fall of MA at rest would be the begin of a frame. A low level that is no half
// period is that of CDM = 1, and follows a half period.
TEST_F(PmBissc, ControlBits_LetMaFallInFramesOnly) {
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  bench.rises.clear();
  bench.falls.clear();
  ASSERT_EQ(program_access(PM_BISSC_REGISTER_WRITE, 0x40, 0xA5, kHalf), PM_BISSC_CD_WRITE_PASS);
  ASSERT_GT(bench.rises.size(), 1000U);
  unsigned long_ones = 0;
  for (std::size_t i = 1; i < bench.rises.size(); ++i) {
    if (bench.rises[i] - bench.falls[i] == kHalf) continue;
    EXPECT_EQ(bench.falls[i] - bench.rises[i - 1], kHalf) << i;
    ++long_ones;
  }
  EXPECT_EQ(long_ones,
            static_cast<unsigned>(std::count(registers.all.begin(), registers.all.end(), true)));
}

TEST_F(PmBissc, EveryAddressAndByte_GoesThereAndBack) {
  program_begin(0, 13, 6, 3, 0, 4);
  bench.slave.timeout = 100;
  position(0x0E08, 13);
  mb4test::Dice dice;
  for (int round = 0; round < 12; ++round) {
    const auto address = static_cast<std::uint16_t>(dice.below(128));
    const auto value = static_cast<std::uint16_t>(dice.below(256));
    ASSERT_EQ(program_access(PM_BISSC_REGISTER_WRITE, address, value, 4), PM_BISSC_CD_WRITE_PASS);
    ASSERT_EQ(registers.bytes[address], value);
    ASSERT_EQ(program_access(PM_BISSC_REGISTER_READ, address, 0, 4), PM_BISSC_CD_READ_PASS);
    ASSERT_EQ(reg.rxData, value);
  }
}

// C-10, counted on the line.
TEST_F(PmBissc, ControlFramesBackToBack_Have14FramesWithoutBetween) {
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(program_access(i % 2 != 0 ? PM_BISSC_REGISTER_READ : PM_BISSC_REGISTER_WRITE, 0x41,
                             static_cast<std::uint16_t>(0x55 + i), kHalf) >>
                  1U,
              i % 2 != 0 ? 2U : 1U);
  }
  // START, 31 more bits, then zeros.
  unsigned zeros = 0, frames = 0;
  for (std::size_t i = 0; i < registers.all.size();) {
    if (!registers.all[i]) {
      ++zeros;
      ++i;
      continue;
    }
    EXPECT_GE(zeros, 14U) << i;
    ++frames;
    zeros = 0;
    i += 32;
  }
  EXPECT_EQ(frames, 5U);
}

struct Fault {
  const char* name;
  enum cdRegisterAccessType type;
  std::vector<std::size_t> flips;
  enum cdStatus status;
};
class PmBisscFault : public PmBissc, public testing::WithParamInterface<Fault> {};

TEST_P(PmBisscFault, Answer_GivesItsStatusAndTheNextAccessIsGood) {
  const Fault& fault = GetParam();
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  registers.bytes[0x40] = 0x5A;
  for (const std::size_t slot : fault.flips) registers.flips[slot] = true;
  reg.rxData = 0x777;
  EXPECT_EQ(program_access(fault.type, 0x40, 0xA5, kHalf), fault.status);
  EXPECT_EQ(reg.rxData, 0x777U) << "no data";
  registers.flips.clear();
  EXPECT_EQ(program_access(PM_BISSC_REGISTER_WRITE, 0x41, 0x3C, kHalf), PM_BISSC_CD_WRITE_PASS);
  EXPECT_EQ(program_access(PM_BISSC_REGISTER_READ, 0x41, 0, kHalf), PM_BISSC_CD_READ_PASS);
  EXPECT_EQ(reg.rxData, 0x3CU);
}

// Slots of CDS: 17 R, 18 W, 19 S, 20 to 27 data, 28 to 31 CRC.
INSTANTIATE_TEST_SUITE_P(
    Answers, PmBisscFault,
    testing::Values(
        Fault{"ReadNoS", PM_BISSC_REGISTER_READ, {19}, PM_BISSC_CD_READ_WRITE_UNSUPPORTED},
        Fault{"WriteNoS", PM_BISSC_REGISTER_WRITE, {19}, PM_BISSC_CD_READ_WRITE_UNSUPPORTED},
        Fault{"ReadBoth", PM_BISSC_REGISTER_READ, {18}, PM_BISSC_CD_READ_WRITE_INVALID},
        Fault{"WriteBoth", PM_BISSC_REGISTER_WRITE, {17}, PM_BISSC_CD_READ_WRITE_INVALID},
        Fault{"ReadNone", PM_BISSC_REGISTER_READ, {17}, PM_BISSC_CD_READ_FAIL},
        Fault{"WriteNone", PM_BISSC_REGISTER_WRITE, {18}, PM_BISSC_CD_WRITE_FAIL},
        Fault{"ReadAsWrite", PM_BISSC_REGISTER_READ, {17, 18}, PM_BISSC_CD_READ_FAIL},
        Fault{"ReadData", PM_BISSC_REGISTER_READ, {23}, PM_BISSC_CD_CRC_FAIL},
        Fault{"ReadCrc", PM_BISSC_REGISTER_READ, {31}, PM_BISSC_CD_CRC_FAIL},
        Fault{"WriteEcho", PM_BISSC_REGISTER_WRITE, {27}, PM_BISSC_CD_WRITE_FAIL},
        Fault{"WriteCrc", PM_BISSC_REGISTER_WRITE, {28}, PM_BISSC_CD_CRC_FAIL}),
    [](const auto& test) { return test.param.name; });

// Several calls in a frame change nothing; a broken frame ends the access and no other one.
TEST_F(PmBissc, CallsTwiceAndBrokenFrames_DoNotSendAWrongBit) {
  program_begin(0, 18, 6, 3, 0, kHalf);
  position(0x12345, 18);
  reg = {0x40, 0, 0x3C, PM_BISSC_REGISTER_WRITE};
  cd.cdState = PM_BISSC_CD_NEW_REQUEST;
  for (int i = 0; i < 100 && cd.cdState != PM_BISSC_CD_COMPLETE; ++i) {
    for (int twice = 0; twice < 3; ++twice) PM_bissc_doCDTasks(&cd, &reg);
    program_frame(kHalf);
  }
  bench.clocks(1000);  // the encoder's timeout
  ASSERT_EQ(registers.words.size(), 1U);
  EXPECT_EQ(registers.bytes[0x40], 0x3CU);
  cd.cdState = PM_BISSC_CD_NEW_REQUEST;
  for (int i = 0; i < 100 && cd.cdState != PM_BISSC_CD_TRANSMITTING; ++i) program_frame(kHalf);
  for (int i = 0; i < 5; ++i) program_frame(kHalf);
  bench.drive_sl = [] { return true; };
  bench.write(biss_clb::regs::kAddrWatchdog, 100);
  EXPECT_EQ(program_frame(kHalf), PM_BISSC_DATA_INVALID);
  bench.drive_sl = nullptr;
  EXPECT_EQ(cd.cdState, PM_BISSC_CD_COMPLETE);
  bench.clocks(1000);
  EXPECT_EQ(program_access(PM_BISSC_REGISTER_READ, 0x40, 0, kHalf), PM_BISSC_CD_READ_PASS);
  EXPECT_EQ(reg.rxData, 0x3CU);
}

// MA is the clock divided by 2 * div; values outside 1 to 2048 act as the next one.
TEST_F(PmBissc, Divider_IsThatOfMa) {
  for (const std::uint32_t div : {0U, 1U, 2U, 3U, 10U, 2047U, 2048U, 2049U, 0xFFFF'FFFFU}) {
    program_begin(0, 18, 6, 3, 0, kHalf);
    PM_bissc_setFreq(div);
    PM_bissc_setupSCDTransaction(&scd);
    PM_bissc_startOperation(&scd, div);
    std::vector<std::uint64_t> rises;
    bool before = bench.ma();
    for (const std::uint64_t begin = bench.now; rises.size() < 4 && bench.now - begin < 30'000;) {
      bench.clock();
      if (bench.ma() && !before) rises.push_back(bench.now);
      before = bench.ma();
    }
    ASSERT_EQ(rises.size(), 4U) << div;
    const std::uint64_t period = 2ULL * std::clamp(div, 1U, 2048U);
    for (std::size_t i = 1; i < rises.size(); ++i) {
      EXPECT_EQ(rises[i] - rises[i - 1], period) << div;
    }
    PM_bissc_haltOperation();
    bench.clocks(20'000);
  }
}

}  // namespace

extern "C" {

void pm_bissc_port_write(uint32_t offset, uint32_t value) { bench_now->write(offset, value); }
uint32_t pm_bissc_port_read(uint32_t offset) { return bench_now->read(offset); }
// 200 MHz.
uint32_t pm_bissc_port_now_us(void) { return static_cast<uint32_t>(bench_now->now / 200); }
void pm_bissc_program_wait(void) {
  bench_now->clock();
  if (bench_now->irq()) bissc_spiRxISR();
}
}
