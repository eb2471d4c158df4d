// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Slaves on a hand-written MA waveform: no chip, no RTL.
#ifndef TESTS_UNIT_LINES_CHAIN_BENCH_HPP_
#define TESTS_UNIT_LINES_CHAIN_BENCH_HPP_

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/event_queue.hpp"
#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/clocked/slave_chain.hpp"

namespace mb4test {

using namespace mb4::sim;

class ChainBench {
 public:
  using Edges = std::vector<std::pair<Time, bool>>;

  ChainBench() : chain(queue, &ChainBench::record, this) {}

  BissCSlave& add(const BissCSlaveConfig& config) { return put<BissCSlave>(config, 1); }
  // A slave of any kind from what its constructor takes.
  template <typename Kind, typename... Arguments>
  Kind& put(const Arguments&... arguments) {
    auto slave = std::make_unique<Kind>(arguments...);
    Kind& reference = *slave;
    chain.add(std::move(slave));
    return reference;
  }

  // Lets everything up to and including `time` happen.
  void run_until(Time time) {
    while (queue.next_time() <= time) queue.run_next();
    now = time;
  }
  // The short way of shift() where the chain allows it, as a line does.
  void ma(Time time, bool level) {
    run_until(time);
    if (!chain.shifting() || level == chain.ma() || mo != chain.mo()) {
      chain.drive(time, level, mo);
      return;
    }
    const bool before = chain.slo();
    if (chain.shift(time, level, mo) != before) record(time, this, !before);
  }
  // One frame from time `start`: first falling edge there, then `rising` rising edges with 50 %
  // duty; MA rests high, or low after one more falling edge.
  // Returns SLO in the middle of each bit: just before the falling edge after rising edge 1, 2, ...
  std::string frame(Time start, Time period, unsigned rising, bool rest = true) {
    std::string bits;
    ma(start, false);
    for (unsigned i = 0; i < rising; ++i) {
      ma(start + i * period + period / 2, true);
      const Time falling = start + (i + 1) * period;
      run_until(falling - 1);
      bits += chain.slo() ? '1' : '0';
      if (i + 1 < rising || !rest) ma(falling, false);
    }
    return bits;
  }

  EventQueue queue;
  SlaveChain chain;
  Edges slo;  // every change of SLO of slave 1
  Time now = 0;
  bool mo = false;

 private:
  static void record(Time time, void* receiver, bool level) {
    static_cast<ChainBench*>(receiver)->slo.emplace_back(time, level);
  }
};

// The low `bits` bits of `value`, MSB first, as '0' and '1'.
inline std::string binary(std::uint64_t value, unsigned bits) {
  std::string text;
  for (unsigned i = bits; i-- > 0;) text += ((value >> i) & 1U) != 0 ? '1' : '0';
  return text;
}

inline BissCSlaveConfig constant_slave(unsigned data_bits, std::uint64_t word,
                                       std::uint32_t polynomial) {
  BissCSlaveConfig config;
  config.data_bits = data_bits;
  config.crc = Crc{polynomial, 0};
  config.source.constant = word;
  return config;
}

}  // namespace mb4test

#endif  // TESTS_UNIT_LINES_CHAIN_BENCH_HPP_
