// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/event_queue.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace mb4::sim {

void EventQueue::post(Time time, Handler handler, void* receiver, std::uint64_t word) {
  heap_.push_back({time, sequence_++, handler, receiver, word});
  std::push_heap(heap_.begin(), heap_.end(), Later{});
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
  assert(!heap_.empty());
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
