// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/dsl_decode.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace mb4::tool {
namespace {

// Bits of a frame in a free run.
constexpr unsigned kFrameBits = 108;
constexpr unsigned kBlockBits = 6;  // of stuffing
constexpr unsigned kMaxBlocks = 26;
constexpr unsigned kDslEdge = 8;  // of SAMPLE
constexpr unsigned kEqualise = 12;
constexpr unsigned kParameter = 16;
constexpr unsigned kLatestBits = 12;  // bits that an answer may be late

// M_PAR: the two highest bits, and the symbols.
constexpr unsigned kFirstBit = 0x80;
constexpr unsigned kVerticalBit = 0x40;
enum DslSymbol : unsigned {
  kIdle = 0x10,
  kSync = 0x19,
  kStart = 0x1A,
  kLearn = 0x1B,
  kCheck = 0x1C,
  kIdRequest = 0x1D,
  kInit = 0x1E,
  kReset = 0x1F,
};

unsigned symbol_of(std::uint8_t parameter) { return parameter & 0x1FU; }

// The first mistake counts.
void blame(DslFrame& frame, std::string mistake) {
  if (frame.mistakes.empty()) frame.mistakes = std::move(mistake);
}

unsigned bits_at(const Wave& line, const DslFrame& frame, unsigned first, unsigned count) {
  unsigned bits = 0;
  for (unsigned i = 0; i < count; ++i) {
    bits = bits << 1U | (line.at(frame.at(first + i + 0.5)) ? 1U : 0U);
  }
  return bits;
}

// The falling edges of SAMPLE up to a time: 00 1 0 11 and the ones of SAMPLE stand before it. The
// same in an answer does not count.
std::vector<sim::Time> sample_edges(const Wave& line, sim::Time until, double bit) {
  std::vector<sim::Time> found;
  std::array<unsigned, 4> runs{};  // lengths, the latest first
  sim::Time last = 0;
  for (const Edge& edge : line.edges) {
    if (edge.time > until) break;
    std::move_backward(runs.begin(), runs.end() - 1, runs.end());
    constexpr double kLongest = 1000;
    runs[0] = static_cast<unsigned>(
        std::min(static_cast<double>(edge.time - last) / bit + 0.5, kLongest));
    last = edge.time;
    if (edge.level || runs[0] < 4 || runs[1] != 1 || runs[2] != 1 || runs[3] < 2) continue;
    const auto apart = static_cast<sim::Time>((kFrameBits - kDslEdge - 2) * bit);
    if (found.empty() || edge.time > found.back() + apart) found.push_back(edge.time);
  }
  return found;
}

// A frame up to M_PAR.
DslFrame begun(const Wave& line, sim::Time edge, double bit) {
  DslFrame frame;
  frame.bit = bit;
  const auto ahead = static_cast<sim::Time>(kDslEdge * bit + 0.5);
  frame.begin = edge - std::min(edge, ahead);
  frame.parameter = dsl_parameter(bits_at(line, frame, kParameter, 10));
  frame.bits = kFrameBits;
  while (frame.bits < kFrameBits + kMaxBlocks * kBlockBits &&
         bits_at(line, frame, frame.bits, 9) != 0b001011110 &&
         bits_at(line, frame, frame.bits, kBlockBits) == 0b001011) {
    frame.bits += kBlockBits;
  }
  return frame;
}

// How late the answer of a training frame begins: its pattern begins with 0. All its edges count.
std::optional<double> measure(const Wave& line, const DslFrame& frame) {
  std::optional<sim::Time> first;
  double away = 0;
  unsigned count = 0;
  for (const Edge& edge : line.edges) {
    if (edge.time < frame.at(kDslSwitch + 0.5)) continue;
    if (!first) {
      if (edge.time > frame.at(kDslSwitch + 1 + kLatestBits)) break;
      if (edge.level) continue;
      first = edge.time;
    }
    const double bits = static_cast<double>(edge.time - *first) / frame.bit;
    if (bits > kDslAnswerBits - 0.5) break;
    away += bits - std::round(bits);
    ++count;
  }
  if (!first) return std::nullopt;
  return static_cast<double>(*first - frame.at(kDslSwitch + 1)) / frame.bit + away / count;
}

Field field(const DslFrame& frame, double from, double to, FieldKind kind,
            std::vector<std::string> labels, bool bad = false) {
  return {frame.at(from), frame.at(to), kind, std::move(labels), bad};
}

void add_sent(const Wave& line, DslFrame& frame) {
  const bool sync = bits_at(line, frame, 0, kEqualise) == 0b001011'110'110;
  const bool trailer = bits_at(line, frame, kDslTrailer, 8) == 0b00000011;
  const unsigned equal = bits_at(line, frame, kEqualise, 4);
  const auto add = [&](double from, double to, FieldKind kind, std::vector<std::string> labels,
                       bool bad = false) {
    frame.sent.push_back(field(frame, from, to, kind, std::move(labels), bad));
  };
  add(0, 6, FieldKind::kFraming, {"SYNC"}, !sync);
  add(6, 9, FieldKind::kFraming, {"SAMPLE"}, !sync);
  add(9, kEqualise, FieldKind::kFraming, {"CYCLE RESET", "CYCLE R."}, !sync);
  add(kEqualise, kParameter, FieldKind::kFlag,
      {fmt::format("EQUALISATION {:04b}", equal), "EQUAL."});
  const std::string text = parameter_text(frame.parameter);
  const std::string byte = frame.parameter ? fmt::format(" {:02X}", *frame.parameter) : "";
  add(kParameter, kDslSwitch, FieldKind::kControl,
      {fmt::format("M_PAR{}: {}", byte, text), "M_PAR: " + text, "M_PAR"}, !frame.parameter);
  if (frame.has_answer()) {
    add(kDslSwitch, kDslSwitch + 1, FieldKind::kRest, {"SWITCH", "SW."});
    add(kDslSwitch + 1, kDslTrailer, FieldKind::kRest, {"its driver is off"});
  } else {
    add(kDslSwitch, kDslTrailer, FieldKind::kFraming, {"0101... for the encoder's clock"});
  }
  add(kDslTrailer, kFrameBits, FieldKind::kFraming, {"TRAILER"}, !trailer);
  if (frame.bits > kFrameBits) {
    add(kFrameBits, frame.bits, FieldKind::kRest, {"STUFFING", "STUFF."});
  }
  if (!sync) blame(frame, "no SYNC");
  if (!frame.parameter) blame(frame, "M_PAR is no word");
  if (!trailer) blame(frame, "no TRAILER");
}

DslWords words_of(std::uint64_t answer) {
  const auto bits = [answer](unsigned first) {
    return static_cast<unsigned>(answer >> (kDslAnswerBits - 10 - first)) & 0x3FFU;
  };
  return {.vertical = dsl_word(bits(0)),
          .parameter = dsl_word(bits(10)),
          .pipeline = dsl_word(bits(20)),
          .acceleration_high = dsl_word(bits(30)),
          .acceleration_low = dsl_word(bits(40)),
          .secondary = dsl_word(bits(51)),
          .direction = (answer >> 10U & 1U) != 0,
          .second_difference = dsl_second_difference(bits(30), bits(40))};
}

std::string byte_text(const DslWord& word) {
  if (word.error) return "?";
  return fmt::format("{}{:02X}", word.special ? "K " : "", word.byte);
}

void add_answered(DslFrame& frame) {
  const auto add = [&](double from, double to, FieldKind kind, std::vector<std::string> labels,
                       bool bad = false) {
    frame.answered.push_back(
        {frame.answer_at(from), frame.answer_at(to), kind, std::move(labels), bad});
  };
  frame.answered.push_back(
      {frame.at(kDslSwitch + 1),
       frame.answer_at(0),
       FieldKind::kRest,
       {fmt::format("{:.2f} bits late", *frame.late), fmt::format("{:.2f} late", *frame.late),
        fmt::format("{:.1f}", *frame.late)},
       false});
  if (frame.training()) {
    const bool bad = frame.answer != kDslPattern;
    add(0, kDslAnswerBits, FieldKind::kFlag, {bad ? "wrong test pattern" : "test pattern"}, bad);
    if (bad) blame(frame, "wrong test pattern");
    return;
  }
  frame.words = words_of(frame.answer);
  const DslWords& words = frame.words;
  const auto word = [&](unsigned from, FieldKind kind, std::string_view name, const DslWord& read,
                        bool bad = false) {
    const std::string text = byte_text(read);
    add(from, from + 10, kind, {fmt::format("{} {}", name, text), text}, read.error || bad);
    if (read.error) blame(frame, fmt::format("{}: no word of the code", name));
  };
  const bool identity = frame.parameter && symbol_of(*frame.parameter) == kIdRequest;
  const bool crc5 = identity || words.second_difference.has_value();
  if (!crc5) blame(frame, "acceleration: CRC5 wrong");
  const auto marks = [](const DslWord& read) { return read.special && read.byte == kDslMarker; };
  if (marks(words.acceleration_high) && marks(words.acceleration_low)) {
    blame(frame, "the encoder has no second difference");
  }
  word(0, FieldKind::kData, "vertical", words.vertical);
  word(10, FieldKind::kControl, "S_PAR", words.parameter);
  word(20, FieldKind::kRest, "pipeline", words.pipeline);
  word(30, FieldKind::kData, "acceleration", words.acceleration_high);
  word(40, FieldKind::kCrc, "acceleration, CRC5", words.acceleration_low, !crc5);
  add(50, 51, FieldKind::kFlag, {words.direction ? "1" : "0"});
  word(51, FieldKind::kData, "secondary", words.secondary);
}

}  // namespace

bool DslFrame::training() const {
  if (!parameter) return false;
  const unsigned symbol = symbol_of(*parameter);
  return symbol >= kStart && symbol <= kCheck;
}

bool DslFrame::has_answer() const {
  return !parameter || (symbol_of(*parameter) != kReset && symbol_of(*parameter) != kSync);
}

sim::Time DslFrame::answer_at(double place) const {
  return at(kDslSwitch + 1 + late.value_or(0) + place);
}

std::string parameter_text(std::optional<std::uint8_t> parameter) {
  if (!parameter) return "?";
  std::string text;
  switch (symbol_of(*parameter)) {
    case kIdle:
      text = "IDLE";
      break;
    case kSync:
      text = "SYNC";
      break;
    case kStart:
      text = "START";
      break;
    case kLearn:
      text = "LEARN";
      break;
    case kCheck:
      text = "CHECK";
      break;
    case kIdRequest:
      text = "ID REQ";
      break;
    case kInit:
      text = "INIT";
      break;
    case kReset:
      text = "RESET";
      break;
    default:
      text = fmt::format("nibble {:X}", *parameter & 0xFU);
  }
  if ((*parameter & kFirstBit) != 0) text += ", first";
  if ((*parameter & kVerticalBit) != 0) text += ", msync";
  return text;
}

std::vector<DslExchange> dsl_exchanges(const Wave& line, double bit) {
  std::vector<DslExchange> found;
  if (line.edges.empty()) return found;
  std::optional<double> late;
  const sim::Time end = line.edges.back().time;
  for (const sim::Time edge : sample_edges(line, end, bit)) {
    DslFrame frame = begun(line, edge, bit);
    if (frame.at(kFrameBits) > end) break;
    if (frame.training()) late = measure(line, frame);
    if (!frame.has_answer()) found.clear();  // a link begins
    const unsigned symbol = frame.parameter ? symbol_of(*frame.parameter) : unsigned{kIdle};
    if (!late || !frame.has_answer() || frame.training() || symbol == kIdRequest) continue;
    frame.late = late;
    unsigned bits = 0;
    for (unsigned i = 10; i < 20; ++i) {
      bits = bits << 1U | (line.at(frame.answer_at(i + 0.5)) ? 1U : 0U);
    }
    const DslWord word = dsl_word(bits);
    DslExchange exchange;
    if (frame.parameter) exchange.sent = symbol;
    if (!word.error && !word.special) exchange.answered = word.byte & 0x1FU;
    found.push_back(exchange);
  }
  return found;
}

DslFrame decode_dsl(const Wave& line, sim::Time sampled, double bit) {
  const auto near = static_cast<sim::Time>(2 * bit);
  std::vector<sim::Time> edges = sample_edges(line, sampled + near, bit);
  if (edges.empty() || edges.back() + near < sampled) edges.push_back(sampled);
  DslFrame frame = begun(line, edges.back(), bit);
  add_sent(line, frame);
  if (!frame.has_answer()) return frame;
  for (auto edge = edges.rbegin(); edge != edges.rend() && !frame.late; ++edge) {
    const DslFrame before = begun(line, *edge, bit);
    if (before.training()) frame.late = measure(line, before);
    if (!before.has_answer()) break;  // an earlier training counts no more
  }
  if (!frame.late) {
    blame(frame, "no answer");
    return frame;
  }
  for (unsigned i = 0; i < kDslAnswerBits; ++i) {
    frame.answer = frame.answer << 1U | (line.at(frame.answer_at(i + 0.5)) ? 1U : 0U);
  }
  add_answered(frame);
  return frame;
}

}  // namespace mb4::tool
