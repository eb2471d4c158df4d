// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What `mb4sim run` prints: a table, CSV and JSON of the same rows.
#ifndef MB4SIM_TOOL_FRAME_REPORT_HPP_
#define MB4SIM_TOOL_FRAME_REPORT_HPP_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "chip_setup.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4sim/scenario.hpp"
#include "mb4sim/time.hpp"

namespace mb4::tool {

// One slave of one frame.
struct FrameRow {
  std::uint64_t frame = 0;  // counted from 1
  sim::Time time = 0;       // when the host had the result
  unsigned slave = 1;
  std::optional<Reading> reading;  // absent: bad frame
  std::string state;               // "ok", "encoder error", "CRC error", ...
};

struct RunSummary {
  sim::Time time = 0;
  std::uint64_t clocks = 0;
  std::uint64_t seed = 0;
};

// What became of the frames of one slave.
struct SlaveCount {
  unsigned slave = 1;
  std::uint64_t good = 0;
  std::uint64_t bad = 0;
};

class FrameReport {
 public:
  // The scenario must outlive the report.
  explicit FrameReport(const sim::Scenario& scenario);

  void add(std::uint64_t frame, sim::Time time, unsigned slave, const Result<Reading>& result);
  // Sums over all slaves.
  std::uint64_t good() const;
  std::uint64_t bad() const;

  std::string table_header() const;
  std::string table_row() const;  // the row added last
  std::string table_summary(const RunSummary& summary) const;
  std::string csv() const;
  std::string json(const std::string& scenario, const RunSummary& summary) const;

 private:
  struct Cells;
  Cells cells(const FrameRow& row) const;

  std::vector<ConnectedSlave> slaves_;
  std::vector<SlaveCount> counts_;  // as slaves_
  std::vector<FrameRow> rows_;
};

// A string as JSON, quotes included.
std::string json_text(const std::string& text);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_FRAME_REPORT_HPP_
