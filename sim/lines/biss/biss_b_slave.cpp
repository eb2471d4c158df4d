// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/biss/biss_b_slave.hpp"

namespace mb4::sim {

std::unique_ptr<Slave> BissBSlaveConfig::make_slave(std::uint64_t seed) const {
  return std::make_unique<BissBSlave>(*this, seed);
}

DeviceTraits BissBSlaveConfig::traits() const {
  return {.protocol = {.key = "biss-b", .title = "BiSS B"},
          .busy_periods = busy_periods,
          .timeout = timeout.fixed,
          .registers = access.present};
}

// IDs of BiSS B slaves count from the last slave.
unsigned BissBSlaveConfig::set_ids_behind(unsigned ids) {
  access.first_id = ids;
  return access.ids;
}

BissBSlave::BissBSlave(const BissBSlaveConfig& config, std::uint64_t seed)
    : BissSlave(config, config.word_bits(), seed), access_(config_.access, registers()) {
  registers().set_layout(config.access);
}

Time BissBSlave::register_timeout() const {
  if (config_.register_timeout != 0) return config_.register_timeout;
  return register_period_ != 0 ? 3 * register_period_ / 2 : config_.register_initial;
}

void BissBSlave::wait() {
  set_idle(state_ == State::kIdle);
  if (state_ == State::kIdle) {
    set_deadline(kNever);
  } else if (state_ != State::kRegister) {
    set_deadline(last_edge_ + timeout_.value());
  } else {
    // The master may wait any time between the change to register mode and its start bit.
    set_deadline(access_.cells() == 0 ? kNever : last_edge_ + register_timeout());
  }
}

void BissBSlave::ma_edge(Time now, bool ma, bool sli_before, bool sli) {
  ma_ = ma;
  if (state_ == State::kRegister) {
    if (ma && access_.cells() == 0) first_cell_ = now;
    if (ma && access_.cells() == 1) register_period_ = now - first_cell_;
    access_.ma_edge(now, ma);
  } else if (ma) {
    rising(now, sli_before, sli);
  } else if (state_ == State::kIdle) {
    first_falling(now, sli);
  }
  last_edge_ = now;
  follow(now, sli);
  wait();
}

void BissBSlave::first_falling(Time now, bool sli) {
  timeout_.begin(now);
  // SLI = 0 that was 1 shortly before comes from MO. SLI of the last slave has always been 0.
  const bool fell = !sli && (sli_ || (sli_fell_ != kNever && now - sli_fell_ <= timeout_.value()));
  is_last_ = !sli && !fell;
  state_ = State::kArmed;
  if (!fell) return;
  ++mo_selections_;
  register_period_ = 0;
  access_.begin(true);
  state_ = State::kRegister;
}

void BissBSlave::rising(Time now, bool sli_before, bool sli) {
  switch (state_) {
    case State::kArmed:
      latch(config_.word(now, frames()));
      break;
    case State::kAckWait:
    case State::kBusy:
    case State::kStart:
      if (rising_before_data(now, sli_before, sli)) load_data();
      break;
    case State::kData:
      shift_.shift(sli_before && !is_last_);
      set_slo(shift_.out());
      break;
    case State::kIdle:
    case State::kRegister:
    case State::kCds:
    case State::kPass:
      break;
  }
}

void BissBSlave::sli_changed(Time now, bool sli) { follow(now, sli); }

void BissBSlave::follow(Time now, bool sli) {
  if (sli_ && !sli) sli_fell_ = now;
  sli_ = sli;
  switch (state_) {
    case State::kArmed:
      // The master sees register mode only after all slaves of the chain have confirmed it.
      set_slo(true);
      break;
    case State::kIdle:
    case State::kAckWait:
      set_slo(is_last_ || sli);
      break;
    case State::kBusy:
      follow_busy(sli);
      break;
    case State::kRegister:
      // The master sees SL = 0 when all slaves have confirmed. Later one of them sends.
      set_slo(access_.out() || (!is_last_ && sli));
      break;
    case State::kStart:
    case State::kData:
    case State::kCds:
    case State::kPass:
      break;
  }
}

void BissBSlave::timer(Time now, bool sli) {
  if (now < deadline()) return;
  if (state_ == State::kRegister) {
    access_.end();
    state_ = State::kIdle;
  } else if (state_ == State::kArmed) {
    ++handshakes_;
    register_period_ = 0;
    access_.begin(false);
    state_ = State::kRegister;
  } else {
    state_ = State::kIdle;
  }
  follow(now, sli);
  wait();
}

}  // namespace mb4::sim
