// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS C sensor or actuator. It follows the frame of the datasheet's BiSS C chapter:
//
//   first falling edge of MA   SLI = 0 tells the slave that it is the last one
//   first rising edge          the slave latches its word
//   second rising edge         the slave acknowledges
//   after its busy periods     start bit, CDS, data and inverted CRC, MSB first
//
// SLI of a slave that is not the last one comes from another slave or from pin MO. Such a slave
// passes the start bit on, and also the acknowledge if `passes_acknowledge` is set. In a chain the
// slave is a shift register of its own length. If a command has switched its data channel off, it
// passes SLI on instead. ControlSlave handles CDS and CDM.
//
// Source: iC-MB4 Rev D2, page 15, figures 11 and 12.
#ifndef MB4SIM_BISS_C_SLAVE_HPP_
#define MB4SIM_BISS_C_SLAVE_HPP_

#include <cstdint>
#include <memory>
#include <string_view>

#include "mb4sim/actuator.hpp"
#include "mb4sim/biss_slave_config.hpp"
#include "mb4sim/control_slave.hpp"
#include "mb4sim/shift_register.hpp"
#include "mb4sim/slave.hpp"
#include "mb4sim/slave_timeout.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

struct BissCSlaveConfig : BissSlaveConfig {
  BissCSlaveConfig() { name = "biss-c"; }

  ControlConfig control;
  // An actuator takes the word that MO brings for it and sends the word that it had before.
  // `source` gives the first of these.
  bool actuator = false;
  bool stop_bit = true;  // actuator: a 0 precedes its data (LSTOP)

  // Length of the data channel on the line, in bits.
  unsigned channel_bits() const { return word_bits() + (actuator && stop_bit ? 1U : 0U); }

  std::unique_ptr<Slave> make_slave(std::uint64_t seed) const override;
  DeviceTraits traits() const override;
  std::string_view refuses(SlaveFault fault) const override;
};

class BissCSlave final : public Slave {
 public:
  BissCSlave(const BissCSlaveConfig& config, std::uint64_t seed);

  void ma_edge(Time now, bool ma, bool sli_before, bool sli) override;
  void last_edge(Time edge, bool ma) override;
  void sli_changed(Time now, bool sli) override;
  void timer(Time now, bool sli) override;

  unsigned data_bits() const override { return config_.data_bits; }
  bool set_data(std::uint64_t raw) override;
  ControlSlave* control() override { return config_.control.present ? &control_ : nullptr; }
  std::optional<std::uint64_t> sent_word() const override { return word_; }
  void set_fault(SlaveFault fault, bool on) override {
    if (fault == SlaveFault::kWrongId) control_.faults().set_wrong_id(on);
    Slave::set_fault(fault, on);
  }
  const Actuator* actuator() const override { return config_.actuator ? &actuator_ : nullptr; }

  const BissCSlaveConfig& config() const { return config_; }
  // SLI was 0 at the start of the last frame.
  bool is_last() const { return is_last_; }
  // The word latched for the current or last frame.
  std::uint64_t latched() const { return word_; }
  // The timeout of the current or last frame, ps.
  Time timeout() const { return timeout_.value(); }

 private:
  enum class State { kIdle, kArmed, kAckWait, kBusy, kStart, kCds, kData, kPass };

  void rising(Time now, bool sli_before, bool sli);
  void begin_cds(bool sli);
  void end_cds(bool sli);
  void follow(bool sli);

  BissCSlaveConfig config_;
  ControlSlave control_;
  Actuator actuator_;
  State state_ = State::kIdle;
  bool ma_ = true;
  bool is_last_ = true;
  bool sli_was_low_ = false;  // since the acknowledge
  bool cds_flip_ = false;
  std::uint64_t word_ = 0;
  unsigned busy_left_ = 0;
  TimeoutClock timeout_;
  ShiftRegister shift_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_C_SLAVE_HPP_
