// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The events of one simulator in order of time. Events of the same time run in the order in which
// they were posted. So a run never depends on addresses or on a hash.
#ifndef MB4SIM_EVENT_QUEUE_HPP_
#define MB4SIM_EVENT_QUEUE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::sim {

class EventQueue {
 public:
  // An event calls this with its time, and with the receiver and the word given to post().
  using Handler = void (*)(Time now, void* receiver, std::uint64_t word);

  // The fast form. It allocates no memory once the queue has grown. The receiver must outlive the
  // event. A time in the past is an error of the caller (asserted).
  void post(Time time, Handler handler, void* receiver, std::uint64_t word = 0);

  // Moves the next event to a later time if it has this handler and this receiver. It then comes
  // after all events of that time, as if it had been posted now. Returns false otherwise.
  bool postpone(Time time, Handler handler, void* receiver) {
    if (!heap_.empty() || few_size_ == 0) return false;
    const Event& next = few_[few_size_ - 1];
    if (next.handler != handler || next.receiver != receiver) return false;
    --few_size_;
    insert({time, sequence_++, handler, receiver, 0});
    return true;
  }

  // The convenient form for tests and scripts.
  void post(Time time, std::function<void()> callback);

  bool empty() const { return size() == 0; }
  std::size_t size() const { return few_size_ + heap_.size(); }
  // Time of the earliest event, or kNever without an event.
  Time next_time() const {
    const Time few = few_size_ == 0 ? kNever : few_[few_size_ - 1].time;
    return heap_.empty() || few < heap_.front().time ? few : heap_.front().time;
  }
  // Removes and runs the earliest event. The queue must not be empty. The handler may post.
  void run_next();

 private:
  struct Event {
    Time time;
    std::uint64_t sequence;
    Handler handler;
    void* receiver;
    std::uint64_t word;
  };
  struct Later {
    bool operator()(const Event& a, const Event& b) const {
      return a.time != b.time ? a.time > b.time : a.sequence > b.sequence;
    }
  };
  static constexpr std::size_t kFew = 16;
  bool few_is_next() const;
  // `event` has been posted last, so events of the same time run before it.
  void insert(const Event& event) {
    std::size_t at = few_size_++;
    for (; at > 0 && few_[at - 1].time <= event.time; --at) few_[at] = few_[at - 1];
    few_[at] = event;
  }
  void to_heap(const Event& event);
  static void run_callback(Time now, void* receiver, std::uint64_t slot);

  // Usually there are few events, and new ones are due soon. `few_` holds these in a sorted row,
  // the earliest one last. An event that finds no room in it goes into the heap.
  std::array<Event, kFew> few_;
  std::size_t few_size_ = 0;
  std::vector<Event> heap_;
  std::uint64_t sequence_ = 0;
  std::vector<std::function<void()>> callbacks_;  // by slot; free slots hold nothing
  std::vector<std::uint64_t> free_slots_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_EVENT_QUEUE_HPP_
