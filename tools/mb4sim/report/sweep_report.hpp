// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The results of a sweep over delay, jitter, duty distortion and codes of the MA frequency (FREQS):
// as text, CSV and picture.
#ifndef MB4SIM_TOOL_SWEEP_REPORT_HPP_
#define MB4SIM_TOOL_SWEEP_REPORT_HPP_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mb4::tool {

// Words read at one delay and jitter: one of each slave a frame.
struct SweepPoint {
  std::uint64_t words = 0;
  std::uint64_t flagged = 0;  // the driver reported an error
  std::uint64_t wrong = 0;    // delivered as good, but not what the slave had sent

  std::uint64_t bad() const { return flagged + wrong; }
};

// Item I305 in the unit of Sweep::jitters_mpercent.
inline constexpr long long kI305 = 25'000;

// One code of the MA frequency, or of another rule, with one skew; points[delay][jitter].
struct SweepPlane {
  unsigned code = 0;
  std::uint64_t ma_hz = 0;                   // bits a second, for codes that are no frequencies
  long long allowed_mpercent = kI305;        // jitter up to which every word must be good
  std::string title;                         // empty: of the frequency
  std::optional<long long> skew_mpercent{};  // of SL; empty: that of the scenario
  std::vector<std::vector<SweepPoint>> points;
};

struct Sweep {
  std::string scenario;
  std::string code_name;    // "FREQS"
  std::string jitter_item;  // where the limit of the jitter is written ("I305"); empty: nowhere
  std::uint64_t seed = 0;
  std::uint64_t frames = 0;          // per point
  std::vector<long long> delays_ps;  // round trip
  std::string period = "T_MA";       // what a jitter is a part of
  // Peak to peak, thousandths of a percent of it.
  std::vector<long long> jitters_mpercent;
  std::vector<SweepPlane> planes;

  // Every word was good wherever the jitter is allowed.
  bool within_allowed() const;
  // A point has allowed jitter.
  bool any_allowed() const;
  // "25 %"; "12, 35 %" if they differ.
  std::string allowed_text() const;
};

// A table of bad words for each plane, and a summary.
std::string sweep_text(const Sweep& sweep);
// The same as one object.
std::string sweep_json(const Sweep& sweep);
// One line a point, with a header.
std::string sweep_csv(const Sweep& sweep);
// Eye margin: the share of bad words over delay and jitter, one panel for each plane.
std::string sweep_svg(const Sweep& sweep);

// "FREQS 0x00: MA 10000 kHz, T_MA 100 ns".
std::string plane_title(const Sweep& sweep, const SweepPlane& plane);

// "20 frames at each point".
std::string frames_text(const Sweep& sweep);

// "12.5": thousandths as a decimal number without trailing zeros.
std::string thousandths(long long value);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SWEEP_REPORT_HPP_
