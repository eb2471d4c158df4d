// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 4: single frames through INSTR, AGS = 0.

#ifndef MB4_ACQUISITION_HPP_
#define MB4_ACQUISITION_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/frame.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Requests one frame by INSTR = 010 (CDM = 0) and fetches the result of one slave or of all. Used
// through Device::read_frame() and read_all(), which document the errors.
//
// Why a value cannot be an old one:
//  * No older frame runs when the new one is requested. The chip ignores an equal INSTR while a
//    frame runs, and would deliver that frame. A good read has seen the end of its frame,
//    configure() sends BREAK, and after a failed read BREAK comes first: its frame may still run,
//    for instance if its first status poll has failed.
//  * A slave that BREAK has cut off gets the time of its timeout before the request. Until then it
//    would take the new frame's clock for the rest of the old frame, and waiting for SL = 1
//    (FrameStart::kWaitForLine) is not enough, as SL may be 1 for a data bit.
//  * SVALID of every enabled slave is cleared before every frame: by the previous good read, by
//    configure(), or after that BREAK.
//  * The frame's end is recognised by EOT = 1 together with INSTR = 0, and only SVALIDx = 1 makes
//    the data readable. With two banks the chip switches at the end of the frame (page 26), so that
//    data and SVALIDx of this frame are what the host sees, and no later frame can replace them
//    before the next request.
template <typename Bus, typename Clock>
class SingleShot {
 public:
  explicit constexpr SingleShot(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

  // The chip is configured and `slave` 1..8 is enabled.
  Result<Reading> read(std::uint8_t slave) {
    const Result<Status> status = run_frame();
    if (!status) {
      return status.info();
    }
    if (const Error bad = detail::judge(chip_.config, slave, *status); bad != Error::kNone) {
      return bad == Error::kLineError ? chip_.stop_frame(bad) : ErrorInfo(bad);
    }
    detail::FetchedData data;
    if (const Result<void> fetched = fetch(static_cast<std::uint8_t>(1U << (slave - 1U)), data);
        !fetched) {
      return fetched.info();
    }
    const Result<Reading> reading = detail::decode(chip_.config, slave, data);
    // kCorrupted casts doubt on the status that came over the same SPI.
    chip_.recover_first = !reading;
    return reading;
  }

  // The chip is configured.
  Result<void> read_all(Frame& frame) {
    frame = Frame();
    const Result<Status> status = run_frame();
    if (!status) {
      return status.info();
    }
    frame.status = *status;
    const std::uint8_t enabled = enabled_slaves(chip_.config);
    unsigned good = 0;
    for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
      if ((enabled >> (slave - 1U) & 1U) != 0) {
        const Error bad = detail::judge(chip_.config, slave, *status);
        if (bad == Error::kNone) {
          good |= 1U << (slave - 1U);
        } else {
          // kLineError is about the whole frame; it cannot be if another slave's data is new.
          frame.set(slave, bad == Error::kLineError ? Error::kNoData : bad);
        }
      }
    }
    if (enabled != 0 && good == 0 && status->start_error() && !status->scd_error()) {
      return chip_.stop_frame(Error::kLineError);
    }
    detail::FetchedData data;
    if (const Result<void> fetched = fetch(static_cast<std::uint8_t>(good), data); !fetched) {
      return fetched;
    }
    for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
      if ((good >> (slave - 1U) & 1U) != 0) {
        frame.set(slave, detail::decode(chip_.config, slave, data));
      }
    }
    chip_.recover_first = !frame.good(enabled);
    return {};
  }

 private:
  // From the request to the status after the end.
  Result<Status> run_frame() {
    if (chip_.recover_first) {
      if (const Result<void> recovered = chip_.recover(); !recovered) {
        return recovered.info();
      }
    }
    chip_.recover_first = true;
    constexpr std::uint8_t kOneFrame =
        regs::INSTR::encode<static_cast<std::uint8_t>(regs::Instr::kCdm0)>();
    if (const Result<void> start = chip_.write_instruction(kOneFrame); !start) {
      return start.info();
    }
    return wait_for_end(frame_timeout_us(chip_.config));
  }

  // Polls until the frame has ended or was refused; stops it when it does not end.
  Result<Status> wait_for_end(std::uint32_t timeout_us) {
    detail::Deadline<Clock> deadline(*chip_.clock, timeout_us);
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      const Result<Status> status = chip_.read_status();
      if (!status) {
        return status;
      }
      // EOT alone is also 1 before the chip has taken the instruction. A refused frame resets
      // INSTR, too; nAGSERR proves nothing yet, see judge().
      if (status->idle() && status->instruction_done()) {
        // Another instruction than the one that was sent may do something else meanwhile.
        return chip_.checks_all() && status->instruction() != 0 ? Error::kCorrupted : status;
      }
    }
    const ErrorInfo stopped = chip_.stop_frame(Error::kTimeout);
    return stopped.code == Error::kTimeout ? chip_.diagnose_line() : stopped;
  }

  // The data of the slaves in `mask`; then SVALID of all is cleared.
  Result<void> fetch(std::uint8_t mask, detail::FetchedData& data) {
    if (const Result<void> read = detail::fetch_data(chip_.opcodes, chip_.config, mask, data);
        !read) {
      return read;
    }
    if (chip_.checks_all()) {
      const Result<Status> after = chip_.read_status();
      if (!after) {
        return after.info();
      }
      if (!after->idle() || (detail::valid_slaves(chip_.config, *after) & mask) != mask) {
        return Error::kCorrupted;
      }
    }
    return chip_.clear_valid_checked(enabled_slaves(chip_.config));
  }

  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_ACQUISITION_HPP_
