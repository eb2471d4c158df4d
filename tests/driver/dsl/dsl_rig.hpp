// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver of the DSL master on the Verilated dsl_axil, with an encoder behind a cable whose
// motion is the test's own: each position that it was asked for is kept, so a test knows all true
// ones.
#ifndef MB4_TESTS_DRIVER_DSL_RIG_HPP_
#define MB4_TESTS_DRIVER_DSL_RIG_HPP_

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dsl/device.hpp"
#include "dsl/messages.hpp"
#include "dsl/resources.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"

namespace mb4test {

inline constexpr mb4::sim::Time kDslFrame = 11'520'000;  // ps
inline constexpr unsigned kDslBits = 30;

// An access that goes wrong. Accesses count from 0, reads alone for a flip.
struct BusFault {
  std::optional<std::uint64_t> fails;  // this access
  std::optional<std::uint64_t> flips;  // this read, in this bit
  std::optional<std::uint32_t> hole;   // no read of this offset is answered
  unsigned bit = 0;
};

// Bus and clock.
class DslBus {
 public:
  // `slave`: more keys of the encoder; `master`: more tables.
  explicit DslBus(const std::string& slave = "", const std::string& master = "")
      : simulator_(
            mb4::sim::parse_scenario(
                "[master]\ntype = \"dsl\"\n" + master +
                    "[[channel]]\nnumber = 1\ncable_m = 30.0\n"
                    "[[channel.slave]]\nprotocol = \"dsl\"\nposition_bits = 30\nsigned = true\n" +
                    slave,
                "test"),
            {}),
        bus_(simulator_.word_bus()) {
    encoder().set_motion(motion, this);
  }

  // ---- port and clock ----
  bool read(std::uint32_t offset, std::uint32_t& word) {
    if (fault.fails == accesses_++) return false;
    EXPECT_EQ(offset % 4, 0U);
    if (fault.hole == offset) return false;
    if (bus_->read(offset, word) != std::uint8_t{0}) return false;
    if (fault.flips == reads_++) word ^= std::uint32_t{1} << fault.bit;
    return true;
  }
  bool write(std::uint32_t offset, std::uint8_t byte) {
    if (fault.fails == accesses_++) return false;
    const mb4::sim::ByteWrite one(offset, byte);
    return bus_->write(one.address, one.data, one.strobe) == std::uint8_t{0};
  }
  std::uint32_t now_us() const {
    return clock_stands ? 7 : static_cast<std::uint32_t>(simulator_.now() / mb4::sim::kPsPerUs);
  }

  // ---- what a test does ----
  void frames(unsigned count) { simulator_.advance(count * kDslFrame); }
  mb4::sim::DslSlave& encoder() { return dynamic_cast<mb4::sim::DslSlave&>(*simulator_.slave(1)); }
  void set_fault(const mb4::sim::SlaveFault& kind, bool on = true) {
    encoder().set_fault(kind, on);
  }
  mb4::sim::Simulator& simulator() { return simulator_; }
  // The bus fault from the next access on.
  void arm(const BusFault& next) {
    fault = next;
    accesses_ = reads_ = 0;
  }
  std::uint64_t accesses() const { return accesses_; }
  std::uint64_t reads() const { return reads_; }

  // The encoder was there, at one of its last `last` samples.
  bool was_at(std::int64_t position, std::size_t last) const {
    const std::size_t from = truth.size() > last ? truth.size() - last : 0;
    return std::find(truth.begin() + static_cast<std::ptrdiff_t>(from), truth.end(), position) !=
           truth.end();
  }

  std::vector<std::int64_t> truth;  // positions of the samples, signed
  BusFault fault;
  bool clock_stands = false;

 private:
  // A motor that speeds up and slows down, through 0. No position comes twice in a short time.
  static std::uint64_t motion(void* context) {
    auto& self = *static_cast<DslBus*>(context);
    self.speed_ += self.truth.size() / 64 % 2 == 0 ? 3 : -3;
    self.position_ += self.speed_;
    self.truth.push_back(self.position_);
    return static_cast<std::uint64_t>(self.position_) & ((std::uint64_t{1} << kDslBits) - 1);
  }

  mb4::sim::Simulator simulator_;
  mb4::sim::WordHost* bus_;
  std::uint64_t accesses_ = 0;
  std::uint64_t reads_ = 0;
  std::int64_t position_ = -2000;
  std::int64_t speed_ = 101;
};

class DslRig : public DslBus {
 public:
  using DslBus::DslBus;

  void link() {
    ASSERT_TRUE(device.start());
    const auto found = device.wait_for_link(*this, 5000);
    ASSERT_TRUE(found) << static_cast<int>(found.error());
  }

  dsl::Device<DslBus> device{*this};
  dsl::Messages<DslBus, DslBus> messages{device, *this};
  dsl::Messages<DslBus, DslBus> of_safe_host{device, *this, dsl::Host::kSafe};
};

}  // namespace mb4test

#endif  // MB4_TESTS_DRIVER_DSL_RIG_HPP_
