// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs a random case on the chip, action by action, and compares what the host sees with the
// reference after each of them.
#ifndef TESTS_CHIP_RANDOM_RANDOM_RUN_HPP_
#define TESTS_CHIP_RANDOM_RANDOM_RUN_HPP_

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/reference/reference.hpp"
#include "tests/support/random_case.hpp"
#include "tests/support/session.hpp"

namespace mb4test {

// The chip differs from the reference.
class Difference : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RandomCounts {
  std::uint64_t frames = 0;
  std::uint64_t words = 0;
  std::uint64_t faulty_words = 0;  // with a CRC
  std::uint64_t undetected = 0;
  enum Action { kInstr, kRate, kAgsMin, kGetsens, kHold, kAgsHold, kSwBank, kWrite, kSvalid };
  std::array<std::uint64_t, 9> actions{};
};

class RandomRun {
 public:
  RandomRun(const RandomCase& random_case, Random& random, const std::filesystem::path& folder)
      : case_(random_case), random_(random), session_(random_case.scenario, folder) {}

  // Throws Difference at the first one.
  void run(RandomCounts& counts);
  Session& session() { return session_; }

 private:
  void configure();
  void written(unsigned address, std::uint8_t value);
  void fill_bank();
  void instr_frame(unsigned hold);
  void automatic(RandomCounts::Action action);
  void held_frame();
  void held_automatic();
  void toggle_swbank();
  void write_scdata();
  void write_svalid();
  void break_if_error();

  void expect(bool good, const std::string& what);
  void check();
  void check_actuators();
  void set_freqags(unsigned code);
  // EOT = 1, all slaves have timed out and SL = 1 on the lines in use.
  void wait_idle();
  void take_frames(std::uint64_t up_to);
  void count_faults(std::uint64_t frame);
  std::uint64_t frames_seen();
  unsigned rate_code() const;
  std::uint64_t period_ns(unsigned code) const;
  void pulse_getsens();

  const RandomCase& case_;
  Random& random_;
  Session session_;
  mb4test::Reference reference_;
  RandomCounts counts_;
  std::uint64_t applied_ = 0;      // frames that the reference has seen
  std::uint64_t frame_ns_ = 0;     // of one frame with its timeout
  unsigned swbank_ = 0;            // bit of 0xF4 as written last
  std::array<std::string, 2> mo_;  // bits that the last frame had to send
};

}  // namespace mb4test

#endif  // TESTS_CHIP_RANDOM_RANDOM_RUN_HPP_
