// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/biss_c_slave.hpp"

namespace mb4::sim {

BissCSlave::BissCSlave(const BissCSlaveConfig& config, std::uint64_t seed)
    : config_(config),
      random_(seed),
      control_(config_.control, registers()),
      timeout_(config.timeout.adaptive() ? config.timeout.initial : config.timeout.fixed),
      shift_(config.data_bits + config.crc.width(), 0) {
  registers().set_banks(config.control.banks);
  registers().set_missing(config.control.missing);
  registers().set_write_protected(config.control.write_protected);
}

bool BissCSlave::set_data(std::uint64_t raw) {
  if (config_.data_bits < 64 && (raw >> config_.data_bits) != 0) return false;
  config_.source.kind = DataSource::Kind::kConstant;
  config_.source.constant = raw;
  return true;
}

Time BissCSlave::deadline() const {
  return state_ == State::kIdle ? kNever : last_edge_ + timeout_;
}

void BissCSlave::ma_edge(Time now, bool ma, bool sli) {
  ma_ = ma;
  last_edge_ = now;
  if (ma) {
    rising(now, sli);
  } else if (state_ == State::kIdle) {
    // Rising edges in idle are no part of a frame: MA may have rested low (HOLDCDM).
    is_last_ = !sli;
    first_falling_ = now;
    if (config_.timeout.adaptive()) timeout_ = config_.timeout.initial;
    state_ = State::kArmed;
    follow(sli);
  } else if (state_ != State::kData) {
    follow(sli);
  }
}

void BissCSlave::rising(Time now, bool sli) {
  switch (state_) {
    case State::kIdle:
      follow(sli);
      break;
    case State::kArmed:
      word_ =
          config_.source.word(now, frames(), config_.data_bits, config_.flag_bits, config_.flags);
      state_ = State::kAckWait;
      follow(sli);
      break;
    case State::kAckWait:
      if (config_.timeout.adaptive()) {
        timeout_ = now - first_falling_;
        if (config_.timeout.sample_period != 0) {
          timeout_ += random_.up_to(3 * config_.timeout.sample_period);
        }
      }
      slo_ = false;
      busy_left_ = config_.busy_periods;
      shift_loaded_ = false;
      state_ = State::kBusy;
      break;
    case State::kBusy:
      if (is_last_ && busy_left_ > 0) {
        --busy_left_;
      } else if (is_last_ || sli) {
        slo_ = true;
        state_ = State::kCds;
        count_frame();
      } else {
        slo_ = false;
      }
      break;
    case State::kCds:
      slo_ = control_bit(!is_last_ && sli);
      state_ = control_.data_active() ? State::kData : State::kPass;
      break;
    case State::kData:
      if (shift_loaded_) {
        shift();
      } else {
        load_shift_register();
      }
      break;
    case State::kPass:
      follow(sli);
      break;
  }
}

// The CDS bit to send: that of the slaves behind, and the own one.
bool BissCSlave::control_bit(bool sli) {
  if (!config_.control.present) return sli;
  return (control_.cds(sli) || sli) != control_.faults().flip_cds();
}

void BissCSlave::sli_changed(Time /*now*/, bool sli) {
  if (state_ != State::kData) follow(sli);
}

// Outside the data phase a slave passes SLI on; the last one has nothing to pass on. The start bit
// is only taken with an edge of MA, so a busy slave does not let SLI through between the edges.
void BissCSlave::follow(bool sli) {
  switch (state_) {
    case State::kIdle:
    case State::kArmed:
    case State::kAckWait:
      slo_ = is_last_ || sli;
      break;
    case State::kPass:
      slo_ = !is_last_ && sli;
      break;
    case State::kBusy:
    case State::kCds:
    case State::kData:
      break;
  }
}

void BissCSlave::load_shift_register() {
  std::size_t i = 0;
  for (unsigned bit = config_.data_bits; bit-- > 0;) {
    shift_[i++] = static_cast<std::uint8_t>((word_ >> bit) & 1U);
  }
  const std::uint32_t crc = config_.crc.line_bits(word_, config_.data_bits);
  for (unsigned bit = config_.crc.width(); bit-- > 0;) {
    shift_[i++] = static_cast<std::uint8_t>((crc >> bit) & 1U);
  }
  shift_head_ = 0;
  shift_loaded_ = true;
  slo_ = shift_[0] != 0;
}

void BissCSlave::shift() {
  shift_[shift_head_] = sli_before_ && !is_last_ ? 1 : 0;
  if (++shift_head_ == shift_.size()) shift_head_ = 0;
  slo_ = shift_[shift_head_] != 0;
}

void BissCSlave::timer(Time now, bool sli) {
  if (now < deadline()) return;
  // Two pulses and a rest are no frame (INIT): a CDM belongs to a frame that got its start bit.
  if (state_ == State::kCds || state_ == State::kData || state_ == State::kPass) {
    take_cdm(!ma_);
    if (config_.control.present) control_.step(now, !ma_);
  }
  state_ = State::kIdle;
  follow(sli);
}

}  // namespace mb4::sim
