// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The meaning of a control frame (register access or command) found from the CDM and CDS bits of
// the frames that carry it: datasheet pages 16 and 27 to 30, decision 31.
#ifndef MB4SIM_TOOL_CONTROL_DECODE_HPP_
#define MB4SIM_TOOL_CONTROL_DECODE_HPP_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plot/frame_decode.hpp"

namespace mb4::tool {

// The control bits of one frame. CDS answers the CDM of the frame before.
struct ControlBits {
  bool cdm;
  bool cds;
};

// Slots from..to-1 of a control frame; slot 0 has the start bit S.
struct SlotField {
  std::size_t from;
  std::size_t to;
  FieldKind kind;
  std::vector<std::string> labels;
  bool bad = false;
};

struct ControlFrame {
  std::size_t start = 0;  // index of slot 0 in the decoded bits
  std::size_t slots = 0;
  std::vector<SlotField> cdm;
  std::vector<SlotField> cds;
  std::string text;  // "read ID 0, 0x44: 00 D9", "command ..."
  bool complete = false;
  bool good = false;     // complete, and every CRC and echo is right
  std::string mistakes;  // the CRCs that are wrong, with both values
};

// The first control frame of `bits` from index `from` on. S is the first CDM = 1 after 14 or more
// frames with CDM = 0. `slots` is 0 if there is no control frame.
ControlFrame decode_control(const std::vector<ControlBits>& bits, std::size_t from = 0);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_CONTROL_DECODE_HPP_
