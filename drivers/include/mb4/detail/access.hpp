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
  op.restarts_ = restart;
  if (restart) {
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
    op.stage_ = kData;
    add_bytes(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), op.data_ + op.at_,
              part_size(op));
    if (looks_at_words(chip, op)) {
      add_read(op, static_cast<std::uint8_t>(regs::kAddrScdata + op.at_), part_size(op), 1);
    }
    return;
  }
  // A command leaves 0xE2 and 0xE3 as they are.
  const std::uint8_t from = state.kind == ControlState::Kind::kCommand ? 2 : 0;
  op.stage_ = kRequest;
  state.armed = true;
  add_proven(op, static_cast<std::uint8_t>(regs::kAddrRegadr + from), &op.request_[from],
             kRequestBytes - from);
  if (looks_for_strays(chip)) {
    add_witness(op);
  }
}

// 0x80 and 0x00 differ in one bit: a part may go to the SCDATAx of a sensor instead of RDATA.
inline bool Procedures::looks_at_words(const ChipState& chip, const Operation& op) {
  static_assert(Operation::kPart == regs::kScdataStride, "a part is that of one slave");
  return chip.automatic && chip.checks_all() &&
         (unsigned{chip.sensors} >> op.at_ / Operation::kPart & 1U) != 0;
}

// A disturbed byte of a read that has ended well may have begun an access (0x01 and 0x09, INSTR =
// 100): its end would count as that of this one. REGEND = 1 says that none runs.
inline bool Procedures::looks_for_strays(const ChipState& chip) {
  return chip.automatic && chip.checks_all() && chip.control.ended;
}

// All parts are read back when all are written: a disturbed address may have put one into another
// one's place (0x88 and 0x80).
inline void Procedures::add_data_back(ChipState& chip, Operation& op) {
  op.stage_ = kDataBack;
  add_read(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), part_size(op));
  if (chip.checks_all()) {
    add_read(op, static_cast<std::uint8_t>(kImageFirst + op.at_), part_size(op));
    add_witness(op);
  }
}

// RDATA may hold the bytes from before, and then reads back right although the write went to the
// configuration: 0x80 and 0xC0 differ in one bit. The witness has looked at 0xF4 and 0xF5.
inline Result<void> Procedures::take_image_guard(ChipState& chip, Operation& op) {
  Result<void> seen = take_witness(chip, op);
  const unsigned from = kImageFirst + static_cast<unsigned>(op.at_);
  const unsigned size = from + part_size(op) <= regs::kAddrStatus0 ? part_size(op) : 0U;
  if (seen && differs_at(chip, from, received(op) + 2, size, true) != kNowhere) {
    begin_doubt(chip);
    seen = Error::kCorrupted;
  }
  --op.made_;
  return seen;
}

// Bytes of the next frame.
inline std::uint8_t Procedures::part_size(const Operation& op) {
  const std::uint8_t left = static_cast<std::uint8_t>(op.count_ - op.at_);
  return left < Operation::kPart ? left : Operation::kPart;
}

// The part was read back as it was written.
inline bool Procedures::part_is_back(const Operation& op) {
  return bytes_equal(op.data_ + op.at_, received(op) + 2, part_size(op));
}

// Takes `count` registers that an access has read.
inline void Procedures::plan_take(ChipState& chip, Operation& op, std::uint8_t* out,
                                  std::size_t count) {
  begin(chip, op, access_step);
  chip.control.owner = &op;
  op.out_ = out;
  op.count_ = count;
  add_registers(chip, op);
}

// With SpiCheck::kFull each part is read in two steps, each with a witness. A disturbed opcode that
// writes makes them differ: it writes the filler while the chip answers 0.
inline void Procedures::add_registers(ChipState& chip, Operation& op) {
  op.stage_ = kRegisters;
  const bool full = chip.checks_all();
  add_read(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), part_size(op),
           full ? MB4_CYCLIC_FILLER : 0);
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
  op.failures_ = 0;
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
inline Result<void> Procedures::abandon_request(ChipState& chip, Operation& op,
                                                const Result<void>& cause) {
  if (!chip.control.armed) {
    return cause;
  }
  add_rest(chip, op);
  op.stage_ = kStopped;
  op.failures_ = 0;
  op.cause_ = cause;
  return {};
}

inline Result<void> Procedures::access_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  // abort(), BREAK, configure() or another access has ended this one meanwhile.
  if (chip.control.owner != &op) {
    return Error::kWrongMode;
  }
  chip.set_waits(ChipState::kForRequest, false);
  if (op.good_ && chip.automatic && chip.checks_all() && reads_zeros(op)) {
    chip.watch.held = true;
  }
  const Result<void> done = access_stage(chip, op, now_us);
  if (done || chip.control.kind == ControlState::Kind::kNone) {
    return done;
  }
  if (op.stage_ == kRecover || (op.stage_ >= kRestarted && op.stage_ <= kRequest)) {
    // Nothing was begun. But the write may have reached other registers, 0xF4 among them.
    chip.control.kind = ControlState::Kind::kNone;
    chip.restart = chip.automatic || chip.restart;
    chip.control.stray = chip.control.stray || chip.checks_all();
    const bool fills = op.stage_ == kData || op.stage_ == kDataBack;
    chip.control.armed = chip.control.armed || fills;
    return abandon_request(chip, op, done);
  }
  clear_plan(op);
  add_abort(chip, op, done);
  return {};
}

// The stage judges a failed transfer itself.
inline bool Procedures::takes_failure(std::uint32_t stage) {
  return stage == kPoll || stage == kClear || stage == kStopped || stage >= kPollAgain;
}

// A reading that is all 0 may be none: a disturbed opcode makes it a write (0x03, 0x0B and 0x02),
// and its bytes may have reached the SCDATAx of a sensor. The word that waits may be no word of the
// encoder, although its CRC fits: the next read drops it.
inline bool Procedures::reads_zeros(const Operation& op) {
  for (std::uint8_t i = 0; i < op.made_; ++i) {
    if (mb4_plan_tx(&op.plan_, i)[0] == MB4_CYCLIC_READ &&
        is_zero(mb4_plan_rx(&op.plan_, i) + 2, op.plan_.size[i] - 2U)) {
      return true;
    }
  }
  return false;
}

// One stage: what its frames have brought, and the frames of the next one.
inline Result<void> Procedures::access_stage(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (!op.good_ && !takes_failure(op.stage_)) {
    return Error::kTransport;
  }
  switch (op.stage_) {
    case kRecover:
      return take_access_recovery(chip, op, now_us);
    case kRestarted:
      return take_access_restart(chip, op, now_us);
    case kData:
      take_data(chip, op);
      return {};
    case kDataBack:
      return take_data_back(chip, op);
    case kRequest:
      return take_request_back(chip, op);
    case kStart:
      return take_access_start(chip, op, now_us);
    case kNextFrame:
      op.limit_.begin(now_us, chip.frame_us);
      add_next_poll(op, now_us);
      return {};
    case kPoll:
    case kPollAgain:
      return take_access_status(chip, op, now_us);
    case kFirst:
      return take_first_register(chip, op);
    case kRest:
      return take_end(chip, op);
    case kClear:
      return take_access_clear(chip, op, now_us);
    case kRegisters:
      return take_registers(chip, op);
    case kRegistersAgain:
      return take_registers_again(chip, op);
    default:
      return take_access_abort(chip, op);
  }
}

// BREAK was sent, and automatic frames start anew if it has stopped them.
inline Result<void> Procedures::take_access_recovery(ChipState& chip, Operation& op,
                                                     std::uint32_t now_us) {
  const Result<void> done = take_recovery(chip, op);
  if (!recovery_is_over(done, op)) {
    return done;
  }
  if (op.restarts_) {
    op.restarts_ = false;
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

inline Result<void> Procedures::take_access_restart(ChipState& chip, Operation& op,
                                                    std::uint32_t now_us) {
  const Result<void> done = take_start(chip, op);
  if (done) {
    chip.started(now_us);
    add_request(chip, op);
  }
  return done;
}

// A part of RDATA or IDS was written.
inline void Procedures::take_data(ChipState& chip, Operation& op) {
  // If the bytes are in SCDATAx, a word that waits may be no word of the encoder, although its CRC
  // fits: the next read drops it.
  if (looks_at_words(chip, op) && part_is_back(op)) {
    chip.watch.held = true;
  }
  op.at_ += part_size(op);
  if (op.at_ < op.count_) {
    add_request(chip, op);
  } else {
    op.at_ = 0;
    add_data_back(chip, op);
  }
}

// A part of RDATA or IDS was read back.
inline Result<void> Procedures::take_data_back(ChipState& chip, Operation& op) {
  Result<void> set = chip.checks_all() ? take_image_guard(chip, op) : Result<void>();
  if (set && !part_is_back(op)) {
    begin_doubt(chip);
    set = Error::kCorrupted;
  }
  if (!set) {
    return set;
  }
  if (stray_takes_request(chip)) {
    return Error::kCorrupted;
  }
  op.at_ += part_size(op);
  if (op.at_ < op.count_) {
    add_data_back(chip, op);
  } else {
    add_request(chip, op);
  }
  return {};
}

// 0xE2..0xE5 were written and read back.
inline Result<void> Procedures::take_request_back(ChipState& chip, Operation& op) {
  const bool looks = looks_for_strays(chip);
  Result<void> set = looks ? take_witness(chip, op) : Result<void>();
  set = set ? take_readback(chip, op) : set;
  if (!set) {
    return set;
  }
  if (looks && !op.status_.control_ended()) {
    chip.control.stray = true;
  }
  if (stray_takes_request(chip)) {
    return Error::kCorrupted;
  }
  add_access(chip, op);
  return {};
}

// An access that nobody asked for may take the bytes of this one; the next access begins with
// BREAK.
inline bool Procedures::stray_takes_request(const ChipState& chip) {
  return chip.control.stray && chip.checks_all();
}

// The instruction was written.
inline Result<void> Procedures::take_access_start(ChipState& chip, Operation& op,
                                                  std::uint32_t now_us) {
  ControlState& state = chip.control;
  if (state.stray && chip.checks_all()) {
    return Error::kCorrupted;  // a read since then may have changed the request in the chip
  }
  state.access_us = now_us;
  op.limit_.begin(now_us, access_us(chip));
  if (state.biss_b) {
    state.agserr_at_start = !take_status(op) || op.status_.start_error();
  } else if (chip.automatic && chip.checks_all()) {
    const Result<void> begun = take_start_status(chip, op);
    if (!begun || op.plan_.frames != 0) {
      return begun;
    }
  }
  add_next_poll(op, now_us);
  return {};
}

// Beside automatic frames, with SpiCheck::kFull: has the chip got the instruction? Success without
// frames: it has. REGEND falls with the instruction, and reads 0 while it waits. If it is still 1,
// the instruction was lost and the access before would count as this one; or this access has failed
// at once (nREGERR = 0). One disturbed status must not hide an access that runs.
inline Result<void> Procedures::take_start_status(ChipState& chip, Operation& op) {
  ControlState& state = chip.control;
  const Result<void> seen = take_status(op);
  state.suspect = state.suspect || (!seen && op.good_);
  const bool lost = seen && op.status_.control_ended() && !op.status_.control_error();
  // A disturbed SWBANK or HOLDBANK: the next read drops the words that wait. Where reads write no
  // 0xF4 beside an access, none can.
  bool stuck = seen && (op.status_.get<regs::SWBANK>() | op.status_.get<regs::HOLDBANK>()) != 0;
  if (stuck && chip.config.hold_beside_access) {
    chip.watch.held = true;
    stuck = false;
  }
  // AGS = 0 in what was written has made one frame, now, and the next read would begin others. An
  // error of the line ends AGS too.
  if (seen && op.status_.get<regs::AGS>() == 0 && !op.status_.start_error()) {
    return Error::kCorrupted;
  }
  if (seen && !lost && !stuck) {
    return {};
  }
  if (op.made_ != 1) {
    mb4_cyclic_add_status(&op.plan_);
    return {};
  }
  if (!seen) {
    return seen;
  }
  if (lost) {
    state.kind = ControlState::Kind::kNone;
    return abandon_request(chip, op, Error::kCorrupted);
  }
  return Error::kCorrupted;
}

// The access has ended, and RDATA1 was read.
inline Result<void> Procedures::take_first_register(ChipState& chip, Operation& op) {
  const Result<void> seen = take_witness(chip, op);
  if (!seen && seen.error() != Error::kCorrupted && ++op.failures_ != kMostFailures) {
    add_first_register(op);
    return {};
  }
  op.failures_ = 0;
  chip.control.first = seen ? received(op)[2] : std::uint8_t{0};
  add_end(chip, op);
  return {};
}

// The access has ended, and the request at rest was written.
inline Result<void> Procedures::take_end(ChipState& chip, Operation& op) {
  if (!op.good_ && ++op.failures_ != kMostFailures) {
    add_end(chip, op);
    return {};
  }
  if (!take_rest(chip, op)) {
    return {};
  }
  if (chip.control.suspect) {
    begin_doubt(chip);
  }
  if (chip.control.armed) {
    return op.cause_;
  }
  if (!chip.automatic && chip.checks_all()) {
    add_clear(chip, op);
    return {};
  }
  chip.recover_first = chip.automatic;
  return end_access(chip, op);
}

// The same, and SVALID = 0.
inline Result<void> Procedures::take_access_clear(ChipState& chip, Operation& op,
                                                  std::uint32_t now_us) {
  const Result<void> cleared = clear_step(chip, op, now_us);
  if (op.plan_.frames != 0) {
    return {};
  }
  // Otherwise the next frame begins with BREAK.
  chip.recover_first = !cleared || op.cause_.error() == Error::kCorrupted;
  return end_access(chip, op);
}

// A part of RDATA was read.
inline Result<void> Procedures::take_registers(ChipState& chip, Operation& op) {
  if (chip.checks_all()) {
    if (chip.control.stray) {
      return lose_registers(chip);  // a read since the end may have changed RDATA
    }
    if (const Result<void> seen = take_witness(chip, op); !seen) {
      return seen.error() == Error::kCorrupted ? lose_registers(chip) : seen;
    }
  }
  const std::uint8_t* from = received(op) + 2;
  std::uint8_t* to = op.out_ + op.at_;
  for (std::uint8_t* end = to + part_size(op); to != end;) {
    *to++ = *from++;
  }
  if (chip.checks_all()) {
    add_read(op, static_cast<std::uint8_t>(regs::kAddrRdata + op.at_), part_size(op));
    add_witness(op);
    op.stage_ = kRegistersAgain;
    return {};
  }
  keep_registers(chip, op);
  return {};
}

inline Result<void> Procedures::take_registers_again(ChipState& chip, Operation& op) {
  const Result<void> seen = take_witness(chip, op);
  if (seen.error() == Error::kNotDetected) {
    return seen;
  }
  // An access that a disturbed byte has started meanwhile has read register 0 into RDATA1.
  if (seen && (op.at_ != 0 || *op.out_ == chip.control.first) &&
      bytes_equal(op.out_ + op.at_, received(op) + 2, part_size(op))) {
    keep_registers(chip, op);
    return {};
  }
  begin_doubt(chip);
  return lose_registers(chip);
}

// BREAK or the request at rest was sent: an error that came before stays the result.
inline Result<void> Procedures::take_access_abort(ChipState& chip, Operation& op) {
  if (!take_rest(chip, op)) {
    return {};
  }
  const Error cause = op.cause_.error();
  const bool last = cause == Error::kNone || cause == Error::kTimeout;
  return !op.good_ && last ? Result<void>(Error::kTransport) : op.cause_;
}

// What stands in RDATA need not be what the slave has answered.
inline Result<void> Procedures::lose_registers(ChipState& chip) {
  chip.control.readable = 0;
  chip.control.waits = false;
  return Error::kCorrupted;
}

// A part of the registers is here.
inline void Procedures::keep_registers(ChipState& chip, Operation& op) {
  op.at_ += part_size(op);
  if (op.at_ < op.count_) {
    add_registers(chip, op);
  } else if (op.at_ == chip.control.readable) {
    chip.control.waits = false;
  }
}

// Has the access ended, or the frame?
inline Result<void> Procedures::take_access_status(ChipState& chip, Operation& op,
                                                   std::uint32_t now_us) {
  const ControlState& state = chip.control;
  const Status before = op.status_;
  if (const Result<void> seen = take_status(op); !seen) {
    chip.control.suspect = chip.control.suspect || op.good_;
    if (++op.failures_ >= kMostFailures) {
      return seen;
    }
    add_next_poll(op, now_us);
    return {};
  }
  const Status& status = op.status_;
  // A disturbed release of the bank has swapped the banks: the next read drops what waits.
  if (chip.checks_all() && status.get<regs::SWBANK>() != 0) {
    chip.watch.held = true;
  }
  const bool frame_over = status.instruction_done() && (chip.automatic || status.idle());
  // Where several frames follow each other, REGEND = 1 in the first one may still belong to the
  // access before. In BiSS B the BREAK at the beginning has reset REGEND.
  const bool alone = chip.automatic || state.biss_b;
  const bool stale = !alone && state.first_frame;
  if (frame_over && status.control_ended() && !stale) {
    return take_regend(chip, op, before, now_us);
  }
  op.failures_ = 0;
  if (!op.limit_.over) {
    if (alone || !frame_over) {
      add_next_poll(op, now_us);
      return {};
    }
    if (take_frame_end(chip, op, now_us)) {
      return {};
    }
  }
  add_abort(chip, op, Error::kTimeout);
  return {};
}

// REGEND = 1: the access has ended. One disturbed bit must not end it, nor hide how it has ended.
inline Result<void> Procedures::take_regend(ChipState& chip, Operation& op, const Status& before,
                                            std::uint32_t now_us) {
  const ControlState& state = chip.control;
  const bool decides = !state.biss_b || state.first_frame || op.limit_.over;
  if (decides && chip.checks_all() &&
      !(op.stage_ == kPollAgain && statuses_agree(chip, op, before))) {
    if (++op.failures_ > kMostFailures) {
      return Error::kCorrupted;
    }
    add_poll(op);
    op.stage_ = kPollAgain;
    return {};
  }
  if (state.biss_b && state.first_frame) {
    begin_register_timeout(chip, op, now_us);
    return {};
  }
  if (decides) {
    return conclude_access(chip, op);
  }
  add_next_poll(op, now_us);
  return {};
}

// BiSS B: now the slaves' register timeout runs. The line does not show its end.
//
// nAGSERR = 0 has two possible causes. (1) No slave has taken part in the hand-over; then the
// access has lasted as long as the chip's limit. (2) The chip sets nAGSERR = 0 at each write of
// 0xF4 (page 34 can be read so), which the status directly after the instruction shows; then the
// time decides. A quarter of the limit separates the two, because the internal oscillator may be
// faster than f_clk_hz says (D05).
inline void Procedures::begin_register_timeout(ChipState& chip, Operation& op,
                                               std::uint32_t now_us) {
  ControlState& state = chip.control;
  state.no_hand_over =
      op.status_.start_error() &&
      (!state.agserr_at_start || now_us - state.access_us >= register_limit_us(chip.config) / 4);
  state.first_frame = false;
  op.failures_ = 0;
  op.limit_.begin(now_us, chip.config.register_timeout_us);
  add_next_poll(op, now_us);
}

// Without automatic frames a frame of the access is over. False: no other one may follow. One
// disturbed bit must not make a frame more: it would run the whole access again.
inline bool Procedures::take_frame_end(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (chip.checks_all() && op.stage_ != kPollAgain) {
    add_poll(op);
    op.stage_ = kPollAgain;
    return true;
  }
  chip.control.first_frame = false;
  if (enough_frames(chip, now_us)) {
    return false;
  }
  ++chip.control.frames;
  add_instruction(op, kControlFrame);
  op.stage_ = kNextFrame;
  if (chip.config.frame_start != FrameStart::kWaitForLine) {
    // The chip refuses a frame before the slaves' timeout is over (activate()).
    op.plan_.pause_us = kLineRecoveryUs + kClockStepUs;
  }
  return true;
}

// The status tells of the end what the one `before` has told. Beside automatic frames nAGSERR may
// change at any time.
inline bool Procedures::statuses_agree(const ChipState& chip, const Operation& op,
                                       const Status& before) {
  const unsigned end = regs::REGEND::kMask | regs::nREGERR::kMask | regs::nDELAYERR::kMask |
                       (chip.automatic ? 0U : unsigned{regs::nAGSERR::kMask});
  const Status& status = op.status_;
  return ((status.bytes()[0] ^ before.bytes()[0]) & end) == 0 &&
         status.bytes()[3] == before.bytes()[3] && status.instruction() == before.instruction();
}

// The access has ended; how?
inline Result<void> Procedures::conclude_access(ChipState& chip, Operation& op) {
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
  op.failures_ = 0;
  if (chip.checks_all() && state.readable != 0) {
    add_first_register(op);
  } else {
    add_end(chip, op);
  }
  return {};
}

// RDATA1, before another request may stand in the chip: take() compares it. A disturbed opcode that
// writes makes them differ.
inline void Procedures::add_first_register(Operation& op) {
  op.stage_ = kFirst;
  add_read(op, regs::kAddrRdata, 1, MB4_CYCLIC_FILLER);
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

inline Result<void> Procedures::end_access(ChipState& chip, Operation& op) {
  if (op.cause_ && chip.control.readable != 0 && op.out_ != nullptr) {
    op.at_ = 0;
    add_registers(chip, op);
  }
  return op.cause_;
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_ACCESS_HPP_
