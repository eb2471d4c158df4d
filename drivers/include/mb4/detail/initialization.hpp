// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// INIT, which makes the slaves ready and measures the line delay in BiSS C (pages 32, 33); then, in
// BiSS C, one frame that shows whether each slave sends a word.

#ifndef MB4_DETAIL_INITIALIZATION_HPP_
#define MB4_DETAIL_INITIALIZATION_HPP_

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/control_time.hpp"
#include "mb4/detail/procedures.hpp"

namespace mb4::detail {

// INIT measures something.
[[nodiscard]] inline bool measures(const ChipState& chip) {
  return any_channel_is(chip.config, Protocol::kBissC);
}
// It measures `channel` (0, 1).
[[nodiscard]] inline bool measures(const ChipState& chip, unsigned channel) {
  const Protocol protocol = chip.config.channels[channel].protocol;
  return measures(chip) && protocol != Protocol::kUnused && protocol != Protocol::kSsi;
}

// Longest time of INIT: the limits of the delay and of the slaves' timeout (docs/choices.md), or,
// without BiSS C, the limit of the hand-over.
[[nodiscard]] inline std::uint32_t initialization_us(const ChipState& chip) {
  constexpr std::uint32_t kPeriods = 255 + 64 + 1024;
  const Config& config = chip.config;
  const std::uint32_t us =
      measures(chip) ? periods_us(config, kPeriods) : register_limit_us(config);
  return with_spread(config, us) + kFrameMarginUs;
}

// Device::initialize() documents the errors. The chip must be configured, and no frames and no
// control communication may run.
inline void Procedures::plan_initialize(ChipState& chip, Operation& op) {
  begin(chip, op, initialize_step);
  if (chip.recover_first) {
    add_recovery(chip, op);
  } else {
    add_preparation(chip, op);
  }
  chip.recover_first = true;
}

// SCDATA1 and SCDATA5 become 0, so that an old value cannot look like a new one. A register access
// may have left another protocol in REGVERS.
inline void Procedures::add_preparation(ChipState& chip, Operation& op) {
  constexpr std::uint8_t kScdata5 = regs::scdata_address(5);
  mb4_plan_add(&op.plan_, 3, MB4_CYCLIC_WRITE, regs::scdata_address(1), 0);
  mb4_plan_add(&op.plan_, 3, MB4_CYCLIC_WRITE, kScdata5, 0);
  op.stage_ = kEmptied;
  if (any_channel_is(chip.config, Protocol::kBissB)) {
    add_write(chip, op, regs::kAddrCtrl, &chip.image[regs::kAddrCtrl - kImageFirst], 1);
    op.stage_ = kProtocol;
  }
}

inline Result<void> Procedures::initialize_step(ChipState& chip, Operation& op,
                                                std::uint32_t now_us) {
  if (!op.good_) {
    return Error::kTransport;
  }
  switch (op.stage_) {
    case kRecover: {
      const Result<void> done = take_recovery(chip, op);
      if (recovery_is_over(done, op)) {
        add_preparation(chip, op);
      }
      return done;
    }
    case kProtocol:
    case kEmptied:
      return take_preparation(chip, op);
    case kStart:
      return take_init_start(chip, op, now_us);
    case kPoll:
      return take_init_status(chip, op, now_us);
    case kLines:
      return take_init_lines(chip, op, now_us);
    case kDelays:
      return take_delay(chip, op);
    case kClear:
      return take_init_clear(chip, op, now_us);
    default:
      return Error::kTimeout;
  }
}

// The chip is ready for INIT.
inline Result<void> Procedures::take_preparation(ChipState& chip, Operation& op) {
  const Result<void> set =
      op.stage_ == kProtocol && chip.checks_all() ? take_readback(chip, op) : Result<void>();
  if (set) {
    add_instruction(op, regs::INIT::encode<1>());
    chip.control.ended = false;
    op.stage_ = kStart;
    if (chip.checks_all()) {
      mb4_cyclic_add_status(&op.plan_);
    }
  }
  return set;
}

// INIT was written. It reads 1 for a while. In BiSS C it may be over already, but then it has
// measured. With SSI alone an INIT that is lost shows in the flags, if at all.
inline Result<void> Procedures::take_init_start(ChipState& chip, Operation& op,
                                                std::uint32_t now_us) {
  op.init_unseen_ = chip.checks_all() && take_status(op).ok() && op.status_.idle() &&
                    op.status_.get<regs::INIT>() == 0;
  if (op.init_unseen_ && !measures(chip) && any_channel_is(chip.config, Protocol::kBissB)) {
    return Error::kCorrupted;
  }
  // Another bit has come with it: a frame would follow INIT and switch the banks.
  if (chip.checks_all() && op.status_.plausible() &&
      (op.status_.instruction() & ~unsigned{regs::INIT::kMask}) != 0) {
    return Error::kCorrupted;
  }
  op.limit_.begin(now_us, initialization_us(chip));
  add_poll(op);
  return {};
}

// Has INIT ended?
inline Result<void> Procedures::take_init_status(ChipState& chip, Operation& op,
                                                 std::uint32_t now_us) {
  const Result<void> seen = take_status(op);
  if (!seen) {
    return seen;
  }
  if (op.status_.idle() && op.status_.get<regs::INIT>() == 0) {
    // INIT has set the flags to 1 at its beginning.
    if (op.status_.start_error()) {
      return measures(chip) ? Error::kLineDelay : Error::kLineError;
    }
    // INIT also ends with a line that is stuck low (page 33), so the line is checked here. In BiSS
    // B the slaves are in register mode now and first need their timeout.
    op.limit_ = {};
    add_lines(op);
    op.plan_.pause_us = measures(chip) ? 0 : chip.recovery_us();
    return {};
  }
  if (op.limit_.over) {
    chip.stopped();
    add_instruction(op, regs::BREAK::encode<1>());
    op.stage_ = kStopped;
    return {};
  }
  add_next_poll(op, now_us);
  return {};
}

inline Result<void> Procedures::take_init_lines(ChipState& chip, Operation& op,
                                                std::uint32_t now_us) {
  const Result<void> line = take_lines(chip, op, now_us);
  if (line && op.plan_.frames == 0) {
    op.index_ = 0;
    add_delays(chip, op);
  }
  return line;
}

// SCDATA1 and SCDATA5 (page 33) of the channels that INIT has measured, one after the other.
inline void Procedures::add_delays(ChipState& chip, Operation& op) {
  for (; op.index_ < kChannels; ++op.index_) {
    if (measures(chip, op.index_)) {
      const std::uint8_t address =
          op.index_ == 0 ? regs::scdata_address(1) : regs::scdata_address(5);
      op.stage_ = kDelays;
      add_read(op, address, 1);
      if (chip.checks_all()) {
        add_read(op, address, 1);
      }
      return;
    }
    op.delay_.quarters[op.index_] = 0;
  }
  add_clear(chip, op);
}

// The delay of a channel was read. An ideal line and slave give 1.
inline Result<void> Procedures::take_delay(ChipState& chip, Operation& op) {
  const std::uint8_t quarters = received(op)[2];
  op.delay_.quarters[op.index_++] = quarters;
  const Result<void> read = chip.checks_all() ? readback_equals(op) : Result<void>();
  if (!read) {
    return read;
  }
  if (quarters == 0) {
    return op.init_unseen_ ? Error::kCorrupted : Error::kNoData;
  }
  add_delays(chip, op);
  return {};
}

inline Result<void> Procedures::take_init_clear(ChipState& chip, Operation& op,
                                                std::uint32_t now_us) {
  const Result<void> cleared = clear_step(chip, op, now_us);
  chip.recover_first = !cleared || op.plan_.frames != 0;
  if (!chip.recover_first) {
    if (chip.config.activate_at_initialize) {
      begin_activate(chip, op, 0, 0);
      op.step_ = initialize_activate_step;
    } else {
      begin_look(chip, op);
    }
  }
  return cleared;
}

inline Result<void> Procedures::initialize_activate_step(ChipState& chip, Operation& op,
                                                         std::uint32_t now_us) {
  const Result<void> done = activate_step(chip, op, now_us);
  if (op.plan_.frames != 0) {
    op.step_ = initialize_activate_step;
  } else if (done) {
    begin_look(chip, op);
  }
  return done;
}

// ---- Does each slave send a word? One frame at the end ----

// `bytes`: SCDATAx of a word whose CRC is wrong. All its bits were 0 on the line; the chip stores
// the CRC inverted. As mb4_slot_blank(); but a program with this call as well would have a slower
// and larger read path, because the compiler takes the functions of mb4_cyclic.h apart then.
[[nodiscard]] inline bool is_blank(const mb4_word& word, const std::uint8_t* bytes) {
  const unsigned high = word.crc_bits > 8 ? unsigned{bytes[6]} : 0xFFU;
  const unsigned crc = word.crc_bits > 8 ? bytes[7] * 256U + high : unsigned{bytes[7]};
  return (word.crc_bits == 0 || crc == (1U << word.crc_bits) - 1U) &&
         is_zero(bytes, (word.bits + 7U) / 8U);
}

// Where there are actuators no frame is made: it would send words that nobody has written.
inline void Procedures::begin_look(ChipState& chip, Operation& op) {
  bool needed = false;
  for (std::uint8_t i = 0; i < chip.count; ++i) {
    needed = needed || chip.words[i].line != 0;
  }
  if (needed && chip.actuators == 0) {
    begin(chip, op, look_step);
    chip.recover_first = true;
    add_request_frame(op);
  }
}

// A frame that is refused, does not end or brings a wrong word is no error here: INIT has done its
// work, and the reads tell what is wrong.
inline Result<void> Procedures::look_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (!op.good_) {
    return Error::kTransport;
  }
  switch (op.stage_) {
    case kStart:
    case kPoll:
      return take_look_status(chip, op, now_us);
    case kBadWord:
      if (is_blank(chip.words[op.index_ - 1U], received(op) + 2)) {
        op.limit_ = {};
        add_lines(op);
      } else {
        add_bad_words(chip, op);
      }
      return {};
    case kLines:
      return take_look_lines(chip, op, now_us);
    case kClear: {
      const Result<void> cleared = clear_step(chip, op, now_us);
      chip.recover_first = !cleared || op.plan_.frames != 0;
      return cleared && !chip.recover_first ? op.cause_ : cleared;
    }
    default:  // kStopped
      return {};
  }
}

// Has the frame ended?
inline Result<void> Procedures::take_look_status(ChipState& chip, Operation& op,
                                                 std::uint32_t now_us) {
  const Result<void> ended = await_frame(chip, op, now_us);
  if (ended && op.plan_.frames == 0) {
    op.index_ = op.status_.scd_error() ? std::uint8_t{0} : chip.count;
    add_bad_words(chip, op);
  }
  return ended;
}

// A word is all 0. In the slaves' timeout SL is 0, and all bits are if it stays there.
inline Result<void> Procedures::take_look_lines(ChipState& chip, Operation& op,
                                                std::uint32_t now_us) {
  const Result<void> line = take_lines(chip, op, now_us);
  if (op.plan_.frames == 0) {
    op.cause_ = line ? Error::kNoWord : Error::kNone;
    op.index_ = chip.count;
    add_bad_words(chip, op);
  }
  return {};
}

// The bad words one after the other; then SVALID = 0.
inline void Procedures::add_bad_words(ChipState& chip, Operation& op) {
  while (op.index_ < chip.count) {
    const mb4_word& word = chip.words[op.index_++];
    const unsigned flag =
        Status::valid_registers(static_cast<std::uint8_t>(1U << (word.slave - 1U)));
    if ((op.status_.valid_flags() & flag) == 0 && word.line != 0) {
      op.stage_ = kBadWord;
      add_read(op, regs::scdata_address(word.slave), 8);
      return;
    }
  }
  add_clear(chip, op);
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_INITIALIZATION_HPP_
