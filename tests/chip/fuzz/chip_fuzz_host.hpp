// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host of a fuzzed chip: everything it does can be repeated by `mb4sim spi`. It remembers what
// it has written, and what was configured at any time since the chip was last at rest: a frame or
// an access may have started with any of it.
#ifndef TESTS_CHIP_FUZZ_CHIP_FUZZ_HOST_HPP_
#define TESTS_CHIP_FUZZ_CHIP_FUZZ_HOST_HPP_

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "tests/chip/fuzz/chip_fuzz_chip.hpp"
#include "tests/support/session.hpp"

namespace mb4test {

// Of 0xF5 (Tables 50 to 53).
inline constexpr unsigned kForceBits =
    reg::MAVO::kMask | reg::MAFO::kMask | reg::MAVS::kMask | reg::MAFS::kMask;
inline constexpr unsigned kMaForced = reg::MAFS::kMask | reg::MAFO::kMask;

inline bool is_control(unsigned instruction) {
  return (instruction & reg::INSTR::kMask) == reg::kInstrControl ||
         (instruction & reg::INSTR::kMask) == reg::kInstrControlReduced;
}
inline bool is_agsinfinite(unsigned freqags) { return freqags >= 0x7D && freqags <= 0x7F; }

// What a frame or an access that runs may have been started with.
struct Possible {
  unsigned ma_clocks = 0;       // longest period of MA, system clocks
  unsigned frame_periods = 0;   // longest frame, periods of MA
  std::uint64_t limit = 0;      // longest limit of a slave's start bit (Table 58), system clocks
  unsigned bytes = 0;           // of an access
  std::array<bool, 2> used{};   // lines
  std::array<bool, 2> biss{};   // lines of BiSS B or C
  bool biss_b_control = false;  // REGVERS = 0
  bool control_asked = false;   // INSTR = 100, 111 or INIT
  bool agsmin = false;
  bool paired = false;  // CFGIF = 10, 11: line 2 sees SL = 1
  bool ma_forced = false;
  bool ma_may_rest = false;      // EN_MO with an actuator: MA does not go on after the frame
  std::uint64_t ags_period = 0;  // system clocks
};

class FuzzHost {
 public:
  FuzzHost(const FuzzChip& chip, const std::filesystem::path& folder);

  // --- as a line of the script ----------------------------------------------------------------
  void write(unsigned address, const std::vector<std::uint8_t>& bytes);
  std::vector<std::uint8_t> read(unsigned address, std::size_t count) {
    return session_.read(static_cast<std::uint8_t>(address), count);
  }
  // 0xF0 to 0xF4.
  std::array<std::uint8_t, 5> status();
  // 0xF4 by its own opcode.
  void instruct(unsigned byte);
  // The same as two bus cycles as close as the datasheet allows; SPI: two frames.
  void instruct_twice(unsigned first, unsigned second);
  void wait_ns(std::uint64_t ns) { session_.wait_ns(ns); }
  void pin(mb4::sim::Pin pin, const char* name, bool level) { session_.pin(pin, name, level); }
  void reset(std::uint64_t low_ns);

  // Lets `clocks` system clocks pass; false if the clock stands still meanwhile.
  bool wait_clocks(std::uint64_t clocks);
  std::uint64_t clocks() { return simulator().clk_cycles(); }
  std::uint64_t clock_ns() const { return clock_ns_; }  // a clock period, the longest

  unsigned written(unsigned address) const { return image_[address]; }
  // 0xF4 as it should stand without INSTR, INIT and AGS.
  unsigned banks() const {
    return image_[reg::kAddrInstr] & (reg::SWBANK::kMask | reg::HOLDBANK::kMask);
  }
  bool line_used(unsigned line) const;
  mb4test::Protocol protocol(unsigned line) const;
  // INSTR = 100 or 111 would find a line that fits (decision 37).
  bool access_can_run() const;

  const Possible& possible() const { return possible_; }
  // The chip is at rest: only what is configured now counts.
  void at_rest();
  // An access was asked for, and neither BREAK, INIT nor a reset came after it.
  bool access_open() const { return access_open_; }
  void access_ended() { access_open_ = false; }
  // The access began at rest, and nothing was written to a register of configuration after it.
  bool access_clean() const { return access_clean_; }

  Session& session() { return session_; }
  mb4::sim::Simulator& simulator() { return session_.simulator(); }

 private:
  void took(unsigned address, std::uint8_t value);
  void note_configuration();
  void bus_write(std::uint8_t address, std::uint8_t value);
  void bus_data(unsigned value);

  const FuzzChip& chip_;
  Session session_;
  RegisterImage image_{};
  Possible possible_;
  std::uint64_t clock_ns_;
  bool access_open_ = false;
  bool access_clean_ = false;
  bool lost_with_init_ = false;  // an access was open when INIT was written
  std::uint64_t init_clock_ = 0;
  bool rest_ = true;  // nothing was asked for since at_rest()
};

}  // namespace mb4test

#endif  // TESTS_CHIP_FUZZ_CHIP_FUZZ_HOST_HPP_
