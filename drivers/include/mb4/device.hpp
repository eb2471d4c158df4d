// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 3: one chip. The class that most users need.

#ifndef MB4_DEVICE_HPP_
#define MB4_DEVICE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/acquisition.hpp"
#include "mb4/automatic.hpp"
#include "mb4/bus.hpp"
#include "mb4/chip.hpp"
#include "mb4/config.hpp"
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
      return read.info();
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
  // kInvalidConfig, kUnsupported (not touched); kTransport, kNotDetected, kVerify (touched, the
  // Device counts as not configured). The configuration must not be changed while an encoder frame
  // is wanted: call it at start-up or between frames. No frame runs here.
  Result<void> configure(const Config& config) {
    if (const Result<void> valid = validate(config); !valid) {
      return valid;
    }
    forget();
    if (const Result<void> written =
            write_image(encode_registers(config), encode_interface(config));
        !written) {
      return written;
    }
    chip_.config = config;
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
    const Result<void> same =
        compare(encode_registers(chip_.config), encode_interface(chip_.config), Compare::kRunning);
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
    return write_image(image, 0);
  }

  // INIT of BiSS C (page 33): two pulses at MA on the channels in use, waits until the slaves are
  // ready, and returns the delay of the lines. For start-up and after errors: slaves that are in
  // an undefined state become ready. All error flags return to 1, SVALID to 0. No automatic frames
  // and no control communication may run.
  //
  // Transfers: 0x02 twice (SCDATA1, SCDATA5 = 0), 0x07, 0x05 until INIT = 0 and EOT = 1 within 1343
  // periods of MA and 200 us, 0x05 until SL is 1, 0x03 for each channel in use (twice with
  // SpiCheck::kFull), 0x02 (SVALID).
  //
  // kNotConfigured, kWrongMode, kBusy (not touched); kTransport, kNotDetected; kTimeout (BREAK was
  // sent); kLineDelay: beyond 255 quarters of a period; kLineError: SL is stuck low; kNoData:
  // nothing was measured, there is no system clock; kCorrupted.
  Result<LineDelay> initialize() {
    if (const ErrorInfo no = single_frame_allowed(); no.code != Error::kNone) {
      return no;
    }
    return Initialization<Bus, Clock>(chip_).run();
  }

  // Requests one frame with CDM = 0, waits for its end and returns the data of `slave` (1..8, must
  // be enabled in the configuration).
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
    if (const ErrorInfo no = single_frame_allowed(); no.code != Error::kNone) {
      return no;
    }
    if (slave < 1 || slave > kSlaves || !chip_.config.slaves[slave - 1U].enabled) {
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
    if (const ErrorInfo no = single_frame_allowed(); no.code != Error::kNone) {
      return no;
    }
    return SingleShot<Bus, Clock>(chip_).read_all(frame);
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
  Result<Status> read_status() { return chip_.read_status(); }

  // Clears SVALIDx of `slave` (1..8) and nothing else. One transfer. kInvalidArgument (not
  // touched), kTransport.
  Result<void> clear_valid(std::uint8_t slave) {
    if (slave < 1 || slave > kSlaves) {
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
  enum class Compare : std::uint8_t { kIdle, kRunning };

  void forget() {
    chip_.configured = false;
    chip_.automatic = false;
    chip_.restart = false;
    chip_.control = {};
  }

  Result<void> write_image(const RegisterImage& image, std::uint8_t interface_byte) {
    const std::array<std::uint8_t, 2> stop_and_interface{regs::BREAK::encode<1>(), interface_byte};
    if (const Result<void> write = chip_.opcodes.write_instruction(stop_and_interface); !write) {
      return write;
    }
    if (const Result<void> write = chip_.opcodes.write_registers(kImageFirst, image); !write) {
      return write;
    }
    return compare(image, interface_byte, Compare::kIdle);
  }

  Result<void> compare(const RegisterImage& image, std::uint8_t interface_byte, Compare state) {
    std::array<std::uint8_t, regs::kAddrIface - kImageFirst + 1> bytes{};
    if (const Result<void> read = chip_.opcodes.read_registers(kImageFirst, bytes); !read) {
      return read;
    }
    // Asked first: with nothing on the bus every register is different, which says less.
    if (bytes[regs::kAddrVersion - kImageFirst] !=
        static_cast<std::uint8_t>(regs::DeviceVersion::kIcMb4)) {
      return Error::kNotDetected;
    }
    for (unsigned address = kImageFirst; address < regs::kAddrStatus0; ++address) {
      if (is_compared(address, state) &&
          bytes[address - kImageFirst] != image[address - kImageFirst]) {
        return ErrorInfo::at_register(Error::kVerify, static_cast<std::uint8_t>(address));
      }
    }
    if (bytes[regs::kAddrIface - kImageFirst] != interface_byte) {
      return ErrorInfo::at_register(Error::kVerify, regs::kAddrIface);
    }
    return {};
  }

  // REVISION and VERSION are constant; 0xE0, 0xE1 and 0xEE are reserved, what they read is not
  // promised. 0xE2..0xE5 belong to the control communication of the moment.
  static constexpr bool is_compared(unsigned address, Compare state) {
    const bool control = address >= regs::kAddrRegadr && address <= regs::kAddrCtrl;
    return !(control && state == Compare::kRunning) && (address < 0xE0 || address > 0xE1) &&
           address != 0xEE && address != regs::kAddrRevision && address != regs::kAddrVersion;
  }

  [[nodiscard]] ErrorInfo single_frame_allowed() const {
    if (!chip_.configured) {
      return Error::kNotConfigured;
    }
    if (chip_.control.kind != detail::ControlState::Kind::kNone) {
      return Error::kBusy;
    }
    return chip_.automatic ? ErrorInfo(Error::kWrongMode) : ErrorInfo();
  }

  detail::Chip<Bus, Clock> chip_;
  Fields<Bus> fields_;
};

}  // namespace mb4

#endif  // MB4_DEVICE_HPP_
