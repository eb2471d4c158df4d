// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// H-frames of DSL from the recorded level of the line at the master, where both ends are seen. The
// place of the answers is learned from the training frames of the recording. Nothing here knows the
// code of the master or of the encoder.
#ifndef MB4SIM_TOOL_DSL_DECODE_HPP_
#define MB4SIM_TOOL_DSL_DECODE_HPP_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plot/dsl_words.hpp"
#include "plot/field.hpp"
#include "plot/wave.hpp"

namespace mb4::tool {

// Bits of a frame in a free run.
inline constexpr unsigned kDslSwitch = 26;
inline constexpr unsigned kDslTrailer = 100;

// The words of an answer.
struct DslWords {
  DslWord vertical;
  DslWord parameter;
  DslWord pipeline;
  DslWord acceleration_high;
  DslWord acceleration_low;
  DslWord secondary;
  bool direction = false;
  std::optional<int> second_difference;  // nothing: a word or CRC5 is wrong
};

struct DslFrame {
  sim::Time begin = 0;  // of the first bit of SYNC
  double bit = 0;       // ps
  // The byte of M_PAR; nothing if it is no word.
  std::optional<std::uint8_t> parameter;
  unsigned bits = 0;           // up to the end of its stuffing
  std::optional<double> late;  // bits from the end of SWITCH to the answer; nothing: not learned
  std::uint64_t answer = 0;    // its first bit is bit 60
  DslWords words;              // not in the training
  std::vector<Field> sent;     // by the master
  std::vector<Field> answered;
  std::string mistakes;  // of the line; empty: none

  bool training() const;
  bool has_answer() const;  // or the master fills the window
  sim::Time at(double place) const { return begin + static_cast<sim::Time>(place * bit + 0.5); }
  sim::Time answer_at(double place) const;
};

// The symbols of a running frame, five bits each. Nothing: none could be read.
struct DslExchange {
  std::optional<unsigned> sent;      // M_PAR
  std::optional<unsigned> answered;  // S_PAR
};
// Those of all frames behind the training.
std::vector<DslExchange> dsl_exchanges(const Wave& line, double bit);

// "IDLE, first, msync".
std::string parameter_text(std::optional<std::uint8_t> parameter);

// The frame whose edge in SAMPLE is at this time, give or take two bits; without such an edge what
// the line shows there. `bit`: its length, ps. The recording has to go on to the end of the frame.
DslFrame decode_dsl(const Wave& line, sim::Time sampled, double bit);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_DECODE_HPP_
