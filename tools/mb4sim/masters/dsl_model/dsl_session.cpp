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
#include <map>
#include <optional>

#include "report/exit_status.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"
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

// Both safe positions of 40 bits, of an encoder at `position`: the first as wide as the field, the
// second the inverse of its higher bits.
struct SafePositions {
  std::uint64_t first;
  std::uint64_t second;
};
SafePositions safe_positions(const sim::DslSlaveConfig& encoder, std::uint64_t position) {
  constexpr std::uint64_t kField = (std::uint64_t{1} << 40U) - 1;
  const unsigned above = 64 - encoder.data_bits;
  const unsigned narrower =
      encoder.safe2_bits == 0 ? 0
                              : encoder.data_bits - std::min(encoder.safe2_bits, encoder.data_bits);
  const auto wide = static_cast<std::int64_t>(position << above) >> above;
  const std::int64_t whole = encoder.is_signed ? wide : static_cast<std::int64_t>(position);
  return {static_cast<std::uint64_t>(whole) & kField,
          static_cast<std::uint64_t>(~(whole >> narrower)) & kField};
}

class DslSession final : public Session {
 public:
  DslSession(const sim::Scenario& scenario, const SessionOptions& options)
      : Session(scenario, options),
        host_(simulator_.host<LinkHost>("none")),
        line_(*sim::duplex(simulator_.line(slaves_.front().channel))),
        encoder_(dynamic_cast<const sim::DslSlave&>(*simulator_.slave(slaves_.front().number))) {}

  std::string configure() override;
  SessionFrame read(std::uint64_t number) override;
  std::span<const WordColumn> columns() const override;
  std::uint64_t failed_starts() const override { return failed_starts_; }
  // A vertical frame is judged at its end.
  unsigned late_frames() const override { return 8; }
  std::string told_between(std::uint64_t frame) const override;
  RunSummary summary() const override;

 private:
  bool next();
  bool find_link();
  void keep_mistakes();
  std::string no_link() const;
  std::string no_link_and_why() const;
  std::string judge() const;
  std::string judge_safe() const;
  void keep_truth();
  std::vector<std::string> told() const;
  sim::Time sampled() const;

  LinkHost& host_;
  const sim::DuplexLine& line_;
  const sim::DslSlave& encoder_;
  LinkFrame frame_;
  bool first_ = false;  // frame_ has not been read yet
  bool lost_ = false;   // the link, and its restart has been told
  std::uint64_t failed_starts_ = 0;
  // What was wrong with running frames that are no rows, by their numbers.
  std::map<std::uint64_t, std::string> between_;
  std::uint64_t begun_ = 0;  // frames that the encoder has seen
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

// The encoder cannot have taken its next position yet. It has none of a frame that it has not seen.
void DslSession::keep_truth() {
  if (frame_.number != 0 && frame_.place == 0) safe_truth_ = truth_;
  const std::uint64_t begun = encoder_.begun();
  truth_ = begun == begun_ + 1 ? encoder_.sent_word() : std::nullopt;
  begun_ = begun;
}

// A running frame that is no row. A safe position belongs to the eight frames that have brought it.
void DslSession::keep_mistakes() {
  if (frame_.number == 0) return;
  if (!frame_.acceleration_good) between_[frame_.number] = "second difference missing";
  const std::string safe = frame_.safe_new ? judge_safe() : "";
  if (safe.empty()) return;
  for (unsigned i = 0; i <= frame_.place; ++i) {
    if (i < frame_.number) between_.try_emplace(frame_.number - i, safe);
  }
}

std::string DslSession::told_between(std::uint64_t frame) const {
  const auto found = between_.find(frame);
  return found == between_.end() ? "" : found->second;
}

// Runs to the first frame with a certain position.
bool DslSession::find_link() {
  const sim::Time limit = simulator_.now() + simulator_.scenario().host.link_wait;
  while (simulator_.now() < limit) {
    if (!next()) return false;
    if (frame_.number != 0 && !frame_.lost) return true;
    keep_mistakes();
  }
  return false;
}

std::string DslSession::no_link() const {
  return fmt::format("no link within {} ms",
                     sim::to_us(simulator_.scenario().host.link_wait) / 1000);
}

std::string DslSession::no_link_and_why() const {
  const Link& link = host_.model().link();
  return fmt::format("{}: state {}, {} restarts, the last one: {}", no_link(),
                     sim::dsl_model::name_of(link.state()), link.restarts(),
                     sim::dsl_model::name_of(link.last_restart()));
}

std::string DslSession::configure() {
  if (!find_link()) return no_link_and_why();
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
  return frame_.safe_new ? judge_safe() : "";
}

// The same of the safe positions of a vertical frame. Channel 2 is judged by itself.
std::string DslSession::judge_safe() const {
  const auto told_bad = [](const sim::dsl_model::SafeChannel& safe, const char* error,
                           const char* none) {
    return safe.valid ? "" : safe.error ? error : none;
  };
  std::string bad = told_bad(frame_.safe1, "safe position: CRC error", "no safe position");
  if (bad.empty()) {
    bad = told_bad(frame_.safe2, "second safe position: CRC error", "no second safe position");
  }
  if (!bad.empty() || !safe_truth_) return bad;
  const SafePositions right = safe_positions(encoder_.config(), *safe_truth_);
  if (frame_.safe1.position != right.first) return "wrong safe position";
  if (frame_.safe2.position != right.second) return "wrong second safe position";
  return "";
}

// The edge in SAMPLE of the last answer.
sim::Time DslSession::sampled() const { return host_.model().time_of(frame_.sampled); }

RunSummary DslSession::summary() const {
  RunSummary summary = Session::summary();
  const sim::DuplexContention both = line_.contention(simulator_.now());
  if (both.longest > line_.enable_time()) {
    summary.note = fmt::format(
        "two drivers at once: {} times, at most {:.3f} us, {:.3f} us in all, first at {:.3f} us",
        both.times, sim::to_us(both.longest), sim::to_us(both.total), sim::to_us(both.first));
  }
  return summary;
}

SessionFrame DslSession::read(std::uint64_t number) {
  SessionFrame out;
  out.number = number;
  out.begin = simulator_.now();
  std::string error;
  bool any = true;         // a frame has come
  bool link_there = true;  // ... even if the link ends with it
  if (lost_) {
    lost_ = !find_link();
    any = link_there = !lost_;
    if (lost_) error = no_link();
  } else if (first_) {
    first_ = false;
  } else if (!next()) {
    error = no_link();
    any = link_there = false;
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
  if (!link_there) out.error = error;
  out.end = link_there ? sampled() : simulator_.now();
  out.begin = std::min(out.begin, out.end);
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
