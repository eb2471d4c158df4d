// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Evaluates a model for VerilatedChip by eval() alone, whatever has changed.
#ifndef MB4SIM_MB4_PLAIN_STEPS_HPP_
#define MB4SIM_MB4_PLAIN_STEPS_HPP_

#include <cstdint>

namespace mb4::sim {

template <typename Model>
class PlainSteps {
 public:
  // Any inputs have changed.
  void inputs(Model& model) { model.eval(); }
  // Pins of the host have changed. Returns false if the next edge of CLK sees no change.
  bool host(Model& model) {
    model.eval();
    return true;
  }
  // SL1 or SL2 has changed and no other input.
  void sl(Model& model) { model.eval(); }
  // CLK rises or falls and no other input changes.
  void clk(Model& model, bool level) {
    model.clk_i = level;
    model.eval();
  }
  // This class leaves out no edges.
  bool falls_idly(const Model& /*model*/) const { return false; }
  void mark(const Model& /*model*/) {}
  bool at_rest(const Model& /*model*/) const { return false; }
  bool rests(Model& /*model*/, bool /*level*/) { return false; }
  std::uint64_t rest_left(const Model& /*model*/) const { return 0; }
  std::uint64_t leave_out(Model& /*model*/, std::uint64_t clocks) { return clocks; }
};

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_PLAIN_STEPS_HPP_
