// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SPI slave of a word bus between a host with any SCLK and a memory that may wait. Expected:
// the frame of docs/axi.md, "SPI".
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "Venc_spi.h"
#include "tests/support/dice.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::Dice;

constexpr unsigned kWrite = 2;
constexpr unsigned kRead = 3;
constexpr unsigned kClear = 4;
constexpr unsigned kFrameBits = 56;
constexpr unsigned kMark = 0x50;   // of the turn byte
constexpr unsigned kSlow = 0x08;   // s: too late
constexpr unsigned kVoid = 0x04;   // v: a void frame
constexpr unsigned kReady = 0x01;  // r
// Time in thousandths of a clock.
constexpr std::uint64_t kClock = 1000;

struct Access {
  bool write;
  unsigned address;
  std::uint32_t data;
  bool operator==(const Access&) const = default;
};

struct Frame {
  std::vector<std::uint8_t> bytes;
  unsigned bits = kFrameBits;   // NCS rises behind them
  unsigned reset_before = ~0U;  // a bit
};

struct Phases {
  std::uint64_t high = 4 * kClock, low = 4 * kClock;                       // of SCLK
  std::uint64_t setup = 4 * kClock, hold = 4 * kClock, rest = 8 * kClock;  // of NCS
  bool mode3 = false;
};

Frame write_frame(unsigned address, std::uint32_t data) {
  Frame frame;
  frame.bytes = {kWrite, static_cast<std::uint8_t>(address), 0};
  for (int shift = 24; shift >= 0; shift -= 8)
    frame.bytes.push_back(static_cast<std::uint8_t>(data >> static_cast<unsigned>(shift)));
  return frame;
}
Frame read_frame(unsigned address) {
  Frame frame;
  frame.bytes = {kRead, static_cast<std::uint8_t>(address), 0, 0, 0, 0, 0};
  return frame;
}
Frame clear_frame() {
  Frame frame;
  frame.bytes = {kClear, 0, 0, 0, 0, 0, 0};
  return frame;
}

std::uint32_t word_of(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t word = 0;
  for (unsigned i = 3; i < 7; ++i) word = word << 8U | bytes.at(i);
  return word;
}

// The slave, the clock, and a memory behind it that answers after `wait` clocks.
class SpiBench {
 public:
  SpiBench() {
    model_.cs_ni = 1;
    model_.sclk_i = model_.mosi_i = 0;
    model_.word_ready_i = 0;
    model_.word_error_i = 0;
    block_.reset();
    wait_for(8 * kClock);
  }

  // Sends a frame at any phase, and returns the bytes of MISO; bits that were not sent are 0.
  std::vector<std::uint8_t> send(const Frame& frame, const Phases& phases = {}) {
    std::vector<std::uint8_t> in(std::max<std::size_t>(frame.bytes.size(), 7));
    model_.sclk_i = phases.mode3 ? 1 : 0;
    wait_for(phases.rest);
    model_.cs_ni = 0;
    model_.eval();
    EXPECT_EQ(model_.miso_oe_o, 1);
    wait_for(phases.setup);
    for (unsigned bit = 0; bit < frame.bits; ++bit) {
      if (bit == frame.reset_before) reset();
      // Mode 0 has its data before the first edge; mode 3 changes them with the falling edge.
      model_.mosi_i =
          bit / 8 < frame.bytes.size() ? frame.bytes[bit / 8] >> (7 - bit % 8) & 1U : 0U;
      model_.sclk_i = 0;
      wait_for(phases.low);
      if (model_.miso_o != 0 && bit / 8 < in.size())
        in[bit / 8] = static_cast<std::uint8_t>(in[bit / 8] | 1U << (7 - bit % 8));
      model_.sclk_i = 1;
      wait_for(phases.high);
      if (!phases.mode3) model_.sclk_i = 0;
    }
    wait_for(phases.hold);
    model_.cs_ni = 1;
    model_.eval();
    EXPECT_EQ(model_.miso_oe_o, 0);
    return in;
  }
  void wait_for(std::uint64_t time) {
    const std::uint64_t end = now_ + time;
    while (edge_ <= end) {
      clock();
      edge_ += kClock;
    }
    now_ = end;
  }
  void reset() {
    model_.rst_ni = 0;
    wait_for(2 * kClock);
    model_.rst_ni = 1;
  }

  std::vector<Access> accesses;
  std::map<unsigned, std::uint32_t> memory;
  unsigned wait = 0;     // clocks of each access
  bool error = false;    // accesses have word_error_i
  unsigned dropped = 0;  // requests taken back

 private:
  void clock() {
    model_.eval();
    const bool ready = model_.word_req_o != 0 && waited_ >= wait;
    model_.word_ready_i = ready ? 1 : 0;
    model_.word_error_i = ready && error ? 1 : 0;
    const unsigned address = model_.word_addr_o * 4U;
    model_.word_data_i = ready ? memory[address] : 0xDEAD'BEEF;
    model_.eval();
    if (ready) {
      EXPECT_EQ(model_.word_be_o, 0xF);
      const bool write = model_.word_write_o != 0;
      accesses.push_back({write, address, write ? model_.word_data_o : memory[address]});
      if (write) memory[address] = model_.word_data_o;
    }
    if (model_.word_req_o == 0 && waited_ != 0) ++dropped;
    waited_ = model_.word_req_o != 0 && !ready ? waited_ + 1 : 0;
    block_.clock();
  }

  mb4test::Block<Venc_spi> block_;
  Venc_spi& model_ = block_.model;
  std::uint64_t now_ = 0;
  std::uint64_t edge_ = kClock / 2;  // the next one of the clock
  unsigned waited_ = 0;
};

TEST(EncSpi, WordIsWrittenAndRead_InModes0And3) {
  for (const bool mode3 : {false, true}) {
    SpiBench bench;
    bench.send(clear_frame());  // v is set by the reset
    Phases phases;
    phases.mode3 = mode3;
    const auto wrote = bench.send(write_frame(0x38, 0x8123'4567), phases);
    EXPECT_EQ(wrote[2], kMark | kReady);
    EXPECT_EQ(wrote[0] | wrote[1] | wrote[3] | wrote[4] | wrote[5] | wrote[6], 0);
    bench.wait_for(8 * kClock);
    EXPECT_EQ(bench.accesses, (std::vector<Access>{{true, 0x38, 0x8123'4567}}));
    const auto read = bench.send(read_frame(0x38), phases);
    EXPECT_EQ(read[2], kMark | kReady);
    EXPECT_EQ(word_of(read), 0x8123'4567U);
    EXPECT_EQ(bench.accesses.size(), 2U);
  }
}

// A write is done when NCS rises, and not before.
TEST(EncSpi, Write_IsDoneWhenNcsRises) {
  SpiBench bench;
  Phases phases;
  phases.hold = 50 * kClock;
  Frame frame = write_frame(4, 1);
  frame.bits = kFrameBits - 1;
  bench.send(frame, phases);
  bench.wait_for(20 * kClock);
  EXPECT_TRUE(bench.accesses.empty());
  frame.bits = kFrameBits + 1;
  bench.send(frame, phases);
  frame.bits = kFrameBits + 64;
  bench.send(frame, phases);
  bench.wait_for(20 * kClock);
  EXPECT_TRUE(bench.accesses.empty());
  bench.send(write_frame(4, 1), phases);
  EXPECT_TRUE(bench.accesses.empty());
  bench.wait_for(5 * kClock);
  EXPECT_EQ(bench.accesses.size(), 1U);
}

// A quarter of the clock: MISO has what it should 4 clocks after the edge before, at every phase.
TEST(EncSpi, SclkOfAQuarterOfTheClock_ReadsEveryWordAtEveryPhase) {
  SpiBench bench;
  Dice dice;
  bench.memory[0x24] = 0xA5C3'0FF1;
  Phases phases;
  phases.high = phases.low = 2 * kClock;
  for (unsigned phase = 0; phase < 400; ++phase) {
    bench.wait_for(1 + dice.below(2 * kClock));
    const auto read = bench.send(read_frame(0x24), phases);
    ASSERT_EQ(word_of(read), 0xA5C3'0FF1U) << phase;
    ASSERT_EQ(read[2] & ~kVoid, kMark | kReady) << phase;
  }
}

TEST(EncSpi, LateAnswer_IsMarkedAndSetsTheStickyBit) {
  SpiBench bench;
  bench.send(clear_frame());
  bench.memory[8] = 0xFFFF'FFFF;
  bench.send(read_frame(8));
  bench.wait = 60;  // the time of 7 bits is 56 clocks
  const auto late = bench.send(read_frame(8));
  EXPECT_EQ(late[2], kMark);
  EXPECT_EQ(word_of(late), 0U);
  bench.wait = 0;
  EXPECT_EQ(bench.dropped, 1U);
  const auto after = bench.send(read_frame(8));
  EXPECT_EQ(after[2], kMark | kSlow | kVoid | kReady);
  EXPECT_EQ(word_of(after), 0xFFFF'FFFFU);
  bench.send(clear_frame());
  EXPECT_EQ(bench.send(read_frame(8))[2], kMark | kReady);
}

TEST(EncSpi, WriteThatWaits_KeepsItsPayloadAndVoidsTheNextFrame) {
  SpiBench bench;
  bench.send(clear_frame());
  bench.wait = 200;
  bench.send(write_frame(0x10, 0x1357'9BDF));
  const auto blocked = bench.send(write_frame(0x14, 0x2468'ACE0));
  EXPECT_EQ(blocked[2], kMark | kSlow);
  bench.wait_for(800 * kClock);
  EXPECT_EQ(bench.accesses, (std::vector<Access>{{true, 0x10, 0x1357'9BDF}}));
  bench.wait = 0;
  EXPECT_EQ(bench.send(read_frame(0x10))[2], kMark | kSlow | kVoid | kReady);
}

TEST(EncSpi, ErrorOfTheWordBus_VoidsTheFrame) {
  SpiBench bench;
  bench.send(clear_frame());
  bench.error = true;
  EXPECT_EQ(bench.send(read_frame(8))[2], kMark);
  bench.error = false;
  bench.send(clear_frame());
  bench.error = true;
  EXPECT_EQ(bench.send(write_frame(8, 1))[2], kMark | kReady);
  bench.wait_for(8 * kClock);
  bench.error = false;
  EXPECT_EQ(bench.send(read_frame(8))[2], kMark | kVoid | kReady);
}

// The bits behind the reset would be a write of their own.
TEST(EncSpi, FrameThatAResetCuts_DoesNothing) {
  for (unsigned before = 0; before < 70; ++before) {
    SpiBench bench;
    const std::vector<std::uint8_t> write = write_frame(8, 7).bytes;
    Frame frame;
    frame.bytes.assign((before + kFrameBits + 7) / 8, 0);
    for (unsigned bit = 0; bit < kFrameBits; ++bit) {
      const unsigned at = before + bit;
      const unsigned level = write[bit / 8] >> (7 - bit % 8) & 1U;
      frame.bytes[at / 8] = static_cast<std::uint8_t>(frame.bytes[at / 8] | level << (7 - at % 8));
    }
    frame.bits = before + kFrameBits;
    frame.reset_before = before;
    bench.send(frame);
    bench.wait_for(8 * kClock);
    EXPECT_TRUE(bench.accesses.empty()) << before;
    bench.send(write_frame(8, 9));
    bench.wait_for(8 * kClock);
    EXPECT_EQ(bench.accesses, (std::vector<Access>{{true, 8, 9}})) << before;
  }
}

// Frames at random: opcodes of all kinds, ends anywhere, any phase, a memory that waits. Each write
// that is whole is done once, each read that is answered has the word of the memory, nothing else
// happens.
TEST(EncSpi, FramesAtRandom_NoAccessIsLostDoubledOrInvented) {
  const std::uint64_t frames = mb4test::number("MB4_SPI_FRAMES", 20'000);
  SpiBench bench;
  Dice dice;
  std::map<unsigned, std::uint32_t> memory;
  std::uint64_t reads = 0, writes = 0, lates = 0;
  for (std::uint64_t n = 0; n < frames; ++n) {
    Phases phases;
    const std::uint64_t half = 2 * kClock + dice.below(4 * kClock);
    phases.high = half + dice.below(200);
    phases.low = half + dice.below(200);
    phases.setup = 2 * kClock + dice.below(5 * kClock);
    phases.hold = 2 * kClock + dice.below(5 * kClock);
    phases.rest = 4 * kClock + dice.below(8 * kClock);
    phases.mode3 = dice.below(2) != 0;
    Frame frame;
    const unsigned kind = dice.below(8);
    const unsigned address = dice.below(256);
    const std::uint32_t data = dice.below(0x8000'0000U) * 2U + dice.below(2);
    if (kind < 3) {
      frame = write_frame(address, data);
    } else if (kind < 6) {
      frame = read_frame(address);
      for (unsigned i = 3; i < 7; ++i) frame.bytes[i] = static_cast<std::uint8_t>(dice.below(256));
    } else if (kind == 6) {
      frame = clear_frame();
    } else {
      frame = write_frame(address, data);
      frame.bytes[0] = static_cast<std::uint8_t>(dice.below(256));
    }
    frame.bytes[2] = static_cast<std::uint8_t>(dice.below(256));
    const unsigned abort = dice.below(4);
    if (abort == 0) frame.bits = dice.below(120);
    bench.wait = dice.below(4) == 0 ? dice.below(90) : 0;
    const unsigned opcode = frame.bytes[0];
    bench.accesses.clear();
    const auto in = bench.send(frame, phases);
    bench.wait_for(100 * kClock);
    const bool whole = frame.bits == kFrameBits;
    if (opcode == kWrite && whole) {
      memory[address & ~3U] = word_of(frame.bytes);
      ASSERT_EQ(bench.accesses, (std::vector<Access>{{true, address & ~3U, word_of(frame.bytes)}}))
          << n;
      ASSERT_EQ(in[2] & ~(kSlow | kVoid), kMark | kReady) << n;
      ++writes;
    } else if (opcode == kRead && frame.bits >= 16) {
      // A read that is taken back has no access.
      ASSERT_LE(bench.accesses.size(), 1U) << n;
      if (!bench.accesses.empty()) {
        ASSERT_EQ(bench.accesses[0], (Access{false, address & ~3U, memory[address & ~3U]})) << n;
      }
      if (frame.bits >= kFrameBits) {
        ASSERT_EQ(in[2] & 0xF2U, kMark) << n;
        const bool ready = (in[2] & kReady) != 0;
        ASSERT_EQ(word_of(in), ready ? memory[address & ~3U] : 0U) << n;
        ASSERT_TRUE(ready || bench.wait >= 20) << n;
        ++(ready ? reads : lates);
      }
    } else {
      ASSERT_TRUE(bench.accesses.empty()) << n << " opcode " << opcode << " bits " << frame.bits;
      if (frame.bits >= kFrameBits) {
        ASSERT_EQ(in[2] & ~(kSlow | kVoid),
                  kMark | (opcode == kClear || opcode == kWrite ? kReady : 0U))
            << n;
        ASSERT_EQ(word_of(in), 0U) << n;
      }
    }
    if (n % 1000 == 0) {
      for (const auto& [at, word] : memory) ASSERT_EQ(bench.memory[at], word) << n;
    }
  }
  EXPECT_GT(writes, frames / 5);
  EXPECT_GT(reads, frames / 5);
  EXPECT_GT(lates, frames / 200);
}

}  // namespace
