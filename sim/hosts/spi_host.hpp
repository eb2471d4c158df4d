// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// An SPI master with the timing of a real one: MSB first, and every edge has its own time. The chip
// works in mode 0. The other modes show what a wrongly configured host gets.
//
// Source of the limits: iC-MB4 Rev D2, items I201 to I209.
#ifndef MB4SIM_SPI_HOST_HPP_
#define MB4SIM_SPI_HOST_HPP_

#include <cstddef>
#include <cstdint>
#include <span>

#include "sim/core/time.hpp"
#include "sim/hosts/host_pins.hpp"

namespace mb4::sim {

// Times of an SPI frame, ps.
struct SpiTiming {
  Time sclk_low = 50'000;            // I203, at least 10 ns
  Time sclk_high = 50'000;           // I204, at least 10 ns
  Time sclk_high_address = 100'000;  // I204, last high phase of the address byte of 0x03
  Time ncs_setup = 50'000;           // I201, NCS low to first rising SCLK, at least 10 ns
  Time ncs_hold = 50'000;            // I202, last falling SCLK to NCS high, at least 10 ns
  Time ncs_high = 50'000;            // I209, at least 10 ns

  // Returns the timing of a host whose SCLK runs at `sclk_hz` (1 Hz to 50 MHz) or slower.
  static SpiTiming for_frequency(std::uint64_t sclk_hz);
};

// CPOL is the level of SCLK at rest. With CPHA = 1 data are taken at the second edge of a clock,
// with CPHA = 0 at the first.
struct SpiMode {
  bool cpol = false;
  bool cpha = false;
};

// The pins of the master to which a host is connected.
struct SpiPins {
  Pin ncs, sclk, mosi, miso;
};

class SpiHost final : public HostModel {
 public:
  SpiHost(HostPins& pins, const SpiTiming& timing, const SpiPins& wires)
      : pins_(pins), wires_(wires), timing_(timing) {}

  // Sends one frame: NCS low, all bytes, NCS high. `rx` receives as many bytes as it has room for,
  // at most tx.size(). Returns at the rising edge of NCS.
  void transfer(std::span<const std::uint8_t> tx, std::span<std::uint8_t> rx);

  // The same step by step. select() returns when NCS has its new level. byte() returns after the
  // falling edge of its last clock. A second select(true) does nothing. byte() without NCS low
  // makes clocks, but the chip ignores them.
  void select(bool active);
  std::uint8_t byte(std::uint8_t mosi);
  // Sends the low `bits` (1 to 32) of `mosi`, MSB first. Returns the bits of MISO.
  std::uint32_t word(std::uint32_t mosi, unsigned bits);

  // Changes the mode. SCLK takes its new rest level at once. Must not be called inside a frame.
  void set_mode(const SpiMode& mode);
  // A fault of the host: the next transfer() ends after `bits` (1 or more) clocks, at the latest
  // one clock before its end. The rest of `rx` becomes 0. The caller of transfer() is not told.
  void abort_next(std::uint64_t bits) { abort_bits_ = bits; }
  std::uint64_t aborted() const { return aborted_; }  // transfers aborted so far

  void set_timing(const SpiTiming& timing) { timing_ = timing; }
  const SpiTiming& timing() const { return timing_; }

 private:
  void abort(std::span<const std::uint8_t> tx, std::span<std::uint8_t> rx);
  void wait(Time duration) { pins_.run_until(pins_.now() + duration); }
  void drive_mosi(bool level);
  bool clock_bit(bool mosi);

  HostPins& pins_;
  SpiPins wires_;
  SpiTiming timing_;
  SpiMode mode_;
  bool selected_ = false;
  bool mosi_ = false;  // as driven in this word
  bool first_of_word_ = true;
  bool deselected_once_ = false;
  Time deselected_at_ = 0;
  Time last_edge_ = 0;
  std::size_t bits_in_frame_ = 0;
  std::uint8_t opcode_ = 0;       // the first eight bits
  std::uint64_t abort_bits_ = 0;  // 0: the next transfer is not aborted
  std::uint64_t aborted_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SPI_HOST_HPP_
