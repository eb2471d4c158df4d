// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Control communication, which is registers of the slaves and commands.

#ifndef MB4_CONTROL_HPP_
#define MB4_CONTROL_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/detail/blocking.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/operation.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"

namespace mb4 {

// One access at a time; blocking, or in steps for DMA, which need no bus (operation.hpp):
//
//   device.control().read_registers({1, 0}, 0x78, id);       // channel 1, ID 0
//   device.control().plan_read(operation, {1, 0}, 0x78, id);
//
// With automatic frames the access uses these frames: 47 frames for one register. The steps
// after the request only read the status. Without automatic frames the host requests each frame:
// the step that finds a frame ended starts the next one. The driver drops the data of these frames.
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
// Errors of all calls. Not touched, nothing has begun:
//   kNotConfigured, kInvalidArgument
//   kBusy         an access or a command is running
//   kUnsupported  with kFrameStart: without automatic frames FrameStart::kWaitForLine is needed,
//                 because the frames follow each other at once. With kChannelProtocol: the protocol
//                 has no such access
//   kWrongMode    BiSS B while automatic frames run
// Touched. Nothing runs then: if the access may have begun, the last transfers were BREAK, which
// also stops automatic frames (Automatic::next() or restart() starts them again), and the request
// at rest.
//   kRegister, kRegisterDelay  the access has failed (ErrorInfo::bytes says how far it came); the
//                 chip is ready for the next one
//   kCommand      the command was not acknowledged; the chip is ready for the next one
//   kTimeout      the access has not ended in time; BREAK was sent
//   kTransport, kNotDetected  the status could not be read, or cannot come from an iC-MB4, for the
//                 third time in a row; or a write, or the reading of what was fetched, has failed
//   kCorrupted    what was written reads back differently. With SpiCheck::kFull also: the
//                 instruction; a read of positions was kCorrupted meanwhile; no two looks at the
//                 end agree; automatic frames run that nobody has started; the second reading of
//                 what was fetched differs from the first
//   kVerify       with SpiCheck::kFull, from the comparison below
//
// Time limit. With automatic frames: the time of the frames needed, plus register_busy_us, by the
// clock. Without them the chip makes a frame only when a step asks for it: frame_timeout_us() for
// each frame, from its request on, and register_busy_us, from the beginning on, which counts when
// all frames needed have run. A caller whose steps are seldom therefore uses up register_busy_us.
// After the limit the status is read once more. So each call ends, whatever chip and slave do.
//
// At the end of each access and command, good or bad, the request at rest is written: 0xE2..0xE5
// ask for a read of register 0, so that a disturbed byte which starts an access does no harm. It is
// one transfer, two with SpiCheck::kFull. If it fails three times the call is kTransport or
// kCorrupted, automatic frames count as stopped, and the next call sends it first, behind BREAK.
// kCorrupted, with SpiCheck::kFull: it reads back differently twice, so the write may have reached
// another register (verify()); it is sent again.
//
// With SpiCheck::kFull, where something reads back differently, the disturbed transfer may have
// reached the configuration, or have been an instruction. Then the call, before it ends, compares
// the whole configuration as Device::verify() does, and looks whether automatic frames run;
// meanwhile reads of positions are kBusy. It ends with the error that it had, or with kCorrupted
// and needs a restart; if the configuration differs, or cannot be read, with the error of verify()
// (kVerify, kNotDetected, kTransport), and the Device counts as not configured. This takes four
// transfers more. Behind each reading of data, whose right answer may be 0, a witness follows: the
// status and 0xF5, which show a read that was an instruction. Each write of RDATA also reads the
// registers that one wrong bit of its address would have changed. Reads of positions are kBusy
// from the request to its instruction.
//
// Registers go in parts of eight, each in a transfer of its own. After a failed call BREAK comes
// first, before anything of the access is written: two transfers and 100 us more, three with
// SpiCheck::kFull, if no automatic frames run.
template <typename Bus, typename Clock>
class Control {
 public:
  explicit constexpr Control(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

  // Reads out.size() (1..128) registers from `address`, in parts of 64; address + size <= 128.
  // kNotConfigured, kInvalidArgument, kBusy, kUnsupported, kWrongMode, kTransport, kNotDetected,
  // kCorrupted, kTimeout, kRegister, kRegisterDelay. ErrorInfo::bytes counts over all parts; on
  // error `out` holds the registers of the parts before the one that has failed.
  Result<void> read_registers(SlaveAddress slave, std::uint8_t address, Span<std::uint8_t> out) {
    return detail::Blocking::in_parts(chip_, slave, address, nullptr, out.data(), out.size());
  }

  // Writes data.size() (1..128) registers from `address`, in parts of 64; address + size <= 128.
  // Errors of read_registers(). On error the first ErrorInfo::bytes registers are written, and the
  // next one may be.
  Result<void> write_registers(SlaveAddress slave, std::uint8_t address,
                               Span<const std::uint8_t> data) {
    return detail::Blocking::in_parts(chip_, slave, address, data.data(), nullptr, data.size());
  }

  // Sends a command and waits for its end. kNotConfigured, kInvalidArgument, kBusy, kUnsupported,
  // kTransport, kNotDetected, kCorrupted, kTimeout, kCommand.
  Result<void> send(const Command& command) {
    return detail::Blocking::run(chip_,
                                 detail::Procedures::plan_command(chip_, chip_.own, command));
  }

  // Switches on what broadcast commands can have switched off in the slaves of BiSS C: broadcast
  // command 01 (they take part in control communication), then command 00 to the IDs given (they
  // send their data), which exactly these must acknowledge. `ids`, `ids_2`: bit n is ID n of
  // channel 1, of channel 2; both 0: those of the enabled slaves, one ID each. It needs no
  // automatic frames, with any Config::frame_start, and uses them where they run. Without them it
  // makes about 70 frames, or 100 with two channels; they send the words of actuators too. In a
  // chain a slave that was off on purpose shifts the words of the others when it is on.
  //
  // With SpiCheck::kFull also the errors of a comparison.
  //
  // Not touched: kNotConfigured, kBusy; kUnsupported (kChannelProtocol): no channel is BiSS C, or
  // not the one that an ID was given for. kTransport, kNotDetected, kCorrupted, kTimeout as of
  // send(). kCommand: not all have acknowledged; those that did are on.
  Result<void> activate(std::uint8_t ids = 0, std::uint8_t ids_2 = 0) {
    return detail::Blocking::run(chip_,
                                 detail::Procedures::plan_activate(chip_, chip_.own, ids, ids_2));
  }

  // Begins to read out.size() (1..64) registers without a transfer: the caller makes the frames of
  // `operation` and calls Device::finish() until it returns true. `out` must stay until then; it is
  // valid on success only. With automatic frames the steps after the request only read the status,
  // and positions are read between the steps. Without them each frame of the line takes two steps.
  //
  // Not touched: kNotConfigured, kInvalidArgument, kBusy, kUnsupported, kWrongMode.
  // operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kRegister, kRegisterDelay,
  // kVerify with SpiCheck::kFull: the Device is not configured any more. After kTransport and
  // kNotDetected the last step was BREAK, if an access ran. The time limit is by `now_us` of
  // finish().
  Result<void> plan_read(Operation& operation, SlaveAddress slave, std::uint8_t address,
                         Span<std::uint8_t> out) {
    return detail::Procedures::plan_access(chip_, operation, slave, address, nullptr, out.data(),
                                           out.size());
  }

  // As plan_read(), but writes data.size() (1..64) registers. `data` must stay until the end.
  // Not touched: kNotConfigured, kInvalidArgument, kBusy, kUnsupported, kWrongMode.
  // operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kRegister, kRegisterDelay,
  // kVerify.
  Result<void> plan_write(Operation& operation, SlaveAddress slave, std::uint8_t address,
                          Span<const std::uint8_t> data) {
    return detail::Procedures::plan_access(chip_, operation, slave, address, data.data(), nullptr,
                                           data.size());
  }

  // Device::finish(), for an operation that this object has begun.
  [[nodiscard]] bool finish(Operation& operation, bool transferred, std::uint32_t now_us) {
    return detail::Procedures::finish(chip_, operation, transferred, now_us);
  }

  // As plan_read(), but sends a command. Not touched: kNotConfigured, kInvalidArgument, kBusy,
  // kUnsupported. operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kCommand,
  // and those of a comparison.
  Result<void> plan_command(Operation& operation, const Command& command) {
    return detail::Procedures::plan_command(chip_, operation, command);
  }

  // As plan_command(), but for activate(). Not touched: kNotConfigured, kBusy, kUnsupported.
  // operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kCommand, and
  // those of a comparison.
  Result<void> plan_activate(Operation& operation, std::uint8_t ids = 0, std::uint8_t ids_2 = 0) {
    return detail::Procedures::plan_activate(chip_, operation, ids, ids_2);
  }

  // Sends BREAK: the access ends at once. Registers of the slave may be changed already; the one
  // whose byte is cut may get a value that nobody has named: its first bits, and zeros
  // (docs/choices.md). Automatic frames stop as well; Automatic::next() or restart() starts them
  // again. One transfer, and the request at rest if an access ran; proven and told as
  // Device::break_transmission(). kTransport, kNotDetected, kCorrupted.
  Result<void> abort() {
    detail::Procedures::plan_stop(chip_, chip_.own, regs::BREAK::encode<1>(),
                                  chip_.automatic || chip_.restart);
    return detail::Blocking::run(chip_, chip_.own);
  }

 protected:
  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_CONTROL_HPP_
