// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/hosts/spi_host.hpp"

#include <algorithm>

namespace mb4::sim {
namespace {

constexpr std::uint8_t kOpcodeRead = 0x03;
constexpr Time kMinimumPhase = 10 * kPsPerNs;         // I201, I202, I209
constexpr Time kMinimumAddressHigh = 100 * kPsPerNs;  // I204

}  // namespace

SpiTiming SpiTiming::for_frequency(std::uint64_t sclk_hz) {
  const Time period = (kPsPerSecond + sclk_hz - 1) / sclk_hz;
  SpiTiming timing;
  timing.sclk_low = period / 2;
  timing.sclk_high = period - period / 2;
  timing.sclk_high_address = std::max(timing.sclk_high, kMinimumAddressHigh);
  timing.ncs_setup = std::max(timing.sclk_low, kMinimumPhase);
  timing.ncs_hold = timing.ncs_setup;
  timing.ncs_high = timing.ncs_setup;
  return timing;
}

void SpiHost::select(bool active) {
  if (active == selected_) return;
  if (active) {
    if (deselected_once_) {
      pins_.run_until(std::max(pins_.now(), deselected_at_ + timing_.ncs_high));
    }
    bits_in_frame_ = 0;
    opcode_ = 0;
    last_edge_ = pins_.now();
    pins_.set_pin(wires_.ncs, false);
  } else {
    pins_.run_until(std::max(pins_.now(), last_edge_ + timing_.ncs_hold));
    pins_.set_pin(wires_.ncs, true);
    pins_.set_pin(wires_.mosi, false);
    deselected_at_ = pins_.now();
    deselected_once_ = true;
  }
  selected_ = active;
}

void SpiHost::set_mode(const SpiMode& mode) {
  mode_ = mode;
  pins_.set_pin(wires_.sclk, mode_.cpol);
}

// Other code may have driven the pin since the last word.
inline void SpiHost::drive_mosi(bool level) {
  if (!first_of_word_ && level == mosi_) return;
  first_of_word_ = false;
  mosi_ = level;
  pins_.set_pin(wires_.mosi, level);
}

// Makes one clock. With CPHA = 0 MOSI changes at the end of the clock before, and chip and host
// take data at the first edge. With CPHA = 1 MOSI changes at the first edge, and both take data at
// the second one.
bool SpiHost::clock_bit(bool mosi) {
  constexpr std::size_t kOpcodeBits = 8;
  constexpr std::size_t kLastAddressBit = 15;
  const bool stretch = bits_in_frame_ == kLastAddressBit && opcode_ == kOpcodeRead;
  const Time high = stretch ? timing_.sclk_high_address : timing_.sclk_high;
  const Time rest = mode_.cpol ? high : timing_.sclk_low;
  const Time pulse = mode_.cpol ? timing_.sclk_low : high;
  const bool first = bits_in_frame_ == 0;
  bool miso = false;
  if (mode_.cpha) {
    if (first) wait(timing_.ncs_setup);
    // MOSI changes after the edge: a chip that takes data at this edge gets the bit before.
    pins_.set_pin(wires_.sclk, !mode_.cpol);
    drive_mosi(mosi);
    wait(pulse);
    miso = pins_.pin(wires_.miso);
    pins_.set_pin(wires_.sclk, mode_.cpol);
    wait(rest);
  } else {
    drive_mosi(mosi);
    wait(first ? std::max(rest, timing_.ncs_setup) : rest);
    miso = pins_.pin(wires_.miso);
    pins_.set_pin(wires_.sclk, !mode_.cpol);
    wait(pulse);
    pins_.set_pin(wires_.sclk, mode_.cpol);
  }
  if (bits_in_frame_ < kOpcodeBits) {
    opcode_ = static_cast<std::uint8_t>((opcode_ << 1U) | (mosi ? 1U : 0U));
  }
  ++bits_in_frame_;
  return miso;
}

std::uint32_t SpiHost::word(std::uint32_t mosi, unsigned bits) {
  std::uint32_t miso = 0;
  first_of_word_ = true;
  for (unsigned bit = bits; bit-- > 0;) {
    miso = (miso << 1U) | (clock_bit(((mosi >> bit) & 1U) != 0) ? 1U : 0U);
  }
  last_edge_ = pins_.now();
  return miso;
}

std::uint8_t SpiHost::byte(std::uint8_t mosi) { return static_cast<std::uint8_t>(word(mosi, 8)); }

void SpiHost::transfer(std::span<const std::uint8_t> tx, std::span<std::uint8_t> rx) {
  if (abort_bits_ != 0 && !tx.empty()) {
    abort(tx, rx);
    return;
  }
  select(true);
  for (std::size_t i = 0; i < tx.size(); ++i) {
    const std::uint8_t value = byte(tx[i]);
    if (i < rx.size()) rx[i] = value;
  }
  select(false);
}

void SpiHost::abort(std::span<const std::uint8_t> tx, std::span<std::uint8_t> rx) {
  const std::uint64_t bits = std::min<std::uint64_t>(abort_bits_, 8 * tx.size() - 1);
  abort_bits_ = 0;
  ++aborted_;
  std::fill(rx.begin(), rx.end(), std::uint8_t{0});
  select(true);
  for (std::size_t i = 0; 8 * i < bits; ++i) {
    const auto count = static_cast<unsigned>(std::min<std::uint64_t>(bits - 8 * i, 8));
    const std::uint32_t value = word(std::uint32_t{tx[i]} >> (8 - count), count);
    if (i < rx.size()) rx[i] = static_cast<std::uint8_t>(value << (8 - count));
  }
  select(false);
}

}  // namespace mb4::sim
