// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// mb4_slave_begin_read() to mb4_slave_take(): one access in the Operation of the device, whose
// caller polls. mb4_c.cpp includes it. A program in C++ takes Control::plan_read() and its like.

#ifndef MB4_C_ACCESS_HPP_
#define MB4_C_ACCESS_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/control.hpp"
#include "mb4/detail/blocking.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/device.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"

namespace mb4_c {

// One access at a time. The caller can do other work between the frames:
//
//   mb4_slave_begin_read(&device, 1, 0, 0x78, 8);
//   do {
//     result = mb4_slave_poll(&device, &ended);
//   } while (result.code == MB4_OK && !ended);
//   mb4_slave_take(&device, id, 8);
//
// The chip is not touched unless the line says so. Errors of all begin calls: those of
// Control::plan_read(); also
//   kTransport    touched
//   kNotDetected  touched; only with SpiCheck::kFull while automatic frames run
//   kCorrupted    touched: what was written reads back differently. With SpiCheck::kFull also the
//                 instruction, while automatic frames run: one or two transfers more
template <typename Bus, typename Clock>
class PolledAccess : public mb4::Control<Bus, Clock> {
  using Base = mb4::Control<Bus, Clock>;
  using Base::chip_;

 public:
  explicit PolledAccess(mb4::Device<Bus, Clock>& device) : Base(device.control()) {}

  // Begins to read `count` (1..64) registers from `address`; address + count <= 128. `slave`:
  // channel 1 or 2, ID 0..7. Three transfers; four in BiSS B, and two for BREAK (SpiCheck::kFull:
  // three).
  mb4::Result<void> begin_read(mb4::SlaveAddress slave, std::uint8_t address, std::size_t count) {
    return until_poll(mb4::detail::Procedures::plan_access(chip_, chip_.own, slave, address,
                                                           nullptr, nullptr, count));
  }

  // Begins to write data.size() (1..64) registers from `address`; address + size <= 128. The data
  // is in the chip when the call returns. Two transfers more for each eight registers, four with
  // SpiCheck::kFull.
  mb4::Result<void> begin_write(mb4::SlaveAddress slave, std::uint8_t address,
                                mb4::Span<const std::uint8_t> data) {
    return until_poll(mb4::detail::Procedures::plan_access(chip_, chip_.own, slave, address,
                                                           data.data(), nullptr, data.size()));
  }

  // Begins a command; see Command for the ranges of its members. Five transfers; seven with
  // SpiCheck::kFull.
  mb4::Result<void> begin_command(const mb4::Command& command) {
    return until_poll(mb4::detail::Procedures::plan_command(chip_, chip_.own, command));
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
  mb4::Result<bool> poll() {
    using mb4::detail::Procedures;
    mb4::Operation& op = chip_.own;
    if (!chip_.control_runs() || chip_.control.owner != &op) {
      return mb4::Error::kWrongMode;
    }
    if (Procedures::seen_running(chip_, op, chip_.ask_us(chip_))) {
      return false;
    }
    const mb4::Result<void> done = until_poll({});
    return done ? mb4::Result<bool>(!chip_.control_runs()) : mb4::Result<bool>(done.failure());
  }

  // Copies the registers that the last read has fetched: out.size() is 1 up to their number. One
  // transfer for each eight, four with SpiCheck::kFull; the chip is only read.
  // kInvalidArgument (not touched): out.size() is out of range, the last access was no successful
  // read, or another access has begun since. kTransport, kNotDetected. kCorrupted: the second
  // reading (SpiCheck::kFull) differs from the first, or the first register from what the end of
  // the access has read, or a read of positions has been kCorrupted since. The registers must be
  // read again.
  mb4::Result<void> take(mb4::Span<std::uint8_t> out) {
    if (out.size() == 0 || out.size() > chip_.control.readable) {
      return mb4::Error::kInvalidArgument;
    }
    mb4::detail::Procedures::plan_take(chip_, chip_.own, out.data(), out.size());
    return mb4::detail::Blocking::run(chip_, chip_.own);
  }

 private:
  // Makes the steps up to the next look at the status, or to the end. Success: no error yet.
  mb4::Result<void> until_poll(const mb4::Result<void>& planned) {
    using mb4::detail::Procedures;
    if (!planned) {
      return planned;
    }
    while (!mb4::detail::Blocking::step(chip_, chip_.own)) {
      if (Procedures::polls(chip_.own)) {
        return {};
      }
    }
    return chip_.own.result();
  }
};

}  // namespace mb4_c

#endif  // MB4_C_ACCESS_HPP_
