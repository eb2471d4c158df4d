// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// INIT in steps (pages 32, 33). Device::plan_initialize() documents it.

#ifndef MB4_DETAIL_INITIALIZATION_STEPS_HPP_
#define MB4_DETAIL_INITIALIZATION_STEPS_HPP_

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/initialization.hpp"
#include "mb4/detail/procedures.hpp"

namespace mb4::detail {

// Device::initialize() documents the errors. The chip must be configured, and no frames and no
// control communication may run.
inline void Procedures::plan_initialize(ChipState& chip, Operation& op) {
  begin(chip, op, initialize_step, chip.recover_first);
  chip.recover_first = true;
  if (op.stage_ == kStart) {
    prepare(chip, op);
  }
}

// SCDATA1 and SCDATA5 become 0, so that an old value cannot look like a new one. A register access
// may have left another protocol in REGVERS.
inline void Procedures::prepare(ChipState& chip, Operation& op) {
  constexpr std::uint8_t kScdata5 = regs::scdata_address(5);
  mb4_plan_add(&op.plan_, 3, MB4_CYCLIC_WRITE, regs::scdata_address(1), 0);
  mb4_plan_add(&op.plan_, 3, MB4_CYCLIC_WRITE, kScdata5, 0);
  op.stage_ = kSet;
  if (any_channel_is(chip.config, Protocol::kBissB)) {
    add_write(chip, op, regs::kAddrCtrl, &chip.image[regs::kAddrCtrl - kImageFirst], 1);
    op.stage_ = kFill;
  }
}

inline Result<void> Procedures::initialize_step(ChipState& chip, Operation& op,
                                                std::uint32_t now_us) {
  if (!op.good_) {
    return Error::kTransport;
  }
  switch (op.stage_) {
    case kRecover:
      recovered(chip, op);
      prepare(chip, op);
      return {};
    case kFill:
    case kSet: {
      const Result<void> set = op.stage_ == kFill ? same(chip, op) : Result<void>();
      if (set) {
        add_instruction(op, regs::INIT::encode<1>());
        op.stage_ = kStart;
      }
      return set;
    }
    case kStart:
      op.limit_.begin(now_us, initialization_us(chip));
      add_poll(op);
      return {};
    case kPoll: {
      const Result<void> seen = look(op);
      if (!seen) {
        return seen;
      }
      if (op.status_.idle() && op.status_.get<regs::INIT>() == 0) {
        // INIT has set the flags to 1 at its beginning.
        if (op.status_.start_error()) {
          return measures(chip) ? Error::kLineDelay : Error::kLineError;
        }
        // INIT also ends with a line that is stuck low (page 33), so the line is checked here. In
        // BiSS B the slaves are in register mode now and first need their timeout.
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
      op.limit_.note(now_us);
      add_poll(op);
      return {};
    }
    case kLines: {
      const Result<void> line = lines(chip, op, now_us);
      if (!line || op.plan_.frames != 0) {
        return line;
      }
      op.at_ = 0;
      break;
    }
    case kDelays: {
      // An ideal line and slave give 1.
      std::uint8_t& quarters = op.delay_.quarters[op.at_++];
      quarters = received(op)[2];
      const Result<void> read = same(chip, op);
      if (!read || quarters == 0) {
        return read ? Error::kNoData : read;
      }
      break;
    }
    case kClear: {
      const Result<void> cleared = clear_step(chip, op, now_us);
      chip.recover_first = !cleared || op.plan_.frames != 0;
      return cleared;
    }
    default:
      return Error::kTimeout;
  }
  // SCDATA1 and SCDATA5 (page 33) of the channels that INIT has measured.
  for (; op.at_ < kChannels; ++op.at_) {
    if (measures(chip, op.at_)) {
      const std::uint8_t address = op.at_ == 0 ? regs::scdata_address(1) : regs::scdata_address(5);
      op.stage_ = kDelays;
      add_read(op, address, 1);
      if (chip.checks_all()) {
        add_read(op, address, 1);
      }
      return {};
    }
    op.delay_.quarters[op.at_] = 0;
  }
  add_clear(chip, op);
  return {};
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_INITIALIZATION_STEPS_HPP_
