// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of the master and the encoder on a duplex line, without a scenario, and what a test
// wants to see of each frame.
#ifndef MB4_TESTS_UNIT_DSL_BENCH_HPP_
#define MB4_TESTS_UNIT_DSL_BENCH_HPP_

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "sim/core/event_queue.hpp"
#include "sim/core/random.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"
#include "sim/lines/duplex/duplex_line.hpp"
#include "sim/lines/line_kind.hpp"
#include "sim/masters/dsl_model/link_model.hpp"

namespace mb4::sim::dsl_test {

using dsl_model::Link;
using dsl_model::LinkFrame;
using dsl_model::LinkModel;
using dsl_model::LinkRules;
using dsl_model::LinkState;
using dsl_model::Restart;

inline constexpr std::uint64_t kClock = 75'000'000;
inline constexpr Time kFrameTime = 11'520 * kPsPerNs;
inline constexpr double kPsPerMetre = 5300;  // one way
constexpr Time kBits(unsigned count) { return count * Time{320'000} / 3; }

// Frames of a long test: 20,000 in the suite, as many as the nightly run says.
inline std::uint64_t long_run() {
  const char* text = std::getenv("MB4_DSL_FRAMES");
  return text == nullptr ? 20'000 : std::strtoull(text, nullptr, 10);
}

struct BenchSetup {
  LinkRules rules;
  DslSlaveConfig encoder;
  DuplexConfig cable;
  std::uint64_t hz = kClock;
  std::uint64_t seed = 1;
  Time start = kPsPerUs;

  BenchSetup() {
    cable.enable = 30 * kPsPerNs;
    cable.disable = 40 * kPsPerNs;
  }
  BenchSetup& metres(double length) {
    cable.delay = 2 * static_cast<Time>(length * kPsPerMetre);
    return *this;
  }
};

class Bench final : public LineMaster, public dsl_model::LinkListener {
 public:
  explicit Bench(const BenchSetup& setup)
      : model_(setup.rules, setup.hz, setup.start),
        cable_(setup.cable),
        late_(late(setup)),
        line_({queue_, cable_, {}, setup.seed, *this, 0}) {
    clock_ = &model_;
    auto encoder = std::make_unique<DslSlave>(setup.encoder);
    encoder_ = encoder.get();
    line_.add(std::move(encoder));
    model_.link().set_listener(this);
  }

  // Two drivers are never on for longer than one needs to come on, whatever a test does. An answer
  // that ends late meets the trailer for as long as it is late, or up to the end of the frame.
  ~Bench() {
    const DuplexContention both = line_.contention(now_);
    if (misreads) {
      EXPECT_LE(both.times, link().restarts());
      EXPECT_LE(both.longest, kBits(61) + cable_.enable);
    } else {
      EXPECT_LE(both.longest, cable_.enable + late_);
    }
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  // The encoder may take a RESET or SYNC for another symbol and answer into it, once in a start.
  bool misreads = false;

  Link& link() { return model_.link(); }
  LinkModel& model() { return model_; }
  DslSlave& encoder() { return *encoder_; }
  DuplexLine& line() { return line_; }
  Time now() const { return now_; }
  EventQueue& queue() { return queue_; }

  // Is told of every answer, in or after the training.
  std::function<void(const LinkFrame&)> on_frame;

  void run_until(Time time) {
    while (step(time)) {
    }
  }
  // Runs to the next answer. False if none comes within a time in which one must.
  bool next_frame() {
    const std::uint64_t before = answers_;
    const Time limit = now_ + 100 * kFrameTime;
    while (answers_ == before && step(limit)) {
    }
    return answers_ != before;
  }
  // Runs until this many running frames have been judged, or up to the limit.
  bool run_frames(std::uint64_t frames, Time limit = kEndOfTime) {
    const std::uint64_t wanted = running_ + frames;
    while (running_ < wanted && step(limit)) {
    }
    return running_ >= wanted;
  }
  std::uint64_t running() const { return running_; }
  // Runs until the position is certain.
  bool link_up(Time limit) {
    while (link().frame().lost && step(limit)) {
    }
    return !link().frame().lost;
  }

  void set_inputs(Time now, unsigned line, unsigned levels) override {
    model_.set_inputs(now, line, levels);
  }
  [[noreturn]] void stop(const std::string& reason) override { throw std::runtime_error(reason); }
  void answered(const LinkFrame& frame) override {
    ++answers_;
    if (frame.number != 0) ++running_;
    if (on_frame) on_frame(frame);
  }

 private:
  // How long an answer goes on when the master drives its trailer: it has 12 bits for its way, and
  // the driver comes on late.
  static Time late(const BenchSetup& setup) {
    const Time way = setup.cable.delay + setup.encoder.latency + setup.encoder.lead;
    return way - std::min(way, kBits(12) + setup.cable.enable);
  }
  // As the simulator does it.
  bool step(Time limit) {
    const Time event = queue_.next_time();
    const Time until = std::min(limit, event);
    if (const Time changed = model_.run_clocks(until); changed != kNever) {
      now_ = changed;
      line_.drive(now_, static_cast<unsigned>(model_.outputs() & MasterModel::kLevels));
      return true;
    }
    now_ = until;
    if (event > limit) return false;
    queue_.run_next();
    return true;
  }

  EventQueue queue_;
  LinkModel model_;
  DuplexConfig cable_;
  Time late_;
  DuplexLine line_;
  DslSlave* encoder_ = nullptr;
  Time now_ = 0;
  std::uint64_t answers_ = 0;
  std::uint64_t running_ = 0;
};

// Random motion: second differences up to a limit, and a speed that stays inside a bound.
class RandomMotion {
 public:
  RandomMotion(DslSlave& encoder, std::uint64_t seed, int most = 1023, int top_speed = 1'000'000)
      : random_(seed), most_(most), top_(top_speed), bits_(encoder.data_bits()) {
    encoder.set_motion(&RandomMotion::next, this);
  }
  std::uint64_t position() const { return position_; }

 private:
  static std::uint64_t next(void* context) {
    auto& self = *static_cast<RandomMotion*>(context);
    const auto range = static_cast<std::uint64_t>(2 * self.most_);
    auto a = static_cast<int>(self.random_.up_to(range)) - self.most_;
    if (self.speed_ > self.top_ && a > 0) a = -a;
    if (self.speed_ < -self.top_ && a < 0) a = -a;
    self.speed_ += a;
    self.position_ += static_cast<std::uint64_t>(static_cast<std::int64_t>(self.speed_));
    return self.position_ & (~std::uint64_t{0} >> (64 - self.bits_));
  }

  Random random_;
  int most_;
  int top_;
  unsigned bits_;
  int speed_ = 0;
  std::uint64_t position_ = 0;
};

}  // namespace mb4::sim::dsl_test

#endif  // MB4_TESTS_UNIT_DSL_BENCH_HPP_
