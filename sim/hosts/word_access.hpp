// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A manager of a bus of words inside a Verilated model, and the host in front of it, which lets
// time pass until an access has its answer.
#ifndef MB4SIM_WORD_ACCESS_HPP_
#define MB4SIM_WORD_ACCESS_HPP_

#include <cstdint>
#include <optional>

#include "sim/core/time.hpp"
#include "sim/hosts/host_pins.hpp"
#include "sim/hosts/word_host.hpp"

namespace mb4::sim {

// An access that runs or has ended.
struct WordAccess {
  bool write = false;
  std::uint32_t address = 0;
  std::uint32_t data = 0;   // written, or read
  std::uint8_t strobe = 0;  // write
  std::uint8_t answer = 0;  // 0: a good one
  bool done = true;
};

// The side of the model.
class WordManager {
 public:
  // Begins an access: it is on the pins after the next clock edge at the latest. Only one runs.
  virtual void begin(const WordAccess& access) = 0;
  virtual const WordAccess& access() const = 0;
  // Ends an access that has no answer. If the master has taken it, its late answer is dropped.
  virtual void give_up() = 0;

 protected:
  ~WordManager() = default;
};

// Waits for an answer `most_clocks` clocks of `period`.
class PollingWordHost : public WordHost {
 public:
  PollingWordHost(HostPins& outside, WordManager& manager, Time period, unsigned most_clocks,
                  std::uint32_t last_address)
      : outside_(outside),
        manager_(manager),
        period_(period),
        most_clocks_(most_clocks),
        last_address_(last_address) {}

  std::optional<std::uint8_t> write(std::uint32_t address, std::uint32_t data,
                                    std::uint8_t strobe) override {
    return run({.write = true, .address = address, .data = data, .strobe = strobe, .done = false});
  }
  std::optional<std::uint8_t> read(std::uint32_t address, std::uint32_t& data) override {
    const auto answer = run({.address = address, .done = false});
    data = answer ? manager_.access().data : 0;
    return answer;
  }
  std::uint32_t last_address() const override { return last_address_; }

 private:
  std::optional<std::uint8_t> run(const WordAccess& access) {
    manager_.begin(access);
    for (unsigned clock = 0; clock < most_clocks_ && !manager_.access().done; ++clock) {
      outside_.run_until(outside_.now() + period_);
    }
    if (manager_.access().done) return manager_.access().answer;
    manager_.give_up();
    return std::nullopt;
  }

  HostPins& outside_;
  WordManager& manager_;
  Time period_;
  unsigned most_clocks_;
  std::uint32_t last_address_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_WORD_ACCESS_HPP_
