// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A Verilated model at rest. A model is at rest if some clocks leave every bit of it as it was and
// change no output: then any multiple of them does, up to the next change of an input. For a model
// whose counters always run these are a period of the counters, else a single clock. Only counts
// that a master names may move meanwhile, such as a time since the reset; they are set forward.
//
// No part of it depends on how Verilator writes a model, but it must keep all state in its root.
#ifndef MB4SIM_MODEL_MODEL_REST_HPP_
#define MB4SIM_MODEL_MODEL_REST_HPP_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

#include "sim/model/clock_source.hpp"

namespace mb4::sim {

// Says when a look at the model is worth its cost.
class RestWatch {
 public:
  // Before a rising edge. True: the master shall look whether this clock changes anything.
  bool due() { return ++quiet_ == kLooks[looks_]; }
  // What the look has found.
  void found(bool rest) {
    quiet_ = 0;
    resting_ = rest;
    looks_ = rest ? 0 : std::min(looks_ + 1, std::size(kLooks) - 1);
  }
  // An input or an output has changed.
  void stirred() {
    quiet_ = 0;
    resting_ = false;
  }
  unsigned clocks_to_look() const { return kLooks[looks_]; }
  bool resting() const { return resting_; }
  void set_resting(bool rest) { resting_ = rest; }

  // Clocks have been left out.
  void passed(std::uint64_t clocks) { left_out_ += clocks; }
  std::uint64_t left_out() const { return left_out_; }

 private:
  // Number of clocks without a change at a pin, or since the last look, after which a look is worth
  // its cost. The first look comes soon after the end of a frame. If the model is not at rest (MA
  // of a low frequency), the looks become less frequent.
  static constexpr unsigned kLooks[] = {4, 2, 8, 16, 32, 64};

  unsigned quiet_ = 0;     // clocks since a pin changed, or since the last look
  std::size_t looks_ = 0;  // looks in a row that found no rest
  bool resting_ = false;
  std::uint64_t left_out_ = 0;
};

// The bits of a model before a clock.
template <typename Root>
class StateMark {
 public:
  void set(const Root& root) {
    before_.resize(sizeof(Root));
    std::memcpy(before_.data(), bytes(root), sizeof(Root));
  }
  template <typename Member>
  bool moved(const Root& root, const Member& member) const {
    return std::memcmp(before_.data() + place(root, member), &member, sizeof member) != 0;
  }
  // The member counts as unchanged.
  template <typename Member>
  void ignore(const Root& root, const Member& member) {
    std::memcpy(before_.data() + place(root, member), &member, sizeof member);
  }
  bool same(const Root& root) const {
    return std::memcmp(before_.data(), bytes(root), sizeof(Root)) == 0;
  }

 private:
  static const std::byte* bytes(const Root& root) {
    return reinterpret_cast<const std::byte*>(&root);
  }
  template <typename Member>
  static std::ptrdiff_t place(const Root& root, const Member& member) {
    return reinterpret_cast<const std::byte*>(&member) - bytes(root);
  }

  std::vector<std::byte> before_;
};

// For a model with one clock, of which whole clocks are left out after a falling edge.
//   Counts::period(root)        clocks after which its counters are where they were; at least 1
//   Counts::each(root, f)       calls f(member) for each variable that may move
//   Counts::left(root)          clocks in which these do nothing but count
//   Counts::pass(root, clocks)  sets them forward. What depends on them follows with the next edge,
//                               so `left` ends some clocks before they have an effect
template <typename Root, typename Counts>
class ModelRest {
 public:
  // `never`: no clock is left out.
  explicit ModelRest(bool never) : never_(never) { wait(); }

  // An input or an output has changed.
  void stirred() {
    quiet_ = 0;
    if (active_) rouse();
  }
  // After each falling edge. Leaves out clocks up to `limit`, and returns their number. Most calls
  // only count.
  std::uint64_t falls(Root& root, ClockSource& clock, Time limit) {
    if (++quiet_ < due_) [[likely]]
      return 0;
    return look(root, clock, limit);
  }
  std::uint64_t left_out() const { return watch_.left_out(); }

 private:
  [[gnu::noinline]] std::uint64_t look(Root& root, ClockSource& clock, Time limit) {
    if (!active_) {  // a look begins
      active_ = true;
      quiet_ = 0;
      due_ = period_ = Counts::period(root);
      mark_.set(root);
      return 0;
    }
    if (!watch_.resting()) {  // it ends
      Counts::each(root, [&](const auto& member) { mark_.ignore(root, member); });
      watch_.found(mark_.same(root));
      if (!watch_.resting()) {
        wait();
        return 0;
      }
      due_ = 0;
    }
    const std::uint64_t left = Counts::left(root);
    if (left < period_) {
      rouse();
      return 0;
    }
    std::uint64_t clocks = std::min(left, clock.whole_periods(limit));
    clocks -= clocks % period_;
    if (clocks == 0) return 0;
    Counts::pass(root, clocks);
    clock.skip(clocks);
    watch_.passed(clocks);
    return clocks;
  }
  [[gnu::noinline]] void rouse() {
    watch_.stirred();
    wait();
  }
  void wait() {
    active_ = false;
    quiet_ = 0;
    due_ = never_ ? ~std::uint64_t{0} : watch_.clocks_to_look();
  }

  RestWatch watch_;
  StateMark<Root> mark_;
  std::uint64_t quiet_ = 0;  // clocks since a pin changed, or since the last look began or ended
  std::uint64_t due_ = 0;
  std::uint64_t period_ = 1;
  bool never_;
  bool active_ = false;  // a look runs, or the model is at rest
};

// Counts of a model of which no clock is left out.
struct NoCounts {
  template <typename Root, typename Each>
  static void each(const Root& /*root*/, Each /*each*/) {}
  template <typename Root>
  static std::uint64_t period(const Root& /*root*/) {
    return 1;
  }
  template <typename Root>
  static std::uint64_t left(const Root& /*root*/) {
    return 0;
  }
  template <typename Root>
  static void pass(Root& /*root*/, std::uint64_t /*clocks*/) {}
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_MODEL_REST_HPP_
