// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Control communication step by step: registers of the slaves, and commands, with and without
// automatic frames. Use it through Control.
// Source: datasheet pages 16, 27 to 29, 34, 35.

#ifndef MB4_CONTROL_STEPS_HPP_
#define MB4_CONTROL_STEPS_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/detail/blocking.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/operation.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"
#include "mb4/span.hpp"

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
// Errors of all begin calls. The chip is not touched unless the line says so. After an error
// nothing runs: if the access may have begun, the last transfers were BREAK, which also stops
// automatic frames (Automatic::next() or restart() starts them again), and the request at rest.
//   kNotConfigured, kInvalidArgument
//   kBusy         an access or a command is running
//   kUnsupported  with kFrameStart: without automatic frames FrameStart::kWaitForLine is needed,
//                 because the frames follow each other at once. With kChannelProtocol: the protocol
//                 has no such access
//   kWrongMode    BiSS B while automatic frames run
//   kTransport    touched
//   kNotDetected  touched; only with SpiCheck::kFull while automatic frames run
//   kCorrupted    touched: what was written reads back differently. With SpiCheck::kFull also the
//                 instruction, while automatic frames run: one or two transfers more
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
// registers that one wrong bit of its address would have changed. Without SpiCheck::kFull reads of
// positions are kBusy from the request to its instruction.
//
// Registers go in parts of eight, each in a transfer of its own. After a failed call BREAK comes
// first, before anything of the access is written: two transfers and 100 us more, three with
// SpiCheck::kFull, if no automatic frames run.
template <typename Bus, typename Clock>
class ControlSteps {
 public:
  explicit constexpr ControlSteps(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

  // Begins to read `count` (1..64) registers from `address`; address + count <= 128. `slave`:
  // channel 1 or 2, ID 0..7. Three transfers; four in BiSS B, and two for BREAK (SpiCheck::kFull:
  // three).
  Result<void> begin_read(SlaveAddress slave, std::uint8_t address, std::size_t count) {
    return begin_access(slave, address, nullptr, count);
  }

  // Begins to write data.size() (1..64) registers from `address`; address + size <= 128. The data
  // is in the chip when the call returns. Two transfers more for each eight registers, four with
  // SpiCheck::kFull.
  Result<void> begin_write(SlaveAddress slave, std::uint8_t address,
                           Span<const std::uint8_t> data) {
    return begin_access(slave, address, data.data(), data.size());
  }

  // Begins a command; see Command for the ranges of its members. Five transfers; seven with
  // SpiCheck::kFull.
  Result<void> begin_command(const Command& command) {
    return detail::Blocking::until_poll(
        chip_, detail::Procedures::plan_command(chip_, chip_.own, command));
  }

  // Reads the status once and does the next step of what was begun; it never waits. At most three
  // transfers, eight with SpiCheck::kFull and nothing disturbed: the status; then, without
  // automatic frames, the next frame's instruction; at the end the request at rest, and SVALID = 0
  // without automatic frames. kFull reads the status of the end twice, RDATA1 for take(), and the
  // request and SVALID back, and before each further frame the status twice. A failed end is sent
  // again, up to twice. None if Automatic::poll() or poll_slave() has seen since the last call that
  // the access runs. Call it until it returns true or an error.
  //
  //   false                      the access is still running; or the status could not be read, or
  //                              cannot come from an iC-MB4, for the first or second time in a row
  //   true                       the access has ended without error; after a read call take()
  //   kRegister, kRegisterDelay  the access has failed (ErrorInfo::bytes says how far it came); the
  //                              chip is ready for the next one
  //   kCommand                   the command was not acknowledged; the chip is ready for the next
  //   kTimeout                   the access has not ended in time; BREAK was sent
  //   kTransport, kNotDetected   ... for the third time; or a write has failed. BREAK was sent
  //   kCorrupted                 SpiCheck::kFull: a read of positions was kCorrupted meanwhile, or
  //                              the request at rest has gone elsewhere. Or no two looks at the end
  //                              agree, or automatic frames run that nobody has started: BREAK was
  //                              sent
  //   kWrongMode                 nothing was begun
  //
  // Time limit, checked by poll(). With automatic frames: the time of the frames needed, plus
  // register_busy_us, by the clock, from the begin call on. Without them the chip makes a frame
  // only when poll() asks for it: frame_timeout_us() for each frame, from its request on, and
  // register_busy_us, from the begin call on, which counts when all frames needed have run. A
  // caller that polls seldom therefore uses up register_busy_us. After the limit the status is read
  // once more.
  Result<bool> poll() { return detail::Blocking::poll_access(chip_); }

  // Copies the registers that the last read has fetched: out.size() is 1 up to their number. One
  // transfer for each eight, four with SpiCheck::kFull; the chip is only read.
  // kInvalidArgument (not touched): out.size() is out of range, the last access was no successful
  // read, or another access has begun since. kTransport, kNotDetected. kCorrupted: the second
  // reading (SpiCheck::kFull) differs from the first, or the first register from what the end of
  // the access has read, or a read of positions has been kCorrupted since. The registers must be
  // read again.
  Result<void> take(Span<std::uint8_t> out) {
    return detail::Blocking::take(chip_, out.data(), out.size());
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

 private:
  Result<void> begin_access(SlaveAddress slave, std::uint8_t address, const std::uint8_t* data,
                            std::size_t count) {
    return detail::Blocking::until_poll(
        chip_,
        detail::Procedures::plan_access(chip_, chip_.own, slave, address, data, nullptr, count));
  }
};

}  // namespace mb4

#endif  // MB4_CONTROL_STEPS_HPP_
