// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/frame_report.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "report/messages.hpp"

namespace mb4::tool {
namespace {

constexpr const char* kTableRow = "{:>5}  {:>12}  {:>5}  {:>{}}  {:>{}}  {:>2}  {:>2}  {:>6}  {}\n";

constexpr const char* kWrongData = "wrong data, not what the slave sent";

std::string state_of(const SlaveResult& result) {
  if (!result.word) return result.error;
  const bool error = !result.word->n_error.value_or(true);
  const bool warning = !result.word->n_warning.value_or(true);
  if (error && warning) return "ok (encoder error, warning)";
  if (error) return "ok (encoder error)";
  if (warning) return "ok (encoder warning)";
  return "ok";
}

}  // namespace

// The values of one row as text; a missing value is empty.
struct FrameReport::Cells {
  std::string raw;
  std::string position;
  std::string error;    // nE
  std::string warning;  // nW
  std::string crc;
};

FrameReport::Cells FrameReport::cells(const FrameRow& row) {
  Cells cells;
  if (!row.word) return cells;
  const Word& word = *row.word;
  cells.raw = fmt::format("0x{:0{}X}", word.bits, (word.data_bits + 3) / 4);
  cells.position = fmt::format("{}", word.flag_bits >= 64 ? 0 : word.bits >> word.flag_bits);
  if (word.n_error) cells.error = fmt::format("{:d}", *word.n_error);
  if (word.n_warning) cells.warning = fmt::format("{:d}", *word.n_warning);
  if (word.crc) cells.crc = fmt::format("0x{:02X}", *word.crc);
  return cells;
}

FrameReport::FrameReport(const sim::Scenario& scenario) {
  for (const ConnectedSlave& one : connected_slaves(scenario))
    counts_.push_back({one.number, 0, 0});
}

std::uint64_t FrameReport::good() const {
  std::uint64_t sum = 0;
  for (const SlaveCount& count : counts_) sum += count.good;
  return sum;
}

std::uint64_t FrameReport::bad() const {
  std::uint64_t sum = 0;
  for (const SlaveCount& count : counts_) sum += count.bad;
  return sum;
}

const FrameRow& FrameReport::add(const SessionFrame& frame, unsigned slave, std::size_t index) {
  const SlaveResult& result = frame.results[index];
  any_ = any_ || row_.frame != 0;
  row_ = {frame.number, frame.end, slave, result.word, false, state_of(result)};
  row_.wrong = frame.kind(index) == SlaveOutcome::Kind::kWrong;
  if (row_.wrong) row_.state = kWrongData;
  for (SlaveCount& count : counts_) {
    if (count.slave == slave) ++(row_.good() ? count.good : count.bad);
  }
  if (!row_.good()) ++errors_[row_.state];
  return row_;
}

std::string FrameReport::worst_error() const {
  const auto worst = std::max_element(errors_.begin(), errors_.end(),
                                      [](auto& a, auto& b) { return a.second < b.second; });
  return worst == errors_.end() ? "" : worst->first;
}

std::string FrameReport::table_header() const {
  return fmt::format(kTableRow, "frame", "time/us", "slave", "raw", 18, "position", 20, "nE", "nW",
                     "CRC", "state");
}

std::string FrameReport::table_row() const {
  const Cells c = cells(row_);
  const auto dash = [](const std::string& text) { return text.empty() ? std::string("-") : text; };
  return fmt::format(kTableRow, row_.frame, fmt::format("{:.3f}", sim::to_us(row_.time)),
                     row_.slave, dash(c.raw), 18, dash(c.position), 20, dash(c.error),
                     dash(c.warning), dash(c.crc), row_.state);
}

std::string FrameReport::table_summary(const RunSummary& summary) const {
  std::string out;
  const char* separator = "errors: ";
  for (const auto& [error, number] : errors_) {
    out += fmt::format("{}{} {}", separator, error, number);
    separator = ", ";
  }
  if (!errors_.empty()) out += '\n';
  // With one slave the sum is enough.
  if (counts_.size() > 1) {
    for (const SlaveCount& count : counts_) {
      out += fmt::format("slave {}: good {}, bad {}\n", count.slave, count.good, count.bad);
    }
  }
  return out + fmt::format(
                   "frames good {}, bad {}; simulated time {:.3f} us, simulated clocks {}; seed "
                   "{}\n",
                   good(), bad(), sim::to_us(summary.time), summary.clocks, summary.seed);
}

std::string FrameReport::csv_header() const {
  return "frame,time_us,slave,raw,position,nE,nW,crc,state\n";
}

std::string FrameReport::csv_row() const {
  const Cells c = cells(row_);
  std::string state = row_.state;
  if (state.find(',') != std::string::npos) state = fmt::format("\"{}\"", state);
  return fmt::format("{},{:.3f},{},{},{},{},{},{},{}\n", row_.frame, sim::to_us(row_.time),
                     row_.slave, c.raw, c.position, c.error, c.warning, c.crc, state);
}

std::string FrameReport::json_header(const std::string& scenario, std::uint64_t seed) const {
  return fmt::format("{{\"scenario\": {}, \"seed\": {}, \"frames\": [", json_text(scenario), seed);
}

std::string FrameReport::json_row() const {
  const auto number = [](const std::string& text) {
    return text.empty() ? std::string("null") : text;
  };
  const auto quoted = [](const std::string& text) {
    return text.empty() ? std::string("null") : json_text(text);
  };
  const Cells c = cells(row_);
  return fmt::format(
      "{}\n  {{\"frame\": {}, \"time_us\": {:.3f}, \"slave\": {}, \"good\": {}, \"raw\": {}, "
      "\"position\": {}, \"nE\": {}, \"nW\": {}, \"crc\": {}, \"state\": {}}}",
      any_ ? "," : "", row_.frame, sim::to_us(row_.time), row_.slave, row_.good(), quoted(c.raw),
      number(c.position), number(c.error), number(c.warning), quoted(c.crc), json_text(row_.state));
}

std::string FrameReport::json_summary(const RunSummary& summary, const std::string& more) const {
  std::string out = fmt::format(
      "\n], \"summary\": {{\"good\": {}, \"bad\": {}, \"time_us\": {:.3f}, \"clocks\": {}, "
      "\"slaves\": [",
      good(), bad(), sim::to_us(summary.time), summary.clocks);
  for (const SlaveCount& count : counts_) {
    out += fmt::format("{}{{\"slave\": {}, \"good\": {}, \"bad\": {}}}",
                       &count == &counts_.front() ? "" : ", ", count.slave, count.good, count.bad);
  }
  out += "], \"errors\": {";
  const char* separator = "";
  for (const auto& [error, number] : errors_) {
    out += fmt::format("{}{}: {}", separator, json_text(error), number);
    separator = ", ";
  }
  return out + "}}" + more + "}\n";
}

}  // namespace mb4::tool
