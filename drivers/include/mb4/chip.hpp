// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What all calls on one chip share: bus, clock, configuration, and what the driver knows about the
// chip's state. Not for direct use; see Device.

#ifndef MB4_CHIP_HPP_
#define MB4_CHIP_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/config.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// A polling loop's end: by time, and by count should the time source stand still.
template <typename Clock>
class Deadline {
 public:
  [[gnu::noinline]] constexpr Deadline(Clock& clock, std::uint32_t timeout_us)
      : clock_(clock),
        start_us_(clock.now_us()),
        timeout_us_(timeout_us),
        // A poll is at least 6 bytes of 8 SCLK periods of >= 20 ns (I203, I204), 0.96 us. With a
        // working clock time runs out first.
        polls_left_(timeout_us + timeout_us / 16 + 2) {}

  // Asked before each poll, so that the last poll is made when the time is already over: a task
  // that was suspended does not report a timeout without having looked.
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

// Lets time pass without a transfer. A time source that stands still ends it, too: even at 1 ns a
// call the count is not reached before the time is over.
template <typename Clock>
void pause(Clock& clock, std::uint32_t time_us) {
  const std::uint32_t start_us = clock.now_us();
  std::uint32_t calls_left = time_us * 1000;
  while (clock.now_us() - start_us < time_us && --calls_left != 0) {
  }
}

// How long a slave that BREAK has cut off may need until it is ready again: its timeout, 12.5 to
// 40 us are common.
inline constexpr std::uint32_t kLineRecoveryUs = 100;

// The control communication in progress, and what is left of the last one.
struct ControlState {
  enum class Kind : std::uint8_t { kNone, kRead, kWrite, kCommand };

  Kind kind = Kind::kNone;
  std::uint8_t readable = 0;    // registers that a finished read has left in RDATA
  std::uint8_t count = 0;       // registers of this access, 1..64
  bool biss_b = false;          // one instruction, and no frames, to the end
  bool first_frame = false;     // REGEND may still be the one of the last access; BiSS B: not ended
  std::uint32_t start_us = 0;   // of this frame, or with automatic frames of the access
  std::uint32_t access_us = 0;  // start of the access
  std::uint32_t timeout_us = 0;
  std::uint32_t frames = 0;      // begun so far, without automatic frames
  std::uint32_t polls_left = 0;  // should the time source stand still
};

template <typename Bus, typename Clock>
struct Chip {
  static_assert(kIsClock<Clock>,
                "mb4: the Clock type needs 'std::uint32_t now_us()'; see mb4/bus.hpp");

  constexpr Chip(Bus& bus, Clock& the_clock) : opcodes(bus), clock(&the_clock) {}

  Opcodes<Bus> opcodes;
  Clock* clock;
  Config config{};
  std::uint8_t sensors = 0;    // of `config`: slaves that deliver data, ...
  std::uint8_t actuators = 0;  // ... and that take it; bit 0 is slave 1
  bool configured = false;
  // AGS = 1 was written, and nothing has stopped it.
  bool automatic = false;
  // A frame may still run and SVALID is unknown: BREAK and clearing come before the next request.
  // Set by every error after the first transfer, whatever it is.
  bool recover_first = true;
  // Automatic frames are wanted, but need BREAK and a new start before (Table 69).
  bool restart = false;
  ControlState control{};

  // One status snapshot. kTransport, kNotDetected.
  Result<void> look(Status& status) {
    std::array<std::uint8_t, Status::kBytes> bytes{};
    const Result<void> read = opcodes.read_status(bytes);
    status = Status(bytes);
    return read && !status.plausible() ? Error::kNotDetected : read;
  }

  // Writes 0xF4 alone. All other bits of it become 0, SWBANK too, which this driver never sets.
  Result<void> write_instruction(std::uint8_t instruction) {
    return opcodes.write_instruction(Span<const std::uint8_t>(&instruction, 1));
  }

  // BREAK: the chip is idle, AGS is off, MA is 1 and the error flags are 1 again.
  Result<void> write_break() {
    automatic = false;
    control.kind = ControlState::Kind::kNone;
    return write_instruction(regs::BREAK::encode<1>());
  }

  // Clears SVALIDx of the slaves in `mask` (bit 0 is slave 1) in the bank that the host reads: 0
  // clears, 1 has no effect (page 35, "reset by writing to the SVALIDx register"), so no other
  // slave's flag is touched. One transfer, or none without a slave.
  Result<void> clear_valid(std::uint8_t mask) {
    const unsigned keep = ~unsigned{Status::valid_registers(mask)};
    const std::array<std::uint8_t, 2> both{static_cast<std::uint8_t>(keep),
                                           static_cast<std::uint8_t>(keep >> 8U)};
    return mask == 0 ? Result<void>() : opcodes.write_registers(regs::kAddrSvalidLo, both);
  }

  [[nodiscard]] bool checks_all() const { return config.spi_check == SpiCheck::kFull; }

  // The same, and with SpiCheck::kFull one status more, or two, to see that the flags are 0. The
  // chip takes some system clocks to clear them. kCorrupted: they are not.
  Result<void> clear_valid_checked(std::uint8_t mask) {
    if (const Result<void> cleared = clear_valid(mask); !cleared || !checks_all()) {
      return cleared;
    }
    for (unsigned looks = 2; looks > 0; --looks) {
      Status status;
      const Result<void> read = look(status);
      if (!read || (status.valid_mask() & mask) == 0) {
        return read;
      }
    }
    return Error::kCorrupted;
  }

  // Ends what runs, lets the slaves' timeout pass, and clears the flags of frames that ran. With
  // SpiCheck::kFull 0xF5 is written as well: it lies next to 0xF4, and what has failed may be a
  // read of the status that came to the chip as a write.
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
    return clear_valid(sensors);
  }

  // SpiCheck::kFull: is `want` what 0xF4 holds? AGS, which an error may have ended, is not looked
  // at. One transfer, or none. kCorrupted: it is not; kTransport, kNotDetected.
  Result<void> confirm_instruction(std::uint8_t want) {
    if (!checks_all()) {
      return {};
    }
    Status status;
    const Result<void> read = look(status);
    constexpr std::uint8_t kAgs = regs::AGS::encode<1>();
    return read && (status.instruction() | kAgs) != (want | kAgs) ? Error::kCorrupted : read;
  }

  // BREAK behind `cause`: returns it, or the failure of the transfer, which is then the more urgent
  // news.
  Result<void> stop_frame(Error cause) {
    const Result<void> stopped = write_break();
    return stopped ? Result<void>(cause) : stopped;
  }

  // BREAK, and what has kept a frame from ending: kTimeout or kLineError.
  Result<void> stop_and_diagnose() {
    const Result<void> stopped = write_break();
    const Result<void> line = stopped ? diagnose_line() : stopped;
    return line ? Error::kTimeout : line;
  }

  // After BREAK has ended a frame that did not end by itself: does SL of all channels in use return
  // to 1, as it does once the slaves' timeout is over? Then no slave has answered, otherwise a line
  // is stuck low (kLineError).
  Result<void> diagnose_line() {
    Deadline<Clock> deadline(*clock, kLineRecoveryUs);
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      std::array<std::uint8_t, regs::SL1::kAddress - regs::kAddrStatus0 + 1> bytes{};
      const Result<void> read = opcodes.read_status(bytes);
      if (!read || lines_are_high(bytes[bytes.size() - 1])) {
        return read;
      }
    }
    return Error::kLineError;
  }

  // Slaves of BiSS B may be in register mode.
  [[nodiscard]] std::uint32_t recovery_us() const {
    return any_channel_is(config, Protocol::kBissB) ? kLineRecoveryUs + config.register_timeout_us
                                                    : kLineRecoveryUs;
  }

 private:
  [[nodiscard]] bool lines_are_high(std::uint8_t line_status) const {
    return (config.channels[0].protocol == Protocol::kUnused || regs::SL1::get(line_status) == 1) &&
           (config.channels[1].protocol == Protocol::kUnused || regs::SL2::get(line_status) == 1);
  }
};

}  // namespace mb4::detail

#endif  // MB4_CHIP_HPP_
