// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes a frame on the line from its edges and the scenario's data of the slaves. It does not use
// the chip.
#ifndef MB4SIM_TOOL_FRAME_DECODE_HPP_
#define MB4SIM_TOOL_FRAME_DECODE_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "plot/field.hpp"
#include "plot/line_recording.hpp"
#include "sim/core/time.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// Labels for a wrong CRC: the received value and the right one, in more and in fewer words.
std::vector<std::string> wrong_crc(std::uint32_t got, std::uint32_t right, unsigned bits);

struct DecodedFrame {
  FrameTrace trace;
  sim::Time delay = 0;          // of SL against MA
  std::vector<sim::Time> bits;  // where the bits on SL begin, one period each
  std::vector<Field> sl;
  std::vector<Field> ma;
  bool cds = false;
  bool cdm = false;
  bool complete = false;  // all fields have been found
  bool good = false;      // and every CRC is right
  std::string mistakes;   // the CRCs that are wrong, with both values
  std::vector<std::uint64_t> words;
};

DecodedFrame decode_frame(const LineRecording& recording, const FrameTrace& trace,
                          const sim::ChannelConfig& channel);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_FRAME_DECODE_HPP_
