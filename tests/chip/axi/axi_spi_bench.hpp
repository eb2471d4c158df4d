// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_spi with encoders behind cables, and the driver over words on SPI.
#ifndef TESTS_CHIP_AXI_SPI_BENCH_HPP_
#define TESTS_CHIP_AXI_SPI_BENCH_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "biss_axi/device.hpp"
#include "biss_axi/page.hpp"
#include "biss_axi/spi_port.hpp"
#include "sim/hosts/spi_host.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {

struct SpiBus {
  bool transfer(enc::Span<const std::uint8_t> tx, enc::Span<std::uint8_t> rx) {
    host.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
    return true;
  }
  sim::SpiHost& host;
};

struct SpiClock {
  std::uint32_t now_us() {
    simulator.advance(100 * sim::kPsPerNs);
    return static_cast<std::uint32_t>(simulator.now() / sim::kPsPerUs);
  }
  sim::Simulator& simulator;
};

inline std::string behind_spi(const std::vector<AxiEncoder>& encoders, std::uint64_t f_clk_hz,
                              std::uint64_t sclk_hz, const std::string& features = "document") {
  return with_features(axi_scenario(encoders, f_clk_hz) +
                           "[host]\ninterface = \"spi\"\nsclk_hz = " + std::to_string(sclk_hz) +
                           "\n",
                       features);
}

struct SpiBench {
  explicit SpiBench(const std::string& scenario)
      : simulator(sim::parse_scenario(scenario, "test.toml")) {
    simulator.advance(AxiBench::kTimeoutLimit * sim::kPsPerSecond /
                      simulator.scenario().chip.f_clk_hz);
  }
  sim::Simulator simulator;
  SpiBus bus{simulator.spi()};
  SpiClock clock{simulator};
  biss_axi::SpiPort<SpiBus> port{bus};
  biss_axi::Device<biss_axi::SpiPort<SpiBus>, SpiClock> device{port, clock};
  biss_axi::Page<biss_axi::SpiPort<SpiBus>> page{port};
};

}  // namespace mb4test

#endif  // TESTS_CHIP_AXI_SPI_BENCH_HPP_
