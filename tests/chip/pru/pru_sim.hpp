// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_pru with an encoder behind a cable in the simulator. The host reads the memory behind each
// frame.
#ifndef TESTS_CHIP_PRU_SIM_HPP_
#define TESTS_CHIP_PRU_SIM_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

#include "mb4sim/simulator.hpp"
#include "pru_regs.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/wave.hpp"

namespace mb4test {

namespace prureg = biss_pru::regs;
namespace sim = mb4::sim;

inline std::string pru_scenario(const std::string& channel, std::uint64_t f_clk_hz = 200'000'000) {
  return "[master]\ntype = \"pru\"\n[chip]\nf_clk_hz = " + std::to_string(f_clk_hz) + "\n" +
         channel;
}

// The memory of a frame.
struct PruFrame {
  std::uint64_t position = 0;
  std::uint32_t status = 0;
  std::uint32_t received = 0;
  std::uint32_t times = 0;
  std::uint32_t signals = 0;
  std::uint32_t count = 0;  // FRAME_COUNT
  std::uint32_t latch = 0;  // LATCH_TIME
  unsigned ma_rises = 0;    // rising edges of MA since the frame before
  std::uint32_t irq = 0;    // IRQ_STATUS
  std::uint64_t sent = 0;   // by the encoder: its last word

  // Position, nE, nW: as the encoder has sent them.
  std::uint64_t word() const {
    return position << 2U | prureg::NE::get(signals) << 1U | prureg::NW::get(signals);
  }
  std::uint32_t flags() const { return status >> 16U & 0xFFU; }
  std::uint32_t crc_errors() const { return prureg::POS_CRC_ERRORS::get(status); }
  std::uint32_t raw() const { return prureg::RAW_DATA::get(received); }
  std::uint32_t crc() const { return prureg::POS_CRC::get(received); }
  std::uint32_t ctrl_crc() const { return prureg::CTRL_CRC::get(received); }
  std::uint32_t line_delay() const { return prureg::LINE_DELAY::get(times); }
  std::uint32_t processing() const { return prureg::PROC_TIME::get(times); }
};

// Of the byte FLAGS.
inline constexpr std::uint32_t kPruAverage = 1U << 0U;
inline constexpr std::uint32_t kPruLate = 1U << 1U;
inline constexpr std::uint32_t kPruSending = 1U << 2U;
inline constexpr std::uint32_t kPruCrc = 1U << 3U;
inline constexpr std::uint32_t kPruControlCrc = 1U << 4U;
inline constexpr std::uint32_t kPruNoSlave = 1U << 5U;

class PruSim {
 public:
  explicit PruSim(const std::string& scenario, const sim::SimulatorOptions& options = {})
      : simulator(sim::parse_scenario(scenario, "test.toml"), mb4test::with_wave(options)),
        host(*simulator.word_bus()),
        irq_(*simulator.pin_by_name("irq_o")),
        ma_(*simulator.pin_by_name("ma_o")) {}

  void write(std::uint32_t address, std::uint32_t data, std::uint8_t strobe = 0xF) {
    EXPECT_EQ(host.write(address, data, strobe), std::uint8_t{0});
  }
  std::uint32_t read(std::uint32_t address) {
    std::uint32_t data = 0;
    EXPECT_EQ(host.read(address, data), std::uint8_t{0});
    return data;
  }

  // RUN, and its frame at 1 MHz. `tail`: bits of nE, nW and CRC.
  PruFrame start(unsigned bits, unsigned tail, unsigned mhz, unsigned period_us = 100) {
    const std::uint64_t hz = simulator.scenario().chip.f_clk_hz;
    write(prureg::kAddrRun, 0);
    write(prureg::kAddrLengths, prureg::DATA_LENGTH::of(bits) | prureg::CRC_ERR_WAR::of(tail) |
                                    prureg::FREQUENCY::of(mhz));
    write(prureg::kAddrTriggerPeriod, static_cast<std::uint32_t>(period_us * (hz / 1'000'000)));
    write(prureg::kAddrIrqStatus, 0x1F);
    write(prureg::kAddrIrqEnable, prureg::FRAME_ENDED_ENABLE::kMask);
    write(prureg::kAddrRun, 1);
    return frame();
  }
  // The next frame.
  PruFrame frame() {
    PruFrame out;
    const sim::Time limit = simulator.now() + 5'000 * sim::kPsPerUs;
    bool before = simulator.pin(ma_);
    const bool ended = simulator.run_while_waiting(
        [&] {
          const bool level = simulator.pin(ma_);
          out.ma_rises += level && !before ? 1 : 0;
          before = level;
          return simulator.pin(irq_);
        },
        limit);
    EXPECT_TRUE(ended) << "no frame";
    out.sent = simulator.slave(1)->sent_word().value_or(0);
    const std::uint64_t high = read(prureg::kAddrPosHi);
    out.position = high << 32U | read(prureg::kAddrPosLo);
    out.status = read(prureg::kAddrStatus);
    out.received = read(prureg::kAddrReceived);
    out.times = read(prureg::kAddrTimes);
    out.signals = read(prureg::kAddrSignals);
    out.count = read(prureg::kAddrFrameCount);
    out.latch = read(prureg::kAddrLatchTime);
    out.irq = read(prureg::kAddrIrqStatus);
    write(prureg::kAddrIrqStatus, 0x1F);
    return out;
  }
  // A control frame, to its end. The last frame of it.
  PruFrame control(std::uint32_t word) {
    write(prureg::kAddrCtrl, word);
    for (unsigned i = 0; i < 100; ++i) {
      const PruFrame one = frame();
      if ((one.irq & prureg::CTRL_ENDED::kMask) != 0) return one;
    }
    ADD_FAILURE() << "the control frame does not end";
    return {};
  }
  // CTRL_RESULT, or nothing if its CRC was wrong.
  std::optional<std::uint8_t> access(std::uint32_t word) {
    const PruFrame end = control(word);
    if ((end.flags() & kPruControlCrc) != 0) return {};
    return static_cast<std::uint8_t>(read(prureg::kAddrCtrlResult));
  }

  sim::Simulator simulator;
  sim::WordHost& host;

 private:
  sim::Pin irq_;
  sim::Pin ma_;
};

}  // namespace mb4test

#endif  // TESTS_CHIP_PRU_SIM_HPP_
