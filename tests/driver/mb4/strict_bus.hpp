// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A bus with a list of expected transfers: it compares every transfer byte by byte, in order, with
// this list, which reads like the log of a logic analyser. And a clock under the test's control.

#ifndef TESTS_DRIVER_MB4_STRICT_BUS_HPP_
#define TESTS_DRIVER_MB4_STRICT_BUS_HPP_

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "mb4/bus.hpp"
#include "mb4/result.hpp"

namespace mb4test {

using Bytes = std::vector<std::uint8_t>;

// What kFull sends while data is read: not 0, and in 0xF5 it forces no line and keeps ENTEST = 0
// (MAVO and MAVS alone; tables 51 to 53, page 33).
constexpr std::uint8_t kFiller = 0xA0;

inline std::string hex(const Bytes& bytes) {
  std::ostringstream text;
  for (const std::uint8_t byte : bytes) {
    text << std::hex << std::uppercase << std::setw(2) << std::setfill('0') << unsigned{byte}
         << ' ';
  }
  return text.str();
}

// Concatenation, so that long bursts can be written as runs.
inline Bytes join(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

inline Bytes zeros(std::size_t count) { return Bytes(count, 0x00); }

struct Transfer {
  Bytes mosi;
  Bytes miso;  // empty: the driver is expected not to ask for MISO
  bool succeeds = true;
};

class StrictBus {
 public:
  StrictBus() = default;
  StrictBus(const StrictBus&) = delete;
  StrictBus& operator=(const StrictBus&) = delete;

  ~StrictBus() {
    EXPECT_EQ(next_, expected_.size()) << "transfers that were expected and did not come";
  }

  StrictBus& expect_write(Bytes mosi) {
    expected_.push_back({std::move(mosi), {}, true});
    return *this;
  }
  StrictBus& expect_read(Bytes mosi, Bytes miso) {
    EXPECT_EQ(mosi.size(), miso.size()) << "slip in the test: SPI is full duplex";
    expected_.push_back({std::move(mosi), std::move(miso), true});
    return *this;
  }
  // A write of registers, and what reads it back.
  StrictBus& expect_proven(const Bytes& mosi) {
    Bytes back = mosi;
    Bytes reads(mosi.size(), 0x00);
    back[0] = back[1] = 0x00;
    reads[0] = 0x03;
    reads[1] = mosi[1];
    return expect_write(mosi).expect_read(std::move(reads), std::move(back));
  }
  // The transfer at `index` of the list fails and ends the list.
  StrictBus& fail_at(std::size_t index) {
    expected_.resize(index + 1);
    expected_[index].succeeds = false;
    return *this;
  }

  // The transfer that was added last fails; others may follow.
  StrictBus& fail_last() { return fail_at(expected_.size() - 1); }

  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    const Bytes mosi(tx.begin(), tx.end());
    if (next_ >= expected_.size()) {
      ADD_FAILURE() << "unexpected transfer number " << next_ << ": " << hex(mosi);
      return false;
    }
    const std::size_t index = next_++;
    const Transfer& want = expected_[index];
    EXPECT_EQ(hex(mosi), hex(want.mosi)) << "transfer number " << index;
    EXPECT_EQ(rx.size(), want.miso.size()) << "MISO bytes of transfer number " << index;
    for (std::size_t i = 0; i < rx.size() && i < want.miso.size(); ++i) {
      rx[i] = want.miso[i];
    }
    return want.succeeds;
  }

  [[nodiscard]] std::size_t transfers() const { return next_; }

 private:
  std::vector<Transfer> expected_;
  std::size_t next_ = 0;
};

// Accepts everything and answers with one level.
class StuckBus {
 public:
  explicit StuckBus(std::uint8_t level) : level_(level) {}

  bool transfer(mb4::Span<const std::uint8_t>, mb4::Span<std::uint8_t> rx) {
    ++transfers_;
    for (std::uint8_t& byte : rx) {
      byte = level_;
    }
    return true;
  }

  [[nodiscard]] std::size_t transfers() const { return transfers_; }
  void set_level(std::uint8_t level) { level_ = level; }

 private:
  std::uint8_t level_;
  std::size_t transfers_ = 0;
};

// Advances by `step_us` each time it is asked.
struct FakeClock {
  std::uint32_t time_us = 0;
  std::uint32_t step_us = 1;

  std::uint32_t now_us() {
    const std::uint32_t now = time_us;
    time_us += step_us;
    return now;
  }
};

}  // namespace mb4test

#endif  // TESTS_DRIVER_MB4_STRICT_BUS_HPP_
