// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Single frames through INSTR, AGS = 0; and the end of the next automatic frame.

#ifndef MB4_DETAIL_SINGLE_FRAME_HPP_
#define MB4_DETAIL_SINGLE_FRAME_HPP_

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/cyclic.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/error.hpp"

namespace mb4::detail {

// Requests one frame by INSTR = 010 (CDM = 0) and fetches the result of `count` slaves, in the
// memory of `read`. Device::read_frame() and read_all() document the errors. The chip is
// configured.
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
inline void Procedures::plan_frame(ChipState& chip, Operation& op, ReadSteps& read,
                                   const mb4_word* words, std::uint8_t count) {
  begin(chip, op, frame_step);
  op.read_ = &read;
  mb4_plan_memory(&op.plan_, read.plan_.tx, read.plan_.rx);
  mb4_cyclic& cyclic = read.read_;
  cyclic.words = words;
  cyclic.count = count;
  cyclic.wide = true;
  cyclic.spi_check = static_cast<std::uint8_t>(chip.config.spi_check);
  cyclic.built = nullptr;
  cyclic.told = false;
  cyclic.one_frame = true;
  cyclic.blank = 0;
  mb4_cyclic_all(&cyclic, MB4_WITH_ALL);
  read.code_ = MB4_NO_DATA;
  if (chip.recover_first) {
    add_recovery(chip, op);
  } else {
    add_request_frame(op);
  }
  chip.recover_first = true;
}

inline void Procedures::add_request_frame(Operation& op) {
  op.stage_ = kStart;
  add_instruction(op, regs::INSTR::encode<static_cast<std::uint8_t>(regs::Instr::kCdm0)>());
}

// Waits until an automatic frame has ended, good or bad.
inline void Procedures::plan_wait(ChipState& chip, Operation& op) {
  begin(chip, op, wait_step);
  mb4_cyclic_add_status(&op.plan_);
}

// A frame has been requested. Success without more frames: it has ended, or was refused. After its
// time limit BREAK; then stopped_step(). kNotDetected; kCorrupted, with SpiCheck::kFull: the chip
// has got another byte than the one sent.
//
// EOT = 1 alone does not show the end: EOT is also 1 before the chip has taken the instruction. A
// refused frame resets INSTR too.
inline Result<void> Procedures::await_frame(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (op.stage_ == kStart) {
    op.limit_.begin(now_us, chip.frame_us);
    add_next_poll(op, now_us);
    return {};
  }
  const Result<void> seen = take_status(op);
  if (seen && op.status_.idle() && op.status_.instruction_done()) {
    return chip.checks_all() && op.status_.instruction() != 0 ? Error::kCorrupted : Error::kNone;
  }
  if (seen && op.limit_.over) {
    add_stop(chip, op, Error::kTimeout);
  } else if (seen) {
    add_next_poll(op, now_us);
  }
  return seen;
}

inline Result<void> Procedures::frame_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  const Result<void> done = frame_stage(chip, op, now_us);
  if (op.plan_.frames == 0) {
    op.read_->code_ = static_cast<std::uint8_t>(done.error());
    op.read_->read_.told = done.ok();
  }
  return done;
}

inline Result<void> Procedures::frame_stage(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (!op.good_) {
    return Error::kTransport;
  }
  switch (op.stage_) {
    case kRecover:
      return take_frame_recovery(chip, op);
    case kStart:
    case kPoll:
      return take_frame_end_status(chip, op, now_us);
    case kWords:
      return take_words(chip, op);
    case kWordsAgain: {
      mb4_cyclic& read = op.read_->read_;
      mb4_cyclic_compare(&read, &op.plan_, 0, read.fresh, MB4_WITH_ALL);
      return take_words_status(chip, op);
    }
    case kFrameStatus:
      return take_words_status(chip, op);
    case kClear: {
      const Result<void> cleared = clear_step(chip, op, now_us);
      return cleared && op.plan_.frames == 0 ? end_frame(chip, op) : cleared;
    }
    case kBlank:
      // A line that stays low is no reason to drop the good words.
      static_cast<void>(take_lines(chip, op, now_us));
      op.stage_ = kBlank;
      if (op.plan_.frames == 0) {
        static_cast<void>(mb4_cyclic_tell_blank(&op.read_->read_, received(op), MB4_WITH_ALL));
      }
      return {};
    default:
      return stopped_step(chip, op, now_us);
  }
}

inline Result<void> Procedures::take_frame_recovery(ChipState& chip, Operation& op) {
  const Result<void> done = take_recovery(chip, op);
  if (recovery_is_over(done, op)) {
    add_request_frame(op);
  }
  return done;
}

// Has the frame ended?
inline Result<void> Procedures::take_frame_end_status(ChipState& chip, Operation& op,
                                                      std::uint32_t now_us) {
  const Result<void> ended = await_frame(chip, op, now_us);
  return ended && op.plan_.frames == 0 ? take_frame_status(chip, op) : ended;
}

// The data is here.
inline Result<void> Procedures::take_words(ChipState& chip, Operation& op) {
  mb4_cyclic& read = op.read_->read_;
  read.fresh = mb4_cyclic_take(&read, &op.plan_, 0, mb4_cyclic_valid(&read), MB4_WITH_ALL);
  mb4_cyclic_find_blank(&read, MB4_WITH_ALL);
  if (!chip.checks_all() || read.flags == 0) {
    return end_frame(chip, op);  // SVALID is cleared already, or there is none
  }
  if (read.fresh == 0) {
    add_poll(op);
    op.stage_ = kFrameStatus;
    return {};
  }
  op.stage_ = kWordsAgain;
  mb4_cyclic_add_data(&read, &op.plan_, read.fresh, MB4_WITH_ALL);
  mb4_cyclic_add_status(&op.plan_);
  return {};
}

// With SpiCheck::kFull: the status after the data.
inline Result<void> Procedures::take_words_status(ChipState& chip, Operation& op) {
  const Result<void> seen = take_status(op);
  if (!seen) {
    return seen;
  }
  const unsigned wanted = op.read_->read_.flags;
  if (!op.status_.idle() || (wanted & ~unsigned{op.status_.valid_flags()}) != 0) {
    return Error::kCorrupted;
  }
  add_clear(chip, op);
  return {};
}

// The frame has ended, or was refused.
//
// SVALIDx was cleared before the request, so SVALIDx = 1 proves that the requested frame ran, with
// any value of nAGSERR. A chip may set nAGSERR = 0 at each write of 0xF4 (page 34 can be read so;
// AGSERR_ON_INSTR_WRITE = 1). The driver looks at nAGSERR only if there is no data and nSCDERR = 1;
// nSCDERR = 0 shows that a frame ran. On such a chip kNoData appears as kLineError.
inline Result<void> Procedures::take_frame_status(ChipState& chip, Operation& op) {
  const Status& status = op.status_;
  mb4_cyclic& read = op.read_->read_;
  for (std::size_t i = 0; i < Status::kBytes; ++i) {
    read.status[i] = status.bytes()[i];
  }
  // Every slave without SVALID was bad in this frame.
  for (std::uint8_t i = 0; i < read.count; ++i) {
    read.slots[i].code = status.scd_error() ? MB4_CRC : MB4_NO_DATA;
  }
  // nSCDERR = 0: the CRC of a slave was wrong, and SVALIDx = 0 identifies the slave (page 34). If
  // every SVALIDx is 1, the chip contradicts itself and the driver uses no data.
  const unsigned valid = status.valid_flags() & unsigned{chip.sensor_flags};
  const bool contradicts = status.scd_error() && valid == chip.sensor_flags;
  // The bad words are read too: one that is all 0 was not sent.
  read.flags = contradicts ? std::uint16_t{0} : mb4_cyclic_readable(&read, MB4_WITH_ALL);
  if (read.flags != 0) {
    mb4_cyclic_add_data(&read, &op.plan_, read.flags, MB4_WITH_ALL);
    if (!chip.checks_all() && mb4_cyclic_valid(&read) != 0) {
      mb4_cyclic_add_clear(&op.plan_, chip.sensor_flags, 4);
    }
    op.stage_ = kWords;
    return {};
  }
  // Without a sensor only nAGSERR can show a refused frame. With kWaitForLine the chip refuses no
  // frame.
  const bool refusable = read.count != 0 || chip.config.frame_start != FrameStart::kWaitForLine;
  if (refusable && status.start_error() && !status.scd_error()) {
    add_stop(chip, op, Error::kLineError);
    return {};
  }
  return end_frame(chip, op);
}

inline Result<void> Procedures::end_frame(ChipState& chip, Operation& op) {
  const mb4_cyclic& read = op.read_->read_;
  bool good = true;
  for (std::uint8_t i = 0; i < read.count; ++i) {
    good = good && read.slots[i].code == MB4_OK;
    static_cast<void>(mb4_slot_tell(&read.words[i], &read.slots[i], MB4_WITH_ALL));
  }
  // After kCorrupted the status, which came over the same SPI, is doubtful too.
  chip.recover_first = !good;
  if (read.blank != 0) {
    op.limit_ = {};
    add_lines(op);
    op.stage_ = kBlank;
  }
  return {};
}

inline Result<void> Procedures::wait_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (op.stage_ != kStart && op.stage_ != kPoll) {
    return op.good_ ? stopped_step(chip, op, now_us) : Error::kTransport;
  }
  if (const Result<void> seen = take_status(op); !seen) {
    return seen;
  }
  if (op.stage_ == kStart) {
    op.limit_.begin(now_us, chip.frame_us + chip.pitch_us);
  }
  const Status& status = op.status_;
  // A frame that was bad for all slaves shows only in nSCDERR. The BREAK of a restart sets nSCDERR
  // to 1 again.
  if ((status.valid_flags() & chip.sensor_flags) != 0 || status.scd_error()) {
    return {};
  }
  if (!op.limit_.over) {
    add_next_poll(op, now_us);
    return {};
  }
  if (status.idle() && chip.watch.silent_us == MB4_NEVER) {
    return Error::kNoData;
  }
  add_stop(chip, op, Error::kTimeout);
  return {};
}

// BREAK; then `cause`, or, if that is kTimeout, what the lines say.
inline void Procedures::add_stop(ChipState& chip, Operation& op, Error cause) {
  chip.stopped();
  add_instruction(op, regs::BREAK::encode<1>());
  op.stage_ = kStopped;
  op.cause_ = cause;
}

// A frame did not end by itself. SL of all channels in use must be 1 when the slaves' timeout is
// over. kTimeout: so it is, no slave has answered. kLineError: a line is stuck low.
inline Result<void> Procedures::stopped_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (op.stage_ == kStopped) {
    if (op.cause_.error() == Error::kTimeout) {
      op.limit_ = {};
      add_lines(op);
      return {};
    }
    return op.cause_;
  }
  const Result<void> line = take_lines(chip, op, now_us);
  return line && op.plan_.frames == 0 ? Result<void>(Error::kTimeout) : line;
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_SINGLE_FRAME_HPP_
