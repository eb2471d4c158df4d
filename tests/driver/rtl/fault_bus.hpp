// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The Verilated chip on an SPI bus that fails where a test orders it.

#ifndef TESTS_DRIVER_RTL_FAULT_BUS_HPP_
#define TESTS_DRIVER_RTL_FAULT_BUS_HPP_

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "masters/mb4/sim_bus.hpp"
#include "mb4/mb4.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/test_host.hpp"
#include "tests/support/wave.hpp"

namespace mb4test {

enum class FaultKind : std::uint8_t {
  kNone,
  kRefused,      // transfer() returns false, the chip has seen nothing
  kFailedAfter,  // transfer() returns false, the chip has seen it all
  kLost,         // transfer() returns true, the chip has seen nothing, MISO is 0
  kMisoLow,      // MISO is 0 throughout
  kMisoHigh,     // MISO is 1 throughout
  kFlipMiso,     // bit `bit` of MISO, from the first byte's top bit
  kFlipMosi,     // bit `bit` of MOSI
  kStoresNot,    // transfer() returns true, the chip has seen it all, rx stays as it was
  kStoresLate,   // the same, and rx is stored at the start of the next transfer
};

struct Fault {
  FaultKind kind = FaultKind::kNone;
  std::size_t first = 0;  // transfer, from 0 on
  std::size_t last = 0;
  std::size_t bit = 0;

  [[nodiscard]] std::string text() const {
    return "fault " + std::to_string(static_cast<int>(kind)) + " in transfer " +
           std::to_string(first) + " to " + std::to_string(last) + ", bit " + std::to_string(bit);
  }
};

class FaultBus {
 public:
  explicit FaultBus(mb4::sim::Simulator& simulator) : inner_(simulator) {}

  // From now on transfers count from 0.
  void plan(const Fault& fault) {
    fault_ = fault;
    count_ = 0;
    bits_.clear();
    opcodes_.clear();
  }
  // Transfers since plan(), the bits and the opcode of each.
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::vector<std::size_t>& bits() const { return bits_; }
  [[nodiscard]] const std::vector<std::uint8_t>& opcodes() const { return opcodes_; }

  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    const std::size_t index = count_++;
    for (std::size_t i = 0; i < late_.size(); ++i) late_to_[i] = late_[i];
    late_.clear();
    bits_.push_back(8 * tx.size());
    opcodes_.push_back(tx[0]);
    if (fault_.kind == FaultKind::kNone || index < fault_.first || index > fault_.last) {
      return inner_.transfer(tx, rx);
    }
    std::vector<std::uint8_t> mosi(tx.begin(), tx.end());
    switch (fault_.kind) {
      case FaultKind::kRefused:
        return false;
      case FaultKind::kLost:
        fill(rx, 0x00);
        return true;
      case FaultKind::kFlipMosi:
        mosi[fault_.bit / 8] ^= static_cast<std::uint8_t>(0x80U >> fault_.bit % 8);
        break;
      default:
        break;
    }
    if (fault_.kind == FaultKind::kStoresNot || fault_.kind == FaultKind::kStoresLate) {
      std::vector<std::uint8_t> miso(rx.size());
      inner_.transfer(tx, mb4::Span<std::uint8_t>(miso.data(), miso.size()));
      if (fault_.kind == FaultKind::kStoresLate) {
        late_ = miso;
        late_to_ = rx.data();
      }
      return true;
    }
    inner_.transfer(mb4::Span<const std::uint8_t>(mosi.data(), mosi.size()), rx);
    if (fault_.kind == FaultKind::kMisoLow) fill(rx, 0x00);
    if (fault_.kind == FaultKind::kMisoHigh) fill(rx, 0xFF);
    if (fault_.kind == FaultKind::kFlipMiso && !rx.empty()) {
      rx[fault_.bit / 8] ^= static_cast<std::uint8_t>(0x80U >> fault_.bit % 8);
    }
    return fault_.kind != FaultKind::kFailedAfter;
  }

 private:
  static void fill(mb4::Span<std::uint8_t> rx, std::uint8_t level) {
    for (std::uint8_t& byte : rx) byte = level;
  }

  mb4::tool::SimBus inner_;
  Fault fault_;
  std::size_t count_ = 0;
  std::vector<std::uint8_t> late_;  // bytes that are still to be stored, and where
  std::uint8_t* late_to_ = nullptr;
  std::vector<std::size_t> bits_;
  std::vector<std::uint8_t> opcodes_;
};

inline constexpr std::size_t kForEver = std::numeric_limits<std::size_t>::max();

// A chip whose bus can fail, on the host interface that MB4_HOST names.
struct FaultyChip {
  explicit FaultyChip(const std::string& scenario)
      : simulator(mb4test::with_test_host(mb4::sim::parse_scenario(scenario, "test.toml")),
                  mb4test::with_wave()),
        bus(simulator),
        clock(simulator),
        device(bus, clock) {}

  mb4::sim::Simulator simulator;
  FaultBus bus;
  mb4::tool::SimClock clock;
  mb4::Device<FaultBus, mb4::tool::SimClock> device;
};

// Every way in which one transfer, or the bus from one transfer on, can go wrong, for a run of
// transfers of the given lengths in bits. Of the single bits, every `stride`-th.
inline std::vector<Fault> all_faults(const std::vector<std::size_t>& bits, std::size_t stride) {
  std::vector<Fault> faults;
  for (std::size_t index = 0; index < bits.size(); ++index) {
    for (const FaultKind kind :
         {FaultKind::kRefused, FaultKind::kFailedAfter, FaultKind::kLost, FaultKind::kMisoLow,
          FaultKind::kMisoHigh, FaultKind::kStoresNot}) {
      faults.push_back({kind, index, index, 0});
      faults.push_back({kind, index, kForEver, 0});
    }
    for (std::size_t bit = index % stride; bit < bits[index]; bit += stride) {
      faults.push_back({FaultKind::kFlipMiso, index, index, bit});
      faults.push_back({FaultKind::kFlipMosi, index, index, bit});
    }
  }
  return faults;
}

}  // namespace mb4test

#endif  // TESTS_DRIVER_RTL_FAULT_BUS_HPP_
