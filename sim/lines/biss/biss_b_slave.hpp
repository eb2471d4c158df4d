// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS B sensor. Its frame is that of BiSS C without CDS and CDM.
//
// Two events select register mode. If MA stays low after the first falling edge until the sensor
// timeout, the slave confirms register mode with SLO = 0. On a bus MO selects it by a fall just
// before the first falling edge of MA. Register mode ends when MA has rested for the register
// timeout.
//
// Source: iC-MB4 Rev D2, pages 12, 13, 16.
#ifndef MB4SIM_BISS_B_SLAVE_HPP_
#define MB4SIM_BISS_B_SLAVE_HPP_

#include <cstdint>
#include <memory>

#include "sim/core/time.hpp"
#include "sim/lines/biss/biss_b_registers.hpp"
#include "sim/lines/biss/biss_slave.hpp"
#include "sim/lines/biss/biss_slave_config.hpp"
#include "sim/lines/slave.hpp"

namespace mb4::sim {

struct BissBSlaveConfig : BissSlaveConfig {
  BissBSlaveConfig() {
    name = "biss-b";
    timeout.fixed = 16 * kPsPerUs;
  }

  // Timeout of register mode, ps. 0: 1.5 periods of the register clock, measured in the start bit;
  // before that `register_initial`.
  Time register_timeout = 0;
  Time register_initial = 1000 * kPsPerUs;
  BissBRegisterConfig access;

  std::unique_ptr<Slave> make_slave(std::uint64_t seed) const override;
  DeviceTraits traits() const override;
  unsigned set_ids_behind(unsigned ids) override;
};

class BissBSlave final : public BissSlave<BissBSlaveConfig> {
 public:
  BissBSlave(const BissBSlaveConfig& config, std::uint64_t seed);

  void ma_edge(Time now, bool ma, bool sli_before, bool sli) override;
  void sli_changed(Time now, bool sli) override;
  void timer(Time now, bool sli) override;

  bool set_data(std::uint64_t raw) override { return config_.hold(raw); }

  bool in_register_mode() const { return state_ == State::kRegister; }
  // How often the timeout has selected register mode, and how often MO has.
  std::uint64_t handshakes() const { return handshakes_; }
  std::uint64_t mo_selections() const { return mo_selections_; }
  BissBRegisters& access() { return access_; }

 private:
  void rising(Time now, bool sli_before, bool sli);
  void first_falling(Time now, bool sli);
  void follow(Time now, bool sli);
  Time register_timeout() const;
  void wait();

  BissBRegisters access_;
  bool sli_ = false;
  Time sli_fell_ = kNever;  // kNever: it has not fallen yet
  Time last_edge_ = 0;
  Time first_cell_ = 0;       // start of the first cell of register mode
  Time register_period_ = 0;  // its length; 0: not measured yet
  std::uint64_t handshakes_ = 0;
  std::uint64_t mo_selections_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_B_SLAVE_HPP_
