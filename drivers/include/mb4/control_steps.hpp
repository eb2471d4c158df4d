// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Control communication step by step: registers of the slaves, and commands, with and without
// automatic frames. Use it through Control.
// Source: datasheet pages 16, 27 to 29, 34, 35.

#ifndef MB4_CONTROL_STEPS_HPP_
#define MB4_CONTROL_STEPS_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/config.hpp"
#include "mb4/detail/access.hpp"
#include "mb4/detail/checked_registers.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/detail/control_checks.hpp"
#include "mb4/detail/control_pace.hpp"
#include "mb4/detail/control_time.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// One access at a time. The caller can do other work between the frames:
//
//   device.control().begin_read({1, 0}, 0x78, 8);
//   while (!*device.control().poll()) { ... }                // errors left out here
//   device.control().take(id);
//
// With automatic frames the access uses these frames: 47 frames for one register. poll() then only
// reads the status. Without automatic frames the host requests each frame: each poll() that finds
// the frame ended starts the next one. The driver drops the data of these frames.
//
// The channel's protocol decides what the chip does with the same calls:
//  * BiSS C: as above.
//  * BiSS B: in register mode no frame runs, on either channel. So automatic frames must be stopped
//    (kWrongMode): an omitted frame would hide a failed hand-over, because both set nAGSERR = 0.
//    The access begins with BREAK and a pause of 100 us + register_timeout_us. It ends
//    register_timeout_us after the last bit. Slave ID 0 is unused with Config::mo. BiSS B has no
//    commands.
//  * SSI (extended): register writes and broadcasts only; reading is kUnsupported. The encoder
//    cannot answer, so success says only that the chip has sent everything.
//
// Errors of all begin calls. The chip is not touched unless the line says so.
//   kNotConfigured, kInvalidArgument
//   kBusy         an access or a command is running
//   kUnsupported  with kFrameStart: without automatic frames FrameStart::kWaitForLine is needed,
//                 because the frames follow each other at once. With kChannelProtocol: the protocol
//                 has no such access
//   kWrongMode    BiSS B while automatic frames run
//   kTransport    touched: parts of the request are in the chip and the access may run; call
//                 abort()
//   kNotDetected  as kTransport; only with SpiCheck::kFull while automatic frames run
//   kCorrupted    touched, the access does not run. Only with SpiCheck::kFull, which reads back
//                 each write: one transfer more for each write of registers, and, while automatic
//                 frames run, one or two for the instruction
template <typename Bus, typename Clock>
class ControlSteps : protected detail::ControlChecks<Bus, Clock> {
 public:
  using detail::ControlChecks<Bus, Clock>::ControlChecks;

  // Begins to read `count` (1..64) registers from `address`; address + count <= 128. `slave`:
  // channel 1 or 2, ID 0..7. Two transfers.
  Result<void> begin_read(SlaveAddress slave, std::uint8_t address, std::size_t count) {
    if (const Result<void> possible = Checks::check_access(slave, address, count, Protocol::kSsi);
        !possible) {
      return possible;
    }
    return begin_access(slave, regs::REGADR::insert(0, address), count, Kind::kRead);
  }

  // Begins to write data.size() (1..64) registers from `address`; address + size <= 128. The data
  // is in the chip when the call returns. Three transfers.
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

  // Begins a command; see Command for the ranges of its members. Three transfers.
  Result<void> begin_command(const Command& command) {
    if (const Result<void> possible = Checks::check_command(command); !possible) {
      return possible;
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

  // Reads the status once and does the next step of what was begun; it never waits. At most three
  // transfers: the status; then, without automatic frames, the next frame's instruction, or at the
  // end SVALID = 0. None if Automatic::poll() or poll_slave() has seen since the last call that the
  // access runs. With SpiCheck::kFull the end is read twice beside these calls. Call it until it
  // returns true or an error.
  //
  //   false                      the access is still running
  //   true                       the access has ended without error; after a read call take()
  //   kRegister, kRegisterDelay  the access has failed (ErrorInfo::bytes says how far it came); the
  //                              chip is ready for the next one
  //   kCommand                   the command was not acknowledged; the chip is ready for the next
  //   kTimeout                   the access has not ended in time; BREAK was sent
  //   kTransport, kNotDetected   the state is unknown, the access may still run; poll again or call
  //                              abort()
  //   kWrongMode                 nothing was begun
  //
  // Time limit, checked by poll(). With automatic frames: the time of the frames needed, plus
  // register_busy_us, by the clock, from the begin call on. Without them the chip makes a frame
  // only when poll() asks for it: frame_timeout_us() for each frame, from its request on, and
  // register_busy_us, from the begin call on, which counts when all frames needed have run. A
  // caller that polls seldom therefore uses up register_busy_us.
  Result<bool> poll() {
    if (chip_.control.kind == Kind::kNone) {
      return Error::kWrongMode;
    }
    detail::ControlState& state = chip_.control;
    // The time is taken before the status is read. A task that was suspended therefore reads the
    // status once more before it reports a timeout.
    const bool late =
        --state.polls_left == 0 || chip_.clock->now_us() - state.start_us >= state.timeout_us;
    if (state.seen_running && !late) {
      state.seen_running = false;
      return false;
    }
    Status status;
    if (const Result<void> look = chip_.look(status); !look) {
      state.polls_left += state.polls_left == 0 ? 1 : 0;
      return look.failure();
    }
    const bool frame_over = status.instruction_done() && (chip_.automatic || status.idle());
    // Where several frames follow each other, REGEND = 1 in the first one may still belong to the
    // access before. In BiSS B the BREAK at the beginning has reset REGEND.
    const bool alone = chip_.automatic || state.biss_b;
    const bool stale = !alone && state.first_frame;
    if (frame_over && status.control_ended() && !stale) {
      // INSTR = 000 tells nothing where a read of positions has written it. One disturbed bit must
      // not end the access.
      if (state.overwritten && chip_.checks_all()) {
        if (const Result<void> look = chip_.look(status); !look || !status.control_ended()) {
          return look ? Result<bool>(false) : Result<bool>(look.failure());
        }
      }
      // Now the slaves' register timeout runs. The line does not show its end.
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
    if (detail::enough_frames(chip_, chip_.clock->now_us())) {
      return give_up();
    }
    ++state.frames;
    detail::restart_time(chip_, chip_.frame_us);
    if (const Result<void> next = chip_.write_instruction(kFrame); !next) {
      return next.failure();
    }
    return false;
  }

  // Copies the registers that the last read has fetched: out.size() is 1 up to their number. One
  // transfer, two with SpiCheck::kFull; the chip is only read.
  // kInvalidArgument (not touched): out.size() is out of range, the last access was no successful
  // read, or another access has begun since. kTransport. kCorrupted: the second reading
  // (SpiCheck::kFull) differs from the first.
  Result<void> take(Span<std::uint8_t> out) {
    if (out.empty() || out.size() > chip_.control.readable) {
      return Error::kInvalidArgument;
    }
    return detail::read_checked(chip_, regs::kAddrRdata, out);
  }

  // Sends BREAK: the access ends at once. Registers of the slave may be changed already. Automatic
  // frames stop as well; Automatic::next() or restart() starts them again. One transfer.
  // kTransport.
  Result<void> abort() {
    const bool restart = chip_.automatic || chip_.restart;
    chip_.recover_first = true;
    const Result<void> stopped = chip_.write_break();
    chip_.restart = restart;
    return stopped;
  }

 protected:
  using Checks = detail::ControlChecks<Bus, Clock>;
  using Checks::chip_;

  // True while an access or a command that was begun has not ended.
  [[nodiscard]] bool running() const { return chip_.control.kind != Kind::kNone; }

 private:
  using Kind = detail::ControlState::Kind;

  static constexpr std::uint8_t kFrame =
      regs::INSTR::encode<static_cast<std::uint8_t>(regs::Instr::kControl)>();

  Result<void> begin_access(SlaveAddress slave, std::uint8_t regadr, std::size_t count, Kind kind) {
    const bool biss_b = Checks::is_biss_b(slave.channel);
    const std::uint8_t control = regs::CTS::insert(
        regs::SLAVEID::insert(detail::encode_ctrl(chip_.config, biss_b), slave.id), 1);
    // CHSEL has one bit for each channel: the codes of channels 1 and 2 are 1 and 2.
    const std::array<std::uint8_t, 4> bytes{regadr, static_cast<std::uint8_t>(count - 1),
                                            slave.channel, control};
    if (const Result<void> set = detail::write_checked(chip_, regs::kAddrRegadr, bytes); !set) {
      return set;
    }
    return begin(kind, count, biss_b);
  }

  Result<void> begin(Kind kind, std::size_t count, bool biss_b) {
    detail::ControlState& state = chip_.control;
    // After a failed read its frame may still run and would execute the new instruction. For BiSS B
    // BREAK also resets REGEND and nAGSERR, so that both describe this access.
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
    state.overwritten = false;
    state.seen_running = false;
    state.first_frame = true;
    state.frames = 1;
    state.access_us = chip_.clock->now_us();
    detail::restart_time(chip_, detail::access_us(chip_));
    const Result<void> written = chip_.write_instruction(
        chip_.automatic ? static_cast<std::uint8_t>(kFrame | regs::AGS::encode<1>()) : kFrame);
    return written && chip_.automatic && chip_.checks_all() ? confirm_begun() : written;
  }

  // REGEND falls with the instruction, and reads 0 while it waits. If it is still 1, the
  // instruction was lost and the access before would count as this one; or this access has failed
  // at once (nREGERR = 0). One disturbed status must not hide an access that runs.
  Result<void> confirm_begun() {
    for (unsigned looks = 2; looks > 0; --looks) {
      Status status;
      const Result<void> look = chip_.look(status);
      if (!look || !status.control_ended() || status.control_error()) {
        return look;
      }
    }
    chip_.control.kind = Kind::kNone;
    return Error::kCorrupted;
  }

  Result<bool> finish(const Status& status) {
    detail::ControlState& state = chip_.control;
    const Kind kind = state.kind;
    state.kind = Kind::kNone;
    // Without AGS the frames of the access have set SVALID, and the next single frame needs
    // SVALID = 0. With AGS the class Automatic clears the flags.
    if (!chip_.automatic) {
      if (const Result<void> clear = chip_.clear_valid(chip_.sensor_flags); clear) {
        chip_.recover_first = false;
      }
    }
    const ErrorInfo error = detail::access_error(chip_, kind, status, chip_.clock->now_us());
    if (error.code != Error::kNone) {
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
