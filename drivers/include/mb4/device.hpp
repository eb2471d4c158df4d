// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 3: one chip. The class that most users need.

#ifndef MB4_DEVICE_HPP_
#define MB4_DEVICE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/acquisition.hpp"
#include "mb4/actuator.hpp"
#include "mb4/automatic.hpp"
#include "mb4/bus.hpp"
#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/configuration.hpp"
#include "mb4/control.hpp"
#include "mb4/fields.hpp"
#include "mb4/frame.hpp"
#include "mb4/initialization.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/reading.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// What the chip says it is (tables 41, 42, page 31).
struct Identity {
  std::uint8_t version = 0;   // 0x84; a regs::DeviceVersion
  std::uint8_t revision = 0;  // 0x10 Z, 0x11 Z1, 0x20 Y; others are reported as they are
};

// One iC-MB4 or compatible chip on an SPI bus.
//
// `Bus` and `Clock` obey the contracts in bus.hpp and outlive the Device. No heap, no global state:
// any number of devices side by side. Size: a Config, two pointers and a few flags.
//
// Interrupt safety: no call may be interrupted by another call on the same Device, and all calls
// of one Device belong in one context (main loop or one interrupt). Different devices are
// independent as far as their buses are. Calls block until their transfers are done; the number of
// transfers is stated for each.
template <typename Bus, typename Clock>
class Device {
 public:
  constexpr Device(Bus& bus, Clock& clock) : chip_(bus, clock), fields_(chip_.opcodes) {}

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

  // Validates `config` completely, then stops whatever the chip is doing (BREAK, AGS off), writes
  // all configuration registers, reads them back and compares. Three transfers:
  //   0x07  0xF4, 0xF5   BREAK, clock source and interface
  //   0x02  0xC0..0xF2   everything else; clears SVALID 1 to 8
  //   0x03  0xC0..0xF5   comparison of all bits that can be written, and of VERSION
  // kInvalidConfig (not touched); kTransport, kNotDetected, kVerify (touched, the
  // Device counts as not configured). The configuration must not be changed while an encoder frame
  // is wanted: call it at start-up or between frames. No frame runs here.
  Result<void> configure(const Config& config) {
    if (const Result<void> valid = validate(config); !valid) {
      return valid;
    }
    forget();
    if (const Result<void> written = Configuration<Bus, Clock>(chip_).write(
            encode_registers(config), encode_interface(config));
        !written) {
      return written;
    }
    chip_.config = config;
    chip_.sensors = sensors(config);
    chip_.actuators = actuators(config);
    chip_.configured = true;
    chip_.recover_first = false;
    return {};
  }

  // Reads the configuration back and compares it, as configure() does: has a disturbed transfer or
  // a supply dip changed it? One transfer (0x03 from 0xC0, 56 bytes), changes nothing. Registers of
  // control communications are not compared. kNotConfigured (not touched), kTransport;
  // kNotDetected, kVerify: the Device counts as not configured from now on, configure() again.
  Result<void> verify() {
    if (!chip_.configured) {
      return Error::kNotConfigured;
    }
    const Result<void> same = Configuration<Bus, Clock>(chip_).compare(
        encode_registers(chip_.config), encode_interface(chip_.config), true);
    if (same.error() == Error::kNotDetected || same.error() == Error::kVerify) {
      chip_.configured = false;
    }
    return same;
  }

  // BREAK, then all registers of the configuration as after power-on (page 21: all 0), compared.
  // Three transfers, as configure(). The data memories keep their contents. kTransport,
  // kNotDetected, kVerify (touched). The Device counts as not configured, whatever comes of it.
  Result<void> reset() {
    forget();
    RegisterImage image{};
    image[regs::kAddrSlaveloc5 - kImageFirst] = kSlaveloc5Constant;
    return Configuration<Bus, Clock>(chip_).write(image, 0);
  }

  // INIT (page 33), in BiSS C two pulses at MA: waits until the slaves are ready, and returns the
  // delay of the lines. Without a channel of BiSS C it is the hand-over of BiSS B, with SSI alone
  // it resets flags only; nothing is measured then. For start-up and after errors: slaves that are
  // in an undefined state become ready. All error flags return to 1, SVALID to 0. No automatic
  // frames and no control communication may run.
  //
  // Transfers: 0x02 twice (SCDATA1, SCDATA5 = 0), with BiSS B 0x02 (0xE5), 0x07, 0x05 until INIT =
  // 0 and EOT = 1 within 1343 periods of MA (BiSS B alone: 4096 register clocks) and 200 us, 0x05
  // until SL is 1, 0x03 for each channel that is measured, 0x02 (SVALID); with SpiCheck::kFull some
  // are read again.
  //
  // kNotConfigured, kWrongMode, kBusy (not touched); kTransport, kNotDetected; kTimeout (BREAK was
  // sent); kLineDelay: beyond 255 quarters of a period; kLineError: SL is stuck low, or in BiSS B
  // no slave has answered; kNoData: nothing was measured, there is no system clock; kCorrupted.
  Result<LineDelay> initialize() {
    if (const Result<void> allowed = single_frame_allowed(); !allowed) {
      return allowed.failure();
    }
    LineDelay delay;
    const Result<void> done = Initialization<Bus, Clock>(chip_).run(delay);
    return done ? Result<LineDelay>(delay) : Result<LineDelay>(done.failure());
  }

  // Requests one frame with CDM = 0, waits for its end and returns the data of `slave` (1..8, must
  // be an enabled sensor of the configuration).
  //
  // Transfers of a good read: 3 + p, where p >= 1 is the number of status polls, with
  // SpiCheck::kFull at most 4 more (1 for data again where no stored CRC proves it, 1 status behind
  // the data, 1 or 2 behind the clearing of SVALID); 2 more and 100 us
  // after a failed read that has made a transfer, because its frame may still run. Each poll is 6
  // bytes, and p is limited by frame_timeout_us(config): at most t + t/16 + 2 polls for t
  // microseconds even if the clock stands still. In order:
  //   0x07  BREAK, then 100 us for the slaves' timeout  (after a failed read)
  //   0x02  SVALID of the enabled slaves = 0            (after a failed read)
  //   0x07  INSTR = 010
  //   0x05  0xF0..0xF4, repeated until EOT = 1 and INSTR = 0
  //   0x09  SCDATA1, 1..8 bytes (0x03 with its address for slaves 2 to 8)
  //   0x02  SVALID of the enabled slaves = 0
  //
  // kNotConfigured, kInvalidArgument, kWrongMode (automatic frames run), kBusy (not touched);
  // kTransport; kNotDetected (status cannot be that of an iC-MB4); kTimeout, kLineError (BREAK was
  // sent); kCrc, kNoData, kCorrupted. A Reading is returned only for a good frame that began after
  // this request; whether the slave itself trusts its position is Reading::error.
  //
  // Sets HOLDBANK and SWBANK to 0, as any single frame does.
  Result<Reading> read_frame(std::uint8_t slave = 1) {
    if (const Result<void> allowed = single_frame_allowed(); !allowed) {
      return allowed.failure();
    }
    if (!is_in(chip_.sensors, slave)) {
      return Error::kInvalidArgument;
    }
    return SingleShot<Bus, Clock>(chip_).read(slave);
  }

  // The same for all enabled slaves with one frame. Transfers as for read_frame(), but 1..n for the
  // data of n slaves (once more as many with SpiCheck::kFull): only the bytes that they need, in as
  // few bursts as pays; none if no slave is good.
  //
  // Success means that the frame has ended; what became of each slave is in frame[slave]. Errors of
  // the call are about the whole frame: those of read_frame() except kCrc, kNoData, kCorrupted. On
  // error `frame` holds no Reading.
  Result<void> read_all(Frame& frame) {
    if (const Result<void> allowed = single_frame_allowed(); !allowed) {
      return allowed.failure();
    }
    return SingleShot<Bus, Clock>(chip_).read_all(frame);
  }

  // Gives the actuator `slave` (1..8) the word that it takes with each frame from the next one on:
  // its low data_bits; the chip adds stop bit and CRC. Transfers: 0x02, 0x07, 0x02, 0x07, with
  // single_bank only 0x02; with automatic frames 0x07, 0x02, 0x07 for one bank, 0x03 until the end
  // of a frame has switched, at most for one frame's time and its timeout, and the same for the
  // other bank. With SpiCheck::kFull all writes are read back.
  //
  // kNotConfigured, kBusy, kInvalidArgument (no actuator, or the word has more bits; not touched);
  // kTransport, kNotDetected, kCorrupted (touched: the word may go out or not; write it again).
  Result<void> write_actuator(std::uint8_t slave, std::uint64_t word) {
    if (const Result<void> allowed = single_frame_allowed();
        !allowed && allowed.error() != Error::kWrongMode) {
      return allowed;
    }
    return ActuatorWrite<Bus, Clock>(chip_).write(slave, word, true);
  }

  // Writes BREAK (page 33): aborts a frame, a control communication and AGS at once, MA returns to
  // 1, the error flags return to 1. One transfer. kTransport. The configuration stays. The next
  // read gives the slaves 100 us for their timeout first.
  Result<void> break_transmission() {
    chip_.recover_first = true;
    chip_.restart = false;
    return chip_.write_break();
  }

  // 0xF0..0xF4 in one transfer; changes nothing. kTransport, kNotDetected.
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
    return chip_.clear_valid(static_cast<std::uint8_t>(1U << (slave - 1U)));
  }

  // Frames that come by themselves; see automatic.hpp. Cheap to make, keeps nothing itself.
  [[nodiscard]] Automatic<Bus, Clock> automatic() { return Automatic<Bus, Clock>(chip_); }
  // Registers of the slaves and commands; see control.hpp. Cheap to make, keeps nothing itself.
  [[nodiscard]] Control<Bus, Clock> control() { return Control<Bus, Clock>(chip_); }

  // The lower layers, for what Device does not cover. See their headers for what they do not
  // protect from.
  [[nodiscard]] Fields<Bus>& fields() { return fields_; }
  [[nodiscard]] Opcodes<Bus>& opcodes() { return chip_.opcodes; }

  // True after a successful configure().
  [[nodiscard]] bool configured() const { return chip_.configured; }
  // The configuration in the chip; meaningful if configured().
  [[nodiscard]] const Config& config() const { return chip_.config; }

 private:
  void forget() {
    chip_.configured = false;
    chip_.automatic = false;
    chip_.restart = false;
    chip_.control = {};
  }

  [[nodiscard]] Result<void> single_frame_allowed() const {
    if (!chip_.configured) {
      return Error::kNotConfigured;
    }
    if (chip_.control.kind != detail::ControlState::Kind::kNone) {
      return Error::kBusy;
    }
    return chip_.automatic ? Error::kWrongMode : Error::kNone;
  }

  detail::Chip<Bus, Clock> chip_;
  Fields<Bus> fields_;
};

}  // namespace mb4

#endif  // MB4_DEVICE_HPP_
