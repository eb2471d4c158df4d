// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The master's pins of a clocked line, MA and MO, and the guard of MA's pulses in a simulation.
#ifndef MB4SIM_CLOCKED_END_HPP_
#define MB4SIM_CLOCKED_END_HPP_

#include <string>

#include "sim/core/time.hpp"
#include "sim/lines/clocked/ma_pulse_check.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {

// The bits that a master drives on a clocked line.
inline constexpr unsigned kMaPin = 1;
inline constexpr unsigned kMoPin = 2;

// Ends the simulation at a pulse of MA that is too short. Without a master it guards nothing.
class MaGuard {
 public:
  void attach(LineMaster& master, unsigned index) {
    master_ = &master;
    index_ = index;
  }
  [[gnu::always_inline]] void drive(Time now, unsigned levels) {
    const bool ma = (levels & kMaPin) != 0;
    if (ma == ma_) return;
    ma_ = ma;
    if (master_ == nullptr) return;
    // A pin that follows another one has no pulses of its own.
    if (follows_) {
      check_.restart(ma);
      return;
    }
    MasterClock& clock = master_->clock();
    const std::string* violation =
        check_.edge(now, ma, clock.cycles(), clock.half_clocks(index_), clock.min_clock());
    const bool cut = clock.take_cut(index_, kMaPin);
    if (violation != nullptr) broken(*violation, cut);
  }
  void follow(bool follows, unsigned levels) {
    if (follows == follows_) return;
    follows_ = follows;
    check_.restart((levels & kMaPin) != 0);
  }
  MaPulseCheck& check() { return check_; }

 private:
  [[gnu::noinline]] void broken(const std::string& violation, bool cut) {
    if (!cut) master_->stop("MA" + std::to_string(index_ + 1) + ": " + violation);
    check_.count_cut();
  }

  LineMaster* master_ = nullptr;
  unsigned index_ = 0;
  bool ma_ = true;
  bool follows_ = false;
  MaPulseCheck check_;
};

// A channel of the master that the scenario does not have: nothing but the guard.
class ClockedOpenEnd final : public LineEnd {
 public:
  ClockedOpenEnd(LineMaster& master, unsigned index) { guard_.attach(master, index); }
  void drive(Time now, unsigned levels) override { guard_.drive(now, levels); }
  void follow(bool follows, unsigned levels) override { guard_.follow(follows, levels); }
  MaGuard& guard() { return guard_; }

 private:
  MaGuard guard_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_CLOCKED_END_HPP_
