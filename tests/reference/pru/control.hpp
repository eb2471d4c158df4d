// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The control channel: a free word of 32 bits, one bit of it in each frame (R-P15, R-P17).
#ifndef TESTS_REFERENCE_PRU_CONTROL_HPP_
#define TESTS_REFERENCE_PRU_CONTROL_HPP_

#include <cstdint>
#include <optional>
#include <string>

namespace pru_judge {

struct ControlResult {
  std::uint8_t data = 0;
  std::uint8_t crc = 0;  // as received
  bool crc_error = false;
};

class Control {
 public:
  static constexpr unsigned kLeadIn = 14;  // frames with CDM = 0 before START
  static constexpr unsigned kSlots = 32;   // START and bits 31..1

  // CDM of the frame that comes next, or is running.
  bool cdm() const;
  // From the take of a word to the end of its last frame.
  bool running() const { return running_; }
  // CMD_START_FLAG: START has been sent, and the end has not come.
  bool started() const { return running_ && taken_ > kLeadIn; }
  // Number of the frame after START (START is 0) that the next step() ends, none before START.
  std::optional<unsigned> slot() const;

  // Takes a word other than 0 at the end of a frame.
  void take(std::uint32_t word);
  // A frame that takes a bit has ended. Gives the result with the last frame.
  std::optional<ControlResult> step(bool cds);
  // RUN rose.
  void stop() { running_ = false; }

 private:
  bool running_ = false;
  std::uint32_t word_ = 0;
  unsigned taken_ = 0;  // frames since the take
  std::string cds_;     // of slots 20..31
};

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_CONTROL_HPP_
