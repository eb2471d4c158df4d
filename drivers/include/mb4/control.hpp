// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Control communication, which is registers of the slaves and commands.

#ifndef MB4_CONTROL_HPP_
#define MB4_CONTROL_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/control_steps.hpp"
#include "mb4/detail/access.hpp"
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
  // Errors of begin_read(), poll() and take(). After kTransport and kNotDetected the call has tried
  // to send BREAK. ErrorInfo::bytes counts over all parts; on error only that many bytes of `out`
  // are valid.
  Result<void> read_registers(SlaveAddress slave, std::uint8_t address, Span<std::uint8_t> out) {
    return in_parts(slave, address, out, Span<const std::uint8_t>(nullptr, out.size()));
  }

  // Writes data.size() (1..128) registers from `address`, in parts of 64; address + size <= 128.
  // Errors of begin_write() and poll(), as for read_registers(). On error the first
  // ErrorInfo::bytes registers are written, and the next one may be.
  Result<void> write_registers(SlaveAddress slave, std::uint8_t address,
                               Span<const std::uint8_t> data) {
    return in_parts(slave, address, Span<std::uint8_t>(), data);
  }

  // Sends a command and waits for its end. Errors of begin_command() and poll().
  Result<void> send(const Command& command) { return wait(Steps::begin_command(command)); }

  // Begins to read out.size() (1..64) registers without a transfer: the caller makes the frames of
  // `operation` and calls Device::finish() until it returns true. `out` must stay until then; it is
  // valid on success only. With automatic frames the steps after the request only read the status,
  // and positions are read between the steps. Without them each frame of the line takes two steps.
  //
  // Not touched, nothing has begun: kNotConfigured, kInvalidArgument, kBusy, kUnsupported,
  // kWrongMode as of the begin calls. operation.result(): kTransport, kNotDetected, kCorrupted as
  // of begin_read() and take(), kTimeout, kRegister, kRegisterDelay as of poll(). After kTransport
  // and kNotDetected the last step was BREAK, if an access ran. The time limit is that of poll(),
  // by `now_us` of finish(); after it the status is read once more.
  Result<void> plan_read(Operation& operation, SlaveAddress slave, std::uint8_t address,
                         Span<std::uint8_t> out) {
    const Result<void> possible = detail::Procedures::possible(
        operation, Steps::check_access(slave, address, out.size(), Protocol::kSsi));
    if (possible) {
      detail::Procedures::plan_access(Steps::chip_, operation, slave, address, nullptr, out.data(),
                                      out.size());
    }
    return possible;
  }

  // As plan_read(), but writes data.size() (1..64) registers. `data` must stay until the end.
  // Not touched: kNotConfigured, kInvalidArgument, kBusy, kUnsupported, kWrongMode.
  // operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kRegister, kRegisterDelay.
  Result<void> plan_write(Operation& operation, SlaveAddress slave, std::uint8_t address,
                          Span<const std::uint8_t> data) {
    const Result<void> possible = detail::Procedures::possible(
        operation, Steps::check_access(slave, address, data.size(), Protocol::kUnused));
    if (possible) {
      detail::Procedures::plan_access(Steps::chip_, operation, slave, address, data.data(), nullptr,
                                      data.size());
    }
    return possible;
  }

  // As plan_read(), but sends a command. Not touched: kNotConfigured, kInvalidArgument, kBusy,
  // kUnsupported. operation.result(): kTransport, kNotDetected, kCorrupted, kTimeout, kCommand.
  Result<void> plan_command(Operation& operation, const Command& command) {
    const Result<void> possible =
        detail::Procedures::possible(operation, Steps::check_command(command));
    if (possible) {
      detail::Procedures::plan_command(Steps::chip_, operation, command);
    }
    return possible;
  }

 private:
  // Waits for the end of what a begin call has begun; `begun` is the result of that call. After an
  // error nothing runs. The first error is returned, even if BREAK fails after it.
  Result<void> wait(const Result<void>& begun) {
    if (!begun && begun.error() != Error::kTransport) {
      return begun;
    }
    Result<bool> ended = begun ? Result<bool>(false) : Result<bool>(begun.failure());
    while (ended && !*ended) {
      ended = Steps::poll();
    }
    if (Steps::running()) {
      static_cast<void>(Steps::abort());
    }
    return ended ? Result<void>() : Result<void>(ended.failure());
  }

  // Reads data.size() registers into `out`; if `out` is empty it writes `data`.
  Result<void> in_parts(SlaveAddress slave, std::uint8_t address, Span<std::uint8_t> out,
                        Span<const std::uint8_t> data) {
    const std::size_t size = data.size();
    if (size > kSlaveRegisters || address + size > kSlaveRegisters) {
      return Error::kInvalidArgument;
    }
    std::size_t done = 0;
    do {
      const std::size_t left = size - done;
      const std::size_t count = left < kMaxRegistersPerAccess ? left : kMaxRegistersPerAccess;
      const std::uint8_t from = static_cast<std::uint8_t>(address + done);
      Result<void> result =
          wait(out.empty() ? Steps::begin_write(slave, from,
                                                Span<const std::uint8_t>(data.data() + done, count))
                           : Steps::begin_read(slave, from, count));
      if (result && !out.empty()) {
        result = Steps::take(Span<std::uint8_t>(out.data() + done, count));
      }
      if (!result) {
        ErrorInfo error = result.info();
        error.detail = static_cast<std::uint8_t>(error.bytes() + done);
        return error;
      }
      done += count;
    } while (done < size);
    return {};
  }
};

}  // namespace mb4

#endif  // MB4_CONTROL_HPP_
