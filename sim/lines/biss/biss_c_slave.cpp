// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/biss/biss_c_slave.hpp"

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

std::string_view BissCSlaveConfig::refuses(const SlaveFault& fault) const {
  using namespace slave_fault;
  const bool counts = fault == kStuckCounter || fault == kSkippedWord;
  const bool of_sensor = fault == kStuckWord || fault == kSwappedWords;
  if ((fault == kWrongId && control.present) || (of_sensor && !actuator) ||
      (counts && life_counter.bits != 0)) {
    return "";
  }
  return BissSlaveConfig::refuses(fault);
}

BissCSlave::BissCSlave(const BissCSlaveConfig& config, std::uint64_t seed)
    : BissSlave(config, config.channel_bits(), seed), control_(config_.control, registers()) {
  registers().set_layout(config.control);
  actuator_.preset(config_.word(0, 0));
}

void BissCSlave::set_fault(const SlaveFault& fault, bool on) {
  if (fault == slave_fault::kWrongId) control_.faults().set_wrong_id(on);
  if (fault == slave_fault::kStuckWord) stuck_word_ = on;
  if (fault == slave_fault::kStuckCounter) stuck_counter_ = on;
  if (fault == slave_fault::kSkippedWord) skipped_word_ = on;
  if (fault == slave_fault::kSwappedWords) set_swapped_words(on);
  BissSlave::set_fault(fault, on);
}

bool BissCSlave::set_data(std::uint64_t raw) {
  if (!config_.hold(raw)) return false;
  actuator_.preset(raw);
  return true;
}

// The word of the frame that begins. The counter goes on with each frame that had a start bit.
std::uint64_t BissCSlave::next_word(Time now) {
  if (config_.actuator) return actuator_.word();
  const std::uint64_t frames = Slave::frames() - counted_frames_;
  counted_frames_ += frames;
  if (!stuck_counter_) life_steps_ += skipped_word_ ? 2 * frames : frames;
  if (stuck_word_ && counted_frames_ != 0) return word_;
  return config_.life_counter.in_word(config_.word(now, counted_frames_), life_steps_);
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
    case State::kArmed:
      latch(next_word(now));
      follow(sli);
      break;
    case State::kAckWait:
    case State::kBusy:
    case State::kStart:
      if (rising_before_data(now, sli_before, sli)) begin_cds();
      follow(sli);
      break;
    case State::kCds:
      end_cds(sli_before);
      if (control_.data_active()) {
        load_data();
        set_shifting(&shift_, !is_last_);
      } else {
        state_ = State::kPass;
        follow(sli);
      }
      break;
    case State::kData:
      shift(sli_before);
      break;
    case State::kIdle:
    case State::kPass:
    case State::kRegister:
      follow(sli);
      break;
  }
}

void BissCSlave::last_edge(Time edge, bool ma) {
  ma_ = ma;
  set_deadline(edge + timeout_.value());
}

void BissCSlave::begin_cds() {
  state_ = State::kCds;
  cds_flip_ = config_.control.present && control_.faults().flip_cds();
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
      follow_busy(sli);
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
    case State::kRegister:
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
