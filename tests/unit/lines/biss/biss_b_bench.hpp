// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS B master made of MA and MO edges only: the timing of pages 12 and 13 of the datasheet, the
// fields of docs/choices.md.
#ifndef TESTS_UNIT_LINES_BISS_BISS_B_BENCH_HPP_
#define TESTS_UNIT_LINES_BISS_BISS_B_BENCH_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "sim/lines/biss/biss_b_slave.hpp"
#include "tests/unit/lines/registers/control_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

inline BissBSlaveConfig biss_b_slave(unsigned data_bits, std::uint64_t word,
                                     std::uint32_t polynomial) {
  BissBSlaveConfig config;
  config.data_bits = data_bits;
  config.crc = Crc{polynomial, 0};
  config.source.constant = word;
  return config;
}

// ID, address, WNR and their inverted CRC between start and stop bit.
inline std::string biss_b_header(unsigned id, unsigned address, bool write) {
  const std::string fields = binary(id, 3) + binary(address, 7) + (write ? "1" : "0");
  return std::string("1") + fields + crc4(fields) + "0";
}

class BissBBench : public ChainBench {
 public:
  Time cell = 800 * kPsPerNs;  // T_MAR

  BissBSlave& add(const BissBSlaveConfig& config) { return put<BissBSlave>(config, 1U); }

  // MA falls and stays low until SL confirms; false after 1 ms.
  bool hand_over() {
    ma(now + cell, false);
    const Time limit = now + from_us(1000);
    while (chain.slo() && now < limit) run_until(now + 100 * kPsPerNs);
    return !chain.slo();
  }
  // The other way: MO falls just before MA.
  void select_by_mo() {
    set_mo(now + cell, false);
    ma(now + cell / 4, false);
  }
  void set_mo(Time time, bool level) {
    run_until(time);
    mo = level;
    chain.drive(time, chain.ma(), mo);
  }
  // One cell; returns SL as it stands just before its rising edge.
  bool clock(unsigned high_percent) {
    const Time rise = now + cell * (100 - last_high_) / 100;
    run_until(rise - 1);
    const bool level = chain.slo();
    ma(rise, true);
    ma(rise + cell * high_percent / 100, false);
    last_high_ = high_percent;
    return level;
  }
  // Cells of '0' (25 %), '1' (75 %) and 'c' (50 %); SL at the rising edge of each.
  std::string send(const std::string& bits) {
    std::string answer;
    for (const char bit : bits) {
      answer += clock(bit == '1' ? 75 : bit == '0' ? 25 : 50) ? '1' : '0';
    }
    return answer;
  }
  // The last rising edge; MA rests high. Returns SL before it.
  bool finish() {
    const Time rise = now + cell * (100 - last_high_) / 100;
    run_until(rise - 1);
    const bool level = chain.slo();
    ma(rise, true);
    last_high_ = 50;
    return level;
  }

 private:
  unsigned last_high_ = 50;
};

}  // namespace mb4test

#endif  // TESTS_UNIT_LINES_BISS_BISS_B_BENCH_HPP_
