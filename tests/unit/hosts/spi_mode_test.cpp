// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SPI modes and word lengths of the simulated host, seen at its pins: the edge at which each mode
// takes data follows from CPOL and CPHA, the order of bits from the length of the words.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "sim/hosts/spi_host.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

// Records MOSI as it was before each edge of SCLK, and answers with given bits.
class Pins final : public HostPins {
 public:
  Time now() const override { return now_; }
  void run_until(Time time) override { now_ = time; }
  void set_pin(Pin pin, bool level) override {
    if (pin == Pin::kDb0) mosi_ = level;
    if (pin == Pin::kNcs) selected = !level;
    if (pin != Pin::kAle || level == sclk) return;
    sclk = level;
    if (!selected) return;
    (level ? at_rising : at_falling) += mosi_ ? '1' : '0';
    if (level == answer_edge) ++next_;
  }
  bool pin(Pin pin) const override {
    return pin == Pin::kDb1 && next_ < answer.size() && answer[next_] == '1';
  }

  bool selected = false;
  bool sclk = false;
  bool answer_edge = false;  // MISO changes after edges to this level
  std::string answer;
  std::string at_rising;
  std::string at_falling;

 private:
  Time now_ = 0;
  bool mosi_ = false;
  std::size_t next_ = 0;
};

TEST(SpiMode, FourModes_TakeDataAtTheirEdge) {
  for (unsigned mode = 0; mode < 4; ++mode) {
    SCOPED_TRACE(mode);
    const bool cpol = (mode & 2U) != 0;
    const bool cpha = (mode & 1U) != 0;
    Pins pins;
    SpiHost host(pins, {}, kSpiPins);
    host.set_mode({cpol, cpha});
    EXPECT_EQ(pins.sclk, cpol);
    // Data are taken at the rising edge in modes 0 and 3, at the falling one in 1 and 2.
    const bool taken_at_rising = cpol == cpha;
    pins.answer_edge = !taken_at_rising;
    pins.answer = cpha ? "x11001010" : "11001010";
    host.select(true);
    EXPECT_EQ(host.byte(0xA6), 0xCA);
    EXPECT_EQ(pins.sclk, cpol);
    EXPECT_EQ(taken_at_rising ? pins.at_rising : pins.at_falling, "10100110");
    host.select(false);
  }
}

TEST(SpiMode, WordsOf1To32Bits_GoOutMsbFirst) {
  for (unsigned bits = 1; bits <= 32; ++bits) {
    Pins pins;
    SpiHost host(pins, {}, kSpiPins);
    host.select(true);
    host.word(0xA55AC33D, bits);
    host.select(false);
    std::string expected;
    for (unsigned bit = bits; bit-- > 0;) expected += ((0xA55AC33DU >> bit) & 1U) != 0 ? '1' : '0';
    EXPECT_EQ(pins.at_rising, expected);
  }
}

}  // namespace
}  // namespace mb4test
