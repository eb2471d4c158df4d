// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host whose accesses follow each other as fast as the datasheet allows.
#ifndef TESTS_CHIP_HOST_FAST_HOST_HPP_
#define TESTS_CHIP_HOST_FAST_HOST_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "mb4/mb4.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/hosts/parallel_host.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/wave.hpp"

namespace mb4test {

namespace reg = mb4::regs;
namespace sim = mb4::sim;

inline constexpr unsigned kPhases = 50;

// A chip behind its fastest host: SPI at 50 MHz, or the shortest bus cycles.
class FastHost {
 public:
  FastHost(const std::string& interface, double clk_mhz, const std::string& rest = "")
      : simulator_(
            sim::parse_scenario(
                "[chip]\nf_clk_hz = " + std::to_string(static_cast<unsigned>(clk_mhz * 1e6)) +
                    "\n[host]\ninterface = \"" + interface + "\"\nsclk_hz = 50_000_000\n" + rest,
                "test.toml"),
            mb4test::with_wave()),
        spi_(interface == "spi") {
    if (!spi_) simulator_.bus().set_timing({});
  }
  sim::Simulator& chip() { return simulator_; }

  void write(std::uint8_t address, const std::vector<std::uint8_t>& bytes) {
    if (spi_) {
      std::vector<std::uint8_t> tx{0x02, address};
      if (address == reg::kAddrInstr) tx = {0x07};
      tx.insert(tx.end(), bytes.begin(), bytes.end());
      simulator_.spi().transfer(tx, {});
    } else {
      for (const auto byte : bytes) simulator_.bus().write(address++, byte);
    }
  }
  std::uint8_t read(std::uint8_t address) {
    if (!spi_) return simulator_.bus().read(address);
    std::vector<std::uint8_t> tx{0x03, address, 0x00}, rx(3);
    simulator_.spi().transfer(tx, rx);
    return rx[2];
  }
  // Time passes up to phase `of` kPhases of a period of CLK.
  void phase(sim::Time period, unsigned of) {
    simulator_.run_until((simulator_.now() / period + 20) * period + period * of / kPhases);
  }

 private:
  sim::Simulator simulator_;
  bool spi_;
};

}  // namespace mb4test

#endif  // TESTS_CHIP_HOST_FAST_HOST_HPP_
