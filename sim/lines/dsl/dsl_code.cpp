// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/dsl/dsl_code.hpp"

#include <string_view>

namespace mb4::sim::dsl {
namespace {

// The blocks that a negative disparity takes, as they are sent.
constexpr std::string_view kBlocks6[32] = {
    "100111", "011101", "101101", "110001", "110101", "101001", "011001", "111000",
    "111001", "100101", "010101", "110100", "001101", "101100", "011100", "010111",
    "011011", "100011", "010011", "110010", "001011", "101010", "011010", "111010",
    "110011", "100110", "010110", "110110", "001110", "101110", "011110", "101011"};
constexpr std::string_view kBlocks4[8] = {"1011", "1001", "0101", "1100",
                                          "1101", "1010", "0110", "1110"};
constexpr std::string_view kBlock6OfK28 = "001111";
constexpr std::string_view kBlocks4OfK28[8] = {"1011", "0110", "1010", "1100",
                                               "1101", "0101", "1001", "0111"};
constexpr std::string_view kBlock4OfK7 = "0111";
constexpr unsigned kK28 = 28;

constexpr unsigned bits_of(std::string_view text) {
  unsigned bits = 0;
  for (const char c : text) bits = bits << 1U | (c == '1' ? 1U : 0U);
  return bits;
}

constexpr int ones_more(std::string_view text) {
  int sum = 0;
  for (const char c : text) sum += c == '1' ? 1 : -1;
  return sum;
}

// Appends a block. With a positive disparity it is inverted if it is uneven, or if `pair` says that
// it has two forms although it is even.
unsigned append(unsigned word, std::string_view block, bool pair, bool& positive) {
  const bool uneven = ones_more(block) != 0;
  const unsigned all = (1U << block.size()) - 1;
  const bool invert = positive && (uneven || pair);
  if (uneven) positive = !positive;
  return word << block.size() | (bits_of(block) ^ (invert ? all : 0U));
}

// A remainder goes on by one bit.
std::uint32_t step(std::uint32_t rest, bool next, std::uint32_t polynomial, unsigned degree) {
  rest = rest << 1U | (next ? 1U : 0U);
  return (rest >> degree & 1U) != 0 ? rest ^ polynomial : rest;
}

constexpr std::uint32_t kPolynomial16 = 0x190D9;
constexpr std::uint32_t kPolynomial5 = 0x25;

}  // namespace

unsigned Coder::data(std::uint8_t byte) {
  const unsigned x = byte & 0x1FU;
  const unsigned y = byte >> 5U;
  const unsigned six = append(0, kBlocks6[x], x == 7, positive_);
  // Five equal bits would stand in a row.
  const bool second = y == 7 && (positive_ ? (six & 3U) == 0 : (six & 3U) == 3);
  return append(six, second ? kBlock4OfK7 : kBlocks4[y], y == 3, positive_);
}

unsigned Coder::special(std::uint8_t byte) {
  const unsigned x = byte & 0x1FU;
  const unsigned y = byte >> 5U;
  const unsigned six = append(0, x == kK28 ? kBlock6OfK28 : kBlocks6[x], false, positive_);
  return append(six, x == kK28 ? kBlocks4OfK28[y] : kBlock4OfK7, true, positive_);
}

std::optional<std::uint8_t> parameter_of(unsigned word) {
  const auto same = [](unsigned bits, std::string_view block, bool pair) {
    const unsigned all = (1U << block.size()) - 1;
    const unsigned form = bits_of(block);
    return bits == form || (bits == (form ^ all) && (pair || ones_more(block) != 0));
  };
  const unsigned six = word >> 4U & 0x3FU;
  const unsigned four = word & 0xFU;
  for (unsigned x = 0; x < 32; ++x) {
    if (!same(six, kBlocks6[x], x == 7) && !(x == kK28 && same(six, kBlock6OfK28, true))) continue;
    for (unsigned y = 0; y < 8; ++y) {
      if (same(four, kBlocks4[y], y == 3) || (y == 7 && same(four, kBlock4OfK7, true))) {
        return static_cast<std::uint8_t>(y << 5U | x);
      }
    }
  }
  return std::nullopt;
}

std::uint16_t check_bytes(std::span<const std::uint8_t> bytes) {
  std::uint32_t rest = 0;
  for (const std::uint8_t byte : bytes) {
    for (unsigned i = 8; i-- > 0;) rest = step(rest, (byte >> i & 1U) != 0, kPolynomial16, 16);
  }
  for (unsigned i = 0; i < 16; ++i) rest = step(rest, false, kPolynomial16, 16);
  return static_cast<std::uint16_t>(rest ^ 0x00FFU);
}

std::uint16_t with_check(int acceleration) {
  const unsigned bits = static_cast<unsigned>(acceleration) & 0x7FFU;
  std::uint32_t rest = 0;
  for (unsigned i = 11; i-- > 0;) rest = step(rest, (bits >> i & 1U) != 0, kPolynomial5, 5);
  for (unsigned i = 0; i < 5; ++i) rest = step(rest, false, kPolynomial5, 5);
  return static_cast<std::uint16_t>(bits << 5U | (rest ^ 0x1FU));
}

}  // namespace mb4::sim::dsl
