// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/lines/replay/inflate.hpp"

#include <array>
#include <vector>

namespace mb4::sim {
namespace {

struct BadData {};

class Bits {
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}

  unsigned take(unsigned count) {
    while (held_ < count) {
      value_ |= static_cast<std::uint32_t>(byte()) << held_;
      held_ += 8;
    }
    const unsigned taken = value_ & ((1U << count) - 1);
    value_ >>= count;
    held_ -= count;
    return taken;
  }
  // At a whole byte.
  std::string_view block(std::size_t size) {
    if (size > bytes_.size() - at_) throw BadData();
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  void drop_rest_of_byte() { value_ = held_ = 0; }

 private:
  std::uint8_t byte() {
    if (at_ == bytes_.size()) throw BadData();
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t value_ = 0;
  unsigned held_ = 0;  // fewer than 8 between two calls
};

constexpr unsigned kLongest = 15;

// A canonical Huffman code: how many codes have a length, and the symbols in order of their codes.
class Code {
 public:
  explicit Code(const std::vector<std::uint8_t>& lengths) {
    for (const std::uint8_t length : lengths) ++counts_[length];
    counts_[0] = 0;
    std::array<unsigned, kLongest + 2> next{};
    for (unsigned length = 1; length <= kLongest; ++length) {
      next[length + 1] = next[length] + counts_[length];
    }
    symbols_.resize(lengths.size());
    for (unsigned symbol = 0; symbol < lengths.size(); ++symbol) {
      if (lengths[symbol] != 0) symbols_[next[lengths[symbol]]++] = symbol;
    }
    int left = 1;
    for (unsigned length = 1; length <= kLongest; ++length) {
      left = 2 * left - static_cast<int>(counts_[length]);
      if (left < 0) throw BadData();  // more codes than there can be
    }
  }

  unsigned take(Bits& bits) const {
    unsigned code = 0;
    unsigned first = 0;
    unsigned index = 0;
    for (unsigned length = 1; length <= kLongest; ++length) {
      code |= bits.take(1);
      if (code < first + counts_[length]) return symbols_[index + code - first];
      index += counts_[length];
      first = (first + counts_[length]) << 1U;
      code <<= 1U;
    }
    throw BadData();
  }

 private:
  std::array<unsigned, kLongest + 1> counts_{};
  std::vector<unsigned> symbols_;
};

struct Codes {
  Code literals;
  Code distances;
};

Codes fixed_codes() {
  std::vector<std::uint8_t> literals(288, 8);
  for (unsigned i = 144; i < 256; ++i) literals[i] = 9;
  for (unsigned i = 256; i < 280; ++i) literals[i] = 7;
  return {Code(literals), Code(std::vector<std::uint8_t>(30, 5))};
}

Codes sent_codes(Bits& bits) {
  constexpr std::uint8_t kOrder[] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                     11, 4,  12, 3, 13, 2, 14, 1, 15};
  const unsigned literals = bits.take(5) + 257;
  const unsigned distances = bits.take(5) + 1;
  const unsigned sent = bits.take(4) + 4;
  std::vector<std::uint8_t> lengths(19);
  for (unsigned i = 0; i < sent; ++i) lengths[kOrder[i]] = static_cast<std::uint8_t>(bits.take(3));
  const Code code(lengths);
  lengths.clear();
  while (lengths.size() < literals + distances) {
    const unsigned symbol = code.take(bits);
    if (symbol < 16) {
      lengths.push_back(static_cast<std::uint8_t>(symbol));
    } else if (symbol == 16) {
      if (lengths.empty()) throw BadData();
      lengths.insert(lengths.end(), 3 + bits.take(2), lengths.back());
    } else {
      lengths.insert(lengths.end(), symbol == 17 ? 3 + bits.take(3) : 11 + bits.take(7), 0);
    }
  }
  if (lengths.size() != literals + distances || literals > 286) throw BadData();
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(literals);
  return {Code({lengths.begin(), middle}), Code({middle, lengths.end()})};
}

void unpack_block(Bits& bits, const Codes& codes, std::string& out, std::size_t size) {
  constexpr std::uint16_t kLength[] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                       15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                       67, 83, 99, 115, 131, 163, 195, 227, 258};
  constexpr std::uint8_t kLengthBits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                          2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
  for (;;) {
    const unsigned symbol = codes.literals.take(bits);
    if (symbol == 256) return;
    if (symbol < 256) {
      out += static_cast<char>(symbol);
    } else {
      const unsigned kind = symbol - 257;
      if (kind >= std::size(kLength)) throw BadData();
      const std::size_t length = kLength[kind] + bits.take(kLengthBits[kind]);
      const unsigned far = codes.distances.take(bits);
      if (far >= 30) throw BadData();
      const unsigned more = far < 2 ? 0 : far / 2 - 1;
      const std::size_t distance =
          far < 2 ? far + 1 : ((2U + far % 2) << more) + 1 + bits.take(more);
      if (distance > out.size()) throw BadData();
      for (std::size_t i = 0; i < length; ++i) out += out[out.size() - distance];
    }
    if (out.size() > size) throw BadData();
  }
}

}  // namespace

std::optional<std::string> inflate(std::string_view packed, std::size_t size) {
  std::string out;
  try {
    Bits bits(packed);
    for (bool last = false; !last;) {
      last = bits.take(1) != 0;
      const unsigned kind = bits.take(2);
      if (kind == 0) {
        bits.drop_rest_of_byte();
        const unsigned length = bits.take(16);
        if ((bits.take(16) ^ length) != 0xFFFF) throw BadData();
        out += bits.block(length);
      } else if (kind == 1) {
        unpack_block(bits, fixed_codes(), out, size);
      } else if (kind == 2) {
        unpack_block(bits, sent_codes(bits), out, size);
      } else {
        throw BadData();
      }
      if (out.size() > size) throw BadData();
    }
  } catch (const BadData&) {
    return std::nullopt;
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

std::uint32_t crc32_of(std::string_view bytes) {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = value >> 1U ^ ((value & 1U) != 0 ? 0xEDB88320U : 0);
    table[i] = value;
  }
  std::uint32_t crc = ~std::uint32_t{0};
  for (const char byte : bytes)
    crc = crc >> 8U ^ table[(crc ^ static_cast<std::uint8_t>(byte)) & 0xFFU];
  return ~crc;
}

}  // namespace mb4::sim
