// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/event_queue.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace mb4::sim {

void EventQueue::post(Time time, Handler handler, void* receiver, std::uint64_t word) {
  const Event event{time, sequence_++, handler, receiver, word};
  if (few_size_ < kFew) {
    insert(event);
  } else if (time >= few_[0].time) {
    to_heap(event);
  } else {
    to_heap(few_[0]);
    std::move(few_.begin() + 1, few_.end(), few_.begin());
    --few_size_;
    insert(event);
  }
}

void EventQueue::to_heap(const Event& event) {
  heap_.push_back(event);
  std::push_heap(heap_.begin(), heap_.end(), Later{});
}

bool EventQueue::few_is_next() const {
  return heap_.empty() || (few_size_ != 0 && Later{}(heap_.front(), few_[few_size_ - 1]));
}

void EventQueue::post(Time time, std::function<void()> callback) {
  std::uint64_t slot = callbacks_.size();
  if (free_slots_.empty()) {
    callbacks_.push_back(std::move(callback));
  } else {
    slot = free_slots_.back();
    free_slots_.pop_back();
    callbacks_[slot] = std::move(callback);
  }
  post(time, &EventQueue::run_callback, this, slot);
}

void EventQueue::run_next() {
  assert(!empty());
  if (few_is_next()) {
    const Event event = few_[--few_size_];
    event.handler(event.time, event.receiver, event.word);
    return;
  }
  std::pop_heap(heap_.begin(), heap_.end(), Later{});
  const Event event = heap_.back();
  heap_.pop_back();
  event.handler(event.time, event.receiver, event.word);
}

void EventQueue::run_callback(Time /*now*/, void* receiver, std::uint64_t slot) {
  auto* queue = static_cast<EventQueue*>(receiver);
  const std::function<void()> callback = std::exchange(queue->callbacks_[slot], nullptr);
  queue->free_slots_.push_back(slot);
  callback();
}

}  // namespace mb4::sim
