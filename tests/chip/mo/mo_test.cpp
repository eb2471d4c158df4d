// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bus connection on the whole chip: pages 15, 25 (Tables 17, 18), 31 (Tables 39, 40).
#include <gtest/gtest.h>

#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/protocol_chip.hpp"

namespace {

using mb4test::ChipPlan;
using mb4test::ProtocolChip;
using mb4test::to_bits;
using mb4test::valid;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr const char* kBus = "mo = true\n";

std::string channel(unsigned number, const std::string& keys = kBus) {
  return "[[channel]]\nnumber = " + std::to_string(number) + "\n" + keys;
}
std::string sensor(unsigned bits, std::uint64_t word, const std::string& keys = "") {
  return "[[channel.slave]]\nprotocol = \"biss-c\"\nflag_bits = 0\ndata_bits = " +
         std::to_string(bits) + "\ndata = " + std::to_string(word) + "\n" + keys;
}
std::string actuator(unsigned bits, bool stop_bit = true, const std::string& keys = "") {
  return "[[channel.slave]]\nprotocol = \"biss-c\"\nactuator = true\ndata_bits = " +
         std::to_string(bits) + "\nstop_bit = " + (stop_bit ? "true" : "false") + "\n" + keys;
}

// One actuator slot: stop bit, data, inverted CRC of x^6 + x + 1 (long division in bits.hpp).
std::string slot(std::uint64_t word, unsigned bits, bool stop_bit) {
  return (stop_bit ? "0" : "") + mb4test::word_on_line(word, bits, {6, 0x43}, 0);
}

// Level of MO after each rising edge of MA, from the first on.
std::string mo_by_slot(const ProtocolChip& chip, unsigned line, bool before) {
  std::string text;
  std::size_t next = 0;
  bool level = before;
  for (const auto& edge : chip.ma[line]) {
    if (!edge.level) continue;
    while (next < chip.mo[line].size() && chip.mo[line][next].time <= edge.time) {
      level = chip.mo[line][next++].level;
    }
    text += level ? '1' : '0';
  }
  return text;
}

void write_both_banks(ProtocolChip& chip, unsigned x, std::uint64_t word) {
  chip.write_scdata(x, word);
  chip.instruct(reg::SWBANK::kMask);  // SWBANK
  chip.advance_us(1);
  chip.write_scdata(x, word);
  chip.instruct(0);
  chip.advance_us(1);
}

// Page 31: the waveform of MO, slot by slot.
TEST(ChipMo, Waveform_IsAcknowledgeBusyStartCdsWords) {
  for (const unsigned busy : {0U, 1U, 2U, 15U, 16U, 255U}) {
    ProtocolChip chip(channel(1) + actuator(12) + sensor(9, 0x155) + actuator(8, false),
                      {.freqs = 4, .en_mo = true, .mo_busy = busy});
    write_both_banks(chip, 1, 0xA5C);
    write_both_banks(chip, 3, 0xE7);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMo1));
    ASSERT_TRUE(chip.frame());
    // MO after rising edge 1: still idle; 2: acknowledge; 3 + MO_BUSY: start bit; then CDS = 0, the
    // words, and 1.
    EXPECT_EQ(mo_by_slot(chip, 0, true), "1" + std::string(1 + busy, '0') + "10" +
                                             slot(0xA5C, 12, true) + std::string(15, '0') +
                                             slot(0xE7, 8, false) + "1");
    // MO changes with rising edges of MA only.
    for (const auto& mo : chip.mo[0]) {
      bool with_edge = false;
      for (const auto& ma : chip.ma[0]) with_edge = with_edge || (ma.level && ma.time == mo.time);
      EXPECT_TRUE(with_edge) << mo.time;
    }
    EXPECT_EQ(chip.scdata(2, 9), 0x155U);
    EXPECT_EQ(chip.svalid(), valid({2}));
    EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), 0xA5CU);
    EXPECT_EQ(clocked(chip.simulator.slave(3))->actuator()->word(), 0xE7U);
  }
}

// The same in BiSS B, which has no CDS; what the slave makes of the word does not matter here.
TEST(ChipMo, WaveformInBissB_IsAcknowledgeBusyStartWords) {
  for (const bool acts : {false, true}) {
    for (const unsigned busy : {0U, 3U}) {
      ProtocolChip chip(channel(1) + "[[channel.slave]]\nprotocol = \"biss-b\"\ndata_bits = 9\n",
                        {.freqs = 4, .biss_c_registers = false, .en_mo = true, .mo_busy = busy});
      if (acts) {
        chip.write(reg::kAddrActnsens, {reg::ACTnSENS<1>::kMask});  // ACTnSENS1
        write_both_banks(chip, 1, 0x155);
      }
      std::string slots(1, '1');
      slots += std::string(1 + busy, '0');
      slots += '1';
      slots += acts ? slot(0x155, 9, false) : std::string(15, '0');
      slots += '1';
      for (unsigned i = 0; i < 3; ++i) {
        ASSERT_TRUE(chip.frame());
        EXPECT_EQ(mo_by_slot(chip, 0, true), slots);
      }
    }
  }
}

// docs/choices.md, MO: BiSS B at f_CLK / 2 with MO_BUSY = 0 has time for six words. The slots of a
// longer chain are undefined, but its frames end: MO does not stay 0, which the slaves would pass
// on.
TEST(ChipMo, LongChainInBissBWithoutProcessingTime_FramesEnd) {
  for (unsigned slaves = 6; slaves <= 8; ++slaves) {
    for (unsigned long_one = 0; long_one < slaves; ++long_one) {
      std::string scenario = channel(1);
      for (unsigned i = 0; i < slaves; ++i)
        scenario += "[[channel.slave]]\nprotocol = \"biss-b\"\nflag_bits = 0\ndata_bits = " +
                    std::to_string(i == long_one ? 64 : 3) + "\n";
      for (const unsigned acts : {0x00U, 0x01U, 0x40U, 0x55U, 0xFFU}) {
        ProtocolChip chip(scenario, {.freqs = 0, .biss_c_registers = false, .en_mo = true});
        chip.write(reg::kAddrActnsens, {static_cast<std::uint8_t>(acts)});
        for (unsigned x = 1; x <= slaves; ++x) write_both_banks(chip, x, 0);
        for (unsigned i = 0; i < 3; ++i)
          ASSERT_TRUE(chip.frame()) << slaves << " slaves, the long one is " << long_one
                                    << ", ACTnSENS " << acts << ", frame " << i;
      }
    }
  }
}

TEST(ChipMo, EnMoOff_HoldsMoLow) {
  ProtocolChip chip(channel(1) + sensor(12, 0xA5C), {.freqs = 4, .mo_busy = 7});
  ASSERT_TRUE(chip.frame());
  EXPECT_TRUE(chip.mo[0].empty());
  EXPECT_FALSE(chip.simulator.pin(sim::Pin::kMo1));
  EXPECT_FALSE(chip.simulator.pin(sim::Pin::kMo2));
  EXPECT_EQ(chip.scdata(1, 12), 0xA5CU);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising,
            12U + 6 + 5);
}

// Every position in chains of 1 to 8, beside sensors and among actuators, without and with a cable
// whose MO is late.
class MoChains : public testing::TestWithParam<std::tuple<unsigned, bool>> {};

TEST_P(MoChains, EveryPosition_GetsExactlyWhatTheHostWrote) {
  const auto [length, cable] = GetParam();
  for (unsigned position = 0; position <= length; ++position) {  // length: all are actuators
    std::string text = channel(1, cable ? "mo = true\ndelay_ns = 730\nmo_delay_ns = 385\n" : kBus);
    for (unsigned i = 0; i < length; ++i) {
      const bool is_actuator = position == length || i == position;
      text += is_actuator ? actuator(3 + 7 * i, i == 0 || i % 2 == 1) : sensor(5 + 6 * i, 9 + i);
    }
    ProtocolChip chip(text, {.freqs = 0, .en_mo = true, .mo_busy = length});
    std::uint64_t seed = 0x9E3779B97F4A7C15ULL;
    for (unsigned frame = 1; frame <= 4; ++frame) {
      for (unsigned i = 0; i < length; ++i) {
        if (position == length || i == position) write_both_banks(chip, i + 1, seed + i * frame);
      }
      ASSERT_TRUE(chip.frame());
      unsigned valid = 0;
      for (unsigned i = 0; i < length; ++i) {
        const auto* received = clocked(chip.simulator.slave(i + 1))->actuator();
        if (received != nullptr) {
          const unsigned bits = 3 + 7 * i;
          EXPECT_EQ(received->word(), (seed + i * frame) & ((1ULL << bits) - 1)) << position;
          EXPECT_EQ(received->words(), frame);
          EXPECT_EQ(received->crc_errors() + received->stop_errors(), 0U);
        } else {
          valid |= 2U << (2 * i);
          EXPECT_EQ(chip.scdata(i + 1, 5 + 6 * i), 9U + i) << position;
        }
      }
      EXPECT_EQ(chip.svalid(), valid) << position;
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
      seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Length, MoChains,
                         testing::Combine(testing::Range(1U, 9U), testing::Bool()),
                         [](const auto& entry) {
                           return std::to_string(std::get<0>(entry.param)) +
                                  (std::get<1>(entry.param) ? "SlavesCable" : "Slaves");
                         });

// Every length, CRC and start value of one actuator.
TEST(ChipMo, EveryLengthAndCrc_ArrivesWithTheRightCrc) {
  constexpr std::uint32_t kPolynomials[] = {0, 0xB, 0x13, 0x25, 0x43, 0x89, 0x12F, 0x190D9, 0x97};
  unsigned turn = 0;
  for (unsigned bits = 1; bits <= 64; ++bits) {
    const std::uint32_t polynomial = kPolynomials[turn++ % std::size(kPolynomials)];
    const unsigned start = polynomial == 0 ? 0 : (turn * 0x2B5U) & 0xFFFF;
    ProtocolChip chip(channel(1) + actuator(bits, true,
                                            "crc = " + std::to_string(polynomial) +
                                                "\ncrc_start = " + std::to_string(start) + "\n"),
                      {.freqs = 1, .en_mo = true});
    const std::uint64_t word = 0xA5C396F05A3C69E1ULL >> (64 - bits);
    write_both_banks(chip, 1, word);
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), word)
        << bits << " " << polynomial;
    EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->words(), 1U)
        << bits << " " << polynomial;
  }
}

// The design review of an older revision: both channels with different lengths and either CDM.
TEST(ChipMo, BothChannelsWithDifferentLengths_AndBothCdm) {
  for (const bool cdm : {false, true}) {
    ProtocolChip chip(channel(1) + actuator(8) + sensor(24, 0xC0FFEE) + channel(2) +
                          sensor(40, 0x123456789A) + actuator(48, true),
                      {.freqs = 3, .en_mo = true, .mo_busy = 3});
    for (unsigned frame = 1; frame <= 5; ++frame) {
      write_both_banks(chip, 1, 0x30 + frame);
      write_both_banks(chip, 6, 0xA1B2C3D4E5F6ULL * frame);
      ASSERT_TRUE(chip.frame(cdm ? reg::kInstrCdm1 : reg::kInstrCdm0));
      EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), 0x30U + frame);
      EXPECT_EQ(clocked(chip.simulator.slave(6))->actuator()->word(),
                (0xA1B2C3D4E5F6ULL * frame) & 0xFFFFFFFFFFFFULL);
      EXPECT_EQ(chip.scdata(2, 24), 0xC0FFEEU);
      EXPECT_EQ(chip.scdata(5, 40), 0x123456789AULL);
      EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), cdm);
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
    }
  }
}

// Page 25: what the host writes goes out in the frame after the next switch of the banks, for the
// actuators of both halves of the memory and of both lines.
TEST(ChipMo, HostWritesItsBank_TheNextSwitchHandsItOver) {
  for (const unsigned x : {1U, 4U, 5U, 8U, 15U}) {  // 15: slave 5 on line 2
    std::string text = channel(1);
    for (unsigned i = 1; i < (x == 15 ? 4 : x); ++i) text += sensor(2, 1);
    if (x < 9) text += actuator(16);
    if (x == 15) text += channel(2) + actuator(16);
    ProtocolChip chip(text, {.freqs = 3, .en_mo = true});
    const unsigned channel_number = x == 15 ? 5 : x;
    const auto* received = clocked(chip.simulator.slave(channel_number))->actuator();
    chip.write_scdata(channel_number, 0x1111);
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(received->word(), 0U) << x;
    chip.write_scdata(channel_number, 0x2222);
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(received->word(), 0x1111U) << x;
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(received->word(), 0x2222U) << x;
    chip.write(reg::kAddrBankcfg, {reg::kSinglebankOneBank});  // SINGLEBANK
    chip.write_scdata(channel_number, 0x3333);
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(received->word(), 0x3333U) << x;
  }
}

// A cable longer than the frame: MA has to stop with the last bit of MO all the same.
TEST(ChipMo, CableLongerThanTheFrame_WordArrives) {
  for (const double delay_ns : {900.0, 2500.0, 10'000.0}) {
    ProtocolChip chip(channel(1, "mo = true\ndelay_ns = " + std::to_string(delay_ns) + "\n") +
                          sensor(8, 0x5A) + actuator(8),
                      {.freqs = 0, .en_mo = true});
    write_both_banks(chip, 2, 0xC3);
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(clocked(chip.simulator.slave(2))->actuator()->word(), 0xC3U) << delay_ns;
    EXPECT_EQ(clocked(chip.simulator.slave(2))->actuator()->words(), 1U) << delay_ns;
    EXPECT_EQ(chip.scdata(1, 8), 0x5AU) << delay_ns;
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising,
              8U + 6 + 1 + 8 + 6 + 5)
        << delay_ns;
  }
}

// Sensors alone on such a cable, or some that do not listen to MO and process longer than mo_busy:
// MA goes on until the start bit is back and the words are in (decision 17), and MO has to stay 0
// meanwhile. A 1 would run through the slaves after the data and look like their timeout.
TEST(ChipMo, SensorsThatAnswerLate_SeeNoHighLevelAfterTheirSlots) {
  struct Case {
    double delay_ns;
    const char* channel_keys;
    const char* slave_keys;
  };
  for (const auto& [delay_ns, channel_keys, slave_keys] :
       {Case{900.0, kBus, ""}, Case{2500.0, kBus, ""}, Case{10'000.0, kBus, ""},
        Case{100.0, "", "busy_periods = 20\n"}}) {
    for (const bool cdm : {false, true}) {
      ProtocolChip chip(
          channel(1, std::string(channel_keys) + "delay_ns = " + std::to_string(delay_ns) + "\n") +
              sensor(8, 0x5A, slave_keys) + sensor(5, 0x15, slave_keys),
          {.freqs = 0, .en_mo = true, .mo_busy = 1});
      for (unsigned frame = 1; frame <= 3; ++frame) {
        ASSERT_TRUE(chip.frame(cdm ? reg::kInstrCdm1 : reg::kInstrCdm0));
        EXPECT_EQ(chip.scdata(1, 8), 0x5AU) << delay_ns;
        EXPECT_EQ(chip.scdata(2, 5), 0x15U) << delay_ns;
        EXPECT_EQ(chip.status(), reg::kResetStatus0) << delay_ns;
        EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), cdm) << delay_ns;
        EXPECT_EQ(clocked(chip.simulator.slave(2))->last_cdm(), cdm) << delay_ns;
        EXPECT_EQ(clocked(chip.simulator.slave(1))->cdm_count(), frame) << delay_ns;
        // 0 with the acknowledge, the start bit, 0 up to the last rising edge at least.
        ASSERT_EQ(chip.mo[0].size(), 4U) << delay_ns;
        const auto& ma = chip.ma[0];
        sim::Time last_rise = 0;
        for (std::size_t i = 0; i < ma.size(); ++i) {
          const bool clock = i == 0 || ma[i].time - ma[i - 1].time == chip.t_ma / 2;
          if (ma[i].level && clock) last_rise = ma[i].time;
        }
        EXPECT_GE(chip.mo[0][3].time, last_rise) << delay_ns;
        EXPECT_GT(last_rise, chip.mo[0][2].time + (8 + 6 + 5 + 6) * chip.t_ma / 2) << delay_ns;
      }
      // Frames follow each other, and the chip takes no other 1 on SL for the timeout.
      chip.instruct(reg::kAgsOn);
      chip.advance_us(400);
      EXPECT_EQ(chip.svalid(), valid({1, 2})) << delay_ns;
      EXPECT_EQ(chip.status() & ~reg::EOT::kMask, reg::kResetStatus0 & ~reg::EOT::kMask)
          << delay_ns;
      EXPECT_EQ(chip.simulator.slave(1)->frames(), chip.simulator.slave(2)->frames());
      EXPECT_GT(chip.simulator.slave(1)->frames(), 8U) << delay_ns;
    }
  }
}

// docs/choices.md: MO changes with rising edges of MA, and at the end of the frame. Sensors alone
// on cables and with processing times of the chip of any length, so that MA ends at each place of
// what MO sends.
TEST(ChipMo, ChangesWithRisingEdgesOfMaAlone) {
  for (unsigned delay = 0; delay <= 3000; delay += 150) {
    for (unsigned mo_busy = 1; mo_busy <= 40; ++mo_busy) {
      ProtocolChip chip(
          channel(1, "delay_ns = " + std::to_string(delay) + ".0\n") + sensor(8, 0x5A, ""),
          {.freqs = 0, .en_mo = true, .mo_busy = static_cast<std::uint8_t>(mo_busy)});
      ASSERT_TRUE(chip.frame(reg::kInstrCdm1));
      const auto& mo = chip.mo[0];
      ASSERT_FALSE(mo.empty());
      EXPECT_TRUE(mo.back().level);
      for (std::size_t i = 0; i + 1 < mo.size(); ++i) {
        EXPECT_TRUE(std::any_of(chip.ma[0].begin(), chip.ma[0].end(),
                                [&](const auto& ma) { return ma.level && ma.time == mo[i].time; }))
            << delay << " ns, " << mo_busy << " periods, change " << i;
      }
    }
  }
}

// --- INIT in BiSS C (decision 39) -------------------------------------------------------------

constexpr sim::Time kSlaveTimeout = 40 * sim::kPsPerUs;  // the longest in the field
const char* const kKinds[] = {"latched", "passed-on"};

std::string sensors(unsigned count, const std::string& kind, const std::string& timeout) {
  std::string text;
  for (unsigned i = 0; i < count; ++i) {
    text += sensor(9 + i, 0x155 + i, "acknowledge = \"" + kind + "\"\ntimeout = " + timeout + "\n");
  }
  return text;
}

// Decision 2: sampling points after the second rising edge, up to the first that reads 0, which SL
// reaches `delay` after that edge.
unsigned quarters(sim::Time delay, sim::Time t_ma) {
  return static_cast<unsigned>(delay / (t_ma / 4) + 1);
}

// Frames right after INIT, without a pause: the first one together with it.
void check_init_and_frames(ProtocolChip& chip, unsigned lines, unsigned count, sim::Time delay,
                           const std::string& trace) {
  SCOPED_TRACE(trace);
  ASSERT_TRUE(chip.run(reg::kInitStart | reg::kInstrCdm0));  // INIT, then a frame with CDM = 0
  for (unsigned i = 0; i < lines; ++i) {
    ASSERT_GE(chip.ma[i].size(), 4U);
    const sim::Time second = chip.ma[i][3].time;
    const sim::Time frame = chip.ma[i][4].time;
    ASSERT_GE(chip.mo[i].size(), 2U);
    EXPECT_EQ(chip.mo[i][0].time, second) << "falls with rising edge 2";
    EXPECT_TRUE(chip.mo[i][1].level);
    EXPECT_GE(chip.mo[i][1].time, second + kSlaveTimeout) << "all slaves have timed out";
    EXPECT_LT(chip.mo[i][1].time, frame) << "1 again before the next frame";
    EXPECT_LT(frame - second, 1024 * chip.t_ma) << "SL ends INIT, not the limit";
    for (unsigned x = 1; x <= count; ++x) {
      EXPECT_EQ(chip.scdata(4 * i + x, 8 + x), 0x154U + x);
      EXPECT_EQ(chip.simulator.slave(4 * i + x)->frames(), 1U);
    }
  }
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  chip.simulator.advance(kSlaveTimeout + delay);
  ASSERT_TRUE(chip.run(reg::kInitStart));
  for (unsigned i = 0; i < lines; ++i) {
    EXPECT_EQ(chip.scdata(4 * i + 1, 8), quarters(delay, chip.t_ma));
    EXPECT_TRUE(chip.simulator.pin(i == 0 ? sim::Pin::kMo1 : sim::Pin::kMo2));
    EXPECT_TRUE(chip.simulator.pin(i == 0 ? sim::Pin::kSl1 : sim::Pin::kSl2));
  }
  EXPECT_EQ(chip.svalid(), 0U) << "decision 35";
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
}

// Both kinds of slaves acknowledge, at every delay in steps of one clock.
TEST(ChipMoInit, EveryDelay_AcknowledgeCountAndFramesBehindIt) {
  for (const char* kind : kKinds) {
    for (const unsigned count : {1U, 3U}) {
      for (const unsigned freqs : {0U, 2U}) {
        for (unsigned step = 0; step <= 2 * mb4test::ma_clocks(freqs) + 3; ++step) {
          const sim::Time delay = step * ProtocolChip::kClk;
          std::string text;
          for (unsigned line = 1; line <= 2; ++line) {
            text += channel(line, "mo = true\ndelay_ns = " + std::to_string(50 * step) + "\n") +
                    sensors(count, kind, "40.0");
          }
          ProtocolChip chip(text, {.freqs = freqs, .en_mo = true, .freqags = 0x7F});
          check_init_and_frames(chip, 2, count, delay,
                                std::string(kind) + " " + std::to_string(count) + " freqs " +
                                    std::to_string(freqs) + " step " + std::to_string(step));
        }
      }
    }
  }
}

// MO later than MA, in steps of one clock up to a period: slaves that pass it on acknowledge when
// it falls, the others do not wait for it.
TEST(ChipMoInit, MoLaterThanMa_CountIsThatOfTheSlavesKind) {
  for (const char* kind : kKinds) {
    for (unsigned step = 0; step <= 10; ++step) {
      const unsigned mo_ns = 100 + 50 * step;
      ProtocolChip chip(
          channel(1, "mo = true\ndelay_ns = 200\nmo_delay_ns = " + std::to_string(mo_ns) + "\n") +
              sensors(3, kind, "\"adaptive\""),
          {.freqs = 4, .en_mo = true, .freqags = 0x7F});
      ASSERT_TRUE(chip.run(reg::kInitStart));
      const unsigned ns = (kind == kKinds[1] ? mo_ns : 100) + 100;
      EXPECT_EQ(chip.scdata(1, 8), quarters(ns * sim::kPsPerNs, chip.t_ma)) << kind << " " << mo_ns;
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
    }
  }
}

// A frame at every phase after INIT's end, in steps of one clock.
TEST(ChipMoInit, FrameAtEveryPhaseAfterIt) {
  for (const char* kind : kKinds) {
    ProtocolChip chip(channel(1, "mo = true\ndelay_ns = 730\n") + sensors(3, kind, "40.0"),
                      {.freqs = 1, .en_mo = true, .freqags = 0x7F});
    for (unsigned phase = 0; phase < 40; ++phase) {
      ASSERT_TRUE(chip.run(reg::kInitStart)) << kind << " " << phase;
      chip.simulator.advance(phase * ProtocolChip::kClk);
      ASSERT_TRUE(chip.frame()) << kind << " " << phase;
      EXPECT_EQ(chip.svalid(), valid({1, 2, 3})) << kind << " " << phase;
      for (unsigned x = 1; x <= 3; ++x) EXPECT_EQ(chip.scdata(x, 8 + x), 0x154U + x);
      EXPECT_EQ(chip.status(), reg::kResetStatus0) << kind << " " << phase;
    }
  }
}

// Page 33: BREAK at every clock of INIT. MO is 1 again, and what follows works.
TEST(ChipMoInit, BreakAtEveryPhase_ReturnsMo) {
  for (const char* kind : kKinds) {
    ProtocolChip chip(channel(1) + sensors(3, kind, "\"adaptive\""),
                      {.freqs = 1, .en_mo = true, .freqags = 0x7F});
    for (unsigned phase = 0; phase < 60; ++phase) {
      chip.instruct(reg::kInitStart);
      chip.simulator.advance(phase * ProtocolChip::kClk);
      chip.instruct(reg::kBreakAbort);
      chip.advance_us(45);
      EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMo1)) << kind << " " << phase;
      ASSERT_TRUE(chip.frame(reg::kInitStart | reg::kInstrCdm0)) << kind << " " << phase;
      EXPECT_EQ(chip.svalid(), valid({1, 2, 3})) << kind << " " << phase;
      EXPECT_EQ(chip.status(), reg::kResetStatus0) << kind << " " << phase;
    }
  }
}

// BREAK and INIT in one byte, at any time of a frame: MO takes part in this INIT, so that slaves
// that pass it on acknowledge.
TEST(ChipMoInit, BreakAndInitInOneByte_MoTakesPart) {
  for (const char* kind : kKinds) {
    ProtocolChip chip(channel(1) + sensors(3, kind, "\"adaptive\""),
                      {.freqs = 1, .en_mo = true, .freqags = 0x7F});
    for (unsigned phase = 0; phase < 200; ++phase) {
      chip.instruct(reg::kInstrCdm0);
      chip.simulator.advance(phase * ProtocolChip::kClk);
      chip.instruct(reg::kBreakAbort | reg::kInitStart);
      chip.advance_us(300);
      EXPECT_EQ(chip.status(), reg::kResetStatus0) << kind << " " << phase;
      ASSERT_TRUE(chip.frame()) << kind << " " << phase;
      EXPECT_EQ(chip.svalid(), valid({1, 2, 3})) << kind << " " << phase;
    }
  }
}

// EN_MO counts from the next frame (docs/choices.md): cleared within one, the actuator still gets
// the word that the host wrote.
TEST(ChipMo, EnMoClearedInAFrame_WordArrives) {
  ProtocolChip chip(channel(1) + actuator(40) + sensor(9, 0x155),
                    {.freqs = 1, .en_mo = true, .freqags = 0x7F});
  constexpr std::uint64_t kWord = 0x12'3456'789A;
  write_both_banks(chip, 1, kWord);
  const std::uint8_t ctrl = chip.read(reg::kAddrCtrl);
  for (unsigned phase = 40; phase < 300; ++phase) {
    const auto words = clocked(chip.simulator.slave(1))->actuator()->words();
    chip.write(reg::kAddrCtrl, {ctrl});
    chip.advance_us(40);
    chip.instruct(reg::kInstrCdm0);
    chip.simulator.advance(phase * ProtocolChip::kClk);
    chip.write(reg::kAddrCtrl, {static_cast<std::uint8_t>(ctrl & ~reg::kEnMoData)});
    ASSERT_TRUE(chip.wait_eot()) << phase;
    chip.advance_us(40);  // the actuator takes the word in its timeout
    EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->words(), words + 1) << phase;
    EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), kWord) << phase;
  }
}

// EN_MO = 0, or a chain that is not wired to MO: the last slave shows the timeout, INIT ends with
// it.
TEST(ChipMoInit, MoNotInUse_EndsWithTheSlavesTimeout) {
  for (const char* kind : kKinds) {
    for (const bool en_mo : {false, true}) {
      for (const bool wired : {false, true}) {
        if (en_mo && wired) continue;
        for (unsigned step = 0; step < 20; ++step) {
          const sim::Time delay = step * ProtocolChip::kClk;
          ProtocolChip chip(channel(1, std::string("mo = ") + (wired ? "true" : "false") +
                                           "\ndelay_ns = " + std::to_string(50 * step) + "\n") +
                                sensors(3, kind, "20.0"),
                            {.freqs = 1, .en_mo = en_mo, .freqags = 0x7F});
          ASSERT_TRUE(chip.run(reg::kInitStart));
          const sim::Time second = chip.ma[0].at(3).time;
          const sim::Time end = second + 20 * sim::kPsPerUs + delay;
          EXPECT_GE(chip.simulator.now(), end);
          EXPECT_LE(chip.simulator.now(), end + 3 * chip.t_ma) << kind << " " << step;
          EXPECT_EQ(chip.scdata(1, 8), quarters(delay, chip.t_ma)) << kind << " " << step;
          EXPECT_EQ(chip.mo[0].size(), en_mo ? 2U : 0U);
          EXPECT_EQ(chip.simulator.pin(sim::Pin::kMo1), en_mo);
          ASSERT_TRUE(chip.frame());
          EXPECT_EQ(chip.svalid(), valid({1, 2, 3})) << kind << " " << step;
          EXPECT_EQ(chip.status(), reg::kResetStatus0);
        }
      }
    }
  }
}

// Frames with either kind, and with both in one chain, at every delay in steps of one clock.
TEST(ChipMo, FramesWithBothKindsOfAcknowledge) {
  for (const unsigned kinds : {0U, 7U, 2U, 5U}) {
    for (unsigned step = 0; step < 20; ++step) {
      std::string text = channel(1, "mo = true\ndelay_ns = " + std::to_string(50 * step) + "\n");
      const auto kind = [&](unsigned i) {
        return std::string("acknowledge = \"") + kKinds[kinds >> i & 1U] + "\"\n";
      };
      text += sensor(9, 0x155, kind(0)) + actuator(8, true, kind(1)) + sensor(12, 0xABC, kind(2));
      ProtocolChip chip(text, {.freqs = 1, .en_mo = true, .mo_busy = step % 4});
      for (unsigned frame = 1; frame <= 3; ++frame) {
        write_both_banks(chip, 2, 0x30 + frame);
        ASSERT_TRUE(chip.frame()) << kinds << " " << step;
        EXPECT_EQ(clocked(chip.simulator.slave(2))->actuator()->word(), 0x30U + frame);
        EXPECT_EQ(chip.scdata(1, 9), 0x155U) << kinds << " " << step;
        EXPECT_EQ(chip.scdata(3, 12), 0xABCU) << kinds << " " << step;
        EXPECT_EQ(chip.svalid(), valid({1, 3})) << kinds << " " << step;
        EXPECT_EQ(chip.status(), reg::kResetStatus0) << kinds << " " << step;
      }
    }
  }
}

// Control communication works on a bus: slave N has ID 0 (page 27).
TEST(ChipMo, RegisterAccessOnABus) {
  ProtocolChip chip(channel(1) + sensor(8, 0x5A, "registers = { 0x44 = 0x11 }\n") +
                        actuator(8, true, "registers = { 0x44 = 0x22 }\n"),
                    {.freqs = 0, .en_mo = true, .mo_busy = 2});
  mb4test::ControlHost host(chip);
  for (const unsigned id : {0U, 1U}) {
    host.set_read(id, 0x44, 1);
    chip.write(reg::kAddrCtrl,
               {static_cast<std::uint8_t>(reg::kCtsRegisterAccess | reg::kRegversBissC |
                                          reg::kEnMoData | reg::SLAVEID::of(id))});
    ASSERT_TRUE(host.run_ags(100'000));
    EXPECT_EQ(host.rdata(1)[0], id == 0 ? 0x22 : 0x11);
    EXPECT_EQ(host.status() & (reg::nAGSERR::kMask | reg::nDELAYERR::kMask | reg::nSCDERR::kMask |
                               reg::nREGERR::kMask | reg::REGEND::kMask),
              unsigned{reg::kNagserrGood | reg::kNdelayerrGood | reg::kNscderrGood |
                       reg::kNregerrGood | reg::kRegendDone});
    chip.instruct(0);
    chip.advance_us(100);
  }
}

// Page 16, figure 13, decision 39: INIT of BiSS C with EN_MO = 1 asks for the acknowledge as a
// frame does: MO falls with rising edge 2 of MA and is 1 again at the end of INIT.
TEST(ChipMo, Init_MoFallsWithTheSecondRisingEdge) {
  for (const unsigned freqs : {0U, 4U, 0x13U}) {
    for (const bool two_lines : {false, true}) {
      ProtocolChip chip(channel(1, "mo = true\ndelay_ns = 260.0\n") + sensor(8, 0x5A) +
                            actuator(8) + (two_lines ? channel(2) + actuator(12) : ""),
                        {.freqs = freqs, .en_mo = true, .mo_busy = 3});
      const unsigned lines = two_lines ? 2 : 1;
      for (int round = 0; round < 2; ++round) {
        ASSERT_TRUE(chip.frame(reg::kInitStart)) << freqs;
        EXPECT_EQ(chip.status(), reg::kResetStatus0) << freqs;
        EXPECT_EQ(chip.read(reg::kAddrScdata), 1 + 260'000 * 4 / chip.t_ma) << freqs;
        for (unsigned line = 0; line < lines; ++line) {
          ASSERT_EQ(chip.ma[line].size(), 4U) << freqs;
          ASSERT_EQ(chip.mo[line].size(), 2U) << freqs;
          EXPECT_FALSE(chip.mo[line][0].level);
          EXPECT_EQ(chip.mo[line][0].time, chip.ma[line][3].time) << freqs;
          EXPECT_TRUE(chip.mo[line][1].level);
          EXPECT_GT(chip.mo[line][1].time, chip.ma[line][3].time + chip.t_ma / 4) << freqs;
        }
        ASSERT_TRUE(chip.frame()) << freqs;
        EXPECT_EQ(chip.scdata(1, 8), 0x5AU);
      }
    }
  }
}

}  // namespace
