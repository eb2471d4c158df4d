// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a DSL master tells of its last frame with an answer, for a picture: the model by itself, the
// RTL by its registers.
#ifndef MB4SIM_TOOL_DSL_SEEN_HPP_
#define MB4SIM_TOOL_DSL_SEEN_HPP_

#include <cstdint>
#include <optional>

#include "mb4sim/simulator.hpp"
#include "sim/masters/dsl_model/receiver.hpp"

namespace mb4::tool {

struct DslSeen {
  sim::Time sampled = 0;          // the edge in SAMPLE
  bool told = false;              // the master has told what follows
  std::uint64_t number = 0;       // running frames from 1 on; 0: training
  std::optional<unsigned> place;  // in its vertical frame
  unsigned sample_place = 0;      // number of the sample of the first bit
  unsigned delay = 0;
  std::uint64_t position = 0;
  bool lost = true;
  int speed = 0;
  unsigned quality = 0;
  bool restart = false;  // the frame ends the link
  std::optional<sim::dsl_model::Answer> answer;
};

// Nothing if there has been no such frame.
std::optional<DslSeen> dsl_seen(sim::Simulator& simulator);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_SEEN_HPP_
