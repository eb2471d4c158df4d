// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Scenarios of all protocols, and the driver's configuration of them, written out by hand.

#ifndef TESTS_DRIVER_RTL_PROTOCOL_BUS_HPP_
#define TESTS_DRIVER_RTL_PROTOCOL_BUS_HPP_

#include <cstdint>
#include <string>

#include "mb4/mb4.hpp"
#include "tests/driver/rtl/fault_bus.hpp"

namespace mb4test {

inline std::string on_channel(unsigned number, const std::string& keys = "") {
  return "[[channel]]\nnumber = " + std::to_string(number) + "\n" + keys;
}

inline std::string device(const std::string& protocol, unsigned bits, const std::string& keys) {
  return "[[channel.slave]]\nprotocol = \"" + protocol + "\"\ndata_bits = " + std::to_string(bits) +
         "\n" + keys + "\n";
}

// A configuration with nothing on it. MA at 2 MHz, 20 MHz at pin CLK.
inline mb4::Config empty_config(mb4::Protocol first,
                                mb4::Protocol second = mb4::Protocol::kUnused) {
  mb4::Config config;
  config.ma_hz = 2'000'000;
  config.channels[0].protocol = first;
  config.channels[1].protocol = second;
  return config;
}

inline void add(mb4::Config& config, unsigned slave, unsigned bits, std::uint32_t crc,
                mb4::Flags flags = mb4::Flags::kNone) {
  mb4::SlaveConfig& one = config.slaves[slave - 1];
  one.enabled = true;
  one.data_bits = static_cast<std::uint8_t>(bits);
  one.crc_polynomial = crc;
  one.flags = flags;
}

inline void add_actuator(mb4::Config& config, unsigned slave, unsigned bits, bool stop_bit = true) {
  add(config, slave, bits, 0x43);
  config.slaves[slave - 1].actuator = true;
  config.slaves[slave - 1].stop_bit = stop_bit;
  config.mo = true;
}

// One BiSS B slave with 28 bits: f_MA 2 MHz, register clock 250 kHz.
inline const std::string kBissBKeys = "timeout = 2\nregister_timeout = 4\nflag_bits = 0\n";

inline mb4::Config biss_b_config(bool mo) {
  mb4::Config config = empty_config(mb4::Protocol::kBissB);
  config.mo = mo;
  config.register_divider = 8;
  config.register_timeout_us = 5;
  add(config, 1, 28, 0x43);
  return config;
}

inline std::string biss_b_bus(bool mo, const std::string& keys = "") {
  return on_channel(1, mo ? "mo = true\n" : "") + device("biss-b", 28, kBissBKeys + keys);
}

}  // namespace mb4test

#endif  // TESTS_DRIVER_RTL_PROTOCOL_BUS_HPP_
