// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A session with the model of a DSL master. It has no driver: the master runs by itself, and each
// H-frame from the first certain position on is one of the session. A restart of the link is a
// frame without a word; the frames up to the next certain position are left out.
#include "masters/dsl_model/dsl_session.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "report/exit_status.hpp"
#include "sim/lines/duplex/duplex_line.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"

namespace mb4::tool {
namespace {

using sim::dsl_model::Link;
using sim::dsl_model::LinkFrame;
using sim::dsl_model::LinkHost;
using sim::dsl_model::Restart;
using sim::dsl_model::SampleRule;

constexpr std::uint32_t kSigned = 1U << 10U;  // in the identity of the encoder

// A number of this width, as the identity of the encoder says.
std::string number_text(std::uint64_t value, unsigned bits, bool is_signed) {
  const unsigned above = 64 - bits;
  const std::uint64_t high = value << above;
  return is_signed ? fmt::format("{}", static_cast<std::int64_t>(high) >> above)
                   : fmt::format("{}", high >> above);
}

class DslSession final : public Session {
 public:
  DslSession(const sim::Scenario& scenario, const SessionOptions& options)
      : Session(scenario, options), host_(simulator_.host<LinkHost>("none")) {}

  std::string configure() override;
  SessionFrame read(std::uint64_t number) override;
  std::span<const WordColumn> columns() const override;
  std::uint64_t failed_starts() const override { return failed_starts_; }
  // A vertical frame is judged at its end.
  unsigned late_frames() const override { return 8; }

 private:
  bool next();
  bool find_link();
  std::string no_link() const;
  std::string judge() const;
  void keep_truth();
  std::vector<std::string> told() const;

  LinkHost& host_;
  LinkFrame frame_;
  bool first_ = false;  // frame_ has not been read yet
  bool lost_ = false;   // the link, and its restart has been told
  std::uint64_t failed_starts_ = 0;
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
  failed_starts_ = host_.model().link().restarts();
  return "";
}

std::span<const WordColumn> DslSession::columns() const {
  static constexpr WordColumn kColumns[] = {{"position", "position", 14, true, nullptr},
                                            {"speed", "speed", 8, true, nullptr},
                                            {"safe_position", "safe position", 14, true, nullptr},
                                            {"quality", "QM", 2, true, nullptr},
                                            {"delay", "delay", 5, true, nullptr}};
  return kColumns;
}

// In the order of the columns. Position and speed only if they are certain.
std::vector<std::string> DslSession::told() const {
  const Link& link = host_.model().link();
  const bool is_signed = (link.identity() & kSigned) != 0;
  const auto position = [&](std::uint64_t value) {
    return number_text(value, link.position_bits(), is_signed);
  };
  const bool safe = frame_.safe_new && frame_.safe1.valid;
  return {frame_.lost ? "" : position(frame_.position),
          frame_.lost ? "" : fmt::format("{}", frame_.speed),
          safe ? position(frame_.safe1.position) : "", fmt::format("{}", frame_.quality),
          fmt::format("{}", frame_.delay)};
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
  bool any = true;  // a frame has come
  if (lost_) {
    lost_ = !find_link();
    any = !lost_;
    if (lost_) error = no_link();
  } else if (first_) {
    first_ = false;
  } else if (!next()) {
    error = no_link();
    any = false;
  }
  if (error.empty() && frame_.restart != Restart::kNone) {
    error = fmt::format("restart: {}", sim::dsl_model::name_of(frame_.restart));
    lost_ = true;
    any = false;
  }
  if (error.empty()) error = judge();
  SlaveResult result{std::nullopt, error, {}};
  if (any) result.told = told();
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

// Jitter that each rule of the sample allows, peak to peak, in thousandths of a percent of a bit.
constexpr long long kAllowed[] = {12'000, 35'000, 50'000};

std::string sample_title(unsigned code) {
  constexpr const char* kNames[] = {"published", "first zero", "tracking"};
  return fmt::format("SAMPLE {}: {}", code, kNames[code]);
}

// A point of a sweep has a few starts to link.
void set_sample(sim::Scenario& scenario, unsigned code) {
  constexpr sim::Time kSweepWait = 5000 * sim::kPsPerUs;
  sim::dsl_model::set_sample(scenario.chip, static_cast<SampleRule>(code));
  scenario.host.link_wait = std::min(scenario.host.link_wait, kSweepWait);
}

void set_jitter(sim::LineConfig& cable, sim::Time jitter) {
  dynamic_cast<sim::DuplexConfig&>(cable).in.jitter = jitter;
}

}  // namespace

const MasterSupport kDslModelSupport{
    .type = "dsl-model",
    .check = [](const sim::Scenario& scenario) { require_slaves(scenario); },
    .open = [](const sim::Scenario& scenario,
               const SessionOptions& options) -> std::unique_ptr<Session> {
      if (options.bus_log) throw UseError("--bus-log: a master of type dsl-model has no bus");
      return std::make_unique<DslSession>(scenario, options);
    },
    .not_begun = "the master has no position",
    .registers = false,
    .trains = true,
    .sweep = {.name = "SAMPLE",
              .most = std::size(kAllowed) - 1,
              .divider = [](std::uint64_t /*clk_hz*/,
                            unsigned /*code*/) { return sim::dsl_model::kTicksPerBit; },
              .period = "a bit",
              .allowed = [](unsigned code) { return kAllowed[code]; },
              .present =
                  [](const sim::Scenario& scenario) {
                    return static_cast<unsigned>(sim::dsl_model::rules_of(scenario.chip).sample);
                  },
              .set = set_sample,
              .title = sample_title,
              .set_jitter = set_jitter}};

}  // namespace mb4::tool
