// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Evaluates the model without tracing for VerilatedChip. The result is that of PlainSteps, with
// less work.
//
// For one clock, eval() of Verilator 5 needs more time to find out what has changed than to compute
// the chip's logic. It computes all logic that depends on the inputs. It looks for edges of every
// clock and reset of the chip three times or more. It does the same at falling edges of CLK, where
// only a few flops act. Here the change is known: an edge of CLK. So only those statements of the
// model run that such an edge starts and that read something that has changed
// (sim/model/parts/model_parts.py). A falling edge costs nothing if it would leave its flops
// unchanged.
//
// An edge of a host pin runs only the host's logic. The core sees it if something changes that an
// edge of CLK reads.
//
// A chip is at rest if a clock leaves every bit of it unchanged. Then any number of clocks leaves
// it unchanged. Only the time to the next frame (AGS) may move, and this class advances it.
//
// There are three ways to run such an edge (chip_edges.hpp), of which one is in use: for MA slow
// against the clock, for a second line that rests, and for all the rest. A change of the way
// computes the whole chip once, so it comes seldom.
//
// This relies on how Verilator 5.006 (Debian 12) writes a model. With another version fast_chip.cpp
// uses PlainSteps. tests/chip/random/lockstep_test.cpp compares both.
#ifndef MB4SIM_MB4_DIRECT_STEPS_HPP_
#define MB4SIM_MB4_DIRECT_STEPS_HPP_

#include <Vmb4_chip.h>
#include <Vmb4_chip___024root.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "chip_edges.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"
#include "sim/model/model_rest.hpp"

namespace mb4::sim {

class DirectSteps {
 public:
  // This Verilator's model can be taken apart.
  static bool possible() { return edges_of_one_line() != nullptr; }

  // Any inputs have changed.
  void inputs(Vmb4_chip& model) {
    model.eval();
    late_ = false;
    edges_->all(*model.rootp);
  }
  // Pins of the host have changed. Returns false if no output has changed, and nothing that the
  // next edge of CLK reads.
  bool host(Vmb4_chip& model) {
    if (!on_clk(*model.rootp)) {
      inputs(model);
      return true;
    }
    take_sl(*model.rootp);
    return edges_->host(*model.rootp);
  }
  // SL1 or SL2 has changed and no other input. SL is not a clock, and no output depends on it
  // before the next clock edge. So the change waits for that edge.
  void sl(Vmb4_chip& /*model*/) { late_ = true; }

  // CLK falls. Returns false if the edge must be evaluated.
  bool falls_idly(Vmb4_chip& model) {
    Root& root = *model.rootp;
    if (!on_clk(root) || fall_matters(root)) return false;
    set_clock(root, false);
    return true;
  }
  // CLK rises or falls and no other input changes.
  void clk(Vmb4_chip& model, bool level) {
    Root& root = *model.rootp;
    root.clk_i = level;
    if (!on_clk(root)) {  // the chip runs on another clock, or is changing to one
      inputs(model);
      return;
    }
    take_sl(root);
    if (level) {
      if (--to_choice_ == 0) choose(root);
      edges_->rise(root);
    } else {
      edges_->fall(root);
    }
    set_clock(root, level);
  }

  // Stores the state of the chip before a rising edge of CLK.
  void mark(Vmb4_chip& model) {
    // The edge is taken ahead only if CLK is the system clock. Otherwise eval() must see the edge.
    if (on_clk(*model.rootp)) set_clock(*model.rootp, true);
    before_.set(*model.rootp);
  }
  // Called after this edge. Returns true if it has changed nothing except the time to the next
  // frame, and if the falling edge will change nothing. This stays true for rest_left() clocks, up
  // to a change that the chip sees at an edge of CLK.
  bool at_rest(const Vmb4_chip& model) {
    const Root& root = *model.rootp;
    if (!on_clk(root) || fall_matters(root)) return false;
    counting_ = before_.moved(root, root.*kPre) || before_.moved(root, root.*kStep);
    before_.ignore(root, root.*kPre);
    before_.ignore(root, root.*kStep);
    if (!before_.same(root)) return false;
    // The host may have made the rate faster while the count was past the new last step. Such a
    // count goes on to the highest number that its flops hold; no clock of it is left out.
    return !counting_ || (root.*kPre < step_clocks(root) && root.*kStep <= last_step(root));
  }
  std::uint64_t rest_left(const Vmb4_chip& model) const {
    const Root& root = *model.rootp;
    if (!counting_) return std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t last = (last_step(root) + 1) * step_clocks(root) - kMargin;
    return std::max(elapsed(root), last) - elapsed(root);
  }
  // The chip is at rest, and CLK has an edge. Returns false if the edge must be evaluated.
  bool rests(Vmb4_chip& model, bool level) {
    if (level && leave_out(model, 1) == 0) return false;
    set_clock(*model.rootp, level);
    return true;
  }
  // Makes `clocks` clocks pass, or a few less. Returns their number. The end of a step changes more
  // than a count, and the logic that depends on it is computed shortly before. So no clock near
  // that end is left out.
  std::uint64_t leave_out(Vmb4_chip& model, std::uint64_t clocks) {
    Root& root = *model.rootp;
    if (!counting_) return clocks;
    const std::uint64_t latest = step_clocks(root) - kMargin;
    if (root.*kPre > latest) return 0;
    if ((elapsed(root) + clocks) % step_clocks(root) > latest) {
      clocks -= std::min<std::uint64_t>(clocks, kMargin);
    }
    const std::uint64_t after = elapsed(root) + clocks;
    root.*kStep = static_cast<CData>(after / step_clocks(root));
    root.*kPre = static_cast<SData>(after % step_clocks(root));
    edges_->time_passed();
    return clocks;
  }

 private:
  using Root = Vmb4_chip___024root;

  static constexpr std::uint64_t kMargin = 4;
  static constexpr unsigned kSlow = 3;      // clocks of half an MA period
  static constexpr unsigned kChoice = 512;  // clocks between two choices
  static constexpr unsigned kAlone = 16;    // choices without line 2 until it counts as resting

  static constexpr auto kSampled1 =
      &Root::
          mb4_chip__DOT__u_engine__DOT__u_lines__DOT__gen_line__BRA__0__KET____DOT__u_line__DOT__u_sampler__DOT__u_capture__DOT__neg1_q;
  static constexpr auto kSampled2 =
      &Root::
          mb4_chip__DOT__u_engine__DOT__u_lines__DOT__gen_line__BRA__1__KET____DOT__u_line__DOT__u_sampler__DOT__u_capture__DOT__neg1_q;
  // The time to the next frame: the clocks of the current step, the steps, and its rate.
  static constexpr auto kPre =
      &Root::mb4_chip__DOT__u_engine__DOT__u_control__DOT__u_request__DOT__pre_q;
  static constexpr auto kStep =
      &Root::mb4_chip__DOT__u_engine__DOT__u_control__DOT__u_request__DOT__step_q;
  static constexpr auto kFreqags =
      &Root::mb4_chip__DOT__u_engine__DOT__u_regs__DOT__u_cfg__DOT__freqags_q;

  // Computes what depends on SL, if it has changed.
  void take_sl(Root& root) {
    if (std::exchange(late_, false)) edges_->sl(root);
  }
  // Takes the edges that fit what runs.
  [[gnu::noinline]] void choose(const Root& root) {
    to_choice_ = kChoice;
    const unsigned clocks =
        half_ma_clocks(root.mb4_chip__DOT__u_engine__DOT__u_lines__DOT__u_timebase__DOT__len_q);
    const bool second =
        (root.mb4_chip__DOT__u_engine__DOT__u_control__DOT__u_sequencer__DOT__use_q & 2U) != 0;
    alone_ = second ? 0 : std::min(alone_ + 1, kAlone);
    ChipEdges* const wanted = clocks >= kSlow    ? slow_ma_.get()
                              : alone_ == kAlone ? one_line_.get()
                                                 : both_lines_.get();
    if (wanted == edges_) return;
    edges_ = wanted;
    edges_->all(root);
  }
  // CLK and the system clock. eval() must not find an edge that has been handled.
  static void set_clock(Root& root, bool level) {
    root.clk_i = root.mb4_chip__DOT__clk = level;
    root.__Vtrigrprev__TOP__clk_i = root.__Vtrigrprev__TOP__mb4_chip__DOT__clk = level;
  }
  // True if CLK is the system clock.
  static bool on_clk(const Root& root) {
    return root.mb4_chip__DOT__u_clk_mux__DOT__en0_q != 0 &&
           root.mb4_chip__DOT__u_clk_mux__DOT__en1_q == 0;
  }
  // True if a falling edge would change a flop. Such flops are in the clock switch and in the
  // samplers of SL (enc_clk_mux, biss_sl_capture). A lint test checks that there are no others.
  static bool fall_matters(const Root& root) {
    const unsigned paired = root.mb4_chip__DOT__paired;
    const unsigned sl1 = root.sl1_i | (paired & (root.sl2_i ^ 1U));
    const unsigned sl2 = root.sl2_i | paired;
    return root.mb4_chip__DOT__u_clk_mux__DOT__ready0_q == 0 || root.*kSampled1 != sl1 ||
           root.*kSampled2 != sl2;
  }

  static unsigned last_step(const Root& r) { return (r.*kFreqags) & 0x7FU; }
  static std::uint64_t step_clocks(const Root& r) {
    return ((r.*kFreqags) & 0x80U) != 0 ? 625 : 20;
  }
  static std::uint64_t elapsed(const Root& r) { return r.*kStep * step_clocks(r) + r.*kPre; }

  const std::unique_ptr<ChipEdges> one_line_ = edges_of_one_line();
  const std::unique_ptr<ChipEdges> both_lines_ = edges_of_both_lines();
  const std::unique_ptr<ChipEdges> slow_ma_ = edges_of_slow_ma();
  ChipEdges* edges_ = one_line_.get();
  unsigned alone_ = kAlone;       // choices since a frame used line 2
  unsigned to_choice_ = kChoice;  // clocks
  bool late_ = false;             // SL has changed
  bool counting_ = false;
  StateMark<Root> before_;  // a rising edge of CLK
};

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_DIRECT_STEPS_HPP_
