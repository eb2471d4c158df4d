// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Single frames through INSTR, AGS = 0.

#ifndef MB4_DETAIL_SINGLE_SHOT_HPP_
#define MB4_DETAIL_SINGLE_SHOT_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/cyclic.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/error.hpp"
#include "mb4/frame.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// Requests one frame by INSTR = 010 (CDM = 0) and fetches the result of one slave or of all. Used
// through Device::read_frame() and read_all(), which document the errors.
//
// Why a value is never old:
//  * No older frame runs when the driver requests the new one. Otherwise the chip would ignore the
//    equal INSTR and deliver the older frame. A good read has seen the end of its frame, and
//    configure() sends BREAK. After a failed read the frame may still run, for example if the first
//    status poll has failed; so the next read sends BREAK first.
//  * After BREAK the driver waits for the slave's timeout before the request. Before its timeout
//    ends, the slave would take the new frame's clock for the rest of the old frame. Waiting for
//    SL = 1 (FrameStart::kWaitForLine) is not enough, because a data bit may also make SL = 1.
//  * SVALID of every enabled slave is cleared before every frame: by the previous good read, by
//    configure(), or after that BREAK.
//  * The frame has ended when EOT = 1 and INSTR = 0, and the driver uses data only with
//    SVALIDx = 1. With two banks the chip switches them at the end of the frame (page 26). So the
//    host sees data and SVALIDx of this frame, and no later frame replaces them before the next
//    request.
template <typename Bus, typename Clock>
class SingleShot {
 public:
  explicit constexpr SingleShot(Chip<Bus, Clock>& chip) : chip_(chip) {}

  // The chip is configured and `slave` 1..8 delivers data.
  Result<Reading> read(std::uint8_t slave) {
    CyclicRead memory;
    const mb4_word* word = chip_.word_of(slave);
    if (const Result<void> done = run(word, 1, memory); !done) {
      return done.failure();
    }
    const Result<Reading> reading = to_result(*word, memory.slot_);
    // After kCorrupted the status, which came over the same SPI, is doubtful too.
    chip_.recover_first = !reading;
    return reading;
  }

  // The chip is configured.
  Result<void> read_all(Frame& frame) {
    frame.clear();
    FrameRead memory;
    const Result<void> done = run(chip_.words.data(), chip_.count, memory);
    if (done) {
      memory.fill(frame);
      chip_.recover_first = !frame.good(chip_.sensors);
    }
    return done;
  }

 private:
  // Runs one frame and fetches the data of those slaves of `words` that are good.
  //
  // SVALIDx was cleared before the request, so SVALIDx = 1 proves that the requested frame ran,
  // with any value of nAGSERR. A chip may set nAGSERR = 0 at each write of 0xF4 (page 34 can be
  // read so; AGSERR_ON_INSTR_WRITE = 1). The driver looks at nAGSERR only if there is no data and
  // nSCDERR = 1; nSCDERR = 0 shows that a frame ran. On such a chip kNoData appears as kLineError.
  Result<void> run(const mb4_word* words, std::uint8_t count, ReadSteps& steps) {
    Status status;
    if (const Result<void> ended = run_frame(status); !ended) {
      return ended;
    }
    mb4_cyclic& read = steps.read_;
    read.words = words;
    read.count = count;
    read.wide = true;
    read.spi_check = static_cast<std::uint8_t>(chip_.config.spi_check);
    mb4_cyclic_all(&read, MB4_WITH_ALL);
    for (std::size_t i = 0; i < Status::kBytes; ++i) {
      read.status[i] = status.bytes()[i];
    }
    // SVALID was cleared before the request, so every slave without it was bad in this frame.
    for (std::uint8_t i = 0; i < count; ++i) {
      read.slots[i].code = status.scd_error() ? MB4_CRC : MB4_NO_DATA;
    }
    const unsigned valid = status.valid_flags() & unsigned{chip_.sensor_flags};
    // nSCDERR = 0: the CRC of a slave was wrong, and SVALIDx = 0 identifies the slave (page 34). If
    // every SVALIDx is 1, the chip contradicts itself and the driver uses no data.
    const bool contradicts = status.scd_error() && valid == chip_.sensor_flags;
    read.flags = contradicts ? 0 : mb4_cyclic_valid(&read);
    if (read.flags == 0) {
      // Without a sensor only nAGSERR can show a refused frame. With kWaitForLine the chip refuses
      // no frame.
      const bool refusable = count != 0 || chip_.config.frame_start != FrameStart::kWaitForLine;
      return refusable && status.start_error() && !status.scd_error()
                 ? chip_.stop_frame(Error::kLineError)
                 : Result<void>();
    }
    Result<void> done = fetch(steps);
    if (done && chip_.checks_all()) {
      Status after;
      done = chip_.look(after);
      if (done && (!after.idle() || (read.flags & ~unsigned{after.valid_flags()}) != 0)) {
        return Error::kCorrupted;
      }
    }
    return done ? chip_.clear_valid_checked(chip_.sensor_flags) : done;
  }

  // Reads the data of the slaves read.flags; twice what only a second reading proves.
  Result<void> fetch(ReadSteps& steps) {
    mb4_cyclic& read = steps.read_;
    mb4_plan& plan = steps.plan_;
    mb4_cyclic_add_data(&read, &plan, read.flags, MB4_WITH_ALL);
    bool done = steps.run(chip_.opcodes.bus());
    const std::uint16_t second =
        done ? mb4_cyclic_take(&read, &plan, 0, read.flags, MB4_WITH_ALL) : std::uint16_t{0};
    if (second != 0) {
      plan.frames = 0;
      mb4_cyclic_add_data(&read, &plan, second, MB4_WITH_ALL);
      done = steps.run(chip_.opcodes.bus());
      mb4_cyclic_compare(&read, &plan, 0, second, MB4_WITH_ALL);
    }
    return done ? Error::kNone : Error::kTransport;
  }

  // Requests a frame and polls until it has ended or was refused. Stops the frame if it does not
  // end in time.
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
    Deadline<Clock> deadline(*chip_.clock, chip_.frame_us);
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      if (const Result<void> look = chip_.look(status); !look) {
        return look;
      }
      // EOT = 1 alone does not show the end: EOT is also 1 before the chip has taken the
      // instruction. A refused frame resets INSTR too; run() finds it.
      if (status.idle() && status.instruction_done()) {
        // INSTR = 0, but another bit is 1: the chip received another byte than the one sent.
        return chip_.checks_all() && status.instruction() != 0 ? Error::kCorrupted : Error::kNone;
      }
    }
    return chip_.stop_and_diagnose();
  }

  Chip<Bus, Clock>& chip_;
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_SINGLE_SHOT_HPP_
