// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register access of biss_axi alone, with three channels: regmap/axi.rdl, 0x94 to 0x9C. The test
// plays the frames of the channels, and an encoder with the bits of a control communication
// (control_script.hpp).
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "Vaxi_access.h"
#include "axi_regs.hpp"
#include "tests/block/axi/axi_bus.hpp"
#include "tests/block/biss/control_script.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = biss_axi::regs;
namespace event_t = mb4test::places::axi_pkg::event_t;
using mb4test::ControlAccess;
using mb4test::ControlScript;

constexpr unsigned kChannels = 3;
constexpr std::uint32_t kStart = 1U << 31U, kActive = 1, kError = 2, kSilent = 4;
constexpr unsigned kRest = 14;        // frames without CDM before an access
constexpr unsigned kPatience = 1024;  // frames for which an encoder may be silent

std::uint32_t command(unsigned channel, const ControlAccess& access) {
  return kStart | (access.write ? 1U << 16U : 0U) | channel << 12U | access.id << 8U |
         access.address;
}

class AxiAccessBlock : public testing::Test {
 protected:
  AxiAccessBlock() {
    m.clear_i = 0;
    m.events_i = 0;
    m.bus_i = 0;
    block.reset();
  }
  void clock() {
    m.eval();
    ends += m.end_o;
    block.clock();
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  std::uint32_t read(unsigned address) { return mb4test::read_page(block, address); }
  void write(unsigned address, std::uint32_t data) {
    m.bus_i = mb4test::page_write(address, data);
    clock();
    m.bus_i = 0;
    clock();
  }
  std::uint32_t status() { return read(reg::kAddrAccessStatus); }
  void start(unsigned channel, const ControlAccess& access) {
    accessed = channel;
    write(reg::kAddrAccess, command(channel, access));
  }
  // One clock with events of a channel.
  void happens(unsigned channel, std::uint64_t events) {
    m.events_i = static_cast<std::uint32_t>(events << channel * (event_t::kAllBits));
    clock();
    m.events_i = 0;
  }
  // A frame of a channel with this CDS: its CDM. Channels without the access have none, whatever
  // their CDS.
  bool frame(unsigned channel, bool cds) {
    clocks(dice.below(3));
    m.eval();
    const unsigned both = m.cdm_o >> 2 * channel & 3U;
    EXPECT_EQ(m.cdm_o & ~(3U << 2 * accessed), 0U);
    happens(channel, event_t::kBegun(1));
    const bool cdm = (both >> (cds ? 1 : 0) & 1U) != 0;
    clocks(dice.below(3));
    happens(channel, event_t::kEnded(1) | event_t::kCds(cds) | event_t::kCdm(cdm));
    return cdm;
  }
  // Frames with CDS = 0 up to that which begins a control communication.
  unsigned rest(unsigned channel) {
    unsigned frames = 0;
    while (frames < 100 && !frame(channel, false)) ++frames;
    return frames;
  }
  // The rest of a control communication, whose first bit has been seen; up to place `until`.
  void play(unsigned channel, const ControlScript& script, char until = '.') {
    for (std::size_t i = 1; i < script.cdm.size() && script.place[i] != until; ++i) {
      ASSERT_EQ(status(), kActive) << i;
      ASSERT_EQ(frame(channel, script.cds[i] == '1'), script.cdm[i] == '1') << i;
      if (dice.below(8) == 0) happens(channel, event_t::kLate(1));  // no frame
      // Frames of the other channels do not count.
      if (dice.below(4) == 0) frame((channel + 1) % kChannels, dice.below(2) != 0);
    }
  }
  ControlAccess random_access() { return mb4test::random_access(dice, dice.below(2) != 0, 1); }
  // An access that has begun its control communication.
  ControlAccess begin(unsigned channel) {
    const ControlAccess access = random_access();
    start(channel, access);
    rest(channel);
    return access;
  }

  mb4test::Dice dice;
  mb4test::Block<Vaxi_access> block;
  Vaxi_access& m = block.model;
  unsigned ends = 0, accessed = 0;
};

TEST_F(AxiAccessBlock, Reset_NoAccessRuns) {
  EXPECT_EQ(read(reg::kAddrAccess), 0U);
  EXPECT_EQ(read(reg::kAddrAccessData), 0U);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(status(), 0U);
    EXPECT_FALSE(frame(static_cast<unsigned>(i) % kChannels, false));
  }
  EXPECT_EQ(ends, 0U);
}

TEST_F(AxiAccessBlock, RandomAccesses_WriteAndReadTheirByte) {
  unsigned last = kChannels;
  for (int round = 0; round < 100; ++round) {
    const unsigned channel = dice.below(kChannels);
    const ControlAccess access = random_access();
    SCOPED_TRACE(round);
    const unsigned before = access.write ? access.bytes[0] : dice.below(256);
    write(reg::kAddrAccessData, before | 0xABC00U);
    EXPECT_EQ(read(reg::kAddrAccessData), before);
    ends = 0;
    start(channel, access);
    EXPECT_EQ(read(reg::kAddrAccess), command(channel, access));
    // What the host writes meanwhile does not count.
    write(reg::kAddrAccess, ~0U);
    write(reg::kAddrAccessData, ~before & 0xFFU);
    EXPECT_EQ(read(reg::kAddrAccess), command(channel, access));
    EXPECT_EQ(read(reg::kAddrAccessData), before);
    const unsigned rested = rest(channel);
    if (channel != last) {
      EXPECT_GE(rested, kRest) << "of this channel";
    }
    EXPECT_LE(rested, kRest + 1);
    last = channel;
    play(channel, script_of(access));
    if (HasFatalFailure()) return;
    clocks(4);
    EXPECT_EQ(status(), 0U);
    EXPECT_EQ(ends, 1U);
    EXPECT_EQ(read(reg::kAddrAccess), command(channel, access) & ~kStart);
    EXPECT_EQ(read(reg::kAddrAccessData), access.bytes[0]);
  }
}

TEST_F(AxiAccessBlock, EncoderThatIsSilent_EndsTheAccess) {
  for (int round = 0; round < 3; ++round) {
    const ControlAccess access = begin(1);
    play(1, script_of(access), access.busy[0] > 0 ? 'w' : 's');
    unsigned frames = 0;
    for (; status() == kActive && frames < 2 * kPatience; ++frames) frame(1, false);
    EXPECT_GE(frames, kPatience);
    EXPECT_LE(frames, kPatience + 2);
    EXPECT_EQ(status(), kSilent);
    for (unsigned i = 0; i < 20; ++i) frame(1, false);
  }
}

// A wrong bit of the echo of R and W.
TEST_F(AxiAccessBlock, WrongEcho_IsAnError) {
  ControlScript script = script_of(begin(2));
  const std::size_t echo = 18;  // behind S and the header with its CRC: 1, 11, 4 bits; R, W
  script.cds[echo - 1] = script.cds[echo - 1] == '1' ? '0' : '1';
  for (std::size_t i = 1; i < script.cdm.size() && status() == kActive; ++i)
    frame(2, script.cds[i] == '1');
  clocks(4);
  EXPECT_EQ(status(), kError);
}

TEST_F(AxiAccessBlock, WhatEndsAnAccess_EndsItAtOnce) {
  enum class How { kHost, kFailed, kClear, kReset };
  for (const How how : {How::kHost, How::kFailed, How::kClear, How::kReset}) {
    for (unsigned frames = 0; frames < 20; ++frames) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(how) << " " << frames);
      const ControlScript script = script_of(begin(1));
      for (unsigned i = 1; i <= frames; ++i) frame(1, script.cds[i] == '1');
      ASSERT_EQ(status(), kActive);
      happens(0, event_t::kFailed(1));
      EXPECT_EQ(status(), kActive) << "another channel";
      ends = 0;
      if (how == How::kHost) write(reg::kAddrAccess, 0);
      if (how == How::kFailed) happens(1, event_t::kFailed(1));
      m.clear_i = how == How::kClear;
      m.rst_ni = how != How::kReset;
      m.eval();
      if (how == How::kReset) {
        EXPECT_EQ(m.end_o, 0);
      }
      clock();
      m.clear_i = 0;
      m.rst_ni = 1;
      clocks(3);
      EXPECT_EQ(status(), how == How::kHost || how == How::kFailed ? kError : 0U);
      EXPECT_EQ(ends, how == How::kReset ? 0U : 1U);
      for (unsigned i = 0; i < 30; ++i) ASSERT_FALSE(frame(1, false)) << i;
    }
  }
}

TEST_F(AxiAccessBlock, ChannelThatIsNotThere_IsAnErrorAtOnce) {
  for (unsigned channel = kChannels; channel < 16; ++channel) {
    ends = 0;
    write(reg::kAddrAccess, command(channel, random_access()));
    clocks(3);
    EXPECT_EQ(status(), kError);
    EXPECT_EQ(ends, 1U);
    for (unsigned i = 0; i < 20; ++i) ASSERT_FALSE(frame(channel % kChannels, false));
  }
  // The next access begins without an error.
  begin(0);
  EXPECT_EQ(status(), kActive);
}

// Nothing runs: there is nothing to end, and during a soft reset nothing begins.
TEST_F(AxiAccessBlock, CommandsThatDoNotCount_ChangeNothing) {
  write(reg::kAddrAccess, 0);
  clocks(3);
  EXPECT_EQ(ends, 0U);
  EXPECT_EQ(status(), 0U);
  m.clear_i = 1;
  write(reg::kAddrAccess, command(1, random_access()));
  m.clear_i = 0;
  clocks(3);
  EXPECT_EQ(status(), 0U);
  // START at another address.
  write(reg::kAddrAccessStatus, kStart);
  write(reg::kAddrTimeout, kStart);
  EXPECT_EQ(status(), 0U);
  for (unsigned i = 0; i < 40; ++i) ASSERT_FALSE(frame(1, false));
}

}  // namespace
