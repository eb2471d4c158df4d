// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages of the model of the master: each rule by itself, symbol by symbol, and both ends of the
// channel in random transactions, one in four of them disturbed (D-9, D-10, D-12).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/dsl/dsl_messages.hpp"
#include "sim/masters/dsl_model/host_bytes.hpp"
#include "sim/masters/dsl_model/messages.hpp"
#include "tests/unit/dsl/dsl_bench.hpp"
#include "tests/unit/dsl/dsl_dialogue.hpp"
#include "tests/unit/dsl/message_bytes.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_model;
using dsl_test::Dialogue;
using dsl_test::HostPort;
using dsl_test::transactions;
namespace address = host_address;
namespace mask = host_bit;
using dsl_test::Bytes;
using dsl_test::with_crc;
using Symbols = std::vector<unsigned>;

constexpr unsigned kIdleSymbol = 0x10;
constexpr unsigned kSnak = 0x15;
constexpr unsigned kLnak = 0x1A;
constexpr unsigned kInitSymbol = 0x1E;
constexpr unsigned kInitialised = 0x1F;
constexpr unsigned kUnreadable = 0x100;

const FrameNews kLinked{.linked = true, .lost = false, .safe1 = {}, .safe2 = {}};

Symbols nibbles(const Bytes& bytes) {
  Symbols all;
  for (const std::uint8_t byte : bytes) {
    all.push_back(byte >> 4U);
    all.push_back(byte & 0xFU);
  }
  return all;
}

Symbols idle(unsigned count) { return Symbols(count, kIdleSymbol); }

Symbols join(std::initializer_list<Symbols> parts) {
  Symbols all;
  for (const Symbols& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// ---- The master against a script ----------------------------------------------------------------

// The host's registers with a link that runs; the test says what the encoder sends.
class Script {
 public:
  explicit Script(const MessageRules& rules = {}) : host(rules) {
    host.reset_begins();
    host.link_begins();
    EXPECT_EQ(frames(8), idle(8));
    clear();
  }
  void clear() {
    for (const unsigned at : {address::kEventH, address::kEventL, address::kEventS}) {
      host.write(at, 0);
    }
  }
  // A frame: returns what the master sends.
  unsigned frame(unsigned answer = kIdleSymbol) {
    const unsigned sent = host.symbol();
    Word word;
    word.byte = static_cast<std::uint8_t>(answer);
    word.error = answer == kUnreadable;
    host.frame(word, kLinked);
    return sent;
  }
  Symbols frames(unsigned count) {
    Symbols sent;
    for (unsigned i = 0; i < count; ++i) sent.push_back(frame());
    return sent;
  }
  // The encoder sends these; the master has to be silent.
  void answer(const Symbols& symbols) {
    for (const unsigned symbol : symbols) EXPECT_EQ(frame(symbol), kIdleSymbol);
  }
  void bytes(const Bytes& bytes) { answer(nibbles(bytes)); }
  void expect_request(const Bytes& bytes) {
    EXPECT_EQ(frames(1), idle(1));
    EXPECT_EQ(frames(2 * static_cast<unsigned>(bytes.size())), nibbles(bytes));
  }
  std::uint8_t events() const {
    return host.read(address::kEventL) & 0x33;
  }  // MIN, ANS, FREL, FRES
  std::uint8_t safe_events() const { return host.read(address::kEventS) & 0x03; }
  void start(std::uint8_t header, std::uint8_t low) {
    host.write(address::kAddH, header);
    host.write(address::kAddL, low);
    host.write(address::kCtrl, mask::kStart);
  }

  HostBytes host;
};

TEST(DslTalk, GoldenShortRequests_AreSent) {
  const struct {
    std::uint8_t control;
    std::uint8_t data;
    Bytes request;
    Bytes answer;
  } kCases[] = {{0xFF, 0, {0x7F, 0x8A, 0x44}, {0x7F, 0xAB, 0x68, 0xE3}},
                {0xC0, 0, {0x40, 0x87, 0x75}, with_crc({0x40, 0x01})},
                {0xFC, 0, {0x7C, 0xAB, 0xF6}, with_crc({0x7C, 0x07})},
                {0x7F, 0xAB, {0x3F, 0xAB, 0xAE, 0x93}, {0x3F, 0x0D, 0xCE}}};
  for (const bool sdk_map : {false, true}) {
    for (const auto& test : kCases) {
      Script script({.sdk_map = sdk_map});
      const unsigned data = sdk_map ? address::kSafeData : address::kData;
      script.host.write(data, test.data);
      script.host.write(address::kControl, test.control);
      EXPECT_EQ(script.host.read(address::kControl), test.control);
      script.expect_request(test.request);
      EXPECT_EQ(script.events() | script.safe_events(), 0);
      script.bytes(test.answer);
      EXPECT_EQ(script.events(), sdk_map ? 0 : mask::kFres);
      EXPECT_EQ(script.safe_events(), sdk_map ? mask::kSafeFres : 0);
      EXPECT_EQ(script.host.read(data), test.answer.size() == 4 ? test.answer[1] : test.data);
      EXPECT_EQ(script.host.read(address::kControl), 0x3F);
      EXPECT_EQ(script.frames(100), idle(100));
    }
  }
}

TEST(DslTalk, GoldenLongRequests_AreSent) {
  Script script;
  script.start(0xC8, 0x00);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
  script.start(0xCC, 0x81);                  // ignored: one is under way
  EXPECT_EQ(script.frames(300), idle(300));  // no limit of time
  script.bytes(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  EXPECT_EQ(script.events(), mask::kFrel);
  for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(script.host.read(address::kBuffer0 + i), "ROOT"[i]);
  EXPECT_EQ(script.host.read(address::kBuffer0 + 4), 0);

  script.start(0xCC, 0x81);
  EXPECT_EQ(script.events(), 0);  // the start has cleared FREL
  script.expect_request({0xCC, 0x81, 0xC1, 0x0B});
  script.bytes(Bytes{0xCC, 0x81, 0x52, 0x45, 0x53, 0x4F, 0x4C, 0x55, 0x54, 0x4E, 0xDB, 0x8C});
  EXPECT_EQ(script.events(), mask::kFrel);
  for (unsigned i = 0; i < 8; ++i) {
    EXPECT_EQ(script.host.read(address::kBuffer0 + i), "RESOLUTN"[i]);
  }
  // An offset, and bit 7 of both high bytes.
  script.host.write(address::kOffH, 0x00);
  script.host.write(address::kOffL, 0x03);
  script.start(0x64, 0x81);
  script.expect_request(with_crc({0xE4, 0x81, 0x80, 0x03}));
  script.bytes(with_crc({0xC4, 0x81, 0x00, 0x0F}));
  EXPECT_EQ(script.host.read(address::kBuffer0), 0x00);
  EXPECT_EQ(script.host.read(address::kBuffer0 + 1), 0x0F);
  EXPECT_EQ(script.host.read(address::kBuffer0 + 2), 'S');  // as it was
}

TEST(DslTalk, LongWrite_TakesTheBuffer) {
  for (const unsigned code : {0U, 1U, 2U, 3U}) {
    const unsigned length = code == 0 ? 0 : 1U << code;
    Script script;
    Bytes request{static_cast<std::uint8_t>(0x91 | code << 2U), 0x55};
    for (unsigned i = 0; i < 8; ++i) {
      const auto byte = static_cast<std::uint8_t>(0xA0 + i);
      script.host.write(address::kBuffer0 + i, byte);
      EXPECT_EQ(script.host.read(address::kBuffer0 + i), byte);
      if (i < length) request.push_back(byte);
    }
    script.start(request[0], request[1]);
    script.host.write(address::kBuffer0, 0x11);  // ignored
    script.host.write(address::kAddL, 0x11);
    script.expect_request(with_crc(request));
    script.bytes(with_crc(request));
    EXPECT_EQ(script.events(), mask::kFrel);
    EXPECT_EQ(script.host.read(address::kBuffer0), 0xA0);
    // Or without data.
    script.start(request[0], request[1]);
    script.expect_request(with_crc(request));
    script.answer(idle(1));
    script.bytes(with_crc({static_cast<std::uint8_t>(request[0] & 0xF3), 0x55}));
    EXPECT_EQ(script.events(), mask::kFrel);
  }
}

TEST(DslTalk, ErrorAnswer_EndsNormally) {
  for (const bool sdk_map : {false, true}) {
    Script script({.sdk_map = sdk_map});
    script.start(0x84, 0x00);
    script.expect_request(with_crc({0x84, 0x00, 0, 0}));
    script.bytes(with_crc({0xA4, 0x00, 0x10, 0x41}));
    EXPECT_EQ(script.events(), mask::kFrel);
    EXPECT_EQ(script.host.read(address::kAddH), 0xA4);
    EXPECT_EQ(script.host.read(address::kBuffer0), sdk_map ? 0x41 : 0x10);
    EXPECT_EQ(script.host.read(address::kBuffer0 + 1), sdk_map ? 0x10 : 0x41);
    // Without data.
    script.start(0xC4, 0x00);
    script.expect_request(with_crc({0xC4, 0x00}));
    script.bytes(with_crc({0xE0, 0x00}));
    EXPECT_EQ(script.events(), mask::kFrel);
    EXPECT_EQ(script.host.read(address::kAddH), 0xE0);
  }
}

TEST(DslTalk, ReadOfNoBytes_Ends) {
  Script script;
  script.start(0xC0, 0x81);
  script.expect_request(with_crc({0xC0, 0x81}));
  script.bytes(with_crc({0xC0, 0x81}));
  EXPECT_EQ(script.events(), mask::kFrel);
}

// 64 frames without an answer, or a NAK: the same bytes again, without end (R16).
TEST(DslTalk, ShortRequest_IsRepeated) {
  const Bytes ping{0x7F, 0x8A, 0x44};
  Script script;
  script.host.write(address::kControl, 0xFF);
  script.expect_request(ping);
  for (unsigned i = 1; i <= 20; ++i) {
    EXPECT_EQ(script.frames(64), idle(64));
    EXPECT_EQ(script.frames(6), nibbles(ping));
    EXPECT_EQ(script.host.messages().retries(), i);
  }
  // NAK in the frame of the last nibble, and later.
  EXPECT_EQ(script.frames(10), idle(10));
  EXPECT_EQ(script.frame(kSnak), kIdleSymbol);
  EXPECT_EQ(script.frames(6), join({idle(1), {7, 15, 8, 10, 4}}));
  EXPECT_EQ(script.frame(kSnak), 4U);
  EXPECT_EQ(script.frames(7), join({idle(1), nibbles(ping)}));
  EXPECT_EQ(script.host.messages().retries(), 22);
  EXPECT_EQ(script.events(), 0);
  script.answer({kIdleSymbol});
  EXPECT_EQ(script.frames(63), idle(63));
}

// The answer to the first request may come twice when the request was sent twice.
TEST(DslTalk, AnswerAfterARepetition_EndsAfterItsTime) {
  const Bytes write{0x3F, 0xAB, 0xAE, 0x93};
  const Bytes done{0x3F, 0x0D, 0xCE};
  Script script;
  script.host.write(address::kData, 0xAB);
  script.host.write(address::kControl, 0x7F);
  script.expect_request(write);
  EXPECT_EQ(script.frames(64 + 8), join({idle(64), nibbles(write)}));
  script.bytes(done);
  EXPECT_EQ(script.events(), 0);
  script.answer(idle(20));
  script.bytes(done);  // the second one is dropped
  EXPECT_EQ(script.host.messages().foreign(), 1);
  script.answer(idle(64 - 6 - 20 - 6 - 1));
  EXPECT_EQ(script.events(), 0);
  script.answer(idle(1));
  EXPECT_EQ(script.events(), mask::kFres);
}

// The rest of a repetition is not sent when the answer comes.
TEST(DslTalk, AnswerDuringARepetition_EndsIt) {
  const Bytes ping{0x7F, 0x8A, 0x44};
  const Symbols answer = nibbles({0x7F, 0xAB, 0x68, 0xE3});
  Script script;
  script.host.write(address::kControl, 0xFF);
  script.expect_request(ping);
  EXPECT_EQ(script.frames(64), idle(64));
  EXPECT_EQ(script.frame(), 7U);
  EXPECT_EQ(script.frame(answer[0]), 15U);
  script.answer(Symbols(answer.begin() + 1, answer.end()));
  EXPECT_EQ(script.events(), mask::kFres);
  EXPECT_EQ(script.host.read(address::kData), 0xAB);
  // An answer that begins just before: the repetition waits, and comes if the answer is none.
  script.host.write(address::kControl, 0xFF);
  script.expect_request(ping);
  EXPECT_EQ(script.frames(63), idle(63));
  script.answer(Symbols(answer.begin(), answer.begin() + 5));
  script.answer({kUnreadable});
  EXPECT_EQ(script.frames(7), join({idle(1), nibbles(ping)}));
}

TEST(DslTalk, BrokenAnswers_AreNone) {
  const Bytes good{0x7F, 0xAB, 0x68, 0xE3};
  const Symbols all = nibbles(good);
  // A nibble that cannot be read, IDLE, NAK of the other kind, a wrong nibble: at each place.
  for (std::size_t place = 1; place < all.size(); ++place) {
    for (const unsigned wrong : {kUnreadable, kIdleSymbol, kLnak, kInitialised, all[place] ^ 1U}) {
      Script script;
      script.host.write(address::kControl, 0xFF);
      script.expect_request({0x7F, 0x8A, 0x44});
      Symbols symbols = all;
      symbols[place] = wrong;
      script.answer(symbols);
      EXPECT_EQ(script.events(), 0);
      EXPECT_EQ(script.host.messages().foreign(), 0);
      script.answer(idle(1));
      script.bytes(good);
      EXPECT_EQ(script.events(), mask::kFres);
    }
  }
}

TEST(DslTalk, BrokenLongAnswer_SetsAns) {
  const Symbols all = nibbles(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  for (std::size_t place = 1; place < all.size(); ++place) {
    for (const unsigned wrong :
         {kUnreadable, kIdleSymbol, kSnak, kLnak, kInitialised, all[place] ^ 2U}) {
      // Another length of the answer is another answer, which ends too early or too late.
      Script script;
      script.start(0xC8, 0x00);
      script.expect_request({0xC8, 0x00, 0xC2, 0x78});
      Symbols symbols = all;
      symbols[place] = wrong;
      script.answer(symbols);
      script.answer(idle(1));
      EXPECT_EQ(script.events(), mask::kAns | mask::kFrel) << place << ' ' << wrong;
      EXPECT_NE(script.host.read(address::kOnlineD + 1) & mask::kAns, 0);
      EXPECT_EQ(script.host.read(address::kBuffer0), 0);
      script.start(0xC8, 0x00);
      EXPECT_EQ(script.events(), mask::kAns);
      EXPECT_EQ(script.host.read(address::kOnlineD + 1) & mask::kAns, 0);
    }
  }
}

TEST(DslTalk, LongNak_SetsAns) {
  Script script;
  script.answer({kLnak, kSnak});  // nothing is under way
  EXPECT_EQ(script.events(), 0);
  script.start(0xC8, 0x00);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
  script.answer({kLnak});
  EXPECT_EQ(script.events(), mask::kAns | mask::kFrel);
  EXPECT_EQ(script.frames(200), idle(200));  // not repeated
}

// Another address, direction or length: dropped and counted.
TEST(DslTalk, ForeignAnswers_AreDropped) {
  const struct {
    std::uint8_t control;
    std::uint8_t header;
    Bytes foreign;
  } kShorts[] = {{0xFF, 0x7F, {0x7E, 1}},
                 {0xFF, 0x7F, {0x3F}},
                 {0x7F, 0x3F, {0x3E}},
                 {0x7F, 0x3F, {0x7F, 1}},
                 {0xC0, 0x40, {0x60, 1}}};
  for (const bool check : {true, false}) {
    for (const auto& test : kShorts) {
      Script script({.check_answers = check});
      script.host.write(address::kControl, test.control);
      const bool read = (test.header & 0x40) != 0;
      script.expect_request(with_crc(read ? Bytes{test.header} : Bytes{test.header, 0}));
      script.bytes(with_crc(test.foreign));
      EXPECT_EQ(script.events(), check ? 0 : mask::kFres);
      EXPECT_EQ(script.host.messages().foreign(), check ? 1 : 0);
      script.answer(idle(1));
      script.bytes(with_crc(read ? Bytes{test.header, 0x42} : Bytes{test.header}));
      EXPECT_EQ(script.events(), mask::kFres);
      EXPECT_EQ(script.host.messages().foreign(), 1);
    }
    const Bytes kLongs[] = {{0xC8, 0x01, 0, 0, 0, 0},
                            {0xC9, 0x00, 0, 0, 0, 0},
                            {0x88, 0x00, 0, 0, 0, 0},
                            {0xC4, 0x00, 0, 0},
                            {0xCC, 0x00, 0, 0, 0, 0, 0, 0, 0, 0},
                            {0xC0, 0x00},
                            {0xA4, 0x00, 0x10, 0x41}};
    for (const Bytes& foreign : kLongs) {
      Script script({.check_answers = check});
      script.start(0xC8, 0x00);
      script.expect_request({0xC8, 0x00, 0xC2, 0x78});
      script.bytes(with_crc(foreign));
      EXPECT_EQ(script.events(), check ? 0 : mask::kFrel);
      EXPECT_EQ(script.host.messages().foreign(), check ? 1 : 0);
      if (!check) continue;
      EXPECT_EQ(script.host.read(address::kBuffer0), 0);
      script.answer(idle(1));
      script.bytes(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
      EXPECT_EQ(script.events(), mask::kFrel);
    }
  }
  // Nothing is asked for.
  Script script;
  script.bytes(with_crc({0x7F, 0xAB}));
  script.answer(idle(1));
  script.bytes(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  EXPECT_EQ(script.host.messages().foreign(), 2);
  EXPECT_EQ(script.events(), 0);
}

// An answer that began before its request was whole is none.
TEST(DslTalk, AnswerThatBeganTooEarly_IsForeign) {
  const Symbols ping = nibbles({0x7F, 0xAB, 0x68, 0xE3});
  Script script;
  script.host.write(address::kControl, 0xFF);
  EXPECT_EQ(script.frames(5), join({idle(1), {7, 15, 8, 10}}));
  EXPECT_EQ(script.frame(ping[0]), 4U);
  EXPECT_EQ(script.frame(ping[1]), 4U);  // the last nibble of the request
  script.answer(Symbols(ping.begin() + 2, ping.end()));
  EXPECT_EQ(script.events(), 0);
  EXPECT_EQ(script.host.messages().foreign(), 1);
  script.answer(idle(1));
  script.answer(ping);
  EXPECT_EQ(script.events(), mask::kFres);
  // One that begins with the last nibble may be right.
  script.host.write(address::kControl, 0xFF);
  EXPECT_EQ(script.frames(6), join({idle(1), {7, 15, 8, 10, 4}}));
  EXPECT_EQ(script.frame(ping[0]), 4U);
  script.answer(Symbols(ping.begin() + 1, ping.end()));
  EXPECT_EQ(script.events(), mask::kFres);
}

// A direct and an indirect answer are not told apart.
TEST(DslTalk, IndirectBit_IsNotCompared) {
  Script script;
  script.start(0xD4, 0x80);
  script.expect_request(with_crc({0xD4, 0x80}));
  script.bytes(with_crc({0xC4, 0x80, 0, 2}));
  EXPECT_EQ(script.events(), mask::kFrel);
}

// Short before long, main before safe, one at a time.
TEST(DslTalk, Owner_IsShortBeforeLongAndMainBeforeSafe) {
  Script script;
  script.start(0xC8, 0x00);
  script.host.write(address::kSafeData, 0x77);
  script.host.write(address::kSafeControl, 0x7E);
  script.host.write(address::kControl, 0xFF);
  script.expect_request({0x7F, 0x8A, 0x44});
  EXPECT_EQ(script.frames(30), idle(30));
  script.bytes(Bytes{0x7F, 0xAB, 0x68, 0xE3});
  EXPECT_EQ(script.events(), mask::kFres);
  EXPECT_EQ(script.safe_events(), 0);
  script.expect_request(with_crc({0x3E, 0x77}));
  script.bytes(with_crc({0x3E}));
  EXPECT_EQ(script.safe_events(), mask::kSafeFres);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
}

TEST(DslTalk, LongRequest_IsNotInterrupted) {
  Script script;
  script.start(0xC8, 0x00);
  EXPECT_EQ(script.frames(1), idle(1));
  script.host.write(address::kControl, 0xFF);
  const Symbols wanted =
      join({nibbles({0xC8, 0x00, 0xC2, 0x78}), idle(1), nibbles({0x7F, 0x8A, 0x44}), idle(1)});
  EXPECT_EQ(script.frames(static_cast<unsigned>(wanted.size())), wanted);
  // The short answer comes while the long one is awaited.
  script.bytes(Bytes{0x7F, 0xAB, 0x68, 0xE3});
  EXPECT_EQ(script.events(), mask::kFres);
  script.answer(idle(1));
  script.bytes(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  EXPECT_EQ(script.events(), mask::kFres | mask::kFrel);
}

// The short answer parts the long one, or comes behind it.
TEST(DslTalk, LongAnswer_IsTakenInParts) {
  const Symbols name = nibbles(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  const Symbols ping = nibbles({0x7F, 0xAB, 0x68, 0xE3});
  for (std::size_t part = 1; part < name.size(); ++part) {
    Script script;
    script.start(0xC8, 0x00);
    script.expect_request({0xC8, 0x00, 0xC2, 0x78});
    script.host.write(address::kControl, 0xFF);
    script.expect_request({0x7F, 0x8A, 0x44});
    script.answer(Symbols(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(part)));
    script.answer(idle(1));
    script.answer(ping);
    EXPECT_EQ(script.events(), mask::kFres) << part;
    script.answer(idle(1));
    script.answer(Symbols(name.begin() + static_cast<std::ptrdiff_t>(part), name.end()));
    EXPECT_EQ(script.events(), mask::kFres | mask::kFrel) << part;
    EXPECT_EQ(script.host.read(address::kBuffer0), 'R');
  }
  Script script;
  script.start(0xC8, 0x00);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
  script.host.write(address::kControl, 0xFF);
  script.expect_request({0x7F, 0x8A, 0x44});
  script.answer(name);
  EXPECT_EQ(script.events(), mask::kFrel);
  script.answer(idle(1));
  script.answer(ping);
  EXPECT_EQ(script.events(), mask::kFres | mask::kFrel);
}

TEST(DslTalk, LongAnswerThatStops_IsBrokenAfter64Frames) {
  Script script;
  script.start(0xC8, 0x00);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
  script.host.write(address::kControl, 0xFF);
  script.expect_request({0x7F, 0x8A, 0x44});
  script.answer({0xC, 0x8, 0x0});
  script.answer(idle(40));
  script.bytes(Bytes{0x7F, 0xAB, 0x68, 0xE3});
  script.answer(idle(62));
  EXPECT_EQ(script.events(), mask::kFres);
  script.answer(idle(1));
  EXPECT_EQ(script.events(), mask::kFres | mask::kFrel | mask::kAns);
}

TEST(DslTalk, MessageReset_IsSentUntilItIsAcknowledged) {
  Script script;
  script.start(0xC8, 0x00);
  script.host.write(address::kControl, 0xFF);
  EXPECT_EQ(script.frames(4), join({idle(1), {7, 15, 8}}));
  script.host.write(address::kSysCtrl, mask::kMrst);
  EXPECT_EQ(script.host.read(address::kSysCtrl), mask::kMrst);
  EXPECT_EQ(script.frames(5), Symbols(5, kInitSymbol));
  script.host.write(address::kSafeControl, 0xFF);  // dropped
  EXPECT_EQ(script.frame(kUnreadable), kInitSymbol);
  EXPECT_EQ(script.events(), 0);
  EXPECT_EQ(script.frame(kInitialised), kInitSymbol);
  EXPECT_EQ(script.events(), mask::kMin | mask::kFrel | mask::kFres);
  EXPECT_EQ(script.safe_events(), mask::kSafeMin | mask::kSafeFres);
  EXPECT_EQ(script.host.read(address::kSysCtrl), 0);
  EXPECT_EQ(script.frames(200), idle(200));
  // At least once.
  script.host.write(address::kSysCtrl, mask::kMrst);
  EXPECT_EQ(script.frame(kInitialised), kInitSymbol);
  EXPECT_EQ(script.frames(5), idle(5));
}

TEST(DslTalk, MessageReset_DropsHalfAnAnswer) {
  const Symbols name = nibbles(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  Script script;
  script.start(0xC8, 0x00);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
  script.answer(Symbols(name.begin(), name.begin() + 6));
  script.host.write(address::kSysCtrl, mask::kMrst);
  EXPECT_EQ(script.frame(kInitialised), kInitSymbol);
  EXPECT_EQ(script.events(), mask::kMin | mask::kFrel | mask::kFres);
  script.start(0xC8, 0x00);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
  script.answer(name);
  EXPECT_EQ(script.events() & (mask::kFrel | mask::kAns), mask::kFrel);
}

TEST(DslTalk, EndOfALink_KeepsShortOnesAndEndsLongOnes) {
  Script script;
  script.start(0xC8, 0x00);
  script.expect_request({0xC8, 0x00, 0xC2, 0x78});
  script.host.write(address::kControl, 0xFF);
  script.expect_request({0x7F, 0x8A, 0x44});
  script.answer({7, 15});
  script.host.link_ends();
  EXPECT_EQ(script.events(), mask::kAns | mask::kFrel);
  EXPECT_EQ(script.host.read(address::kOnlineD + 1) & 3, 0);
  script.start(0xC8, 0x01);  // before the next link
  script.host.link_begins();
  EXPECT_EQ(script.events(), mask::kAns);
  EXPECT_EQ(script.frames(8), idle(8));  // F9
  script.expect_request({0x7F, 0x8A, 0x44});
  EXPECT_EQ(script.host.messages().retries(), 1);
  script.bytes(Bytes{0x7F, 0xAB, 0x68, 0xE3});
  EXPECT_EQ(script.events(), mask::kAns | mask::kFres);
  script.expect_request(with_crc({0xC8, 0x01}));
}

TEST(DslTalk, Control3F_StartsNothing) {
  Script script;
  script.host.write(address::kControl, 0x3F);
  EXPECT_EQ(script.frames(100), idle(100));
  // Bit 6 is not looked at (K22).
  script.host.write(address::kControl, 0xBF);
  script.expect_request({0x7F, 0x8A, 0x44});
}

// ---- Both ends, at random -----------------------------------------------------------------------

HostPort port_of(HostBytes& host) {
  return {.read = [&host](unsigned at) { return host.read(at); },
          .write = [&host](unsigned at, std::uint8_t data) { host.write(at, data); }};
}

class DslTransactions : public testing::TestWithParam<std::uint64_t> {};

// Both ends of the channel without a line: 10,000 transactions, one in four disturbed. Every one
// ends; none tells a success that the encoder has not had.
TEST_P(DslTransactions, OfBothHosts_EndByRule) {
  HostBytes host{MessageRules{}};
  RegisterFile registers;
  dsl::MessageConfig config = Dialogue::encoder();
  config.short_inside_long = GetParam() % 2 == 0;
  config.write_answer_data = GetParam() % 3 != 0;
  dsl::ParameterChannel channel(config, {}, registers);
  Dialogue dialogue(port_of(host), channel, registers, GetParam());
  host.reset_begins();
  host.link_begins();
  constexpr std::uint64_t kWanted = 10'000 / 4;
  constexpr std::uint64_t kMostFrames = 2'000'000;
  for (std::uint64_t frame = 0; frame < kMostFrames; ++frame) {
    if (dialogue.ended >= kWanted) dialogue.stop_starting();
    if (dialogue.ended >= kWanted && dialogue.all_ended()) break;
    dialogue.host_acts();
    dialogue.make_line_errors();
    if (dialogue.link_lost) {
      host.link_ends();
      channel.reset();
      host.reset_begins();
      host.link_begins();
    }
    const unsigned sent = host.symbol() ^ dialogue.request_flip;
    const bool init = sent == kInitSymbol && !dialogue.request_unreadable;
    unsigned answer =
        channel.frame(dialogue.request_unreadable ? std::nullopt : std::optional(sent));
    if (init) {
      channel.reset();
      answer = kInitialised;
    }
    Word word;
    word.byte = static_cast<std::uint8_t>(answer);
    word.error = dialogue.answer_unreadable;
    host.frame(word, kLinked);
    if (HasFailure()) break;
  }
  EXPECT_TRUE(dialogue.all_ended());
  EXPECT_GE(dialogue.ended, kWanted);
  EXPECT_GE(4 * dialogue.disturbed, kWanted);
  EXPECT_GT(dialogue.good, kWanted / 2);
  EXPECT_GT(dialogue.bad_answers, 20U);
  EXPECT_GT(dialogue.error_answers, 20U);
  EXPECT_GT(host.messages().retries(), 100U);
  EXPECT_GT(host.messages().foreign(), 20U);
  std::printf(
      "transactions %llu, disturbed %llu, good %llu, ANS %llu, refused %llu, MRST %llu, "
      "retries %u, foreign %u\n",
      static_cast<unsigned long long>(dialogue.ended),
      static_cast<unsigned long long>(dialogue.disturbed),
      static_cast<unsigned long long>(dialogue.good),
      static_cast<unsigned long long>(dialogue.bad_answers),
      static_cast<unsigned long long>(dialogue.error_answers),
      static_cast<unsigned long long>(dialogue.resets), host.messages().retries(),
      host.messages().foreign());
}

INSTANTIATE_TEST_SUITE_P(Seeds, DslTransactions, testing::Range<std::uint64_t>(1, 5));

// A state may take 75 ms: its request goes again and again, is done once and answered once.
TEST(DslTransactionsOfSlowStates, AreDoneOnce) {
  HostBytes host{MessageRules{}};
  RegisterFile registers;
  dsl::MessageConfig config;
  config.status_latency = 6510;  // frames of 11.52 us
  dsl::ParameterChannel channel(config, {}, registers);
  unsigned done = 0;
  channel.on_done = [&done](std::span<const std::uint8_t> /*request*/) { ++done; };
  host.link_begins();
  host.write(address::kEventL, 0);
  host.write(address::kControl, 0xC0);
  unsigned frames = 0;
  while ((host.read(address::kEventL) & mask::kFres) == 0 && frames < 10'000) {
    Word word;
    word.byte = static_cast<std::uint8_t>(channel.frame(host.symbol()));
    host.frame(word, kLinked);
    ++frames;
  }
  // The first vertical frame, one IDLE, six nibbles, the wait and eight nibbles; and the last
  // request's own time after it.
  EXPECT_GE(frames, 8U + 1 + 6 + 6510 + 8);
  EXPECT_LE(frames, 8U + 1 + 6 + 6510 + 8 + 64 + 6);
  EXPECT_EQ(done, 1U);
  EXPECT_EQ(host.read(address::kData), 0x01);
  EXPECT_EQ(host.messages().retries(), 6510 / 70);  // each 64 frames and six nibbles
  EXPECT_EQ(host.messages().foreign(), 0);
}

// The same on a line, with random motion: no position is lost by messages, and none is wrong.
TEST(DslTransactionsOnALine, NoPositionIsLost) {
  dsl_test::BenchSetup setup;
  setup.metres(35);
  setup.encoder.messages = Dialogue::encoder();
  dsl_test::Bench bench(setup);
  dsl_test::RandomMotion motion(bench.encoder(), 5);
  Dialogue dialogue(port_of(bench.link().host()), bench.encoder().messages(),
                    bench.encoder().registers(), 77);
  std::uint64_t certain = 0;
  std::uint64_t wrong = 32;  // the last frame with a wrong bit
  std::uint64_t wrong_bits = 0;
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.number == 0) return;
    if (frame.number > 32) {
      ASSERT_FALSE(frame.lost) << frame.number;
      ASSERT_TRUE(frame.acceleration_good);
      const auto there = bench.encoder().sent_word();
      ASSERT_EQ(frame.position, there);
      ++certain;
    }
    // A wrong bit in S_PAR costs quality, so not many stand near each other.
    dialogue.make_line_errors();
    if (dialogue.answer_unreadable && frame.number - wrong >= 40) {
      wrong = frame.number;
      bench.line().flip(frame.number + 1, {10 + static_cast<unsigned>(wrong % 10)});
      ++wrong_bits;
    }
    dialogue.host_acts();
  };
  const std::uint64_t wanted = transactions();
  ASSERT_TRUE(bench.link_up(10'000 * kPsPerUs));
  for (std::uint64_t i = 0; i < 100 * wanted && dialogue.ended < wanted; ++i) {
    ASSERT_TRUE(bench.run_frames(20, bench.now() + 100 * dsl_test::kFrameTime));
    if (HasFailure()) break;
  }
  EXPECT_GE(dialogue.ended, wanted);
  EXPECT_EQ(bench.link().restarts(), 0U);
  EXPECT_GT(certain, 10 * wanted);
  EXPECT_GT(wrong_bits, wanted / 100);
  EXPECT_GT(4 * dialogue.disturbed, wanted);
}

// A line with wrong bits both ways, which loses the link from time to time: a success is one all
// the same, and what has not ended goes on.
TEST(DslTransactionsOnALine, WrongBits_MakeNoFalseSuccess) {
  dsl_test::BenchSetup setup;
  setup.encoder.messages = Dialogue::encoder();
  setup.cable.answer_errors = 5e-4;
  setup.cable.master_errors = 5e-4;
  dsl_test::Bench bench(setup);
  bench.misreads = true;
  Dialogue dialogue(port_of(bench.link().host()), bench.encoder().messages(),
                    bench.encoder().registers(), 3);
  dialogue.disturb_all();
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.number != 0) dialogue.host_acts();
  };
  const std::uint64_t wanted = transactions();
  for (std::uint64_t i = 0; i < 100 * wanted && dialogue.ended < wanted && !HasFailure(); ++i) {
    bench.run_frames(20, bench.now() + 1000 * dsl_test::kFrameTime);
  }
  EXPECT_GE(dialogue.ended, wanted);
  EXPECT_GT(bench.link().restarts(), wanted / 100);
  EXPECT_GT(2 * dialogue.good, wanted);
}

}  // namespace
