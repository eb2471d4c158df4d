// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/receiver.hpp"

#include <algorithm>

namespace mb4::sim::dsl_model {
namespace {

constexpr unsigned kSlot10 = 10;

}  // namespace

// The edges of a slot stand in a ring. The largest distance between two neighbours counts.
unsigned rssi_of(std::uint8_t edges, bool table) {
  unsigned largest = 0;
  unsigned found = 0;
  int last = -1;
  int first = -1;
  for (int i = 0; i < 8; ++i) {
    if ((edges >> i & 1) == 0) continue;
    ++found;
    if (first < 0) first = i;
    if (last >= 0) largest = std::max(largest, static_cast<unsigned>(i - last));
    last = i;
  }
  if (found <= 1) return Receiver::kBestRssi;
  largest = std::max(largest, static_cast<unsigned>(first + 8 - last));
  if (largest <= 2) return table ? Receiver::kBestRssi : 0;
  return 2 * (largest - 2);
}

void Receiver::forget() {
  learning_ = false;
  place_ = 0;
  sample_ = 0;
  edges_ = 0;
  frame_rssi_ = kBestRssi;
}

unsigned Receiver::place_of_bit() const {
  return rule_ == SampleRule::kTracking ? (place_ >> kFraction) + 4 : sample_;
}

Answer Receiver::bits_from(unsigned sample) const {
  Answer answer = 0;
  for (unsigned i = 0; i < kAnswerBits; ++i) {
    const unsigned at = sample + 8 * i;
    answer = answer << 1U | (at < kSamples && samples_[at] ? 1U : 0U);
  }
  return answer;
}

std::optional<unsigned> Receiver::first_zero() const {
  const auto found = std::find(samples_.begin(), samples_.end(), false);
  if (found == samples_.end()) return std::nullopt;
  return static_cast<unsigned>(found - samples_.begin());
}

bool Receiver::learn() {
  if (rule_ != SampleRule::kTracking) return learn_by_search();
  if (learning_) {
    if (!fits()) return false;
    const bool same = bits_from(place_of_bit()) == kTestPattern;
    track(Window::kTraining);
    return same && fits();
  }
  learning_ = true;
  const auto zero = first_zero();
  if (!zero) return false;
  // This edge may have come early or late. If it is half a bit away from others, these count to the
  // wrong bit; so the same edges are measured again from the place that they have given.
  place_ = *zero << kFraction;
  track(Window::kTraining);
  track(Window::kTraining);
  return fits();
}

// Each START frame is searched anew.
bool Receiver::learn_by_search() {
  const auto zero = first_zero();
  if (!zero) return false;
  const unsigned slot = *zero / 8;
  unsigned edge = *zero % 8;
  if (rule_ == SampleRule::kPublished) {
    edge = static_cast<unsigned>(
        std::count(samples_.begin() + slot * 8, samples_.begin() + slot * 8 + 8, true));
  }
  unsigned eighth = (4 + edge) % 8;
  if (rule_ == SampleRule::kPublished && slot == kSlot10 && edge >= 4) eighth = 7;
  for (unsigned offset = kMinDelay; offset <= kMaxDelay; ++offset) {
    if (bits_from(8 * offset + eighth) != kTestPattern) continue;
    sample_ = 8 * offset + eighth;
    return true;
  }
  return false;
}

bool Receiver::matches() {
  if (!fits()) return false;
  const bool same = bits_from(place_of_bit()) == kTestPattern;
  for (unsigned slot = delay(); slot < delay() + kAnswerBits && slot < kSlots; ++slot) {
    edges_ |= edges_of(slot);
  }
  if (rule_ == SampleRule::kTracking) track(Window::kTraining);
  return same && fits();
}

Answer Receiver::answer(bool linked) {
  const Answer answer = bits_from(place_of_bit());
  frame_rssi_ = kBestRssi;
  for (unsigned slot = delay(); slot < delay() + kAnswerBits && slot < kSlots; ++slot) {
    frame_rssi_ = std::min(frame_rssi_, rssi_of(edges_of(slot), rssi_table_));
  }
  if (rule_ == SampleRule::kTracking) track(linked ? Window::kLinked : Window::kIdentity);
  return answer;
}

// The first sample of a slot is compared with the last one of the slot before.
std::uint8_t Receiver::edges_of(unsigned slot) const {
  unsigned edges = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const unsigned at = slot * 8 + i;
    const bool edge = at != 0 && samples_[at] != samples_[at - 1];
    edges |= (edge ? 1U : 0U) << i;
  }
  return static_cast<std::uint8_t>(edges);
}

// An edge belongs to the nearest begin of a bit.
void Receiver::track(Window window) {
  constexpr int kOne = 1 << kFraction;
  constexpr int kBit = 8 * kOne;
  constexpr int kFewest = 8;
  constexpr int kMost = 64;
  constexpr int kStep = 2 * kOne;  // of a frame, when linked
  const int first = static_cast<int>(place_ >> kFraction) - 3;
  const int end = first + 8 * static_cast<int>(kAnswerBits);
  int sum = 0;
  int count = 0;
  for (int i = std::max(first, 1); i < std::min(end, static_cast<int>(kSamples)); ++i) {
    if (samples_[static_cast<unsigned>(i)] == samples_[static_cast<unsigned>(i) - 1]) continue;
    if (++count > kMost) break;
    const int away = i * kOne - static_cast<int>(place_) + kBit / 2;
    sum += ((away % kBit) + kBit) % kBit - kBit / 2;
  }
  if (count < kFewest) return;
  count = std::min(count, kMost);
  int move = sum / count;
  if (window == Window::kLinked) move = std::clamp(move, -kStep, kStep);
  const int moved = static_cast<int>(place_) + move;
  // The answer stays in the window.
  const int lowest = (static_cast<int>(kMinDelay) * 8 - 4) * kOne;
  const int highest = (static_cast<int>(kMaxDelay) * 8 + 4) * kOne - 1;
  place_ = static_cast<unsigned>(window == Window::kTraining ? std::max(moved, 0)
                                                             : std::clamp(moved, lowest, highest));
}

}  // namespace mb4::sim::dsl_model
