// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/slave_chain.hpp"

#include <algorithm>
#include <utility>

namespace mb4::sim {

void SlaveChain::add(std::unique_ptr<Slave> slave) {
  if (attached_ == slaves_.size()) ++attached_;
  slaves_.push_back(std::move(slave));
}

void SlaveChain::drive(Time now, bool ma, bool mo) {
  if (ma != ma_) {
    drive_slaves(now, ma, mo);
  } else if (mo != mo_) {
    mo_ = mo;
    settle_sli(now);
  }
  finish(now);
}

// One pass from the far slave to the near one: SLI of each before the edge is what the slave behind
// it sent until it was called.
void SlaveChain::drive_slaves(Time now, bool ma, bool mo) {
  bool sli_before = end_level(mo_);
  bool sli = end_level(mo);
  ma_ = ma;
  mo_ = mo;
  for (std::size_t i = attached_; i-- > 0;) {
    const bool slo_before = slo_of(i);
    slaves_[i]->ma_edge(now, ma, sli_before, sli);
    sli_before = slo_before;
    sli = slo_of(i);
  }
}

void SlaveChain::detach(Time now, std::size_t index) {
  const std::size_t before = attached_;
  attached_ = std::min(index, slaves_.size());
  // MA = 0 goes away for those that leave, and comes for those that come back.
  for (std::size_t i = slaves_.size(); !ma_ && i-- > std::min(before, attached_);) {
    slaves_[i]->ma_edge(now, i >= attached_, sli_of(i), sli_of(i));
  }
  refresh(now);
}

void SlaveChain::refresh(Time now) {
  settle_sli(now);
  finish(now);
}

void SlaveChain::settle_sli(Time now) {
  for (std::size_t i = slaves_.size(); i-- > 0;) slaves_[i]->sli_changed(now, sli_of(i));
}

void SlaveChain::on_timer(Time now, void* receiver, std::uint64_t /*word*/) {
  auto* chain = static_cast<SlaveChain*>(receiver);
  if (now != chain->armed_at_) return;
  chain->armed_at_ = kNever;
  auto& slaves = chain->slaves_;
  const bool running = !chain->idle_;
  const bool level = chain->reported_;
  for (std::size_t i = slaves.size(); i-- > 0;) {
    if (slaves[i]->deadline() <= now) slaves[i]->timer(now, chain->sli_of(i));
  }
  chain->settle_sli(now);
  chain->finish(now);
  // A frame that was cut off in a bit of 1 ends without an edge.
  if (running && level && chain->reported_ && chain->idle_) {
    chain->output_(now, chain->receiver_, level);
  }
}

// Reports a new level of SLO and keeps one timer event at or before the next deadline. Deadlines
// move away with every edge of MA; the event stays and is posted anew when it turns out too early.
void SlaveChain::finish(Time now) {
  Time next = kNever;
  idle_ = true;
  for (const auto& slave : slaves_) {
    next = std::min(next, slave->deadline());
    idle_ = idle_ && slave->idle();
  }
  if (next < armed_at_) {
    armed_at_ = next;
    queue_.post(next, &SlaveChain::on_timer, this);
  }
  if (slo() != reported_) {
    reported_ = slo();
    output_(now, receiver_, reported_);
  }
}

}  // namespace mb4::sim
