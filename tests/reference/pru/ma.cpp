// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/ma.hpp"

#include <algorithm>

namespace pru_judge {
namespace {

// Rising edges that a clock without end has had from rising edge 1 to the instant, and the one that
// ends a low half in which the instant lies.
unsigned clocked_to(const FrameSettings& settings, const FrameReading& reading, Time instant) {
  const Time period = settings.rate.period_ps();
  const Time since = instant - reading.rising_edge_1;
  return static_cast<unsigned>(since / period) + (since % period >= period / 2 ? 2 : 1);
}

MaEdges of_all(unsigned least, unsigned most, bool cdm) {
  // The last rising edge is left out with CDM = 1.
  const unsigned left_out = cdm ? 1 : 0;
  return {least - left_out, most - left_out, !cdm};
}

std::string in_ns(Time ps) { return std::to_string(ps / 1000) + " ns"; }

}  // namespace

MaEdges ma_edges(const FrameSettings& settings, const FrameReading& reading, bool cdm,
                 Time decision) {
  switch (reading.kind) {
    case FrameKind::kSlLow:
      return {};
    case FrameKind::kNoAcknowledge: {
      // Byte n ends with the last edge: with CDM = 1 no master can know that it has to leave it
      // out.
      const unsigned all = 2 + settings.search_periods();
      return of_all(all, all + (cdm ? 1 : 0), cdm);
    }
    case FrameKind::kDropped:
      return {clocked_to(settings, reading, reading.last_sample),
              clocked_to(settings, reading, reading.last_sample + decision), true};
    case FrameKind::kRead:
      break;
  }
  // R-P13. Edges behind the last one come before START where the line delay is as long as the
  // frame: then no master can know that they are too many.
  const unsigned least = 2 + 3 + settings.bits() + reading.zeros - (cdm ? 1 : 0);
  return {least, std::max(least, clocked_to(settings, reading, reading.start_bit + decision)),
          !cdm};
}

std::vector<std::string> check_ma(const FrameSettings& settings, const FrameReading& reading,
                                  const std::vector<Edge>& ma, bool rests,
                                  const MaEdges& expected) {
  std::vector<std::string> complaints;
  if (reading.kind == FrameKind::kSlLow) {
    if (!ma.empty()) complaints.push_back("MA moves although SL was 0 before the frame");
    return complaints;
  }
  const Time half = settings.rate.period_ps() / 2;
  // MA that rests at 0 rises, then falls for the frame.
  const std::size_t first = rests ? 0 : 1;
  if (!rests && ma.size() > 1 && ma[1].at - ma[0].at < half) {
    complaints.push_back("MA is high for " + in_ns(ma[1].at - ma[0].at) + " before the frame");
  }
  unsigned rising = 0;
  bool late = false;
  for (std::size_t i = first; i < ma.size(); ++i) {
    rising += ma[i].level ? 1 : 0;
    const Time due = reading.rising_edge_1 + (static_cast<Time>(i - first) - 1) * half;
    if (ma[i].at == due || late) continue;
    late = true;  // the first one says enough
    complaints.push_back("edge " + std::to_string(i - first) + " of MA is " +
                         in_ns(ma[i].at - due) + " late");
  }
  if (rising < expected.least || rising > expected.most) {
    complaints.push_back("MA has " + std::to_string(rising) + " rising edges, not " +
                         std::to_string(expected.least) +
                         (expected.most > expected.least ? " or one more" : ""));
  }
  if (ma.back().level != expected.rests_at) {
    complaints.push_back(std::string("MA rests at ") + (expected.rests_at ? "0" : "1"));
  }
  return complaints;
}

}  // namespace pru_judge
