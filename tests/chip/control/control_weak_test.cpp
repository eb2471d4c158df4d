// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The weak places of control communication, each named in docs/choices.md: one inverted bit that
// no side can detect, because no acknowledge covers it or the four CRC bits fit by chance.
#include <string>

#include "tests/chip/control/control_fault_bench.hpp"
#include "tests/support/bits.hpp"

namespace {

using mb4test::delay_error;
using mb4test::Expected;
using mb4test::FaultBench;
using mb4test::Flag;
using mb4test::kGood;
using mb4test::reg_error;
using mb4test::Way;

constexpr unsigned kAddress = 0x30;

// Eight data bits and CRC4 as they stand on the line.
std::string word_of(unsigned value) {
  return mb4test::word_on_line(value, 8, mb4test::crc_choice(0x04), 0);
}

// The slave's start bit of a write is lost. The master repeats S, the slave takes it for D7, and
// the master takes its echo for the start bit. All echoes fit, one frame late. The slave's CRC
// stops the write. The master notices it only if the last CRC bit is 1, because the slave sees this
// bit in the slot of P. So a host that must be sure reads back.
TEST(ControlWeak, LostStartBitOfAWrite_IsSeenByTheLastCrcBitOnly) {
  for (unsigned value = 0; value < 256; ++value) {
    FaultBench bench(Way::kCds, 19);
    bench.host.set_write(0, kAddress, {static_cast<std::uint8_t>(value)});
    const Expected result = bench.run();
    // Lowest CRC bit as the XOR of the data bits that reach it (x^4 + x + 1), inverted on the line.
    bool crc0 = false;
    for (const unsigned bit : {0U, 3U, 4U, 6U}) crc0 ^= ((value >> bit) & 1U) != 0;
    const bool line_bit = !crc0;
    EXPECT_EQ(result, line_bit ? reg_error(0) : kGood) << value;
    EXPECT_EQ(bench.far.counters().writes, 0U) << value;
    EXPECT_EQ(bench.slave_reg(kAddress), 0) << value;
  }
}

// A false start bit comes one frame early, in the last frame in which the slave is busy. The master
// sends D7. If D7 is 1, the slave takes it for the repeated S, and the master takes the slave's S
// for the echo of D7. All bits are shifted by one, so no CRC fits, and the slave never writes.
TEST(ControlWeak, EarlyStartBitOfAWrite_IsSeenIfD7IsZero) {
  for (unsigned value = 0; value < 256; ++value) {
    FaultBench bench(Way::kCds, 20, "write_busy_frames = 2");
    bench.host.set_write(0, kAddress, {static_cast<std::uint8_t>(value)});
    EXPECT_EQ(bench.run(), (value & 0x80U) != 0 ? kGood : reg_error(0)) << value;
    EXPECT_EQ(bench.far.counters().writes, 0U) << value;
    EXPECT_EQ(bench.slave_reg(kAddress), 0) << value;
  }
}

// A slave that sees CDM = 1 while it sends a byte falls silent. The zeros that follow fit the CRC
// of 1.5 % of all cases.
TEST(ControlWeak, SlaveThatFallsSilentWhileItSends_IsNotSeenIfTheCrcFits) {
  unsigned unseen = 0;
  for (unsigned value = 0; value < 256; value += 3) {
    for (unsigned sent = 0; sent < 12; ++sent) {
      FaultBench bench(Way::kCdm, 19 + sent);
      bench.set_reg(kAddress, static_cast<std::uint8_t>(value));
      bench.host.set_read(0, kAddress, 1);
      const Expected result = bench.run();
      const std::string word = word_of(value).substr(0, sent) + std::string(12 - sent, '0');
      const auto got = static_cast<unsigned>(mb4test::from_bits(word.substr(0, 8)));
      const bool fits = word_of(got) == word;
      EXPECT_EQ(result, fits ? kGood : reg_error(0)) << value << " " << sent;
      if (fits) {
        EXPECT_EQ(bench.host.rdata(1)[0], got);
        unseen += got != value ? 1 : 0;
      }
    }
  }
  EXPECT_GT(unseen, 0U);
  std::printf("%u of %u\n", unseen, 86U * 12U);
}

// Here the chip reports the error, but the slave may hold a third value: zeros follow a wrong echo,
// and their CRC may fit. So after an error the register that REGBYTES points at holds the old, the
// new or another value.
TEST(ControlWeak, WriteThatIsCutOff_MayLeaveAThirdValueButIsReported) {
  FaultBench bench(Way::kCds, 19 + 5);
  bench.set_reg(kAddress, 0x11);
  bench.host.set_write(0, kAddress, {0x33});
  EXPECT_EQ(bench.run(), reg_error(0));
  EXPECT_EQ(word_of(0x30), "001100000000");
  EXPECT_EQ(bench.slave_reg(kAddress), 0x30);
  bench.check_next();
}

// An acknowledge is one bit without a CRC.
TEST(ControlWeak, InvertedAcknowledge_StandsForASlaveThatIsNotThere) {
  for (const bool tested : {false, true}) {
    FaultBench bench(Way::kCds, 17 + 5);
    bench.host.set_command(0x80 | 0x04, 3, tested);  // IDs 0 and 5
    EXPECT_EQ(bench.run().flag, Flag::kNone);
    EXPECT_EQ(bench.far.counters().commands, 1U);
  }
}

// S is lost at the far slave alone: it locks no ID, so the near one becomes ID 0 and is written.
// The chip does not look at the bits that lock IDs, CDS in slots 1 to 8.
TEST(ControlWeak, SLostAtOneSlaveOnly_TheNextOneTakesItsId) {
  FaultBench bench(Way::kCdm, 0);
  bench.near.faults() = {};
  bench.host.set_write(0, kAddress, {0x5A});
  EXPECT_EQ(bench.run(), kGood);
  EXPECT_EQ(bench.slave_reg(kAddress), 0);
  EXPECT_EQ(bench.chip.simulator.slave(1)->reg_read(kAddress), 0x5A);
  bench.check_next();
}

}  // namespace
