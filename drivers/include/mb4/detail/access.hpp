// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A control communication from its request to its end: registers of the slaves, and commands.
// Source: datasheet pages 16, 27 to 29, 34, 35.

#ifndef MB4_DETAIL_ACCESS_HPP_
#define MB4_DETAIL_ACCESS_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/control_checks.hpp"
#include "mb4/detail/control_time.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/register_image.hpp"

namespace mb4::detail {

inline constexpr std::uint8_t kControlFrame =
    regs::INSTR::encode<static_cast<std::uint8_t>(regs::Instr::kControl)>();

// Longest time of the access, in microseconds: at most 930 * 1 s + 13 s, which fits 32 bits.
[[nodiscard]] inline std::uint32_t longest_access_us(const ChipState& chip) {
  return control_frames(chip.control.count) * chip.pitch_us + chip.busy_us + kFrameMarginUs;
}

// For accesses without automatic frames, where the host sets the pace. True when the access cannot
// end well any more: all frames that it needs have run and the time of a busy slave is over. A
// frame takes more than a microsecond, so a clock that stands still ends it too.
[[nodiscard]] inline bool enough_frames(const ChipState& chip, std::uint32_t now_us) {
  const ControlState& state = chip.control;
  const std::uint32_t needed = control_frames(state.count);
  return state.frames >= needed && (state.frames - needed > chip.busy_us ||
                                    now_us - state.access_us >= longest_access_us(chip));
}

// Time limit of the access that chip.control describes, from its instruction on; of its first frame
// without automatic frames.
[[nodiscard]] inline std::uint32_t access_us(const ChipState& chip) {
  const ControlState& state = chip.control;
  if (state.biss_b) {
    return biss_b_timeout_us(chip.config, state.count);
  }
  return chip.automatic ? longest_access_us(chip) : chip.frame_us;
}

// How the access has ended.
[[nodiscard]] inline ErrorInfo access_error(const ChipState& chip, ControlState::Kind kind,
                                            const Status& status) {
  if (chip.control.biss_b && chip.control.no_hand_over) {
    return Error::kRegister;
  }
  ErrorInfo error;
  if (status.delay_error() && kind != ControlState::Kind::kCommand) {
    error = Error::kRegisterDelay;
  } else if (status.control_error()) {
    error = kind == ControlState::Kind::kCommand ? Error::kCommand : Error::kRegister;
  }
  if (error.code != Error::kNone) {
    error.detail =
        kind == ControlState::Kind::kCommand ? std::uint8_t{0} : status.get<regs::REGBYTES>();
  }
  return error;
}

// An access before, or the frame of a failed read, may still run and would take the new bytes and
// execute the new instruction. For BiSS B BREAK also resets REGEND and nAGSERR, so that both
// describe this access.
inline void Procedures::begin_access(ChipState& chip, Operation& op, bool biss_b) {
  begin(chip, op, access_step);
  // Beside automatic frames BREAK is followed by a new start of the frames, in the access itself.
  const bool restart = chip.automatic && chip.control.stray;
  if (restart) {
    op.bad_ = 1;
    chip.restart = true;  // until the frames run again
  }
  if (restart || biss_b || (!chip.automatic && chip.recover_first)) {
    add_recovery(chip, op);
  }
  chip.control.stray = false;
  chip.recover_first = true;
  chip.control.readable = 0;
  chip.control.waits = false;
  chip.control.suspect = false;
  chip.control.biss_b = biss_b;
  chip.control.owner = &op;
}

// Control documents arguments and errors. Writes `data`, or, if that is null, reads `count`
// registers into `out`; if that is null too, they stay for plan_take(). After an error nothing is
// planned.
inline Result<void> Procedures::plan_access(ChipState& chip, Operation& op, SlaveAddress slave,
                                            std::uint8_t address, const std::uint8_t* data,
                                            std::uint8_t* out, std::size_t count) {
  const Result<void> allowed =
      possible_in(chip, op,
                  check_access(chip, slave, address, count,
                               data != nullptr ? Protocol::kUnused : Protocol::kSsi));
  if (!allowed) {
    return allowed;
  }
  ControlState& state = chip.control;
  const bool biss_b = chip.config.channels[slave.channel - 1U].protocol == Protocol::kBissB;
  begin_access(chip, op, biss_b);
  state.kind = data != nullptr ? ControlState::Kind::kWrite : ControlState::Kind::kRead;
  state.count = static_cast<std::uint8_t>(count);
  op.data_ = data;
  op.out_ = out;
  op.count_ = count;
  const std::uint8_t regadr =
      regs::WNR::insert(regs::REGADR::insert(0, address), data != nullptr ? 1 : 0);
  const std::uint8_t control = encode_ctrl(chip.config, biss_b);
  op.request_[0] = regadr;
  op.request_[1] = static_cast<std::uint8_t>(state.count - 1U);
  op.request_[2] = slave.channel;
  op.request_[3] = regs::CTS::insert(regs::SLAVEID::insert(control, slave.id), 1);
  if (op.stage_ == kStart) {
    add_request(chip, op);
  }
  return {};
}

inline Result<void> Procedures::plan_command(ChipState& chip, Operation& op,
                                             const Command& command) {
  const Result<void> allowed = possible_in(chip, op, check_command(chip, command));
  if (allowed) {
    begin_command(chip, op, command);
  }
  return allowed;
}

inline void Procedures::begin_command(ChipState& chip, Operation& op, const Command& command) {
  ControlState& state = chip.control;
  begin_access(chip, op, false);
  state.kind = ControlState::Kind::kCommand;
  state.count = 1;
  const std::uint8_t control = regs::CMD::insert(encode_ctrl(chip.config, false), command.code);
  op.request_[1] = reversed(command.ids);  // IDS0 is bit 7 (table 32)
  op.request_[2] = command.channels;
  op.request_[3] = regs::IDA_TEST::insert(control, command.test_acknowledge ? 1 : 0);
  op.data_ = &op.request_[1];
  op.count_ = 1;
  if (op.stage_ == kStart) {
    add_request(chip, op);
  }
}

// Control::activate() documents arguments and errors.
inline Result<void> Procedures::plan_activate(ChipState& chip, Operation& op, std::uint8_t ids_1,
                                              std::uint8_t ids_2) {
  const Result<void> allowed = possible_in(chip, op, check_activate(chip, ids_1, ids_2));
  if (allowed) {
    begin_activate(chip, op, ids_1, ids_2);
  }
  return allowed;
}

// Broadcast command 01: all slaves take part in control communication. The commands that follow are
// in request_[4] and [5]: the IDs of a channel.
inline void Procedures::begin_activate(ChipState& chip, Operation& op, std::uint8_t ids_1,
                                       std::uint8_t ids_2) {
  const bool given = (ids_1 | ids_2) != 0;
  Command command;
  command.code = 1;
  command.channels = 0;
  for (std::uint8_t channel = 1; channel <= kChannels; ++channel) {
    const bool biss_c = chip.config.channels[channel - 1U].protocol == Protocol::kBissC;
    command.channels =
        static_cast<std::uint8_t>(command.channels | (biss_c ? channel : std::uint8_t{0}));
  }
  begin_command(chip, op, command);
  op.step_ = activate_step;
  op.request_[4] = given ? ids_1 : biss_c_ids(chip, 1);
  op.request_[5] = given ? ids_2 : biss_c_ids(chip, 2);
}

// Command 00, addressed: these slaves send their data. The channels one after the other, because
// their IDs may differ.
inline Result<void> Procedures::activate_step(ChipState& chip, Operation& op,
                                              std::uint32_t now_us) {
  const Result<void> done = access_step(chip, op, now_us);
  const std::uint8_t channel = op.request_[4] != 0 ? 1 : 2;
  std::uint8_t& ids = op.request_[3U + channel];
  if (done && chip.in_doubt()) {
    return op.plan_.frames == 0 ? Error::kCorrupted : Error::kNone;  // no command before the proof
  }
  if (done && op.plan_.frames == 0 && ids != 0) {
    Command command;
    command.channels = channel;
    command.ids = ids;
    ids = 0;
    begin_command(chip, op, command);
    op.step_ = activate_step;
  }
  return done;
}

// RDATA, or IDS of a command; then the request. All is read back, whatever Config::spi_check says:
// a byte that is lost here makes a command or a write that nobody asked for.
inline void Procedures::add_request(ChipState& chip, Operation& op) {
  ControlState& state = chip.control;
  if (state.kind != ControlState::Kind::kRead && op.at_ < op.count_) {
    op.stage_ = kFill;
    add_bytes(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), op.data_ + op.at_,
              part(op));
    if (chip.automatic && chip.checks_all()) {
      add_read(op, static_cast<std::uint8_t>(regs::kAddrScdata + op.at_), part(op), 1);
    }
    return;
  }
  // A command leaves 0xE2 and 0xE3 as they are.
  const std::uint8_t from = state.kind == ControlState::Kind::kCommand ? 2 : 0;
  op.stage_ = kSet;
  state.armed = true;
  add_proven(op, static_cast<std::uint8_t>(regs::kAddrRegadr + from), &op.request_[from],
             kRequestBytes - from);
  if (looks_for_strays(chip)) {
    add_witness(op);
  }
}

// A disturbed byte of a read that has ended well may have begun an access (0x01 and 0x09, INSTR =
// 100): its end would count as that of this one. REGEND = 1 says that none runs.
inline bool Procedures::looks_for_strays(const ChipState& chip) {
  return chip.automatic && chip.checks_all() && chip.control.ended;
}

// All parts are read back when all are written: a disturbed address may have put one into another
// one's place (0x88 and 0x80).
inline void Procedures::add_back(ChipState& chip, Operation& op) {
  op.stage_ = kCompare;
  add_read(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), part(op));
  if (chip.checks_all()) {
    add_read(op, static_cast<std::uint8_t>(kImageFirst + op.at_), part(op));
    add_witness(op);
  }
}

// RDATA may hold the bytes from before, and then reads back right although the write went to the
// configuration: 0x80 and 0xC0 differ in one bit. The witness has looked at 0xF4 and 0xF5.
inline Result<void> Procedures::guarded(ChipState& chip, Operation& op) {
  Result<void> seen = witnessed(chip, op);
  const unsigned from = kImageFirst + static_cast<unsigned>(op.at_);
  const unsigned size = from + part(op) <= regs::kAddrStatus0 ? part(op) : 0U;
  if (seen && differs_at(chip, from, received(op) + 2, size, true) != kNowhere) {
    doubt(chip);
    seen = Error::kCorrupted;
  }
  --op.made_;
  return seen;
}

// Bytes of the next frame.
inline std::uint8_t Procedures::part(const Operation& op) {
  const std::uint8_t left = static_cast<std::uint8_t>(op.count_ - op.at_);
  return left < Operation::kPart ? left : Operation::kPart;
}

// Takes `count` registers that an access has read.
inline void Procedures::plan_take(ChipState& chip, Operation& op, std::uint8_t* out,
                                  std::size_t count) {
  begin(chip, op, access_step);
  chip.control.owner = &op;
  op.out_ = out;
  op.count_ = count;
  add_take(chip, op);
}

// With SpiCheck::kFull each part is read in two steps, each with a witness. A disturbed opcode that
// writes makes them differ: it writes 0x5A while the chip answers 0.
inline void Procedures::add_take(ChipState& chip, Operation& op) {
  op.stage_ = kTake;
  const bool full = chip.checks_all();
  add_read(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), part(op), full ? 0x5A : 0);
  if (full) {
    add_witness(op);
  }
}

// Ends the access at once. `cause` is the result when BREAK is sent.
inline void Procedures::add_abort(ChipState& chip, Operation& op, const Result<void>& cause) {
  chip.restart = chip.automatic || chip.restart;
  chip.recover_first = true;
  chip.stopped();
  chip.control.owner = &op;
  add_instruction(op, regs::BREAK::encode<1>());
  add_rest(chip, op);
  op.stage_ = kStopped;
  op.bad_ = 0;
  op.cause_ = cause;
}

inline void Procedures::add_access(ChipState& chip, Operation& op) {
  ControlState& state = chip.control;
  state.ended = false;
  state.seen_running = false;
  state.first_frame = true;
  state.frames = 1;
  op.stage_ = kStart;
  // The 0x02 of a read with one wrong bit (0xF1 and 0xE1) would make another request of it.
  chip.set_waits(ChipState::kForRequest, chip.automatic);
  add_instruction(op, static_cast<std::uint8_t>(
                          chip.automatic ? kControlFrame | regs::AGS::encode<1>() : kControlFrame));
  if (state.biss_b || (chip.automatic && chip.checks_all())) {
    mb4_cyclic_add_status(&op.plan_);
  }
}

// The access does not begin, but its request may be in the chip.
inline Result<void> Procedures::not_begun(ChipState& chip, Operation& op,
                                          const Result<void>& cause) {
  if (!chip.control.armed) {
    return cause;
  }
  add_rest(chip, op);
  op.stage_ = kStopped;
  op.bad_ = 0;
  op.cause_ = cause;
  return {};
}

inline Result<void> Procedures::access_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  // abort(), BREAK, configure() or another access has ended this one meanwhile.
  if (chip.control.owner != &op) {
    return Error::kWrongMode;
  }
  chip.set_waits(ChipState::kForRequest, false);
  const Result<void> done = access(chip, op, now_us);
  if (done || chip.control.kind == ControlState::Kind::kNone) {
    return done;
  }
  if (op.stage_ <= kRestarted || (op.stage_ >= kFill && op.stage_ <= kSet)) {
    // Nothing was begun. But the write may have reached other registers, 0xF4 among them.
    chip.control.kind = ControlState::Kind::kNone;
    chip.restart = chip.automatic || chip.restart;
    chip.control.stray = chip.control.stray || chip.checks_all();
    const bool fills = op.stage_ == kFill || op.stage_ == kCompare;
    chip.control.armed = chip.control.armed || fills;
    return not_begun(chip, op, done);
  }
  clear_plan(op);
  add_abort(chip, op, done);
  return {};
}

inline Result<void> Procedures::access(ChipState& chip, Operation& op, std::uint32_t now_us) {
  ControlState& state = chip.control;
  // These judge a failed transfer themselves.
  const bool own =
      op.stage_ >= kFirst || op.stage_ == kPoll || op.stage_ == kPollAgain || op.stage_ == kClear;
  if (!op.good_ && !own) {
    return Error::kTransport;
  }
  switch (op.stage_) {
    case kFill:
      // 0x80 and 0x00 differ in one bit. If the bytes are in SCDATAx, a word that waits may be no
      // word of the encoder, although its CRC fits (all 0): the next read drops it.
      if (chip.automatic && chip.checks_all() &&
          equal(op.data_ + op.at_, received(op) + 2, part(op))) {
        chip.watch.held = true;
      }
      op.at_ += part(op);
      if (op.at_ < op.count_) {
        add_request(chip, op);
      } else {
        op.at_ = 0;
        add_back(chip, op);
      }
      return {};
    case kCompare:
    case kSet: {
      Result<void> set;
      if (op.stage_ == kSet) {
        const bool looks = looks_for_strays(chip);
        set = looks ? witnessed(chip, op) : Result<void>();
        set = set ? written(chip, op) : set;
        if (set && looks && !op.status_.control_ended()) {
          state.stray = true;
        }
      } else {
        set = chip.checks_all() ? guarded(chip, op) : Result<void>();
        if (set && !equal(op.data_ + op.at_, received(op) + 2, part(op))) {
          doubt(chip);
          set = Error::kCorrupted;
        }
      }
      if (!set) {
        return set;
      }
      if (state.stray && chip.checks_all()) {
        return Error::kCorrupted;  // it may take these bytes; the next access begins with BREAK
      }
      if (op.stage_ == kSet) {
        add_access(chip, op);
        return {};
      }
      op.at_ += part(op);
      if (op.at_ < op.count_) {
        add_back(chip, op);
      } else {
        add_request(chip, op);
      }
      return {};
    }
    case kRecover: {
      const Result<void> done = recovered(chip, op);
      if (!has_recovered(done, op)) {
        return done;
      }
      if (op.bad_ != 0) {
        op.bad_ = 0;
        add_start(chip, op);
        if (chip.checks_all()) {
          op.stage_ = kRestarted;
          return {};
        }
        chip.started(now_us);
      }
      add_request(chip, op);
      return {};
    }
    case kRestarted:
      if (const Result<void> done = confirmed_start(chip, op); !done) {
        return done;
      }
      chip.started(now_us);
      add_request(chip, op);
      return {};
    case kStart: {
      if (state.stray && chip.checks_all()) {
        return Error::kCorrupted;  // a read since then may have changed the request in the chip
      }
      state.access_us = now_us;
      op.limit_.begin(now_us, access_us(chip));
      if (state.biss_b) {
        state.agserr_at_start = !look(op) || op.status_.start_error();
      } else if (chip.automatic && chip.checks_all()) {
        // REGEND falls with the instruction, and reads 0 while it waits. If it is still 1, the
        // instruction was lost and the access before would count as this one; or this access has
        // failed at once (nREGERR = 0). One disturbed status must not hide an access that runs.
        const Result<void> seen = look(op);
        state.suspect = state.suspect || (!seen && op.good_);
        const bool lost = seen && op.status_.control_ended() && !op.status_.control_error();
        // A disturbed SWBANK or HOLDBANK: the next read drops the words that wait. Where reads
        // write no 0xF4 beside an access, none can.
        bool stuck =
            seen && (op.status_.get<regs::SWBANK>() | op.status_.get<regs::HOLDBANK>()) != 0;
        if (stuck && chip.config.hold_beside_access) {
          chip.watch.held = true;
          stuck = false;
        }
        // AGS = 0 in what was written has made one frame, now, and the next read would begin
        // others. An error of the line ends AGS too.
        if (seen && op.status_.get<regs::AGS>() == 0 && !op.status_.start_error()) {
          return Error::kCorrupted;
        }
        if (!seen || lost || stuck) {
          if (op.made_ != 1) {
            mb4_cyclic_add_status(&op.plan_);
            return {};
          }
          if (!seen) {
            return seen;
          }
          if (lost) {
            state.kind = ControlState::Kind::kNone;
            return not_begun(chip, op, Error::kCorrupted);
          }
          return Error::kCorrupted;
        }
      }
      again(op, now_us);
      return {};
    }
    case kNextFrame:
      op.limit_.begin(now_us, chip.frame_us);
      again(op, now_us);
      return {};
    case kPoll:
    case kPollAgain:
      return poll(chip, op, now_us);
    case kTake: {
      if (chip.checks_all()) {
        if (state.stray) {
          return not_taken(chip);  // a read since the end may have changed RDATA
        }
        if (const Result<void> seen = witnessed(chip, op); !seen) {
          return seen.error() == Error::kCorrupted ? not_taken(chip) : seen;
        }
      }
      const std::uint8_t* from = received(op) + 2;
      std::uint8_t* to = op.out_ + op.at_;
      for (std::uint8_t* end = to + part(op); to != end;) {
        *to++ = *from++;
      }
      if (chip.checks_all()) {
        add_read(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), part(op));
        add_witness(op);
        op.stage_ = kTakeAgain;
        return {};
      }
      return taken(chip, op);
    }
    case kTakeAgain: {
      const Result<void> seen = witnessed(chip, op);
      if (seen.error() == Error::kNotDetected) {
        return seen;
      }
      // An access that a disturbed byte has started meanwhile has read register 0 into RDATA1.
      if (seen && (op.at_ != 0 || *op.out_ == state.first) &&
          equal(op.out_ + op.at_, received(op) + 2, part(op))) {
        return taken(chip, op);
      }
      doubt(chip);
      return not_taken(chip);
    }
    case kFirst: {
      const Result<void> seen = witnessed(chip, op);
      if (!seen && seen.error() != Error::kCorrupted && ++op.bad_ != kBadLooks) {
        add_first(op);
        return {};
      }
      op.bad_ = 0;
      state.first = seen ? received(op)[2] : std::uint8_t{0};
      add_end(chip, op);
      return {};
    }
    case kRest:
      if (!op.good_ && ++op.bad_ != kBadLooks) {
        add_end(chip, op);
        return {};
      }
      if (!rested(chip, op)) {
        return {};
      }
      if (state.suspect) {
        doubt(chip);
      }
      if (state.armed) {
        return op.cause_;
      }
      if (!chip.automatic && chip.checks_all()) {
        add_clear(chip, op);
        return {};
      }
      chip.recover_first = chip.automatic;
      return ended(chip, op);
    case kClear: {
      const Result<void> cleared = clear_step(chip, op, now_us);
      if (op.plan_.frames == 0) {
        // Otherwise the next frame begins with BREAK.
        chip.recover_first = !cleared || op.cause_.error() == Error::kCorrupted;
        return ended(chip, op);
      }
      return {};
    }
    default: {  // kStopped: an error that came before stays the result
      if (!rested(chip, op)) {
        return {};
      }
      const Error cause = op.cause_.error();
      const bool last = cause == Error::kNone || cause == Error::kTimeout;
      return !op.good_ && last ? Result<void>(Error::kTransport) : op.cause_;
    }
  }
}

// What stands in RDATA need not be what the slave has answered.
inline Result<void> Procedures::not_taken(ChipState& chip) {
  chip.control.readable = 0;
  chip.control.waits = false;
  return Error::kCorrupted;
}

// A part of the registers is here.
inline Result<void> Procedures::taken(ChipState& chip, Operation& op) {
  op.at_ += part(op);
  if (op.at_ < op.count_) {
    add_take(chip, op);
  } else if (op.at_ == chip.control.readable) {
    chip.control.waits = false;
  }
  return {};
}

// Has the access ended, or the frame?
inline Result<void> Procedures::poll(ChipState& chip, Operation& op, std::uint32_t now_us) {
  ControlState& state = chip.control;
  const Status before = op.status_;
  if (const Result<void> seen = look(op); !seen) {
    state.suspect = state.suspect || op.good_;
    if (++op.bad_ >= kBadLooks) {
      return seen;
    }
    again(op, now_us);
    return {};
  }
  const Status& status = op.status_;
  const bool frame_over = status.instruction_done() && (chip.automatic || status.idle());
  // Where several frames follow each other, REGEND = 1 in the first one may still belong to the
  // access before. In BiSS B the BREAK at the beginning has reset REGEND.
  const bool alone = chip.automatic || state.biss_b;
  const bool stale = !alone && state.first_frame;
  if (frame_over && status.control_ended() && !stale) {
    const bool decides = !state.biss_b || state.first_frame || op.limit_.over;
    // One disturbed bit must not end the access, nor hide how it has ended.
    if (decides && chip.checks_all() && !(op.stage_ == kPollAgain && agrees(chip, op, before))) {
      if (++op.bad_ > kBadLooks) {
        return Error::kCorrupted;
      }
      add_poll(op);
      op.stage_ = kPollAgain;
      return {};
    }
    // Now the slaves' register timeout runs. The line does not show its end.
    if (state.biss_b && state.first_frame) {
      // nAGSERR = 0 has two possible causes. (1) No slave has taken part in the hand-over; then the
      // access has lasted as long as the chip's limit. (2) The chip sets nAGSERR = 0 at each write
      // of 0xF4 (page 34 can be read so), which the status directly after the instruction shows;
      // then the time decides. A quarter of the limit separates the two, because the internal
      // oscillator may be faster than f_clk_hz says (D05).
      state.no_hand_over =
          status.start_error() && (!state.agserr_at_start ||
                                   now_us - state.access_us >= register_limit_us(chip.config) / 4);
      state.first_frame = false;
      op.bad_ = 0;
      op.limit_.begin(now_us, chip.config.register_timeout_us);
      again(op, now_us);
      return {};
    }
    if (decides) {
      return conclude(chip, op);
    }
    again(op, now_us);
    return {};
  }
  op.bad_ = 0;
  if (!op.limit_.over) {
    if (alone || !frame_over) {
      again(op, now_us);
      return {};
    }
    // One disturbed bit must not make a frame more: it would run the whole access again.
    if (chip.checks_all() && op.stage_ != kPollAgain) {
      add_poll(op);
      op.stage_ = kPollAgain;
      return {};
    }
    state.first_frame = false;
    if (!enough_frames(chip, now_us)) {
      ++state.frames;
      add_instruction(op, kControlFrame);
      op.stage_ = kNextFrame;
      if (chip.config.frame_start != FrameStart::kWaitForLine) {
        // The chip refuses a frame before the slaves' timeout is over (activate()).
        op.plan_.pause_us = kLineRecoveryUs + kClockStepUs;
      }
      return {};
    }
  }
  add_abort(chip, op, Error::kTimeout);
  return {};
}

// The status tells of the end what the one `before` has told. Beside automatic frames nAGSERR may
// change at any time.
inline bool Procedures::agrees(const ChipState& chip, const Operation& op, const Status& before) {
  const unsigned end = regs::REGEND::kMask | regs::nREGERR::kMask | regs::nDELAYERR::kMask |
                       (chip.automatic ? 0U : unsigned{regs::nAGSERR::kMask});
  const Status& status = op.status_;
  return ((status.bytes()[0] ^ before.bytes()[0]) & end) == 0 &&
         status.bytes()[3] == before.bytes()[3] && status.instruction() == before.instruction();
}

// The access has ended; how?
inline Result<void> Procedures::conclude(ChipState& chip, Operation& op) {
  ControlState& state = chip.control;
  // 0x08, the instruction of a frame, and 0x09, which begins automatic frames, differ in one bit.
  if (chip.checks_all() && !chip.automatic && op.status_.instruction() != 0) {
    return Error::kCorrupted;
  }
  // A read whose bytes were disturbed may have changed RDATA.
  const ErrorInfo error = chip.checks_all() && state.stray
                              ? ErrorInfo(Error::kCorrupted)
                              : access_error(chip, state.kind, op.status_);
  op.cause_ = error;
  state.readable = error.code == Error::kNone && state.kind == ControlState::Kind::kRead
                       ? state.count
                       : std::uint8_t{0};
  state.waits = state.readable != 0;
  state.kind = ControlState::Kind::kNone;
  state.ended = true;
  op.bad_ = 0;
  if (chip.checks_all() && state.readable != 0) {
    add_first(op);
  } else {
    add_end(chip, op);
  }
  return {};
}

// RDATA1, before another request may stand in the chip: take() compares it. A disturbed opcode that
// writes makes them differ.
inline void Procedures::add_first(Operation& op) {
  op.stage_ = kFirst;
  add_read(op, regs::kAddrRdata, 1, 0x5A);
  add_witness(op);
}

// Without AGS the frames of the access have set SVALID, and the next single frame needs SVALID = 0,
// which SpiCheck::kFull proves in a step of its own behind this one;
// where the chip would refuse it before the slaves' timeout is over, this time passes first. With
// AGS the reads of positions clear the flags.
inline void Procedures::add_end(const ChipState& chip, Operation& op) {
  op.stage_ = kRest;
  if (!chip.automatic) {
    if (!chip.checks_all()) {
      mb4_cyclic_add_clear(&op.plan_, chip.sensor_flags, 4);
    }
    if (chip.config.frame_start != FrameStart::kWaitForLine) {
      op.plan_.pause_us = kLineRecoveryUs + kClockStepUs;
    }
  }
  add_rest(chip, op);
}

inline Result<void> Procedures::ended(ChipState& chip, Operation& op) {
  if (op.cause_ && chip.control.readable != 0 && op.out_ != nullptr) {
    op.at_ = 0;
    add_take(chip, op);
  }
  return op.cause_;
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_ACCESS_HPP_
