// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What one frame delivered for all slaves.

#ifndef MB4_FRAME_HPP_
#define MB4_FRAME_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/error.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"

namespace mb4 {

// All slaves of one frame. The caller provides it; about 300 bytes.
class Frame {
 public:
  // The result of slave 1..8. It is a Reading or an error: kCrc, kNoData (no new frame since the
  // last read, or none for this slave), kCorrupted, kSlaveError (nE = 0; reading() has the word).
  // kInvalidArgument: the slave is not enabled, it is an actuator, or `slave` is not 1..8.
  [[nodiscard]] const Result<Reading>& operator[](std::size_t slave) const {
    return results_[slave <= kSlaves ? slave : 0];
  }
  // Sets everything to the state after construction.
  void clear() {
    for (Result<Reading>& result : results_) {
      result = kNone;
    }
    status = Status();
    one_frame = false;
  }
  // Slave 1..8; nothing happens for other numbers.
  void set(std::size_t slave, const Result<Reading>& result) {
    if (slave - 1 < kSlaves) {
      results_[slave] = result;
    }
  }

  // True when every slave of `mask` (bit 0 is slave 1) has a Reading.
  [[nodiscard]] bool good(std::uint8_t mask) const {
    for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
      if (is_in(mask, static_cast<std::uint8_t>(slave)) && !results_[slave]) {
        return false;
      }
    }
    return true;
  }

  // True when every slave of `mask` has sent a whole word: a Reading, or kSlaveError.
  [[nodiscard]] bool complete(std::uint8_t mask) const {
    for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
      if (is_in(mask, static_cast<std::uint8_t>(slave)) && !results_[slave] &&
          results_[slave].error() != Error::kSlaveError) {
        return false;
      }
    }
    return true;
  }

  // Status read after the data.
  Status status;
  // All Readings, those with kSlaveError too, are of one frame of the line. False only where a bad
  // word was read again and the slave has sent the next one meanwhile (Automatic::poll(), next()),
  // and on an error of the call.
  bool one_frame = false;

 private:
  static constexpr Error kNone = Error::kInvalidArgument;
  // [0] is the answer for a number that is no slave; it never changes.
  std::array<Result<Reading>, kSlaves + 1> results_{
      {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone}};
};

}  // namespace mb4

#endif  // MB4_FRAME_HPP_
