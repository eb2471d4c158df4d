// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares frames decoded from the edges at the pins with the words set in the encoders and what
// the chip has stored, for every protocol, with random lengths, CRCs and delays.
#include "plot/frame_decode.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "plot/line_recording.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/protocol_chip.hpp"

namespace mb4test {

using namespace mb4::tool;

namespace {

using mb4test::ChipPlan;
using mb4test::ProtocolChip;

struct Encoder {
  unsigned bits;
  unsigned flags;
  std::uint64_t raw;
};

struct Case {
  std::string scenario;
  std::vector<Encoder> encoders;
  std::uint64_t delay_ns = 0;
  unsigned busy = 0;
};

Case make_case(const std::string& protocol, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto up_to = [&](std::uint64_t maximum) { return random() % (maximum + 1); };
  const bool ssi = protocol == "ssi";
  Case result;
  // BiSS B and SSI take SL at the edge of MA: no more delay than a period less the set-up time.
  result.delay_ns = protocol == "biss-c" ? up_to(3000) : up_to(700);
  result.busy = ssi ? 0 : static_cast<unsigned>(up_to(9));
  result.scenario = "[[channel]]\nnumber = 1\ndelay_ns = " + std::to_string(result.delay_ns) + "\n";
  constexpr unsigned kPolynomials[] = {0, 0x0B, 0x13, 0x25, 0x43, 0x89, 0x12F, 0x190D9};
  const std::uint64_t count = ssi ? 1 : 1 + up_to(2);
  for (std::uint64_t i = 0; i < count; ++i) {
    Encoder encoder{};
    encoder.bits = static_cast<unsigned>(1 + up_to(63));
    encoder.flags = ssi || encoder.bits < 3 ? 0 : 2;
    encoder.raw = random() >> (64 - encoder.bits);
    const unsigned polynomial = ssi ? 0 : kPolynomials[up_to(7)];
    result.scenario += "[[channel.slave]]\nprotocol = \"" + protocol +
                       "\"\ndata_bits = " + std::to_string(encoder.bits) +
                       "\nflag_bits = " + std::to_string(encoder.flags) +
                       "\ncrc = " + std::to_string(polynomial) + "\ndata = \"" +
                       std::to_string(encoder.raw) + "\"\n";
    if (!ssi) result.scenario += "busy_periods = " + std::to_string(result.busy) + "\n";
    result.encoders.push_back(encoder);
  }
  return result;
}

// 1 MHz: slow enough for every protocol's default timeout and for the delays above.
ChipPlan plan() { return {.freqs = 9}; }

DecodedFrame last_frame(ProtocolChip& chip, const LineRecording& recording) {
  const std::vector<FrameTrace> frames = recording.frames(chip.simulator.now());
  EXPECT_FALSE(frames.empty());
  return frames.empty()
             ? DecodedFrame{}
             : decode_frame(recording, frames.back(), chip.simulator.scenario().channels.front());
}

class FrameDecode : public testing::TestWithParam<const char*> {};

TEST_P(FrameDecode, RandomEncoders_AreReadAsTheyAreSent) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Case one = make_case(GetParam(), seed);
    SCOPED_TRACE(one.scenario);
    ProtocolChip chip(one.scenario, plan());
    LineRecording recording(*clocked(chip.simulator.line(1)));
    ASSERT_TRUE(chip.frame());
    chip.simulator.advance(5 * sim::kPsPerUs);
    const DecodedFrame frame = last_frame(chip, recording);
    EXPECT_TRUE(frame.complete);
    EXPECT_TRUE(frame.good);
    EXPECT_FALSE(frame.cdm);
    ASSERT_EQ(frame.words.size(), one.encoders.size());
    for (unsigned i = 0; i < frame.words.size(); ++i) {
      EXPECT_EQ(frame.words[i], one.encoders[i].raw);
      EXPECT_EQ(chip.scdata(i + 1, one.encoders[i].bits), one.encoders[i].raw);
    }
    if (std::string(GetParam()) == "ssi") continue;
    EXPECT_EQ(frame.delay, one.delay_ns * sim::kPsPerNs);
    EXPECT_EQ(frame.sl.front().to - frame.sl.front().from, (1 + one.busy) * chip.t_ma);
    // Fields follow each other without gaps, one period for each bit.
    for (std::size_t i = 1; i + 1 < frame.sl.size(); ++i) {
      EXPECT_EQ(frame.sl[i].from, frame.sl[i - 1].to);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Protocols, FrameDecode, testing::Values("biss-c", "biss-b", "ssi"),
                         [](const auto& param) {
                           const std::string name = param.param;
                           return name == "ssi" ? name : "biss_" + name.substr(5);
                         });

TEST(FrameDecodeCdm, LevelBehindTheFrame_IsCdmInverted) {
  ProtocolChip chip(make_case("biss-c", 1).scenario, plan());
  LineRecording recording(*clocked(chip.simulator.line(1)));
  for (const bool cdm : {true, false, true}) {
    chip.frame(cdm ? 0x02 : 0x04);
    chip.simulator.advance(5 * sim::kPsPerUs);
    EXPECT_EQ(last_frame(chip, recording).cdm, cdm);
  }
  EXPECT_EQ(recording.frames(chip.simulator.now()).size(), 3U);
}

TEST(FrameDecodeErrors, InvertedBit_IsAWrongCrc) {
  ProtocolChip chip(
      "[[channel]]\nnumber = 1\nflips = [[1, 7], [3, 31]]\n[[channel.slave]]\n"
      "protocol = \"biss-c\"\npreset = \"resolute-26\"\ndata = 0xAAF37BF\n",
      plan());
  LineRecording recording(*clocked(chip.simulator.line(1)));
  for (const bool good : {false, true, false, true}) {
    chip.frame();
    chip.simulator.advance(5 * sim::kPsPerUs);
    const DecodedFrame frame = last_frame(chip, recording);
    EXPECT_TRUE(frame.complete);
    EXPECT_EQ(frame.good, good);
  }
}

TEST(FrameDecodeErrors, SilentEncoder_HasNoFields) {
  ProtocolChip chip(
      "[[channel]]\nnumber = 1\n[[channel.event]]\nat_us = 1\naction = \"sl-high\"\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"resolute-26\"\n",
      plan());
  LineRecording recording(*clocked(chip.simulator.line(1)));
  EXPECT_FALSE(chip.run(0x04, 100));
  chip.instruct(0x80);
  chip.simulator.advance(100 * sim::kPsPerUs);
  const DecodedFrame frame = last_frame(chip, recording);
  EXPECT_FALSE(frame.complete);
  EXPECT_FALSE(frame.good);
  EXPECT_TRUE(frame.words.empty());
}

}  // namespace
}  // namespace mb4test
