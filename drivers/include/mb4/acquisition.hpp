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

  // The chip is configured and `slave` 1..8 delivers data.
  Result<Reading> read(std::uint8_t slave) {
    detail::Outcome outcome;
    detail::FetchedData data;
    if (const Result<void> done = run(static_cast<std::uint8_t>(1U << (slave - 1U)), outcome, data);
        !done) {
      return done.failure();
    }
    if (outcome.good == 0) {
      return missing(outcome);
    }
    const Result<Reading> reading = detail::decode(
        chip_.config, slave, &data.image[regs::scdata_address(slave)], is_in(data.stable, slave));
    // kCorrupted casts doubt on the status that came over the same SPI.
    chip_.recover_first = !reading;
    return reading;
  }

  // The chip is configured.
  Result<void> read_all(Frame& frame) {
    frame.clear();
    detail::Outcome outcome;
    detail::FetchedData data;
    const Result<void> done = run(chip_.sensors, outcome, data);
    if (done) {
      detail::decode_all(chip_.config, chip_.sensors, outcome, data, missing(outcome), frame);
      chip_.recover_first = !frame.good(chip_.sensors);
    }
    return done;
  }

 private:
  static Error missing(const detail::Outcome& outcome) {
    return outcome.status.scd_error() ? Error::kCrc : Error::kNoData;
  }

  // One frame, and the data of those slaves of `mask` that are good.
  //
  // SVALIDx was cleared before the request, so 1 proves that the requested frame ran, whatever
  // nAGSERR says. A chip may set nAGSERR = 0 at each write of 0xF4 (page 34 can be read so;
  // AGSERR_ON_INSTR_WRITE = 1). nAGSERR only tells why there is no data, and only after nSCDERR,
  // which is 0 when a frame ran. On a chip as above kNoData shows as kLineError.
  Result<void> run(std::uint8_t mask, detail::Outcome& out, detail::FetchedData& data) {
    Status& status = out.status;
    if (const Result<void> ended = run_frame(status); !ended) {
      return ended;
    }
    const unsigned valid = status.valid_mask() & unsigned{chip_.sensors};
    // With nSCDERR = 0 some slave's CRC was wrong; SVALIDx identifies it (page 34). If all are 1
    // the chip contradicts itself and nothing of it is believed.
    if (!status.scd_error() || valid != chip_.sensors) {
      out.good = static_cast<std::uint8_t>(valid & mask);
    }
    if (out.good == 0) {
      // Without a sensor nAGSERR is all there is; such a frame is not refused if it may wait.
      const bool refusable = mask != 0 || chip_.config.frame_start != FrameStart::kWaitForLine;
      return refusable && status.start_error() && !status.scd_error()
                 ? chip_.stop_frame(Error::kLineError)
                 : Result<void>();
    }
    Result<void> done = detail::fetch_data(chip_.opcodes, chip_.config, out.good, data);
    if (done && chip_.checks_all()) {
      Status after;
      done = chip_.look(after);
      if (done && (!after.idle() || (out.good & ~unsigned{after.valid_mask()}) != 0)) {
        return Error::kCorrupted;
      }
    }
    return done ? chip_.clear_valid_checked(chip_.sensors) : done;
  }

  // From the request to the status after the end: until the frame has ended or was refused; stops
  // it when it does not end.
  Result<void> run_frame(Status& status) {
    if (chip_.recover_first) {
      if (const Result<void> recovered = chip_.recover(); !recovered) {
        return recovered;
      }
    }
    chip_.recover_first = true;
    constexpr std::uint8_t kOneFrame =
        regs::INSTR::encode<static_cast<std::uint8_t>(regs::Instr::kCdm0)>();
    if (const Result<void> start = chip_.write_instruction(kOneFrame); !start) {
      return start;
    }
    detail::Deadline<Clock> deadline(*chip_.clock, frame_timeout_us(chip_.config));
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      if (const Result<void> look = chip_.look(status); !look) {
        return look;
      }
      // EOT alone is also 1 before the chip has taken the instruction. A refused frame resets
      // INSTR, too; nAGSERR proves nothing yet, see run().
      if (status.idle() && status.instruction_done()) {
        // Another instruction than the one that was sent may do something else meanwhile.
        return chip_.checks_all() && status.instruction() != 0 ? Error::kCorrupted : Error::kNone;
      }
    }
    return chip_.stop_and_diagnose();
  }

  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_ACQUISITION_HPP_
