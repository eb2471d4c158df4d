// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "watched_chip.hpp"

#include <stdexcept>
#include <utility>

namespace mb4::sim {

WatchedChip::WatchedChip(std::unique_ptr<ChipModel> chip, std::unique_ptr<ChipModel> traced)
    : chip_(std::move(chip)), traced_(std::move(traced)) {
  take();
}

WatchedChip::~WatchedChip() = default;

std::unique_ptr<ChipModel> WatchedChip::release() {
  traced_.reset();
  return std::move(chip_);
}

// The chip's answers are those of this model. A traced model that answers otherwise would show what
// never was.
void WatchedChip::take() {
  outputs_ = chip_->outputs();
  followers_ = chip_->followers();
  cycles_ = chip_->cycles();
  min_clock_ = chip_->min_clock();
  if (traced_->outputs() != outputs_ || traced_->db_out() != chip_->db_out()) {
    throw std::logic_error("the waveform's model differs from the chip");
  }
}

// An assertion that stops the chip stops the traced model too, which then shows what led to it.
template <typename Step, typename Follow>
void WatchedChip::both(Step step, Follow follow) {
  try {
    step();
  } catch (...) {
    try {
      follow();
    } catch (...) {
    }
    throw;
  }
  follow();
  take();
}

Time WatchedChip::run_clocks(Time limit) {
  Time changed = kNever;
  const auto follow = [&] {
    const Time end = changed == kNever ? limit : changed;
    while (traced_->run_clocks(end) != kNever) {
    }
  };
  both([&] { changed = chip_->run_clocks(limit); }, follow);
  return changed;
}

template <typename Change>
void WatchedChip::change(Change change) {
  both([&] { change(*chip_); }, [&] { change(*traced_); });
}

void WatchedChip::set_input(Time now, Pin pin, bool level) {
  change([&](ChipModel& chip) { chip.set_input(now, pin, level); });
}

void WatchedChip::set_inputs(Time now, unsigned line, unsigned levels) {
  change([&](ChipModel& chip) {
    chip.drive_pair(drives_pair_);
    chip.set_inputs(now, line, levels);
  });
}

void WatchedChip::set_clock(Time now, std::uint64_t hz) {
  change([&](ChipModel& chip) { chip.set_clock(now, hz); });
}

}  // namespace mb4::sim
