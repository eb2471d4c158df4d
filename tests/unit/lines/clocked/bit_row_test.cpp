// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A row of bits does what the shift registers do one behind the other.
#include "sim/lines/clocked/bit_row.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

namespace mb4test {

using namespace mb4::sim;

namespace {

TEST(BitRow, RandomRegisters_SameBitsAsOneAfterTheOther) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<ShiftRegister> registers;
    BitRow row;
    row.restart();
    for (std::size_t slaves = 1 + random() % 8; slaves > 0; --slaves) {
      ShiftRegister& data = registers.emplace_back(1 + random() % ShiftRegister::kMaxBits);
      const auto bits = static_cast<unsigned>(random() % (data.size() + 1) % 65);
      data.load(random(), bits, Crc{0, 0});
      row.append(data.bits(), data.size());
    }
    const std::size_t shifts = random() % 900;
    for (std::size_t k = 0; k < shifts; ++k) {
      bool in = random() % 3 == 0;
      EXPECT_FALSE(row.full());
      const bool next = row.shift(in);
      for (std::size_t i = registers.size(); i-- > 0;) {
        const bool out = registers[i].out();
        registers[i].shift(in);
        in = out;
      }
      ASSERT_EQ(next, registers[0].out()) << "seed " << seed << " shift " << k;
    }
    EXPECT_EQ(row.shifts(), shifts);
    std::size_t place = 0;
    for (const ShiftRegister& data : registers) {
      EXPECT_TRUE(row.bits(place, data.size()) == data.bits()) << "seed " << seed;
      place += data.size();
    }
  }
}

TEST(BitRow, Full_AfterItsRoomAndBeforeTheStart) {
  BitRow row;
  EXPECT_TRUE(row.full());
  row.restart();
  row.append(0, 1);
  for (std::size_t k = 1; k < BitRow::kRoom; ++k) {
    ASSERT_FALSE(row.full());
    row.shift(true);
  }
  EXPECT_TRUE(row.full());
}

}  // namespace
}  // namespace mb4test
