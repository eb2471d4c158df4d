// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/ssi/ssi_slave.hpp"

#include <algorithm>

namespace mb4::sim {

std::unique_ptr<Slave> SsiSlaveConfig::make_slave(std::uint64_t /*seed*/) const {
  return std::make_unique<SsiSlave>(*this);
}

DeviceTraits SsiSlaveConfig::traits() const {
  return {.protocol = {.key = "ssi", .title = "SSI", .start_bit = false},
          .timeout = monoflop,
          .response = response,
          .repeats = ring,
          .gray = gray,
          .registers = control.present,
          .alone = "an SSI encoder"};
}

SsiSlave::SsiSlave(const SsiSlaveConfig& config)
    : config_(config), control_(config_.control, registers()) {
  registers().set_layout(config.control);
}

std::uint64_t SsiSlave::line_word(std::uint64_t raw) const {
  if (!config_.gray) return raw;
  const unsigned flag_bits = config_.flag_bits;
  if (flag_bits >= 64) return raw;
  const std::uint64_t position = raw >> flag_bits;
  const std::uint64_t flags = raw & ((std::uint64_t{1} << flag_bits) - 1U);
  return (position ^ (position >> 1U)) << flag_bits | flags;
}

void SsiSlave::wait() {
  const Time end = active_ ? last_falling_ + config_.monoflop : kNever;
  set_deadline(next_change_ < changes_.size() ? std::min(end, changes_[next_change_].time) : end);
  set_idle(!active_);
}

void SsiSlave::ma_edge(Time now, bool ma, bool /*sli_before*/, bool /*sli*/) {
  ma_ = ma;
  if (!ma) {
    last_falling_ = now;
    if (!active_) begin(now);
  } else if (active_) {
    // A rising edge in idle is not part of a frame: MA may have rested low (CDM).
    if (rising_ == 0) count_frame();
    show(now, bit(rising_++));
  }
  wait();
}

void SsiSlave::begin(Time now) {
  active_ = true;
  rising_ = 0;
  raw_ = config_.word(now, frames());
  data_ = line_word(raw_);
  crc_ = config_.crc.line_bits(data_, config_.data_bits) ^ (wrong_crc() ? 1U : 0U);
}

bool SsiSlave::bit(std::uint64_t index) const {
  const unsigned length = config_.word_bits();
  if (config_.ring) index %= length + 1;
  if (index < config_.data_bits) return ((data_ >> (config_.data_bits - 1 - index)) & 1U) != 0;
  if (index < length) return ((crc_ >> (length - 1 - index)) & 1U) != 0;
  return false;
}

void SsiSlave::show(Time now, bool level) {
  if (config_.response == 0) {
    set_slo(level);
  } else {
    changes_.push_back({now + config_.response, level});
  }
}

void SsiSlave::timer(Time now, bool /*sli*/) {
  while (next_change_ < changes_.size() && changes_[next_change_].time <= now) {
    set_slo(changes_[next_change_++].level);
  }
  if (next_change_ == changes_.size()) {
    changes_.clear();
    next_change_ = 0;
  }
  if (active_ && now >= last_falling_ + config_.monoflop) end(now);
  wait();
}

void SsiSlave::end(Time now) {
  active_ = false;
  set_slo(true);
  changes_.clear();
  next_change_ = 0;
  if (rising_ == 0) return;
  take_cdm(!ma_);
  if (!config_.control.present) return;
  control_.end_cds(false);  // no slave is behind it, and its CDS goes nowhere
  control_.step(now, !ma_);
}

}  // namespace mb4::sim
