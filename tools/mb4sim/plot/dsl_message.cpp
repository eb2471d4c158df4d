// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/dsl_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "plot/dsl_words.hpp"

namespace mb4::tool {
namespace {

using Symbol = std::optional<unsigned>;

constexpr unsigned kNibble = 0x10;  // symbols below it
constexpr unsigned kSilence = 0x10;
constexpr std::size_t kMargin = 2;   // frames on either side
constexpr std::size_t kLongest = 8;  // frames of silence that are drawn in full

bool is_nibble(const Symbol& symbol) { return symbol && *symbol < kNibble; }

// In more and in fewer words.
std::vector<std::string> names_of(const Symbol& symbol, bool answer) {
  if (!symbol) return {"?"};
  if (*symbol < kNibble) return {fmt::format("{:X}", *symbol)};
  switch (*symbol) {
    case kSilence:
      return {"IDLE"};
    case 0x15:
      return {answer ? "short NAK" : "?", answer ? "NAK" : "?"};
    case 0x1A:
      return {answer ? "long NAK" : "START", answer ? "NAK" : "?"};
    case 0x1E:
      return {answer ? "?" : "INIT"};
    case 0x1F:
      return {answer ? "INIT" : "RESET"};
    default:
      return {"?"};
  }
}

// Where the frames stand: a long silence is cut.
class FrameAxis {
 public:
  FrameAxis(const std::vector<DslExchange>& frames, std::size_t first, std::size_t end)
      : first_(first) {
    std::size_t silent = 0;
    for (std::size_t i = first; i <= end; ++i) {
      const bool idle =
          i < end && frames[i].sent == Symbol(kSilence) && frames[i].answered == Symbol(kSilence);
      if (!idle) {
        // The middle of a silence is one cell.
        if (silent > kLongest) close(silent);
        silent = 0;
      }
      cells_.push_back(next_);
      next_ += 1;
      silent = idle ? silent + 1 : 0;
    }
  }
  double at(std::size_t frame) const { return cells_[frame - first_]; }
  double length() const { return cells_.back(); }
  const std::vector<double>& cuts() const { return cuts_; }

 private:
  void close(std::size_t silent) {
    const std::size_t begin = cells_.size() - silent;
    const double from = cells_[begin];
    constexpr double kShown = kLongest;
    for (std::size_t i = 0; i < silent; ++i) {
      cells_[begin + i] = from + kShown * static_cast<double>(i) / static_cast<double>(silent);
    }
    cuts_.push_back(from + kShown / 2);
    next_ = from + kShown;
  }

  std::size_t first_;
  double next_ = 0;
  std::vector<double> cells_;  // begin of each frame, and of the one behind
  std::vector<double> cuts_;
};

struct Direction {
  DiagramRow symbols;
  DiagramRow bytes;
  std::string text;  // the bytes of its messages
  bool good = true;
};

// A run of nibbles from `from` up to `to`.
void add_run(Direction& out, const FrameAxis& axis, const std::vector<unsigned>& nibbles,
             std::size_t from) {
  constexpr std::size_t kCheck = 2;  // bytes
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < nibbles.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(nibbles[i] << 4U | nibbles[i + 1]));
  }
  const bool good = nibbles.size() % 2 == 0 && bytes.size() > kCheck &&
                    dsl_check({bytes.data(), bytes.size() - kCheck}) ==
                        (bytes[bytes.size() - 2] << 8U | bytes.back());
  out.good &= good;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool crc = i + kCheck >= bytes.size();
    out.bytes.fields.push_back({{axis.at(from + 2 * i), axis.at(from + 2 * i + 2)},
                                crc ? FieldKind::kCrc : FieldKind::kData,
                                {fmt::format("{:02X}", bytes[i])},
                                crc && !good});
  }
  out.text += fmt::format("{}{:02X}{}", out.text.empty() ? "" : "; ", fmt::join(bytes, " "),
                          good ? "" : " (cut short, or its CRC is wrong)");
}

Direction direction(const std::vector<DslExchange>& frames, Symbol DslExchange::*which, bool answer,
                    const FrameAxis& axis, std::size_t first, std::size_t end) {
  Direction out;
  out.symbols.type = out.bytes.type = DiagramRow::Type::kFields;
  out.symbols.name = answer ? "S_PAR" : "M_PAR";
  std::vector<unsigned> run;
  for (std::size_t i = first; i < end;) {
    const Symbol& symbol = frames[i].*which;
    std::size_t to = i + 1;
    if (is_nibble(symbol)) {
      run.push_back(*symbol);
    } else {
      if (!run.empty()) add_run(out, axis, run, i - run.size());
      run.clear();
      while (to < end && frames[to].*which == symbol) ++to;
    }
    const FieldKind kind = is_nibble(symbol)            ? FieldKind::kFlag
                           : symbol == Symbol(kSilence) ? FieldKind::kRest
                                                        : FieldKind::kControl;
    out.symbols.fields.push_back(
        {{axis.at(i), axis.at(to)}, kind, names_of(symbol, answer), !symbol});
    out.good &= symbol.has_value();
    i = to;
  }
  if (!run.empty()) add_run(out, axis, run, end - run.size());
  return out;
}

}  // namespace

std::optional<Picture> dsl_message_picture(const std::vector<DslExchange>& frames) {
  const auto speaks = [](const DslExchange& frame) {
    return is_nibble(frame.sent) || is_nibble(frame.answered);
  };
  const auto from = std::find_if(frames.begin(), frames.end(), speaks);
  if (from == frames.end()) return std::nullopt;
  const auto last = std::find_if(frames.rbegin(), frames.rend(), speaks).base();
  const auto begin = static_cast<std::size_t>(from - frames.begin());
  const auto behind = static_cast<std::size_t>(last - frames.begin());
  const std::size_t first = begin - std::min(begin, kMargin);
  const std::size_t end = std::min(behind + kMargin, frames.size());
  const FrameAxis axis(frames, first, end);
  const Direction sent = direction(frames, &DslExchange::sent, false, axis, first, end);
  const Direction answered = direction(frames, &DslExchange::answered, true, axis, first, end);
  Picture picture;
  picture.good = sent.good && answered.good && !answered.text.empty();
  Diagram& diagram = picture.diagram;
  diagram.notes = {
      fmt::format("To the encoder: {}", sent.text.empty() ? "nothing" : sent.text),
      fmt::format("From the encoder: {}", answered.text.empty() ? "nothing" : answered.text),
      "One cell for each H-frame; the last two bytes of a message are its CRC"};
  diagram.rows = {sent.symbols, sent.bytes, answered.symbols, answered.bytes};
  diagram.axis = "frame";
  diagram.length = axis.length();
  diagram.cuts = axis.cuts();
  for (std::size_t i = first; i < end; ++i) {
    const double middle = (axis.at(i) + axis.at(i + 1)) / 2;
    constexpr double kWhole = 0.99;
    if (axis.at(i + 1) - axis.at(i) > kWhole && (i - begin) % 4 == 0) {
      diagram.ticks.push_back({middle, fmt::format("{}", i - begin)});
    }
  }
  return picture;
}

}  // namespace mb4::tool
