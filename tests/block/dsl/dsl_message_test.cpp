// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages through the registers: the golden bytes of the protocol, the rules one by one, and
// random transactions, one in four of them disturbed, against the model, register by register.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "Vdsl_host_top.h"
#include "sim/masters/dsl_model/host_bytes.hpp"
#include "tests/block/dsl/dsl_frames.hpp"
#include "tests/block/dsl/dsl_registers.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace map = dsl::regs;
namespace page = dsl::page;
using namespace mb4::sim::dsl_model;
using dsl_frames::AnswerPort;
using Bytes = std::vector<std::uint8_t>;
using Symbols = std::vector<unsigned>;

constexpr auto kCheckAnswers =
    static_cast<unsigned>(mb4test::places::dsl_pkg::quirks_t::kCheckAnswers(1));
constexpr unsigned kIdle = 0x10;
constexpr unsigned kShortNak = 0x15;
constexpr unsigned kLongNak = 0x1A;
constexpr unsigned kInitSymbol = 0x1E;  // of the master
constexpr unsigned kInitAnswer = 0x1F;  // of the encoder
constexpr unsigned kUnreadable = 0x100;
constexpr unsigned kVerticalFrames = 8;

// x^16 + x^15 + x^12 + x^7 + x^6 + x^4 + x^3 + 1, the last byte inverted.
Bytes with_crc(Bytes bytes) {
  unsigned rest = 0;
  for (const std::uint8_t byte : bytes) {
    for (unsigned i = 8; i-- > 0;) {
      const unsigned out = (rest >> 15U ^ byte >> i) & 1U;
      rest = (rest << 1U & 0xFFFFU) ^ (out != 0 ? 0x90D9U : 0U);
    }
  }
  bytes.push_back(static_cast<std::uint8_t>(rest >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(rest ^ 0xFFU));
  return bytes;
}

Symbols nibbles_of(const Bytes& bytes) {
  Symbols all;
  for (const std::uint8_t byte : bytes) {
    all.push_back(byte >> 4U);
    all.push_back(byte & 0xFU);
  }
  return all;
}

constexpr unsigned kLengths[] = {0, 2, 4, 8};

// Registers and messages of the master, in a link that runs; its judge goes along.
class Bench {
 public:
  explicit Bench(bool sdk, bool check = true)
      : judge({.check_answers = check, .sdk_map = sdk}), is_sdk(sdk) {
    m.quirks_i = mb4test::quirks_of({.sdk_map = sdk}) & ~kCheckAnswers;
    if (check) m.quirks_i |= kCheckAnswers;
    m.word_req_i = m.ended_i = m.tell_i = m.begin_i = m.edge_i = m.stale_i = m.mismatch_i = 0;
    m.counts_i = 0;
    m.record_write_i = m.time_copied_i = m.lost_i = 0;
    m.record_data_i = m.time_data_i = 0;
    m.told_i = 0;
    m.status_i = 0;
    m.answer_i = 0;
    block.reset();
    for (unsigned i = 0; i < 50; ++i) clock();
    begin_link();
  }

  void clock() {
    m.answer_i = port.bits();
    block.clock();
  }
  std::uint32_t read(unsigned address) {
    return dsl_registers::access(m, address & ~3U, false, 0, 0xF, [this] { clock(); });
  }
  unsigned read_byte(unsigned address) { return read(address) >> 8 * (address & 3U) & 0xFFU; }
  void write(unsigned address, unsigned data) {
    const unsigned lane = address & 3U;
    dsl_registers::access(m, address & ~3U, true, data << 8 * lane, 1U << lane,
                          [this] { clock(); });
    judge.write(address, static_cast<std::uint8_t>(data));
  }

  void begin_link() {
    judge.link_begins();
    port.linked = true;
    place = 0;
    for (unsigned i = 0; i < 20; ++i) clock();
  }
  void end_link() {
    port.linked = port.running = false;
    for (unsigned i = 0; i < 20; ++i) clock();
    judge.link_ends();
    // Frames of a training carry no message.
    m.begin_i = 1;
    clock();
    m.begin_i = 0;
    clock();
  }

  // A frame: what the master sends in it, and what comes with its S_PAR.
  unsigned frame(unsigned answer = kIdle) {
    begin();
    end(answer);
    return sent;
  }
  void begin() {
    port.place = (place + kVerticalFrames - 1) % kVerticalFrames;
    m.begin_i = 1;
    clock();
    m.begin_i = 0;
    port.running = true;
    port.place = place;
    m.eval();
    sent = m.symbol_o;
    for (unsigned i = 0; i < 16; ++i) clock();
  }
  void end(unsigned answer) {
    port.valid = true;
    port.number = dsl_frames::kParameter;
    port.word = {.byte = static_cast<std::uint8_t>(answer), .error = answer == kUnreadable};
    clock();
    port.valid = false;
    for (unsigned i = 0; i < 90; ++i) clock();
    place = (place + 1) % kVerticalFrames;
    expected = judge.symbol();
    judge.frame(port.word, {.linked = true, .lost = false, .safe1 = {}, .safe2 = {}});
  }
  // The first vertical frame of a link is over.
  void first_frames() {
    for (unsigned i = 0; i < kVerticalFrames; ++i) ASSERT_EQ(frame(), kIdle);
  }

  unsigned events() { return read_byte(map::kAddrEventL) & 0x33U; }
  unsigned safe_events() { return read_byte(map::kAddrEventS) & 0x03U; }
  void clear() {
    write(map::kAddrEventL, 0);
    write(map::kAddrEventS, 0);
  }

  // All registers of messages are those of the judge.
  void compare() {
    constexpr unsigned kBytes[] = {
        map::kAddrPcAddH,   map::kAddrPcAddL,  map::kAddrPcOffH,       map::kAddrPcOffL,
        map::kAddrPcData,   map::kAddrSPcData, map::kAddrSlaveRegCtrl, map::kAddrSSlaveRegCtrl,
        map::kAddrOnlineDL, map::kAddrOnline1L};
    for (const unsigned address : kBytes) {
      ASSERT_EQ(read_byte(address), judge.read(address)) << std::hex << address;
    }
    for (unsigned i = 0; i < 8; ++i) {
      ASSERT_EQ(read_byte(map::kAddrPcBuffer0 + i), judge.read(map::kAddrPcBuffer0 + i)) << i;
    }
    ASSERT_EQ(read_byte(map::kAddrSysCtrl) & map::MRST::kMask, judge.read(0) & map::MRST::kMask);
    const std::uint32_t counts = read(page::kAddrMessages);
    ASSERT_EQ(counts & 0xFFFFU, judge.messages().foreign());
    ASSERT_EQ(counts >> 16U, judge.messages().retries());
  }

  mb4test::Block<Vdsl_host_top> block;
  Vdsl_host_top& m = block.model;
  HostBytes judge;
  AnswerPort port;
  bool is_sdk;
  unsigned place = 0;
  unsigned sent = 0;
  unsigned expected = 0;
};

class DslMessageBlock : public testing::TestWithParam<bool> {
 protected:
  DslMessageBlock() : bench(GetParam()) {
    bench.first_frames();
    bench.clear();
  }
  bool sdk() const { return GetParam(); }
  // The host whose short messages stand at SLAVE_REG_CTRL.
  unsigned data_address() const { return sdk() ? map::kAddrSPcData : map::kAddrPcData; }
  unsigned free_events() {
    return sdk() ? bench.safe_events() & map::S_FRES::kMask : bench.events() & map::FRES::kMask;
  }

  void expect_request(const Bytes& bytes) {
    EXPECT_EQ(bench.frame(), kIdle);
    for (const unsigned nibble : nibbles_of(bytes)) EXPECT_EQ(bench.frame(), nibble);
  }
  void answer(const Bytes& bytes) {
    for (const unsigned nibble : nibbles_of(bytes)) EXPECT_EQ(bench.frame(nibble), kIdle);
  }
  void start_long(unsigned header, unsigned low) {
    bench.write(map::kAddrPcAddH, header);
    bench.write(map::kAddrPcAddL, low);
    bench.write(map::kAddrPcCtrl, map::LSTA::kMask);
  }

  Bench bench;
};

// ---- Golden messages ----------------------------------------------------------------------------

// Bytes as the law has them, their CRC with them.
TEST_P(DslMessageBlock, ShortMessagesOfTheLaw_BothWays) {
  struct Golden {
    unsigned control;
    std::optional<unsigned> data;  // of a write
    Bytes request;
    Bytes reply;
    std::optional<unsigned> result;  // of a read
  };
  const Golden all[] = {
      {0xBF, std::nullopt, {0x7F, 0x8A, 0x44}, {0x7F, 0xAB, 0x68, 0xE3}, 0xAB},
      {0x80, std::nullopt, {0x40, 0x87, 0x75}, with_crc({0x40, 0x01}), 0x01},
      {0xBC, std::nullopt, {0x7C, 0xAB, 0xF6}, with_crc({0x7C, 0x07}), 0x07},
      {0x7F, 0xAB, {0x3F, 0xAB, 0xAE, 0x93}, {0x3F, 0x0D, 0xCE}, std::nullopt},
  };
  for (const Golden& one : all) {
    SCOPED_TRACE(one.control);
    if (one.data) bench.write(map::kAddrPcData, *one.data);
    bench.write(map::kAddrSlaveRegCtrl, one.control);
    EXPECT_EQ(bench.read_byte(map::kAddrSlaveRegCtrl), one.control);
    EXPECT_EQ(free_events(), 0U);
    expect_request(one.request);
    EXPECT_EQ(bench.frame(), kIdle);
    answer(one.reply);
    EXPECT_EQ(free_events(), 1U);
    EXPECT_EQ(bench.read_byte(map::kAddrSlaveRegCtrl), 0x3FU);
    if (one.result) {
      EXPECT_EQ(bench.read_byte(data_address()), *one.result);
    }
    bench.frame();
    bench.compare();
  }
}

TEST_P(DslMessageBlock, LongMessagesOfTheLaw_BothWays) {
  start_long(0xC8, 0x00);
  expect_request({0xC8, 0x00, 0xC2, 0x78});
  answer(with_crc({0xC8, 0x00, 'R', 'O', 'O', 'T'}));
  EXPECT_EQ(bench.events(), map::FREL::kMask);
  for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(bench.read_byte(map::kAddrPcBuffer0 + i), "ROOT"[i]);
  bench.frame();
  start_long(0xCC, 0x81);
  EXPECT_EQ(bench.events(), 0U);
  expect_request({0xCC, 0x81, 0xC1, 0x0B});
  answer({0xCC, 0x81, 0x52, 0x45, 0x53, 0x4F, 0x4C, 0x55, 0x54, 0x4E, 0xDB, 0x8C});
  EXPECT_EQ(bench.events(), map::FREL::kMask);
  for (unsigned i = 0; i < 8; ++i) {
    EXPECT_EQ(bench.read_byte(map::kAddrPcBuffer0 + i), "RESOLUTN"[i]);
  }
  bench.frame();
  bench.compare();
}

// R21. An error answer has its two bytes in the order of the line, with the SDK the other way
// round.
TEST_P(DslMessageBlock, ErrorAnswer_HasItsBytesInTheOrderOfThePersonality) {
  bench.write(map::kAddrPcBuffer0, 0x12);
  bench.write(map::kAddrPcBuffer1, 0x34);
  start_long(0x84, 0x00);
  expect_request(with_crc({0x84, 0x00, 0x12, 0x34}));
  answer(with_crc({0xA4, 0x00, 0x10, 0x41}));
  EXPECT_EQ(bench.events(), map::FREL::kMask);
  EXPECT_NE(bench.read_byte(map::kAddrPcAddH) & map::LOFF::kMask, 0U);
  EXPECT_EQ(bench.read_byte(map::kAddrPcBuffer0), sdk() ? 0x41U : 0x10U);
  EXPECT_EQ(bench.read_byte(map::kAddrPcBuffer1), sdk() ? 0x10U : 0x41U);
}

// Each header of a request: offset, direction, length.
TEST_P(DslMessageBlock, LongRequests_OfEachKind) {
  for (unsigned kind = 0; kind < 64; ++kind) {
    SCOPED_TRACE(kind);
    const unsigned first = 0x80U | kind << 1U;
    Bytes request = {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(kind * 7)};
    const bool read = (first & 0x40U) != 0;
    const unsigned length = kLengths[first >> 2U & 3U];
    bench.write(map::kAddrPcOffH, 0x15);
    bench.write(map::kAddrPcOffL, 0xA0 + kind);
    Bytes data;
    for (unsigned i = 0; i < 8; ++i) {
      bench.write(map::kAddrPcBuffer0 + i, 0x31 * (i + 1) + kind);
      if (!read && i < length) data.push_back(static_cast<std::uint8_t>(0x31 * (i + 1) + kind));
    }
    if ((first & 0x20U) != 0) {
      request.push_back(0x95);
      request.push_back(static_cast<std::uint8_t>(0xA0 + kind));
    }
    request.insert(request.end(), data.begin(), data.end());
    start_long(first, kind * 7);
    expect_request(with_crc(request));
    Bytes reply = {static_cast<std::uint8_t>(first & ~0x20U), static_cast<std::uint8_t>(kind * 7)};
    for (unsigned i = 0; i < length; ++i) reply.push_back(static_cast<std::uint8_t>(i + 0x60));
    answer(with_crc(reply));
    EXPECT_EQ(bench.events(), map::FREL::kMask);
    bench.frame();
    bench.compare();
  }
}

// ---- Rules, one by one --------------------------------------------------------------------------

// F9. A start in the first vertical frame of a link waits for its end.
TEST_P(DslMessageBlock, FirstVerticalFrame_HasNoMessage) {
  bench.end_link();
  bench.write(map::kAddrSlaveRegCtrl, 0x80);
  bench.begin_link();
  for (unsigned i = 0; i < 9; ++i) EXPECT_EQ(bench.frame(), kIdle) << i;
  EXPECT_EQ(bench.frame(), 4U);
}

// R16: 64 frames behind the last nibble the request goes again, without end.
TEST_P(DslMessageBlock, ShortMessageWithoutAnAnswer_IsSentAgain) {
  const Bytes request = {0x40, 0x87, 0x75};
  bench.write(map::kAddrSlaveRegCtrl, 0x80);
  expect_request(request);
  for (unsigned turn = 1; turn < 5; ++turn) {
    for (unsigned i = 0; i < 63; ++i) ASSERT_EQ(bench.frame(), kIdle);
    expect_request(request);
    EXPECT_EQ(bench.read(page::kAddrMessages) >> 16U, turn);
    EXPECT_EQ(free_events(), 0U);
  }
}

TEST_P(DslMessageBlock, ShortNak_SendsAtOnce_LongNakEnds) {
  bench.write(map::kAddrSlaveRegCtrl, 0x80);
  expect_request({0x40, 0x87, 0x75});
  EXPECT_EQ(bench.frame(), kIdle);
  EXPECT_EQ(bench.frame(kShortNak), kIdle);
  expect_request({0x40, 0x87, 0x75});
  answer(with_crc({0x40, 0x55}));
  EXPECT_EQ(free_events(), 1U);
  bench.frame();
  // R17.
  start_long(0xC8, 0x00);
  expect_request({0xC8, 0x00, 0xC2, 0x78});
  EXPECT_EQ(bench.events() & map::ANS::kMask, 0U);
  EXPECT_EQ(bench.frame(kLongNak), kIdle);
  EXPECT_EQ(bench.events() & (map::ANS::kMask | map::FREL::kMask),
            map::ANS::kMask | map::FREL::kMask);
  bench.compare();
}

// R17. INIT up to its acknowledge, then everything is free.
TEST_P(DslMessageBlock, ResetOfMessages_SendsInitUpToItsAcknowledge) {
  start_long(0xC8, 0x00);
  bench.write(map::kAddrSlaveRegCtrl, 0x80);
  for (unsigned i = 0; i < 5; ++i) bench.frame();
  bench.write(map::kAddrSysCtrl, map::MRST::kMask);
  for (unsigned i = 0; i < 20; ++i) {
    EXPECT_EQ(bench.frame(i == 0 ? kUnreadable : kIdle), kInitSymbol);
    EXPECT_EQ(bench.read_byte(map::kAddrSysCtrl), map::MRST::kMask);
  }
  EXPECT_EQ(bench.frame(kInitAnswer), kInitSymbol);
  EXPECT_EQ(bench.events(), map::MIN::kMask | map::FREL::kMask | map::FRES::kMask);
  EXPECT_EQ(bench.safe_events(), map::S_MIN::kMask | map::S_FRES::kMask);
  EXPECT_EQ(bench.read_byte(map::kAddrSysCtrl), 0U);
  for (unsigned i = 0; i < 100; ++i) EXPECT_EQ(bench.frame(), kIdle);
  bench.compare();
}

// Answers of another address, direction or length, and those that nobody has asked for.
TEST_P(DslMessageBlock, ForeignAnswers_AreDroppedAndCounted) {
  const auto foreign = [this] { return bench.read(page::kAddrMessages) & 0xFFFFU; };
  answer(with_crc({0x40, 0x55}));
  bench.frame();
  EXPECT_EQ(foreign(), 1U);
  bench.write(data_address(), 0x99);
  bench.write(map::kAddrSlaveRegCtrl, 0x80);
  expect_request({0x40, 0x87, 0x75});
  for (const Bytes& reply : {Bytes{0x41, 0x55}, Bytes{0x60, 0x55}, Bytes{0x00}}) {
    answer(with_crc(reply));
    bench.frame();
  }
  EXPECT_EQ(foreign(), 4U);
  EXPECT_EQ(free_events(), 0U);
  EXPECT_EQ(bench.read_byte(data_address()), 0x99U);
  answer(with_crc({0x40, 0x56}));
  EXPECT_EQ(free_events(), 1U);
  EXPECT_EQ(bench.read_byte(data_address()), 0x56U);
  bench.frame();
  start_long(0xC8, 0x82);
  expect_request(with_crc({0xC8, 0x82}));
  for (const Bytes& reply :
       {Bytes{0xC8, 0x83, 1, 2, 3, 4}, Bytes{0xC9, 0x82, 1, 2, 3, 4}, Bytes{0x88, 0x82, 1, 2, 3, 4},
        Bytes{0xC4, 0x82, 1, 2}, Bytes{0xC0, 0x82}}) {
    answer(with_crc(reply));
    bench.frame();
  }
  EXPECT_EQ(foreign(), 9U);
  EXPECT_EQ(bench.events() & map::FREL::kMask, 0U);
  EXPECT_EQ(bench.read_byte(map::kAddrPcBuffer0), 0U);
  answer(with_crc({0xC8, 0x82, 9, 8, 7, 6}));
  EXPECT_EQ(bench.events() & map::FREL::kMask, map::FREL::kMask);
  EXPECT_EQ(bench.read(map::kAddrPcBuffer0), 0x06070809U);
  bench.compare();
}

// An answer that began before its request was whole is none of it.
TEST_P(DslMessageBlock, AnswerThatBeganBeforeItsRequest_IsForeign) {
  const Symbols reply = nibbles_of(with_crc({0x40, 0x55}));
  bench.write(map::kAddrSlaveRegCtrl, 0x80);
  for (unsigned i = 0; i < 5; ++i) bench.frame();
  for (const unsigned nibble : reply) bench.frame(nibble);
  EXPECT_EQ(free_events(), 0U);
  EXPECT_EQ(bench.read(page::kAddrMessages) & 0xFFFFU, 1U);
}

// F12. A short message goes while a long answer is awaited or comes.
TEST_P(DslMessageBlock, ShortMessageWhileALongAnswerComes) {
  const Symbols reply = nibbles_of(with_crc({0xCC, 0x81, 'R', 'E', 'S', 'O', 'L', 'U', 'T', 'N'}));
  for (unsigned pause = 1; pause < 23; ++pause) {
    SCOPED_TRACE(pause);
    bench.clear();
    start_long(0xCC, 0x81);
    expect_request({0xCC, 0x81, 0xC1, 0x0B});
    bench.write(map::kAddrSlaveRegCtrl, 0xBF);
    Symbols symbols = {kIdle, 7, 15, 8, 10, 4, 4};
    for (unsigned i = 0; i < reply.size(); ++i) {
      if (i == pause) {
        while (!symbols.empty()) {
          EXPECT_EQ(bench.frame(), symbols.front());
          symbols.erase(symbols.begin());
        }
        bench.frame();
        answer({0x7F, 0xAB, 0x68, 0xE3});
        bench.frame();
        EXPECT_EQ(free_events(), 1U);
      }
      const unsigned expected = symbols.empty() ? kIdle : symbols.front();
      if (!symbols.empty()) symbols.erase(symbols.begin());
      EXPECT_EQ(bench.frame(reply[i]), expected);
      // The rest of a request is sent before the encoder can answer it.
      if (i + 1 == pause) {
        while (!symbols.empty()) {
          EXPECT_EQ(bench.frame(), symbols.front());
          symbols.erase(symbols.begin());
        }
      }
    }
    EXPECT_NE(bench.events() & map::FREL::kMask, 0U);
    EXPECT_EQ(bench.events() & map::ANS::kMask, 0U);
    EXPECT_EQ(bench.read(map::kAddrPcBuffer4), 0x4E54554CU);
    bench.frame();
    bench.compare();
  }
}

// A word is read as it was before an answer, or as it is behind it.
TEST_P(DslMessageBlock, ReadsWhileAnAnswerIsTaken_SeeOneOrTheOther) {
  std::set<std::uint32_t> seen;
  for (unsigned turn = 0; turn < 60; ++turn) {
    for (unsigned i = 0; i < 8; ++i) bench.write(map::kAddrPcBuffer0 + i, 0x11);
    start_long(0xCC, 0x81);
    expect_request({0xCC, 0x81, 0xC1, 0x0B});
    Symbols reply =
        nibbles_of(with_crc({0xCC, 0x81, 0x22, 0x22, 0x22, 0x22, 0x22, 0x22, 0x22, 0x22}));
    const unsigned last = reply.back();
    reply.pop_back();
    for (const unsigned nibble : reply) bench.frame(nibble);
    bench.begin();
    bench.port.valid = true;
    bench.port.number = dsl_frames::kParameter;
    bench.port.word = {.byte = static_cast<std::uint8_t>(last)};
    bench.clock();
    bench.port.valid = false;
    for (unsigned i = 0; i < turn; ++i) bench.clock();
    for (unsigned i = 0; i < 8; ++i) {
      const std::uint32_t word = bench.read(map::kAddrPcBuffer0 + 4 * (i % 2));
      ASSERT_TRUE(word == 0x11111111U || word == 0x22222222U) << std::hex << word;
      seen.insert(word);
    }
    for (unsigned i = 0; i < 80; ++i) bench.clock();
    bench.place = (bench.place + 1) % kVerticalFrames;
    static_cast<void>(bench.judge.symbol());
    bench.judge.frame(bench.port.word, {.linked = true, .lost = false, .safe1 = {}, .safe2 = {}});
    ASSERT_EQ(bench.read(map::kAddrPcBuffer0), 0x22222222U);
    bench.frame();
  }
  EXPECT_EQ(seen.size(), 2U);
}

// ---- At random ----------------------------------------------------------------------------------

// An encoder, as far as messages go: it does what a request with a right CRC says, and answers.
class Encoder {
 public:
  explicit Encoder(mb4test::Dice& dice) : random(dice) {}

  // What it sends in a frame in which the master sends `symbol`.
  unsigned frame(unsigned symbol) {
    listen(symbol);
    if (renews_ && random.below(3) != 0) {
      renews_ = false;
      return kInitAnswer;
    }
    return disturbed(speak());
  }
  void drop() {
    in_.clear();
    short_.clear();
    long_.clear();
    renews_ = false;
  }

  std::map<unsigned, std::uint8_t> bytes;  // by address
  std::set<unsigned> had;  // address and data that a byte has had, since a host asked
  unsigned writes = 0;     // long ones, done

  struct Told {
    unsigned delay = 0;
    Symbols symbols;
  };

 private:
  void listen(unsigned symbol) {
    if (symbol == kInitSymbol) {
      drop();
      renews_ = true;
      return;
    }
    if (symbol >= 0x10) {
      if (!in_.empty()) take();
      in_.clear();
      return;
    }
    in_.push_back(symbol);
  }
  void take() {
    // A nibble is lost now and then.
    if (random.below(20) == 0) return;
    Bytes all;
    for (unsigned i = 0; i + 1 < in_.size(); i += 2) {
      all.push_back(static_cast<std::uint8_t>(in_[i] << 4U | in_[i + 1]));
    }
    if (all.size() < 3) return;
    Bytes message(all.begin(), all.end() - 2);
    if (with_crc(message) != all) return;
    const bool is_long = (message[0] & 0x80U) != 0;
    const bool read = (message[0] & 0x40U) != 0;
    Bytes reply = {message[0]};
    if (is_long) {
      reply.push_back(message[1]);
      reply[0] &= 0xDFU;
      const unsigned length = kLengths[message[0] >> 2U & 3U];
      if (!read) ++writes;
      if (random.below(6) == 0) {
        reply[0] = static_cast<std::uint8_t>((reply[0] & 0xF3U) | 0x24U);
        reply.push_back(0x10);
        reply.push_back(0x41);
      } else {
        for (unsigned i = 0; i < length; ++i) {
          reply.push_back(static_cast<std::uint8_t>(random.below(256)));
        }
      }
    } else {
      const unsigned address = message[0] & 0x3FU;
      if (read) {
        reply.push_back(bytes[address]);
      } else {
        bytes[address] = message[1];
        had.insert(address << 8U | message[1]);
      }
    }
    // One in four is disturbed.
    unsigned delay = random.below(6);
    Symbols symbols = nibbles_of(with_crc(reply));
    if (random.below(4) == 0) {
      switch (random.below(7)) {
        case 0:
          return;  // silence
        case 1:
          symbols = {is_long ? kLongNak : kShortNak};
          break;
        case 2:
          symbols[random.below(static_cast<unsigned>(symbols.size()))] ^= 1U << random.below(4);
          break;
        case 3:
          symbols[random.below(static_cast<unsigned>(symbols.size()))] =
              random.below(2) != 0 ? kIdle : kUnreadable;
          break;
        case 4:
          symbols.erase(symbols.begin() + random.below(static_cast<unsigned>(symbols.size())));
          break;
        case 5:
          delay = 40 + random.below(60);
          break;
        default:  // one of another
          reply[0] ^= static_cast<std::uint8_t>(is_long ? 0x01U : 1U << random.below(7));
          if (!is_long) reply.resize((reply[0] & 0x40U) != 0 ? 2 : 1, 0x77);
          symbols = nibbles_of(with_crc(reply));
      }
    }
    (is_long ? long_ : short_).push_back({delay, symbols});
  }
  unsigned speak() {
    for (auto* queue : {&short_, &long_}) {
      for (Told& one : *queue) one.delay -= one.delay != 0 ? 1 : 0;
    }
    // A short answer goes first; an IDLE stands between two.
    const auto next = [](std::deque<Told>& queue) {
      const unsigned symbol = queue.front().symbols.front();
      queue.front().symbols.erase(queue.front().symbols.begin());
      if (queue.front().symbols.empty()) queue.pop_front();
      return symbol;
    };
    const bool short_ready = !short_.empty() && short_.front().delay == 0;
    const bool long_ready = !long_.empty() && long_.front().delay == 0;
    const unsigned wants = short_ready ? 1 : long_ready ? 2 : 0;
    if (wants != speaks_) {
      speaks_ = speaks_ == 0 ? wants : 0;
      if (speaks_ == 0) return kIdle;
    }
    if (speaks_ == 0) return kIdle;
    std::deque<Told>& queue = speaks_ == 1 ? short_ : long_;
    const std::size_t count = queue.size();
    const unsigned symbol = next(queue);
    if (queue.size() != count) speaks_ = 3;  // IDLE follows
    return symbol;
  }
  unsigned disturbed(unsigned symbol) {
    return random.below(400) == 0 ? random.below(0x20) : symbol;
  }

  mb4test::Dice& random;
  Symbols in_;
  std::deque<Told> short_;
  std::deque<Told> long_;
  unsigned speaks_ = 0;  // 1 short, 2 long
  bool renews_ = false;
};

TEST_P(DslMessageBlock, TransactionsAtRandom_EndByTheRules) {
  const std::uint64_t transactions = mb4test::number("MB4_DSL_TRANSACTIONS", 1'500);
  mb4test::Dice random;
  Encoder encoder(random);
  std::uint64_t ended = 0;
  unsigned retried = 0;
  bench.write(map::kAddrEventL, 0);
  struct Short {
    bool runs = false;
    unsigned control = 0;
    unsigned data = 0;
  };
  std::array<Short, 2> shorts;
  const unsigned controls[] = {map::kAddrSlaveRegCtrl, map::kAddrSSlaveRegCtrl};
  const unsigned datas[] = {data_address(), map::kAddrSPcData};
  const unsigned hosts = sdk() ? 1 : 2;
  bool long_runs = false;
  unsigned frames = 0;
  for (; ended < transactions && frames < 100 * transactions; ++frames) {
    SCOPED_TRACE(frames);
    // Hosts.
    for (unsigned host = 0; host < hosts; ++host) {
      Short& one = shorts[host];
      if (one.runs || random.below(12) != 0) continue;
      one.data = random.below(256);
      one.control = random.below(256);
      if (one.control == 0x3F) continue;
      bench.write(datas[host], one.data);
      bench.write(controls[host], one.control);
      one.runs = true;
      const unsigned address = one.control & 0x3FU;
      for (unsigned value = 0; value < 256; ++value) encoder.had.erase(address << 8U | value);
      encoder.had.insert(address << 8U | encoder.bytes[address]);
      if ((one.control & 0x80U) == 0) encoder.had.erase(address << 8U | one.data);
    }
    if (!long_runs && random.below(20) == 0) {
      for (unsigned i = 0; i < 8; ++i) {
        if (random.below(2) != 0) bench.write(map::kAddrPcBuffer0 + i, random.below(256));
      }
      bench.write(map::kAddrPcOffL, random.below(256));
      start_long(random.below(256), random.below(256));
      long_runs = true;
    }
    // Writes that are ignored while something runs.
    if (random.below(30) == 0) {
      const unsigned address = map::kAddrPcBuffer0 + random.below(16);
      if (address < map::kAddrPcCtrl && long_runs) bench.write(address, random.below(256));
    }
    if (random.below(1500) == 0) {
      bench.write(map::kAddrSysCtrl, map::MRST::kMask);
    }
    if (random.below(4000) == 0) {
      bench.end_link();
      encoder.drop();
      bench.begin_link();
      bench.first_frames();
    }
    bench.begin();
    const unsigned answer = encoder.frame(bench.sent);
    bench.end(answer);
    ASSERT_EQ(bench.sent, bench.expected) << "answer " << std::hex << answer;
    const unsigned events = bench.read_byte(map::kAddrEventL);
    const unsigned safe_events = bench.read_byte(map::kAddrEventS);
    ASSERT_EQ(events & 0x33U, bench.judge.read(map::kAddrEventL) & 0x33U);
    ASSERT_EQ(safe_events & 0x03U, bench.judge.read(map::kAddrEventS) & 0x03U);
    const bool renewed = (events & map::MIN::kMask) != 0;
    for (unsigned host = 0; host < hosts; ++host) {
      const bool safe = host == 1 || sdk();
      if (((safe ? safe_events : events) & 1U) == 0 || !shorts[host].runs) continue;
      shorts[host].runs = false;
      ++ended;
      // It has been done, and what was read is what stood there. A reset of messages says nothing.
      const unsigned address = shorts[host].control & 0x3FU;
      const bool read = (shorts[host].control & 0x80U) != 0;
      const unsigned value = read ? bench.read_byte(datas[host]) : shorts[host].data;
      ASSERT_TRUE(renewed || encoder.had.count(address << 8U | value) != 0)
          << (read ? "read " : "write ") << std::hex << address;
    }
    if ((events & map::FREL::kMask) != 0 && long_runs) {
      long_runs = false;
      ++ended;
    }
    if ((events & 0x33U) != 0) bench.write(map::kAddrEventL, 0);
    if ((safe_events & 0x03U) != 0) bench.write(map::kAddrEventS, 0);
    if (frames % 8 == 0) bench.compare();
    retried = bench.judge.messages().retries();
  }
  EXPECT_GE(ended, transactions) << frames << " frames";
  EXPECT_GT(retried, transactions / 50);
}

INSTANTIATE_TEST_SUITE_P(Maps, DslMessageBlock, testing::Values(false, true),
                         [](const auto& sdk) { return sdk.param ? "Sdk" : "Ours"; });

// Without the check each answer is one of the open request of its kind, as published.
TEST(DslMessageUnchecked, AnyAnswerOfTheKind_IsTaken) {
  Bench bench(false, false);
  bench.first_frames();
  bench.clear();
  bench.write(map::kAddrSlaveRegCtrl, 0x80);
  for (unsigned i = 0; i < 7; ++i) bench.frame();
  for (const unsigned nibble : nibbles_of(with_crc({0x66, 0x42}))) bench.frame(nibble);
  EXPECT_EQ(bench.events(), map::FRES::kMask);
  EXPECT_EQ(bench.read_byte(map::kAddrPcData), 0x42U);
  bench.frame();
  bench.compare();
}

}  // namespace
