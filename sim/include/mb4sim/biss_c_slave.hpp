// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS C sensor. It follows the frame of the datasheet's BiSS C chapter (iC-MB4 Rev D2, page 15,
// figures 11 and 12): on the first falling edge of MA it looks at SLI to learn whether it is the
// last slave, latches on the first rising edge, acknowledges on the second, and after its busy
// periods sends start bit, CDS, data and inverted CRC, MSB first. As part of a chain it is a shift
// register of its own length, unless a command has switched its data channel off: then it passes
// SLI on. CDS and CDM go to its ControlSlave.
#ifndef MB4SIM_BISS_C_SLAVE_HPP_
#define MB4SIM_BISS_C_SLAVE_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "mb4sim/control_slave.hpp"
#include "mb4sim/crc.hpp"
#include "mb4sim/data_source.hpp"
#include "mb4sim/random.hpp"
#include "mb4sim/slave.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

// How long MA must be constant until a slave ends the frame.
struct SlaveTimeout {
  // Fixed: `fixed` ps after the last edge of MA. Adaptive (fixed = 0): 1.5 periods of MA, measured
  // in every frame from the first falling to the second rising edge, plus 0 to 3 sampling periods
  // of the slave's own clock, drawn anew in every frame.
  Time fixed = 0;
  Time sample_period = 0;
  // Adaptive only: used as long as nothing has been measured.
  Time initial = 40 * kPsPerUs;

  bool adaptive() const { return fixed == 0; }
};

struct BissCSlaveConfig {
  std::string name = "biss-c";
  unsigned data_bits = 28;     // 1 to 64, position and flags
  unsigned flag_bits = 2;      // the lowest bits of the word that are no position
  std::uint64_t flags = 0b11;  // their level with source ramp or sine; nE = nW = 1: no error
  Crc crc{0x43, 0};
  SlaveTimeout timeout;
  unsigned busy_periods = 0;  // periods of MA between acknowledge and start bit beyond one
  DataSource source;
  ControlConfig control;
};

class BissCSlave final : public Slave {
 public:
  BissCSlave(const BissCSlaveConfig& config, std::uint64_t seed);

  void sample(bool sli) override { sli_before_ = sli; }
  void ma_edge(Time now, bool ma, bool sli) override;
  void sli_changed(Time now, bool sli) override;
  Time deadline() const override;
  void timer(Time now, bool sli) override;
  bool slo() const override { return slo_; }
  bool idle() const override { return state_ == State::kIdle; }

  unsigned data_bits() const override { return config_.data_bits; }
  bool set_data(std::uint64_t raw) override;
  ControlSlave* control() override { return config_.control.present ? &control_ : nullptr; }

  const BissCSlaveConfig& config() const { return config_; }
  // Level found at SLI at the start of the last frame was 0.
  bool is_last() const { return is_last_; }
  // Word latched for the current or last frame.
  std::uint64_t latched() const { return word_; }
  // Timeout that applies to the current or last frame, ps.
  Time timeout() const { return timeout_; }

 private:
  enum class State { kIdle, kArmed, kAckWait, kBusy, kCds, kData, kPass };

  void rising(Time now, bool sli);
  bool control_bit(bool sli);
  void follow(bool sli);
  void load_shift_register();
  void shift();

  BissCSlaveConfig config_;
  Random random_;
  ControlSlave control_;
  State state_ = State::kIdle;
  bool ma_ = true;
  bool slo_ = true;
  bool is_last_ = true;
  bool sli_before_ = false;
  std::uint64_t word_ = 0;
  unsigned busy_left_ = 0;
  Time first_falling_ = 0;
  Time last_edge_ = 0;
  Time timeout_ = 0;
  // Shift register as a ring: one entry a bit, own bits first, then what came in at SLI.
  std::vector<std::uint8_t> shift_;
  std::size_t shift_head_ = 0;
  bool shift_loaded_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_C_SLAVE_HPP_
