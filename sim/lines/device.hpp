// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A slave as a scenario describes it, whatever its protocol. The room of each protocol derives its
// own configuration from DeviceConfig. The rest of the simulator asks questions and names no
// protocol.
#ifndef MB4SIM_DEVICE_HPP_
#define MB4SIM_DEVICE_HPP_

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "sim/core/copied.hpp"
#include "sim/core/time.hpp"
#include "sim/lines/crc.hpp"
#include "sim/lines/slave.hpp"

namespace mb4::sim {

// How the slaves of a line talk. All slaves of a line have the same.
struct LineProtocol {
  std::string_view key;    // as in the scenario: "biss-c"
  std::string_view title;  // for the user: "BiSS C"
  bool start_bit = true;   // slaves acknowledge and send a start bit before their data
  bool control = false;    // CDS follows the start bit: a master can ask which slaves are there
  // Bits of an answer, where a bit-flip counts them; 0: it counts those of the whole frame.
  unsigned answer_bits = 0;

  // Bits of a frame before the data.
  unsigned leading_bits() const { return (start_bit ? 1U : 0U) + (control ? 1U : 0U); }
  bool operator==(const LineProtocol& other) const { return key == other.key; }
};

// What a master must know of a device to read it, and a user to choose it.
struct DeviceTraits {
  LineProtocol protocol;
  unsigned busy_periods = 0;  // periods of MA between acknowledge and start bit beyond one
  // Time without an edge of MA after which a frame is over, ps. 0: the device measures MA.
  Time timeout = 0;
  Time response = 0;     // from the edge that asks for a bit to this bit, at the device
  bool repeats = false;  // the word follows once more if the master goes on
  bool gray = false;
  bool actuator = false;   // it takes words from MO
  bool stop_bit = false;   // actuator: a 0 precedes its data
  bool registers = false;  // a master can reach registers
  // What such a device is called if it must be alone on its line; empty: it need not be.
  std::string_view alone{};
};

struct DeviceConfig {
  std::string name;
  unsigned data_bits = 28;  // 1 to 64, position and flags
  unsigned flag_bits = 2;   // the lowest bits of the word that are not part of the position
  Crc crc{0x43, 0};

  virtual ~DeviceConfig() = default;
  // `seed`: of the random values of this slave.
  virtual std::unique_ptr<Slave> make_slave(std::uint64_t seed) const = 0;
  virtual DeviceTraits traits() const = 0;
  // Returns why the device cannot have this fault; empty if it can. By default it can have kSilent,
  // and kWrongCrc if it has a CRC.
  virtual std::string_view refuses(const SlaveFault& fault) const;
  // The slave learns the number of IDs behind it. Returns the number of its own IDs that are fixed.
  virtual unsigned set_ids_behind(unsigned /*ids*/) { return 0; }

 protected:
  DeviceConfig() = default;
  DeviceConfig(const DeviceConfig&) = default;
  DeviceConfig& operator=(const DeviceConfig&) = default;
};

// Holds a DeviceConfig of any kind by value.
using Device = Copied<DeviceConfig>;

}  // namespace mb4::sim

#endif  // MB4SIM_DEVICE_HPP_
