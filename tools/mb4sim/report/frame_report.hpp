// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The output of `mb4sim run`: table, CSV and JSON of the same rows, row by row.
#ifndef MB4SIM_TOOL_FRAME_REPORT_HPP_
#define MB4SIM_TOOL_FRAME_REPORT_HPP_

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "session.hpp"
#include "sim/core/time.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// One slave of one frame.
struct FrameRow {
  std::uint64_t frame = 0;  // counted from 1
  sim::Time time = 0;       // when the host had the result
  unsigned slave = 1;
  std::optional<Word> word;  // absent: bad frame
  // Delivered as good, but not the word that the slave has sent.
  bool wrong = false;
  std::string state;                // "ok", "encoder error", "CRC error", ...
  std::vector<std::string> told{};  // SlaveResult::told

  bool good() const { return word.has_value() && !wrong; }
};

// The counts of the frames of one slave by result.
struct SlaveCount {
  unsigned slave = 1;
  std::uint64_t good = 0;
  std::uint64_t bad = 0;
};

class FrameReport {
 public:
  // `columns`: Session::columns(); without rows none are needed.
  explicit FrameReport(const sim::Scenario& scenario, std::span<const WordColumn> columns = {});

  // `index`: of the slave in this frame.
  const FrameRow& add(const SessionFrame& frame, unsigned slave, std::size_t index);
  // Sums over all slaves.
  std::uint64_t good() const;
  std::uint64_t bad() const;

  // The most frequent error; empty if there was none.
  std::string worst_error() const;

  std::string table_header() const;
  std::string table_summary(const RunSummary& summary) const;
  std::string csv_header() const;
  // Opens the object and its array "frames"; rows follow, then json_summary() closes both.
  // `more`: further members, each with ", " before it.
  std::string json_header(const std::string& scenario, std::uint64_t seed) const;
  std::string json_summary(const RunSummary& summary, const std::string& more) const;
  // The row added last.
  std::string table_row() const;
  std::string csv_row() const;
  std::string json_row() const;

 private:
  // Calls use(column, text) for each cell of the row; the text is empty where there is none.
  template <typename Use>
  void each_cell(Use use) const;

  std::span<const WordColumn> columns_;
  std::vector<SlaveCount> counts_;               // by slave
  std::map<std::string, std::uint64_t> errors_;  // bad results by what was wrong
  FrameRow row_;                                 // added last
  bool any_ = false;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_FRAME_REPORT_HPP_
