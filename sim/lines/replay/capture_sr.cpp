// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Sessions of sigrok, version 2: a ZIP file with "metadata" and the samples of all channels in
// pieces "logic-1-1", "logic-1-2", ... of at most a few megabytes.
#include <algorithm>
#include <map>
#include <optional>

#include "sim/core/number_text.hpp"
#include "sim/lines/replay/capture.hpp"
#include "sim/lines/replay/inflate.hpp"

namespace mb4::sim {
namespace {

constexpr std::size_t kMaxPiece = std::size_t{64} << 20U;

class ZipFile {
 public:
  ZipFile(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    constexpr std::size_t kEndSize = 22;
    std::size_t end = bytes.size() < kEndSize ? std::string_view::npos
                                              : bytes.rfind("PK\x05\x06", bytes.size() - kEndSize);
    if (end == std::string_view::npos) {
      fail(bytes.size(), "expected the end of a ZIP file: is the .sr file whole?");
    }
    std::size_t at = number(end + 16, 4);
    for (std::size_t left = number(end + 10, 2); left != 0; --left) {
      if (number(at, 4) != 0x02014B50) fail(at, "expected an entry of the ZIP file's directory");
      const std::size_t length = number(at + 28, 2);
      entries_[std::string(part(at + 46, length))] = {
          number(at + 10, 2), static_cast<std::uint32_t>(number(at + 16, 4)), number(at + 20, 4),
          number(at + 24, 4), number(at + 42, 4)};
      at += 46 + length + number(at + 30, 2) + number(at + 32, 2);
    }
  }

  bool has(const std::string& entry) const { return entries_.count(entry) != 0; }

  std::string read(const std::string& entry) const {
    const auto found = entries_.find(entry);
    if (found == entries_.end()) fail(bytes_.size(), "expected '" + entry + "' in the .sr file");
    const Entry& place = found->second;
    if (number(place.at, 4) != 0x04034B50)
      fail(place.at, "expected '" + entry + "' of the ZIP file");
    const std::size_t from = place.at + 30 + number(place.at + 26, 2) + number(place.at + 28, 2);
    const std::string_view packed = part(from, place.packed);
    if (place.size > kMaxPiece) fail(from, "expected '" + entry + "' to have at most 64 MiB");
    std::optional<std::string> text;
    if (place.method == 0 && place.size == place.packed) text = std::string(packed);
    if (place.method == 8) text = inflate(packed, place.size);
    if (!text || crc32_of(*text) != place.crc) {
      fail(from, "expected '" + entry + "', stored or deflated with " + std::to_string(place.size) +
                     " bytes and its CRC: the .sr file is damaged");
    }
    return std::move(*text);
  }

 private:
  struct Entry {
    std::size_t method;
    std::uint32_t crc;
    std::size_t packed;
    std::size_t size;
    std::size_t at;
  };

  [[noreturn]] void fail(std::size_t byte, const std::string& message) const {
    throw RecordingError(name_ + ": byte " + std::to_string(byte) + ": " + message);
  }
  std::string_view part(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) {
      fail(std::min(at, bytes_.size()),
           "expected " + std::to_string(size) + " bytes, the file ends");
    }
    return bytes_.substr(at, size);
  }
  // Low byte first.
  std::size_t number(std::size_t at, std::size_t size) const {
    std::size_t value = 0;
    const std::string_view bytes = part(at, size);
    for (std::size_t i = size; i-- != 0;) value = value << 8U | static_cast<std::uint8_t>(bytes[i]);
    return value;
  }

  std::string_view bytes_;
  const std::string& name_;
  std::map<std::string, Entry> entries_;
};

// The lines KEY=VALUE of "[device 1]".
struct Metadata {
  std::map<std::string, std::string> values;
  std::map<std::string, std::size_t> lines;
};

Metadata metadata_of(std::string_view text, const std::string& name) {
  Metadata data;
  std::size_t number = 0;
  bool mine = false;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with('[')) mine = line == "[device 1]";
    const std::size_t equal = line.find('=');
    if (!mine || equal == std::string_view::npos) continue;
    data.values[std::string(line.substr(0, equal))] = line.substr(equal + 1);
    data.lines[std::string(line.substr(0, equal))] = number;
  }
  for (const char* key : {"capturefile", "samplerate", "unitsize"}) {
    if (data.values.count(key) == 0) {
      fail_at_line(name + ": metadata", number, std::string("expected ") + key + "= in [device 1]");
    }
  }
  return data;
}

}  // namespace

Capture parse_sr(std::string_view bytes, const std::string& name, const CaptureNames& signals) {
  const ZipFile zip(bytes, name);
  Metadata data = metadata_of(zip.read("metadata"), name);
  const auto fail = [&](const std::string& key, const std::string& message) {
    fail_at_line(name + ": metadata", data.lines[key], message);
  };
  const double rate = frequency(data.values["samplerate"]);
  if (rate == 0) fail("samplerate", "expected a rate such as samplerate=200 MHz");
  const auto unit_size = parse_word(data.values["unitsize"]);
  if (!unit_size || *unit_size == 0 || *unit_size > 8) fail("unitsize", "expected unitsize=1 to 8");
  const auto unit = static_cast<std::size_t>(*unit_size);

  // Probe n is bit n - 1 of a sample, whose low byte is first.
  std::vector<std::string> names;
  const auto bit_of = [&](const std::string& wanted) -> unsigned {
    names.clear();
    for (unsigned bit = 0; bit < 8 * unit; ++bit) {
      const auto found = data.values.find("probe" + std::to_string(bit + 1));
      if (found == data.values.end()) continue;
      if (found->second == wanted) return bit;
      names.push_back(found->second);
    }
    fail("capturefile", "expected a channel '" + wanted + "', the file has " + quoted(names));
    return 0;
  };
  const unsigned ma = bit_of(signals.ma);
  const unsigned sl = bit_of(signals.sl);

  Capture capture;
  std::uint64_t sample = 0;
  std::string before;
  const std::string base = data.values["capturefile"];
  const bool pieces = zip.has(base + "-1");
  for (unsigned piece = 1; pieces ? zip.has(base + "-" + std::to_string(piece)) : piece == 1;
       ++piece) {
    const std::string samples = zip.read(pieces ? base + "-" + std::to_string(piece) : base);
    for (std::size_t at = 0; at + unit <= samples.size(); at += unit, ++sample) {
      // Most samples are as the one before.
      if (sample != 0 && samples.compare(at, unit, before) == 0) continue;
      before = samples.substr(at, unit);
      const auto level = [&](unsigned bit) {
        return (static_cast<std::uint8_t>(before[bit / 8]) >> bit % 8 & 1U) != 0;
      };
      if (sample == 0) {
        capture.ma.first = level(ma);
        capture.sl.first = level(sl);
      }
      const Time now = sample_time(sample, rate);
      capture.ma.set(now, level(ma));
      capture.sl.set(now, level(sl));
    }
  }
  capture.end = sample_time(sample, rate);
  return capture;
}

}  // namespace mb4::sim
