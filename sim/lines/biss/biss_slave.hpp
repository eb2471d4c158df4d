// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What BiSS B and BiSS C slaves share: a frame from the request to the start bit.
//
//   first falling edge of MA   a request
//   first rising edge          the slave latches its word
//   second rising edge         the slave acknowledges
//   after its busy periods     the last slave sends the start bit; the others pass it on
//
// SLI of a slave that is not the last one comes from another slave or from pin MO.
#ifndef MB4SIM_BISS_SLAVE_HPP_
#define MB4SIM_BISS_SLAVE_HPP_

#include <cstdint>
#include <optional>

#include "sim/core/time.hpp"
#include "sim/lines/biss/biss_slave_config.hpp"
#include "sim/lines/clocked/clocked_slave.hpp"
#include "sim/lines/clocked/shift_register.hpp"
#include "sim/lines/clocked/slave_timeout.hpp"

namespace mb4::sim {

// `Config` derives from BissSlaveConfig.
template <typename Config>
class BissSlave : public ClockedSlave {
 public:
  // `channel_bits`: length of the data channel on the line.
  BissSlave(const Config& config, unsigned channel_bits, std::uint64_t seed)
      : config_(config), timeout_(config.timeout, seed), shift_(channel_bits) {}

  unsigned data_bits() const override { return config_.data_bits; }
  std::optional<std::uint64_t> sent_word() const override { return word_; }

  const Config& config() const { return config_; }
  // SLI was 0 at the start of the last frame.
  bool is_last() const { return is_last_; }

 protected:
  // In the order of a sensor frame: from kStart to kPass the start bit has been sent. BiSS C has
  // kCds and kPass. BiSS B has kRegister, its register mode.
  enum class State { kIdle, kArmed, kAckWait, kBusy, kStart, kCds, kData, kPass, kRegister };

  // A rising edge of MA in kAckWait, kBusy or kStart. Returns true if the start bit is over. Else
  // the caller lets SLO follow.
  bool rising_before_data(Time now, bool sli_before, bool sli) {
    switch (state_) {
      case State::kAckWait:
        timeout_.measure(now);
        busy_left_ = config_.busy_periods;
        sli_was_low_ = !sli;
        state_ = State::kBusy;
        set_slo(false);
        return false;
      case State::kBusy:
        if (!is_last_) {
          // The start bit has already passed between the edges.
          if (!sli_was_low_ || !sli_before || busy_for_ever()) return false;
          count_frame();
          return true;
        }
        if (busy_left_ > 0) {
          --busy_left_;
        } else if (!busy_for_ever()) {
          set_slo(true);
          state_ = State::kStart;
          count_frame();
        }
        return false;
      default:
        return state_ == State::kStart;
    }
  }
  // The first rising edge latches the word.
  void latch(std::uint64_t word) {
    word_ = word;
    state_ = State::kAckWait;
  }
  // SLO follows SLI while the slave waits for the start bit. The last slave has nothing to pass on.
  void follow_busy(bool sli) {
    // The acknowledge of MO may come late. So a 1 is the start bit only after a 0.
    if (is_last_) return;
    if (!sli) sli_was_low_ = true;
    set_slo(sli && (sli_was_low_ ? !busy_for_ever() : config_.passes_acknowledge));
  }
  void load_data() {
    shift_.load(word_, config_.data_bits, config_.crc, wrong_crc());
    set_slo(shift_.out());
    state_ = State::kData;
  }

  Config config_;
  State state_ = State::kIdle;
  bool ma_ = true;
  bool is_last_ = true;
  std::uint64_t word_ = 0;
  TimeoutClock timeout_;
  ShiftRegister shift_;

 private:
  bool sli_was_low_ = false;  // since the acknowledge
  unsigned busy_left_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_SLAVE_HPP_
