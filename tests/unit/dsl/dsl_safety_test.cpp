// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host sees beside positions: the checks of the two safe channels, each with a fault that
// trips it and no other one, and events with their masks, live states and interrupts (D-8, D-13).
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "sim/lines/dsl/dsl_faults.hpp"
#include "sim/masters/dsl_model/host_bytes.hpp"
#include "tests/unit/dsl/dsl_bench.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_model;
using dsl_test::Bench;
using dsl_test::BenchSetup;
namespace address = host_address;
namespace mask = host_bit;

constexpr unsigned kVertical = 8;

BenchSetup turning_motor() {
  BenchSetup setup;
  setup.metres(10);
  setup.encoder.source.kind = DataSource::Kind::kRamp;
  setup.encoder.source.step = 3000;
  return setup;
}

// Runs to the begin of a vertical frame. The position is certain.
void run_to_begin(Bench& bench) {
  ASSERT_TRUE(bench.link_up(10'000 * kPsPerUs));
  do {
    ASSERT_TRUE(bench.run_frames(1));
  } while (bench.link().frame().place + 1 != kVertical);
}

void clear_events(HostBytes& host) {
  for (const unsigned at : {address::kEventH, address::kEventL, address::kEventS}) {
    host.write(at, 0);
  }
}

std::string names_of_checks(const SafeFlags& flags) {
  std::string names;
  for (unsigned i = 0; i < kSafeChecks; ++i) {
    if (!flags.has(static_cast<SafeCheck>(i))) continue;
    names += (names.empty() ? "" : ", ") + std::string(name_of(static_cast<SafeCheck>(i)));
  }
  return names;
}

std::string names_of_events(const HostBytes& host) {
  const struct {
    unsigned at;
    std::uint8_t mask;
    const char* name;
  } kBits[] = {{address::kEventH, mask::kSce, "SCE"},
               {address::kEventH, mask::kVpos, "VPOS"},
               {address::kEventH, mask::kPos, "POS"},
               {address::kEventL, mask::kQmlw, "QMLW"},
               {address::kEventS, mask::kSce, "SCE of EVENT_S"},
               {address::kEventS, mask::kSafeVpos, "VPOS of EVENT_S"}};
  std::string names;
  for (const auto& [at, bit, name] : kBits) {
    if ((host.read(at) & bit) != 0) names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names.empty() ? "none" : names;
}

// What the vertical frames from the next one on fail, and which events they bring. The fault lasts
// for one vertical frame.
struct Seen {
  SafeFlags flags;
  std::string events;
};

Seen see(Bench& bench, const std::function<void(Bench&, bool)>& fault) {
  Seen seen;
  run_to_begin(bench);
  HostBytes& host = bench.link().host();
  host.check_rules() = {.bits2 = 32, .tolerance = 0};
  clear_events(host);
  fault(bench, true);
  for (unsigned i = 0; i < 6 * kVertical; ++i) {
    if (i == kVertical) fault(bench, false);
    EXPECT_TRUE(bench.run_frames(1));
    if (bench.link().frame().safe_new) {
      for (unsigned check = 0; check < kSafeChecks; ++check) {
        const auto which = static_cast<SafeCheck>(check);
        seen.flags.set(which, bench.link().frame().checks.has(which));
      }
    }
  }
  seen.events = names_of_events(host);
  EXPECT_EQ(bench.link().restarts(), 0U);
  return seen;
}

struct SafetyCase {
  const char* how;
  const SlaveFault* fault;
  SafeCheck check;
};

constexpr SafetyCase kCases[] = {
    {"CRC of safe channel 1", &slave_fault::kWrongCrc, SafeCheck::kCrc1},
    {"marker in safe channel 1", &slave_fault::kSafeMarker, SafeCheck::kMarked1},
    {"VSYNC early", &slave_fault::kEarlyVsync, SafeCheck::kVsyncEarly},
    {"VSYNC late", &slave_fault::kLateVsync, SafeCheck::kVsyncLate},
    {"stale safe positions", &slave_fault::kStaleSafe, SafeCheck::kStale},
    {"position 1 is not position 2", &slave_fault::kSafe2Mismatch, SafeCheck::kMismatch},
    {"TOG2", &slave_fault::kToggle2, SafeCheck::kToggle2},
    {"TEST2", &slave_fault::kTest2, SafeCheck::kTest2},
    {"ERR2", &slave_fault::kError2, SafeCheck::kError2},
    {"FIX2", &slave_fault::kFix2, SafeCheck::kFix2},
    {"VSYNC missing", &slave_fault::kNoVsync, SafeCheck::kVsyncMissing},
    {"K27.7 in safe channel 2", &slave_fault::kSafe2Marker, SafeCheck::kMarked2},
    {"CRC of safe channel 2", &slave_fault::kWrongCrc2, SafeCheck::kCrc2},
};

std::string row(const std::string& how, const std::string& fault, SafeCheck check,
                const std::string& events) {
  return "| " + how + " | " + fault + " | " + std::to_string(static_cast<unsigned>(check)) + " | " +
         events + " |\n";
}

// The table of docs/dsl.md is what this makes.
TEST(DslSafety, EachCheck_HasAFaultThatTripsItAlone) {
  std::string table;
  for (const SafetyCase& test : kCases) {
    SCOPED_TRACE(test.how);
    Bench bench(turning_motor());
    const Seen seen =
        see(bench, [&test](Bench& there, bool on) { there.encoder().set_fault(*test.fault, on); });
    EXPECT_EQ(names_of_checks(seen.flags), name_of(test.check));
    table += row(test.how, "`" + std::string(test.fault->name) + "`", test.check, seen.events);
  }
  // A wrong bit: one of the ten makes a word that is none.
  for (const bool second : {false, true}) {
    unsigned codes = 0;
    std::string events;
    for (unsigned bit = 0; bit < 10; ++bit) {
      Bench bench(turning_motor());
      const Seen seen = see(bench, [&](Bench& there, bool on) {
        const std::uint64_t next = there.link().frame().number + 3;
        if (on) there.line().flip(next, {bit + (second ? 51U : 0U)});
      });
      EXPECT_NE(seen.flags.bits(), 0U) << bit;
      const SafeCheck check = second ? SafeCheck::kCode2 : SafeCheck::kCode1;
      if (names_of_checks(seen.flags) != name_of(check)) continue;
      ++codes;
      events = seen.events;
    }
    EXPECT_GT(codes, 2U);
    table += row(std::string("coding of safe channel ") + (second ? "2" : "1"), "`bit-flip`",
                 second ? SafeCheck::kCode2 : SafeCheck::kCode1, events);
  }
  std::ifstream file(MB4_DSL_PAGE);
  const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_NE(page.find(table), std::string::npos) << "docs/dsl.md must have\n" << table;
}

TEST(DslSafety, WithoutAFault_NothingIsTripped) {
  for (const unsigned narrow : {0U, 1U, 20U, 32U}) {
    for (const bool is_signed : {false, true}) {
      BenchSetup setup = turning_motor();
      setup.encoder.safe2_bits = narrow;
      setup.encoder.is_signed = is_signed;
      setup.encoder.source.start = 0xFFFF'0000;
      Bench bench(setup);
      run_to_begin(bench);
      bench.link().host().check_rules() = {.bits2 = narrow, .tolerance = 0};
      for (unsigned i = 0; i < 80; ++i) {
        ASSERT_TRUE(bench.run_frames(1));
        ASSERT_EQ(names_of_checks(bench.link().frame().checks), "");
      }
    }
  }
}

// The two positions may differ by the tolerance, round the end of the range too.
TEST(DslSafety, Tolerance_IsADistance) {
  const struct {
    std::uint64_t first;
    std::uint64_t second;
    unsigned tolerance;
    bool agrees;
  } kPairs[] = {{0x1000, 0x10, 0, true},  {0x1000, 0x11, 0, false}, {0x1000, 0x11, 1, true},
                {0x1000, 0x0F, 1, true},  {0x1000, 0x0E, 1, false}, {0x0000, 0xFF, 1, true},
                {0xFFFF, 0x00, 1, true},  {0xFFFF, 0x01, 1, false}, {0x8000, 0x00, 127, false},
                {0x8000, 0x00, 128, true}};
  for (const auto& [first, second, tolerance, agrees] : kPairs) {
    EXPECT_EQ(positions_agree(first, 16, ~second, {.bits2 = 8, .tolerance = tolerance}), agrees)
        << first << ' ' << second << ' ' << tolerance;
  }
  EXPECT_TRUE(positions_agree(1, 16, 5, {}));  // not compared
}

// Each channel has an age of its own, which goes on while no good vertical frame comes.
TEST(DslSafety, Age_CountsFramesSinceTheLastGoodOne) {
  Bench bench(turning_motor());
  bench.on_frame = [](const LinkFrame& frame) {
    if (frame.number < kVertical) {
      EXPECT_FALSE(frame.safe1.age.has_value());
    }
  };
  run_to_begin(bench);
  bench.on_frame = nullptr;
  EXPECT_EQ(bench.link().frame().safe1.age, 0U);
  bench.encoder().set_fault(slave_fault::kWrongCrc2, true);
  for (unsigned frame = 1; frame <= 5 * kVertical; ++frame) {
    if (frame == 2 * kVertical + 1) bench.encoder().set_fault(slave_fault::kWrongCrc2, false);
    ASSERT_TRUE(bench.run_frames(1));
    EXPECT_EQ(bench.link().frame().safe1.age, frame % kVertical) << frame;
    const unsigned second = frame < 3 * kVertical ? frame : frame % kVertical;
    EXPECT_EQ(bench.link().frame().safe2.age, second) << frame;
  }
  bench.encoder().set_fault(slave_fault::kSilent, true);
  bench.line().slave_changed(bench.now());
  bench.run_until(bench.now() + 100 * dsl_test::kFrameTime);
  EXPECT_FALSE(bench.link().frame().safe1.age.has_value());
  EXPECT_FALSE(bench.link().frame().safe2.age.has_value());
}

// One bad vertical frame is no fault of the toggle bit of the next one.
TEST(DslSafety, LostVerticalFrame_DoesNotTripTheToggleBit) {
  for (const unsigned frames : {1U, 2U, 3U}) {
    Bench bench(turning_motor());
    run_to_begin(bench);
    bench.encoder().set_fault(slave_fault::kWrongCrc2, true);
    ASSERT_TRUE(bench.run_frames(frames * kVertical));
    bench.encoder().set_fault(slave_fault::kWrongCrc2, false);
    for (unsigned i = 0; i < 3 * kVertical; ++i) {
      ASSERT_TRUE(bench.run_frames(1));
      const SafeFlags& checks = bench.link().frame().checks;
      ASSERT_FALSE(checks.has(SafeCheck::kToggle2)) << frames;
    }
  }
}

// K8: a position whose first byte is FDh, FBh in the second channel, is an error by its value in
// the map of the SDK alone.
TEST(DslSafety, MarkerByValue_CountsInTheMapOfTheSdk) {
  for (const bool sdk_map : {false, true}) {
    for (const std::uint64_t top : {0xFDULL, 0x04ULL}) {  // ~04h is FBh
      BenchSetup setup;
      setup.rules.sdk_map = sdk_map;
      setup.rules.strict_id = false;
      setup.encoder.data_bits = 40;
      setup.encoder.source.constant = top << 32U | 0x12345678;
      Bench bench(setup);
      ASSERT_TRUE(bench.run_frames(60, 50'000 * kPsPerUs));
      const LinkFrame& frame = bench.link().frame();
      EXPECT_EQ(frame.safe1.marked, sdk_map && top == 0xFD);
      EXPECT_EQ(frame.safe2.marked, sdk_map && top == 0x04);
      EXPECT_EQ(frame.safe1.valid, !frame.safe1.marked);
    }
  }
}

// ---- Events -------------------------------------------------------------------------------------

TEST(DslEvents, StartOfALink_SetsThem) {
  Bench bench(turning_motor());
  HostBytes& host = bench.link().host();
  bench.run_until(bench.now() + 20 * kPsPerUs);
  EXPECT_EQ(host.read(address::kEventH), mask::kPrst);  // R37
  EXPECT_EQ(host.read(address::kEventS), mask::kSafePrst);
  EXPECT_EQ(host.read(address::kOnlineD), 0x10 | mask::kPos | mask::kPrst);
  EXPECT_EQ(host.read(address::kOnlineD + 1), 0);
  EXPECT_EQ(host.read(address::kOnline1), 0x10 | mask::kPrst);
  EXPECT_EQ(host.read(address::kOnline2), 0x10 | mask::kPrst);
  run_to_begin(bench);
  // F13: the channel of messages is free from the first VSYNC on.
  EXPECT_EQ(host.read(address::kEventL), mask::kQmlw | mask::kFrel | mask::kFres);
  EXPECT_EQ(host.read(address::kEventS), mask::kSafeQmlw | mask::kSafePrst | mask::kSafeFres);
  EXPECT_EQ(host.read(address::kEventH), mask::kPos | mask::kPrst);
  ASSERT_TRUE(bench.run_frames(80));
  EXPECT_EQ(host.read(address::kOnlineD), 0x10);
  EXPECT_EQ(host.read(address::kOnlineD + 1), mask::kFrel | mask::kFres);
  EXPECT_EQ(host.read(address::kOnline1), 0x10);
  EXPECT_EQ(host.read(address::kOnline1 + 1), mask::kSafeFres);
  EXPECT_EQ(host.read(address::kOnline2), 0x10);
}

TEST(DslEvents, HostClearsThem_ByWriting0) {
  Bench bench(turning_motor());
  HostBytes& host = bench.link().host();
  run_to_begin(bench);
  host.write(address::kEventH, static_cast<std::uint8_t>(~mask::kPos));
  EXPECT_EQ(host.read(address::kEventH), mask::kPrst);
  host.write(address::kEventH, 0xFF);
  EXPECT_EQ(host.read(address::kEventH), mask::kPrst);
  host.write(address::kEventH, 0);
  EXPECT_EQ(host.read(address::kEventH), 0);
  clear_events(host);
  ASSERT_TRUE(bench.run_frames(80));
  clear_events(host);  // QM is 15 now
  ASSERT_TRUE(bench.run_frames(8));
  EXPECT_EQ(host.read(address::kEventH) | host.read(address::kEventL) | host.read(address::kEventS),
            0);
}

// SUM is masked by MASK_SUM, SSUM is not; INT and SINT follow the masks of their registers.
TEST(DslEvents, Masks_SayWhichBitsInterrupt) {
  BenchSetup setup = turning_motor();
  setup.encoder.summary = 0x24;
  Bench bench(setup);
  HostBytes& host = bench.link().host();
  run_to_begin(bench);
  ASSERT_TRUE(bench.run_frames(80));
  clear_events(host);
  ASSERT_TRUE(bench.run_frames(8));
  EXPECT_EQ(host.read(address::kEventH), 0);
  EXPECT_EQ(host.read(address::kEventS), mask::kSum);
  EXPECT_EQ(host.read(address::kOnlineD), 0x10);
  EXPECT_EQ(host.read(address::kOnline1), 0x10 | mask::kSum);
  host.write(address::kMaskSum, 0x04);
  EXPECT_EQ(host.read(address::kMaskSum), 0x04);
  EXPECT_EQ(host.read(address::kOnlineD), 0x10 | mask::kSum);
  unsigned events = 0;
  unsigned safe_events = 0;
  host.write(address::kMaskS, mask::kSum);
  host.write(address::kMaskH, mask::kSum);
  EXPECT_EQ(host.read(address::kEventS), mask::kInt | mask::kSum);
  host.write(address::kEventS, 0);
  EXPECT_EQ(host.read(address::kEventS), 0);
  for (unsigned i = 0; i < 3 * kVertical; ++i) {
    ASSERT_TRUE(bench.run_frames(1));
    events += host.causes().event ? 1 : 0;
    safe_events += host.causes().event_s ? 1 : 0;
    EXPECT_TRUE(host.causes().frame);
    EXPECT_EQ(host.causes().safe1, bench.link().frame().place + 1 == kVertical);
    EXPECT_EQ(host.causes().safe2, host.causes().safe1);
  }
  EXPECT_EQ(host.read(address::kEventH), mask::kInt | mask::kSum);
  EXPECT_EQ(host.read(address::kOnlineD), 0x10 | mask::kInt | mask::kSum);
  EXPECT_EQ(host.read(address::kOnline1), 0x10 | mask::kInt | mask::kSum);
  EXPECT_EQ(events, 1U);  // it stays: the host has not cleared it
  EXPECT_EQ(safe_events, 1U);
  host.write(address::kMaskH, 0);
  EXPECT_EQ(host.read(address::kEventH), mask::kSum);
}

// Each event has a mask of its own.
TEST(DslEvents, EachBit_InterruptsByItsMask) {
  constexpr std::uint8_t kH = 0x6D;
  constexpr std::uint8_t kL = 0x37;
  Bench bench(turning_motor());
  HostBytes& host = bench.link().host();
  for (const unsigned at : {address::kMaskH, address::kMaskL, address::kMaskS}) {
    host.write(at, 0xFF);
  }
  EXPECT_EQ(host.read(address::kMaskH), kH);
  EXPECT_EQ(host.read(address::kMaskL), kL);
  EXPECT_EQ(host.read(address::kMaskS), 0x7F);
  run_to_begin(bench);
  const std::uint8_t high = host.read(address::kEventH);
  const std::uint8_t low = host.read(address::kEventL);
  const std::uint8_t safe = host.read(address::kEventS);
  for (unsigned bit = 0; bit < 7; ++bit) {
    const auto one = static_cast<std::uint8_t>(1U << bit);
    host.write(address::kMaskH, one);
    host.write(address::kMaskL, 0);
    host.write(address::kMaskS, one);
    EXPECT_EQ((host.read(address::kEventH) & mask::kInt) != 0, (high & one) != 0) << bit;
    EXPECT_EQ((host.read(address::kEventS) & mask::kInt) != 0, (safe & one) != 0) << bit;
    host.write(address::kMaskH, 0);
    host.write(address::kMaskL, one);
    EXPECT_EQ((host.read(address::kEventH) & mask::kInt) != 0, (low & one) != 0) << bit;
  }
}

TEST(DslEvents, PositionState_TellsWhatHasCome) {
  for (const bool sdk_map : {false, true}) {
    BenchSetup setup = turning_motor();
    setup.rules.sdk_map = sdk_map;
    Bench bench(setup);
    run_to_begin(bench);
    for (unsigned place = 0; place < kVertical; ++place) {
      // Behind the sample edge of the frame, and behind its end.
      const Time edge = bench.now() + dsl_test::kBits(8 + 9 + 12);
      bench.run_until(edge);
      EXPECT_EQ(bench.link().position_state(), 0) << place;
      ASSERT_TRUE(bench.run_frames(1));
      EXPECT_EQ(bench.link().position_state(), place + 1 == kVertical ? 3 : 2) << place;
    }
    // Safe position 1 alone.
    bench.encoder().set_fault(slave_fault::kWrongCrc2, true);
    ASSERT_TRUE(bench.run_frames(kVertical));
    EXPECT_EQ(bench.link().position_state(), sdk_map ? 3 : 1);
    bench.encoder().set_fault(slave_fault::kWrongCrc2, false);
    bench.encoder().set_fault(slave_fault::kWrongCrc, true);
    ASSERT_TRUE(bench.run_frames(kVertical));
    EXPECT_EQ(bench.link().position_state(), sdk_map ? 2 : 3);
  }
}

// STATUS2 and the byte of the pipeline, as they came.
TEST(DslEvents, StatesOfTheSecondChannel_AreLive) {
  BenchSetup setup = turning_motor();
  setup.encoder.pipeline = 0x5A;
  Bench bench(setup);
  HostBytes& host = bench.link().host();
  run_to_begin(bench);
  ASSERT_TRUE(bench.run_frames(80));
  EXPECT_EQ(host.read(address::kPipeD), 0x5A);
  EXPECT_EQ(host.read(address::kPipeS), 0);
  // A wrong word: it is told, and the byte stays.
  unsigned errors = 0;
  for (unsigned bit = 20; bit < 30; ++bit) {
    bench.line().flip(bench.link().frame().number + 1, {bit});
    ASSERT_TRUE(bench.run_frames(1));
    const std::uint8_t state = host.read(address::kPipeS);
    errors += state == pipe_bit::kError ? 1 : 0;
    EXPECT_EQ(state == 0, host.read(address::kPipeD) != 0x5A);
    ASSERT_TRUE(bench.run_frames(1));
  }
  EXPECT_GT(errors, 0U);
  ASSERT_TRUE(bench.run_frames(4));  // up to the end of a vertical frame
  bench.encoder().set_fault(slave_fault::kTest2, true);
  std::uint8_t toggles = 0;
  for (unsigned i = 0; i < 4; ++i) {
    ASSERT_TRUE(bench.run_frames(kVertical));
    const std::uint8_t low = host.read(address::kOnline2 + 1);
    EXPECT_EQ(low & 0x7F, 0x40);
    EXPECT_EQ(host.read(address::kOnline2), 0x10 | mask::kSum);
    if (i != 0) {
      EXPECT_NE(low & 0x80, toggles);
    }
    toggles = low & 0x80;
  }
}

}  // namespace
