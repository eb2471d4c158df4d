// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/biss_c_slave.hpp"

namespace mb4::sim {

std::unique_ptr<Slave> BissCSlaveConfig::make_slave(std::uint64_t seed) const {
  return std::make_unique<BissCSlave>(*this, seed);
}

DeviceTraits BissCSlaveConfig::traits() const {
  return {.protocol = {.key = "biss-c", .title = "BiSS C", .control = true},
          .busy_periods = busy_periods,
          .timeout = timeout.fixed,
          .actuator = actuator,
          .stop_bit = actuator && stop_bit,
          .registers = control.present};
}

std::string_view BissCSlaveConfig::refuses(SlaveFault fault) const {
  if (fault == SlaveFault::kWrongId && control.present) return "";
  return BissSlaveConfig::refuses(fault);
}

BissCSlave::BissCSlave(const BissCSlaveConfig& config, std::uint64_t seed)
    : config_(config),
      control_(config_.control, registers()),
      timeout_(config.timeout, seed),
      shift_(config.channel_bits()) {
  registers().set_layout(config.control);
  actuator_.preset(config_.word(0, 0));
}

bool BissCSlave::set_data(std::uint64_t raw) {
  if (!config_.hold(raw)) return false;
  actuator_.preset(raw);
  return true;
}

void BissCSlave::ma_edge(Time now, bool ma, bool sli_before, bool sli) {
  ma_ = ma;
  if (ma) {
    rising(now, sli_before, sli);
  } else if (state_ == State::kIdle) {
    // A rising edge in idle is not part of a frame: MA may have rested low (HOLDCDM).
    is_last_ = !sli;
    timeout_.begin(now);
    state_ = State::kArmed;
    set_idle(false);
    follow(sli);
  } else {
    follow(sli);
  }
  if (state_ != State::kIdle) set_deadline(now + timeout_.value());
}

// The slave samples SLI with the edge: `sli_before` is SLI in the period of MA that ends here.
void BissCSlave::rising(Time now, bool sli_before, bool sli) {
  switch (state_) {
    case State::kIdle:
      follow(sli);
      break;
    case State::kArmed:
      word_ = config_.actuator ? actuator_.word() : config_.word(now, frames());
      state_ = State::kAckWait;
      follow(sli);
      break;
    case State::kAckWait:
      timeout_.measure(now);
      busy_left_ = config_.busy_periods;
      sli_was_low_ = false;
      state_ = State::kBusy;
      set_slo(false);
      follow(sli);
      break;
    case State::kBusy:
      if (!is_last_) {
        // The start bit has already passed between the edges.
        if (sli_was_low_ && sli_before && !faults().busy) {
          begin_cds(sli);
        } else {
          follow(sli);
        }
      } else if (busy_left_ > 0) {
        --busy_left_;
      } else if (!faults().busy) {
        set_slo(true);
        state_ = State::kStart;
        count_frame();
      }
      break;
    case State::kStart:
      begin_cds(sli);
      break;
    case State::kCds:
      end_cds(sli_before);
      if (control_.data_active()) {
        shift_.load(word_, config_.data_bits, config_.crc, faults().wrong_crc);
        set_slo(shift_.out());
        state_ = State::kData;
        set_shifting(&shift_, !is_last_);
      } else {
        state_ = State::kPass;
        follow(sli);
      }
      break;
    case State::kData:
      shift(sli_before);
      break;
    case State::kPass:
      follow(sli);
      break;
  }
}

void BissCSlave::last_edge(Time edge, bool ma) {
  ma_ = ma;
  set_deadline(edge + timeout_.value());
}

void BissCSlave::begin_cds(bool sli) {
  if (!is_last_) count_frame();
  state_ = State::kCds;
  cds_flip_ = config_.control.present && control_.faults().flip_cds();
  follow(sli);
}

void BissCSlave::end_cds(bool sli) {
  if (config_.control.present) control_.end_cds(!is_last_ && sli);
}

void BissCSlave::sli_changed(Time /*now*/, bool sli) { follow(sli); }

// Outside the data phase a slave passes SLI on, also between the edges of MA. The last slave has
// nothing to pass on.
void BissCSlave::follow(bool sli) {
  switch (state_) {
    case State::kIdle:
    case State::kArmed:
    case State::kAckWait:
      set_slo(is_last_ || sli);
      break;
    case State::kBusy:
      // The acknowledge of MO may come late. So a 1 is the start bit only after a 0.
      if (is_last_) break;
      if (!sli) sli_was_low_ = true;
      set_slo(sli && (sli_was_low_ ? !faults().busy : config_.passes_acknowledge));
      break;
    case State::kCds: {
      const bool own = config_.control.present && control_.cds();
      set_slo((own || (!is_last_ && sli)) != cds_flip_);
      break;
    }
    case State::kPass:
      set_slo(!is_last_ && sli);
      break;
    case State::kStart:
    case State::kData:
      break;
  }
}

void BissCSlave::timer(Time now, bool sli) {
  if (now < deadline()) return;
  // Two pulses and a rest (INIT) are not a frame. A CDM belongs to a frame with a start bit.
  const bool frame = state_ >= State::kStart;
  if (state_ == State::kCds) end_cds(sli);
  if (state_ == State::kData && config_.actuator && shift_.filled()) {
    actuator_.take(shift_, config_.data_bits, config_.crc);
  }
  if (frame) {
    take_cdm(!ma_);
    if (config_.control.present) control_.step(now, !ma_);
  }
  state_ = State::kIdle;
  set_idle(true);
  set_shifting(nullptr, false);
  set_deadline(kNever);
  follow(sli);
}

}  // namespace mb4::sim
