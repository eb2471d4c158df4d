// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/dsl_seen.hpp"

#include "dsl_page_regs.hpp"
#include "dsl_window.hpp"
#include "sim/masters/dsl/live_dsl.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"
#include "word_port.hpp"

namespace mb4::tool {
namespace {

namespace page = dsl::page;

using sim::dsl_model::LinkState;

constexpr unsigned kFractionBits = 5;  // of SAMPLE_PLACE
constexpr unsigned kVertical = 8;
constexpr unsigned kLastPlace = 7;

std::optional<DslSeen> seen_by(sim::dsl_model::LinkModel& model) {
  const sim::dsl_model::LinkFrame& frame = model.link().frame();
  if (frame.sampled == 0) return std::nullopt;
  DslSeen seen;
  seen.sampled = model.time_of(frame.sampled);
  seen.told = true;
  seen.number = frame.number;
  if (frame.number != 0) seen.place = frame.place;
  seen.sample_place = frame.sample_place;
  seen.delay = frame.delay;
  seen.position = frame.position;
  seen.lost = frame.lost;
  seen.speed = frame.speed;
  seen.quality = frame.quality;
  seen.restart = frame.restart != sim::dsl_model::Restart::kNone;
  seen.answer = frame.answer;
  return seen;
}

// A running frame, whose record the window has.
bool take_record(WordPort& port, const sim::DslHost& host, DslSeen& seen) {
  const auto window = read_dsl_window(port);
  std::uint32_t safe = 0;
  std::uint32_t age = 0;
  if (!window || !port.read(page::kAddrSafe1Lo, safe) || !port.read(page::kAddrSafe1Age, age)) {
    return false;
  }
  const auto at = host.edge_at(window->time);
  if (!at) return false;
  seen.sampled = *at;
  seen.number = window->number;
  if (age < kVertical) seen.place = (kLastPlace + age) % kVertical;
  seen.position = window->position;
  seen.lost = window->lost;
  seen.speed = window->speed;
  seen.quality = window->quality;
  seen.delay = window->delay;
  return true;
}

// In the training the next frame that wants an answer is taken.
bool wait_for_training(sim::Simulator& simulator, WordPort& port, const sim::DslHost& host,
                       DslSeen& seen) {
  const sim::Time end = simulator.now() + 1000 * sim::kPsPerUs;
  std::uint32_t status = 0;
  LinkState state = LinkState::kGap;
  while (state < LinkState::kStart) {
    if (simulator.now() > end || !port.read(page::kAddrStatus, status)) return false;
    state = static_cast<LinkState>(page::LINK_STATE::get(status));
  }
  const auto before = host.last_edge();
  simulator.run_while_waiting([&] { return host.last_edge() != before; }, end);
  // Registers have what the master knows when the answer is over.
  constexpr sim::Time kAnswer = 10 * sim::kPsPerUs;
  simulator.run_until(simulator.now() + kAnswer);
  if (host.last_edge() == before || !port.read(page::kAddrStatus, status)) return false;
  seen.sampled = *host.last_edge();
  seen.delay = page::DELAY_BITS::get(status);
  return true;
}

std::optional<DslSeen> seen_by(sim::Simulator& simulator, const sim::DslHost& host) {
  WordPort port(simulator);
  DslSeen seen;
  std::uint32_t status = 0;
  std::uint32_t place = 0;
  if (!host.last_edge()) return std::nullopt;
  if (port.read(page::kAddrStatus, status)) {
    seen.told = page::LINK_STATE::get(status) == static_cast<unsigned>(LinkState::kRun)
                    ? take_record(port, host, seen)
                    : wait_for_training(simulator, port, host, seen);
    seen.told = seen.told && port.read(page::kAddrSamplePlace, place);
    seen.sample_place = place >> kFractionBits;
  }
  // Its clock stands: all that is known is when it asked for the last position.
  if (!seen.told) seen.sampled = *host.last_edge();
  return seen;
}

}  // namespace

std::optional<DslSeen> dsl_seen(sim::Simulator& simulator) {
  if (simulator.scenario().master->type == "dsl") {
    return seen_by(simulator, simulator.host<sim::DslHost>("axi"));
  }
  return seen_by(simulator.host<sim::dsl_model::LinkHost>("none").model());
}

}  // namespace mb4::tool
