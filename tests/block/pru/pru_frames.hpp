// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of pru_core by its trigger pin, without a judge.
#ifndef TESTS_BLOCK_PRU_PRU_FRAMES_HPP_
#define TESTS_BLOCK_PRU_PRU_FRAMES_HPP_

#include <cstdint>
#include <string>

#include "tests/block/pru/pru_bench.hpp"

namespace mb4test {

namespace prureg = biss_pru::regs;

template <typename Bench>
struct PruFrames {
  static constexpr unsigned kBits = 12;
  static constexpr unsigned kTail = 8;

  explicit PruFrames(unsigned quirks = 1) : bench(quirks) { set_rate(1); }

  // Lines are in parts of T_MA.
  void set_rate(unsigned mhz) {
    rate = mhz;
    bench.encoder.timeout = static_cast<std::uint64_t>(period() * 3 / 2);
  }
  Time period() const { return 1'000'000 / rate; }
  void send(std::uint64_t position) {
    const std::string word = bits_of(position, kBits) + "11";
    bench.encoder.payload = "0" + word + bits_of(~crc_of(word, 0x43), 6);
  }
  // RUN, and its frame at 1 MHz. `mhz` counts from the next one on.
  void start(unsigned mhz) {
    bench.write(prureg::kAddrIrqEnable, 1);
    bench.write(prureg::kAddrTriggerPeriod, 0);
    bench.write(prureg::kAddrOverhead, 0);
    bench.write(prureg::kAddrLengths, kBits | kTail << 8U | mhz << 16U);
    bench.write(prureg::kAddrRun, 1);
    wait();
    set_rate(mhz);
  }
  void frame() {
    bench.m.trigger_i = 1;
    wait();
    bench.m.trigger_i = 0;
    bench.clocks(4);
  }
  std::uint64_t position() { return bench.read(prureg::kAddrPosLo); }
  std::uint32_t flags() { return bench.read(prureg::kAddrStatus) >> 16U; }

  Bench bench;
  unsigned rate = 1;  // MHz

 private:
  // Up to the end of a frame, and of the encoder's timeout.
  void wait() {
    for (unsigned i = 0; i < 200'000 && bench.m.irq_o == 0; ++i) bench.clock();
    ASSERT_EQ(bench.m.irq_o, 1) << "no end of a frame";
    bench.write(prureg::kAddrIrqStatus, 0x1F);
    for (unsigned i = 0; i < 20'000 && bench.encoder.in_frame; ++i) bench.clock();
    bench.clocks(static_cast<std::uint64_t>((bench.delay + period() / 2) / Bench::kClock) + 10);
    bench.ma.forget(bench.now);
    bench.sl.forget(bench.now);
  }
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_PRU_PRU_FRAMES_HPP_
