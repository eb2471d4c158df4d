// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The state that all calls on one chip share: bus, clock, configuration, and what the driver knows
// about the chip.

#ifndef MB4_DETAIL_CHIP_HPP_
#define MB4_DETAIL_CHIP_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/config.hpp"
#include "mb4/detail/chip_state.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

using enc::clock_step_us;

// Ends a polling loop after `timeout_us`, never before. It also counts the polls, so that the loop
// ends when the time source stands still.
template <typename Clock>
class Deadline {
 public:
  [[gnu::noinline]] constexpr Deadline(Clock& clock, std::uint32_t timeout_us)
      : clock_(clock),
        start_us_(clock.now_us()),
        timeout_us_(timeout_us + kClockStepUs),
        polls_left_(polls_of(timeout_us)) {}

  // Call it before each poll. The last poll is then made when the time is already over: a task that
  // was suspended reads the status once more before it reports a timeout.
  bool last_poll() {
    --polls_left_;
    return polls_left_ == 0 || clock_.now_us() - start_us_ >= timeout_us_;
  }

 private:
  Clock& clock_;
  std::uint32_t start_us_;
  std::uint32_t timeout_us_;
  std::uint32_t polls_left_;
};

// Waits at least `time_us` (up to 4'294'967) without a transfer. A count of calls ends the wait
// when the time source stands still. Even if a call takes only 1 ns, the count does not end before
// the time.
template <typename Clock>
void pause(Clock& clock, std::uint32_t time_us) {
  const std::uint32_t start_us = clock.now_us();
  std::uint32_t calls_left = time_us * 1000;
  while (clock.now_us() - start_us < time_us + kClockStepUs && --calls_left != 0) {
  }
}

template <typename Bus, typename Clock>
struct Chip : ChipState {
  static_assert(kIsClock<Clock>,
                "mb4: the Clock type needs 'std::uint32_t now_us()'; see mb4/bus.hpp");

  constexpr Chip(Bus& bus, Clock& the_clock) : opcodes(bus), clock(&the_clock) {}

  Opcodes<Bus> opcodes;
  Clock* clock;
  // Reads the status once. kTransport, kNotDetected.
  Result<void> look(Status& status) {
    std::array<std::uint8_t, Status::kBytes> bytes{};
    const Result<void> read = opcodes.read_status(bytes);
    status = Status(bytes);
    return read && !status.plausible() ? Error::kNotDetected : read;
  }

  // Writes 0xF4 and no other register. All bits that `instruction` does not set become 0.
  Result<void> write_instruction(std::uint8_t instruction) {
    return opcodes.write_instruction(Span<const std::uint8_t>(&instruction, 1));
  }

  // Sends BREAK. After it the chip is idle, AGS is off, MA is 1 and the error flags are 1.
  Result<void> write_break() {
    automatic = false;
    control.kind = ControlState::Kind::kNone;
    return write_instruction(regs::BREAK::encode<1>());
  }

  // Clears SVALIDx of the slaves in `mask` (flag_of()) in the bank that the host reads.
  // Writing 0 clears a flag and writing 1 has no effect (page 35, "reset by writing to the SVALIDx
  // register"), so the flags of other slaves do not change. One transfer; none if `mask` is 0.
  Result<void> clear_valid(std::uint16_t mask) {
    const unsigned keep = ~unsigned{mask};
    const std::array<std::uint8_t, 2> both{static_cast<std::uint8_t>(keep),
                                           static_cast<std::uint8_t>(keep >> 8U)};
    return mask == 0 ? Result<void>() : opcodes.write_registers(regs::kAddrSvalidLo, both);
  }

  // As clear_valid(). With SpiCheck::kFull it then reads the status once or twice until the flags
  // are 0: the chip takes some system clocks to clear them. kCorrupted: they are still 1.
  Result<void> clear_valid_checked(std::uint16_t mask) {
    if (const Result<void> cleared = clear_valid(mask); !cleared || !checks_all()) {
      return cleared;
    }
    for (unsigned looks = 2; looks > 0; --looks) {
      Status status;
      const Result<void> read = look(status);
      if (!read || (status.valid_flags() & mask) == 0) {
        return read;
      }
    }
    return Error::kCorrupted;
  }

  // Sends BREAK, waits for the slaves' timeout, and clears the flags of frames that ran. With
  // SpiCheck::kFull it also writes 0xF5, the register after 0xF4: the failed transfer may have been
  // a read of the status that reached the chip as a write.
  Result<void> recover() {
    automatic = false;
    control.kind = ControlState::Kind::kNone;
    const std::array<std::uint8_t, 2> bytes{regs::BREAK::encode<1>(), encode_interface(config)};
    const Span<const std::uint8_t> both(bytes);
    if (const Result<void> stopped = opcodes.write_instruction(both.first(checks_all() ? 2 : 1));
        !stopped) {
      return stopped;
    }
    pause(*clock, recovery_us());
    return clear_valid(sensor_flags);
  }

  // With SpiCheck::kFull: reads 0xF4 and compares it with `want`, except AGS, which an error may
  // have ended. One transfer; otherwise none. kCorrupted: 0xF4 differs. kTransport, kNotDetected.
  Result<void> confirm_instruction(std::uint8_t want) {
    if (!checks_all()) {
      return {};
    }
    Status status;
    const Result<void> read = look(status);
    constexpr std::uint8_t kAgs = regs::AGS::encode<1>();
    return read && (status.instruction() | kAgs) != (want | kAgs) ? Error::kCorrupted : read;
  }

  // Sends BREAK and returns `cause`. If the transfer fails it returns that failure instead.
  Result<void> stop_frame(Error cause) {
    const Result<void> stopped = write_break();
    return stopped ? Result<void>(cause) : stopped;
  }

  // Sends BREAK and returns why the frame did not end: kTimeout or kLineError.
  Result<void> stop_and_diagnose() {
    const Result<void> stopped = write_break();
    const Result<void> line = stopped ? diagnose_line() : stopped;
    return line ? Error::kTimeout : line;
  }

  // For a frame that did not end by itself, after BREAK: waits until SL of all channels in use is
  // 1, which it must be when the slaves' timeout is over. Success: SL is 1, so no slave has
  // answered. kLineError: a line is stuck low.
  Result<void> diagnose_line() {
    Deadline<Clock> deadline(*clock, kLineRecoveryUs);
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      if (const Result<void> line = look_at_lines(); line.error() != Error::kLineError) {
        return line;
      }
    }
    return Error::kLineError;
  }

  // Reads the lines once. kLineError: SL of a channel in use is 0.
  [[gnu::noinline]] Result<void> look_at_lines() {
    std::array<std::uint8_t, regs::SL1::kAddress - regs::kAddrStatus0 + 1> bytes{};
    const Result<void> read = opcodes.read_status(bytes);
    return read && !lines_are_high(bytes[bytes.size() - 1]) ? Error::kLineError : read;
  }

 private:
  [[nodiscard]] bool lines_are_high(std::uint8_t line_status) const {
    return (line_status & watch.lines) == watch.lines;
  }
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CHIP_HPP_
