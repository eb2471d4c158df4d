// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The master of one line with its clock: what the simulator runs. No RTL is behind it.
//
// Clock domain: one clock, whose edges take the level of the line and move its pins. A frequency of
// 0 stops it.
#ifndef MB4SIM_DSL_MODEL_LINK_MODEL_HPP_
#define MB4SIM_DSL_MODEL_LINK_MODEL_HPP_

#include <cstdint>

#include "sim/core/time.hpp"
#include "sim/masters/dsl_model/link.hpp"
#include "sim/masters/master_model.hpp"

namespace mb4::sim::dsl_model {

class LinkModel final : public MasterModel {
 public:
  // Bits of the line: level to send, driver on (sim/lines/duplex/).
  static constexpr unsigned kOut = 1;
  static constexpr unsigned kEnable = 2;

  // The first edge of the clock is at `start`.
  LinkModel(const LinkRules& rules, std::uint64_t hz, Time start);

  Time run_clocks(Time limit) override;
  void set_inputs(Time /*now*/, unsigned line, unsigned levels) override {
    if (line == 0) in_ = (levels & 1U) != 0;
  }
  void set_clock(Time now, std::uint64_t hz) override;
  unsigned half_clocks(unsigned /*line*/) const override { return kTicksPerBit / 2; }

  Link& link() { return link_; }
  // Of an edge that has been, as LinkFrame::sampled counts them, at the present frequency, or at
  // that before the clock stopped.
  Time time_of(std::uint64_t tick) const;

 private:
  void pass(std::uint64_t edges);

  Link link_;
  std::uint64_t hz_;
  Time next_;  // edge
  // What time_of() counts from while the clock stands.
  Time stopped_next_ = 0;
  std::uint64_t stopped_hz_ = 0;
  // A period is no whole number of ps: what is left of it, in parts of 1 / hz.
  std::uint64_t rest_ = 0;
  bool in_ = true;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_LINK_MODEL_HPP_
