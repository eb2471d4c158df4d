// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// One chip. Most users need only this class.

#ifndef MB4_DEVICE_HPP_
#define MB4_DEVICE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/automatic.hpp"
#include "mb4/bus.hpp"
#include "mb4/config.hpp"
#include "mb4/control.hpp"
#include "mb4/detail/blocking.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/error.hpp"
#include "mb4/fields.hpp"
#include "mb4/frame.hpp"
#include "mb4/line_delay.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/operation.hpp"
#include "mb4/reading.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Identity of the chip (tables 41, 42, page 31).
struct Identity {
  std::uint8_t version = 0;   // 0x84; a regs::DeviceVersion
  std::uint8_t revision = 0;  // 0x10 Z, 0x11 Z1, 0x20 Y; probe() accepts every value
};

// One iC-MB4 or compatible chip on an SPI bus.
//
// `Bus` and `Clock` obey the contracts in bus.hpp and outlive the Device. A Device uses no heap and
// no global state, so a program can have any number of them. Size: a Config, pointers and a few
// flags.
//
// Interrupt safety: no call may be interrupted by another call on the same Device, and all calls
// of one Device belong in one context (main loop or one interrupt). Different devices are
// independent if their buses are. Calls block until their transfers are done, except plan calls and
// finish(), which make none; the comment of each call states the number of transfers.
template <typename Bus, typename Clock>
class Device {
 public:
  constexpr Device(Bus& bus, Clock& clock) : chip_(bus, clock), fields_(chip_.opcodes) {}
  // What a Device knows about its chip must exist once: a copy would read a frame twice, or request
  // one that already runs.
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // Reads VERSION and REVISION. One transfer, changes nothing.
  // kTransport; kNotDetected: VERSION is not 0x84 (an iC-MB3 says 0x83).
  Result<Identity> probe() {
    std::array<std::uint8_t, 2> bytes{};
    static_assert(regs::kAddrVersion == regs::kAddrRevision + 1);
    if (const Result<void> read = chip_.opcodes.read_registers(regs::kAddrRevision, bytes); !read) {
      return read.failure();
    }
    if (bytes[1] != static_cast<std::uint8_t>(regs::DeviceVersion::kIcMb4)) {
      return Error::kNotDetected;
    }
    Identity identity;
    identity.revision = bytes[0];
    identity.version = bytes[1];
    return identity;
  }

  // Validates `config` completely, then stops all activity of the chip (BREAK, AGS off), writes all
  // configuration registers, reads them back and compares them. Eight transfers:
  //   0x07        0xF4, 0xF5   BREAK, clock source and interface
  //   0x02 three  0xC0..0xF2   all other registers; clears SVALID 1 to 8
  //   0x03 three  0xC0..0xF5   comparison of all bits that can be written, and of VERSION
  //   0x05        status       which no stuck MISO makes; 0xF4 and SVALID are 0
  // Behind the first three it waits for the slaves' timeout: 100 us, with BiSS B also
  // register_timeout_us, because BREAK may have cut a frame.
  // One more before them, which only reads, if actuators are on both channels and these have
  // frames of different length: VERSION and REVISION.
  // Not touched: kInvalidConfig. Read only: kInvalidConfig for what this revision cannot do
  // (validate() with a revision). Touched: kTransport, kNotDetected, kVerify. After an error that
  // is not "not touched" the Device counts as not configured. The call ends a frame that runs and
  // starts none: call it at start-up or between frames.
  Result<void> configure(const Config& config) {
    const Result<void> valid = validate(config);
    if (valid) {
      detail::Procedures::plan_configure(chip_, chip_.own, config);
    }
    return detail::Blocking::run(chip_, valid);
  }

  // Begins configure() without a transfer: the caller makes the frames of `operation` and calls
  // finish() until it returns true. Five steps. This call checks and encodes the configuration, so
  // it takes longer than other plan calls. Not touched: kInvalidConfig. operation.result():
  // kTransport, kNotDetected, kVerify, kInvalidConfig as of configure(). Wrong use: operation.hpp.
  Result<void> plan_configure(Operation& operation, const Config& config) {
    const Result<void> allowed = detail::Procedures::possible(operation, validate(config));
    if (allowed) {
      detail::Procedures::plan_configure(chip_, operation, config);
    }
    return allowed;
  }

  // Reads the configuration back and compares it as configure() does. It finds a configuration that
  // a disturbed transfer or a supply dip has changed. Four transfers, three of 18 to 20 bytes (0x03
  // from 0xE2, 0xC0 and 0xD0) and a status with 0xF5; it changes nothing in the chip. Beside
  // automatic frames SpiCheck::kFull reads SCDATA1 before the status: the third reading may have
  // become a write there. The request of a control communication that runs is not compared.
  // kNotConfigured (not touched), kTransport. kNotDetected, kVerify: the Device then counts as not
  // configured; call configure() again. Where reads are kBusy because an operation with
  // SpiCheck::kFull was given up, it ends this; then kTransport means not configured too, and
  // kCorrupted that automatic frames have stopped.
  Result<void> verify() { return detail::Blocking::verify(chip_); }

  // Begins verify() without a transfer: the caller makes the frames of `operation` and calls
  // finish() until it returns true. Three steps, the last one of two or three frames, which may
  // stand beside reads of positions and a control communication that runs. kNotConfigured (not
  // touched). operation.result(): kTransport, kNotDetected, kVerify as of verify(). Wrong use:
  // operation.hpp.
  Result<void> plan_verify(Operation& operation) {
    const Result<void> allowed = detail::Procedures::possible(
        operation, chip_.configured ? Error::kNone : Error::kNotConfigured);
    if (allowed) {
      detail::Procedures::plan_verify(chip_, operation);
    }
    return allowed;
  }

  // Takes what came back for an operation that a plan call has begun (operation.hpp).
  // `transferred`: all its frames were made, in order. `now_us`: the time, as Clock::now_us()
  // counts it. True: the operation has ended, see its result(). False: make the frames that it
  // holds now, and call it again. It makes no transfer and does not ask for the time.
  [[nodiscard]] bool finish(Operation& operation, bool transferred, std::uint32_t now_us) {
    return detail::Procedures::finish(chip_, operation, transferred, now_us);
  }

  // Sends BREAK, then writes all registers of the configuration to their value after power-on
  // (page 21: all 0) and compares them. Eight transfers, as configure(), without its pause. The
  // data memories keep their contents. kTransport, kNotDetected, kVerify (touched). After the call,
  // with or without error, the Device counts as not configured.
  Result<void> reset() {
    detail::Procedures::plan_reset(chip_, chip_.own);
    return detail::Blocking::run(chip_, chip_.own);
  }

  // Runs INIT (page 33): two pulses at MA in BiSS C. The call waits until the slaves are ready and
  // returns the delay of the lines. Use it at start-up and after errors: slaves that are in an
  // undefined state become ready. INIT sets all error flags to 1 and SVALID to 0. Without a BiSS C
  // channel nothing is measured: in BiSS B INIT is the hand-over, with SSI alone it only resets
  // flags. No automatic frames and no control communication may run.
  //
  // Where a slave of BiSS C has a CRC and no actuator is configured, one frame follows, whose data
  // nobody gets: a slave whose data channel is off answers to INIT too. If a word was not sent, the
  // result is kNoWord. Any other fault of this frame is left to the reads.
  //
  // Transfers: 0x02 twice (SCDATA1, SCDATA5 = 0), with BiSS B 0x02 (0xE5), 0x07, 0x05 until INIT =
  // 0 and EOT = 1 within 1343 periods of MA (BiSS B alone: 4096 register clocks) and 200 us, 0x05
  // until SL is 1, 0x03 for each channel that is measured, 0x02 (SVALID); for the frame 0x07, 0x05
  // until it has ended, 0x02 (SVALID), and 0x03 for each bad word. SpiCheck::kFull reads some of
  // them again. With Config::activate_at_initialize the transfers of Control::activate() come
  // before the frame.
  //
  // Not touched: kNotConfigured, kWrongMode, kBusy. Touched: kTransport, kNotDetected; kTimeout
  // (BREAK was sent); kLineDelay: the delay is more than 255 quarters of a period of MA;
  // kLineError: SL is stuck low, or in BiSS B no slave has answered; kNoData: nothing was measured,
  // because the chip has no system clock; kCorrupted; kNoWord;
  // kCommand: as of Control::activate().
  Result<LineDelay> initialize() { return detail::Blocking::initialize(chip_); }

  // Begins initialize() without a transfer: the caller makes the frames of `operation` and calls
  // finish() until it returns true; then operation.line_delay(). After a failed read one step
  // begins after a pause; another one if no channel is BiSS C. kNotConfigured, kWrongMode, kBusy:
  // not touched. operation.result(): kTransport, kNotDetected, kTimeout, kLineDelay, kLineError,
  // kNoData, kCorrupted, kNoWord, kCommand as of initialize(); kWrongMode (operation.hpp).
  Result<void> plan_initialize(Operation& operation) {
    const Result<void> allowed =
        detail::Procedures::possible(operation, chip_.single_frame_allowed());
    if (allowed) {
      detail::Procedures::plan_initialize(chip_, operation);
    }
    return allowed;
  }

  // Requests one frame with CDM = 0, waits for its end and returns the data of `slave` (1..8, an
  // enabled sensor of the configuration).
  //
  // Transfers of a good read: 3 + p, where p >= 1 is the number of status polls.
  //  * SpiCheck::kFull adds at most 4: 1 for data again where no stored CRC proves it or an address
  //    was sent (0x03), 1 status after the data, 1 or 2 after SVALID is cleared.
  //  * After a failed read that has made a transfer, 2 more and 100 us, because its frame may still
  //    run. BiSS B adds register_timeout_us. SpiCheck::kFull adds a status.
  //  * Each poll is 6 bytes. frame_timeout_us(config) limits p: at most 4 t + 132 polls for t
  //    microseconds, even if the clock stands still.
  // In order:
  //   0x07  BREAK, then 100 us for the slaves' timeout  (after a failed read)
  //   0x02  SVALID of the enabled slaves = 0            (after a failed read)
  //   0x07  INSTR = 010
  //   0x05  0xF0..0xF4, repeated until EOT = 1 and INSTR = 0
  //   0x09  SCDATA1, 1..8 bytes (0x03 with its address for slaves 2 to 8)
  //   0x02  SVALID of the enabled slaves = 0
  //
  // Not touched: kNotConfigured, kInvalidArgument, kWrongMode (automatic frames run), kBusy.
  // Touched: kTransport; kNotDetected (the status cannot come from an iC-MB4); kTimeout, kLineError
  // (BREAK was sent); kCrc, kNoData, kCorrupted; kNoWord: BiSS C, the word is all 0, CRC too, while
  // the line is at 1 again (1 transfer more, up to 100 us while it is 0). The call returns a
  // Reading only for a good frame that began after this request. kSlaveError: so does one whose nE
  // is 0; Result::reading() has it.
  //
  // Sets HOLDBANK and SWBANK to 0, as any single frame does.
  Result<Reading> read_frame(std::uint8_t slave = 1) {
    return detail::Blocking::read_frame(chip_, slave);
  }

  // Reads all enabled slaves with one frame. Transfers as for read_frame(), but 1..n for the data
  // of n slaves; SpiCheck::kFull adds up to n. Only bytes that hold data are read; slaves share a
  // burst where this needs fewer bytes. The data of a bad word is read for kNoWord only: BiSS C
  // with a CRC.
  //
  // Success means that the frame has ended; frame[slave] holds the result of each slave,
  // kSlaveError where nE is 0. Errors of the call concern the whole frame: those of read_frame()
  // except kCrc and kNoData. On error `frame` holds no Reading.
  Result<void> read_all(Frame& frame) { return detail::Blocking::read_all(chip_, frame); }

  // Begins read_all() without a transfer: the caller makes the frames of `operation`, whose memory
  // is that of `read`, and calls finish() until it returns true; then read.result(frame). Two steps
  // and one for each poll; after a failed read one more, and the next one begins after a pause.
  // SpiCheck::kFull needs up to four more. No frame is longer than 66 bytes. Not touched:
  // kNotConfigured, kWrongMode, kBusy. read.result(): the errors of read_all().
  Result<void> plan_read_all(Operation& operation, FrameRead& read) {
    const Result<void> allowed =
        detail::Procedures::possible(operation, chip_.single_frame_allowed());
    if (allowed) {
      detail::Procedures::plan_frame(chip_, operation, read, chip_.words.data(), chip_.count);
    }
    return allowed;
  }

  // Writes the word that the chip sends to the actuator `slave` (1..8) with each frame, from the
  // next frame on. `word` has at most data_bits bits; the chip adds stop bit and CRC.
  //
  // Transfers; SpiCheck::kFull reads back each write by one more, looks at the status behind it and
  // behind 0x07, and reads the word twice where it looks for the other bank:
  //   without automatic frames  0x02, 0x07, 0x02, 0x07; with single_bank only 0x02
  //   with automatic frames     0x07, 0x02, 0x07 for one bank; 0x03 and 0x05 until the end of a
  //                             frame has switched the banks; 0x07, 0x02, 0x07 for the other bank;
  //                             0x03 and 0x05 until no bank has shown another word for
  //                             frame_timeout_us() and one frame period
  //
  // Not touched: kNotConfigured, kBusy, kInvalidArgument (`slave` is no actuator, or the word has
  // too many bits). Touched: kTransport, kNotDetected, kCorrupted; the chip may send the word or
  // not, write it again.
  Result<void> write_actuator(std::uint8_t slave, std::uint64_t word) {
    return detail::Blocking::run(chip_, plan_word(chip_.own, slave, word, actuator_allowed()));
  }

  // Begins write_actuator() without a transfer: the caller makes the frames of `operation` and
  // calls finish() until it returns true. Four steps, the third after a pause; with automatic
  // frames two, and one for each look at the other bank. SpiCheck::kFull needs three instead of one
  // for a bank. Not touched: kNotConfigured, kBusy, kInvalidArgument. operation.result():
  // kTransport, kNotDetected, kCorrupted as of write_actuator().
  Result<void> plan_actuator(Operation& operation, std::uint8_t slave, std::uint64_t word) {
    return plan_word(operation, slave, word,
                     detail::Procedures::possible(operation, actuator_allowed()));
  }

  // Writes BREAK (page 33): it aborts a frame, a control communication and AGS at once; MA and the
  // error flags return to 1. The configuration stays. One transfer; one or two more if it ends a
  // control communication. With SpiCheck::kFull a status proves it, and all is sent once more where
  // 0xF4 is not 0. kTransport; kCorrupted as of Control::poll(), for the request at rest; with
  // SpiCheck::kFull kNotDetected, and kCorrupted: the second one has not come either.
  // The next read first waits 100 us for the slaves' timeout.
  Result<void> break_transmission() {
    detail::Procedures::plan_stop(chip_, chip_.own, regs::BREAK::encode<1>(), false);
    return detail::Blocking::run(chip_, chip_.own);
  }

  // Begins break_transmission() without a transfer: one step of one frame, or up to four. It ends
  // an access of another Operation, whose finish() then says so (operation.hpp). kBusy: the
  // operation of this object has not ended. operation.result(): kTransport, kNotDetected,
  // kCorrupted.
  Result<void> plan_break(Operation& operation) {
    const Result<void> allowed = detail::Procedures::possible(operation, Error::kNone);
    if (allowed) {
      detail::Procedures::plan_stop(chip_, operation, regs::BREAK::encode<1>(), false);
    }
    return allowed;
  }

  // Reads 0xF0..0xF4 in one transfer; changes nothing. kTransport, kNotDetected.
  Result<Status> read_status() {
    Status status;
    const Result<void> read = chip_.look(status);
    return read ? Result<Status>(status) : Result<Status>(read.failure());
  }

  // Clears SVALIDx of `slave` (1..8) and nothing else. One transfer. kInvalidArgument (not
  // touched), kTransport.
  Result<void> clear_valid(std::uint8_t slave) {
    if (!is_in(0xFF, slave)) {
      return Error::kInvalidArgument;
    }
    return chip_.clear_valid(flag_of(slave));
  }

  // Automatic frames; see automatic.hpp, `With` too. The returned object holds only a reference to
  // this Device.
  template <std::uint8_t With = MB4_WITH_ALL>
  [[nodiscard]] Automatic<Bus, Clock, With> automatic() {
    return Automatic<Bus, Clock, With>(chip_);
  }
  // Registers of the slaves and commands; see control.hpp. The returned object holds only a
  // reference to this Device.
  [[nodiscard]] Control<Bus, Clock> control() { return Control<Bus, Clock>(chip_); }

  // The lower layers, for what Device does not cover. Their headers state what they do not protect.
  [[nodiscard]] Fields<Bus>& fields() { return fields_; }
  [[nodiscard]] Opcodes<Bus>& opcodes() { return chip_.opcodes; }

  // True after a successful configure().
  [[nodiscard]] bool configured() const { return chip_.configured; }
  // The configuration in the chip; meaningful if configured().
  [[nodiscard]] const Config& config() const { return chip_.config; }

 private:
  [[nodiscard]] Result<void> actuator_allowed() const {
    const Result<void> allowed = chip_.single_frame_allowed();
    return allowed.error() == Error::kWrongMode ? Result<void>() : allowed;
  }
  Result<void> plan_word(Operation& operation, std::uint8_t slave, std::uint64_t word,
                         const Result<void>& allowed) {
    return allowed ? detail::Procedures::plan_actuator(chip_, operation, slave, word, true)
                   : allowed;
  }

  detail::Chip<Bus, Clock> chip_;
  Fields<Bus> fields_;
};

}  // namespace mb4

#endif  // MB4_DEVICE_HPP_
