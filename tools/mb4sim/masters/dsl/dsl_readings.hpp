// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host gets of a DSL master, frame by frame: from the model itself, or from the registers of
// the RTL.
#ifndef MB4SIM_TOOL_DSL_READINGS_HPP_
#define MB4SIM_TOOL_DSL_READINGS_HPP_

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "mb4sim/simulator.hpp"
#include "session.hpp"
#include "sim/masters/dsl_model/safe_channels.hpp"

namespace mb4::tool {

// A frame with an answer, or the end of a link.
struct DslReading {
  std::uint64_t number = 0;  // running frames from 1 on; 0: the line is not that far
  sim::Time sampled = 0;     // the edge in SAMPLE
  bool acceleration_good = true;
  bool lost = true;            // the position is not certain
  std::uint64_t position = 0;  // as wide as the encoder says
  int speed = 0;
  unsigned quality = 0;
  unsigned delay = 0;
  bool safe_new = false;  // a vertical frame has ended, which brought these
  bool safe_here = true;  // it has ended with this frame
  sim::dsl_model::SafeChannel safe1;
  sim::dsl_model::SafeChannel safe2;
  std::string restart;  // why the link ended with this frame; empty: it goes on
};

class DslReadings {
 public:
  DslReadings() = default;
  DslReadings(const DslReadings&) = delete;
  DslReadings& operator=(const DslReadings&) = delete;
  virtual ~DslReadings() = default;

  // Before the first frame. Returns why it failed, or empty.
  virtual std::string begin() { return ""; }
  // Lets time pass up to the next frame, or up to `limit`: then there is none.
  virtual std::optional<DslReading> next(sim::Time limit) = 0;

  // Restarts of the link so far.
  virtual std::uint64_t restarts() = 0;
  // "state LEARN, 3 restarts, the last one: no answer was found".
  virtual std::string state() = 0;
  // As the encoder has told it.
  virtual std::uint32_t identity() const = 0;
  virtual RegisterMap registers() { return {}; }
  // What the user must know of the readings; empty: nothing.
  virtual std::string note() const { return ""; }
};

std::unique_ptr<DslReadings> readings_of_model(sim::Simulator& simulator);
// `log`: as WordPort has it.
std::unique_ptr<DslReadings> readings_of_registers(sim::Simulator& simulator, std::string* log);

// What an identity says.
constexpr unsigned dsl_position_bits(std::uint32_t identity) {
  return (identity >> 4U & 0x3FU) + (identity & 0xFU) + 8;
}
constexpr bool dsl_is_signed(std::uint32_t identity) { return (identity >> 10U & 1U) != 0; }

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_READINGS_HPP_
