// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS C sensor or actuator. It follows the frame of the datasheet's BiSS C chapter:
//
//   request, acknowledge, start bit   biss_slave.hpp
//   after the start bit               CDS, data and inverted CRC, MSB first
//
// A slave that is not the last one passes the start bit on, and also the acknowledge if
// `passes_acknowledge` is set. In a chain the slave is a shift register of its own length. If a
// command has switched its data channel off, it passes SLI on instead. ControlSlave handles CDS and
// CDM.
//
// Source: iC-MB4 Rev D2, page 15, figures 11 and 12.
#ifndef MB4SIM_BISS_C_SLAVE_HPP_
#define MB4SIM_BISS_C_SLAVE_HPP_

#include <cstdint>
#include <memory>
#include <string_view>

#include "sim/core/time.hpp"
#include "sim/lines/biss/biss_slave.hpp"
#include "sim/lines/biss/biss_slave_config.hpp"
#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "sim/lines/slave.hpp"

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
  std::string_view refuses(const SlaveFault& fault) const override;
};

class BissCSlave final : public BissSlave<BissCSlaveConfig> {
 public:
  BissCSlave(const BissCSlaveConfig& config, std::uint64_t seed);

  void ma_edge(Time now, bool ma, bool sli_before, bool sli) override;
  void last_edge(Time edge, bool ma) override;
  void sli_changed(Time now, bool sli) override;
  void timer(Time now, bool sli) override;

  bool set_data(std::uint64_t raw) override;
  bool sends_data() const override { return control_.data_active(); }
  ControlSlave* control() override { return config_.control.present ? &control_ : nullptr; }
  void set_fault(const SlaveFault& fault, bool on) override;
  const Actuator* actuator() const override { return config_.actuator ? &actuator_ : nullptr; }

  // The word latched for the current or last frame.
  std::uint64_t latched() const { return word_; }
  // The timeout of the current or last frame, ps.
  Time timeout() const { return timeout_.value(); }

 private:
  std::uint64_t next_word(Time now);
  void rising(Time now, bool sli_before, bool sli);
  void begin_cds();
  void end_cds(bool sli);
  void follow(bool sli);

  ControlSlave control_;
  Actuator actuator_;
  bool cds_flip_ = false;
  bool stuck_word_ = false;  // faults, see biss_c_faults.hpp
  bool stuck_counter_ = false;
  bool skipped_word_ = false;
  std::uint64_t counted_frames_ = 0;  // frames that the life counter knows of
  std::uint64_t life_steps_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_C_SLAVE_HPP_
