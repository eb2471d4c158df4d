// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/sensor_keys.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/core/number_text.hpp"
#include "sim/core/text_file.hpp"

namespace mb4::sim {
namespace {

constexpr std::int64_t kMaxBits = 64;
constexpr std::int64_t kMaxPolynomial = 0x1FFFF;  // degree 16
constexpr double kMinTimeoutUs = 0.05;
constexpr double kMaxTimeoutUs = 1e6;
constexpr double kMaxSampleNs = 1e5;

constexpr double kUsualPeriodUs = 10'000;
constexpr double kUsualAmplitude = 1000;

// A quarter of all positions, if they are few.
double usual_amplitude(const SensorConfig& config) {
  const double quarter = std::ldexp(0.25, static_cast<int>(config.data_bits - config.flag_bits));
  return std::min(kUsualAmplitude, quarter);
}

bool fits(std::uint64_t value, unsigned bits) { return bits >= 64 || (value >> bits) == 0; }

// Reads the words of a file into `source`. Returns the path of the file.
std::string read_words(TomlReader& reader, unsigned data_bits, DataSource& source) {
  const auto name = reader.file_name("file");
  source.repeat = reader.boolean("repeat").value_or(true);
  if (!name) {
    reader.missing("file", "missing: source \"file\" needs it");
    return "";
  }
  const std::string path = beside(reader.file().name, *name);
  std::string text;
  try {
    text = read_text_file(path);
  } catch (const ScenarioError& error) {
    reader.fail("file", error.what());
  }
  unsigned number = 0;
  for (std::size_t at = 0; at < text.size();) {
    ++number;
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    line.resize(std::min(line.find('#'), line.size()));
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    line = line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
    const auto value = parse_word(line);
    if (!value || !fits(*value, data_bits)) {
      throw ScenarioError(path + ":" + std::to_string(number) + ": '" + line +
                          "' is no number of " + std::to_string(data_bits) + " bits");
    }
    source.words.push_back(*value);
  }
  if (source.words.empty()) reader.fail("file", path + " holds no words");
  return path;
}

}  // namespace

void read_source(TomlReader& reader, SensorConfig& config, std::string& file,
                 std::string_view bits_key) {
  DataSource& source = config.source;
  const auto kind = reader.choice("source", {"ramp", "sine", "file"});
  if (const auto word = reader.word("data")) {
    if (kind) reader.fail("data", "cannot be given together with source");
    if (!fits(*word, config.data_bits)) {
      const unsigned needed = 64U - static_cast<unsigned>(std::countl_zero(*word));
      reader.fail("data", "does not fit into " + std::to_string(config.data_bits) +
                              " bits: " + hex_word(*word) + " needs " + std::string(bits_key) +
                              " = " + std::to_string(needed) + ", the highest is " +
                              hex_word((std::uint64_t{1} << config.data_bits) - 1));
    }
    source.constant = *word;
  } else if (!kind) {
    // A sensor at position 0 without an error or a warning.
    source.constant = config.flags;
  }
  if (!kind) return;
  if (*kind == 0) {
    source.kind = DataSource::Kind::kRamp;
    source.start = reader.integer("start", INT64_MIN, INT64_MAX).value_or(0);
    source.step = reader.integer("step", INT64_MIN, INT64_MAX).value_or(1);
  } else if (*kind == 1) {
    source.kind = DataSource::Kind::kSine;
    constexpr double kMaxPosition = 9e18;
    source.offset = reader.number("offset", -kMaxPosition, kMaxPosition).value_or(0);
    source.amplitude =
        reader.number("amplitude", 0, kMaxPosition).value_or(usual_amplitude(config));
    if (const double most = kMaxPosition - std::abs(source.offset); source.amplitude > most) {
      reader.fail("amplitude", "with offset " + plain(source.offset) + " at most " + plain(most));
    }
    source.period = from_us(reader.number("period_us", 0.001, 1e12).value_or(kUsualPeriodUs));
  } else {
    source.kind = DataSource::Kind::kList;
    file = read_words(reader, config.data_bits, source);
  }
}

void read_crc(TomlReader& reader, Crc& crc) {
  if (const auto polynomial = reader.integer("crc", 0, kMaxPolynomial)) {
    if (*polynomial != 0 && (*polynomial < 3 || *polynomial % 2 == 0)) {
      reader.fail("crc", "not a full polynomial such as 0x43 (0 = no CRC)");
    }
    crc.polynomial = static_cast<std::uint32_t>(*polynomial);
  }
  if (const auto start = reader.integer("crc_start", 0, 0xFFFF)) {
    crc.start = static_cast<std::uint32_t>(*start);
  }
}

void read_timeout_us(TomlReader& reader, std::string_view name, Time& value) {
  if (const auto us = reader.number(name, kMinTimeoutUs, kMaxTimeoutUs)) value = from_us(*us);
}

void read_timeout(TomlReader& reader, SlaveTimeout& timeout) {
  const TomlValue* value = reader.value("timeout", {"\"adaptive\""});
  if (value != nullptr && value->is(TomlValue::Kind::kText)) {
    if (value->text != "adaptive") {
      reader.fail("timeout", "expected \"adaptive\" or a number of microseconds");
    }
    timeout.fixed = 0;
  } else {
    read_timeout_us(reader, "timeout", timeout.fixed);
  }
  if (const auto ns = reader.number("t_sample_ns", 0, kMaxSampleNs)) {
    timeout.sample_period = from_ns(*ns);
    if (!timeout.adaptive() && *ns != 0) {
      reader.fail("t_sample_ns", "only an adaptive timeout has it");
    }
  }
}

void read_lengths(TomlReader& reader, unsigned& data_bits, unsigned& flag_bits,
                  unsigned default_flags) {
  if (const auto bits = reader.integer("data_bits", 1, kMaxBits)) {
    data_bits = static_cast<unsigned>(*bits);
  }
  if (data_bits == 0) {
    reader.missing("data_bits");
    data_bits = kMaxBits;
  }
  if (const auto flags = reader.integer("flag_bits", 0, kMaxBits)) {
    flag_bits = static_cast<unsigned>(*flags);
    if (flag_bits > data_bits) {
      reader.fail("flag_bits", std::to_string(flag_bits) + " is more than data_bits");
    }
  } else {
    flag_bits = data_bits > default_flags ? default_flags : 0;
  }
}

void read_sensor(TomlReader& reader, SensorConfig& config, unsigned default_flags,
                 std::string& file) {
  read_lengths(reader, config.data_bits, config.flag_bits, default_flags);
  const unsigned counter = config.life_counter.bits;
  if (counter > config.flag_bits) {
    reader.fail("life_counter_bits", std::to_string(counter) + " is more than flag_bits");
  }
  const unsigned flag_bits = config.flag_bits - counter;
  config.flags = (fits(0b11, flag_bits) ? 0b11U : (1U << flag_bits) - 1U) << counter;
  if (const auto flags = reader.word("flags")) {
    if (!fits(*flags, config.flag_bits)) {
      reader.fail("flags", "does not fit into flag_bits = " + std::to_string(config.flag_bits));
    }
    config.flags = *flags;
  }
  read_crc(reader, config.crc);
  read_source(reader, config, file);
}

void know_source_keys(TomlReader& reader) {
  reader.know(
      {"data", "source", "start", "step", "amplitude", "period_us", "offset", "file", "repeat"});
}

void know_sensor_keys(TomlReader& reader) {
  reader.know({"data_bits", "flag_bits", "flags", "crc", "crc_start"});
  know_source_keys(reader);
}

}  // namespace mb4::sim
