// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/chip/clb/clb_bench.hpp"

#include "tests/support/wave.hpp"

namespace mb4test {
namespace {

ClbBench* bench_now = nullptr;

}  // namespace

ClbBench::ClbBench(const std::string& scenario, const sim::SimulatorOptions& options)
    : simulator(sim::parse_scenario(scenario, "test.toml"), mb4test::with_wave(options)),
      host(*simulator.word_bus()) {
  EXPECT_EQ(bench_now, nullptr) << "one master a program";
  bench_now = this;
}

ClbBench::~ClbBench() { bench_now = nullptr; }

void ClbBench::set_up(unsigned bits, unsigned div) {
  div_ = div;
  scd.positionSTBits = static_cast<std::uint16_t>(bits);
  PM_bissc_setupPeriph();
  PM_bissc_initParams(&scd, &cd);
  PM_bissc_setFreq(div);
}

unsigned ClbBench::frame() {
  PM_bissc_doCDTasks(&cd, &reg);
  PM_bissc_setupSCDTransaction(&scd);
  PM_bissc_startOperation(&scd, div_);
  const sim::Time limit = simulator.now() + 100'000 * sim::kPsPerUs;
  const sim::Pin irq = *simulator.pin_by_name("irq_o");
  while (!scd.dataReady && simulator.now() < limit) {
    simulator.run_while_waiting([&] { return simulator.pin(irq); }, limit);
    bissc_spiRxISR();
  }
  return PM_bissc_receivePosition(&scd, &cd, &encoder);
}

unsigned ClbBench::access(enum cdRegisterAccessType type, unsigned address, unsigned data) {
  reg.accessType = type;
  reg.address = static_cast<std::uint16_t>(address);
  reg.txData = static_cast<std::uint16_t>(data);
  cd.cdState = PM_BISSC_CD_NEW_REQUEST;
  for (int frames = 0; frames < 200; ++frames) {
    if (cd.cdState == PM_BISSC_CD_PARSED) return static_cast<unsigned>(cd.cdStatus);
    frame();
  }
  return PM_BISSC_FAIL;
}

}  // namespace mb4test

extern "C" {

void pm_bissc_port_write(uint32_t offset, uint32_t value) {
  mb4test::bench_now->write(offset, value);
}
uint32_t pm_bissc_port_read(uint32_t offset) { return mb4test::bench_now->read(offset); }
uint32_t pm_bissc_port_now_us(void) {
  return static_cast<uint32_t>(mb4test::bench_now->simulator.now() / mb4test::sim::kPsPerUs);
}
}
