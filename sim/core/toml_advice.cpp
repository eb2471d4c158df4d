// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/toml_advice.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

struct Unit {
  std::string_view name;
  char kind;  // time, frequency, length
  int power;  // of ten
};
constexpr Unit kUnits[] = {{"ps", 't', -12}, {"ns", 't', -9}, {"us", 't', -6}, {"ms", 't', -3},
                           {"s", 't', 0},    {"hz", 'f', 0},  {"khz", 'f', 3}, {"mhz", 'f', 6},
                           {"ghz", 'f', 9},  {"mm", 'l', -3}, {"cm", 'l', -2}, {"m", 'l', 0},
                           {"km", 'l', 3}};
constexpr double kLargestWhole = 1e15;
constexpr int kLongestPlain = 4;  // digits without an underscore

const Unit* unit_by_name(std::string_view name) {
  std::string lower(name);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto* found = std::find_if(std::begin(kUnits), std::end(kUnits),
                                   [&](const Unit& each) { return each.name == lower; });
  return found == std::end(kUnits) ? nullptr : found;
}

// A key such as "at_us": "at" and the unit; null if it has none.
struct KeyWithUnit {
  std::string_view stem;
  const Unit* unit;
};
KeyWithUnit cut_unit(std::string_view key) {
  const std::size_t at = key.rfind('_');
  if (at == std::string_view::npos) return {key, nullptr};
  return {key.substr(0, at), unit_by_name(key.substr(at + 1))};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool is_word_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string quoted(std::string_view text) {
  std::string all(1, '"');
  all.append(text).append(1, '"');
  return all;
}

// All lines up to the closing brace as one; empty if there is none.
std::string joined(const std::vector<std::string_view>& lines, std::size_t at,
                   std::string_view value) {
  std::string all(value);
  while (all.find('}') == std::string::npos) {
    if (++at == lines.size()) return "";
    const std::string_view next = trimmed(lines[at]);
    if (next.find('#') != std::string_view::npos) return "";
    if (!next.empty()) all.append(" ").append(next);
  }
  return all;
}

// The value that was meant, as TOML has it; empty if nothing is known. `key` tells the unit.
std::string meant_value(std::string_view key, std::string_view value) {
  if (value.empty()) return "";
  if (value.back() == ',' && value.front() != '[' && value.front() != '{') {
    const std::string_view left = trimmed(value.substr(0, value.size() - 1));
    const std::string better = meant_value(key, left);
    return better.empty() ? std::string(left) : better;
  }
  if (std::count(value.begin(), value.end(), '"') == 1) {
    const bool at_begin = value.front() == '"';
    const bool at_end = value.back() == '"';
    if (at_begin) return quoted(value.substr(1));
    if (at_end) return quoted(value.substr(0, value.size() - 1));
  }
  const std::string line = number_line(key, value);
  if (!line.empty()) return line.substr(line.find('=') + 2);
  const bool word = std::all_of(value.begin(), value.end(), is_word_letter) &&
                    std::isalpha(static_cast<unsigned char>(value.front())) != 0;
  if (!word) return "";
  if (value == "True" || value == "TRUE") return "true";
  if (value == "False" || value == "FALSE") return "false";
  return value == "true" || value == "false" ? "" : quoted(value);
}

}  // namespace

std::string toml_number(double value) {
  if (std::abs(value) >= kLargestWhole || value != std::floor(value)) return plain(value);
  std::string digits = std::to_string(static_cast<std::int64_t>(std::abs(value)));
  if (digits.size() > kLongestPlain) {
    for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, '_');
  }
  return value < 0 ? digits.insert(0, 1, '-') : digits;
}

std::optional<InUnit> other_unit(std::string_view key, double value,
                                 const std::vector<std::string>& known) {
  const KeyWithUnit typed = cut_unit(key);
  if (typed.unit == nullptr) return std::nullopt;
  for (const std::string& each : known) {
    const KeyWithUnit one = cut_unit(each);
    if (one.unit == nullptr || one.stem != typed.stem || one.unit->kind != typed.unit->kind) {
      continue;
    }
    const int power = typed.unit->power - one.unit->power;
    const double factor = std::pow(10, std::abs(power));
    return InUnit{each, power >= 0 ? value * factor : value / factor};
  }
  return std::nullopt;
}

std::string number_line(std::string_view key, std::string_view text) {
  text = trimmed(text);
  std::size_t end = 0;
  std::string digits;
  while (end < text.size() && (is_word_letter(text[end]) || text[end] == '+') &&
         (std::isalpha(static_cast<unsigned char>(text[end])) == 0 || text.starts_with("0x"))) {
    if (text[end] != '_') digits += text[end];
    ++end;
  }
  if (digits.empty()) return "";
  const std::string_view rest = trimmed(text.substr(end));
  const std::string begin = std::string(key) + " = ";
  if (text.starts_with("0x")) {
    return rest.empty() && parse_word(text.substr(0, end))
               ? begin + std::string(text.substr(0, end))
               : "";
  }
  const auto number = parse_real(digits);
  if (!number) return "";
  const double value = *number;
  if (rest.empty()) return begin + std::string(text.substr(0, end));
  const Unit* typed = unit_by_name(rest);
  const KeyWithUnit own = cut_unit(key);
  if (typed == nullptr || own.unit == nullptr || own.unit->kind != typed->kind) return "";
  const int power = typed->power - own.unit->power;
  const double factor = std::pow(10, std::abs(power));
  return begin + toml_number(power >= 0 ? value * factor : value / factor);
}

LineAdvice advice_on_line(std::string_view text, unsigned number) {
  const std::vector<std::string_view> lines = lines_of(text);
  LineAdvice advice;
  if (number == 0 || number > lines.size()) return advice;
  for (std::size_t at = number; at-- > 0;) {
    const std::string_view line = trimmed(lines[at]);
    if (!line.starts_with('[')) continue;
    advice.section = line.substr(0, line.find_last_of(']') + 1);
    break;
  }
  const std::string_view line = trimmed(lines[number - 1]);
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return advice;
  const std::string_view key = trimmed(line.substr(0, equals));
  if (key.empty() || !std::all_of(key.begin(), key.end(), is_word_letter)) return advice;
  std::string_view value = line.substr(equals + 1);
  if (value.find('"') == std::string_view::npos) value = value.substr(0, value.find('#'));
  value = trimmed(value);
  advice.key = key;
  const bool open = value.starts_with('{') && value.find('}') == std::string_view::npos;
  const std::string meant = open ? joined(lines, number - 1, value) : meant_value(key, value);
  if (!meant.empty()) advice.line = advice.key + " = " + meant;
  return advice;
}

}  // namespace mb4::sim
