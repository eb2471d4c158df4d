// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// An SSI encoder.
//
// - The first falling edge of MA latches the word and starts a monoflop. Every further falling edge
//   starts the monoflop again.
// - Each rising edge shows the next bit, MSB first. After the word the line is 0 until the monoflop
//   has run out.
// - With multiple transmission (ring) one 0 and the same word follow the word.
// - Extended SSI: the level of MA when the monoflop runs out is a CDM bit. With these bits a master
//   can write registers as in BiSS C, without an answer.
//
// Source: iC-MB4 Rev D2, pages 14, 16.
#ifndef MB4SIM_SSI_SLAVE_HPP_
#define MB4SIM_SSI_SLAVE_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/lines/clocked/clocked_slave.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "sim/lines/sensor_config.hpp"

namespace mb4::sim {

struct SsiSlaveConfig : SensorConfig {
  SsiSlaveConfig() {
    name = "ssi";
    flag_bits = 0;
    flags = 0;
    crc = {};
    control.present = false;
  }

  bool gray = false;  // the position is sent in Gray code; the flags after it are not converted
  bool ring = false;  // multiple transmission
  // Duration of the monoflop, ps.
  Time monoflop = 20 * kPsPerUs;
  Time response = 0;      // from a rising edge of MA to the bit at SLO, ps
  ControlConfig control;  // present: extended SSI

  std::unique_ptr<Slave> make_slave(std::uint64_t seed) const override;
  DeviceTraits traits() const override;
};

class SsiSlave final : public ClockedSlave {
 public:
  explicit SsiSlave(const SsiSlaveConfig& config);

  void ma_edge(Time now, bool ma, bool sli_before, bool sli) override;
  void sli_changed(Time /*now*/, bool /*sli*/) override {}
  void timer(Time now, bool sli) override;

  unsigned data_bits() const override { return config_.data_bits; }
  // Sets the word before its conversion into Gray code.
  bool set_data(std::uint64_t raw) override { return config_.hold(raw); }
  std::optional<std::uint64_t> sent_word() const override { return raw_; }
  ControlSlave* control() override { return config_.control.present ? &control_ : nullptr; }

  const SsiSlaveConfig& config() const { return config_; }
  // The data bits, without CRC, that the line carries for the word `raw`.
  std::uint64_t line_word(std::uint64_t raw) const;

 private:
  struct Change {
    Time time;
    bool level;
  };

  void wait();
  void begin(Time now);
  void end(Time now);
  bool bit(std::uint64_t index) const;
  void show(Time now, bool level);

  SsiSlaveConfig config_;
  ControlSlave control_;
  bool active_ = false;
  bool ma_ = true;
  std::uint64_t raw_ = 0;     // word of the running frame
  std::uint64_t data_ = 0;    // the same word as on the line
  std::uint32_t crc_ = 0;     // CRC after this word
  std::uint64_t rising_ = 0;  // rising edges of the running frame
  Time last_falling_ = 0;
  // Bits on their way to SLO, from next_change_ on. Usually there are none.
  std::vector<Change> changes_;
  std::size_t next_change_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SSI_SLAVE_HPP_
