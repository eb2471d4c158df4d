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

// A procedure consists of a function that plans its first frames, and of its step, which looks at
// what came back, adds the frames of the next step, and returns success or an error. It ends when
// it adds no frame. A program has only the procedures that it begins. The blocking calls are loops
// over the same steps (Chip::run()).
struct Procedures {
  // Where an operation is: what the frames do that are made now.
  enum Stage : std::uint8_t {
    kRecover,    // send BREAK; the slaves need their timeout afterwards
    kRestarted,  // an access: BREAK has stopped automatic frames, and they run again
    kStart,      // the first frames of the operation's own
    kPoll,       // read the status until what was started has ended
    kPollAgain,  // an access: a second read of the status must say "ended" too
    kLines,      // read the lines until SL is 1
    kFill,       // an access: RDATA or IDS; an actuator: its word; all registers
    kCompare,    // an access: RDATA or IDS is read back
    kSet,        // an access: 0xE2..0xE5; an actuator: 0xF4
    kNextFrame,  // an access: the next frame
    kDelays,     // INIT: what it has measured; a configuration: REVISION, VERSION
    kClear,      // SVALID = 0
    kTake,       // an access: RDATA; a single frame: its data; an actuator: the other bank's word
    kTakeAgain,  // ... once more
    kProof,      // a single frame, a configuration: the status after what was read
    kFirst,      // an access that has ended: RDATA1
    kRest,       // ... the request at rest
    kStopped,    // BREAK; the result is known
    kBlank       // a single frame: a word is all 0; read the lines until SL is 1
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
    op.request_[0] = instruction;
    add_stopping(chip, op);
  }
  // BREAK also ends what the request has begun. With SpiCheck::kFull the status follows: 0xF4 is 0.
  static void add_stopping(const ChipState& chip, Operation& op) {
    const std::uint8_t instruction = op.request_[0];
    op.stage_ = kStopped;
    add_instruction(op, instruction);
    if (instruction != 0 && chip.control.armed) {
      add_rest(chip, op);
    }
    if (chip.checks_all()) {
      op.stage_ = kProof;
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

  // ---- An access whose caller polls: control_steps.hpp ----

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
  static constexpr std::uint32_t kBadLooks = 3;

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
    op.bad_ = 0;
    op.cause_ = {};
  }

  // BREAK, at kRecover. With SpiCheck::kFull it also writes 0xF5, the register after 0xF4: the
  // failed transfer may have been a read of the status that reached the chip as a write; then
  // SVALID = 0, and a witness follows. Afterwards recovered().
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
  [[gnu::noinline]] static Result<void> recovered(ChipState& chip, Operation& op) {
    if (chip.checks_all()) {
      const Result<void> seen = look(op);
      const bool first = op.made_ != 1;
      if (!seen) {
        return seen;
      }
      if (first && chip.control.armed && !rests(chip, op, 1)) {
        doubt(chip);
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
  static bool has_recovered(const Result<void>& done, const Operation& op) {
    return done && op.stage_ != kRecover;
  }

  static void add_instruction(Operation& op, std::uint8_t instruction) {
    mb4_cyclic_add_instruction(&op.plan_, instruction);
  }

  // AGS = 1. With SpiCheck::kFull the words of both banks are dropped, because a disturbed byte
  // before may have switched them. What drops them may reach the request, or 0xF5, by one bit of
  // its address: both are read back, with a witness: confirmed_start().
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
  [[gnu::noinline]] static Result<void> confirmed_start(ChipState& chip, Operation& op) {
    const Result<void> done = confirmed(chip, op, regs::AGS::encode<1>());
    if (done && chip.checks_all() && (interface_changed(chip, op) || !rests(chip, op, 1))) {
      doubt(chip);
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
  // Reads back what it writes: written().
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
  static void doubt(ChipState& chip) { chip.set_waits(ChipState::kForProof, chip.checks_all()); }
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
  // With SpiCheck::kFull it reads back what it writes: same().
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
  [[gnu::noinline]] static bool rests(const ChipState& chip, const Operation& op, unsigned behind) {
    return differs_at(chip, regs::kAddrRegadr, received(op, behind) + 2, kRestBytes, false) ==
           kNowhere;
  }
  // add_rest() was made. False: frames are still to be made. With SpiCheck::kFull a request that
  // differs is read again. If it differs once more the write has failed, and may have reached
  // another register: it is sent again, and op.cause_ becomes kCorrupted. If that fails, or a
  // transfer, control.armed stays, which makes the next call send it; until then nothing may start
  // what was asked for once more.
  [[gnu::noinline]] static bool rested(ChipState& chip, Operation& op) {
    const bool set = op.good_ && (!chip.checks_all() || rests(chip, op, 0));
    if (!set && op.good_ && ++op.bad_ < kBadLooks) {
      if (op.bad_ == 1) {
        doubt(chip);
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

  static void again(Operation& op, std::uint32_t now_us) {
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
  [[gnu::noinline]] static Result<void> look(Operation& op) {
    if (!op.good_) {
      return Error::kTransport;
    }
    const std::uint8_t* rx = received(op);
    const std::array<std::uint8_t, Status::kBytes> bytes{rx[1], rx[2], rx[3], rx[4], rx[5]};
    op.status_ = Status(bytes);
    return op.status_.plausible() ? Error::kNone : Error::kNotDetected;
  }

  [[gnu::noinline]] static bool equal(const std::uint8_t* one, const std::uint8_t* other,
                                      unsigned size) {
    for (; size > 0; --size) {
      if (*one++ != *other++) {
        return false;
      }
    }
    return true;
  }

  // What was read, with a witness behind it, has come from the chip, and nothing but a read has
  // gone there. The frame of the witness is taken away. kNotDetected; kCorrupted, with doubt().
  [[gnu::noinline]] static Result<void> witnessed(ChipState& chip, Operation& op) {
    const Result<void> seen = look(op);
    if (!seen) {
      // 0x05 may have become 0x07, which writes 0 to 0xF4 and 0xF5.
      if (op.good_) {
        doubt(chip);
      }
      return seen;
    }
    const unsigned instruction = op.status_.instruction();
    const bool other = chip.automatic ? (instruction & regs::AGS::kMask) == 0
                                      : (instruction & ~unsigned{regs::SWBANK::kMask}) != 0;
    const bool changed = other || interface_changed(chip, op);
    --op.made_;
    if (changed) {
      doubt(chip);
    }
    return changed ? Error::kCorrupted : Error::kNone;
  }

  // With SpiCheck::kFull: witnessed() and equals(), beside automatic frames written(). kTransport.
  [[gnu::noinline]] static Result<void> same(ChipState& chip, Operation& op) {
    if (!op.good_ || !chip.checks_all()) {
      return op.good_ ? Error::kNone : Error::kTransport;
    }
    const Result<void> seen = witnessed(chip, op);
    return !seen ? seen : chip.automatic ? written(chip, op) : equals(op);
  }
  // equals(), and with SpiCheck::kFull doubt() where it differs.
  static Result<void> written(ChipState& chip, const Operation& op) {
    const Result<void> result = equals(op);
    if (result.error() == Error::kCorrupted) {
      doubt(chip);
    }
    return result;
  }
  // The last two frames belong together: the second has read what the first has written or read.
  // kTransport; kCorrupted: it differs.
  [[gnu::noinline]] static Result<void> equals(const Operation& op) {
    if (!op.good_) {
      return Error::kTransport;
    }
    const std::uint8_t first = static_cast<std::uint8_t>(op.made_ - 2);
    const std::uint8_t* before =
        mb4_plan_reads(&op.plan_, first) ? received(op, 1) : mb4_plan_tx(&op.plan_, first);
    return equal(before + 2, received(op) + 2, op.plan_.size[first] - 2U) ? Error::kNone
                                                                          : Error::kCorrupted;
  }

  // After a good transfer: SL of the channels in use is 1, as it must be after the slaves' timeout.
  // Otherwise it looks again, for a while. kLineError: a line is stuck low.
  [[gnu::noinline]] static Result<void> lines(const ChipState& chip, Operation& op,
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
    const Result<void> done = breaks ? recovered(chip, op) : confirmed_start(chip, op);
    if (breaks && has_recovered(done, op)) {
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
    const Result<void> seen = look(op);
    // A disturbed address makes an instruction of the bytes: 0xF1 and 0xF3 differ in one bit.
    const bool other = op.status_.instruction() != 0;
    if (!seen || ((op.status_.valid_flags() & chip.sensor_flags) == 0 && !other)) {
      return seen;
    }
    if (op.made_ == 1 || other) {
      doubt(chip);
      return Error::kCorrupted;
    }
    mb4_cyclic_add_status(&op.plan_);
    return {};
  }

  // An instruction that has not come, or come as another one, is sent once more.
  static Result<void> stop_step(ChipState& chip, Operation& op, std::uint32_t /*now_us*/) {
    const bool rests = op.request_[0] != 0 && chip.control.armed;
    if (op.stage_ == kProof && op.good_) {
      const Result<void> seen = look(op);
      if (!seen || op.status_.instruction() != 0) {
        if (op.at_ != 0) {
          return seen ? Error::kCorrupted : seen;
        }
        op.at_ = 1;
        add_stopping(chip, op);
        return {};
      }
      --op.made_;
      op.stage_ = kStopped;
    }
    if (rests) {
      return rested(chip, op) ? op.cause_ : Result<void>();
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
  // Parts of configuration.hpp, initialization.hpp,
  static void add_image(ChipState& chip, Operation& op);
  static void add_compared(Operation& op, std::uint8_t address);
  static void plan_proof(ChipState& chip, Operation& op, const Result<void>& cause);
  static Result<void> configure(ChipState& chip, Operation& op);
  static void prepare(ChipState& chip, Operation& op);
  static void begin_look(ChipState& chip, Operation& op);
  // ... single_frame.hpp,
  static void add_request_frame(Operation& op);
  static Result<void> await_frame(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> frame(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> frame_over(ChipState& chip, Operation& op);
  static Result<void> frame_ended(ChipState& chip, Operation& op);
  static void add_stop(ChipState& chip, Operation& op, Error cause);
  static Result<void> stopped_step(ChipState& chip, Operation& op, std::uint32_t now_us);
  // ... actuator.hpp,
  static void add_word(ChipState& chip, Operation& op, std::uint32_t stage);
  static void add_confirmed(ChipState& chip, Operation& op, std::uint8_t instruction,
                            std::uint32_t stage);
  static Result<void> confirmed(ChipState& chip, Operation& op, std::uint8_t want);
  static void add_held(ChipState& chip, Operation& op);
  static void add_release(ChipState& chip, Operation& op, const Result<void>& cause);
  static void add_other(Operation& op, std::uint32_t now_us);
  // ... and access.hpp.
  static void add_request(ChipState& chip, Operation& op);
  static bool looks_for_strays(const ChipState& chip);
  static void add_back(ChipState& chip, Operation& op);
  static Result<void> guarded(ChipState& chip, Operation& op);
  static std::uint8_t part(const Operation& op);
  static void add_take(ChipState& chip, Operation& op);
  static void begin_access(ChipState& chip, Operation& op, bool biss_b);
  static void begin_command(ChipState& chip, Operation& op, const Command& command);
  static void begin_activate(ChipState& chip, Operation& op, std::uint8_t ids_1,
                             std::uint8_t ids_2);
  static void add_abort(ChipState& chip, Operation& op, const Result<void>& cause);
  static void add_first(Operation& op);
  static void add_end(const ChipState& chip, Operation& op);
  static bool agrees(const ChipState& chip, const Operation& op, const Status& before);
  static Result<void> not_begun(ChipState& chip, Operation& op, const Result<void>& cause);
  static void add_access(ChipState& chip, Operation& op);
  static Result<void> access(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> poll(ChipState& chip, Operation& op, std::uint32_t now_us);
  static Result<void> conclude(ChipState& chip, Operation& op);
  static Result<void> taken(ChipState& chip, Operation& op);
  static Result<void> not_taken(ChipState& chip);
  static Result<void> ended(ChipState& chip, Operation& op);
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_PROCEDURES_HPP_
