// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/mb4/spi_lines.hpp"

#include <fmt/core.h>

#include <charconv>

#include "sim/core/words.hpp"

namespace mb4::tool {
namespace {

constexpr std::uint64_t kMaxAdvanceNs = 1'000'000'000'000;  // 1000 s

template <typename T>
bool parse_whole(std::string_view word, T& value, int base) {
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value, base);
  return error == std::errc() && stop == end;
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view line) {
  return sim::split_at_blanks(line.substr(0, line.find('#')));
}

std::string execute_words(sim::Simulator& simulator, SimBus& bus,
                          const std::vector<std::string_view>& words,
                          std::vector<std::uint8_t>& received) {
  received.clear();
  if (words[0].starts_with('+')) {
    std::uint64_t ns = 0;
    if (words.size() != 1 || !parse_whole(words[0].substr(1), ns, 10) || ns > kMaxAdvanceNs) {
      return "expected +N with N nanoseconds up to 10^12";
    }
    simulator.advance(ns * sim::kPsPerNs);
    return "";
  }
  if (words[0] == "pin") {
    if (words.size() != 3 || (words[2] != "0" && words[2] != "1")) {
      return "expected 'pin NAME LEVEL' with level 0 or 1";
    }
    const auto pin = simulator.pin_by_name(words[1]);
    if (!pin) return fmt::format("there is no pin '{}'", words[1]);
    if (!simulator.can_set(*pin)) {
      return fmt::format("pin '{}' is driven by chip or simulation", words[1]);
    }
    simulator.set_pin(*pin, words[2] == "1");
    return "";
  }
  std::vector<std::uint8_t> tx;
  for (const std::string_view word : words) {
    std::uint8_t byte = 0;
    if (word.size() != 2 || !parse_whole(word, byte, 16)) {
      return fmt::format("expected bytes of two hex digits, +N or pin NAME LEVEL, found '{}'",
                         word);
    }
    tx.push_back(byte);
  }
  received.resize(tx.size());
  bus.transfer({tx.data(), tx.size()}, {received.data(), received.size()});
  return "";
}

}  // namespace mb4::tool
