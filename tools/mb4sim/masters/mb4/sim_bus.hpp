// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bus of the iC-MB4's driver on top of a simulator.
#ifndef MB4SIM_TOOL_SIM_BUS_HPP_
#define MB4SIM_TOOL_SIM_BUS_HPP_

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "mb4/parallel_bus.hpp"
#include "mb4/result.hpp"
#include "mb4/words/memory_bus.hpp"
#include "mb4_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim_clock.hpp"
#include "word_port.hpp"

namespace mb4::tool {

// Bus cycles of the simulated processor.
class SimPort {
 public:
  explicit SimPort(sim::Simulator& simulator) : simulator_(simulator) {}

  bool write(std::uint8_t address, std::uint8_t value) {
    const bool instruction = address == regs::kAddrInstr;
    if (instruction) simulator_.run_until(next_instruction_);
    simulator_.bus().write(address, value);
    if (instruction) next_instruction_ = simulator_.now() + gap();
    return true;
  }
  bool read(std::uint8_t address, std::uint8_t& value) {
    value = simulator_.bus().read(address);
    return true;
  }

 private:
  // Five clocks of the slower clock: CLKENI may choose either.
  sim::Time gap() const {
    const sim::ChipConfig& chip = simulator_.scenario().chip;
    const std::uint64_t pin_hz = chip.f_clk_hz != 0 ? chip.f_clk_hz : chip.f_osc_hz;
    return 5 * sim::kPsPerSecond / std::min(pin_hz, chip.f_osc_hz);
  }

  sim::Simulator& simulator_;
  sim::Time next_instruction_ = 0;
};

// SPI frames over whatever the scenario's interface is: SPI; with "spi2" reads of SCDATA5..8
// through SPI2; with "intel" and "motorola" as bus cycles; with "axi" and "wb" as words.
class SimBus {
 public:
  // `log`: takes one line for each frame, "bytes sent > bytes received" in hex. Received bytes are
  // there only if the caller takes them. Of words it takes a line for each access (WordPort).
  explicit SimBus(sim::Simulator& simulator, std::string* log = nullptr)
      : simulator_(simulator),
        port_(simulator),
        parallel_(port_),
        words_(simulator, log),
        memory_(words_),
        log_(simulator.scenario().host.interface.words ? nullptr : log) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    const bool done = exchange(tx, rx);
    if (log_ != nullptr) write_log(tx, rx);
    return done;
  }

 private:
  bool exchange(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    if (simulator_.scenario().host.parallel()) return parallel_.transfer(tx, rx);
    if (simulator_.scenario().host.interface.words) return memory_.transfer(tx, rx);
    sim::SpiHost& host = through_spi2(tx) ? simulator_.spi2() : simulator_.spi();
    host.transfer(std::span(tx.data(), tx.size()), std::span(rx.data(), rx.size()));
    return true;
  }

  void write_log(Span<const std::uint8_t> tx, Span<const std::uint8_t> rx) {
    static constexpr char kDigits[] = "0123456789ABCDEF";
    const auto put = [this](std::uint8_t byte) {
      *log_ += kDigits[byte >> 4U];
      *log_ += kDigits[byte & 15U];
      *log_ += ' ';
    };
    for (const std::uint8_t byte : tx) put(byte);
    *log_ += '>';
    for (const std::uint8_t byte : rx) {
      *log_ += ' ';
      put(byte);
      log_->pop_back();
    }
    *log_ += '\n';
  }

  bool through_spi2(Span<const std::uint8_t> tx) const {
    constexpr std::size_t kBegin = 0x20;
    constexpr std::size_t kEnd = 0x40;
    return simulator_.scenario().host.interface == sim::HostInterface::kSpi2 && tx.size() > 2 &&
           tx[0] == static_cast<std::uint8_t>(regs::SpiOpcode::kReadRegisters) && tx[1] >= kBegin &&
           tx[1] + tx.size() - 2 <= kEnd;
  }

  sim::Simulator& simulator_;
  SimPort port_;
  ParallelBus<SimPort> parallel_;
  WordPort words_;
  MemoryBus<WordPort> memory_;
  std::string* log_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SIM_BUS_HPP_
