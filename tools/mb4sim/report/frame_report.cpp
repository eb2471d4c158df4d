// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/frame_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "report/messages.hpp"

namespace mb4::tool {
namespace {

constexpr const char* kFirstCells = "{:>5}  {:>12}  {:>5}";
constexpr const char* kCell = "  {:>{}}";
constexpr const char* kLastCell = "  {}\n";
constexpr std::size_t kRowLength = 120;  // of most masters

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

FrameReport::FrameReport(const sim::Scenario& scenario, std::span<const WordColumn> columns)
    : columns_(columns) {
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
  row_ = {frame.number, frame.end, slave, result.word, false, state_of(result), result.told};
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

template <typename Use>
void FrameReport::each_cell(Use use) const {
  std::size_t told = 0;
  for (const WordColumn& column : columns_) {
    if (column.text != nullptr) {
      use(column, row_.word ? column.text(*row_.word) : std::string());
    } else {
      use(column, told < row_.told.size() ? row_.told[told] : std::string());
      ++told;
    }
  }
}

std::string FrameReport::table_header() const {
  std::string out = fmt::format(kFirstCells, "frame", "time/us", "slave");
  for (const WordColumn& column : columns_) {
    out += fmt::format(kCell, column.title, column.width);
  }
  return out + fmt::format(kLastCell, "state");
}

std::string FrameReport::table_row() const {
  std::string out;
  out.reserve(kRowLength);
  const auto end = std::back_inserter(out);
  fmt::format_to(end, kFirstCells, row_.frame, fmt::format("{:.3f}", sim::to_us(row_.time)),
                 row_.slave);
  each_cell([&out](const WordColumn& column, const std::string& text) {
    const std::string_view shown = text.empty() ? std::string_view("-") : text;
    out.append(2 + (column.width > shown.size() ? column.width - shown.size() : 0), ' ');
    out += shown;
  });
  out += "  ";
  out += row_.state;
  out += '\n';
  return out;
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
  if (!summary.note.empty()) out += summary.note + '\n';
  return out + fmt::format(
                   "frames good {}, bad {}; simulated time {:.3f} us, simulated clocks {}; seed "
                   "{}\n",
                   good(), bad(), sim::to_us(summary.time), summary.clocks, summary.seed);
}

std::string FrameReport::csv_header() const {
  std::string out = "frame,time_us,slave,";
  for (const WordColumn& column : columns_) out += fmt::format("{},", column.key);
  return out + "state\n";
}

std::string FrameReport::csv_row() const {
  std::string out = fmt::format("{},{:.3f},{},", row_.frame, sim::to_us(row_.time), row_.slave);
  each_cell([&out](const WordColumn& /*column*/, const std::string& text) { out += text + ','; });
  const bool quoted = row_.state.find(',') != std::string::npos;
  return out + fmt::format("{0}{1}{0}\n", quoted ? "\"" : "", row_.state);
}

std::string FrameReport::json_header(const std::string& scenario, std::uint64_t seed) const {
  return fmt::format("{{\"scenario\": {}, \"seed\": {}, \"frames\": [", json_text(scenario), seed);
}

std::string FrameReport::json_row() const {
  std::string out =
      fmt::format("{}\n  {{\"frame\": {}, \"time_us\": {:.3f}, \"slave\": {}, \"good\": {}, ",
                  any_ ? "," : "", row_.frame, sim::to_us(row_.time), row_.slave, row_.good());
  each_cell([&out](const WordColumn& column, const std::string& text) {
    out += fmt::format("\"{}\": {}, ", column.key,
                       text.empty()    ? "null"
                       : column.number ? text
                                       : json_text(text));
  });
  return out + fmt::format("\"state\": {}}}", json_text(row_.state));
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
  out += '}';
  if (!summary.note.empty()) out += ", \"note\": " + json_text(summary.note);
  return out + '}' + more + "}\n";
}

}  // namespace mb4::tool
