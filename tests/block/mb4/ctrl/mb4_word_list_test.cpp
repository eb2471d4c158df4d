// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The list of words of one line: pages 23 to 26; the lowest data channel is next to SL.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "Vmb4_word_list.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

struct Channel {
  bool enabled = false, actuator = false, gray_lstop = false;
  unsigned data_bits = 0;
  unsigned crc_bits = 0;  // 0, 3 to 8, 16
  unsigned crc_start = 0;

  // Table 14: the polynomial without its last 1, and without what is above x^7.
  unsigned polynomial() const {
    static constexpr unsigned kFull[] = {0, 0, 0, 0xB, 0x13, 0x25, 0x43, 0x89, 0x12F};
    return (crc_bits == 16 ? 0x190D9U : kFull[crc_bits]) >> 1 & 0x7F;
  }
  std::uint64_t port() const {
    namespace at = mb4test::places::mb4_pkg::slave_cfg_t;
    return at::kCrcStart(crc_start) | at::kCrcOn(crc_bits != 0) |
           at::kCrcLast(crc_bits != 0 ? crc_bits - 1 : 0) | at::kCrcPoly(polynomial()) |
           at::kGrayLstop(gray_lstop) | at::kEnscd(enabled) | at::kScdlen(data_bits - 1);
  }
};

class WordList : public mb4test::Block<Vmb4_word_list> {
 public:
  WordList() {
    model.enscd_i = model.actnsens_i = model.ssi_i = model.nocrc_i = 0;
    model.start_i = model.next_i = 0;
    model.cfg_i = 0;
    reset();
  }
  // A clock; the configuration that is asked for arrives with it.
  void step() {
    model.eval();
    const bool asked = model.cfg_en_o != 0;
    const unsigned slave = model.cfg_slave_o;
    clock();
    if (asked) model.cfg_i = channels[slave].port();
    model.start_i = model.next_i = 0;
    model.eval();
  }
  std::uint64_t field(mb4test::Place place) const { return place.of(model.offer_o); }
  std::array<Channel, 8> channels;
};

namespace offer_t = mb4test::places::biss_pkg::offer_t;

TEST(WordListBlock, RandomConfigurations_WordsComeInOrderWithTheirLengths) {
  mb4test::Dice random;
  for (int round = 0; round < 2'000; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    WordList list;
    auto& m = list.model;
    const bool ssi = random.below(4) == 0;
    const bool nocrc = random.below(4) == 0;
    m.ssi_i = ssi;
    m.nocrc_i = nocrc;
    std::vector<unsigned> words, lengths;
    bool actuators = false;
    for (unsigned i = 0; i < 8; ++i) {
      Channel& c = list.channels[i];
      c.enabled = random.below(2) != 0;
      c.actuator = random.below(3) == 0;
      c.gray_lstop = random.below(2) != 0;
      c.data_bits = 1 + random.below(64);
      const unsigned crc = 2 + random.below(8);
      c.crc_bits = crc == 2 ? 0 : crc == 9 ? 16 : crc;
      c.crc_start = random.below(65536);
      const auto bit = static_cast<std::uint8_t>(1U << i);
      if (c.enabled) m.enscd_i |= bit;
      if (c.actuator) m.actnsens_i |= bit;
      if (!c.enabled) continue;
      words.push_back(i);
      // Table 18: the stop bit of an actuator; SSI has none.
      const bool sends = c.actuator && !ssi;
      actuators = actuators || c.actuator;
      lengths.push_back(c.data_bits + c.crc_bits + (sends && c.gray_lstop ? 1 : 0));
    }
    m.start_i = 1;
    list.step();
    ASSERT_EQ(m.actuator_o, actuators);
    std::vector<unsigned> told;
    for (; m.len_valid_o != 0 && told.size() < 9; list.step()) told.push_back(m.len_last_o + 1U);
    ASSERT_EQ(told, lengths);

    for (std::size_t i = 0; i < words.size(); ++i) {
      const Channel& c = list.channels[words[i]];
      const bool sends = c.actuator && !ssi;
      ASSERT_EQ(list.field(offer_t::kAny), 1U) << "any";
      ASSERT_EQ(list.field(offer_t::kLast), i + 1 == words.size()) << "last";
      ASSERT_EQ(list.field(offer_t::kSlave), words[i]) << "slave";
      ASSERT_EQ(list.field(offer_t::kWordDataLast), c.data_bits - 1);
      ASSERT_EQ(list.field(offer_t::kWordCrcOn), c.crc_bits != 0);
      ASSERT_EQ(list.field(offer_t::kWordCrcLast), c.crc_bits == 0 ? 0 : c.crc_bits - 1);
      if (c.crc_bits != 0) {
        ASSERT_EQ(list.field(offer_t::kWordCrcPoly), c.polynomial() << 1 | 1U);
      }
      ASSERT_EQ(list.field(offer_t::kWordCrcStart), c.crc_start);
      // Page 26, Table 21: NOCRC = 0, and the data leave the top byte(s) free.
      ASSERT_EQ(list.field(offer_t::kWordCrcStore),
                c.crc_bits != 0 && !nocrc && c.data_bits <= (c.crc_bits == 16 ? 48U : 56U));
      ASSERT_EQ(list.field(offer_t::kWordGray), ssi && c.gray_lstop) << "Gray";
      ASSERT_EQ(list.field(offer_t::kWordActuator), sends) << "actuator";
      ASSERT_EQ(list.field(offer_t::kWordStop), sends && c.gray_lstop) << "stop bit";
      m.next_i = 1;
      list.step();
    }
    ASSERT_EQ(list.field(offer_t::kAny), 0U) << "no word follows";
  }
}

}  // namespace
