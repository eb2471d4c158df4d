// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The slaves of one line. MA goes to all of them at once. SLO of each slave goes to SLI of the next
// slave towards the master. Slave 1 is the nearest to the master. SLI of the farthest slave is MO
// or a constant 0.
#ifndef MB4SIM_SLAVE_CHAIN_HPP_
#define MB4SIM_SLAVE_CHAIN_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/core/event_queue.hpp"
#include "sim/core/time.hpp"
#include "sim/lines/clocked/bit_row.hpp"
#include "sim/lines/clocked/clocked_slave.hpp"

namespace mb4::sim {

class SlaveChain {
 public:
  // Called when SLO of slave 1 changes. Also called when the last slave times out and SLO stays 1.
  using Output = void (*)(Time now, void* receiver, bool slo);

  SlaveChain(EventQueue& queue, Output output, void* receiver)
      : queue_(queue), output_(output), receiver_(receiver) {}
  SlaveChain(const SlaveChain&) = delete;
  SlaveChain& operator=(const SlaveChain&) = delete;

  // Appends a slave at the end away from the master. Must not be called while a frame runs.
  void add(std::unique_ptr<ClockedSlave> slave);

  // Sets the levels of MA and MO as they arrive at the slaves. Both change at once.
  void drive(Time now, bool ma, bool mo);
  // True in the data of a frame, which is the longest part of a frame, if nothing disturbs it.
  // There shift() does what drive() does when MA changes, without a call of the output. It returns
  // SLO.
  bool shifting() const { return shifting_; }
  bool shift(Time now, bool ma, bool mo) {
    last_edge_ = now;
    deadline_ = now + timeout_;
    if (armed_at_ == now) postpone();
    if (ma) {
      if (row_.full()) fill_row();
      reported_ = row_.shift(mo_ && takes_mo_);
    }
    ma_ = ma;
    mo_ = mo;
    return reported_;
  }
  // Unplugs slave `index` (0 = slave 1) and those behind it: they see MA = 1, time out and become
  // idle. The last slave that is left sees SLI = 1. With index = size() all slaves are plugged in.
  void detach(Time now, std::size_t index);
  // Applies a changed SlaveFault.
  void refresh(Time now);

  std::size_t size() const { return slaves_.size(); }
  // Number of slaves that are plugged in.
  std::size_t attached() const { return attached_; }
  // `index` 0 is slave 1.
  ClockedSlave& slave(std::size_t index) { return *slaves_[index]; }
  const ClockedSlave& slave(std::size_t index) const { return *slaves_[index]; }
  // Level of SLO of slave 1. Without slaves it is 1, from the pull-up.
  bool slo() const {
    if (shifting_) return reported_;
    return attached_ == 0 || slo_of(0);
  }
  bool ma() const { return ma_; }
  bool mo() const { return mo_; }
  // True when all slaves have timed out.
  bool idle() const { return idle_; }

 private:
  static void on_timer(Time now, void* receiver, std::uint64_t word);
  bool slo_of(std::size_t index) const { return slaves_[index]->slo() || slaves_[index]->silent(); }
  bool sli_of(std::size_t index) const {
    if (index + 1 == attached_) return end_level(mo_);
    return index + 1 < slaves_.size() ? slo_of(index + 1) : mo_;
  }
  // Level of SLI of the last slave that is plugged in.
  bool end_level(bool mo) const { return mo || attached_ < slaves_.size(); }
  // The common state of all slaves.
  struct Standing {
    Time deadline = kNever;  // the earliest
    bool idle = true;
    bool shifting = true;
    void add(const ClockedSlave& slave) {
      deadline = slave.deadline() < deadline ? slave.deadline() : deadline;
      idle = idle && slave.idle();
      shifting = shifting && slave.shifting() != nullptr;
    }
  };
  Standing drive_slaves(Time now, bool ma, bool mo);
  void swap_words();
  bool in_one_row() const;
  void fill_row();
  void empty_row();
  void catch_up();
  Standing settle_sli(Time now);
  void finish(Time now, const Standing& standing);
  void arm();
  void postpone();
  void report(Time now);

  EventQueue& queue_;
  Output output_;
  void* receiver_;
  std::vector<std::unique_ptr<ClockedSlave>> slaves_;
  std::size_t attached_ = 0;  // slaves from this index on are unplugged
  bool ma_ = true;
  bool mo_ = false;
  bool idle_ = true;
  Time deadline_ = kNever;  // the earliest deadline of the slaves
  Time armed_at_ = kNever;  // time of the timer event that is valid; later ones are stale
  bool shifting_ = false;   // all slaves shift in one row; catch_up() tells them
  Time timeout_ = 0;        // shifting: the shortest timeout, from each edge of MA on
  Time last_edge_ = 0;      // shifting: last edge of MA
  bool reported_ = true;
  bool takes_mo_ = false;  // the last slave takes bits from MO
  BitRow row_;             // shifting: the registers of all slaves, if not full
};

}  // namespace mb4::sim

#endif  // MB4SIM_SLAVE_CHAIN_HPP_
