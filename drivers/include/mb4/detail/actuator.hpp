// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Writes the words of actuators (pages 15, 25, 31).

#ifndef MB4_DETAIL_ACTUATOR_HPP_
#define MB4_DETAIL_ACTUATOR_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/procedures.hpp"

namespace mb4::detail {

// Words for other banks that an operation writes at most.
inline constexpr std::uint8_t kMostWords = 8;

// A switch of the banks takes some system clocks, each at most 1 us.
inline constexpr std::uint32_t kSwitchUs = 10 + kClockStepUs;

// Device::write_actuator() and Automatic::write_actuator() document the errors. The chip is
// configured, and no control communication runs. `both_banks` = false: with automatic frames only
// the host's bank is written. kInvalidArgument: nothing is planned.
//
// A frame sends the word in the chip's bank. The host writes into the other bank, and each end of a
// frame switches the banks. So a word that is to stay must be written to both banks:
//  * Without automatic frames no frame switches the banks; the driver does it with SWBANK.
//  * With automatic frames the driver writes each bank under HOLDBANK, so that no frame sends half
//    a word. It writes the second bank when the end of a frame has switched the banks. It sees this
//    when it reads another word than it has written.
inline Result<void> Procedures::plan_actuator(ChipState& chip, Operation& op, std::uint8_t slave,
                                              std::uint64_t word, bool both_banks) {
  if (!is_in(chip.actuators, slave)) {
    return Error::kInvalidArgument;
  }
  const SlaveConfig& config = chip.config.slaves[slave - 1U];
  std::array<std::uint8_t, regs::kScdataStride> bytes{};
  unsigned bits_left = config.data_bits;
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(word);
    word >>= 8;
    if (bits_left < 8 && byte >> bits_left != 0) {
      return Error::kInvalidArgument;
    }
    bits_left -= bits_left < 8 ? bits_left : 8;
  }
  begin(chip, op, chip.automatic ? held_step : switched_step);
  op.request_ = bytes;
  op.count_ = data_bytes(config);
  if (chip.automatic && chip.checks_all()) {
    add_mark(chip, op);
  }
  op.address_ = regs::scdata_address(slave);
  op.both_banks_ = both_banks;
  op.words_ = 0;
  if (chip.automatic) {
    add_held(chip, op);
  } else if (chip.recover_first) {
    add_recovery(chip, op);
  } else {
    add_word(chip, op, kWord);
  }
  chip.recover_first = chip.recover_first || !chip.automatic;
  return {};
}

// SpiCheck::kFull, beside automatic frames: a mark in the byte behind the word, which no frame
// sends. Each call has another one, and it is not 0. So a write that has gone to the word of a
// sensor (0x08 and 0x00 differ in one bit) does not read back right, although the memory held the
// same word before. Neither does a reading that has become a write itself (0x03, 0x0B and 0x02).
// The mark is no byte of the word: a write that has gone some bytes too far shows too. A word of
// eight bytes leaves no room for a mark: drop_beside().
inline void Procedures::add_mark(ChipState& chip, Operation& op) {
  if (op.count_ == op.request_.size()) {
    return;
  }
  std::uint8_t mark = static_cast<std::uint8_t>(chip.mark + 1U);
  for (std::size_t i = 0; i < op.request_.size(); ++i) {
    if (op.request_[i] == mark) {  // the bytes behind the word are 0
      ++mark;
      i = 0;
    }
  }
  chip.mark = mark;
  op.request_[op.count_] = mark;
  ++op.count_;
}

// Nothing proves a word without a mark. Words of sensors that wait now may be foreign: the next
// read drops them.
inline void Procedures::drop_beside(ChipState& chip, const Operation& op) {
  const bool waits = (op.status_.valid_flags() & unsigned{chip.sensor_flags}) != 0;
  chip.watch.held = chip.watch.held || (waits && op.count_ == op.request_.size());
}

inline void Procedures::add_word(ChipState& chip, Operation& op, std::uint32_t stage) {
  op.stage_ = stage;
  add_write(chip, op, op.address_, op.request_.data(), op.count_);
  if (chip.checks_all()) {
    add_witness(op);
  }
}

// 0xF4; with SpiCheck::kFull it is read back.
inline void Procedures::add_confirmed(ChipState& chip, Operation& op, std::uint8_t instruction,
                                      std::uint32_t stage) {
  op.stage_ = stage;
  add_instruction(op, instruction);
  if (chip.checks_all()) {
    mb4_cyclic_add_status(&op.plan_);
  }
}
// AGS may have ended by an error. kTransport, kNotDetected, kCorrupted.
inline Result<void> Procedures::take_instruction(ChipState& chip, Operation& op,
                                                 std::uint8_t want) {
  if (!op.good_ || !chip.checks_all()) {
    return op.good_ ? Error::kNone : Error::kTransport;
  }
  const Result<void> seen = take_status(op);
  const unsigned ended = want & regs::AGS::kMask;
  return seen && (op.status_.instruction() | ended) != want ? Error::kCorrupted : seen;
}

// ---- Without automatic frames: two words, SWBANK inverted after each ----

inline Result<void> Procedures::switched_step(ChipState& chip, Operation& op,
                                              std::uint32_t /*now_us*/) {
  constexpr std::uint8_t kSwitch = regs::SWBANK::encode<1>();
  Result<void> done = op.good_ ? Error::kNone : Error::kTransport;
  switch (op.stage_) {
    case kRecover:
      done = take_recovery(chip, op);
      if (recovery_is_over(done, op)) {
        add_word(chip, op, kWord);
      }
      return done;
    case kWord:
    case kSecondWord: {
      done = take_write(chip, op);
      if (done && !chip.config.single_bank) {
        const bool first = op.stage_ == kWord;
        add_confirmed(chip, op, first ? kSwitch : std::uint8_t{0}, first ? kSwitched : kStopped);
        return done;
      }
      break;
    }
    case kSwitched:
      done = take_instruction(chip, op, kSwitch);
      if (done) {
        add_word(chip, op, kSecondWord);
        op.plan_.pause_us = kSwitchUs;
      }
      return done;
    default:  // kStopped; after two changes SWBANK is 0 again (page 33)
      done = take_instruction(chip, op, 0);
      break;
  }
  chip.recover_first = !done;
  return done;
}

// ---- With automatic frames: under HOLDBANK ----

// With SpiCheck::kFull three steps, otherwise one.
inline void Procedures::add_held(ChipState& chip, Operation& op) {
  add_confirmed(chip, op, kHoldAndAgs, kHold);
  chip.set_waits(ChipState::kForActuator, chip.checks_all());
  if (!chip.checks_all()) {
    add_word(chip, op, kWord);
    add_release(chip, op, {});
    op.stage_ = kStart;
  }
}

inline void Procedures::add_release(ChipState& chip, Operation& op, const Result<void>& cause) {
  op.stage_ = kStopped;
  op.cause_ = cause;
  add_instruction(op, regs::AGS::encode<1>());
  if (chip.checks_all()) {
    mb4_cyclic_add_status(&op.plan_);
  }
}

inline Result<void> Procedures::held_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  switch (op.stage_) {
    case kHold:
      take_hold(chip, op);
      return {};
    case kWord:
      op.cause_ = take_write(chip, op);
      drop_beside(chip, op);
      add_release(chip, op, op.cause_);
      return {};
    case kOtherWord:
      return take_other_word(chip, op, now_us);
    case kStart:
      if (!op.good_) {
        add_release(chip, op, Error::kTransport);
        return {};
      }
      break;
    default:  // kStopped
      break;
  }
  return take_release(chip, op, now_us);
}

// HOLDBANK was written.
inline void Procedures::take_hold(ChipState& chip, Operation& op) {
  const Result<void> held = take_instruction(chip, op, kHoldAndAgs);
  if (held) {
    add_word(chip, op, kWord);
  } else {
    add_release(chip, op, held);
  }
}

// The word was read again: has the end of a frame switched the banks? With SpiCheck::kFull one
// reading that differs from the other is not the other bank. If it is 0 it may have been a write to
// the word of a sensor: the next read drops what waits.
inline Result<void> Procedures::take_other_word(ChipState& chip, Operation& op,
                                                std::uint32_t now_us) {
  const bool full = chip.checks_all();
  const Result<void> seen = full ? take_witness(chip, op) : take_status(op);
  if (!seen) {
    return seen;
  }
  bool again = false;
  if (full) {
    drop_beside(chip, op);
    again = !readback_equals(op);
    const std::uint8_t* zeros = mb4_plan_tx(&op.plan_, 0) + 2;
    const unsigned size = static_cast<unsigned>(op.count_);
    if (again && (bytes_equal(received(op) + 2, zeros, size) ||
                  bytes_equal(received(op, 1) + 2, zeros, size))) {
      chip.watch.held = true;
    }
  }
  const std::uint8_t* is = received(op, full ? 0 : 1) + 2;
  if (!again && !bytes_equal(is, op.request_.data(), static_cast<unsigned>(op.count_))) {
    if (op.words_ >= kMostWords) {
      return Error::kCorrupted;
    }
    ++op.words_;
    add_held(chip, op);
  } else if (again && ++op.failures_ >= kMostFailures) {
    return Error::kCorrupted;
  } else if (again || !op.limit_.over) {
    add_other_word(chip, op, now_us);
  }  // otherwise both banks hold the word
  return {};
}

// The bank was released; without SpiCheck::kFull in the step that has written the word.
inline Result<void> Procedures::take_release(ChipState& chip, Operation& op, std::uint32_t now_us) {
  Result<void> done = op.good_ ? Error::kNone : Error::kTransport;
  if (op.stage_ == kStopped) {
    chip.set_waits(ChipState::kForActuator, false);
    if (done) {
      done = take_instruction(chip, op, regs::AGS::encode<1>());
    }
    if (op.cause_) {
      op.cause_ = done;
    }
    // A disturbed byte of 0xF4 may have started an access.
    chip.control.stray = chip.control.stray || (chip.checks_all() && !op.cause_);
  }
  // What a failed call has done to the banks nobody knows: SWBANK in the byte that holds the bank
  // swaps them, and the one that releases it swaps them back.
  chip.watch.held = chip.watch.held || !op.cause_ || !done;
  if (op.cause_ && op.both_banks_) {
    op.limit_.begin(now_us, chip.frame_us + chip.pitch_us);
    add_other_word(chip, op, now_us);
  }
  return op.cause_;
}

// Reads until the word differs, which shows the other bank, also behind the word for that one: a
// frame may have ended between the reading and HOLDBANK, and the word is in the first bank again.
// If no reading differs, both banks hold the word. The status makes the two frames as long as the
// count of polls expects.
inline void Procedures::add_other_word(const ChipState& chip, Operation& op, std::uint32_t now_us) {
  op.limit_.note(now_us);
  op.stage_ = kOtherWord;
  add_read(op, op.address_, op.count_);
  if (chip.checks_all()) {
    add_read(op, op.address_, op.count_);
    add_witness(op);
  } else {
    mb4_cyclic_add_status(&op.plan_);
  }
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_ACTUATOR_HPP_
