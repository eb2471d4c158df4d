// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/slave_chain.hpp"

#include <algorithm>
#include <utility>

namespace mb4::sim {

void SlaveChain::add(std::unique_ptr<Slave> slave) { slaves_.push_back(std::move(slave)); }

bool SlaveChain::idle() const {
  return std::all_of(slaves_.begin(), slaves_.end(), [](const auto& s) { return s->idle(); });
}

void SlaveChain::drive(Time now, bool ma, bool mo) {
  if (ma != ma_) {
    const std::size_t count = attached();
    for (std::size_t i = 0; i < count; ++i) slaves_[i]->sample(sli_of(i));
    ma_ = ma;
    mo_ = mo;
    for (std::size_t i = count; i-- > 0;) slaves_[i]->ma_edge(now, ma, sli_of(i));
  } else if (mo != mo_) {
    mo_ = mo;
    settle_sli(now);
  }
  finish(now);
}

void SlaveChain::detach(Time now, std::size_t index) {
  const std::size_t before = attached();
  attached_ = index < slaves_.size() ? index : SIZE_MAX;
  // MA = 0 goes away for those that leave, and comes for those that come back.
  for (std::size_t i = slaves_.size(); !ma_ && i-- > std::min(before, attached());) {
    slaves_[i]->sample(sli_of(i));
    slaves_[i]->ma_edge(now, i >= attached(), sli_of(i));
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
  const bool running = !chain->idle();
  const bool level = chain->reported_;
  for (std::size_t i = slaves.size(); i-- > 0;) {
    if (slaves[i]->deadline() <= now) slaves[i]->timer(now, chain->sli_of(i));
  }
  chain->settle_sli(now);
  chain->finish(now);
  // A frame that was cut off in a bit of 1 ends without an edge.
  if (running && level && chain->reported_ && chain->idle()) {
    chain->output_(now, chain->receiver_, level);
  }
}

// Reports a new level of SLO and keeps one timer event at or before the next deadline. Deadlines
// move away with every edge of MA; the event stays and is posted anew when it turns out too early.
void SlaveChain::finish(Time now) {
  Time next = kNever;
  for (const auto& slave : slaves_) next = std::min(next, slave->deadline());
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
