// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "register_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "sim/core/number_text.hpp"

namespace mb4::tool {
namespace {

const RegisterMap::Code* code_of(const RegisterMap::Field& field) {
  const std::uint32_t value = field.value();
  const auto found = std::find_if(
      field.codes.begin(), field.codes.end(),
      [&](const RegisterMap::Code& code) { return value >= code.first && value <= code.last; });
  return found == field.codes.end() ? nullptr : &*found;
}

// "code + 1", "code - 127", with or without brackets.
std::optional<double> of_code(std::string_view text, std::uint32_t code) {
  if (text.starts_with('(') && text.ends_with(')')) text = text.substr(1, text.size() - 2);
  constexpr std::string_view kBegin = "code ";
  if (!text.starts_with(kBegin) || text.size() < kBegin.size() + 3) return std::nullopt;
  const auto step = sim::parse_real(text.substr(kBegin.size() + 2));
  if (!step) return std::nullopt;
  return text[kBegin.size()] == '-' ? code - *step : code + *step;
}

// A divisor of a formula: "20", "(code + 1)", "2^(code + 1)".
std::optional<double> divisor(std::string_view text, std::uint32_t code) {
  if (text.starts_with("2^")) {
    const auto power = of_code(text.substr(2), code);
    return power ? std::optional(std::exp2(*power)) : std::nullopt;
  }
  const auto value = of_code(text, code);
  return value ? value : sim::parse_real(text);
}

std::optional<double> frequency(const RegisterMap& map, std::string_view formula,
                                std::uint32_t code);

// f_CLK, or f_MA as the field FREQS makes it.
std::optional<double> base(const RegisterMap& map, std::string_view name) {
  if (map.clk_hz == 0) return std::nullopt;
  if (name == "f_CLK") return static_cast<double>(map.clk_hz);
  if (name != "f_MA") return std::nullopt;
  for (const RegisterMap::Field& field : map.fields) {
    const RegisterMap::Code* code = field.name == "FREQS" ? code_of(field) : nullptr;
    if (code != nullptr) return frequency(map, code->meaning, field.value());
  }
  return std::nullopt;
}

// Of a formula such as "f_CLK / 20 / (code + 1)"; nothing if the text is none.
std::optional<double> frequency(const RegisterMap& map, std::string_view formula,
                                std::uint32_t code) {
  constexpr std::string_view kBetween = " / ";
  std::size_t end = formula.find(kBetween);
  std::optional<double> hz = base(map, formula.substr(0, end));
  while (hz && end != std::string_view::npos) {
    const std::size_t at = end + kBetween.size();
    end = formula.find(kBetween, at);
    const auto by =
        divisor(formula.substr(at, end == std::string_view::npos ? end : end - at), code);
    hz = by && *by != 0 ? std::optional(*hz / *by) : std::nullopt;
  }
  return hz;
}

std::string hertz(double hz) {
  constexpr double kMega = 1e6;
  constexpr double kKilo = 1e3;
  if (hz >= kMega) return fmt::format("{:g} MHz", hz / kMega);
  return hz >= kKilo ? fmt::format("{:g} kHz", hz / kKilo) : fmt::format("{:g} Hz", hz);
}

// What a code means for this value; empty if that is not a value.
std::string meaning(const RegisterMap& map, const RegisterMap::Code& code, std::uint32_t value) {
  if (!code.name.empty()) return std::string(code.name);
  if (const auto hz = frequency(map, code.meaning, value)) return hertz(*hz);
  // "code + 1 bits"
  const std::size_t last = code.meaning.rfind(' ');
  if (last != std::string_view::npos) {
    if (const auto count = of_code(code.meaning.substr(0, last), value)) {
      return fmt::format("{:g}{}", *count, code.meaning.substr(last));
    }
  }
  return code.first == code.last ? std::string(code.meaning) : "";
}

}  // namespace

std::string value_text(const RegisterMap& map, const RegisterMap::Field& field) {
  const std::uint32_t value = field.value();
  const RegisterMap::Code* code = code_of(field);
  const bool all_named = std::all_of(
      field.codes.begin(), field.codes.end(),
      [](const RegisterMap::Code& each) { return !each.name.empty() && each.first == each.last; });
  if (code != nullptr && all_named) return std::string(code->name);
  constexpr unsigned kNarrow = 4;
  const unsigned digits = std::max(2U, (field.width + 3) / 4);
  const std::string plain = field.width < kNarrow && field.codes.empty()
                                ? fmt::format("{}", value)
                                : fmt::format("0x{:0{}X}", value, digits);
  const std::string word = code == nullptr ? "" : meaning(map, *code, value);
  return word.empty() ? plain : fmt::format("{} ({})", plain, word);
}

}  // namespace mb4::tool
