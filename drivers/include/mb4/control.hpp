// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Control communication, which is registers of the slaves and commands.

#ifndef MB4_CONTROL_HPP_
#define MB4_CONTROL_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/control_steps.hpp"
#include "mb4/detail/blocking.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/operation.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"
#include "mb4/span.hpp"

namespace mb4 {

// The calls of ControlSteps; their blocking forms; and the whole access in steps for DMA, which
// needs no bus (operation.hpp):
//
//   device.control().read_registers({1, 0}, 0x78, id);       // channel 1, ID 0
//   device.control().plan_read(operation, {1, 0}, 0x78, id);
//
// A call ends within the time limit of ControlSteps::poll(), whatever chip and slave do.
template <typename Bus, typename Clock>
class Control : public ControlSteps<Bus, Clock> {
  using Steps = ControlSteps<Bus, Clock>;

 public:
  using Steps::Steps;

  // Reads out.size() (1..128) registers from `address`, in parts of 64; address + size <= 128.
  // Errors of begin_read(), poll() and take(). ErrorInfo::bytes counts over all parts; on error
  // `out` holds the registers of the parts before the one that has failed.
  Result<void> read_registers(SlaveAddress slave, std::uint8_t address, Span<std::uint8_t> out) {
    return detail::Blocking::in_parts(Steps::chip_, slave, address, nullptr, out.data(),
                                      out.size());
  }

  // Writes data.size() (1..128) registers from `address`, in parts of 64; address + size <= 128.
  // Errors of begin_write() and poll(), as for read_registers(). On error the first
  // ErrorInfo::bytes registers are written, and the next one may be.
  Result<void> write_registers(SlaveAddress slave, std::uint8_t address,
                               Span<const std::uint8_t> data) {
    return detail::Blocking::in_parts(Steps::chip_, slave, address, data.data(), nullptr,
                                      data.size());
  }

  // Sends a command and waits for its end. Errors of begin_command() and poll().
  Result<void> send(const Command& command) {
    return detail::Blocking::run(
        Steps::chip_, detail::Procedures::plan_command(Steps::chip_, Steps::chip_.own, command));
  }

  // Switches on what broadcast commands can have switched off in the slaves of BiSS C: broadcast
  // command 01 (they take part in control communication), then command 00 to the IDs given (they
  // send their data), which exactly these must acknowledge. `ids`, `ids_2`: bit n is ID n of
  // channel 1, of channel 2; both 0: those of the enabled slaves, one ID each. It needs no
  // automatic frames, with any Config::frame_start, and uses them where they run. Without them it
  // makes about 70 frames, or 100 with two channels; they send the words of actuators too. In a
  // chain a slave that was off on purpose shifts the words of the others when it is on.
  //
  // With SpiCheck::kFull also the errors of a comparison (control_steps.hpp).
  //
  // Not touched: kNotConfigured, kBusy; kUnsupported (kChannelProtocol): no channel is BiSS C, or
  // not the one that an ID was given for. kTransport, kNotDetected, kCorrupted, kTimeout as of
  // begin_command() and poll(). kCommand: not all have acknowledged; those that did are on.
  Result<void> activate(std::uint8_t ids = 0, std::uint8_t ids_2 = 0) {
    return detail::Blocking::run(Steps::chip_, detail::Procedures::plan_activate(
                                                   Steps::chip_, Steps::chip_.own, ids, ids_2));
  }

  // Begins to read out.size() (1..64) registers without a transfer: the caller makes the frames of
  // `operation` and calls Device::finish() until it returns true. `out` must stay until then; it is
  // valid on success only. With automatic frames the steps after the request only read the status,
  // and positions are read between the steps. Without them each frame of the line takes two steps.
  //
  // Not touched, nothing has begun: kNotConfigured, kInvalidArgument, kBusy, kUnsupported,
  // kWrongMode as of the begin calls. operation.result(): kTransport, kNotDetected, kCorrupted as
  // of begin_read() and take(), kTimeout, kRegister, kRegisterDelay as of poll(), kVerify with
  // SpiCheck::kFull: the Device is not configured any more (control_steps.hpp). After kTransport
  // and kNotDetected the last step was BREAK, if an access ran. The time limit is that of poll(),
  // by `now_us` of finish(); after it the status is read once more.
  Result<void> plan_read(Operation& operation, SlaveAddress slave, std::uint8_t address,
                         Span<std::uint8_t> out) {
    return detail::Procedures::plan_access(Steps::chip_, operation, slave, address, nullptr,
                                           out.data(), out.size());
  }

  // As plan_read(), but writes data.size() (1..64) registers. `data` must stay until the end.
  // Not touched: kNotConfigured, kInvalidArgument, kBusy, kUnsupported, kWrongMode.
  // operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kRegister, kRegisterDelay,
  // kVerify.
  Result<void> plan_write(Operation& operation, SlaveAddress slave, std::uint8_t address,
                          Span<const std::uint8_t> data) {
    return detail::Procedures::plan_access(Steps::chip_, operation, slave, address, data.data(),
                                           nullptr, data.size());
  }

  // Device::finish(), for an operation that this object has begun.
  [[nodiscard]] bool finish(Operation& operation, bool transferred, std::uint32_t now_us) {
    return detail::Procedures::finish(Steps::chip_, operation, transferred, now_us);
  }

  // As plan_read(), but sends a command. Not touched: kNotConfigured, kInvalidArgument, kBusy,
  // kUnsupported. operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kCommand,
  // and those of a comparison (control_steps.hpp).
  Result<void> plan_command(Operation& operation, const Command& command) {
    return detail::Procedures::plan_command(Steps::chip_, operation, command);
  }

  // As plan_command(), but for activate(). Not touched: kNotConfigured, kBusy, kUnsupported.
  // operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kCommand, and
  // those of a comparison (control_steps.hpp).
  Result<void> plan_activate(Operation& operation, std::uint8_t ids = 0, std::uint8_t ids_2 = 0) {
    return detail::Procedures::plan_activate(Steps::chip_, operation, ids, ids_2);
  }
};

}  // namespace mb4

#endif  // MB4_CONTROL_HPP_
