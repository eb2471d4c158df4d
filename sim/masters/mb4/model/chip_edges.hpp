// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The edges of the chip in parts (sim/model/parts/README.md), made three times. They differ in what
// the build has found busy, so each is the fastest in its own kind of run; the results are the
// same.
#ifndef MB4SIM_MB4_CHIP_EDGES_HPP_
#define MB4SIM_MB4_CHIP_EDGES_HPP_

#include <memory>

class Vmb4_chip___024root;  // of Verilator

namespace mb4::sim {

// Keeps what has changed in one model. Each change is told to it, or all() before its next use.
class ChipEdges {
 public:
  using Root = Vmb4_chip___024root;

  ChipEdges() = default;
  ChipEdges(const ChipEdges&) = delete;
  ChipEdges& operator=(const ChipEdges&) = delete;
  virtual ~ChipEdges() = default;

  // Anything may have changed.
  virtual void all(const Root& root) = 0;
  // The system clock rises, or falls.
  virtual void rise(Root& root) = 0;
  virtual void fall(Root& root) = 0;
  // Pins of the host have changed. Returns false if no output has changed, and nothing that the
  // next edge of CLK reads.
  virtual bool host(Root& root) = 0;
  // SL has changed: computes what depends on it before the next edge.
  virtual void sl(Root& root) = 0;
  // The time to the next frame has been set forward.
  virtual void time_passed() = 0;
};

// nullptr: the model cannot be taken apart (chip_edges.cpp).
std::unique_ptr<ChipEdges> edges_of_one_line();    // line 2 rests
std::unique_ptr<ChipEdges> edges_of_both_lines();  // both run, with a register access
std::unique_ptr<ChipEdges> edges_of_slow_ma();     // a half period of MA has several clocks

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_CHIP_EDGES_HPP_
