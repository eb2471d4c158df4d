// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "bridge/spi_port.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "sim/core/time.hpp"

namespace mb4::tool {
namespace {

// The pause that Linux makes between two frames of a message when cs_change separates them.
constexpr sim::Time kFrameGap = 10 * sim::kPsPerUs;

unsigned bytes_of(unsigned bits) { return bits <= 8 ? 1 : bits <= 16 ? 2 : 4; }

std::uint32_t reversed(std::uint32_t word, unsigned bits) {
  std::uint32_t result = 0;
  for (unsigned bit = 0; bit < bits; ++bit) result = (result << 1U) | ((word >> bit) & 1U);
  return result;
}

// No controller stretches SCLK for a single byte: whether item I204 is kept is up to the program.
sim::SpiTiming timing_of(std::uint32_t hz) {
  sim::SpiTiming timing = sim::SpiTiming::for_frequency(std::min(hz, SpiSettings::kMaxSpeedHz));
  timing.sclk_high_address = timing.sclk_high;
  return timing;
}

}  // namespace

SpiPort::SpiPort(sim::Simulator& simulator) : simulator_(simulator) {
  settings_.speed_hz = static_cast<std::uint32_t>(simulator.scenario().host.sclk_hz);
}

void SpiPort::set_mode(std::uint32_t mode) {
  if ((mode & ~SpiSettings::kModes) != 0) {
    throw RefusedValue(fmt::format("mode bits 0x{:X} are not supported, only 0x{:X} are",
                                   mode & ~SpiSettings::kModes, SpiSettings::kModes));
  }
  release();
  simulator_.spi().set_mode({(mode & SpiSettings::kCpol) != 0, (mode & SpiSettings::kCpha) != 0});
  settings_.mode = mode;
}

void SpiPort::set_bits_per_word(std::uint32_t bits) {
  if (bits > SpiSettings::kMaxBits) {
    throw RefusedValue(fmt::format("{} bits per word, only 1 to 32 are supported", bits));
  }
  settings_.bits_per_word = bits == 0 ? 8 : static_cast<std::uint8_t>(bits);
}

void SpiPort::set_speed(std::uint32_t hz) {
  if (hz == 0) throw RefusedValue("a speed of 0 Hz");
  settings_.speed_hz = hz;
}

void SpiPort::release() { simulator_.spi().select(false); }

void SpiPort::select(bool active) {
  if ((settings_.mode & SpiSettings::kNoCs) == 0) simulator_.spi().select(active);
}

unsigned SpiPort::bits_of(const SpiTransfer& transfer) const {
  return transfer.bits_per_word != 0 ? transfer.bits_per_word : settings_.bits_per_word;
}

void SpiPort::check(const SpiTransfer& transfer) const {
  const unsigned bits = bits_of(transfer);
  if (bits > SpiSettings::kMaxBits) {
    throw RefusedValue(fmt::format("{} bits per word, only 1 to 32 are supported", bits));
  }
  if (transfer.length % bytes_of(bits) != 0) {
    throw RefusedValue(
        fmt::format("{} bytes are no whole number of words of {} bits", transfer.length, bits));
  }
  if (!transfer.tx.empty() && transfer.tx.size() != transfer.length) {
    throw RefusedValue("the data are not as long as the transfer");
  }
}

void SpiPort::run(const SpiTransfer& transfer, std::vector<std::uint8_t>& rx) {
  sim::SpiHost& host = simulator_.spi();
  const unsigned bits = bits_of(transfer);
  const unsigned bytes = bytes_of(bits);
  const bool lsb_first = (settings_.mode & SpiSettings::kLsbFirst) != 0;
  for (std::size_t at = 0; at < transfer.length; at += bytes) {
    std::uint32_t word = 0;
    for (unsigned i = 0; i < bytes && !transfer.tx.empty(); ++i) {
      word |= static_cast<std::uint32_t>(transfer.tx[at + i]) << (8 * i);
    }
    word = host.word(lsb_first ? reversed(word, bits) : word, bits);
    if (lsb_first) word = reversed(word, bits);
    for (unsigned i = 0; i < bytes; ++i) rx.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
    if (transfer.word_delay_us != 0) simulator_.advance(transfer.word_delay_us * sim::kPsPerUs);
  }
  if (transfer.delay_us != 0) simulator_.advance(transfer.delay_us * sim::kPsPerUs);
}

void SpiPort::message(std::span<const SpiTransfer> transfers, std::vector<std::uint8_t>& rx) {
  for (const SpiTransfer& transfer : transfers) check(transfer);
  bool keep = false;
  for (std::size_t i = 0; i < transfers.size(); ++i) {
    const SpiTransfer& transfer = transfers[i];
    const std::uint32_t hz = transfer.speed_hz != 0 ? transfer.speed_hz : settings_.speed_hz;
    simulator_.spi().set_timing(timing_of(hz));
    select(true);
    run(transfer, rx);
    if (!transfer.cs_change) continue;
    keep = i + 1 == transfers.size();
    if (keep) continue;
    select(false);
    simulator_.advance(kFrameGap);
  }
  if (!keep) select(false);
}

}  // namespace mb4::tool
