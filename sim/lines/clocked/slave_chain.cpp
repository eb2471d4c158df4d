// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/slave_chain.hpp"

#include <algorithm>
#include <utility>

namespace mb4::sim {

void SlaveChain::add(std::unique_ptr<ClockedSlave> slave) {
  if (attached_ == slaves_.size()) ++attached_;
  slaves_.push_back(std::move(slave));
}

void SlaveChain::drive(Time now, bool ma, bool mo) {
  if (ma != ma_) {
    catch_up();
    const Standing standing = drive_slaves(now, ma, mo);
    finish(now, standing);
    shifting_ = standing.shifting && !standing.idle && in_one_row();
    timeout_ = standing.deadline - now;
    last_edge_ = now;
  } else if (mo != mo_) {
    catch_up();
    mo_ = mo;
    finish(now, settle_sli(now));
  } else {
    report(now);
  }
}

// One pass from the far slave to the near one. SLI of each slave before the edge is what the slave
// behind it sent until its call.
SlaveChain::Standing SlaveChain::drive_slaves(Time now, bool ma, bool mo) {
  Standing standing;
  bool sli_before = end_level(mo_);
  bool sli = end_level(mo);
  ma_ = ma;
  mo_ = mo;
  for (std::size_t i = slaves_.size(); i-- > attached_;) standing.add(*slaves_[i]);
  for (std::size_t i = attached_; i-- > 0;) {
    ClockedSlave& slave = *slaves_[i];
    const bool slo_before = slo_of(i);
    slave.ma_edge(now, ma, sli_before, sli);
    sli_before = slo_before;
    sli = slo_of(i);
    standing.add(slave);
  }
  if (ma) swap_words();
  return standing;
}

// Where the data begin, Slave::swapped_words() takes effect: the data and CRC of the slave
// behind leave first. Slaves of different length then have another border than the master expects.
void SlaveChain::swap_words() {
  for (std::size_t i = 0; i + 1 < attached_; ++i) {
    ClockedSlave& near = *slaves_[i];
    ClockedSlave& far = *slaves_[i + 1];
    if (!near.swapped_words() || near.shifting() == nullptr || far.shifting() == nullptr ||
        !near.shifting()->loaded() || !far.shifting()->loaded()) {
      continue;
    }
    const ShiftRegister::Bits was_near = near.shifting()->bits();
    const ShiftRegister::Bits was_far = far.shifting()->bits();
    const std::size_t near_size = near.shifting()->size();
    const std::size_t far_size = far.shifting()->size();
    near.set_shifted(ShiftRegister::first(was_far | was_near >> far_size, near_size), 0);
    far.set_shifted(near_size < far_size
                        ? ShiftRegister::first(
                              was_far << near_size | was_near >> (far_size - near_size), far_size)
                        : was_near << (near_size - far_size),
                    0);
  }
}

// True if each bit that leaves a slave comes in at the next one.
bool SlaveChain::in_one_row() const {
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    if (slaves_[i]->silent() || (i != 0 && !slaves_[i - 1]->takes_sli())) return false;
  }
  return !slaves_.empty() && attached_ == slaves_.size();
}

void SlaveChain::fill_row() {
  empty_row();
  row_.restart();
  for (const auto& slave : slaves_)
    row_.append(slave->shifting()->bits(), slave->shifting()->size());
  takes_mo_ = slaves_.back()->takes_sli();
}

// Gives the bits back to the slaves.
void SlaveChain::empty_row() {
  std::size_t place = 0;
  for (std::size_t i = 0; i < slaves_.size() && row_.shifts() != 0; ++i) {
    const std::size_t size = slaves_[i]->shifting()->size();
    slaves_[i]->set_shifted(row_.bits(place, size), row_.shifts());
    place += size;
  }
  row_.stop();
}

// Ends the short way of shift() until the next edge of MA. The slaves learn what they have shifted
// and the time of the last edge.
void SlaveChain::catch_up() {
  if (!shifting_) return;
  shifting_ = false;
  empty_row();
  for (const auto& slave : slaves_) slave->last_edge(last_edge_, ma_);
}

void SlaveChain::detach(Time now, std::size_t index) {
  catch_up();
  const std::size_t before = attached_;
  attached_ = std::min(index, slaves_.size());
  // If MA is 0, slaves that leave see it rise, and slaves that come back see it fall.
  for (std::size_t i = slaves_.size(); !ma_ && i-- > std::min(before, attached_);) {
    slaves_[i]->ma_edge(now, i >= attached_, sli_of(i), sli_of(i));
  }
  refresh(now);
}

void SlaveChain::refresh(Time now) {
  catch_up();
  finish(now, settle_sli(now));
}

SlaveChain::Standing SlaveChain::settle_sli(Time now) {
  Standing standing;
  for (std::size_t i = slaves_.size(); i-- > 0;) {
    slaves_[i]->sli_changed(now, sli_of(i));
    standing.add(*slaves_[i]);
  }
  return standing;
}

void SlaveChain::on_timer(Time now, void* receiver, std::uint64_t /*word*/) {
  auto* chain = static_cast<SlaveChain*>(receiver);
  if (now != chain->armed_at_) return;
  chain->armed_at_ = kNever;
  if (chain->shifting_ && now < chain->deadline_) {
    chain->arm();
    chain->report(now);
    return;
  }
  chain->catch_up();
  auto& slaves = chain->slaves_;
  const bool running = !chain->idle_;
  const bool level = chain->reported_;
  for (std::size_t i = slaves.size(); i-- > 0;) {
    if (slaves[i]->deadline() <= now) slaves[i]->timer(now, chain->sli_of(i));
  }
  chain->finish(now, chain->settle_sli(now));
  // A frame that ends in a bit of 1 has no edge at its end.
  if (running && level && chain->reported_ && chain->idle_) {
    chain->output_(now, chain->receiver_, level);
  }
}

void SlaveChain::finish(Time now, const Standing& standing) {
  idle_ = standing.idle;
  deadline_ = standing.deadline;
  arm();
  report(now);
}

// Keeps one timer event at or before the next deadline. Every edge of MA moves the deadline to a
// later time. The event stays, and on_timer() posts a new one if it came too early.
void SlaveChain::arm() {
  if (deadline_ >= armed_at_) return;
  armed_at_ = deadline_;
  queue_.post(deadline_, &SlaveChain::on_timer, this);
}

// The timer event would come now and would be too early.
void SlaveChain::postpone() {
  if (queue_.postpone(deadline_, &SlaveChain::on_timer, this)) armed_at_ = deadline_;
}

void SlaveChain::report(Time now) {
  if (slo() == reported_) return;
  reported_ = !reported_;
  output_(now, receiver_, reported_);
}

}  // namespace mb4::sim
