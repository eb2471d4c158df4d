// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A line for the tests of the judge: what a right master sends on MA, and what an encoder at a
// cable answers. Written from the frame of BiSS C, not from the judge; check sums by shift register
// and table.
#ifndef TESTS_UNIT_PRU_JUDGE_BENCH_HPP_
#define TESTS_UNIT_PRU_JUDGE_BENCH_HPP_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "tests/reference/pru/judge.hpp"

namespace pru_judge_test {

using pru_judge::FrameReport;
using pru_judge::Judge;
using pru_judge::JudgeSetup;
using pru_judge::Time;
using pru_judge::Trace;

constexpr Time kNs = 1000;
constexpr Time kUs = 1000 * kNs;

std::string binary(std::uint64_t value, unsigned bits);
// As sent: 6 bits behind the bits of a word, 4 bits behind a byte of the control channel.
std::string crc6(const std::string& bits);
unsigned crc4(unsigned data, unsigned bits);

// What the encoder sends in a frame.
struct Answer {
  unsigned zeros = 0;  // processing time in periods
  bool cds = false;
  std::string bits;          // after CDS
  bool acknowledges = true;  // else SL stays 1
};
// Position, nE, nW and its CRC.
std::string word(std::uint64_t position, unsigned bits, const std::string& signals = "11");

class Bench {
 public:
  explicit Bench(const JudgeSetup& setup = {});

  Judge judge;
  Time delay = 180 * kNs;               // from MA at the master's pin to SL there
  std::function<Time()> jitter{};       // added to each edge of SL
  std::function<void(Trace&)> spoil{};  // makes MA of the next frame wrong
  std::optional<unsigned> ma_edges{};   // rising edges of the next frame, instead of the right ones
  bool sl_rest = true;                  // what SL shows between frames: 0 is a broken wire

  // Lengths, FREQUENCY and RUN.
  void start(unsigned position_bits, unsigned check_bits, unsigned mhz);
  // A frame with MA at the rate that the judge is told, and its report.
  FrameReport frame(const Answer& answer);
  // A frame that is not sent because SL is 0.
  FrameReport frame_without_ma();
  // A frame whose samples after rising edge 2 are these, '0' and '1' (a period has eight), and MA
  // as for `zeros`.
  FrameReport frame_of_samples(unsigned zeros, const std::string& samples);

 private:
  // MA of a frame; returns rising edge 1.
  Time clock(unsigned rising_edges);
  FrameReport report(Time start);
  Time period() const { return 1'000'000'000'000 / (judge.mhz() * 1'000'000U); }
  unsigned right_edges(unsigned zeros) const;

  JudgeSetup setup_;
  Trace ma_;
  Trace sl_;
  Time now_ = 100 * kUs;
  bool ma_rests_ = true;
};

}  // namespace pru_judge_test

#endif  // TESTS_UNIT_PRU_JUDGE_BENCH_HPP_
