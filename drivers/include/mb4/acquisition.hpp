// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 4: getting data. This version: single frames through INSTR.

#ifndef MB4_ACQUISITION_HPP_
#define MB4_ACQUISITION_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/config.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {
namespace detail {

// Reads one status snapshot. kTransport, kNotDetected.
template <typename Bus>
Result<Status> read_status(Opcodes<Bus>& opcodes) {
  std::array<std::uint8_t, Status::kBytes> bytes{};
  if (const Result<void> read = opcodes.read_status(bytes); !read) {
    return read.info();
  }
  const Status status(bytes);
  if (!status.plausible()) {
    return Error::kNotDetected;
  }
  return status;
}

// Writes 0xF4 alone. All other bits of it become 0: AGS off, banks not held, SWBANK at rest.
template <typename Bus>
Result<void> write_instruction(Opcodes<Bus>& opcodes, std::uint8_t instruction) {
  return opcodes.write_instruction(Span<const std::uint8_t>(&instruction, 1));
}

// Clears SVALIDx of one slave in the bank that the host reads: 0 clears, 1 has no effect (page 35,
// "reset by writing to the SVALIDx register"), so no other slave's flag is touched.
template <typename Bus>
Result<void> clear_valid(Opcodes<Bus>& opcodes, std::uint8_t slave) {
  const std::uint8_t byte = static_cast<std::uint8_t>(~unsigned{regs::kFamilySvalid.mask(slave)});
  return opcodes.write_registers(regs::kFamilySvalid.address(slave),
                                 Span<const std::uint8_t>(&byte, 1));
}

// A polling loop's end: by time, and by count should the time source stand still.
template <typename Clock>
class Deadline {
 public:
  constexpr Deadline(Clock& clock, std::uint32_t timeout_us)
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

}  // namespace detail

// Requests one frame by INSTR = 010 (CDM = 0) and fetches the result of one slave. Used through
// Device::read_frame(), which documents the errors.
//
// Why the value cannot be an old one:
//  * No older frame runs when the new one is requested. The chip ignores an equal INSTR while a
//    frame runs, and would deliver that frame. A good read has seen the end of its frame,
//    configure() sends BREAK, and after a failed read BREAK comes first: its frame may still run,
//    for instance if its first status poll has failed.
//  * A slave that BREAK has cut off gets the time of its timeout before the request. Until then it
//    would take the new frame's clock for the rest of the old frame, and waiting for SL = 1
//    (FrameStart::kWaitForLine) is not enough, as SL may be 1 for a data bit.
//  * SVALIDx is cleared before every frame: by the previous good read, by configure(), or after
//    that BREAK.
//  * The frame's end is recognised by EOT = 1 together with INSTR = 0, and only SVALIDx = 1 makes
//    the data readable. With two banks the chip switches at the end of the frame (page 26), so that
//    data and SVALIDx of this frame are what the host sees, and no later frame can replace them
//    before the next request.
template <typename Bus, typename Clock>
class SingleShot {
  static_assert(kIsClock<Clock>,
                "mb4: the Clock type needs 'std::uint32_t now_us()'; see mb4/bus.hpp");

 public:
  // `opcodes` is copied; `clock` must outlive this object.
  constexpr SingleShot(Opcodes<Bus> opcodes, Clock& clock) : opcodes_(opcodes), clock_(&clock) {}

  // To be called when BREAK has been sent and then all SVALID flags have been cleared.
  constexpr void on_flags_cleared() { recover_first_ = false; }

  // `config` is in the chip; `slave` 1..8 is enabled in it.
  Result<Reading> read(const Config& config, std::uint8_t slave) {
    if (recover_first_) {
      if (const Result<void> recovered = recover(slave); !recovered) {
        return recovered.info();
      }
    }
    recover_first_ = true;
    constexpr std::uint8_t kOneFrame =
        regs::INSTR::encode<static_cast<std::uint8_t>(regs::Instr::kCdm0)>();
    if (const Result<void> start = detail::write_instruction(opcodes_, kOneFrame); !start) {
      return start.info();
    }
    const Result<Status> status = wait_for_end(frame_timeout_us(config));
    if (!status) {
      return status.info();
    }
    if (const ErrorInfo bad = judge(config, slave, *status); bad.code != Error::kNone) {
      return bad.code == Error::kLineError ? stop_frame(bad.code) : bad;
    }
    std::array<std::uint8_t, 8> bytes{};
    const Span<std::uint8_t> wanted = Span<std::uint8_t>(bytes).first(reading_bytes(config, slave));
    if (const Result<void> data = read_data(slave, wanted); !data) {
      return data.info();
    }
    if (const Result<void> clear = detail::clear_valid(opcodes_, slave); !clear) {
      return clear.info();
    }
    const Result<Reading> reading = decode_reading(config, slave, wanted);
    // kCorrupted casts doubt on the status that came over the same SPI.
    recover_first_ = !reading;
    return reading;
  }

 private:
  // How long SL may stay low after BREAK while the slaves' timeout runs (12.5 to 40 us are common).
  static constexpr std::uint32_t kLineRecoveryUs = 100;

  // After a failed read: ends its frame if it still runs, lets the slaves' timeout pass, and clears
  // SVALIDx, which that frame may have set. BREAK also sets AGS = 0, which is not used here.
  Result<void> recover(std::uint8_t slave) {
    if (const Result<void> stopped = write_break(); !stopped) {
      return stopped;
    }
    detail::pause(*clock_, kLineRecoveryUs);
    return detail::clear_valid(opcodes_, slave);
  }

  // Polls until the frame has ended or was refused; stops it when it does not end.
  Result<Status> wait_for_end(std::uint32_t timeout_us) {
    detail::Deadline<Clock> deadline(*clock_, timeout_us);
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      const Result<Status> status = detail::read_status(opcodes_);
      if (!status) {
        return status;
      }
      // EOT alone is also 1 before the chip has taken the instruction. A refused frame resets
      // INSTR, too; nAGSERR proves nothing yet, see judge().
      if (status->idle() && status->instruction_done()) {
        return status;
      }
    }
    const ErrorInfo stopped = stop_frame(Error::kTimeout);
    return stopped.code == Error::kTimeout ? diagnose_line() : stopped;
  }

  // BREAK: the chip is idle, MA is 1 and the error flags are 1 again.
  Result<void> write_break() {
    return detail::write_instruction(opcodes_, regs::BREAK::encode<1>());
  }

  // Sends BREAK. Returns `cause`, or the failure of the transfer, which is then the more urgent
  // news.
  ErrorInfo stop_frame(Error cause) {
    const Result<void> stopped = write_break();
    return stopped ? ErrorInfo(cause) : stopped.info();
  }

  // After a frame without end: does SL of channel 1 return to 1, as it does once the slaves'
  // timeout is over? Then no slave has answered (kTimeout), otherwise the line is stuck low
  // (kLineError).
  ErrorInfo diagnose_line() {
    detail::Deadline<Clock> deadline(*clock_, kLineRecoveryUs);
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      std::array<std::uint8_t, regs::SL1::kAddress - regs::kAddrStatus0 + 1> bytes{};
      if (const Result<void> read = opcodes_.read_status(bytes); !read) {
        return read.info();
      }
      if (regs::SL1::get(bytes[bytes.size() - 1]) == 1) {
        return Error::kTimeout;
      }
    }
    return Error::kLineError;
  }

  // What the status after a frame (EOT = 1, INSTR = 0) says about one slave.
  //
  // SVALIDx comes first: it was cleared before the request, so 1 proves that the requested frame
  // ran, whatever nAGSERR says. A chip may set nAGSERR = 0 at each write of 0xF4 (page 34 can be
  // read so; AGSERR_ON_INSTR_WRITE = 1). nAGSERR only tells why there is no data, and only after
  // nSCDERR, which is 0 when a frame ran. On a chip as above kNoData shows as kLineError. With
  // several slaves nSCDERR = 0 may be left from an earlier good read that another slave has
  // spoilt; a frame refused then shows as kCrc.
  static ErrorInfo judge(const Config& config, std::uint8_t slave, const Status& status) {
    if (!status.valid(slave)) {
      if (status.scd_error()) {
        return Error::kCrc;
      }
      return status.start_error() ? Error::kLineError : Error::kNoData;
    }
    if (!status.scd_error()) {
      return {};
    }
    // Some slave's CRC was wrong; SVALIDx identifies it (page 34). If another slave's flag is 0 it
    // is that one, and this slave's data is good. If all are 1 the chip contradicts itself and
    // nothing of it is believed.
    for (std::size_t number = 1; number <= kSlaves; ++number) {
      if (config.slaves[number - 1].enabled && !status.valid(static_cast<std::uint8_t>(number))) {
        return {};
      }
    }
    return Error::kCrc;
  }

  // Slave 1 by opcode 0x09: one byte shorter than 0x03 and without its stretched clock (I204).
  Result<void> read_data(std::uint8_t slave, Span<std::uint8_t> bytes) {
    if (slave == 1) {
      return opcodes_.read_registers0(bytes);
    }
    return opcodes_.read_registers(regs::scdata_address(slave), bytes);
  }

  Opcodes<Bus> opcodes_;
  Clock* clock_;
  // A frame may still run and SVALID is unknown: recover() before the next request. Set by every
  // error after the first transfer, whatever it is.
  bool recover_first_ = true;
};

}  // namespace mb4

#endif  // MB4_ACQUISITION_HPP_
