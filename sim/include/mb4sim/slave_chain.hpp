// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The slaves of one line: MA goes to all of them at once, SLO of each to SLI of the next one
// nearer to the master. Slave 1 is the nearest. MO (or a constant 0) is SLI of the farthest.
#ifndef MB4SIM_SLAVE_CHAIN_HPP_
#define MB4SIM_SLAVE_CHAIN_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mb4sim/event_queue.hpp"
#include "mb4sim/slave.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

class SlaveChain {
 public:
  // Called when SLO of slave 1 changes, and when the last slave times out with SLO = 1 as before.
  using Output = void (*)(Time now, void* receiver, bool slo);

  SlaveChain(EventQueue& queue, Output output, void* receiver)
      : queue_(queue), output_(output), receiver_(receiver) {}
  SlaveChain(const SlaveChain&) = delete;
  SlaveChain& operator=(const SlaveChain&) = delete;

  // Appends the next slave away from the master. Not while a frame runs.
  void add(std::unique_ptr<Slave> slave);

  // Levels of MA and MO as they arrive at the slaves, both at once.
  void drive(Time now, bool ma, bool mo);
  // Slave `index` (0 = slave 1) and those behind it are unplugged: they see MA = 1, time out and
  // idle; the last one left sees SLI = 1. size(): all are plugged in.
  void detach(Time now, std::size_t index);
  // Looks again at SlaveFaults.
  void refresh(Time now);

  std::size_t size() const { return slaves_.size(); }
  // index 0 = slave 1.
  Slave& slave(std::size_t index) { return *slaves_[index]; }
  const Slave& slave(std::size_t index) const { return *slaves_[index]; }
  // Level of SLO of slave 1; without slaves the pull-up's 1.
  bool slo() const { return attached_ == 0 || slo_of(0); }
  bool ma() const { return ma_; }
  bool mo() const { return mo_; }
  // All slaves have timed out.
  bool idle() const { return idle_; }

 private:
  static void on_timer(Time now, void* receiver, std::uint64_t word);
  bool slo_of(std::size_t index) const {
    return slaves_[index]->slo() || slaves_[index]->faults().silent;
  }
  bool sli_of(std::size_t index) const {
    if (index + 1 == attached_) return end_level(mo_);
    return index + 1 < slaves_.size() ? slo_of(index + 1) : mo_;
  }
  // SLI of the last slave that is plugged in.
  bool end_level(bool mo) const { return mo || attached_ < slaves_.size(); }
  void drive_slaves(Time now, bool ma, bool mo);
  void settle_sli(Time now);
  void finish(Time now);

  EventQueue& queue_;
  Output output_;
  void* receiver_;
  std::vector<std::unique_ptr<Slave>> slaves_;
  std::size_t attached_ = 0;  // slaves from here on are unplugged
  bool ma_ = true;
  bool mo_ = false;
  bool idle_ = true;
  bool reported_ = true;
  Time armed_at_ = kNever;  // time of the timer event that counts; later ones are stale
};

}  // namespace mb4::sim

#endif  // MB4SIM_SLAVE_CHAIN_HPP_
