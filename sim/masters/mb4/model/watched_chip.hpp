// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A chip and beside it a traced model of the same chip, for a part of a run. Both see the same
// edges. The simulation goes by the chip alone, so a waveform changes nothing.
#ifndef MB4SIM_MB4_WATCHED_CHIP_HPP_
#define MB4SIM_MB4_WATCHED_CHIP_HPP_

#include <cstdint>
#include <memory>

#include "chip_model.hpp"

namespace mb4::sim {

class WatchedChip final : public ChipModel {
 public:
  // `traced` has the state of `chip` (make_traced_chip()).
  WatchedChip(std::unique_ptr<ChipModel> chip, std::unique_ptr<ChipModel> traced);
  ~WatchedChip() override;

  // Ends the waveform and gives the chip back. Only destruction is left.
  std::unique_ptr<ChipModel> release();

  Time run_clocks(Time limit) override;
  void set_inputs(Time now, unsigned line, unsigned levels) override;
  void set_clock(Time now, std::uint64_t hz) override;
  unsigned half_clocks(unsigned line) const override { return chip_->half_clocks(line); }
  std::uint64_t left_out() const override { return chip_->left_out(); }
  void set_probes(Time now, std::uint64_t ma, std::uint64_t slo, std::uint64_t idle) override {
    traced_->set_probes(now, ma, slo, idle);
  }
  void finish_trace() override { traced_->finish_trace(); }

  Time next_edge() const override { return chip_->next_edge(); }
  void set_input(Time now, Pin pin, bool level) override;
  bool clk() const override { return chip_->clk(); }
  bool sl(unsigned line) const override { return chip_->sl(line); }
  unsigned db_out() const override { return chip_->db_out(); }
  unsigned db_enable() const override { return chip_->db_enable(); }

 private:
  template <typename Step, typename Follow>
  void both(Step step, Follow follow);
  template <typename Change>
  void change(Change change);
  void take();

  std::unique_ptr<ChipModel> chip_;
  std::unique_ptr<ChipModel> traced_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_WATCHED_CHIP_HPP_
