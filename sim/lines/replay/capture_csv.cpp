// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CSV files: those of sigrok, whose comments hold channels and rate, and others with a column of
// time.
#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/number_text.hpp"
#include "sim/lines/replay/capture.hpp"

namespace mb4::sim {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t\r\"");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r\"") - from + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    if (end == line.size()) return cells;
    at = end + 1;
  }
}

// Picoseconds of the unit that the heading of a column of time names: "Time [s]", "nanoseconds". 0:
// it is another column. Nothing: a time without a unit.
std::optional<double> unit_of(std::string_view heading) {
  struct Unit {
    std::string_view short_name;
    std::string_view long_name;
    double ps;
  };
  constexpr Unit kUnits[] = {{"ps", "picoseconds", 1},
                             {"ns", "nanoseconds", 1e3},
                             {"us", "microseconds", 1e6},
                             {"ms", "milliseconds", 1e9},
                             {"s", "seconds", 1e12}};
  std::string text;
  for (const char c : heading) {
    if (c != '[' && c != ']' && c != '(' && c != ')' && c != ' ') {
      text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
  }
  const bool time = text.starts_with("time");
  if (time) text.erase(0, 4);
  for (const Unit& unit : kUnits) {
    if (text == unit.long_name || (time && text == unit.short_name)) return unit.ps;
  }
  if ((time && text.empty()) || text == "samples") return std::nullopt;
  return 0;
}

class CsvFile {
 public:
  CsvFile(std::string_view text, const std::string& name, const CaptureNames& signals)
      : text_(text), name_(name), signals_(signals) {}

  Capture parse() {
    while (next()) {
      if (line_.empty()) continue;
      if (line_.front() == ';') {
        comment(trimmed(line_.substr(1)));
      } else if (line_.starts_with("META ")) {  // sigrok, of an input that tells its rate late
        comment(trimmed(line_.substr(5)));
      } else if (!headed_) {
        heading();
      } else {
        row();
      }
    }
    if (!headed_) fail("expected a line of headings, the file ends");
    if (rows_ == 0) fail("expected rows of levels, the file ends");
    capture_.end = now_;
    return std::move(capture_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    fail_at_line(name_, number_, message);
  }

  bool next() {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line_ = trimmed(text_.substr(0, end));
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    return true;
  }

  void comment(std::string_view text) {
    if (text.starts_with("Channels")) {
      const std::size_t colon = text.find(':');
      if (colon == std::string_view::npos) return;
      for (const std::string_view channel : cells_of(text.substr(colon + 1))) {
        channels_.emplace_back(channel);
      }
    } else if (text.starts_with("Samplerate:") || text.starts_with("samplerate:")) {
      rate_ = frequency(trimmed(text.substr(11)));
      if (rate_ == 0) fail("expected a rate such as '; Samplerate: 200 MHz'");
    }
  }

  void heading() {
    headed_ = true;
    const auto cells = cells_of(line_);
    columns_ = cells.size();
    const auto unit = unit_of(cells[0]);
    // sigrok heads each channel with "logic"; its comment has the names.
    std::vector<std::string> names(cells.begin(), cells.end());
    const bool timed = !unit || *unit != 0;
    const std::size_t first = timed ? 1 : 0;
    if (std::all_of(names.begin() + static_cast<std::ptrdiff_t>(first), names.end(),
                    [](const std::string& name) { return name == "logic"; }) &&
        channels_.size() == names.size() - first) {
      std::copy(channels_.begin(), channels_.end(),
                names.begin() + static_cast<std::ptrdiff_t>(first));
    }
    ma_ = column(names, first, signals_.ma);
    sl_ = column(names, first, signals_.sl);
    if (!unit) {
      fail(
          "expected a unit in the heading of the time, such as 'Time [s]' or 'nanoseconds' "
          "(sigrok: "
          "label=units)");
    }
    if (timed) {
      unit_ = *unit;
    } else if (rate_ == 0) {
      fail("expected a line '; Samplerate: ...' before, or a first column such as 'Time [s]'");
    }
  }

  std::size_t column(const std::vector<std::string>& names, std::size_t first,
                     const std::string& name) const {
    const auto from = names.begin() + static_cast<std::ptrdiff_t>(first);
    const auto found = std::find(from, names.end(), name);
    if (found == names.end()) {
      fail("expected a column '" + name + "', the file has " + quoted({from, names.end()}));
    }
    return static_cast<std::size_t>(found - names.begin());
  }

  bool level(std::string_view cell, const std::string& name) const {
    if (cell != "0" && cell != "1") {
      fail("expected 0 or 1 in column '" + name + "', found '" + std::string(cell.substr(0, 20)) +
           "'");
    }
    return cell == "1";
  }

  void row() {
    const auto cells = cells_of(line_);
    if (cells.size() != columns_) {
      fail("expected " + std::to_string(columns_) + " columns, found " +
           std::to_string(cells.size()));
    }
    if (unit_ != 0) {
      const auto time = parse_real(cells[0]);
      if (!time) fail("expected a time, found '" + std::string(cells[0].substr(0, 20)) + "'");
      const double ps = *time * unit_;
      if (rows_ == 0) begin_ = ps;
      if (!(ps - begin_ < static_cast<double>(kEndOfTime))) fail("expected a time below 2^63 ps");
      if (ps - begin_ < static_cast<double>(now_))
        fail("expected a time after that of the row before");
      now_ = static_cast<Time>(std::llround(ps - begin_));
    } else {
      now_ = sample_time(rows_, rate_);
    }
    const bool ma = level(cells[ma_], signals_.ma);
    const bool sl = level(cells[sl_], signals_.sl);
    if (rows_ == 0) {
      capture_.ma.first = ma;
      capture_.sl.first = sl;
    }
    capture_.ma.set(now_, ma);
    capture_.sl.set(now_, sl);
    ++rows_;
  }

  std::string_view text_;
  const std::string& name_;
  const CaptureNames& signals_;
  std::string_view line_;
  std::size_t number_ = 0;
  std::vector<std::string> channels_;
  double rate_ = 0;
  bool headed_ = false;
  std::size_t columns_ = 0;
  std::size_t ma_ = 0;
  std::size_t sl_ = 0;
  double unit_ = 0;  // ps; 0: no column of time
  double begin_ = 0;
  std::uint64_t rows_ = 0;
  Time now_ = 0;
  Capture capture_;
};

}  // namespace

Capture parse_csv(std::string_view text, const std::string& name, const CaptureNames& signals) {
  return CsvFile(text, name, signals).parse();
}

}  // namespace mb4::sim
