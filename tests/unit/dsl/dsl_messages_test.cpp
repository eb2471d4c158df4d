// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The encoder's side of messages: the golden messages of the published facts (D-9, D-10), its
// remote registers, its resources, its faults.
#include "sim/lines/dsl/dsl_messages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/dsl/message_bytes.hpp"

namespace {

using namespace mb4::sim::dsl;
using mb4::sim::RegisterFile;
using mb4::sim::dsl_test::Bytes;
using mb4::sim::dsl_test::with_crc;

constexpr unsigned kIdle = 0x10;

// An encoder with the other end of its channel.
class Peer {
 public:
  explicit Peer(const MessageConfig& config = {}, const ResourceFacts& facts = {})
      : channel(config, facts, registers) {
    channel.on_done = [this](std::span<const std::uint8_t> request) {
      done.emplace_back(request.begin(), request.end());
    };
  }

  // Sends the nibbles of a request, then IDLE, and returns what comes in the next frames.
  std::vector<unsigned> ask(const Bytes& request, unsigned frames) {
    for (const std::uint8_t byte : request) {
      EXPECT_EQ(channel.frame(byte >> 4U), kIdle);
      EXPECT_EQ(channel.frame(byte & 0xFU), kIdle);
    }
    return idle(frames);
  }
  std::vector<unsigned> idle(unsigned frames) {
    std::vector<unsigned> symbols;
    for (unsigned i = 0; i < frames; ++i) symbols.push_back(channel.frame(kIdle));
    return symbols;
  }

  RegisterFile registers;
  std::vector<Bytes> done;
  ParameterChannel channel;
};

std::vector<unsigned> nibbles(const Bytes& bytes, unsigned idle_before = 0,
                              unsigned idle_behind = 1) {
  std::vector<unsigned> all(idle_before, kIdle);
  for (const std::uint8_t byte : bytes) {
    all.push_back(byte >> 4U);
    all.push_back(byte & 0xFU);
  }
  all.insert(all.end(), idle_behind, kIdle);
  return all;
}

// Answer at once.
MessageConfig quick() {
  MessageConfig config;
  config.long_latency = 0;
  return config;
}

void expect_answer(Peer& peer, const Bytes& request, const Bytes& answer) {
  EXPECT_EQ(peer.ask(request, 2 * static_cast<unsigned>(answer.size()) + 1), nibbles(answer));
}

// ---- Golden messages (D-10) ---------------------------------------------------------------------

TEST(DslEncoderMessages, GoldenShortMessages_AreAnswered) {
  Peer peer;
  // ENC_ST0 reads 01 after the start, SRSSI 7, PING what was written (D-9).
  expect_answer(peer, {0x40, 0x87, 0x75}, with_crc({0x40, 0x01}));
  expect_answer(peer, {0x7C, 0xAB, 0xF6}, with_crc({0x7C, 0x07}));
  expect_answer(peer, {0x3F, 0xAB, 0xAE, 0x93}, {0x3F, 0x0D, 0xCE});
  expect_answer(peer, {0x7F, 0x8A, 0x44}, {0x7F, 0xAB, 0x68, 0xE3});
  expect_answer(peer, with_crc({0x3F, 0xCD}), {0x3F, 0x0D, 0xCE});
  expect_answer(peer, {0x7F, 0x8A, 0x44}, with_crc({0x7F, 0xCD}));
  EXPECT_EQ(peer.done.size(), 6U);
}

TEST(DslEncoderMessages, GoldenLongMessages_AreAnswered) {
  Peer peer(quick());
  expect_answer(peer, {0xC8, 0x00, 0xC2, 0x78}, with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  expect_answer(peer, {0xCC, 0x81, 0xC1, 0x0B},
                {0xCC, 0x81, 0x52, 0x45, 0x53, 0x4F, 0x4C, 0x55, 0x54, 0x4E, 0xDB, 0x8C});
  // RID 081h offset 3: the level of a write is 15.
  expect_answer(peer, with_crc({0xE4, 0x81, 0x80, 0x03}), with_crc({0xC4, 0x81, 0x00, 0x0F}));
  // A write to RID 000h is not possible: 41/10, the low code first.
  expect_answer(peer, with_crc({0x84, 0x00, 0x12, 0x34}), with_crc({0xA4, 0x00, 0x10, 0x41}));
}

// ---- Remote registers ---------------------------------------------------------------------------

TEST(DslEncoderMessages, RemoteRegisters_ReadAndWriteByTheirRules) {
  Peer peer;
  peer.registers.set(0x43, 0x5A);
  peer.registers.set(0x7C, 2);
  expect_answer(peer, with_crc({0x43}), with_crc({0x43, 0x5A}));
  // Status bits are cleared by writing 0.
  expect_answer(peer, with_crc({0x03, 0x0F}), with_crc({0x03}));
  EXPECT_EQ(peer.registers.get(0x43), 0x0A);
  // Reading the strength sets it to 7.
  expect_answer(peer, with_crc({0x7C}), with_crc({0x7C, 2}));
  expect_answer(peer, with_crc({0x7C}), with_crc({0x7C, 7}));
  expect_answer(peer, with_crc({0x3E, 0x99}), with_crc({0x3E}));
  EXPECT_EQ(peer.registers.get(0x7E), 0x99);
  // What is not there, or not in this direction, is refused and not done.
  const std::size_t before = peer.done.size();
  for (const Bytes& request :
       {with_crc({0x48}), with_crc({0x7E}), with_crc({0x3C, 1}), with_crc({0x10, 1})}) {
    EXPECT_EQ(peer.ask(request, 2), (std::vector<unsigned>{0x15, kIdle}));
  }
  EXPECT_EQ(peer.done.size(), before);
}

TEST(DslEncoderMessages, BrokenRequests_AreRefused) {
  Peer peer(quick());
  EXPECT_EQ(peer.ask({0x7F, 0x8A, 0x45}, 2), (std::vector<unsigned>{0x15, kIdle}));
  EXPECT_EQ(peer.ask({0x7F, 0x8A}, 3), (std::vector<unsigned>{kIdle, 0x15, kIdle}));
  EXPECT_EQ(peer.ask({0xC8, 0x00, 0xC2, 0x79}, 2), (std::vector<unsigned>{0x1A, kIdle}));
  EXPECT_EQ(peer.ask({0xC8, 0x00}, 3), (std::vector<unsigned>{kIdle, 0x1A, kIdle}));
  EXPECT_TRUE(peer.done.empty());
}

TEST(DslEncoderMessages, SameRequestAgain_IsAnsweredOnce) {
  MessageConfig config;
  config.short_latency = 12;
  Peer peer(config);
  const Bytes ping{0x3F, 0xAB, 0xAE, 0x93};
  EXPECT_EQ(peer.ask(ping, 1), std::vector<unsigned>(1, kIdle));
  EXPECT_EQ(peer.ask(ping, 30), nibbles({0x3F, 0x0D, 0xCE}, 3, 21));
  EXPECT_EQ(peer.done.size(), 1U);
}

TEST(DslEncoderMessages, OtherRequest_TakesThePlaceOfTheFirst) {
  MessageConfig config;
  config.short_latency = 12;
  Peer peer(config);
  peer.ask({0x3F, 0xAB, 0xAE, 0x93}, 1);
  EXPECT_EQ(peer.ask(with_crc({0x3F, 0x55}), 30), nibbles({0x3F, 0x0D, 0xCE}, 12, 12));
  EXPECT_EQ(peer.registers.get(0x7F), 0x55);
  EXPECT_EQ(peer.done.size(), 1U);
}

TEST(DslEncoderMessages, Init_EndsWhatIsUnderWay) {
  Peer peer;
  peer.ask({0xC8, 0x00, 0xC2, 0x78}, 4);
  peer.channel.reset();
  EXPECT_EQ(peer.idle(40), std::vector<unsigned>(40, kIdle));
}

// ---- Short and long together --------------------------------------------------------------------

TEST(DslEncoderMessages, ShortOne_PartsALongOne) {
  Peer peer(quick());
  const std::vector<unsigned> name =
      nibbles({0xCC, 0x81, 0x52, 0x45, 0x53, 0x4F, 0x4C, 0x55, 0x54, 0x4E, 0xDB, 0x8C}, 0, 0);
  std::vector<unsigned> seen = peer.ask({0xCC, 0x81, 0xC1, 0x0B}, 3);
  for (const unsigned nibble : {0x7U, 0xFU, 0x8U, 0xAU, 0x4U, 0x4U}) {
    seen.push_back(peer.channel.frame(nibble));
  }
  std::vector<unsigned> wanted(name.begin(), name.begin() + 9);
  EXPECT_EQ(seen, wanted);
  wanted = nibbles(with_crc({0x7F, 0x01}), 1, 1);
  wanted.insert(wanted.end(), name.begin() + 9, name.end());
  wanted.push_back(kIdle);
  EXPECT_EQ(peer.idle(1 + 8 + 1 + 15 + 1), wanted);
}

TEST(DslEncoderMessages, ShortOne_WaitsForALongOne) {
  MessageConfig config = quick();
  config.short_inside_long = false;
  Peer peer(config);
  peer.ask({0xC8, 0x00, 0xC2, 0x78}, 3);
  for (const unsigned nibble : {0x7U, 0xFU, 0x8U, 0xAU, 0x4U, 0x4U}) peer.channel.frame(nibble);
  const Bytes name = with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'});
  std::vector<unsigned> wanted = nibbles(name);
  wanted.erase(wanted.begin(), wanted.begin() + 9);
  const std::vector<unsigned> version = nibbles(with_crc({0x7F, 0x01}));
  wanted.insert(wanted.end(), version.begin(), version.end());
  EXPECT_EQ(peer.idle(8 + 8 + 1), wanted);
}

// ---- Resources ----------------------------------------------------------------------------------

Resource resource(unsigned id, ResourceType type, Bytes value, unsigned write_level = 0) {
  Resource made;
  made.id = id;
  made.name = "OWN";
  made.type = type;
  made.value = std::move(value);
  made.write_level = write_level;
  return made;
}

TEST(DslEncoderMessages, OwnResources_ReadAndWriteByTheirRules) {
  MessageConfig config = quick();
  config.access_level = 2;
  config.resources = {resource(0x300, ResourceType::kU8, {0xA5}, 2),
                      resource(0x301, ResourceType::kI16, {0xFF, 0x85}, 3),
                      resource(0x302, ResourceType::kString, {'h', 'e', 'l', 'l', 'o'}, 0),
                      resource(0x3FF, ResourceType::kNode, {})};
  config.resources[1].parent = 0x3FF;
  config.resources[0].timeout_ms = 0x1234;
  Peer peer(config);
  const auto ask = [&peer](const Bytes& request, const Bytes& answer) {
    expect_answer(peer, with_crc(request), with_crc(answer));
  };
  ask({0xD7, 0x00}, {0xD7, 0x00, 0x00, 0xA5});
  ask({0xDB, 0x01}, {0xDB, 0x01, 0xFF, 0xFF, 0xFF, 0x85});  // widened by its sign
  ask({0x97, 0x00, 0x00, 0x42}, {0x97, 0x00, 0x00, 0x42});  // a write repeats its data
  ask({0xD7, 0x00}, {0xD7, 0x00, 0x00, 0x42});
  ask({0x97, 0x01, 0x00, 0x42}, {0xB7, 0x01, 0x12, 0x41});  // level 2 is below 3
  ask({0xF7, 0x02, 0x80, 0x03}, {0xD7, 0x02, 'l', 'o'});    // from an offset on
  ask({0xB7, 0x02, 0x80, 0x01, 'a', 'b'}, {0x97, 0x02, 'a', 'b'});
  ask({0xDF, 0x02}, {0xDF, 0x02, 'h', 'a', 'b', 'l', 'o', 0, 0, 0});
  ask({0xF7, 0x02, 0x80, 0x05}, {0xF7, 0x02, 0x12, 0x40});  // behind its end
  ask({0xE7, 0x00, 0x80, 0x04}, {0xC7, 0x00, 0x12, 0x34});  // its time-out
  ask({0xE7, 0x01, 0x80, 0x05}, {0xC7, 0x01, 0x00, 0x08});  // its type
  ask({0xE7, 0x01, 0x80, 0x06}, {0xE7, 0x01, 0x12, 0x40});
  ask({0xD7, 0xFF}, {0xD7, 0xFF, 0x00, 0x01});              // one child
  ask({0xF7, 0xFF, 0x80, 0x01}, {0xD7, 0xFF, 0x03, 0x01});  // which is 301h
  ask({0xC6, 0x00}, {0xE6, 0x00, 0x10, 0x40});              // 200h is not there
  ask({0xD3, 0x00}, {0xD3, 0x00});                          // no data asked for
}

TEST(DslEncoderMessages, Reset_RestoresPing) {
  Peer peer(quick());
  expect_answer(peer, {0x3F, 0xAB, 0xAE, 0x93}, {0x3F, 0x0D, 0xCE});
  expect_answer(peer, with_crc({0x91, 0x00}), with_crc({0x91, 0x00}));
  EXPECT_EQ(peer.registers.get(0x7F), 1);
}

TEST(DslEncoderMessages, WriteAnswerWithoutData) {
  MessageConfig config = quick();
  config.write_answer_data = false;
  config.resources = {resource(0x300, ResourceType::kU8, {0xA5})};
  Peer peer(config);
  expect_answer(peer, with_crc({0x97, 0x00, 0x00, 0x42}), with_crc({0x93, 0x00}));
}

// ---- Faults -------------------------------------------------------------------------------------

TEST(DslEncoderMessages, EachFault_ChangesTheAnswer) {
  const struct {
    bool MessageFaults::*fault;
    std::vector<unsigned> shorts;  // for a read of PING
    std::vector<unsigned> longs;   // for a read of the name of ROOT
    bool done;
  } kCases[] = {
      {&MessageFaults::lost_nibble, {7, 15, 1, 7, 1, 4, 7, kIdle}, {}, true},
      {&MessageFaults::wrong_crc, {}, {}, true},
      {&MessageFaults::nak, {0x15, kIdle}, {0x1A, kIdle}, false},
      {&MessageFaults::silent, {kIdle}, {kIdle}, false},
      {&MessageFaults::late, nibbles(with_crc({0x7F, 1}), 5),
       nibbles(with_crc({0xC8, 0, 'R', 'O', 'O', 'T'}), 5), true},
      {&MessageFaults::foreign_address, nibbles(with_crc({0x7E, 1})),
       nibbles(with_crc({0xC8, 1, 0, 0, 0, 0})), false},
      {&MessageFaults::foreign_direction, nibbles(with_crc({0x3F})),
       nibbles(with_crc({0x88, 0, 0, 0, 0, 0})), false},
      {&MessageFaults::foreign_length, nibbles(with_crc({0x7F})),
       nibbles(with_crc({0xCC, 0, 0, 0, 0, 0, 0, 0, 0, 0})), false},
  };
  for (std::size_t i = 0; i < std::size(kCases); ++i) {
    SCOPED_TRACE(i);
    const auto& test = kCases[i];
    for (const bool is_long : {false, true}) {
      MessageConfig config = quick();
      config.late = 5;
      Peer peer(config);
      peer.channel.faults().*test.fault = true;
      const Bytes request = is_long ? Bytes{0xC8, 0x00, 0xC2, 0x78} : Bytes{0x7F, 0x8A, 0x44};
      const std::vector<unsigned>& wanted = is_long ? test.longs : test.shorts;
      const std::vector<unsigned> seen = peer.ask(request, 40);
      if (!wanted.empty()) {
        EXPECT_EQ(std::vector<unsigned>(seen.begin(),
                                        seen.begin() + static_cast<std::ptrdiff_t>(wanted.size())),
                  wanted);
      }
      EXPECT_EQ(!peer.done.empty(), test.done);
    }
  }
  // The last bit, and a nibble less.
  Peer wrong;
  wrong.channel.faults().wrong_crc = true;
  Bytes answer = with_crc({0x7F, 1});
  answer.back() ^= 1U;
  EXPECT_EQ(wrong.ask({0x7F, 0x8A, 0x44}, 9), nibbles(answer));
}

}  // namespace
