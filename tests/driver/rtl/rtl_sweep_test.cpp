// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Each call with one disturbed transfer, on the Verilated chip: every bit in both directions, and
// every way in which a transfer can fail as a whole.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "tests/driver/rtl/sweep_rig.hpp"
#include "tests/support/environment.hpp"

namespace {

using namespace mb4test;  // NOLINT: the rig

struct Case {
  Setup setup;
  MeanFault fault;

  static unsigned flags(const Setup& setup) {
    return (setup.omits ? 1U : 0U) + (setup.zeros ? 2U : 0U) + (setup.unheld ? 4U : 0U) +
           (setup.slow ? 8U : 0U);
  }
  // MB4_SWEEP_CASE takes it.
  [[nodiscard]] std::string code() const {
    std::string text;
    for (const unsigned part :
         {static_cast<unsigned>(setup.way), static_cast<unsigned>(setup.bus),
          static_cast<unsigned>(setup.before), static_cast<unsigned>(setup.check), flags(setup),
          static_cast<unsigned>(setup.act), static_cast<unsigned>(fault.kind), fault.transfer,
          fault.place}) {
      text += (text.empty() ? "" : ".") + std::to_string(part);
    }
    return text;
  }
  [[nodiscard]] std::string text() const {
    return "MB4_SWEEP_CASE=" + code() + " (" + setup.text() + ", " + to_string(fault.kind) +
           ", transfer " + std::to_string(fault.transfer) + ", place " +
           std::to_string(fault.place) + ")";
  }
  static Case from(const char* code) {
    std::array<unsigned, 9> parts{};
    for (unsigned& part : parts) {
      char* end = nullptr;
      part = static_cast<unsigned>(std::strtoul(code, &end, 10));
      code = *end == '.' ? end + 1 : end;
    }
    return {{static_cast<Way>(parts[0]), static_cast<Bus>(parts[1]), static_cast<Before>(parts[2]),
             static_cast<SpiCheck>(parts[3]), (parts[4] & 1U) != 0, static_cast<Act>(parts[5]),
             (parts[4] & 2U) != 0, (parts[4] & 4U) != 0, (parts[4] & 8U) != 0},
            {static_cast<MeanKind>(parts[6]), parts[7], parts[8]}};
  }
};

// What a case leaves behind, in memory that its process shares with this one.
struct Outcome {
  Verdict verdict;
  std::size_t count;
  std::array<Transfer, 1000> made;
};
Outcome& outcome() {
  static Outcome* const shared = [] {
    void* memory =
        mmap(nullptr, sizeof(Outcome), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) std::abort();
    return new (memory) Outcome;
  }();
  return *shared;
}

// The rest of a case from here on, in a process of its own, so that the state before the call is
// made once for many cases. It may stop: then the verdict is the worst.
template <typename Rest>
void apart(Rest rest) {
  outcome().verdict = Verdict::kStopped;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    rest();
    std::fflush(nullptr);
    _exit(0);
  }
  if (child < 0) std::abort();
  waitpid(child, nullptr, 0);
}

Verdict disturbed(Rig& rig, const MeanFault& fault, unsigned reads) {
  const bool tells = std::getenv("MB4_SWEEP_CASE") != nullptr;
  apart([&] {
    rig.telling = tells;
    if (tells) rig.bus.log(&rig.story);
    rig.note("the disturbed call");
    rig.disturb(fault);
    const std::vector<Transfer>& made = rig.made();
    outcome().count = std::min(made.size(), outcome().made.size());
    std::copy_n(made.begin(), outcome().count, outcome().made.begin());
    rig.note("reads go on");
    rig.go_on(reads);
    if (tells) std::printf("%s", rig.story.c_str());
    outcome().verdict = rig.verdict;
  });
  return outcome().verdict;
}

// The transfers of the call without a fault.
std::vector<Transfer> transfers(Rig& rig, const Setup& setup) {
  const Verdict verdict = disturbed(rig, {}, 20);
  // With kFull an access of zeros drops the word that waits. activate() sends no ID at first.
  const bool drops = setup.check >= SpiCheck::kFull && !is_single(setup.way) &&
                     setup.act != Act::kNone && (setup.zeros || activates(setup.act));
  // Without a stored CRC a bad word may be no word at all.
  // A read at once may find that the next frame has begun.
  const Verdict most = drops || setup.before == Before::kNothingNew ||
                               (is_bad(setup.before) && setup.check == SpiCheck::kOff)
                           ? Verdict::kHidden
                       : is_bad(setup.before) ? Verdict::kTold
                                              : Verdict::kRight;
  EXPECT_LE(verdict, most) << to_string(verdict) << " without a fault: " << Case{setup, {}}.text();
  return {outcome().made.begin(),
          outcome().made.begin() + static_cast<std::ptrdiff_t>(outcome().count)};
}

// The first, the second and the last one of each kind.
std::vector<unsigned> chosen(const std::vector<Transfer>& made) {
  std::vector<unsigned> result;
  for (unsigned i = 0; i < made.size(); ++i) {
    unsigned before = 0;
    bool last = true;
    for (unsigned k = 0; k < made.size(); ++k) {
      if (k != i && made[k].like(made[i])) {
        before += k < i ? 1 : 0;
        last = last && k < i;
      }
    }
    if (before < 2 || last) result.push_back(i);
  }
  return result;
}

std::vector<MeanFault> flips(const std::vector<Transfer>& made) {
  std::vector<MeanFault> faults;
  for (const unsigned i : chosen(made)) {
    for (unsigned bit = 0; bit < 8U * made[i].size; ++bit) {
      faults.push_back({MeanKind::kFlipMosi, i, bit});
      if (made[i].reads) faults.push_back({MeanKind::kFlipMiso, i, bit});
    }
  }
  return faults;
}

std::vector<MeanFault> failures(const std::vector<Transfer>& made) {
  std::vector<MeanFault> faults;
  for (const unsigned i : chosen(made)) {
    for (const MeanKind kind :
         {MeanKind::kLeftOut, MeanKind::kNotStored, MeanKind::kLate, MeanKind::kToldFailed}) {
      faults.push_back({kind, i, 0});
    }
    for (unsigned bytes = 1; bytes < made[i].size; ++bytes) {
      faults.push_back({MeanKind::kShort, i, bytes});
    }
  }
  return faults;
}

// What came out, by fault and check.
struct Tally {
  std::map<std::tuple<MeanKind, SpiCheck>, std::array<std::uint64_t, kVerdicts>> verdicts;
  std::map<std::string, unsigned> shown;

  void print() const {
    for (const auto& [key, counts] : verdicts) {
      std::uint64_t sum = 0;
      std::string text;
      for (unsigned i = 0; i < kVerdicts; ++i) {
        sum += counts[i];
        if (counts[i] != 0) {
          text += std::string(", ") + to_string(static_cast<Verdict>(i)) + " " +
                  std::to_string(counts[i]);
        }
      }
      std::printf("%-15s %-16s %7llu%s\n", to_string(std::get<0>(key)), to_string(std::get<1>(key)),
                  static_cast<unsigned long long>(sum), text.c_str());
    }
  }
};

// What must never happen.
bool is_forbidden(Verdict verdict, SpiCheck check) {
  if (verdict >= Verdict::kRegister) return true;
  return check >= SpiCheck::kFull && verdict >= Verdict::kUncounted;
}

bool asks(Act act) {
  return (act >= Act::kReadRegisters && act <= Act::kBeginCommand) ||
         (act >= Act::kPlanRead && act <= Act::kPlanCommand) || act >= Act::kReadBesideVerify;
}

std::vector<Setup> control_setups() {
  std::vector<Setup> all;
  for (unsigned i = 1; i < static_cast<unsigned>(Act::kCount); ++i) {
    const Act act = static_cast<Act>(i);
    const bool initializes = act == Act::kInitialize || act == Act::kPlanInitialize;
    const bool starts = act == Act::kStart || act == Act::kStop || act == Act::kRestart ||
                        act == Act::kPlanStart || act == Act::kPlanRestart ||
                        act == Act::kWriteNextActuator;
    const bool actuator =
        act == Act::kWriteActuator || act == Act::kWriteNextActuator || act == Act::kPlanActuator;
    for (const Way way : {Way::kReadFrame, Way::kPollSlave}) {
      if (is_single(way) ? starts : initializes) continue;
      for (const Before before :
           {Before::kFresh, Before::kRead, Before::kWrite, Before::kCommand}) {
        for (unsigned check = 0; check < 4; ++check) {
          for (const bool omits : {false, true}) {
            const Setup setup{way,    actuator ? Bus::kActuator : Bus::kOne,
                              before, static_cast<SpiCheck>(check),
                              omits,  act};
            all.push_back(setup);
            // A slave that is switched off gives the others the words of their neighbours. A bus of
            // eight takes long, so not every state before.
            const bool eight = setup.check == SpiCheck::kFull && !omits &&
                               (before == Before::kFresh || before == Before::kWrite);
            if (asks(act) && eight) {
              all.push_back(setup);
              all.back().bus = Bus::kEight;
            }
            if ((asks(act) || actuator) && setup.check >= SpiCheck::kFull) {
              all.push_back(setup);
              all.back().zeros = true;
            }
            if (asks(act) && !is_single(way)) {
              for (const bool slow : {false, true}) {
                all.push_back(setup);
                all.back().unheld = true;
                all.back().slow = slow;
              }
              all.push_back(setup);
              all.back().slow = true;
            }
          }
        }
      }
    }
  }
  return all;
}

void run(Rig& rig, const Case& one, unsigned reads, Tally& tally) {
  const Verdict verdict = disturbed(rig, one.fault, reads);
  ++tally.verdicts[{one.fault.kind, one.setup.check}][static_cast<unsigned>(verdict)];
  const Transfer hit = outcome().made[one.fault.transfer];
  if (is_forbidden(verdict, one.setup.check) &&
      verdict != left_open(one.setup.check, one.fault, hit)) {
    const std::string key = std::string(to_string(verdict)) + to_string(one.setup.check) +
                            to_string(one.setup.way) + to_string(one.setup.act);
    if (++tally.shown[key] <= 3) ADD_FAILURE() << to_string(verdict) << ": " << one.text();
  }
}

std::vector<Setup> setups(const std::vector<Bus>& buses,
                          const std::vector<bool>& quirks = {false, true}) {
  std::vector<Setup> all;
  for (unsigned way = 0; way < static_cast<unsigned>(Way::kCount); ++way) {
    for (const Bus bus : buses) {
      for (unsigned before = 0; before < static_cast<unsigned>(Before::kCount); ++before) {
        for (unsigned check = 0; check < 4; ++check) {
          for (const bool omits : quirks) {
            const Setup setup{static_cast<Way>(way), bus, static_cast<Before>(before),
                              static_cast<SpiCheck>(check), omits};
            const bool follows = setup.before == Before::kBeside ||
                                 setup.before == Before::kNothingNew ||
                                 setup.before == Before::kBadBefore;
            if (is_single(setup.way) && follows) continue;
            if (is_bad(setup.before) && bus == Bus::kNoCrc) continue;
            if (is_single(setup.way) && omits) continue;  // nothing is held
            const bool controls = setup.before >= Before::kRead && setup.before <= Before::kBeside;
            if (!is_biss_c(bus) && controls) continue;
            if (setup.way == Way::kC99 && setup.before == Before::kBeside) continue;
            all.push_back(setup);
          }
        }
      }
    }
  }
  return all;
}

using Faults = std::vector<MeanFault> (*)(const std::vector<Transfer>&);

// All faults of all setups, or `sample` of them by a seed: some of each setup that is drawn.
// MB4_SWEEP_ONLY: all of those whose code begins with it.
void sweep(Faults faults, std::vector<Setup> all, std::uint64_t sample) {
  if (const char* only = std::getenv("MB4_SWEEP_ONLY")) {
    std::erase_if(all, [only](const Setup& setup) {
      return Case{setup, {}}.code().compare(0, std::strlen(only), only) != 0;
    });
    sample = 0;
  }
  constexpr std::uint64_t kOfASetup = 8;
  Tally tally;
  if (const char* code = std::getenv("MB4_SWEEP_CASE")) {
    const Case one = Case::from(code);
    std::printf("%s\n", one.text().c_str());
    Rig rig(one.setup);
    run(rig, one, static_cast<unsigned>(number("MB4_SWEEP_READS", 20)), tally);
    tally.print();
    return;
  }
  const std::uint64_t seed = number("MB4_SEED", 56);
  const std::uint64_t part = number("MB4_SWEEP_PART", 0);
  const std::uint64_t parts = number("MB4_SWEEP_PARTS", 1);
  std::mt19937_64 random(seed);
  std::uint64_t cases = 0;
  const std::uint64_t rounds = sample == 0 ? all.size() : (sample + kOfASetup - 1) / kOfASetup;
  for (std::uint64_t i = 0; i < rounds; ++i) {
    if (sample == 0 && i % parts != part) continue;
    const Setup& setup = all[sample == 0 ? i : random() % all.size()];
    Rig rig(setup);
    const std::vector<MeanFault> of = faults(transfers(rig, setup));
    const std::uint64_t count = sample == 0 ? of.size() : kOfASetup;
    for (std::uint64_t k = 0; k < count; ++k) {
      const MeanFault& fault = of[sample == 0 ? k : random() % of.size()];
      run(rig, {setup, fault}, cases++ % 50 == 49 ? 200 : 20, tally);
    }
  }
  std::printf("%llu cases, MB4_SEED=%llu\n", static_cast<unsigned long long>(cases),
              static_cast<unsigned long long>(seed));
  tally.print();
}

const std::vector<Bus> kOthers{Bus::kTwo,      Bus::kEight, Bus::kNoCrc, Bus::kLong,
                               Bus::kChannels, Bus::kBissB, Bus::kSsi};

std::uint64_t drawn(std::uint64_t otherwise) { return number("MB4_SWEEP_SAMPLE", otherwise); }

TEST(DriverSweep, OneFlippedBit_OneEncoder) { sweep(flips, setups({Bus::kOne}), drawn(480)); }
TEST(DriverSweep, OneFlippedBit_OtherBuses) { sweep(flips, setups(kOthers, {false}), drawn(240)); }
TEST(DriverSweep, OneFlippedBit_ControlCalls) { sweep(flips, control_setups(), drawn(480)); }
TEST(DriverSweep, OneFailedTransfer_OneEncoder) {
  sweep(failures, setups({Bus::kOne}), drawn(240));
}
TEST(DriverSweep, OneFailedTransfer_OtherBuses) {
  sweep(failures, setups(kOthers, {false}), drawn(240));
}
TEST(DriverSweep, OneFailedTransfer_ControlCalls) { sweep(failures, control_setups(), drawn(240)); }

// ---- The table of docs/driver.md
// -----------------------------------------------------------------

// Lines of the table, of all cases of a part of the setups that runs in a minute: each bit for
// poll_slave(), and each failed transfer for one way to read of each kind.
std::string table() {
  Tally tally;
  const auto all = [&tally](Faults faults, const Setup& setup) {
    Rig rig(setup);
    for (const MeanFault& fault : faults(transfers(rig, setup))) {
      run(rig, {setup, fault}, 20, tally);
    }
  };
  for (unsigned check = 0; check < 4; ++check) {
    Setup setup;
    setup.check = static_cast<SpiCheck>(check);
    all(flips, setup);
    for (const Way way : {Way::kReadFrame, Way::kPollSlave, Way::kPlanSlave, Way::kC99}) {
      setup.way = way;
      all(failures, setup);
    }
    setup.bus = Bus::kTwo;
    for (const Way way : {Way::kPlanReadAll, Way::kPlan}) {
      setup.way = way;
      all(failures, setup);
    }
  }
  std::string text =
      "| one fault | `kOff` | `kCrc` | `kFull` | `kFullAndRelease` |\n|---|---|---|---|---|\n";
  for (unsigned kind = 1; kind < kMeanKinds; ++kind) {
    text += std::string("| ") + to_string(static_cast<MeanKind>(kind));
    for (unsigned check = 0; check < 4; ++check) {
      const auto& counts =
          tally.verdicts[{static_cast<MeanKind>(kind), static_cast<SpiCheck>(check)}];
      std::uint64_t sum = 0;
      std::string what;
      for (unsigned i = kVerdicts; i-- > 0;) {
        sum += counts[i];
        if (i < static_cast<unsigned>(Verdict::kHidden) || counts[i] == 0) continue;
        what += (what.empty() ? "" : ", ") + std::to_string(counts[i]) + " " +
                to_string(static_cast<Verdict>(i));
      }
      text += " | " + (what.empty() ? "0" : what) + " of " + std::to_string(sum);
    }
    text += " |\n";
  }
  return text;
}

TEST(DriverSweep, Table_IsThatOfThePage) {
  const std::string made = table();
  std::ifstream file(MB4_MANUAL);
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find("\n\n" + made + "\n"), std::string::npos)
      << "docs/driver.md has another table. It is now:\n"
      << made;
}

}  // namespace
