// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The control channel of the judge against Tables 7 and 11 of the published text, the slots of the
// protocol, and R-P15 and R-P17.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/reference/pru/division.hpp"
#include "tests/unit/pru/judge_bench.hpp"

namespace {

using namespace pru_judge;
using namespace pru_judge_test;

// The worked examples of 3.2.4.2.11, 12 and 16, and of the facts.
TEST(PruJudgeCrc, WorkedExamples_AreRight) {
  EXPECT_EQ(remainder("10001100111", "10011"), "1101");
  EXPECT_EQ(control_crc("10001100111"), "0010");
  EXPECT_EQ(remainder("01010111", "10011"), "1011");
  EXPECT_EQ(control_crc("01010111"), "0100");
  EXPECT_EQ(remainder("0000000000101", "1000011"), "001111");
  EXPECT_EQ(position_crc("0000000000101"), "110000");
  // The frame of TIDM-1010's stimulus: 13 bits of position and nE = nW = 1.
  EXPECT_EQ(position_crc("0111000001000"
                         "11"),
            "101110");
  constexpr unsigned kBytes[][2] = {{0x00, 0xF}, {0x01, 0xC}, {0x06, 0x5}, {0x4C, 0xF}, {0x57, 0x4},
                                    {0x5F, 0xF}, {0x69, 0xA}, {0xA5, 0x4}, {0xFF, 0xB}};
  for (const auto& [byte, crc] : kBytes) {
    EXPECT_EQ(number(control_crc(binary(byte, 8))), crc) << byte;
    EXPECT_EQ(crc4(byte, 8), crc) << byte;
  }
}

TEST(PruJudgeCrc, EveryWord_IsAsByShiftRegister) {
  for (unsigned value = 0; value < 1 << 13; ++value) {
    const std::string bits = binary(value * 0x9E3779B97F4A7C15ULL, 1 + value % 64);
    ASSERT_EQ(position_crc(bits), crc6(bits)) << bits;
  }
  for (unsigned byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(number(control_crc(binary(byte, 8))), crc4(byte, 8));
  }
}

struct Access {
  std::uint32_t word;
  unsigned address;
  std::optional<unsigned> writes;
};

// What an encoder with ID 0 finds in a word: header, its CRC, R, W, S (protocol facts 3.1).
bool accepted(std::uint32_t word) {
  const unsigned header = word >> 21;
  const unsigned rws = word >> 14 & 7U;
  return (word >> 17 & 0xFU) == crc4(header, 11) && (rws == 5 || rws == 3);
}

// Table 7 with the two missing words of the facts; row 6 as it has to be.
const std::vector<Access>& table7() {
  static const std::vector<Access> kRows = {
      {0x889B4000, 0x44, {}}, {0x88BD4000, 0x45, {}}, {0x88D74000, 0x46, {}},
      {0x88F14000, 0x47, {}}, {0x8C174000, 0x60, {}}, {0x8C16C194, 0x60, 0x06},
      {0x8CE54000, 0x67, {}}, {0x8D014000, 0x68, {}}, {0x8F0B4000, 0x78, {}},
      {0x8F2D4000, 0x79, {}}, {0x8F474000, 0x7A, {}}, {0x8F614000, 0x7B, {}},
      {0x8F934000, 0x7C, {}}, {0x8FB54000, 0x7D, {}}, {0x8FDF4000, 0x7E, {}},
      {0x8FF94000, 0x7F, {}}};
  return kRows;
}

TEST(PruJudgeControl, WordsOfTable7_AreAccesses) {
  for (const Access& row : table7()) {
    EXPECT_TRUE(accepted(row.word)) << std::hex << row.word;
    EXPECT_EQ(row.word >> 21, 1U << 10 | row.address) << std::hex << row.word;
    const unsigned data = row.writes.value_or(0);
    const unsigned tail = row.writes ? data << 4 | crc4(data, 8) : 0;
    EXPECT_EQ(row.word & 0x3FFF, tail << 2) << std::hex << row.word;
  }
  EXPECT_FALSE(accepted(0x8C13C194));  // as printed
}

// An encoder of one ID: CDS of each slot after START, from the word that it has received.
std::string cds_of(std::uint32_t word, unsigned data) {
  if (!accepted(word)) return "01" + std::string(30, '0');
  const bool reads = (word >> 16 & 1U) != 0;
  const unsigned shown = reads ? data << 4 | crc4(data, 8) : word >> 2 & 0xFFFU;
  return "01" + std::string(15, '0') + (reads ? "10" : "01") + "1" + binary(shown, 12);
}

// Runs the frames of a word that is armed now: CDM of each frame from the one that takes it on.
std::string run_word(Bench& bench, const std::string& cds, unsigned frames) {
  std::string cdm;
  for (unsigned i = 0; i < frames; ++i) {
    const std::optional<unsigned> slot = bench.judge.control().slot();
    const FrameReport report =
        bench.frame({0, slot && *slot < cds.size() && cds[*slot] == '1', word(i, 12)});
    EXPECT_EQ(report.complaints, std::vector<std::string>());
    EXPECT_TRUE(report.good);
    cdm += report.cdm ? '1' : '0';
  }
  return cdm;
}

// R-P17: 14 frames with CDM = 0, START, bits 31..1, CDM = 0; flag and result at their frames.
TEST(PruJudgeControl, Word_IsSentBitByBit) {
  Bench bench;
  bench.start(12, 8, 5);
  const std::uint32_t value = 0x8CE54001;  // bit 0 is not sent
  const std::string cds = cds_of(0x8CE54000, 0x5F);
  bench.judge.write(kCtrlWord, value);
  EXPECT_EQ(run_word(bench, cds, 1), "0");
  EXPECT_EQ(bench.judge.value(kCtrlWord, 4), 0U);
  EXPECT_EQ(run_word(bench, cds, 14), std::string(14, '0'));
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdStartFlag, 0);
  EXPECT_EQ(run_word(bench, cds, 1), "1");
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdStartFlag, kCmdStartFlag);
  bench.judge.write(kIrqStatus, 0x1F);
  EXPECT_EQ(run_word(bench, cds, 30), binary(value >> 2, 30));
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdStartFlag, kCmdStartFlag);
  EXPECT_EQ(bench.judge.value(kCtrlResult, 4), 0U);
  EXPECT_EQ(bench.judge.picture().irq_status & kIrqControl, 0U);
  EXPECT_EQ(run_word(bench, cds, 1), "0");
  EXPECT_EQ(bench.judge.byte(kFlags) & (kCmdStartFlag | kCmdCrcErr), 0);
  EXPECT_EQ(bench.judge.value(kCtrlResult, 4), 0x5FU);
  EXPECT_EQ(bench.judge.byte(kCtrlCrc), 0xF);
  EXPECT_EQ(bench.judge.picture().irq_status & kIrqControl, unsigned{kIrqControl});
  EXPECT_EQ(run_word(bench, cds, 20), std::string(20, '0'));
}

// Table 11: 15 registers at four rates. CTRL_CRC is what an encoder sends behind its byte.
TEST(PruJudgeControl, ReadsOfTable11_GiveTheirBytes) {
  constexpr unsigned kTable11[][2] = {{0x44, 0x00}, {0x45, 0xD9}, {0x46, 0x01}, {0x47, 0x32},
                                      {0x60, 0x0B}, {0x67, 0x5F}, {0x68, 0x00}, {0x78, 0x46},
                                      {0x79, 0x3A}, {0x7A, 0xC0}, {0x7B, 0x0C}, {0x7C, 0x00},
                                      {0x7D, 0x01}, {0x7E, 0x57}, {0x7F, 0x41}};
  unsigned reads = 0;
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    Bench bench;
    bench.start(12, 8, mhz);
    for (const auto& [address, value] : kTable11) {
      for (const Access& access : table7()) {
        if (access.address != address || access.writes) continue;
        bench.judge.write(kCtrlWord, access.word);
        run_word(bench, cds_of(access.word, value), 48);
        EXPECT_EQ(bench.judge.value(kCtrlResult, 4), value) << address << " " << mhz;
        EXPECT_EQ(bench.judge.byte(kCtrlCrc), crc4(value, 8)) << address << " " << mhz;
        EXPECT_EQ(bench.judge.byte(kFlags) & kCmdCrcErr, 0) << address << " " << mhz;
        ++reads;
      }
    }
  }
  EXPECT_EQ(reads, 60U);
}

// P-8: the printed row 6 is refused, which the CRC of zeros tells; the right one echoes 0x06.
TEST(PruJudgeControl, RefusedWord_IsToldByCmdCrcErr) {
  Bench bench;
  bench.start(12, 8, 1);
  bench.judge.write(kIrqStatus, 0x1F);
  bench.judge.write(kCtrlWord, 0x8C13C194);
  run_word(bench, cds_of(0x8C13C194, 0), 47);
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdCrcErr, kCmdCrcErr);
  EXPECT_EQ(bench.judge.picture().irq_status & kIrqFlags, unsigned{kIrqFlags});
  run_word(bench, {}, 3);
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdCrcErr, kCmdCrcErr);  // of the last control frame
  bench.judge.write(kCtrlWord, 0x8C16C194);
  run_word(bench, cds_of(0x8C16C194, 0), 47);
  EXPECT_EQ(bench.judge.value(kCtrlResult, 4), 0x06U);
  EXPECT_EQ(bench.judge.byte(kCtrlCrc), 0x5);
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdCrcErr, 0);
}

// An encoder that waits with S is not waited for.
TEST(PruJudgeControl, EncoderThatWaits_GivesCmdCrcErr) {
  Bench bench;
  bench.start(12, 8, 1);
  bench.judge.write(kCtrlWord, 0x8CE54000);
  std::string cds = cds_of(0x8CE54000, 0x57);
  cds = cds.substr(0, 19) + "0" + cds.substr(19);  // one frame late
  run_word(bench, cds, 47);
  // S and seven bits of 0x57 are taken for data, then its last bit and 010 for the CRC.
  EXPECT_EQ(bench.judge.value(kCtrlResult, 4), 0xABU);
  EXPECT_EQ(bench.judge.byte(kCtrlCrc), 0xAU);
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdCrcErr, kCmdCrcErr);
}

// Byte 7 arms the word; 0 is none; a word written while one runs waits.
TEST(PruJudgeControl, ArmedWord_IsTakenAtTheEndOfAFrame) {
  Bench bench;
  bench.start(12, 8, 1);
  bench.judge.write(kCtrlWord, 0x8CE54000, 7);
  run_word(bench, {}, 2);
  EXPECT_FALSE(bench.judge.control().running());
  EXPECT_EQ(bench.judge.read(kCtrlWord), 0x00E54000U);
  bench.judge.write(kCtrlWord, 0x8CE54000, 8);
  EXPECT_FALSE(bench.judge.control().running());
  run_word(bench, {}, 1);
  EXPECT_TRUE(bench.judge.control().running());
  EXPECT_EQ(bench.judge.read(kCtrlWord), 0U);
  bench.judge.write(kCtrlWord, 0xFFFFFFFF);
  run_word(bench, {}, 45);
  EXPECT_EQ(bench.judge.read(kCtrlWord), 0xFFFFFFFFU);
  run_word(bench, {}, 1);  // the end of the first is the take of the second
  EXPECT_EQ(bench.judge.read(kCtrlWord), 0U);
  EXPECT_EQ(run_word(bench, {}, 50), std::string(14, '0') + std::string(32, '1') + "0000");
  bench.judge.write(kCtrlWord, 0);
  run_word(bench, {}, 1);
  EXPECT_FALSE(bench.judge.control().running());
}

// R-P15: a frame without MA takes no bit, one without acknowledge takes one and its CDS reads 0.
TEST(PruJudgeControl, FrameWithoutMa_TakesNoBit) {
  Bench bench;
  bench.start(12, 8, 1);
  bench.judge.write(kCtrlWord, 0x8CE54000);
  const std::string cds = cds_of(0x8CE54000, 0xFF);
  run_word(bench, cds, 1 + 10);
  bench.frame_without_ma();
  run_word(bench, cds, 4);
  EXPECT_TRUE(bench.judge.control().cdm());  // START is next
  bench.frame_without_ma();
  EXPECT_TRUE(bench.judge.control().cdm());
  EXPECT_EQ(bench.judge.byte(kFlags), kNoSlaveFlag | kSmaFlag);
  run_word(bench, cds, 24);
  bench.frame_without_ma();
  EXPECT_EQ(bench.judge.byte(kFlags), kNoSlaveFlag | kSmaFlag | kCmdStartFlag);
  ASSERT_EQ(bench.judge.control().slot(), 24U);
  Answer silent;
  silent.acknowledges = false;
  bench.frame(silent);
  run_word(bench, cds, 7);
  EXPECT_EQ(bench.judge.value(kCtrlResult, 4), 0xF7U);
  EXPECT_EQ(bench.judge.byte(kFlags) & kCmdCrcErr, kCmdCrcErr);
}

}  // namespace
