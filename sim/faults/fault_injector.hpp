// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the faults of a scenario happen, at fixed or at random times, and keeps a record of each.
// If faults of one table overlap, the fault lasts until the last of them is over. If faults of two
// tables do the same at one place, the first end stops both.
#ifndef MB4SIM_FAULT_INJECTOR_HPP_
#define MB4SIM_FAULT_INJECTOR_HPP_

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/core/event_queue.hpp"
#include "sim/core/random.hpp"
#include "sim/core/time.hpp"
#include "sim/core/wire_faults.hpp"
#include "sim/faults/fault.hpp"

namespace mb4::sim {

class FaultTarget;
struct FaultScene;

class FaultInjector {
 public:
  // Posts the first event of each fault. All references must outlive the injector. The injector
  // must exist before time begins. `faults` may grow: add_new() then posts the new ones, whose
  // times must not have passed.
  FaultInjector(FaultTarget& target, EventQueue& queue, const std::vector<FaultConfig>& faults,
                std::uint64_t seed);
  FaultInjector(const FaultInjector&) = delete;
  FaultInjector& operator=(const FaultInjector&) = delete;

  void add_new();

  // The faults so far, in the order in which they began.
  const std::vector<FaultRecord>& records() const { return records_; }

 private:
  struct Source {
    FaultInjector* injector;
    std::size_t config;
    Random random;
    std::vector<std::size_t> lasting;  // records that are not over
    std::vector<WireFaults> was;       // line: faults of each wire without this one
    FaultRecord waiting{};             // of a fault of a named frame that has not come
  };

  static void begin(Time now, void* receiver, std::uint64_t word);
  static void end(Time now, void* receiver, std::uint64_t record);
  static void hit(void* receiver);
  void post_random(Source& source, Time after);
  FaultScene scene(Time now, Source& source, FaultRecord& record) const;
  void remember_cable(Source& source);

  FaultTarget& target_;
  EventQueue& queue_;
  const std::vector<FaultConfig>& faults_;
  std::uint64_t seed_;
  std::vector<std::unique_ptr<Source>> sources_;
  std::vector<FaultRecord> records_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_FAULT_INJECTOR_HPP_
