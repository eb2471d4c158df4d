// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The workloads whose speed is measured, by `mb4sim bench` and by tests/bench.
#ifndef MB4SIM_TOOL_WORKLOAD_HPP_
#define MB4SIM_TOOL_WORKLOAD_HPP_

#include <cstdint>
#include <memory>
#include <span>

#include "sim/core/time.hpp"

namespace mb4::tool {

// What a workload has done since it was made.
struct WorkCount {
  std::uint64_t clocks = 0;    // system clocks of the chip
  std::uint64_t frames = 0;    // of all slaves: eight slaves in one frame count eight
  std::uint64_t accesses = 0;  // register accesses ended well, 64 registers each
  std::uint64_t spi_bytes = 0;
  sim::Time time = 0;  // simulated
};

class Workload {
 public:
  Workload() = default;
  Workload(const Workload&) = delete;
  Workload& operator=(const Workload&) = delete;
  virtual ~Workload() = default;

  // Lets `duration` of simulated time pass, or a little more. Throws std::runtime_error if the chip
  // does not do the work of this workload, sim::ModelStopped.
  virtual void run(sim::Time duration) = 0;
  virtual WorkCount count() const = 0;
};

struct WorkloadInfo {
  char letter;
  const char* description;
  // A configured chip with the workload running. Throws std::runtime_error, sim::ModelStopped.
  std::unique_ptr<Workload> (*make)();
};

// A: 1 slave of 26 bits, automatic frames back to back (FREQAGS = AGSMIN) at f_MA = 10 MHz.
// B: 8 slaves on both channels, AGSMIN, one register access after another.
// C: 1 slave, 1000 frames a second, idle in between; the host does not read the data.
// D: SPI traffic only, no frames.
// E: firmware starts a frame, waits for it and reads it, one after the other (`mb4sim run`).
// F: an interrupt reads automatic frames at 4 kHz (Automatic::poll_slave()).
// G: a simulator is made, configured and has read its first frame, again and again.
// E, F and G replay recorded SPI bytes without the driver; SCLK is 10 MHz.
// K: A with f_MA = 1 MHz.
// A to G, K: the iC-MB4 (masters/mb4/mb4_workload.hpp) with f_CLK = 20 MHz.
// H, I: biss_axi with 1 and with 4 encoders (masters/axi/axi_workload.hpp), 100 MHz.
// J: dsl_axil with an encoder (masters/dsl/dsl_workload.hpp), 75 MHz.
// In the order of their letters.
std::span<const WorkloadInfo> workloads();

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_WORKLOAD_HPP_
