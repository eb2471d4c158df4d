// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 4: frames that come by themselves (AGS = 1) and how to read them without tearing.

#ifndef MB4_AUTOMATIC_HPP_
#define MB4_AUTOMATIC_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/actuator.hpp"
#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/control_data.hpp"
#include "mb4/frame.hpp"
#include "mb4/frame_poll.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Automatic frames, at the rate or on the event that Config::frame_start selects (table 44):
//
//   device.automatic().start();
//   device.automatic().poll(frame);    // in an interrupt: the last frame, if it is new
//   device.automatic().next(frame);    // in a loop: waits for the next frame
//
// Why data is never torn: HOLDBANK keeps the bank while it is read (page 33, table 69). It takes
// effect some system clocks after it was written, so that, with SCLK above 2 f_CLK, bytes read at
// once might still belong to the old bank; the status that is read between HOLDBANK and the data
// takes at least 48 SCLK periods. While a control communication runs, 0xF4 must not be written: its
// INSTR = 100, written back at the wrong moment, would start the access again. The data is then
// read without HOLDBANK, and dropped as kBankSwitched unless SVALID and nSCDERR prove that no bank
// was switched.
//
// Why data is never old: SVALID of all enabled slaves is cleared after each read, so that 1 means a
// frame that has ended since (note of table 61).
template <typename Bus, typename Clock>
class Automatic {
 public:
  explicit constexpr Automatic(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

  // Sets AGS = 1. One transfer; after a failed read 2 more and 100 us (BREAK, SVALID).
  // kNotConfigured, kWrongMode (runs already), kBusy, kUnsupported with kSingleBank (not touched);
  // kTransport (touched: AGS may be on; stop() or start() again).
  Result<void> start() {
    if (!chip_.configured) {
      return Error::kNotConfigured;
    }
    if (control_runs()) {
      return Error::kBusy;
    }
    if (chip_.automatic) {
      return Error::kWrongMode;
    }
    if (chip_.config.single_bank) {
      return ErrorInfo(Error::kUnsupported, ConfigField::kSingleBank, 0);
    }
    if (chip_.recover_first) {
      if (const Result<void> recovered = chip_.recover(); !recovered) {
        return recovered;
      }
    }
    // Single frames begin with BREAK afterwards, because this one may run on.
    chip_.recover_first = true;
    if (const Result<void> on = chip_.write_instruction(kAgs); !on) {
      return on;
    }
    chip_.automatic = true;
    chip_.restart = false;
    return {};
  }

  // Sets AGS = 0: a running frame comes to its end, no other follows. One transfer. Does no harm
  // when nothing runs. kBusy (not touched); kTransport (touched, AGS may be on or off).
  Result<void> stop() {
    if (control_runs()) {
      return Error::kBusy;
    }
    chip_.automatic = false;
    chip_.restart = false;
    chip_.recover_first = true;
    return chip_.write_instruction(0);
  }

  // BREAK, 100 us for the slaves' timeout, SVALID cleared, AGS = 1 (table 69). Three transfers, not
  // for interrupts. Errors as of start(), but automatic frames may run.
  Result<void> restart() {
    if (control_runs()) {
      return Error::kBusy;
    }
    chip_.automatic = false;
    chip_.recover_first = true;
    return start();
  }

  // AGS = 1 is set.
  [[nodiscard]] bool running() const { return chip_.automatic; }

  // Fetches the last complete frame if it has not been fetched yet. Never waits: at most 5 + n
  // transfers for n enabled slaves, 3 when nothing is new, whatever the chip answers, without
  // SpiCheck::kFull:
  //   0x07        HOLDBANK = 1, AGS = 1
  //   0x05        0xF0..0xF4: new at all? And time for HOLDBANK to take effect
  //   0x09, 0x03  SCDATA of the enabled slaves, 1..n bursts; only the bytes that they need
  //   0x05        0xF0..0xF4: SVALID after reading (table 69)
  //   0x02        SVALID of the enabled slaves = 0
  //   0x07        HOLDBANK = 0, AGS = 1; also after a failed transfer
  // While a control communication runs (at most 3 + n): 0x05, 0x02, data, 0x05.
  // SpiCheck::kFull: n + 2 more: data again, where a stored CRC does not prove it, and one or two
  // 0x05 behind the 0x02; beside a control communication n + 1 more.
  //
  // May be used in an interrupt; no other call on the same Device may be interrupted by it.
  //
  // Success: frame[slave] is a Reading, kNoData (nothing new), kCrc or kCorrupted for each enabled
  // slave; frame.status tells of omitted frames (nAGSERR). The datasheet asks for restart() when
  // SVALID is 0 although a frame must have come (table 69); this call leaves that to the caller,
  // who knows how often frames come. next() does it by itself.
  // kWrongMode (not running: not touched); kTransport, kNotDetected, kBankSwitched; kCorrupted with
  // SpiCheck::kFull. On error `frame` holds no Reading.
  Result<void> poll(Frame& frame) {
    frame.clear();
    if (!chip_.automatic) {
      return Error::kWrongMode;
    }
    detail::Outcome outcome;
    detail::FetchedData data;
    const Result<void> read =
        FramePoll<Bus, Clock>(chip_).read(chip_.sensors, control_runs(), outcome, fetch_all, &data);
    if (read) {
      // nSCDERR is about the last frame on the line, which may be later than the bank that was
      // read. A slave without SVALID beside one with it was bad in any case.
      detail::decode_all(
          chip_.config, chip_.sensors, outcome, data,
          outcome.good != 0 || outcome.status.scd_error() ? Error::kCrc : Error::kNoData, frame);
    }
    return read;
  }

  // The same for one slave, 1..8: its position, in at most kMaxPollSlaveTransfers transfers
  // (kMaxPollSlaveTransfersChecked with SpiCheck::kFull), 3 when nothing is new. Small and quick:
  // made for a control loop's interrupt. SVALID of other slaves is left alone.
  //
  // kInvalidArgument (not enabled), kWrongMode (not running): not touched. kNoData: no frame has
  // ended since the last call; kCrc: and the last one was bad. kCorrupted, kTransport,
  // kNotDetected, kBankSwitched as for poll().
  Result<Reading> poll_slave(std::uint8_t slave) {
    if (!is_in(chip_.sensors, slave)) {
      return Error::kInvalidArgument;
    }
    if (!chip_.automatic) {
      return Error::kWrongMode;
    }
    detail::Outcome outcome;
    detail::FetchedSlave data;
    data.slave = slave;
    if (const Result<void> read =
            FramePoll<Bus, Clock>(chip_).read(static_cast<std::uint8_t>(1U << (slave - 1U)),
                                              control_runs(), outcome, fetch_one, &data);
        !read) {
      return read.failure();
    }
    if (outcome.good == 0) {
      return outcome.status.scd_error() ? Error::kCrc : Error::kNoData;
    }
    return detail::decode(chip_.config, slave, data.bytes.data(), data.stable);
  }

  // Device::write_actuator() for a control loop that writes a word each frame: never waits, three
  // transfers (five with SpiCheck::kFull). The word goes out with the frame after the one that
  // runs. Only one of the two banks gets it, so without another call before the frame after that
  // the previous word follows it.
  //
  // kWrongMode (not running), kBusy, kInvalidArgument (not touched); kTransport, kNotDetected,
  // kCorrupted as for Device::write_actuator().
  Result<void> write_actuator(std::uint8_t slave, std::uint64_t word) {
    if (!chip_.automatic) {
      return Error::kWrongMode;
    }
    if (control_runs()) {
      return Error::kBusy;
    }
    return ActuatorWrite<Bus, Clock>(chip_).write(slave, word, false);
  }

  // Waits for the next new frame, at most frame_timeout_us() and one frame period, and fetches it
  // as poll() does. After an error, and after a frame in which a slave was not good (table 69), the
  // next call begins with restart(), unless a control communication runs.
  //
  // kWrongMode (not running: not touched); the errors of poll(); kTimeout, kLineError: no frame has
  // ended in time, BREAK was sent, a control communication with it. kNoData: no pulse at pin
  // GETSENS in that time (FrameStart::kOnPin); nothing is changed.
  Result<void> next(Frame& frame) {
    frame.clear();
    if (!chip_.automatic && !chip_.restart) {
      return Error::kWrongMode;
    }
    if (chip_.restart && !control_runs()) {
      if (const Result<void> again = restart(); !again) {
        chip_.restart = true;
        return again;
      }
    }
    const Result<void> waited = wait();
    if (!waited) {
      return waited;
    }
    const Result<void> read = poll(frame);
    // kBankSwitched is harmless.
    chip_.restart = read ? !frame.good(chip_.sensors) : read.error() != Error::kBankSwitched;
    return read;
  }

 private:
  static constexpr std::uint8_t kAgs = regs::AGS::encode<1>();

  static Result<void> fetch_all(detail::Chip<Bus, Clock>& chip, void* data) {
    return detail::fetch_data(chip.opcodes, chip.config, chip.sensors,
                              *static_cast<detail::FetchedData*>(data));
  }
  static Result<void> fetch_one(detail::Chip<Bus, Clock>& chip, void* data) {
    return detail::fetch_slave(chip.opcodes, chip.config,
                               *static_cast<detail::FetchedSlave*>(data));
  }

  [[nodiscard]] bool control_runs() const {
    return chip_.control.kind != detail::ControlState::Kind::kNone;
  }

  // Polls until a frame is there, good or bad.
  Result<void> wait() {
    detail::Deadline<Clock> deadline(
        *chip_.clock, frame_timeout_us(chip_.config) + detail::frame_pitch_us(chip_.config));
    bool idle = false;
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      Status status;
      if (const Result<void> look = chip_.look(status); !look) {
        chip_.restart = true;
        return look;
      }
      idle = status.idle();
      // A frame that was bad throughout shows in nSCDERR alone; BREAK of the restart sets it to 1.
      if ((status.valid_mask() & chip_.sensors) != 0 || status.scd_error()) {
        return {};
      }
    }
    if (idle && chip_.config.frame_start == FrameStart::kOnPin) {
      return Error::kNoData;
    }
    const Result<void> stopped = chip_.stop_and_diagnose();
    chip_.restart = true;
    return stopped;
  }

  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_AUTOMATIC_HPP_
