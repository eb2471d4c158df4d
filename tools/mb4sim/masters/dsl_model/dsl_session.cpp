// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A session with the model of a DSL master. It has no driver: the master runs by itself, and each
// H-frame from the first certain position on is one of the session. A restart of the link is a
// frame without a word; the frames up to the next certain position are left out.
#include "masters/dsl_model/dsl_session.hpp"

#include <fmt/core.h>

#include <optional>

#include "report/exit_status.hpp"
#include "sim/lines/line_kind.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"

namespace mb4::tool {
namespace {

using sim::dsl_model::Link;
using sim::dsl_model::LinkFrame;
using sim::dsl_model::LinkHost;
using sim::dsl_model::Restart;

class DslSession final : public Session {
 public:
  DslSession(const sim::Scenario& scenario, const SessionOptions& options)
      : Session(scenario, options), host_(simulator_.host<LinkHost>("none")) {}

  std::string configure() override;
  SessionFrame read(std::uint64_t number) override;
  RegisterMap registers() override {
    throw UseError("a master of type dsl-model has no registers");
  }

 private:
  bool next();
  bool find_link();
  std::string no_link() const;
  std::string judge() const;
  void keep_truth();

  LinkHost& host_;
  LinkFrame frame_;
  bool first_ = false;  // frame_ has not been read yet
  bool lost_ = false;   // the link, and its restart has been told
  // The position of the encoder's last sample, of the one before, and that of the sample before the
  // vertical frame.
  std::optional<std::uint64_t> truth_;
  std::optional<std::uint64_t> safe_truth_;
};

// Runs to the next answer. False if none comes while the host waits.
bool DslSession::next() {
  const sim::Time limit = simulator_.now() + simulator_.scenario().host.link_wait;
  simulator_.run_while_waiting([this] { return host_.any(); }, limit);
  const auto frame = host_.take();
  if (!frame) return false;
  frame_ = *frame;
  keep_truth();
  return true;
}

// The encoder cannot have taken its next position yet.
void DslSession::keep_truth() {
  if (frame_.number != 0 && frame_.place == 0) safe_truth_ = truth_;
  truth_ = slaves_.empty() ? std::nullopt : simulator_.slave(slaves_.front().number)->sent_word();
}

// Runs to the first frame with a certain position.
bool DslSession::find_link() {
  const sim::Time limit = simulator_.now() + simulator_.scenario().host.link_wait;
  while (simulator_.now() < limit) {
    if (!next()) return false;
    if (frame_.number != 0 && !frame_.lost) return true;
  }
  return false;
}

std::string DslSession::no_link() const {
  const Link& link = host_.model().link();
  return fmt::format("no link within {} ms: state {}, {} restarts, the last one: {}",
                     sim::to_us(simulator_.scenario().host.link_wait) / 1000,
                     sim::dsl_model::name_of(link.state()), link.restarts(),
                     sim::dsl_model::name_of(link.last_restart()));
}

std::string DslSession::configure() {
  if (!find_link()) return no_link();
  first_ = true;
  return "";
}

// What is wrong with a frame that has a position; empty: nothing.
std::string DslSession::judge() const {
  if (frame_.lost) return "position not certain";
  if (!frame_.safe_new) return "";
  if (!frame_.safe1.valid)
    return frame_.safe1.error ? "safe position: CRC error" : "no safe position";
  const unsigned bits = host_.model().link().position_bits();
  const std::uint64_t safe = frame_.safe1.position & (~std::uint64_t{0} >> (64 - bits));
  if (safe_truth_ && safe != *safe_truth_) return "wrong safe position";
  return "";
}

SessionFrame DslSession::read(std::uint64_t number) {
  SessionFrame out;
  out.number = number;
  out.begin = simulator_.now();
  std::string error;
  if (lost_) {
    lost_ = false;
    if (!find_link()) error = no_link();
  } else if (first_) {
    first_ = false;
  } else if (!next()) {
    error = no_link();
  }
  if (error.empty() && frame_.restart != Restart::kNone) {
    error = fmt::format("restart: {}", sim::dsl_model::name_of(frame_.restart));
    lost_ = true;
  }
  if (error.empty()) error = judge();
  SlaveResult result{std::nullopt, error};
  if (error.empty()) {
    Word word;
    word.bits = frame_.position;
    word.data_bits = host_.model().link().position_bits();
    result.word = word;
  }
  out.results.push_back(result);
  out.sent.push_back(truth_);
  out.end = simulator_.now();
  return out;
}

}  // namespace

const MasterSupport kDslModelSupport{
    .type = "dsl-model",
    .check = [](const sim::Scenario& scenario) { require_slaves(scenario); },
    .open = [](const sim::Scenario& scenario,
               const SessionOptions& options) -> std::unique_ptr<Session> {
      if (options.bus_log) throw UseError("--bus-log: a master of type dsl-model has no bus");
      return std::make_unique<DslSession>(scenario, options);
    }};

}  // namespace mb4::tool
