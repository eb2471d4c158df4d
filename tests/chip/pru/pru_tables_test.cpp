// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables of TIDEP0022 on the RTL: Table 10 with two sets of constants for the cable, its counts
// of errors, the words of Table 7, the registers of Table 11.
#include <algorithm>
#include <set>
#include <vector>

#include "sim/core/random.hpp"
#include "tests/chip/pru/pru_sim.hpp"

namespace mb4test {
namespace {

constexpr unsigned kBits = 12;
constexpr unsigned kTail = 8;

// A row of Table 10: MA, metres of cable, line delay as printed. Row 9 prints none.
struct Row {
  unsigned mhz;
  unsigned metres;
  std::optional<unsigned> printed;
};
constexpr Row kTable10[] = {{1, 2, 1}, {1, 17, 1}, {1, 27, 1}, {1, 42, 1},  {1, 67, 2},
                            {2, 2, 1}, {2, 17, 1}, {2, 27, 2}, {2, 42, {}}, {2, 67, 3},
                            {5, 2, 1}, {5, 17, 3}, {5, 27, 3}, {10, 2, 4}};

std::string encoder(const std::string& channel, const std::string& slave) {
  return "[[channel]]\nnumber = 1\n" + channel +
         "[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"wachendorff-wdgf58m\"\n" + slave;
}
std::string ramp(const std::string& channel) {
  return encoder(channel, "source = \"ramp\"\nstart = 3000\nstep = 77\n");
}
std::string delay_of(const Row& row, unsigned t0_ns, double ns_per_m) {
  return "delay_ns = " + std::to_string(t0_ns + ns_per_m * row.metres) + "\n";
}

struct Cable {
  unsigned t0_ns;
  double ns_per_m;
};

class PruTable10 : public testing::TestWithParam<std::pair<Cable, unsigned>> {};

TEST_P(PruTable10, LineDelays_AreAsPrintedAndNoFrameIsBad) {
  const auto& [cable, clock_mhz] = GetParam();
  for (const Row& row : kTable10) {
    SCOPED_TRACE(std::to_string(row.mhz) + " MHz, " + std::to_string(row.metres) + " m");
    PruSim pru(pru_scenario(ramp(delay_of(row, cable.t0_ns, cable.ns_per_m)),
                            clock_mhz * std::uint64_t{1'000'000}));
    pru.start(kBits, kTail, row.mhz);
    PruFrame last;
    for (unsigned i = 0; i < 1000; ++i) {
      last = pru.frame();
      ASSERT_EQ(last.line_delay(), row.printed.value_or(2)) << "frame " << i;
      ASSERT_EQ(last.word(), last.sent);
      ASSERT_EQ(last.flags() & ~kPruAverage, 0U);
    }
    EXPECT_EQ(last.crc_errors(), 0U);
    EXPECT_EQ(last.count, 1001U);
  }
}

INSTANTIATE_TEST_SUITE_P(Cables, PruTable10,
                         testing::Values(std::pair{Cable{148, 16.0}, 200U},
                                         std::pair{Cable{138, 16.6}, 200U},
                                         std::pair{Cable{148, 16.0}, 80U},
                                         std::pair{Cable{138, 16.6}, 80U}),
                         [](const auto& test) {
                           return "T0_" + std::to_string(test.param.first.t0_ns) + "_Clock" +
                                  std::to_string(test.param.second);
                         });

// The bits of a frame behind START: CDS is 1, so the word begins with 2.
TEST(PruErrors, BitErrorsOfTable10_AreCountedAndChangeNoPosition) {
  for (const unsigned errors : {29U, 6U, 1U}) {
    SCOPED_TRACE(errors);
    sim::Random random(errors);
    std::set<std::uint64_t> frames;  // of the line; the first is that of RUN
    while (frames.size() < errors) frames.insert(2 + random.up_to(999));
    std::string flips;
    for (const std::uint64_t frame : frames) {
      flips += "[" + std::to_string(frame) + ", " +
               std::to_string(2 + random.up_to(kBits + kTail - 1)) + "], ";
    }
    PruSim pru(pru_scenario(ramp("delay_ns = 400\nflips = [" + flips + "]\n")));
    PruFrame before = pru.start(kBits, kTail, 5);
    for (std::uint64_t number = 2; number <= 1001; ++number) {
      const PruFrame frame = pru.frame();
      const bool bad = frames.count(number) != 0;
      ASSERT_EQ((frame.flags() & kPruCrc) != 0, bad) << number;
      ASSERT_EQ(frame.crc_errors(), before.crc_errors() + (bad ? 1U : 0U)) << number;
      ASSERT_EQ(frame.position, bad ? before.position : frame.sent >> 2U) << number;
      before = frame;
    }
    EXPECT_EQ(before.crc_errors(), errors);
  }
}

// ---- Tables 7 and 11 -------------------------------------------------------------------------

struct Access {
  std::uint32_t word;
  std::uint8_t address;
};
// Reads of Table 7, and the two words that it misses.
constexpr Access kReads[] = {{0x889B4000, 0x44}, {0x88BD4000, 0x45}, {0x88D74000, 0x46},
                             {0x88F14000, 0x47}, {0x8C174000, 0x60}, {0x8CE54000, 0x67},
                             {0x8D014000, 0x68}, {0x8F0B4000, 0x78}, {0x8F2D4000, 0x79},
                             {0x8F474000, 0x7A}, {0x8F614000, 0x7B}, {0x8F934000, 0x7C},
                             {0x8FB54000, 0x7D}, {0x8FDF4000, 0x7E}, {0x8FF94000, 0x7F}};
constexpr std::uint32_t kPrintedRow6 = 0x8C13C194;
constexpr std::uint32_t kWrite6To60 = 0x8C16C194;

// Values of Table 11, by address.
std::uint8_t value_of(std::uint8_t address) {
  switch (address) {
    case 0x45:
      return 0xD9;
    case 0x46:
      return 0x01;
    case 0x47:
      return 0x32;
    case 0x60:
      return 0x0B;
    case 0x67:
      return 0x5F;
    case 0x78:
      return 0x46;
    case 0x79:
      return 0x3A;
    case 0x7A:
      return 0xC0;
    case 0x7B:
      return 0x0C;
    case 0x7D:
      return 0x01;
    case 0x7E:
      return 0x57;
    case 0x7F:
      return 0x41;
    default:
      return 0x00;
  }
}
// What the line carries: the remainder by x^4 + x + 1, inverted.
unsigned line_crc4(std::uint8_t byte) {
  unsigned rest = unsigned{byte} << 4U;
  for (unsigned place = 11; place >= 4; --place) {
    if ((rest >> place & 1U) != 0) rest ^= 0x13U << (place - 4);
  }
  return ~rest & 0xFU;
}

// P-7 and P-8: 15 reads at four rates are the 60 rows of Table 11.
TEST(PruControl, ReadsOfTable11_GiveTheirBytesAtEachRate) {
  unsigned rows = 0;
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    PruSim pru(pru_scenario(encoder("cable_m = 4.0\n", "")));
    pru.start(kBits, kTail, mhz);
    for (const Access& row : kReads) {
      SCOPED_TRACE(unsigned{row.address});
      const PruFrame end = pru.control(row.word);
      EXPECT_EQ(end.flags() & ~kPruAverage, 0U);
      EXPECT_EQ(pru.read(prureg::kAddrCtrlResult), value_of(row.address));
      EXPECT_EQ(end.ctrl_crc(), line_crc4(value_of(row.address)));
      EXPECT_EQ(pru.read(prureg::kAddrCtrl), 0U) << "taken";
      ++rows;
    }
  }
  EXPECT_EQ(rows, 60U);
}

// P-8: the printed row 6 is refused, and its corrected form writes.
TEST(PruControl, PrintedRow6_IsRefusedAndTold) {
  PruSim pru(pru_scenario(encoder("cable_m = 4.0\n", "")));
  pru.start(kBits, kTail, 5);
  EXPECT_NE(pru.control(kPrintedRow6).flags() & kPruControlCrc, 0U);
  EXPECT_EQ(pru.simulator.slave(1)->reg_read(0x60), 0x0B);
  EXPECT_EQ(pru.access(kWrite6To60), 0x06);
  EXPECT_EQ(pru.simulator.slave(1)->reg_read(0x60), 0x06);
  // The flag belongs to the last control frame.
  EXPECT_EQ(pru.access(0x8C174000), 0x06);
}

// From the frame of START on FLAGS bit 2 is 1; the last of the 46 frames clears it.
TEST(PruControl, FlagOfTheControlFrame_IsThatOfItsFrames) {
  PruSim pru(pru_scenario(encoder("", "")));
  pru.start(kBits, kTail, 10);
  pru.write(prureg::kAddrCtrl, 0x889B4000);
  unsigned frames = 0, sending = 0;
  for (bool over = false; !over && frames < 100; ++frames) {
    const PruFrame frame = pru.frame();
    sending += (frame.flags() & kPruSending) != 0 ? 1 : 0;
    over = (frame.irq & prureg::CTRL_ENDED::kMask) != 0;
  }
  EXPECT_EQ(frames, 1 + 14 + 32U);  // the first one ends with the word taken
  EXPECT_EQ(sending, 31U);          // the last one ends with it cleared
}

}  // namespace
}  // namespace mb4test
