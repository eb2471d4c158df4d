// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The blocking calls: loops over the steps. They reach bus and clock through two functions of the
// chip, so that a second type of bus adds these two and no other code.

#ifndef MB4_DETAIL_BLOCKING_HPP_
#define MB4_DETAIL_BLOCKING_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/access.hpp"
#include "mb4/detail/actuator.hpp"
#include "mb4/detail/chip_state.hpp"
#include "mb4/detail/configuration.hpp"
#include "mb4/detail/initialization.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/detail/reads.hpp"
#include "mb4/detail/single_frame.hpp"
#include "mb4/frame.hpp"
#include "mb4/operation.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"

namespace mb4::detail {

// Device, Automatic and Control document the calls.
struct Blocking {
  // Makes the frames of one step. True: the operation has ended.
  [[gnu::noinline]] static bool step(ChipState& chip, Operation& op) {
    if (op.pause_us() != 0) {
      pause(chip, op.pause_us());
    }
    const bool transferred = chip.make(chip, op);
    return Procedures::finish(chip, op, transferred, chip.ask_us(chip));
  }
  // All steps.
  [[gnu::noinline]] static Result<void> run(ChipState& chip, Operation& op) {
    while (!step(chip, op)) {
    }
    return op.result();
  }
  // What was planned in chip.own, if `planned`.
  [[gnu::noinline]] static Result<void> run(ChipState& chip, const Result<void>& planned) {
    return planned ? run(chip, chip.own) : planned;
  }

  // ---- Configuration ----

  static Result<void> verify(ChipState& chip) {
    if (!chip.configured) {
      return Error::kNotConfigured;
    }
    Operation op;  // an access may use chip.own
    Procedures::plan_verify(chip, op);
    return run(chip, op);
  }

  static Result<LineDelay> initialize(ChipState& chip) {
    Result<void> done = chip.single_frame_allowed();
    if (done) {
      Procedures::plan_initialize(chip, chip.own);
      done = run(chip, chip.own);
    }
    return done ? Result<LineDelay>(chip.own.line_delay()) : Result<LineDelay>(done.failure());
  }

  // ---- Positions ----

  [[gnu::noinline]] static Result<Reading> read_frame(ChipState& chip, std::uint8_t slave) {
    if (const Result<void> allowed = chip.single_frame_allowed(); !allowed) {
      return allowed.failure();
    }
    if (!is_in(chip.sensors, slave)) {
      return Error::kInvalidArgument;
    }
    CyclicRead read;
    Procedures::plan_frame(chip, chip.own, read, chip.word_of(slave), 1);
    const Result<void> done = run(chip, chip.own);
    return chip.configured ? read.single() : Result<Reading>(done.failure());
  }

  [[gnu::noinline]] static Result<void> read_all(ChipState& chip, Frame& frame) {
    if (const Result<void> allowed = chip.single_frame_allowed(); !allowed) {
      return allowed;
    }
    FrameRead read;
    Procedures::plan_frame(chip, chip.own, read, chip.words.data(), chip.count);
    const Result<void> done = run(chip, chip.own);
    return chip.configured ? read.result(frame) : done;
  }

  template <std::uint8_t With>
  [[gnu::noinline]] static Result<Reading> poll_slave(ChipState& chip, std::uint8_t slave) {
    CyclicRead read;
    if (const Result<void> allowed = Reads::plan<With>(chip, read, slave, false); !allowed) {
      return allowed.failure();
    }
    bool transferred = false;
    do {
      transferred = chip.make(chip, read);
    } while (!Reads::finish<With>(chip, read, transferred, chip.ask_us(chip)));
    return read.result();
  }

  [[gnu::noinline]] static Result<void> poll(ChipState& chip, Frame& frame) {
    frame.clear();
    FrameRead read;
    if (const Result<void> allowed = Reads::begin(chip, read, false, false); !allowed) {
      return allowed;
    }
    bool transferred = false;
    do {
      transferred = chip.make(chip, read);
    } while (!Reads::take<MB4_WITH_ALL>(chip, read, transferred, chip.ask_us(chip)));
    return read.result(frame);
  }

  static Result<void> start(ChipState& chip) {
    Procedures::plan_start(chip, chip.own);
    return run(chip, chip.own);
  }

  template <std::uint8_t With>
  static Result<void> restart(ChipState& chip) {
    const Result<void> allowed = chip.start_allowed(true);
    if (!allowed) {
      return allowed;
    }
    Procedures::prepare_restart<With>(chip);
    return start(chip);
  }

  template <std::uint8_t With>
  [[gnu::noinline]] static Result<void> next(ChipState& chip, Frame& frame) {
    frame.clear();
    if (!chip.automatic && !chip.restart) {
      return Error::kWrongMode;
    }
    if (chip.restart && !chip.control_runs()) {
      if (const Result<void> again = restart<With>(chip); !again) {
        return again;
      }
    }
    if (const Result<void> waited = wait(chip); !waited) {
      chip.restart = waited.error() != Error::kNoData;
      return waited;
    }
    const Result<void> read = poll(chip, frame);
    // kBankSwitched needs no restart.
    chip.restart = read ? !frame.complete(chip.sensors) : read.error() != Error::kBankSwitched;
    return read;
  }

  // ---- Control communication ----

  // Writes `size` registers; if `data` is null it reads them into `out`.
  [[gnu::noinline]] static Result<void> in_parts(ChipState& chip, SlaveAddress slave,
                                                 std::uint8_t address, const std::uint8_t* data,
                                                 std::uint8_t* out, std::size_t size) {
    if (size > kSlaveRegisters || address + size > kSlaveRegisters) {
      return Error::kInvalidArgument;
    }
    std::size_t done = 0;
    do {
      const std::size_t left = size - done;
      const std::size_t count = left < kMaxRegistersPerAccess ? left : kMaxRegistersPerAccess;
      const Result<void> result =
          run(chip, Procedures::plan_access(chip, chip.own, slave,
                                            static_cast<std::uint8_t>(address + done),
                                            data != nullptr ? data + done : nullptr,
                                            out != nullptr ? out + done : nullptr, count));
      if (!result) {
        ErrorInfo error = result.info();
        error.detail = static_cast<std::uint8_t>(error.bytes() + done);
        return error;
      }
      done += count;
    } while (done < size);
    return {};
  }

 private:
  // Waits until the clock has advanced by `time_us` (up to 4'294'967), which holds its step. A
  // count of calls ends the wait when the time source stands still. Even if a call takes only 1 ns,
  // the count does not end before the time.
  static void pause(ChipState& chip, std::uint32_t time_us) {
    const std::uint32_t start_us = chip.ask_us(chip);
    std::uint32_t calls_left = time_us * 1000;
    while (chip.ask_us(chip) - start_us < time_us && --calls_left != 0) {
    }
  }

  // For the end of the next automatic frame; an access may use chip.own meanwhile.
  [[gnu::noinline]] static Result<void> wait(ChipState& chip) {
    Operation op;
    Procedures::plan_wait(chip, op);
    return run(chip, op);
  }
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_BLOCKING_HPP_
