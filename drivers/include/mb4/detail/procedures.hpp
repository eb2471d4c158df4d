// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The operations in steps, without bus and clock: what all of them share.

#ifndef MB4_DETAIL_PROCEDURES_HPP_
#define MB4_DETAIL_PROCEDURES_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/detail/chip_state.hpp"
#include "mb4/error.hpp"
#include "mb4/operation.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

[[nodiscard]] inline bool is_zero(const std::uint8_t* bytes, unsigned size) {
  while (size > 0 && *bytes == 0) {
    ++bytes;
    --size;
  }
  return size == 0;
}

// A procedure consists of a function that plans its first frames, and of its step, which looks at
// what came back, adds the frames of the next step, and returns success or an error. It ends when
// it adds no frame. A program has only the procedures that it begins. The blocking calls are loops
// over the same steps (Chip::run()).
struct Procedures {
  // Where an operation is: what the frames do that are made now. Those of one kind of operation
  // have the same numbers as those of another one.
  enum Stage : std::uint8_t {
    kRecover,  // BREAK; the slaves need their timeout afterwards
    kStart,    // the first frames of the operation's own
    kPoll,     // the status, until what was started has ended
    kLines,    // the lines, until SL is 1
    kClear,    // SVALID = 0
    kStopped,  // BREAK, or what else ends the operation; the result is known
    kOwn,
    // An access.
    kRestarted = kOwn,  // BREAK has stopped automatic frames, and they run again
    kData,              // RDATA or IDS is written
    kDataBack,          // RDATA or IDS is read back
    kRequest,           // 0xE2..0xE5
    kNextFrame,         // the next frame
    kRegisters,         // RDATA is read
    kRegistersAgain,    // RDATA is read once more
    kPollAgain,         // a second read of the status must say "ended" too
    kFirst,             // it has ended: RDATA1
    kRest,              // it has ended: the request at rest
    // INIT.
    kProtocol = kOwn,  // SCDATA1 and SCDATA5 = 0, REGVERS
    kEmptied,          // the same without REGVERS
    kDelays,           // what it has measured
    kBadWord,          // the frame at its end: a word that was bad
    // A configuration.
    kIdentity = kOwn,  // REVISION, VERSION
    kImage,            // all registers are written
    // A single frame.
    kWords = kOwn,  // its data
    kWordsAgain,    // its data once more
    kFrameStatus,   // the status after what was read
    kBlank,         // a word is all 0; the lines until SL is 1
    // AGS = 0 or BREAK.
    kStopStatus = kOwn,  // the status after it
    // An actuator.
    kHold = kOwn,  // HOLDBANK = 1
    kWord,         // its word
    kOtherWord,    // the word of the other bank
    kSwitched,     // SWBANK = 1
    kSecondWord    // the word, in the second bank
  };

  // What came back is here. True: the operation has ended. False: there are other frames to make.
  [[gnu::noinline]] static bool finish(ChipState& chip, Operation& op, bool transferred,
                                       std::uint32_t now_us) {
    if (op.step_ == nullptr) {
      return true;
    }
    op.made_ = op.plan_.frames;
    op.good_ = transferred;
    clear_plan(op);
    const Result<void> result =
        op.chip_ == &chip ? op.step_(chip, op, now_us) : Result<void>(Error::kWrongMode);
    if (op.plan_.frames != 0) {
      return false;
    }
    if (chip.in_doubt() && chip.configured && op.chip_ == &chip && op.step_ != proof_step) {
      plan_proof(chip, op, result);
      return false;
    }
    op.step_ = nullptr;
    op.result_ = result;
    return true;
  }

  // Success, or why the plan call is not possible: `allowed`, or kBusy if the operation of the
  // object has not ended.
  [[gnu::always_inline]] static Result<void> possible(const Operation& op, Result<void> allowed) {
    return allowed && op.step_ != nullptr ? Result<void>(Error::kBusy) : allowed;
  }

  // The same, also for chip.own, which a blocking call may always take.
  [[gnu::always_inline]] static Result<void> possible_in(const ChipState& chip, const Operation& op,
                                                         const Result<void>& allowed) {
    return &op == &chip.own ? allowed : possible(op, allowed);
  }

  // ---- Automatic frames: automatic.hpp ----

  // Sets AGS = 1, after BREAK if need be.
  static void plan_start(ChipState& chip, Operation& op) {
    begin(chip, op, start_step);
    if (chip.recover_first) {
      add_recovery(chip, op);
    } else {
      add_start(chip, op);
    }
    // The next single frame begins with BREAK, because an automatic frame may still run then.
    chip.recover_first = true;
  }

  template <std::uint8_t With>
  static void prepare_restart(ChipState& chip) {
    chip.automatic = false;
    chip.recover_first = true;
    chip.restart = true;
    if ((With & MB4_WITH_COUNTS) != 0 && chip.watch.counts != nullptr) {
      ++chip.watch.counts->restarts;
    }
  }

  // AGS = 0, or BREAK: `instruction`. Nothing runs afterwards, or it ends by itself.
  static void plan_stop(ChipState& chip, Operation& op, std::uint8_t instruction, bool restart) {
    begin(chip, op, stop_step);
    chip.stopped();
    chip.restart = restart;
    chip.recover_first = true;
    op.instruction_ = instruction;
    add_stopping(chip, op);
  }
  // BREAK also ends what the request has begun. With SpiCheck::kFull the status follows: 0xF4 is 0.
  static void add_stopping(const ChipState& chip, Operation& op) {
    const std::uint8_t instruction = op.instruction_;
    op.stage_ = kStopped;
    add_instruction(op, instruction);
    if (instruction != 0 && chip.control.armed) {
      add_rest(chip, op);
    }
    if (chip.checks_all()) {
      op.stage_ = kStopStatus;
      mb4_cyclic_add_status(&op.plan_);
    }
  }

  // ---- The others: configuration.hpp, initialization.hpp, single_frame.hpp, actuator.hpp,
  // access.hpp ----

  static void plan_verify(ChipState& chip, Operation& op);
  static void plan_configure(ChipState& chip, Operation& op, const Config& config);
  static void plan_reset(ChipState& chip, Operation& op);
  static void plan_frame(ChipState& chip, Operation& op, ReadSteps& read, const mb4_word* words,
                         std::uint8_t count);
  static void plan_wait(ChipState& chip, Operation& op);
  static Result<void> plan_actuator(ChipState& chip, Operation& op, std::uint8_t slave,
                                    std::uint64_t word, bool both_banks);
  static void plan_initialize(ChipState& chip, Operation& op);
  static Result<void> plan_access(ChipState& chip, Operation& op, SlaveAddress slave,
                                  std::uint8_t address, const std::uint8_t* data, std::uint8_t* out,
                                  std::size_t count);
  static Result<void> plan_command(ChipState& chip, Operation& op, const Command& command);
  static Result<void> plan_activate(ChipState& chip, Operation& op, std::uint8_t ids_1,
                                    std::uint8_t ids_2);
  static void plan_take(ChipState& chip, Operation& op, std::uint8_t* out, std::size_t count);

  // ---- An access whose caller polls: c/mb4_c_access.hpp ----

  // The access has begun, and the next step reads the status for the first time after a frame.
  static bool polls(const Operation& op) { return op.step_ != nullptr && op.stage_ == kPoll; }
  // A read of positions has just seen that the access runs, and its time is not over.
  static bool seen_running(ChipState& chip, Operation& op, std::uint32_t now_us) {
    const bool seen = !op.limit_.look(now_us) && chip.control.seen_running;
    chip.control.seen_running = false;
    return seen;
  }

 private:
  // Times that a step which may fail is tried, one after the other. One disturbed status must not
  // stop an access, and automatic frames with it.
  static constexpr std::uint32_t kMostFailures = 3;

  // ---- Frames ----

  static void clear_plan(Operation& op) {
    op.plan_.frames = 0;
    op.plan_.pause_us = 0;
  }

  [[gnu::noinline]] static void begin(ChipState& chip, Operation& op, Operation::Step step) {
    mb4_plan_memory(&op.plan_, op.tx_.data(), op.rx_.data());
    clear_plan(op);
    op.step_ = step;
    op.chip_ = &chip;
    op.result_ = Error::kBusy;
    op.stage_ = kStart;
    op.at_ = 0;
    op.failures_ = 0;
    op.cause_ = {};
  }

  // BREAK, at kRecover. With SpiCheck::kFull it also writes 0xF5, the register after 0xF4: the
  // failed transfer may have been a read of the status that reached the chip as a write; then
  // SVALID = 0, and a witness follows. Afterwards take_recovery().
  [[gnu::noinline]] static void add_recovery(ChipState& chip, Operation& op) {
    op.stage_ = kRecover;
    chip.stopped();
    const bool full = chip.checks_all();
    mb4_plan_add(&op.plan_, full ? 3 : 2, MB4_CYCLIC_INSTRUCT, regs::BREAK::encode<1>(),
                 chip.interface_byte);
    if (full) {
      mb4_cyclic_add_clear(&op.plan_, chip.sensor_flags, 4);
    }
    if (chip.control.armed) {
      add_rest(chip, op);
    }
    if (full) {
      add_witness(op);
    }
  }
  // The frames that follow come after the slaves' timeout. Without SpiCheck::kFull the first one
  // clears the flags of frames that ran. Success with frames of stage kRecover: one more look.
  // kTransport; with SpiCheck::kFull kNotDetected; kCorrupted: 0xF4 or SVALID is not 0, 0xF5 is
  // not as it was written, or the request at rest does not stand (the next call sends it again);
  // kTimeout: EOT = 0, a frame still runs, or there is no system clock.
  [[gnu::noinline]] static Result<void> take_recovery(ChipState& chip, Operation& op) {
    if (chip.checks_all()) {
      const Result<void> seen = take_status(op);
      const bool first = op.made_ != 1;
      if (!seen) {
        return seen;
      }
      if (first && chip.control.armed && !rest_stands(chip, op, 1)) {
        begin_doubt(chip);
        return Error::kCorrupted;
      }
      if (op.status_.instruction() != 0 || (first && interface_changed(chip, op))) {
        return Error::kCorrupted;
      }
      const bool valid = (op.status_.valid_flags() & chip.sensor_flags) != 0;
      if (valid || !op.status_.idle()) {
        if (first) {
          mb4_cyclic_add_status(&op.plan_);
          return {};
        }
        return op.status_.idle() ? Error::kCorrupted : Error::kTimeout;
      }
    } else if (!op.good_) {
      return Error::kTransport;
    }
    chip.control.armed = false;
    op.plan_.pause_us = chip.recovery_us();
    op.stage_ = kStart;
    if (!chip.checks_all()) {
      mb4_cyclic_add_clear(&op.plan_, chip.sensor_flags, 4);
    }
    return {};
  }
  // Nothing of a recovery remains to be made.
  static bool recovery_is_over(const Result<void>& done, const Operation& op) {
    return done && op.stage_ != kRecover;
  }

  static void add_instruction(Operation& op, std::uint8_t instruction) {
    mb4_cyclic_add_instruction(&op.plan_, instruction);
  }

  // AGS = 1. With SpiCheck::kFull the words of both banks are dropped, because a disturbed byte
  // before may have switched them. What drops them may reach the request, or 0xF5, by one bit of
  // its address: both are read back, with a witness: take_start().
  static void add_start(const ChipState& chip, Operation& op) {
    add_instruction(op, regs::AGS::encode<1>());
    if (chip.checks_all()) {
      mb4_cyclic_add_clear(&op.plan_, chip.sensor_flags, 4);
      mb4_cyclic_add_clear(&op.plan_, chip.sensor_flags, 4); /* one may be lost */
      add_read(op, regs::kAddrRegadr, kRestBytes);
      add_witness(op);
    }
  }
  // add_start() was made. kTransport, kNotDetected; kCorrupted: the frames do not run, or the
  // clears have changed something else; then the next call begins with BREAK and the request at
  // rest.
  [[gnu::noinline]] static Result<void> take_start(ChipState& chip, Operation& op) {
    const Result<void> done = take_instruction(chip, op, regs::AGS::encode<1>());
    if (done && chip.checks_all() && (interface_changed(chip, op) || !rest_stands(chip, op, 1))) {
      begin_doubt(chip);
      chip.control.armed = true;
      return Error::kCorrupted;
    }
    return done;
  }
  // Reads `size` registers. A bus that stores nothing must not turn an old answer into a new one:
  // the first byte is 0, and no longer that of the answer before.
  [[gnu::noinline]] static void add_read(Operation& op, std::uint8_t address, std::size_t size,
                                         std::uint8_t filler = 0) {
    mb4_plan_add(&op.plan_, static_cast<std::uint8_t>(size + 2), MB4_CYCLIC_READ, address, filler);
    mb4_plan_rx(&op.plan_, static_cast<std::uint8_t>(op.plan_.frames - 1))[2] = 0;
  }
  [[gnu::noinline]] static void add_bytes(Operation& op, std::uint8_t address,
                                          const std::uint8_t* data, std::size_t size) {
    std::uint8_t* tx = mb4_plan_add(&op.plan_, 2, MB4_CYCLIC_WRITE, address, 0) + 2;
    op.plan_.size[op.plan_.frames - 1] = static_cast<std::uint8_t>(size + 2);
    for (const std::uint8_t* end = data + size; data != end;) {
      *tx++ = *data++;
    }
  }
  // Reads back what it writes: take_readback().
  [[gnu::noinline]] static void add_proven(Operation& op, std::uint8_t address,
                                           const std::uint8_t* data, std::size_t size) {
    add_bytes(op, address, data, size);
    add_read(op, address, size);
  }
  // The witness: status and 0xF5, behind readings whose right answer may be 0. A read whose opcode
  // was disturbed is an instruction (0x03 and 0x07), and reads 0: its address has reached 0xF4, its
  // filler 0xF5. A line that is stuck looks like no status.
  static constexpr std::uint8_t kWitnessBytes = 2 + Status::kBytes;
  static void add_witness(Operation& op) {
    mb4_plan_add(&op.plan_, kWitnessBytes, MB4_CYCLIC_STATUS, 0, 0);
  }
  // The last frame was a witness: 0xF5 is not as configure() has written it.
  static bool interface_changed(const ChipState& chip, const Operation& op) {
    return received(op)[kWitnessBytes - 1] != chip.interface_byte;
  }
  // Something that was read back differs. The write may have reached another register, among them
  // the configuration, and a read whose opcode was disturbed is an instruction (0x03 and 0x07): no
  // position is read until the operation has compared all and seen 0xF4, in finish().
  static void begin_doubt(ChipState& chip) {
    chip.set_waits(ChipState::kForProof, chip.checks_all());
  }
  // The first of `size` registers that is not as it was written, of those that are compared while a
  // control communication is `running`.
  static constexpr unsigned kNowhere = 0x100;
  [[gnu::noinline]] static unsigned differs_at(const ChipState& chip, unsigned address,
                                               const std::uint8_t* is, unsigned size,
                                               bool running) {
    const std::uint8_t* want = &chip.image[address - kImageFirst];
    for (; size != 0; --size, ++address) {
      if (*is++ != *want++ && is_compared(address, running)) {
        return address;
      }
    }
    return kNowhere;
  }
  // REVISION and VERSION are constant. 0xE0, 0xE1 and 0xEE are reserved, and the datasheet does not
  // say what they read. 0xE2..0xE5 change while a control communication is `running`. Status and
  // instruction follow.
  static constexpr bool is_compared(unsigned address, bool running) {
    const bool control = address >= regs::kAddrRegadr && address <= regs::kAddrCtrl;
    return address < regs::kAddrStatus0 && !(control && running) &&
           (address < 0xE0 || address > 0xE1) && address != 0xEE &&
           address != regs::kAddrRevision && address != regs::kAddrVersion;
  }
  // With SpiCheck::kFull it reads back what it writes: take_write().
  [[gnu::noinline]] static void add_write(const ChipState& chip, Operation& op,
                                          std::uint8_t address, const std::uint8_t* data,
                                          std::size_t size) {
    add_bytes(op, address, data, size);
    if (chip.checks_all()) {
      add_read(op, address, size);
    }
  }
  // The request at rest: a read of register 0. A disturbed byte of 0xF4 that starts an access then
  // does no harm (docs/choices.md). It may stand there already, so that a write which has missed it
  // looks as if it had not: with SpiCheck::kFull the registers behind it that one bit of the
  // address reaches, the rate of the frames among them, are read back too.
  static constexpr std::uint8_t kRestBytes = regs::kAddrStatus0 - regs::kAddrRegadr;
  [[gnu::noinline]] static void add_rest(const ChipState& chip, Operation& op) {
    add_bytes(op, regs::kAddrRegadr, request_at_rest(chip), kRequestBytes);
    if (chip.checks_all()) {
      add_read(op, regs::kAddrRegadr, kRestBytes);
    }
  }
  static const std::uint8_t* request_at_rest(const ChipState& chip) {
    return &chip.image[regs::kAddrRegadr - kImageFirst];
  }
  // The frame that was made with `behind` frames after it has read the request at rest, and the
  // registers behind it as they were written.
  [[gnu::noinline]] static bool rest_stands(const ChipState& chip, const Operation& op,
                                            unsigned behind) {
    return differs_at(chip, regs::kAddrRegadr, received(op, behind) + 2, kRestBytes, false) ==
           kNowhere;
  }
  // add_rest() was made. False: frames are still to be made. With SpiCheck::kFull a request that
  // differs is read again. If it differs once more the write has failed, and may have reached
  // another register: it is sent again, and op.cause_ becomes kCorrupted. If that fails, or a
  // transfer, control.armed stays, which makes the next call send it; until then nothing may start
  // what was asked for once more.
  [[gnu::noinline]] static bool take_rest(ChipState& chip, Operation& op) {
    const bool set = op.good_ && (!chip.checks_all() || rest_stands(chip, op, 0));
    if (!set && op.good_ && ++op.failures_ < kMostFailures) {
      if (op.failures_ == 1) {
        begin_doubt(chip);
        add_read(op, regs::kAddrRegadr, kRestBytes);
        return false;
      }
      if (op.cause_) {
        op.cause_ = Error::kCorrupted;
      }
      add_rest(chip, op);
      return false;
    }
    chip.control.armed = !set;
    if (!set) {
      chip.control.readable = 0;
      chip.restart = chip.automatic || chip.restart;
      chip.stopped();
      if (op.cause_) {
        op.cause_ = op.good_ ? Error::kCorrupted : Error::kTransport;
      }
    }
    return true;
  }

  static void add_clear(ChipState& chip, Operation& op) {
    op.stage_ = kClear;
    mb4_cyclic_add_clear(&op.plan_, chip.sensor_flags, 4);
    if (chip.checks_all()) {
      mb4_cyclic_add_status(&op.plan_);
    }
  }

  static void add_poll(Operation& op) {
    op.stage_ = kPoll;
    mb4_cyclic_add_status(&op.plan_);
  }

  static void add_next_poll(Operation& op, std::uint32_t now_us) {
    op.limit_.note(now_us);
    add_poll(op);
  }

  static void add_lines(Operation& op) {
    op.stage_ = kLines;
    mb4_plan_add(&op.plan_, 1 + MB4_CYCLIC_LINES, MB4_CYCLIC_STATUS, 0, 0);
    mb4_plan_rx(&op.plan_, static_cast<std::uint8_t>(op.plan_.frames - 1))[MB4_CYCLIC_LINES] = 0;
  }

  // ---- What came back ----

  // Bytes of the last frame, and of the one `before` it, of the step before.
  static const std::uint8_t* received(const Operation& op, unsigned before = 0) {
    return mb4_plan_rx(&op.plan_, static_cast<std::uint8_t>(op.made_ - 1U - before));
  }

  // The status of the last frame. kTransport; kNotDetected.
  [[gnu::noinline]] static Result<void> take_status(Operation& op) {
    if (!op.good_) {
      return Error::kTransport;
    }
    const std::uint8_t* rx = received(op);
    const std::array<std::uint8_t, Status::kBytes> bytes{rx[1], rx[2], rx[3], rx[4], rx[5]};
    op.status_ = Status(bytes);
    return op.status_.plausible() ? Error::kNone : Error::kNotDetected;
  }

  [[gnu::noinline]] static bool bytes_equal(const std::uint8_t* one, const std::uint8_t* other,
                                            unsigned size) {
    for (; size > 0; --size) {
      if (*one++ != *other++) {
        return false;
      }
    }
    return true;
  }

  // What was read, with a witness behind it, has come from the chip, and nothing but a read has
  // gone there. The frame of the witness is taken away. kNotDetected; kCorrupted, with
  // begin_doubt(). SWBANK: a disturbed release of the bank has swapped the banks, and the next read
  // drops what waits.
  [[gnu::noinline]] static Result<void> take_witness(ChipState& chip, Operation& op) {
    const Result<void> seen = take_status(op);
    if (!seen) {
      // 0x05 may have become 0x07, which writes 0 to 0xF4 and 0xF5.
      if (op.good_) {
        begin_doubt(chip);
      }
      return seen;
    }
    const unsigned instruction = op.status_.instruction();
    const bool other = chip.automatic ? (instruction & regs::AGS::kMask) == 0
                                      : (instruction & ~unsigned{regs::SWBANK::kMask}) != 0;
    if ((instruction & regs::SWBANK::kMask) != 0 && chip.automatic) {
      chip.watch.held = true;
    }
    const bool changed = other || interface_changed(chip, op);
    --op.made_;
    if (changed) {
      begin_doubt(chip);
    }
    return changed ? Error::kCorrupted : Error::kNone;
  }

  // With SpiCheck::kFull: take_witness() and readback_equals(), beside automatic frames
  // take_readback(). kTransport.
  [[gnu::noinline]] static Result<void> take_write(ChipState& chip, Operation& op) {
    if (!op.good_ || !chip.checks_all()) {
      return op.good_ ? Error::kNone : Error::kTransport;
    }
    const Result<void> seen = take_witness(chip, op);
    return !seen ? seen : chip.automatic ? take_readback(chip, op) : readback_equals(op);
  }
  // readback_equals(), and with SpiCheck::kFull begin_doubt() where it differs.
  static Result<void> take_readback(ChipState& chip, const Operation& op) {
    const Result<void> result = readback_equals(op);
    if (result.error() == Error::kCorrupted) {
      begin_doubt(chip);
    }
    return result;
  }
  // The last two frames belong together: the second has read what the first has written or read.
  // kTransport; kCorrupted: it differs.
  [[gnu::noinline]] static Result<void> readback_equals(const Operation& op) {
    if (!op.good_) {
      return Error::kTransport;
    }
    const std::uint8_t first = static_cast<std::uint8_t>(op.made_ - 2);
    const std::uint8_t* before =
        mb4_plan_reads(&op.plan_, first) ? received(op, 1) : mb4_plan_tx(&op.plan_, first);
    return bytes_equal(before + 2, received(op) + 2, op.plan_.size[first] - 2U) ? Error::kNone
                                                                                : Error::kCorrupted;
  }

  // After a good transfer: SL of the channels in use is 1, as it must be after the slaves' timeout.
  // Otherwise it looks again, for a while. kLineError: a line is stuck low.
  [[gnu::noinline]] static Result<void> take_lines(const ChipState& chip, Operation& op,
                                                   std::uint32_t now_us) {
    if ((received(op)[MB4_CYCLIC_LINES] & chip.watch.lines) == chip.watch.lines) {
      return {};
    }
    if (op.limit_.over) {
      return Error::kLineError;
    }
    if (op.limit_.polls_left == 0) {
      op.limit_.begin(now_us, kLineRecoveryUs);
    }
    op.limit_.note(now_us);
    add_lines(op);
    return {};
  }

  // ---- Steps ----

  static Result<void> start_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
    const bool breaks = op.stage_ == kRecover;
    const Result<void> done = breaks ? take_recovery(chip, op) : take_start(chip, op);
    if (breaks && recovery_is_over(done, op)) {
      add_start(chip, op);
    } else if (done && !breaks) {
      chip.started(now_us);
    }
    return done;
  }

  // Without automatic frames.
  [[gnu::noinline]] static Result<void> clear_step(ChipState& chip, Operation& op,
                                                   std::uint32_t /*now_us*/) {
    if (!chip.checks_all()) {
      return {};
    }
    const Result<void> seen = take_status(op);
    // A disturbed address makes an instruction of the bytes: 0xF1 and 0xF3 differ in one bit.
    const bool other = op.status_.instruction() != 0;
    if (!seen || ((op.status_.valid_flags() & chip.sensor_flags) == 0 && !other)) {
      return seen;
    }
    if (op.made_ == 1 || other) {
      begin_doubt(chip);
      return Error::kCorrupted;
    }
    mb4_cyclic_add_status(&op.plan_);
    return {};
  }

  // An instruction that has not come, or come as another one, is sent once more.
  static Result<void> stop_step(ChipState& chip, Operation& op, std::uint32_t /*now_us*/) {
    const bool armed = op.instruction_ != 0 && chip.control.armed;
    if (op.stage_ == kStopStatus && op.good_) {
      const Result<void> seen = take_status(op);
      if (!seen || op.status_.instruction() != 0) {
        if (op.failures_ != 0) {
          return seen ? Error::kCorrupted : seen;
        }
        op.failures_ = 1;
        add_stopping(chip, op);
        return {};
      }
      --op.made_;
      op.failures_ = 0;
      op.stage_ = kStopped;
    }
    if (armed) {
      return take_rest(chip, op) ? op.cause_ : Result<void>();
    }
    return op.good_ ? Error::kNone : Error::kTransport;
  }

  static Result<void> configuration_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> proof_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> frame_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> wait_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> switched_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> held_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> initialize_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> access_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> activate_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> initialize_activate_step(ChipState& chip, Operation& op,
                                               std::uint32_t now_us);
  static Result<void> look_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  // Each stage has a function. One that is called from one place only becomes part of its caller:
  // this takes less flash and less stack on small cores. Parts of configuration.hpp,
  static void add_image(ChipState& chip, Operation& op);
  static void add_compared(const ChipState& chip, Operation& op, std::uint8_t address);
  static bool drops_words(const ChipState& chip, const Operation& op);
  static void plan_proof(ChipState& chip, Operation& op, const Result<void>& cause);
  [[gnu::always_inline]] static Result<void> configuration_stage(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_identity(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_image(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_compared(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_configuration_end(ChipState& chip, Operation& op);
  // initialization.hpp,
  static void add_preparation(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_preparation(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_init_start(ChipState& chip, Operation& op,
                                                             std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_init_status(ChipState& chip, Operation& op,
                                                              std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_init_lines(ChipState& chip, Operation& op,
                                                             std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_delay(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_init_clear(ChipState& chip, Operation& op,
                                                             std::uint32_t now_us);
  static void add_delays(ChipState& chip, Operation& op);
  static void begin_look(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_look_status(ChipState& chip, Operation& op,
                                                              std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_look_lines(ChipState& chip, Operation& op,
                                                             std::uint32_t now_us);
  static void add_bad_words(ChipState& chip, Operation& op);
  // single_frame.hpp,
  static void add_request_frame(Operation& op);
  static Result<void> await_frame(ChipState& chip, Operation& op, std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> frame_stage(ChipState& chip, Operation& op,
                                                         std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_frame_recovery(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_frame_end_status(ChipState& chip, Operation& op,
                                                                   std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_words(ChipState& chip, Operation& op);
  static Result<void> take_words_status(ChipState& chip, Operation& op);
  static Result<void> take_frame_status(ChipState& chip, Operation& op);
  static Result<void> end_frame(ChipState& chip, Operation& op);
  static void add_stop(ChipState& chip, Operation& op, Error cause);
  static Result<void> stopped_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  // actuator.hpp,
  static void add_word(ChipState& chip, Operation& op, std::uint32_t stage);
  static void add_confirmed(ChipState& chip, Operation& op, std::uint8_t instruction,
                            std::uint32_t stage);
  static Result<void> take_instruction(ChipState& chip, Operation& op, std::uint8_t want);
  static void add_held(ChipState& chip, Operation& op);
  static void add_release(ChipState& chip, Operation& op, const Result<void>& cause);
  static void add_other_word(const ChipState& chip, Operation& op, std::uint32_t now_us);
  static void add_mark(ChipState& chip, Operation& op);
  static void drop_beside(ChipState& chip, const Operation& op);
  [[gnu::always_inline]] static void take_hold(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_other_word(ChipState& chip, Operation& op,
                                                             std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_release(ChipState& chip, Operation& op,
                                                          std::uint32_t now_us);
  // and access.hpp.
  static void add_request(ChipState& chip, Operation& op);
  static bool looks_at_words(const ChipState& chip, const Operation& op);
  static bool looks_for_strays(const ChipState& chip);
  [[gnu::always_inline]] static bool stray_takes_request(const ChipState& chip);
  static void add_data_back(ChipState& chip, Operation& op);
  static Result<void> take_image_guard(ChipState& chip, Operation& op);
  static std::uint8_t part_size(const Operation& op);
  static bool part_is_back(const Operation& op);
  static void add_registers(ChipState& chip, Operation& op);
  static void begin_access(ChipState& chip, Operation& op, bool biss_b);
  static void begin_command(ChipState& chip, Operation& op, const Command& command);
  static void begin_activate(ChipState& chip, Operation& op, std::uint8_t ids_1,
                             std::uint8_t ids_2);
  static void add_abort(ChipState& chip, Operation& op, const Result<void>& cause);
  static void add_first_register(Operation& op);
  static void add_end(const ChipState& chip, Operation& op);
  static bool statuses_agree(const ChipState& chip, const Operation& op, const Status& before);
  static Result<void> abandon_request(ChipState& chip, Operation& op, const Result<void>& cause);
  static void add_access(ChipState& chip, Operation& op);
  static bool reads_zeros(const Operation& op);
  static bool takes_failure(std::uint32_t stage);
  [[gnu::always_inline]] static Result<void> access_stage(ChipState& chip, Operation& op,
                                                          std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_access_recovery(ChipState& chip, Operation& op,
                                                                  std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_access_restart(ChipState& chip, Operation& op,
                                                                 std::uint32_t now_us);
  [[gnu::always_inline]] static void take_data(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_data_back(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_request_back(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_access_start(ChipState& chip, Operation& op,
                                                               std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_start_status(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_access_status(ChipState& chip, Operation& op,
                                                                std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_regend(ChipState& chip, Operation& op,
                                                         const Status& before,
                                                         std::uint32_t now_us);
  [[gnu::always_inline]] static void begin_register_timeout(ChipState& chip, Operation& op,
                                                            std::uint32_t now_us);
  [[gnu::always_inline]] static bool take_frame_end(ChipState& chip, Operation& op,
                                                    std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> conclude_access(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_first_register(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_end(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_access_clear(ChipState& chip, Operation& op,
                                                               std::uint32_t now_us);
  [[gnu::always_inline]] static Result<void> take_registers(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_registers_again(ChipState& chip, Operation& op);
  [[gnu::always_inline]] static Result<void> take_access_abort(ChipState& chip, Operation& op);
  static void keep_registers(ChipState& chip, Operation& op);
  static Result<void> lose_registers(ChipState& chip);
  static Result<void> end_access(ChipState& chip, Operation& op);
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_PROCEDURES_HPP_
