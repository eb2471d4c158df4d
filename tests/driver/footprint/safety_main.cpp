// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Checks three frames of BiSS Safety in QEMU (26 bits of position in both words) and hands the
// verdicts on. cycles.py counts each call of a function measured_...(). Ends through semihosting:
// 0x18 with 0x20026 is success.

#include "enc/snapshot.hpp"
#include "mb4/safety.hpp"

namespace {

using Latest = enc::Snapshot<mb4::SafetyVerdict>;

// All calls that are counted; not inlined.
[[gnu::noinline]] mb4::SafetyVerdict measured_check(mb4::Safety& safety,
                                                    const mb4::SafetySample& sample) {
  return safety.check(sample);
}
[[gnu::noinline]] void measured_write(Latest& latest, const mb4::SafetyVerdict& verdict) {
  latest.write(verdict);
}
[[gnu::noinline]] bool measured_read(const Latest& latest, mb4::SafetyVerdict& verdict) {
  return latest.try_read(verdict);
}

mb4::SafetySample sample_of(const mb4::SafetyConfig& words, std::uint64_t position, unsigned life) {
  const auto word = [](const mb4::SafetyWord& one, std::uint64_t data) {
    return mb4::SafetyWordRead{data,
                               enc::crc(one.crc_polynomial, one.crc_start, data, one.data_bits),
                               mb4::SafetyWordRead::State::kHere};
  };
  return {word(words.control, position << 2U | 3U),
          word(words.safety, position << 8U | 0xC0U | life), true};
}

Latest latest;
mb4::Safety safety;

bool run_all() {
  const mb4::SafetyConfig words = mb4::bp3_safety(26, 26, 0x2A, 0x1234);
  bool good = safety.configure(words) == mb4::SafetyField::kNone;
  for (unsigned frame = 0; frame < 3; ++frame) {
    const mb4::SafetySample sample = sample_of(words, 0x2ABCDEF, frame);
    measured_write(latest, measured_check(safety, sample));
    mb4::SafetyVerdict verdict;
    good = measured_read(latest, verdict) && good;
    good = good && verdict.ok() == (frame != 0) && verdict.position == 0x2ABCDEF &&
           verdict.life == frame;
  }
  return good;
}

}  // namespace

extern "C" {

extern std::uint32_t stack_top;

[[noreturn]] void reset() {
  const bool good = run_all();
  register std::uint32_t operation asm("r0") = 0x18;
  register std::uint32_t reason asm("r1") = good ? 0x20026 : 0x20023;
  asm volatile("bkpt 0xAB" : : "r"(operation), "r"(reason));
  for (;;) {
  }
}

using Handler = void (*)();
struct Vectors {
  std::uint32_t* stack;
  Handler reset;
};
extern const Vectors vectors;
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors{&stack_top, reset};

}  // extern "C"
