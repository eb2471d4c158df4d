// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What MA has to do in a frame: R-P6, R-P13, R-P15, R-P16.
#ifndef TESTS_REFERENCE_PRU_MA_HPP_
#define TESTS_REFERENCE_PRU_MA_HPP_

#include <string>
#include <vector>

#include "tests/reference/pru/frame.hpp"

namespace pru_judge {

// Number of rising edges from rising edge 1 on. The two differ where no master can know in time how
// the frame goes on, see ma_edges().
struct MaEdges {
  unsigned least = 0;
  unsigned most = 0;
  bool rests_at = true;  // level after the last edge
};

// `cdm`: the bit of the control frame that this frame sends. `decision`: so long after a sample MA
// may still go on as it did without it.
MaEdges ma_edges(const FrameSettings& settings, const FrameReading& reading, bool cdm,
                 Time decision);

// Complaints about the edges of MA in a frame, `rests` its level before them.
std::vector<std::string> check_ma(const FrameSettings& settings, const FrameReading& reading,
                                  const std::vector<Edge>& ma, bool rests, const MaEdges& expected);

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_MA_HPP_
