// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The line of one wire: levels, times and contention are worked out by hand from the delays.
#include "sim/lines/duplex/duplex_line.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/scenario_error.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/lines/duplex/duplex_lines.hpp"

namespace {

using namespace mb4::sim;

constexpr Time kNs = kPsPerNs;
using Edges = std::vector<std::pair<Time, bool>>;

// A device that a test drives by hand.
class Hand final : public DuplexSlave {
 public:
  unsigned data_bits() const override { return 8; }
  bool set_data(std::uint64_t /*raw*/) override { return false; }
  void line_changed(Time now, bool level) override { seen.emplace_back(now, level); }
  bool idle() const override { return true; }
  using DuplexSlave::announce_frame;
  using DuplexSlave::begin_frame;
  using DuplexSlave::disable_time;
  using DuplexSlave::enable_time;
  using DuplexSlave::end_frame;
  using DuplexSlave::set_drive;
  using DuplexSlave::take_flips;
  using DuplexSlave::wrong_answer_bit;
  using DuplexSlave::wrong_master_bit;

  Edges seen;
};

struct Master final : LineMaster {
  void set_inputs(Time now, unsigned line, unsigned levels) override {
    EXPECT_EQ(line, 3U);
    seen.emplace_back(now, levels != 0);
  }
  [[noreturn]] void stop(const std::string& reason) override { throw std::runtime_error(reason); }

  Edges seen;
};

struct Watcher final : LineObserver {
  void frame_begun() override { ++begun; }
  void frame_over(const LineFrame& frame) override { frames.push_back(frame); }
  void edge(Time now, unsigned place, bool level) override {
    edges.push_back(std::to_string(now / kNs) + " " + std::to_string(place) + (level ? "+" : "-"));
  }

  unsigned begun = 0;
  std::vector<LineFrame> frames;
  std::vector<std::string> edges;
};

// 100 ns each way.
class DuplexLineTest : public testing::Test {
 protected:
  DuplexLineTest() { config.delay = 200 * kNs; }
  void make() {
    line = kDuplexLines.make({queue, config, {}, 7, master, 3});
    auto device = std::make_unique<Hand>();
    hand = device.get();
    kDuplexLines.add(*line, std::move(device));
  }
  void run_until(Time time) {
    while (queue.next_time() <= time) queue.run_next();
  }
  // The master's transceiver at `ns`, and the device's.
  void out(Time ns, bool level, bool enable) {
    run_until(ns * kNs);
    line->drive(ns * kNs, (level ? kOutPin : 0U) | (enable ? kEnablePin : 0U));
  }
  void answer(Time ns, bool level, bool enable) {
    run_until(ns * kNs);
    hand->set_drive(ns * kNs, {level, enable});
  }
  void end() { run_until(100'000 * kNs); }
  void act(Time ns, LineAction::What what, unsigned wire = 0) {
    run_until(ns * kNs);
    line->act(ns * kNs, {what, wire});
  }
  static Edges ns(const Edges& edges) {
    Edges in_ps;
    for (const auto& [time, level] : edges) in_ps.emplace_back(time * kNs, level);
    return in_ps;
  }
  DuplexContention contention(Time now = 0) const { return duplex(line.get())->contention(now); }

  EventQueue queue;
  DuplexConfig config;
  Master master;
  std::unique_ptr<Line> line;
  Hand* hand = nullptr;
};

using What = LineAction::What;

TEST_F(DuplexLineTest, RequestAndAnswer_ComeAfterOneWayEach) {
  make();
  out(1000, false, true);
  out(1200, true, true);
  out(1300, true, false);
  answer(1500, false, true);
  answer(1600, true, true);
  answer(1700, true, false);
  end();
  // Each end also sees what it drives itself, at once.
  EXPECT_EQ(hand->seen, ns({{1100, false}, {1300, true}, {1500, false}, {1600, true}}));
  EXPECT_EQ(master.seen, ns({{1000, false}, {1200, true}, {1600, false}, {1700, true}}));
  EXPECT_EQ(contention().times, 0U);
  EXPECT_EQ(line->round_trip(), 200 * kNs);
}

TEST_F(DuplexLineTest, LevelOfADriverThatIsOff_DoesNothing) {
  make();
  out(1000, false, false);
  answer(1000, false, false);
  end();
  EXPECT_TRUE(master.seen.empty());
  EXPECT_TRUE(hand->seen.empty());
}

TEST_F(DuplexLineTest, DriverNeedsItsTimes) {
  config.enable = 20 * kNs;
  config.disable = 30 * kNs;
  make();
  out(1000, false, true);
  out(1100, false, false);
  answer(2000, false, true);
  answer(2100, false, false);
  // Off and on again before it was off: it stays on.
  out(3000, false, true);
  out(3100, false, false);
  out(3110, false, true);
  out(3200, false, false);
  end();
  EXPECT_EQ(
      hand->seen,
      ns({{1120, false}, {1230, true}, {2020, false}, {2130, true}, {3120, false}, {3330, true}}));
  EXPECT_EQ(
      master.seen,
      ns({{1020, false}, {1130, true}, {2120, false}, {2230, true}, {3020, false}, {3230, true}}));
}

// Both drive from 1500 to 1600 at the device and from 1600 to 1700 at the master: one time, because
// it is without a gap.
TEST_F(DuplexLineTest, BothDrive_ZeroWinsAndCounts) {
  make();
  out(1000, true, true);
  answer(1500, false, true);
  out(1700, true, false);
  end();
  EXPECT_EQ(hand->seen, ns({{1500, false}}));
  EXPECT_EQ(master.seen, ns({{1600, false}}));
  EXPECT_EQ(contention().times, 1U);
  EXPECT_EQ(contention().first, 1500 * kNs);
  EXPECT_EQ(contention().total, 300 * kNs);  // at the device until 1800
  answer(2000, true, false);
  out(3000, true, true);
  answer(3050, true, true);  // the request is still on the cable
  answer(3090, true, false);
  end();
  // The answer reaches the master, which drives, from 3150 to 3190. It is over at the device before
  // the request comes.
  EXPECT_EQ(contention().times, 2U);
  EXPECT_EQ(contention().total, 340 * kNs);
}

// One that is not over counts up to now.
TEST_F(DuplexLineTest, BothDriveForEver_CountsUpToNow) {
  make();
  out(1000, true, true);
  answer(1500, true, true);
  run_until(4000 * kNs);
  EXPECT_EQ(contention(4000 * kNs).times, 1U);
  EXPECT_EQ(contention(4000 * kNs).longest, 2500 * kNs);
  EXPECT_EQ(contention(4500 * kNs).total, 3000 * kNs);
}

// Several calls for a frame add up, and each caller is told when it comes.
TEST_F(DuplexLineTest, FlipsOfOneFrame_AddUpAndAreTold) {
  make();
  unsigned told = 0;
  const FlipWatch watch{[](void* count) { ++*static_cast<unsigned*>(count); }, &told};
  line->flip(2, {3}, watch);
  line->flip(2, {5}, watch);
  line->flip(9, {1}, watch);
  EXPECT_TRUE(hand->begin_frame(1000 * kNs).empty());
  EXPECT_EQ(told, 0U);
  EXPECT_EQ(hand->begin_frame(2000 * kNs), (std::vector<unsigned>{3, 5}));
  EXPECT_EQ(told, 2U);
}

TEST_F(DuplexLineTest, Unplugged_TheEndsSeeOnlyThemselves) {
  make();
  out(1000, false, true);
  act(1500, What::kUnplug);
  EXPECT_FALSE(line->plugged());
  out(1600, true, false);
  answer(1700, false, true);
  act(2000, What::kPlug);
  answer(2500, true, false);
  end();
  EXPECT_EQ(hand->seen, ns({{1100, false}, {1500, true}, {1700, false}, {2500, true}}));
  EXPECT_EQ(master.seen, ns({{1000, false}, {1600, true}, {2100, false}, {2600, true}}));
  EXPECT_EQ(contention().times, 0U);
}

TEST_F(DuplexLineTest, DetachedDevice_IsUnplugged) {
  make();
  EXPECT_EQ(line->attached(), 1U);
  line->detach(0, 0);
  EXPECT_EQ(line->attached(), 0U);
  answer(1000, false, true);
  run_until(2000 * kNs);
  EXPECT_TRUE(master.seen.empty());
  line->detach(2000 * kNs, line->size());
  end();
  EXPECT_EQ(line->attached(), 1U);
  EXPECT_EQ(master.seen, ns({{2100, false}}));
}

TEST_F(DuplexLineTest, Shorts_AreOfBothEndsOrOfOne) {
  make();
  act(1000, What::kLow, DuplexLine::kBoth);
  act(1100, What::kFree, DuplexLine::kBoth);
  act(2000, What::kLow, DuplexLine::kIn);
  act(2100, What::kFree, DuplexLine::kIn);
  act(3000, What::kLow, DuplexLine::kOut);
  act(3100, What::kFree, DuplexLine::kOut);
  // A short to 1 is stronger than any driver.
  act(4000, What::kHigh, DuplexLine::kBoth);
  out(4100, false, true);
  answer(4500, false, true);
  act(5000, What::kFree, DuplexLine::kBoth);
  end();
  EXPECT_EQ(hand->seen,
            ns({{1000, false}, {1100, true}, {3000, false}, {3100, true}, {5000, false}}));
  EXPECT_EQ(master.seen,
            ns({{1000, false}, {1100, true}, {2000, false}, {2100, true}, {5000, false}}));
}

TEST_F(DuplexLineTest, Glitch_IsAtTheEndOfItsWay) {
  make();
  line->glitch(0, DuplexLine::kIn, 5 * kNs);
  EXPECT_EQ(master.seen, ns({{0, false}}));
  EXPECT_TRUE(hand->seen.empty());
  run_until(10 * kNs);
  line->glitch(10 * kNs, DuplexLine::kOut, 5 * kNs);
  EXPECT_EQ(hand->seen, ns({{10, false}}));
  run_until(20 * kNs);
  line->glitch(20 * kNs, DuplexLine::kBoth, 5 * kNs);
  end();
  EXPECT_EQ(master.seen, ns({{0, false}, {5, true}, {20, false}, {25, true}}));
  EXPECT_EQ(hand->seen, ns({{10, false}, {15, true}, {20, false}, {25, true}}));
}

// Falling edges come later by the skew of their way. A value for the line holds for both ways.
TEST_F(DuplexLineTest, SkewOfEachWay) {
  config.out.skew = 10 * kNs;
  config.in.skew = 20 * kNs;
  make();
  out(1000, false, true);
  out(1500, true, false);
  answer(2000, false, true);
  answer(2500, true, false);
  end();
  EXPECT_EQ(hand->seen[0].first, 1110 * kNs);
  EXPECT_EQ(hand->seen[1].first, 1600 * kNs);
  EXPECT_EQ(master.seen[2].first, 2120 * kNs);
  EXPECT_EQ(line->wire_faults(DuplexLine::kOut).skew, 10 * std::int64_t{kNs});
  EXPECT_EQ(line->wire_faults(DuplexLine::kIn).skew, 20 * std::int64_t{kNs});
  line->set_wire_faults(DuplexLine::kBoth, {});
  EXPECT_FALSE(line->wire_faults(DuplexLine::kOut).any());
  EXPECT_FALSE(line->wire_faults(DuplexLine::kIn).any());
}

TEST_F(DuplexLineTest, SilentDevice_DrivesNothing) {
  make();
  hand->set_fault(slave_fault::kSilent, true);
  line->slave_changed(0);
  answer(1000, false, true);
  run_until(1500 * kNs);
  EXPECT_TRUE(master.seen.empty());
  EXPECT_TRUE(hand->seen.empty());
  hand->set_fault(slave_fault::kSilent, false);
  line->slave_changed(1500 * kNs);
  end();
  EXPECT_EQ(master.seen, ns({{1600, false}}));
}

// The device knows what a frame is: the line need not rest between two.
TEST_F(DuplexLineTest, Frames_AreThoseOfTheDevice) {
  make();
  Watcher watcher;
  line->observe(0, &watcher, false);
  line->flip(2, {3, 5});
  EXPECT_TRUE(hand->begin_frame(1000 * kNs).empty());
  out(1100, false, true);
  out(1200, true, true);
  run_until(1900 * kNs);
  EXPECT_EQ(hand->begin_frame(2000 * kNs), (std::vector<unsigned>{3, 5}));
  hand->end_frame(2500 * kNs);
  hand->end_frame(2600 * kNs);  // is over already
  EXPECT_EQ(line->flip_frames(), 2U);
  EXPECT_EQ(watcher.begun, 2U);
  ASSERT_EQ(watcher.frames.size(), 2U);
  EXPECT_EQ(watcher.frames[0].number, 1U);
  EXPECT_EQ(watcher.frames[0].start, 1000 * kNs);
  EXPECT_EQ(watcher.frames[0].end, 2000 * kNs);
  EXPECT_EQ(watcher.frames[0].edges, 2U);
  EXPECT_EQ(watcher.frames[1].number, 2U);
  EXPECT_EQ(watcher.frames[1].end, 2500 * kNs);
  EXPECT_TRUE(watcher.edges.empty());
}

// Places 4 to 7: the master's level, its driver, what it sees, the device's level.
TEST_F(DuplexLineTest, Edges_AreToldWithThePresentLevels) {
  make();
  Watcher watcher;
  out(10, false, false);
  line->observe(20 * kNs, &watcher, true);
  EXPECT_EQ(watcher.edges, (std::vector<std::string>{"20 4-", "20 5-", "20 6+", "20 7+"}));
  watcher.edges.clear();
  out(1000, false, true);
  out(1100, true, false);
  answer(2000, false, true);
  answer(2100, false, false);
  end();
  EXPECT_EQ(watcher.edges,
            (std::vector<std::string>{"1000 5+", "1000 6-", "1100 4+", "1100 5-", "1100 6+",
                                      "2000 7-", "2100 6-", "2100 7+", "2200 6+"}));
  line->observe(3000 * kNs, nullptr, true);
  answer(200'000, false, true);
  EXPECT_EQ(watcher.edges.size(), 9U);
}

TEST_F(DuplexLineTest, Events_OfAScenario) {
  config.events = {{1000 * kNs, {What::kLow, DuplexLine::kBoth}},
                   {2000 * kNs, {What::kFree, DuplexLine::kBoth}}};
  make();
  end();
  EXPECT_EQ(master.seen, ns({{1000, false}, {2000, true}}));
}

// A device that finds a frame late, counts its bits, and gives it a number of its own.
TEST_F(DuplexLineTest, FrameFoundLate_BeginsInThePast) {
  make();
  Watcher watcher;
  line->observe(0, &watcher, false);
  line->flip(40, {1, 2});
  hand->announce_frame(1000 * kNs);
  EXPECT_EQ(hand->take_flips(1), std::vector<unsigned>{});
  EXPECT_EQ(hand->take_flips(40), (std::vector<unsigned>{1, 2}));
  EXPECT_EQ(hand->take_flips(40), std::vector<unsigned>{});
  out(1500, false, true);
  end();
  hand->end_frame(3000 * kNs, 108);
  ASSERT_EQ(watcher.frames.size(), 1U);
  EXPECT_EQ(watcher.frames[0].number, 1U);
  EXPECT_EQ(watcher.frames[0].start, 1000 * kNs);
  EXPECT_EQ(watcher.frames[0].end, 3000 * kNs);
  EXPECT_EQ(watcher.frames[0].edges, 108U);
}

// The chance of each direction by itself: 10,000 bits at 1 in 10 within five deviations.
TEST_F(DuplexLineTest, WrongBits_HaveTheirChance) {
  config.answer_errors = 0.1;
  config.enable = 3;
  config.disable = 4;
  make();
  EXPECT_EQ(hand->enable_time(), 3U);
  EXPECT_EQ(hand->disable_time(), 4U);
  int answers = 0;
  int masters = 0;
  for (int i = 0; i < 10'000; ++i) {
    answers += hand->wrong_answer_bit() ? 1 : 0;
    masters += hand->wrong_master_bit() ? 1 : 0;
  }
  EXPECT_NEAR(answers, 1000, 150);
  EXPECT_EQ(masters, 0);
}

DuplexConfig read(const std::string& text) {
  const TomlValue table = parse_toml(text, "line.toml");
  TomlFile file{"line.toml", {}};
  TomlReader reader(table, file);
  const Copied<LineConfig> config = kDuplexLines.read(reader);
  reader.finish();
  return duplex(*config);
}

TEST(DuplexKeys, AreRead) {
  const DuplexConfig config = read(
      "cable_m = 20\nns_per_m = 5\njitter_ns = 2\nout_jitter_ns = 3\nout_glitches_per_s = 4\n"
      "glitch_ns = 7\nenable_ns = 5\ndisable_ns = 6\nflips = [[3, 1, 2]]\n"
      "[[event]]\nat_us = 1\naction = \"out-low\"\n[[event]]\nat_us = 2\naction = \"line-free\"\n");
  EXPECT_EQ(config.delay, 200 * kNs);
  EXPECT_EQ(config.in.jitter, 2 * kNs);
  EXPECT_EQ(config.out.jitter, 3 * kNs);
  EXPECT_EQ(config.out.glitches_per_s, 4U);
  EXPECT_EQ(config.out.glitch_width, 7 * kNs);
  EXPECT_EQ(config.enable, 5 * kNs);
  EXPECT_EQ(config.disable, 6 * kNs);
  EXPECT_EQ(config.flips.at(3), (std::vector<unsigned>{1, 2}));
  ASSERT_EQ(config.events.size(), 2U);
  EXPECT_EQ(config.events[0].action, (LineAction{What::kLow, DuplexLine::kOut}));
  EXPECT_EQ(config.events[1].action, (LineAction{What::kFree, DuplexLine::kBoth}));
}

TEST(DuplexKeys, Defaults_AreThoseOfUsualTransceivers) {
  const DuplexConfig config = read("");
  EXPECT_EQ(config.enable, 30 * kNs);
  EXPECT_EQ(config.disable, 40 * kNs);
  EXPECT_EQ(config.answer_errors, 0);
  EXPECT_EQ(config.master_errors, 0);
  EXPECT_EQ(read("master_errors = 0.1\n").master_errors, 0.1);
  EXPECT_EQ(read("answer_errors = 1e-4\n").answer_errors, 1e-4);
  EXPECT_THROW(read("answer_errors = 0.11\n"), ScenarioError);
}

TEST(DuplexKeys, OfOtherLines_AreRefused) {
  EXPECT_THROW(read("mo = true\n"), ScenarioError);
  EXPECT_THROW(read("ma_jitter_ns = 1\n"), ScenarioError);
  EXPECT_THROW(read("enable_ns = -1\n"), ScenarioError);
  EXPECT_THROW(read("glitch_ns = 5\n"), ScenarioError);
  EXPECT_THROW(read("[[event]]\nat_us = 1\naction = \"sl-low\"\n"), ScenarioError);
}

}  // namespace
