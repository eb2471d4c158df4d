// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The driver's errors, the Config members that they concern, and names for both.

#ifndef MB4_ERROR_HPP_
#define MB4_ERROR_HPP_

#include <cstdint>

namespace mb4 {

// Why a call failed. There are three groups:
//  * "not touched": the call made no SPI transfer;
//  * "read only": the call read the chip and changed nothing in it;
//  * "touched": the call wrote to the chip; the text says in which state the chip is left.
enum class Error : std::uint8_t {
  // Success; a Result that holds a value reports this.
  kNone = 0,
  // An argument is out of its documented range. Not touched.
  kInvalidArgument = 1,
  // A Config member has an impossible value; ErrorInfo::field and ::number name it. Not touched.
  kInvalidConfig = 2,
  // The configuration does not allow this call; ErrorInfo names the member that forbids it. Not
  // touched.
  kUnsupported = 3,
  // A frame was requested before configure() has succeeded. Not touched.
  kNotConfigured = 4,
  // Bus::transfer() returned false. Touched: that transfer may have reached the chip in part.
  kTransport = 5,
  // What was read cannot come from an iC-MB4: VERSION is not 0x84, or bits that are constant in
  // the register map (datasheet pages 21, 22) read otherwise. MISO stuck at 0 or at 1, a wrong SPI
  // mode and a missing chip look like this. Read only for probe(); touched for other calls.
  kNotDetected = 6,
  // The configuration reads back differently; ErrorInfo::address() is the first register that
  // differs. Touched: the configuration in the chip must not be used.
  kVerify = 7,
  // The frame, or a register access (time limit: control.hpp), has not ended in time and
  // SL is not stuck: the slave does not answer or takes longer than the timeout, or the chip has no
  // system clock. Touched: BREAK has been sent, the chip is idle; only Automatic::poll() and
  // poll_slave() leave that to the caller.
  kTimeout = 8,
  // SL is low where it must be high. Either the chip refused to start the frame (nAGSERR = 0 and no
  // new data, datasheet pages 32, 34), or the frame did not end and SL is still low well after
  // BREAK: broken or shorted line, slave without supply. Touched: as for kTimeout.
  kLineError = 9,
  // The frame came with a wrong CRC: nSCDERR = 0 or SVALIDx = 0 (datasheet pages 34, 35). Touched:
  // one frame has run, the chip is idle and the next frame may be requested. Automatic::poll() and
  // poll_slave() tell a bad word with a stored CRC once, and only for its slave; without a stored
  // CRC see Automatic::poll().
  kCrc = 10,
  // The frame ended without an error flag but holds no new data of this slave (SVALIDx = 0).
  // Touched: one frame has run, the chip is idle.
  kNoData = 11,
  // The chip reported a good frame, but the bytes read over SPI contradict it: bits above the data
  // length are not 0, the stored CRC does not match the data, or (SpiCheck::kFull) a second reading
  // differs. Touched as for kCrc.
  kCorrupted = 12,
  // A register access has failed (nREGERR = 0, page 34). Causes: no slave has this ID; a CRC was
  // wrong; the slave did not repeat the written value; frames do not end because no slave is on the
  // line; or no slave of BiSS B has entered register mode (nAGSERR = 0).
  // ErrorInfo::bytes() registers were good. Touched: the access has ended. After a write the first
  // registers may have changed; the one after ErrorInfo::bytes() may hold neither the old nor the
  // new value.
  kRegister = 13,
  // The slave has not sent its start bit in time (nDELAYERR = 0, page 34): it does not have this
  // register or takes too long. ErrorInfo::bytes() and state as for kRegister.
  kRegisterDelay = 14,
  // The addressed slaves did not acknowledge a command (nREGERR = 0, page 34). Touched: with the
  // IDA test the slaves have not executed it; without the test they may have.
  kCommand = 15,
  // A control communication is running; poll or abort it first. A read of positions: an actuator
  // holds the bank between the steps of its operation, or, below SpiCheck::kFull, a request is in
  // the chip and has not begun. Any call but verify(), configure(), reset() and those that only
  // stop:
  // an operation with SpiCheck::kFull compares the configuration, or was given up before it could.
  // Not touched.
  kBusy = 16,
  // The call needs automatic frames and they do not run, or they run and the call forbids them; or
  // mb4_slave_poll() finds nothing that was begun. Not touched.
  kWrongMode = 17,
  // A read without HOLDBANK beside a control communication (Config::hold_beside_access = false),
  // and the chip switched the banks twice meanwhile. Touched: SVALID of one frame is cleared. This
  // is no fault; read again.
  kBankSwitched = 18,
  // INIT: the line delay is more than 255 quarters of a period of MA (nAGSERR = 0, page 33).
  // Touched: INIT has ended, the chip is idle.
  kLineDelay = 19,
  // PositionTracker: the position has moved further than the allowed step. No chip is involved.
  kJump = 20,
  // The word has come with a right CRC, and its nE is 0: the encoder says that its position is not
  // to be trusted. Result::value() refuses it, Result::reading() gives it. The frame was good in
  // every other way: nothing is lost, the chip is idle or the frames go on.
  kSlaveError = 21,
  // BiSS C: the slave has acknowledged the frame and has sent no word: all data bits and the CRC's
  // bits are 0 on the line, and SL is 1 again. Its single-cycle data is switched off (broadcast
  // command 00; Control::activate()), or its output is dead. Touched as for kCrc.
  kNoWord = 22,
};

// The Config member that an error concerns. Values are stable; new ones are added at the end.
enum class ConfigField : std::uint8_t {
  kNone = 0,
  kClkHz,                 // Config::f_clk_hz
  kClockSource,           // Config::clock_source
  kMaHz,                  // Config::ma_hz
  kLineInterface,         // Config::line_interface
  kFrameStart,            // Config::frame_start
  kFrameTimeoutUs,        // Config::frame_timeout_us
  kChannelProtocol,       // Config::channels[number - 1].protocol
  kSlaveEnabled,          // Config::slaves[number - 1].enabled
  kDataBits,              // Config::slaves[number - 1].data_bits
  kFlags,                 // Config::slaves[number - 1].flags
  kCrcPolynomial,         // Config::slaves[number - 1].crc_polynomial
  kCrcStart,              // Config::slaves[number - 1].crc_start
  kFramePeriodClk,        // Config::frame_period_clk
  kSingleBank,            // Config::single_bank
  kRegisterBusyUs,        // Config::register_busy_us
  kSpiCheck,              // Config::spi_check
  kGray,                  // Config::slaves[number - 1].gray
  kActuator,              // Config::slaves[number - 1].actuator
  kMo,                    // Config::mo
  kMoBusy,                // Config::mo_busy
  kRegisterDivider,       // Config::register_divider
  kRegisterTimeoutUs,     // Config::register_timeout_us
  kActivateAtInitialize,  // Config::activate_at_initialize
  kPinPeriodUs,           // Config::pin_period_us
};

// An error with the place that it concerns. It has four bytes and fits a processor register.
struct alignas(4) ErrorInfo {
  Error code = Error::kNone;
  // For kInvalidConfig and kUnsupported; otherwise kNone.
  ConfigField field = ConfigField::kNone;
  // Slave 1..8 or channel 1..2 that `field` belongs to; 0 for the whole chip.
  std::uint8_t number = 0;
  // See address() and bytes().
  std::uint8_t detail = 0;

  constexpr ErrorInfo() = default;
  constexpr ErrorInfo(Error error) : code(error) {}
  constexpr ErrorInfo(Error error, ConfigField which, std::uint8_t which_number)
      : code(error), field(which), number(which_number) {}

  [[nodiscard]] static constexpr ErrorInfo at_register(Error error, std::uint8_t register_address) {
    ErrorInfo info(error);
    info.detail = register_address;
    return info;
  }

  // Register address for kVerify; otherwise 0.
  [[nodiscard]] constexpr std::uint8_t address() const {
    return code == Error::kVerify ? detail : std::uint8_t{0};
  }
  // For kRegister, kRegisterDelay and a timeout of a register access: registers that were
  // transferred before the error, over all parts of a long access; otherwise 0.
  [[nodiscard]] constexpr std::uint8_t bytes() const {
    return code == Error::kVerify ? std::uint8_t{0} : detail;
  }

  // The form in which a Result keeps it (enc/result.hpp).
  [[nodiscard]] static constexpr std::uint32_t pack(ErrorInfo info) {
    return static_cast<std::uint32_t>(info.code) | static_cast<std::uint32_t>(info.field) << 8U |
           std::uint32_t{info.number} << 16U | std::uint32_t{info.detail} << 24U;
  }
  [[nodiscard]] static constexpr ErrorInfo unpack(std::uint32_t packed) {
    ErrorInfo info(static_cast<Error>(packed & 0xFFU),
                   static_cast<ConfigField>(packed >> 8U & 0xFFU),
                   static_cast<std::uint8_t>(packed >> 16U));
    info.detail = static_cast<std::uint8_t>(packed >> 24U);
    return info;
  }
};

// Short stable names for messages; they cost program memory only where they are used.
[[nodiscard]] constexpr const char* to_string(Error error) {
  switch (error) {
    case Error::kNone:
      return "none";
    case Error::kInvalidArgument:
      return "invalid argument";
    case Error::kInvalidConfig:
      return "invalid configuration";
    case Error::kUnsupported:
      return "not with this configuration";
    case Error::kNotConfigured:
      return "not configured";
    case Error::kTransport:
      return "SPI transfer failed";
    case Error::kNotDetected:
      return "no iC-MB4 detected";
    case Error::kVerify:
      return "configuration reads back differently";
    case Error::kTimeout:
      return "frame did not end in time";
    case Error::kLineError:
      return "SL low at the start of the frame";
    case Error::kCrc:
      return "CRC error";
    case Error::kNoData:
      return "frame without data";
    case Error::kCorrupted:
      return "data corrupted on SPI";
    case Error::kRegister:
      return "register access failed";
    case Error::kRegisterDelay:
      return "slave does not have the register or is too slow";
    case Error::kCommand:
      return "command not acknowledged";
    case Error::kBusy:
      return "control communication running";
    case Error::kWrongMode:
      return "wrong mode for automatic frames";
    case Error::kBankSwitched:
      return "bank switched while reading";
    case Error::kLineDelay:
      return "line delay too long";
    case Error::kJump:
      return "position jumped";
    case Error::kSlaveError:
      return "encoder reports an error (nE = 0)";
    case Error::kNoWord:
      return "slave acknowledges and sends no word";
  }
  return "unknown";
}

[[nodiscard]] constexpr const char* to_string(ConfigField field) {
  switch (field) {
    case ConfigField::kNone:
      return "none";
    case ConfigField::kClkHz:
      return "f_clk_hz";
    case ConfigField::kClockSource:
      return "clock_source";
    case ConfigField::kMaHz:
      return "ma_hz";
    case ConfigField::kLineInterface:
      return "line_interface";
    case ConfigField::kFrameStart:
      return "frame_start";
    case ConfigField::kFrameTimeoutUs:
      return "frame_timeout_us";
    case ConfigField::kChannelProtocol:
      return "protocol";
    case ConfigField::kSlaveEnabled:
      return "enabled";
    case ConfigField::kDataBits:
      return "data_bits";
    case ConfigField::kFlags:
      return "flags";
    case ConfigField::kCrcPolynomial:
      return "crc_polynomial";
    case ConfigField::kCrcStart:
      return "crc_start";
    case ConfigField::kFramePeriodClk:
      return "frame_period_clk";
    case ConfigField::kSingleBank:
      return "single_bank";
    case ConfigField::kRegisterBusyUs:
      return "register_busy_us";
    case ConfigField::kSpiCheck:
      return "spi_check";
    case ConfigField::kGray:
      return "gray";
    case ConfigField::kActuator:
      return "actuator";
    case ConfigField::kMo:
      return "mo";
    case ConfigField::kMoBusy:
      return "mo_busy";
    case ConfigField::kRegisterDivider:
      return "register_divider";
    case ConfigField::kRegisterTimeoutUs:
      return "register_timeout_us";
    case ConfigField::kActivateAtInitialize:
      return "activate_at_initialize";
    case ConfigField::kPinPeriodUs:
      return "pin_period_us";
  }
  return "unknown";
}

}  // namespace mb4

#endif  // MB4_ERROR_HPP_
