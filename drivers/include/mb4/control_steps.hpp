// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Control communication step by step (datasheet pages 16, 27 to 29, 34, 35): registers of the
// slaves and commands, with and without automatic frames. Used through Control.

#ifndef MB4_CONTROL_STEPS_HPP_
#define MB4_CONTROL_STEPS_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/checked_registers.hpp"
#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/control_checks.hpp"
#include "mb4/control_data.hpp"
#include "mb4/control_pace.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// One access at a time, so that the caller does something else between the frames:
//
//   device.control().begin_read({1, 0}, 0x78, 8);
//   while (!*device.control().poll()) { ... }                // errors left out here
//   device.control().take(id);
//
// With automatic frames the access runs beside them, 47 frames for one register; poll() only looks.
// Without them each poll() that finds a frame ended starts the next one; its data is dropped.
//
// The channel's protocol decides what the chip does with the same calls:
//  * BiSS C: as above.
//  * BiSS B: in register mode no frame runs, on either channel, so automatic frames must be stopped
//    (kWrongMode); left out, they would hide a failed hand-over, as both show in nAGSERR. Begins
//    with BREAK, 100 us and register_timeout_us, and ends register_timeout_us behind the last bit.
//    Slave ID 0 is unused with Config::mo. No commands.
//  * SSI (extended): register writes and broadcasts, blind: the encoder has no means to answer, so
//    success says only that everything was sent. Reading is kUnsupported.
//
// Errors of all begin calls, which touch nothing unless said: kNotConfigured; kBusy (one is
// running); kInvalidArgument; kUnsupported with kFrameStart (without automatic frames
// FrameStart::kWaitForLine is needed, because the frames follow each other at once) or with
// kChannelProtocol (the protocol has no such access); kWrongMode (BiSS B beside automatic frames);
// kTransport (touched: parts of the request are in the chip, the access may run; abort() it);
// with SpiCheck::kFull, which reads back what it has written by as many transfers, kCorrupted
// (touched: the access does not run).
template <typename Bus, typename Clock>
class ControlSteps : private ControlChecks<Bus, Clock> {
 public:
  using ControlChecks<Bus, Clock>::ControlChecks;

  // Begins to read `count` (1..64) registers from `address`; address + count <= 128. Two transfers.
  Result<void> begin_read(SlaveAddress slave, std::uint8_t address, std::size_t count) {
    if (const Result<void> possible = Checks::check_access(slave, address, count, Protocol::kSsi);
        !possible) {
      return possible;
    }
    return begin_access(slave, regs::REGADR::insert(0, address), count, Kind::kRead);
  }

  // Begins to write data.size() (1..64) registers; the data is in the chip when the call returns.
  // Three transfers.
  Result<void> begin_write(SlaveAddress slave, std::uint8_t address,
                           Span<const std::uint8_t> data) {
    if (const Result<void> possible =
            Checks::check_access(slave, address, data.size(), Protocol::kUnused);
        !possible) {
      return possible;
    }
    if (const Result<void> filled = detail::write_checked(chip_, regs::kAddrRdata, data); !filled) {
      return filled;
    }
    return begin_access(slave, regs::WNR::insert(regs::REGADR::insert(0, address), 1), data.size(),
                        Kind::kWrite);
  }

  // Begins a command. Three transfers.
  Result<void> begin_command(const Command& command) {
    if (const Result<void> free = Checks::check_free(); !free) {
      return free;
    }
    const bool broadcast = command.ids == 0;
    if (command.channels < 1 || command.channels > 3 || command.code > regs::CMD::kMax ||
        (broadcast && (command.test_acknowledge || command.code == regs::CMD::kMax))) {
      return Error::kInvalidArgument;
    }
    for (std::uint8_t channel = 1; channel <= kChannels; ++channel) {
      const Result<void> possible = (command.channels & channel) == 0
                                        ? Result<void>()
                                        : Checks::check_protocol(channel, Protocol::kBissB);
      if (!possible) {
        return possible;
      }
    }
    const std::uint8_t ids = detail::reversed(command.ids);  // IDS0 is bit 7 (table 32)
    if (const Result<void> addressed =
            detail::write_checked(chip_, regs::kAddrIds, Span<const std::uint8_t>(&ids, 1));
        !addressed) {
      return addressed;
    }
    std::uint8_t control =
        regs::CMD::insert(detail::encode_ctrl(chip_.config, false), command.code);
    control = regs::IDA_TEST::insert(control, command.test_acknowledge ? 1 : 0);
    const std::array<std::uint8_t, 2> bytes{command.channels, control};
    if (const Result<void> set = detail::write_checked(chip_, regs::kAddrChsel, bytes); !set) {
      return set;
    }
    return begin(Kind::kCommand, 1, false);
  }

  // One look at what was begun; never waits. At most three transfers: status; then, without
  // automatic frames, the next frame's instruction, or at the end SVALID = 0. Call it until it
  // returns true or an error.
  //
  // False: still running. True: ended well; after a read take() the registers.
  // kRegister, kRegisterDelay (with ErrorInfo::bytes), kCommand: ended, the chip is ready for the
  // next one. kTimeout: BREAK was sent. kTransport, kNotDetected: still running, as far as one can
  // tell; poll again or abort(). kWrongMode: nothing was begun.
  //
  // Time: register_busy_us and the frames needed, by the clock with automatic frames; without them
  // frame_timeout_us() for each frame, and when all frames needed have run register_busy_us.
  Result<bool> poll() {
    if (chip_.control.kind == Kind::kNone) {
      return Error::kWrongMode;
    }
    detail::ControlState& state = chip_.control;
    // Looked at before the status: who was suspended does not report a timeout without a look.
    const bool late =
        --state.polls_left == 0 || chip_.clock->now_us() - state.start_us >= state.timeout_us;
    Status status;
    if (const Result<void> look = chip_.look(status); !look) {
      state.polls_left += state.polls_left == 0 ? 1 : 0;
      return look.failure();
    }
    const bool frame_over = status.instruction_done() && (chip_.automatic || status.idle());
    // REGEND = 1 after the first of several frames is the last access's. In BiSS B BREAK has reset
    // it.
    const bool alone = chip_.automatic || state.biss_b;
    const bool stale = !alone && state.first_frame;
    if (frame_over && status.control_ended() && !stale) {
      // The slaves' register timeout, which the line does not show.
      if (state.biss_b && state.first_frame) {
        state.first_frame = false;
        detail::restart_time(chip_, chip_.config.register_timeout_us);
        return false;
      }
      if (state.biss_b && !late) {
        return false;
      }
      return finish(status);
    }
    if (late) {
      return give_up();
    }
    if (alone || !frame_over) {
      return false;
    }
    state.first_frame = false;
    if (detail::enough_frames(chip_)) {
      return give_up();
    }
    ++state.frames;
    detail::restart_time(chip_, frame_timeout_us(chip_.config));
    if (const Result<void> next = chip_.write_instruction(kFrame); !next) {
      return next.failure();
    }
    return false;
  }

  // The registers that the last read has fetched; out.size() 1 up to their number. One transfer.
  // kInvalidArgument (not touched): more than there are, or the last access was no good read, or
  // something else was begun since. kTransport; kCorrupted: read twice (SpiCheck::kFull) and not
  // the same.
  Result<void> take(Span<std::uint8_t> out) {
    if (out.empty() || out.size() > chip_.control.readable) {
      return Error::kInvalidArgument;
    }
    return detail::read_checked(chip_, regs::kAddrRdata, out);
  }

  // BREAK: ends an access at once, whatever it has done so far in the slave. Automatic frames stop
  // as well; Automatic::next() or restart() sets them going again. One transfer. kTransport.
  Result<void> abort() {
    const bool restart = chip_.automatic || chip_.restart;
    chip_.recover_first = true;
    const Result<void> stopped = chip_.write_break();
    chip_.restart = restart;
    return stopped;
  }

 protected:
  // Something was begun and has not ended.
  [[nodiscard]] bool running() const { return chip_.control.kind != Kind::kNone; }

 private:
  using Checks = ControlChecks<Bus, Clock>;
  using Checks::chip_;
  using Kind = detail::ControlState::Kind;

  static constexpr std::uint8_t kFrame =
      regs::INSTR::encode<static_cast<std::uint8_t>(regs::Instr::kControl)>();

  Result<void> begin_access(SlaveAddress slave, std::uint8_t regadr, std::size_t count, Kind kind) {
    const bool biss_b = Checks::is_biss_b(slave.channel);
    const std::uint8_t control = regs::CTS::insert(
        regs::SLAVEID::insert(detail::encode_ctrl(chip_.config, biss_b), slave.id), 1);
    // CHSEL is one-hot: 1 and 2 are the codes of the channels.
    const std::array<std::uint8_t, 4> bytes{regadr, static_cast<std::uint8_t>(count - 1),
                                            slave.channel, control};
    if (const Result<void> set = detail::write_checked(chip_, regs::kAddrRegadr, bytes); !set) {
      return set;
    }
    return begin(kind, count, biss_b);
  }

  Result<void> begin(Kind kind, std::size_t count, bool biss_b) {
    detail::ControlState& state = chip_.control;
    // A frame of a failed read may still run and take the instruction for the next. BiSS B: REGEND
    // and nAGSERR shall be about this access.
    if (biss_b || (!chip_.automatic && chip_.recover_first)) {
      if (const Result<void> recovered = chip_.recover(); !recovered) {
        return recovered;
      }
    }
    chip_.recover_first = true;
    const std::uint8_t registers = static_cast<std::uint8_t>(count);
    state.readable = 0;
    state.kind = kind;
    state.count = registers;
    state.biss_b = biss_b;
    state.first_frame = true;
    state.frames = 1;
    state.access_us = chip_.clock->now_us();
    std::uint32_t timeout_us = frame_timeout_us(chip_.config);
    if (biss_b) {
      timeout_us = detail::biss_b_timeout_us(chip_.config, registers);
    } else if (chip_.automatic) {
      timeout_us = detail::control_timeout_us(chip_.config, registers);
    }
    detail::restart_time(chip_, timeout_us);
    return chip_.write_instruction(
        chip_.automatic ? static_cast<std::uint8_t>(kFrame | regs::AGS::encode<1>()) : kFrame);
  }

  Result<bool> finish(const Status& status) {
    detail::ControlState& state = chip_.control;
    const Kind kind = state.kind;
    state.kind = Kind::kNone;
    // Without AGS the frames have set SVALID, and the next single frame wants it clear. Otherwise
    // the flags belong to Automatic.
    if (!chip_.automatic) {
      if (const Result<void> clear = chip_.clear_valid(chip_.sensors); clear) {
        chip_.recover_first = false;
      }
    }
    ErrorInfo error;
    // Nobody has taken part in the hand-over, which ends at the chip's limit. The time tells from
    // nAGSERR = 0 at each write of 0xF4 (page 34 can be read so); a quarter because of D05.
    if (state.biss_b && status.start_error() &&
        chip_.clock->now_us() - state.access_us >= detail::register_limit_us(chip_.config) / 4) {
      return Error::kRegister;
    }
    if (status.delay_error() && kind != Kind::kCommand) {
      error = Error::kRegisterDelay;
    } else if (status.control_error()) {
      error = kind == Kind::kCommand ? Error::kCommand : Error::kRegister;
    }
    if (error.code != Error::kNone) {
      error.detail = kind == Kind::kCommand ? std::uint8_t{0} : status.get<regs::REGBYTES>();
      return error;
    }
    state.readable = kind == Kind::kRead ? state.count : std::uint8_t{0};
    return true;
  }

  Result<bool> give_up() {
    const Result<void> stopped = abort();
    return stopped ? Result<bool>(Error::kTimeout) : Result<bool>(stopped.failure());
  }
};

}  // namespace mb4

#endif  // MB4_CONTROL_STEPS_HPP_
