// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated tops mb4_axil and mb4_wb behind an interface without Verilator types.
#ifndef MB4SIM_MB4_BUS_MODEL_HPP_
#define MB4SIM_MB4_BUS_MODEL_HPP_

#include <cstdint>
#include <memory>

#include "sim/core/time.hpp"
#include "sim/hosts/host_config.hpp"
#include "sim/hosts/word_access.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/master_model.hpp"

namespace mb4::sim {

// The core has the clock f_clk_hz, the bus the clock bus_hz. Both begin at time 0: with the same
// frequency they are one clock.
class BusModel : public MasterModel, public WordManager {
 public:
  static constexpr Outputs kEot = own(0);
  static constexpr Outputs kNerLow = own(1);
  static constexpr Outputs kIrq = own(2);
  static constexpr Outputs kClkeni = own(3);
  static constexpr Outputs kAnswered = own(4);  // changes at the end of each access

  // Levels of pins.
  virtual void set_reset(Time now, bool active) = 0;
  virtual void set_getsens(Time now, bool level) = 0;
  virtual void set_ner(Time now, bool level) = 0;
  virtual bool clk() const = 0;
  virtual bool sl(unsigned line) const = 0;
};

// On return the reset is active, and all other inputs have the levels of pins that nobody drives.
std::unique_ptr<BusModel> make_axi_bus_model(const ChipConfig& chip, std::uint64_t bus_hz,
                                             std::uint64_t seed);
std::unique_ptr<BusModel> make_wb_bus_model(const ChipConfig& chip, std::uint64_t bus_hz,
                                            std::uint64_t seed);

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_BUS_MODEL_HPP_
