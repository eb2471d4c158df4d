// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A chip that is driven only in ways that `mb4sim spi` can repeat, and the files to repeat it with.
#ifndef TESTS_SUPPORT_SESSION_HPP_
#define TESTS_SUPPORT_SESSION_HPP_

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "masters/mb4/sim_bus.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/test_host.hpp"
#include "tests/support/wave.hpp"

namespace mb4test {

// A scenario whose slaves send listed words, one a frame: `words` by SCDATAx (1..8).
struct WordScenario {
  std::string text;      // each slave with the line that word_file() gives
  bool any_host = true;  // MB4_HOST chooses the host; false: `text` names it
  std::vector<std::pair<unsigned, std::vector<std::uint64_t>>> words;

  static std::string word_file(unsigned slave) {
    return "slave" + std::to_string(slave) + ".words";
  }
  static std::string source_keys(unsigned slave) {
    return "source = \"file\"\nrepeat = false\nfile = \"" + word_file(slave) + "\"\n";
  }
};

class Session {
 public:
  // Writes scenario and word files into `folder` and loads them from there.
  Session(const WordScenario& scenario, const std::filesystem::path& folder,
          const mb4::sim::SimulatorOptions& options = {})
      : folder_(folder), simulator_(load(scenario, folder), with_wave(options)) {}

  // --- what a line of the script can do -------------------------------------------------------
  std::vector<std::uint8_t> spi(const std::vector<std::uint8_t>& tx) {
    std::vector<std::uint8_t> rx(tx.size());
    bus_.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
    script_ << hex(tx) << "\n";
    answers_ += hex(rx) + "\n";
    return rx;
  }
  void wait_ns(std::uint64_t ns) {
    simulator_.advance(ns * mb4::sim::kPsPerNs);
    script_ << "+" << ns << "\n";
  }
  void pin(mb4::sim::Pin pin, const char* name, bool level) {
    simulator_.set_pin(pin, level);
    script_ << "pin " << name << " " << level << "\n";
  }
  // Waits; `see` is called after every event and every change of an output.
  void watch_ns(std::uint64_t ns, const std::function<void()>& see) {
    const mb4::sim::Time end = simulator_.now() + ns * mb4::sim::kPsPerNs;
    simulator_.run_while_waiting(
        [&] {
          see();
          return false;
        },
        end);
    script_ << "+" << ns << "\n";
  }
  void comment(const std::string& text) { script_ << "# " << text << "\n"; }

  // --- the same, put together -----------------------------------------------------------------
  void write(std::uint8_t address, const std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters, address};
    tx.insert(tx.end(), bytes.begin(), bytes.end());
    spi(tx);
  }
  std::vector<std::uint8_t> read(std::uint8_t address, std::size_t count) {
    std::vector<std::uint8_t> tx(count + 2);
    tx[0] = reg::kSpiOpcodeReadRegisters;
    tx[1] = address;
    const auto rx = spi(tx);
    return {rx.begin() + 2, rx.end()};
  }
  void instruct(unsigned byte) {
    spi({reg::kSpiOpcodeWriteInstruction, static_cast<std::uint8_t>(byte)});
  }
  // Waits in steps until `done()`; false after `limit_ns`.
  template <typename Done>
  bool wait_until(Done done, std::uint64_t limit_ns, std::uint64_t step_ns = 500) {
    std::uint64_t waited = 0;
    while (!done() && waited < limit_ns) {
      simulator_.advance(step_ns * mb4::sim::kPsPerNs);
      waited += step_ns;
    }
    if (waited != 0) script_ << "+" << waited << "\n";
    return done();
  }

  mb4::sim::Simulator& simulator() { return simulator_; }
  const std::string& answers() const { return answers_; }
  std::string script() const { return script_.str(); }
  // Writes frames.spi and answers.txt beside the scenario; returns the command that repeats it.
  std::string save() const {
    std::ofstream(folder_ / "frames.spi") << script_.str();
    std::ofstream(folder_ / "answers.txt") << answers_;
    return "mb4sim spi " + (folder_ / "scenario.toml").string() + " < " +
           (folder_ / "frames.spi").string();
  }

 private:
  static mb4::sim::Scenario load(const WordScenario& scenario,
                                 const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const auto& [slave, words] : scenario.words) {
      std::ofstream file(folder / WordScenario::word_file(slave));
      for (const std::uint64_t word : words) file << "0x" << std::hex << word << "\n";
    }
    const auto path = folder / "scenario.toml";
    std::ofstream(path) << (scenario.any_host ? with_test_host(scenario.text) : scenario.text);
    return mb4::sim::load_scenario(path.string());
  }
  static std::string hex(const std::vector<std::uint8_t>& bytes) {
    static const char* const kDigits = "0123456789ABCDEF";
    std::string text;
    for (const std::uint8_t byte : bytes) {
      if (!text.empty()) text += ' ';
      text += kDigits[byte >> 4U];
      text += kDigits[byte & 15U];
    }
    return text;
  }

  std::filesystem::path folder_;
  mb4::sim::Simulator simulator_;
  mb4::tool::SimBus bus_{simulator_};
  std::ostringstream script_;
  std::string answers_;
};

}  // namespace mb4test

#endif  // TESTS_SUPPORT_SESSION_HPP_
