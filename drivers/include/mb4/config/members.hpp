// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The configuration of the chip in real units (Hz, us, bits). validate() checks it.

#ifndef MB4_CONFIG_MEMBERS_HPP_
#define MB4_CONFIG_MEMBERS_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4_regs.hpp"

namespace mb4 {

inline constexpr std::size_t kSlaves = 8;
inline constexpr std::size_t kChannels = 2;

// CFGCHx, table 8, page 23.
using Protocol = regs::Protocol;
// CLKENI, table 7, page 23.
using ClockSource = regs::ClockSource;
// CFGIF, table 9, page 23.
using LineInterface = regs::LineInterface;

// How frames start: FREQAGS (table 37, pages 30 to 32). This register controls single and automatic
// frames.
//
//                      single frames (read_frame, read_all)   automatic frames (Automatic)
//   kWaitForLine       wait for SL = 1, back to back          back to back (AGSMIN)
//   kRequireIdleLine   refused while SL is low                one per pulse at pin GETSENS
//   kPeriodic          refused while SL is low                every Config::frame_period_clk
//
// SL is low until the slaves' timeout after the previous frame is over (page 32). When the chip
// refuses a frame it sets nAGSERR = 0, and the call returns kLineError at once.
enum class FrameStart : std::uint8_t {
  kWaitForLine = 0,
  kRequireIdleLine = 1,
  kPeriodic = 2,
  // Other names for the same values, for automatic frames.
  kBackToBack = kWaitForLine,
  kOnPin = kRequireIdleLine,
};

// The data bits that are not part of the position.
enum class Flags : std::uint8_t {
  kNone = 0,
  // The last two data bits are nE and nW: error and warning, both active low.
  kErrorWarning = 1,
};

// How the driver checks data on SPI, which has no check of its own.
enum class SpiCheck : std::uint8_t {
  // The driver reads only the bytes that hold data, once. It detects impossible values only.
  kOff = 0,
  // The chip also stores the received CRC (NOCRC = 0). The driver reads it with the data, checks it
  // again and returns it.
  kCrc = 1,
  // As kCrc, with more checks. One disturbed transfer, in either direction, or a line that becomes
  // stuck, can then make neither a wrong nor an old position:
  //  * data without a stored CRC, and data of all zeros or all ones, is read twice;
  //  * the status is read again after the data, and once more after SVALID is cleared;
  //  * 0xF4 is read back after the write, and so is what ends a register access; what starts one is
  //    read back at each level;
  //  * registers of slaves are read twice from the chip.
  // What is left: disturbed bytes of 0xF4 that release the bank or start frames (docs/driver.md).
  kFull = 2,
  // As kFull, and the status is read after each byte of 0xF4 that releases the bank, starts
  // automatic frames, or is BREAK before such a start: 6 bytes more a read, 14 more a start, 6 more
  // its BREAK. If 0xF4 is wrong there, the call has failed, the next read begins with the release
  // and drops the words that have waited, and the next register access begins with BREAK.
  kFullAndRelease = 3,
};

// One single-cycle data channel of the chip.
struct SlaveConfig {
  bool enabled = false;
  // Data length on the line without CRC: position and flags. 1..64; with flags 3..64.
  std::uint8_t data_bits = 0;
  Flags flags = Flags::kErrorWarning;
  // Full polynomial, 0x43 = x^6 + x + 1; 0 = no CRC. See encode_crc() for what the chip can do.
  std::uint32_t crc_polynomial = 0x43;
  // Start value of the CRC; only the low bits count, as many as the CRC has. 0 without CRC.
  std::uint16_t crc_start = 0;
  // GRAYSx (table 19), SSI only: the encoder sends Gray code, the chip converts it.
  bool gray = false;
  // ACTnSENSx (table 17): the slave takes a word from the host (Device::write_actuator()) and
  // delivers none. BiSS only; it needs Config::mo. The driver ignores `flags` of an actuator.
  bool actuator = false;
  // LSTOPx (table 18): a stop bit before the actuator's word. Ignored for sensors.
  bool stop_bit = true;
};

struct ChannelConfig {
  // CFGCHx: kBissC, kBissB, kSsi; two channels may differ. A channel that is kUnused takes no part
  // in frames.
  Protocol protocol = Protocol::kUnused;
};

// Complete configuration of one chip: up to eight slaves, all on channel 1, or, if channel 2 is in
// use, slaves 1 to 4 on channel 1 and 5 to 8 on channel 2 (SLAVELOC5). A slave that is not enabled
// has no data in the frame; slaves may be left out.
struct Config {
  // System clock. Pin CLK: at most 25 MHz (D01, page 9). D01 states no minimum; validate() asks
  // for 1 MHz, which is this driver's own choice. Internal: 10..25 MHz (D05), 20 MHz typical with a
  // wide spread, so ma_hz and the timeout are then only as good as this figure. A slow system clock
  // limits SCLK: <= 2 * f_clk_hz is always safe, see bus.hpp; the driver cannot check it.
  std::uint32_t f_clk_hz = 20'000'000;
  ClockSource clock_source = ClockSource::kExternal;

  // Clock at pin MA. Must be one of the 31 frequencies of table 35 (page 30), in whole hertz,
  // rounded down: use ma_hz_at_most() to choose. Each MA half period must be shorter than the
  // shortest timeout of the slaves.
  std::uint32_t ma_hz = 0;

  LineInterface line_interface = LineInterface::kTtl;
  FrameStart frame_start = FrameStart::kWaitForLine;
  // System clocks from frame to frame, for FrameStart::kPeriodic only, else 0: use
  // frame_period_clk_at_least(). Must hold a frame: N + 5 periods of MA and the shortest timeout,
  // 0.55 of a period (I306); whether line delay, processing time and the real timeout fit as well,
  // validate() cannot know (page 30).
  std::uint32_t frame_period_clk = 0;

  // SINGLEBANK (table 38). True: no second bank; automatic frames are then kUnsupported, because
  // nothing keeps a new frame from overwriting what is being read.
  bool single_bank = false;

  // HOLDCDM (table 25). True: MA keeps its level from the end of a frame to the next one, so that
  // slaves see CDM although their data is not clocked out completely. Then, unless frame_start is
  // kWaitForLine, a used channel may have no enabled slave, as for control communication with
  // slaves that are not known yet.
  bool hold_cdm = false;

  // EN_MO (table 39): pin MO is wired to SLI of the last slave, for actuators, for MO_BUSY, or to
  // select the register mode of BiSS B; slave ID 0 of BiSS B is then unused (page 16).
  bool mo = false;
  // MO_BUSY (table 40): periods of MA by which MO delays the start bit, for the slowest slave's
  // processing time. 0 without `mo`.
  std::uint8_t mo_busy = 0;

  // f_MA / register clock of BiSS B: 2, 4, 8, ... 256 (FREQR, table 36). 64 (FREQR = 5) is what the
  // datasheet asks for where a channel is BiSS C, which also counts its time limit with it.
  std::uint16_t register_divider = 64;
  // Longest timeout after which slaves of BiSS B leave register mode, up to 1'000'000 us; 1.5
  // register clocks to 1 ms are common. The line does not show its end, so every access ends with a
  // pause of this length.
  std::uint32_t register_timeout_us = 2000;

  // Checks against faults of the SPI bus. kOff is fastest; kFull adds two short transfers or more
  // to each read.
  SpiCheck spi_check = SpiCheck::kFull;

  // Longest time from the request of a frame to its end, 1..1'000'000 us. 0 = calculated, see
  // frame_timeout_us().
  std::uint32_t frame_timeout_us = 0;

  // Longest time that a slave may take for one register access beyond the frames it needs, up to
  // 10'000'000 us. 0 = the chip's own limit of 4096 register clocks (page 34); the chip then
  // reports kRegisterDelay. If a shorter time ends, the driver sends BREAK and reports kTimeout.
  std::uint32_t register_busy_us = 0;

  // How positions are read while a BiSS C register access or a command runs beside automatic
  // frames. True: with HOLDBANK as otherwise; the byte of 0xF4 then has INSTR = 000. The RTL goes
  // on with the access whatever INSTR is, once the instruction is in the chip; the datasheet does
  // not say. False, for a chip that does not: without HOLDBANK, and once more at once if the banks
  // have switched meanwhile. A loop whose period is less than twice the time of the transfers then
  // loses positions.
  bool hold_beside_access = true;

  // Device::initialize() also switches on what broadcast commands can have switched off in the
  // slaves of BiSS C: Control::activate() with the IDs of the enabled slaves. About 70 frames. In a
  // chain on which somebody has switched a slave off on purpose it shifts the words of the others.
  // Not with an actuator: the frames would send words that nobody has written.
  bool activate_at_initialize = false;

  // FrameStart::kOnPin: the time from one pulse at pin GETSENS to the next, 1..1'000'000 us. The
  // reads then tell when frames stay away, as with kPeriodic, and mb4_counts can count what is
  // lost. Not shorter than a frame without processing time. 0: the driver does not know it, and
  // there is no alarm. 0 with any other start.
  std::uint32_t pin_period_us = 0;

  std::array<ChannelConfig, kChannels> channels{};  // [0] is channel 1
  std::array<SlaveConfig, kSlaves> slaves{};        // [0] is slave 1, next to SL, SCDATA1
};

inline constexpr std::uint32_t kMaxFrameTimeoutUs = 1'000'000;
inline constexpr std::uint32_t kMaxPinPeriodUs = 1'000'000;
inline constexpr std::uint32_t kMaxRegisterBusyUs = 10'000'000;

}  // namespace mb4

#endif  // MB4_CONFIG_MEMBERS_HPP_
