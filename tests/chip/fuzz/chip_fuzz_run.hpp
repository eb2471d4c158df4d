// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One session of the fuzz of the whole chip: random phases of host, pins and lines. After each
// phase it checks that everything ends. At the end it checks the recovery.
#ifndef TESTS_CHIP_FUZZ_CHIP_FUZZ_RUN_HPP_
#define TESTS_CHIP_FUZZ_CHIP_FUZZ_RUN_HPP_

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/chip/fuzz/chip_fuzz_chip.hpp"
#include "tests/chip/fuzz/chip_fuzz_host.hpp"

namespace mb4test {

// The chip breaks a rule. `rule` is the same for all failures of one kind.
class FuzzFailure : public std::runtime_error {
 public:
  FuzzFailure(std::string rule, const std::string& what)
      : std::runtime_error(rule + ": " + what), rule_(std::move(rule)) {}
  const std::string& rule() const { return rule_; }

 private:
  std::string rule_;
};

// Counts of what the sessions have reached.
struct FuzzCounts {
  enum What {
    kOperations,
    kResets,
    kEndsAsked,          // after a phase: does everything end?
    kInstructionsEnd,    // instructions or INIT that did
    kAccessesEnd,        // control communications that did
    kAccessesCannotRun,  // decision 37
    kWaitsClock,         // CLK stands still
    kWaitsSlLow,         // decision 3
    kWaitsSlave,         // decision 4
    kWaitsHost,          // decisions 23, 42: an access with AGS = 0
    kWaitsGetsens,       // AGSINFINITE
    kWaitsHold,          // AGSERR_ON_HOLDBANK = 1
    kWaitsTooLong,       // the limit is longer than the test waits
    kBreaks,             // that ended one of these
    kWordPhases,
    kWordsRead,       // shown as valid, compared with what was sent
    kSwbankInFrame,   // SWBANK inverted while EOT = 0
    kAliases,         // the line has brought the word with its CRC
    kAliasesUnclear,  // with a CRC below 12 bits; not known because the clock has changed
    kRecoveries,
    kRecoveredWords,
    kReadBacks,    // bytes read behind their writes
    kInitsBehind,  // INIT behind a BREAK that may have cut something
    kDelaysAgain,
    kWhats
  };
  static const char* name(unsigned what);
  // True for what a few hundred sessions reach.
  static bool is_common(unsigned what);

  std::array<std::uint64_t, kWhats> total{};
  std::array<std::uint64_t, kWhats> sessions{};  // that came to it at least once
  std::uint64_t number = 0;                      // of sessions
  std::uint64_t clocks = 0;

  void add(const std::array<std::uint64_t, kWhats>& session);
};

// SL of a line as the chip has seen it.
struct LineRecord {
  std::vector<std::pair<mb4::sim::Time, bool>> edges;
  bool level_at(mb4::sim::Time time) const;
  // `bits` stood on the line, one each `period` ps.
  bool has_brought(const std::string& bits, mb4::sim::Time period) const;
};

class FuzzRun {
 public:
  FuzzRun(const FuzzChip& chip, Random& random, const std::filesystem::path& folder);
  // Throws FuzzFailure or ModelStopped.
  void run();
  FuzzHost& host() { return host_; }
  const std::array<std::uint64_t, FuzzCounts::kWhats>& counts() const { return counts_; }

 private:
  [[noreturn]] void fail(const std::string& rule, const std::string& what);
  void count(FuzzCounts::What what) { ++counts_[what]; }
  bool one_in(unsigned n) { return random_.one_in(n); }
  unsigned below(unsigned n) { return random_.below(n); }
  std::uint8_t byte() { return static_cast<std::uint8_t>(random_.word()); }

  // --- chip_fuzz_run.cpp: what a host may do ---------------------------------------------------
  void configure(bool anew = false);
  void wild_phase();
  void wild_operation();
  void random_registers();
  void random_pin();
  void short_spi_frame();
  void getsens();
  void ask_for_access();
  unsigned random_instruction();
  unsigned random_freqags();
  void random_wait();

  // --- chip_fuzz_words.cpp: words shown as valid -----------------------------------------------
  void word_phase();
  bool begin_words();
  bool word_operation();
  bool write_scdata();
  bool read_words();
  void compare_words();
  // Eight bytes of SCDATA.
  void compare_word(unsigned line, const FuzzSlave& slave, const std::vector<std::uint8_t>& data);

  // --- chip_fuzz_end.cpp: everything ends, and the chip recovers -------------------------------
  void check_end();
  void check_ended();
  bool at_rest();
  enum class End { kDone, kWaits, kTooLong };
  End wait_end();
  template <typename Done>
  End wait_until(std::uint64_t bound, Done done);
  std::uint64_t frame_bound() const;
  std::uint64_t access_bound() const;
  void ensure_clock();
  void not_ended(End end);
  void classify_wait();
  bool access_ended() const;
  void check_access_ends();
  void drive_on(bool by_getsens);
  void check_cannot_run();
  void end_by_break(FuzzCounts::What wait);
  void check_read_back();
  void recover();
  bool is_good() const;
  std::array<std::uint8_t, 2> check_init();
  void check_init_behind_break();
  void wait_slaves(bool sl_high);

  const FuzzChip& chip_;
  Random& random_;
  FuzzHost host_;
  std::array<LineRecord, 2> records_;
  std::array<std::uint64_t, FuzzCounts::kWhats> counts_{};
  std::array<std::uint8_t, 5> status_{};  // 0xF0 to 0xF4 as read last
  // Word phase, by line: the bit of the data channel that is configured otherwise than its slave.
  std::array<unsigned, 2> misfit_{};
  bool clock_changed_ = false;
  std::uint64_t most_clocks_ = 0;  // a limit above it is not waited for
};

}  // namespace mb4test

#endif  // TESTS_CHIP_FUZZ_CHIP_FUZZ_RUN_HPP_
