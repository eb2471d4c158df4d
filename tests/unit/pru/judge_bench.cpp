// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/unit/pru/judge_bench.hpp"

#include <algorithm>
#include <vector>

namespace pru_judge_test {

using namespace pru_judge;

std::string binary(std::uint64_t value, unsigned bits) {
  std::string text;
  for (unsigned bit = bits; bit-- > 0;) text += (value >> bit & 1U) != 0 ? '1' : '0';
  return text;
}

std::string crc6(const std::string& bits) {
  unsigned state = 0;
  for (const char bit : bits) {
    const unsigned out = (state >> 5 & 1U) ^ (bit == '1' ? 1U : 0U);
    state = (state << 1 & 0x3FU) ^ (out != 0 ? 0x03U : 0U);
  }
  return binary(~state & 0x3FU, 6);
}

// The table of nibbles stands in the protocol's facts.
unsigned crc4(unsigned data, unsigned bits) {
  constexpr unsigned kTable[16] = {0x0, 0x3, 0x6, 0x5, 0xC, 0xF, 0xA, 0x9,
                                   0xB, 0x8, 0xD, 0xE, 0x7, 0x4, 0x1, 0x2};
  unsigned state = 0;
  for (unsigned shift = (bits + 3) / 4 * 4; shift > 0; shift -= 4) {
    state = kTable[state ^ (data >> (shift - 4) & 0xFU)];
  }
  return ~state & 0xFU;
}

std::string word(std::uint64_t position, unsigned bits, const std::string& signals) {
  const std::string data = binary(position, bits) + signals;
  return data + crc6(data);
}

Bench::Bench(const JudgeSetup& setup) : judge(setup), setup_(setup) {}

void Bench::start(unsigned position_bits, unsigned check_bits, unsigned mhz) {
  judge.write(kDataLength, position_bits | check_bits << 8 | mhz << 16);
  judge.write(kRun, 0);
  judge.write(kRun, 1);
}

unsigned Bench::right_edges(unsigned zeros) const {
  return 5 + judge.position_bits() + judge.check_bits() + zeros;
}

Time Bench::clock(unsigned rising_edges) {
  const Time half = period() / 2;
  const bool cdm = judge.control().cdm();
  Trace ma(ma_rests_);
  Time at = now_ + kUs;
  ma.edge(at, true);
  at += half;
  const Time first = at + half;
  ma.edge(at, false);
  for (unsigned i = 0; i < rising_edges; ++i) {
    ma.edge(at += half, true);
    if (i + 1 < rising_edges || cdm) ma.edge(at += half, false);
    // The last rising edge is not sent with CDM = 1.
    if (cdm && i + 2 == rising_edges) break;
  }
  if (spoil) spoil(ma);
  spoil = nullptr;
  for (const Edge& edge : ma.within(0, at + kUs)) ma_.edge(edge.at, edge.level);
  ma_rests_ = ma_.from(at + kUs);
  return first;
}

FrameReport Bench::report(Time start) {
  // Later than the last sample of each frame of these tests.
  now_ = start + 1000 * kUs;
  const FrameReport report = judge.frame({start, start + 990 * kUs, ma_, sl_, std::nullopt});
  ma_.forget(start);
  sl_.forget(start);
  return report;
}

FrameReport Bench::frame(const Answer& answer) {
  const Time start = now_;
  const Time length = period();
  const Time first =
      clock(ma_edges.value_or(answer.acknowledges ? right_edges(answer.zeros) : right_edges(0)));
  ma_edges.reset();
  if (!answer.acknowledges) return report(start);
  // Each bit with the rising edge of its number; the stop bit at last, up to the timeout.
  const std::string bits =
      "0" + std::string(answer.zeros, '0') + "1" + (answer.cds ? "1" : "0") + answer.bits + "0";
  Time last = 0;
  for (unsigned i = 0; i < bits.size(); ++i) {
    const Time at = first + (i + 1) * length + delay + (jitter ? jitter() : 0);
    last = std::max(last, at);
    sl_.edge(last, bits[i] == '1');
  }
  sl_.edge(start + 980 * kUs, sl_rest);
  return report(start);
}

FrameReport Bench::frame_without_ma() {
  const Time start = now_;
  sl_.edge(start - kUs, false);
  const FrameReport seen = report(start);
  sl_.edge(start + 991 * kUs, sl_rest);
  return seen;
}

FrameReport Bench::frame_of_samples(unsigned zeros, const std::string& samples) {
  const Time start = now_;
  const Time length = period();
  const Time second = clock(right_edges(zeros)) + length;
  const Time clock_ps = 1'000'000'000'000 / setup_.clock_hz;
  const Time clocks = length / clock_ps;
  for (unsigned i = 0; i < samples.size(); ++i) {
    // A clock before the sample, which is i / 8 periods and a part later (R-P6).
    const Time whole = i / 8 * clocks + (i % 8 + 1) * clocks / 8;
    sl_.edge(second + (whole - 1) * clock_ps, samples[i] == '1');
  }
  sl_.edge(start + 980 * kUs, true);
  return report(start);
}

}  // namespace pru_judge_test
