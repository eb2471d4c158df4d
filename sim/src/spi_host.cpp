// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/spi_host.hpp"

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
    bytes_in_frame_ = 0;
    last_falling_ = pins_.now();
    pins_.set_pin(wires_.ncs, false);
  } else {
    pins_.run_until(std::max(pins_.now(), last_falling_ + timing_.ncs_hold));
    pins_.set_pin(wires_.ncs, true);
    pins_.set_pin(wires_.mosi, false);
    deselected_at_ = pins_.now();
    deselected_once_ = true;
  }
  selected_ = active;
}

std::uint8_t SpiHost::byte(std::uint8_t mosi) {
  if (bytes_in_frame_ == 0) opcode_ = mosi;
  const bool stretch = bytes_in_frame_ == 1 && opcode_ == kOpcodeRead;
  unsigned miso = 0;
  for (unsigned bit = 8; bit-- > 0;) {
    // MOSI changes after the falling edge of SCLK; the chip takes it, and the host takes MISO, at
    // the rising edge.
    pins_.set_pin(wires_.mosi, ((mosi >> bit) & 1U) != 0);
    const bool first = bytes_in_frame_ == 0 && bit == 7;
    wait(first ? std::max(timing_.sclk_low, timing_.ncs_setup) : timing_.sclk_low);
    miso = (miso << 1U) | (pins_.pin(wires_.miso) ? 1U : 0U);
    pins_.set_pin(wires_.sclk, true);
    wait(stretch && bit == 0 ? timing_.sclk_high_address : timing_.sclk_high);
    pins_.set_pin(wires_.sclk, false);
  }
  last_falling_ = pins_.now();
  ++bytes_in_frame_;
  return static_cast<std::uint8_t>(miso);
}

void SpiHost::transfer(std::span<const std::uint8_t> tx, std::span<std::uint8_t> rx) {
  select(true);
  for (std::size_t i = 0; i < tx.size(); ++i) {
    const std::uint8_t value = byte(tx[i]);
    if (i < rx.size()) rx[i] = value;
  }
  select(false);
}

}  // namespace mb4::sim
