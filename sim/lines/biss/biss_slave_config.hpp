// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The properties that BiSS B and BiSS C slaves share: a sensor that acknowledges a request.
#ifndef MB4SIM_BISS_SLAVE_CONFIG_HPP_
#define MB4SIM_BISS_SLAVE_CONFIG_HPP_

#include <string_view>

#include "sim/lines/biss/biss_c_faults.hpp"
#include "sim/lines/clocked/slave_timeout.hpp"
#include "sim/lines/sensor_config.hpp"

namespace mb4::sim {

struct BissSlaveConfig : SensorConfig {
  SlaveTimeout timeout;       // BiSS B: of sensor mode
  unsigned busy_periods = 0;  // periods of MA between acknowledge and start bit beyond one
  // true: SLO of a slave that is not the last one stays SLI from the request to the start bit.
  // false: the second rising edge of MA makes SLO 0, whatever SLI is.
  bool passes_acknowledge = false;

  std::string_view refuses(const SlaveFault& fault) const override {
    if (fault == slave_fault::kBusy) return "";
    if (fault == slave_fault::kWrongId) {
      return "only a BiSS C slave with control communication has an ID";
    }
    return SensorConfig::refuses(fault);
  }
};

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_SLAVE_CONFIG_HPP_
