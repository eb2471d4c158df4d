// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// One operation in steps: start or restart, INIT, the comparison of the configuration, an access to
// registers of a slave or a command. The driver plans SPI frames, the caller makes them, and the
// driver takes what came back.

#ifndef MB4_OPERATION_HPP_
#define MB4_OPERATION_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/detail/time_limit.hpp"
#include "mb4/error.hpp"
#include "mb4/line_delay.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4/steps.hpp"

namespace mb4 {

class ReadSteps;
namespace detail {
struct ChipState;
struct Procedures;
}  // namespace detail

// Memory for an operation, in the caller's hands; 236 bytes on a Cortex-M. A plan call begins the
// operation and Device::finish() continues it:
//
//   mb4::Operation operation;
//   if (device.automatic().plan_restart(operation)) {
//     do {
//       ...  // wait operation.pause_us(), then tx(i) -> rx(i) for i < operation.frames()
//     } while (!device.finish(operation, transferred, now_us));
//   }
//   operation.result();
//
// The driver makes no transfer and does not ask for the time meanwhile. The frames of a step have
// at most kMaxFrameBytes. Between two steps the caller may do other work of any length, which
// includes whole reads of positions (Automatic::plan_slave(), plan(), poll(), poll_slave()) if
// automatic frames run. They are kBusy while an actuator holds the bank, between the steps of its
// operation with SpiCheck::kFull; while an operation compares the configuration, because something
// has read back differently; and between the request of an access and its
// instruction. A plan_verify() of another object is allowed then too. No other call on the Device
// may come between the plan call and the end.
//
// Wrong use has an answer, and no frame is made for it:
//  * finish() of an object without an operation (never begun, or ended: a late interrupt) returns
//    true and changes nothing.
//  * A plan call with an object whose operation has not ended is kBusy, and the operation goes on.
//  * finish() by another Device than the one that has begun it: the operation ends with kWrongMode.
//    So does an access after abort(), break_transmission(), configure() or reset(), and
//    plan_verify() after reset() or a failed configure().
//
// The object may be used again and again. To give an operation up, call finish() with transferred =
// false. While it returns false, a BREAK that stops a control communication remains to be made, or
// the comparison: make the frames, then call finish() with what became of them, until it returns
// true. If the comparison is given up too, the Device counts as not configured.
class Operation : public Steps {
 public:
  constexpr Operation() = default;

  static constexpr std::size_t kMaxFrameBytes = 20;

  // After finish() has returned true: what the blocking call of the same name returns. kBusy while
  // the operation is under way; kWrongMode before the first one.
  [[nodiscard]] Result<void> result() const {
    return chip_ == nullptr ? Error::kWrongMode : result_;
  }
  // After a successful Device::plan_initialize().
  [[nodiscard]] LineDelay line_delay() const { return delay_; }

 private:
  friend struct detail::Procedures;

  // Most bytes of an access in one frame: plan and finish() of one step stay short.
  static constexpr std::uint8_t kPart = 8;
  static constexpr std::size_t kWords = 12;

  enum class Purpose : std::uint8_t { kCompare, kConfigure, kReset };

  // Takes what came back and adds the next frames. Without frames the operation has ended.
  using Step = Result<void> (*)(detail::ChipState&, Operation&, std::uint32_t now_us);

  // Words: short code on small cores. All bytes are 0 at first: a static object is in .bss.
  Step step_ = nullptr;                      // nullptr: no operation is under way
  const detail::ChipState* chip_ = nullptr;  // that of the operation, also of the last one
  std::uint32_t stage_ = 0;
  std::uint32_t at_ = 0;          // bytes of an access that are done
  std::size_t count_ = 0;         // of them all; of the word of an actuator
  std::uint32_t made_ = 0;        // frames of the step before
  bool good_ = false;             // they were made
  std::uint8_t failures_ = 0;     // of the same stage, one after the other
  std::uint8_t instruction_ = 0;  // that stops
  std::uint8_t address_ = 0;      // the part of a configuration; the word of an actuator
  std::uint8_t index_ = 0;        // INIT: the channel, or the word, whose turn it is
  std::uint8_t words_ = 0;        // an actuator: written into other banks so far
  Purpose purpose_{};             // of a configuration
  bool request_away_ = false;     // the request of an access may have been in the chip
  bool restarts_ = false;         // an access: automatic frames start before it
  bool init_unseen_ = false;      // INIT may be lost
  bool both_banks_ = false;       // an actuator: the word is for both
  Result<void> result_{};
  Result<void> cause_{};                // is the result when the frames planned now are made
  const std::uint8_t* data_ = nullptr;  // to write, the caller's
  std::uint8_t* out_ = nullptr;         // to read into, the caller's
  detail::TimeLimit limit_{};
  Status status_{};
  LineDelay delay_{};
  std::array<std::uint8_t, 8> request_{};  // 0xE2..0xE5 of an access; the word of an actuator
  ReadSteps* read_ = nullptr;              // the caller's, of a single frame
  std::array<std::uint32_t, kWords> tx_{};
  std::array<std::uint32_t, kWords> rx_{};
};

}  // namespace mb4

#endif  // MB4_OPERATION_HPP_
