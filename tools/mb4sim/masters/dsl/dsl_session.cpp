// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A session with a DSL master, the model or the RTL. It has no driver: the master runs by itself,
// and each H-frame from the first certain position on is one of the session. A restart of the link
// is a frame without a word; the frames up to the next certain position are left out.
#include "masters/dsl/dsl_session.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "masters/dsl/dsl_readings.hpp"
#include "masters/dsl/dsl_talk.hpp"
#include "masters/dsl/dsl_walk.hpp"
#include "report/exit_status.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"
#include "sim/lines/duplex/duplex_line.hpp"
#include "sim/masters/dsl_model/dsl_quirks.hpp"

namespace mb4::tool {
namespace {

using sim::dsl_model::SampleRule;

constexpr unsigned kTicksOfFrame = 864;
constexpr unsigned kVertical = sim::dsl_model::SafeChannels::kFrames;

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
        master_(scenario.master->type == "dsl" ? readings_of_registers(simulator_, log())
                                               : readings_of_model(simulator_)),
        line_(*sim::duplex(simulator_.line(slaves_.front().channel))),
        encoder_(dynamic_cast<const sim::DslSlave&>(*simulator_.slave(slaves_.front().number))),
        frame_time_(kTicksOfFrame * sim::kPsPerSecond / scenario.chip.f_clk_hz) {}

  std::string configure() override;
  SessionFrame read(std::uint64_t number) override;
  std::span<const WordColumn> columns() const override;
  std::uint64_t failed_starts() const override { return failed_starts_; }
  // A vertical frame is judged at its end.
  unsigned late_frames() const override { return kVertical; }
  std::string told_between(std::uint64_t frame) const override;
  RegisterMap registers() override { return master_->registers(); }
  std::string access(const ControlRequest& request) override;
  RunSummary summary() const override;

 private:
  bool next();
  bool find_link();
  void keep_mistakes();
  std::string no_link() const;
  std::string judge() const;
  std::string judge_safe() const;
  std::optional<std::uint64_t> truth_before(unsigned frames) const;
  std::vector<std::string> told() const;

  std::unique_ptr<DslReadings> master_;
  const sim::DuplexLine& line_;
  const sim::DslSlave& encoder_;
  sim::Time frame_time_;
  DslReading frame_;
  bool first_ = false;  // frame_ has not been read yet
  bool lost_ = false;   // the link, and its restart has been told
  std::uint64_t failed_starts_ = 0;
  // What was wrong with running frames that are no rows, by their numbers.
  std::map<std::uint64_t, std::string> between_;
};

// Runs to the next answer. False if none comes while the host waits.
bool DslSession::next() {
  const auto frame = master_->next(simulator_.now() + simulator_.scenario().host.link_wait);
  if (!frame) return false;
  frame_ = *frame;
  return true;
}

// The position that the encoder took some frames before this one; nothing if it saw no frame then.
std::optional<std::uint64_t> DslSession::truth_before(unsigned frames) const {
  return encoder_.sampled_near(frame_.sampled - frames * frame_time_, frame_time_ / 2);
}

// A running frame that is no row. A safe position belongs to the eight frames that have brought it.
void DslSession::keep_mistakes() {
  if (frame_.number == 0) return;
  if (!frame_.acceleration_good) between_[frame_.number] = "second difference missing";
  const std::string safe = frame_.safe_new ? judge_safe() : "";
  if (safe.empty()) return;
  for (unsigned i = 0; i < kVertical; ++i) {
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

std::string DslSession::configure() {
  if (std::string failed = master_->begin(); !failed.empty()) return failed;
  if (!find_link()) return fmt::format("{}: {}", no_link(), master_->state());
  first_ = true;
  failed_starts_ = master_->restarts();
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
  const std::uint32_t identity = master_->identity();
  const auto position = [identity](std::uint64_t value) {
    return number_text(value, dsl_position_bits(identity), dsl_is_signed(identity));
  };
  const bool safe = frame_.safe_new && frame_.safe_here && frame_.safe1.valid;
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
  // That of the sample before the vertical frame.
  const auto truth = truth_before(kVertical);
  if (!bad.empty() || !truth || !frame_.safe_here) return bad;
  const SafePositions right = safe_positions(encoder_.config(), *truth);
  if (frame_.safe1.position != right.first) return "wrong safe position";
  if (frame_.safe2.position != right.second) return "wrong second safe position";
  return "";
}

// A picture shows the frames behind the message too.
std::string DslSession::access(const ControlRequest& request) {
  constexpr unsigned kBehind = 4;
  const sim::Time behind = kBehind * frame_time_;
  try {
    DslTalk talk(simulator_);
    switch (request.kind) {
      case ControlRequest::Kind::kRead:
        talk.read(request.address);
        break;
      case ControlRequest::Kind::kWrite:
        talk.write(request.address, request.bytes.front());
        break;
      default: {
        constexpr unsigned kName = 8;  // bytes; all else that is said of a resource has two
        const unsigned length = request.offset == 0 ? kName : 2;
        const auto answer = talk.ask(request.resource, false, request.offset, length);
        simulator_.advance(behind);
        return answer.error;
      }
    }
  } catch (const DslTalkError& error) {
    return error.what();
  }
  simulator_.advance(behind);
  return "";
}

RunSummary DslSession::summary() const {
  RunSummary summary = Session::summary();
  const sim::DuplexContention both = line_.contention(simulator_.now());
  if (both.longest > line_.enable_time()) {
    summary.note = fmt::format(
        "two drivers at once: {} times, at most {:.3f} us, {:.3f} us in all, first at {:.3f} us",
        both.times, sim::to_us(both.longest), sim::to_us(both.total), sim::to_us(both.first));
  }
  if (const std::string note = master_->note(); !note.empty()) {
    summary.note += (summary.note.empty() ? "" : "; ") + note;
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
  if (error.empty() && !frame_.restart.empty()) {
    error = "restart: " + frame_.restart;
    lost_ = true;
    any = false;
  }
  if (error.empty()) error = judge();
  SlaveResult result{std::nullopt, error, {}};
  if (any) result.told = told();
  if (error.empty()) {
    Word word;
    word.bits = frame_.position;
    word.data_bits = dsl_position_bits(master_->identity());
    result.word = word;
  }
  out.results.push_back(result);
  out.sent.push_back(truth_before(0));
  if (!link_there) out.error = error;
  out.end = link_there ? frame_.sampled : simulator_.now();
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

std::unique_ptr<Session> open_dsl(const sim::Scenario& scenario, const SessionOptions& options) {
  return std::make_unique<DslSession>(scenario, options);
}

constexpr SweepCodes kDslSweep{
    .name = "SAMPLE",
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
    .set_jitter = set_jitter};

constexpr std::string_view kNoPosition = "the master has no position";

}  // namespace

const MasterSupport kDslSupport{.type = "dsl",
                                .check = require_slaves,
                                .open = open_dsl,
                                .not_begun = kNoPosition,
                                .trains = true,
                                .sweep = kDslSweep,
                                .messages = true,
                                .walk = walk_dsl};

const MasterSupport kDslModelSupport{
    .type = "dsl-model",
    .check = require_slaves,
    .open = [](const sim::Scenario& scenario,
               const SessionOptions& options) -> std::unique_ptr<Session> {
      if (options.bus_log) throw UseError("--bus-log: a master of type dsl-model has no bus");
      return open_dsl(scenario, options);
    },
    .not_begun = kNoPosition,
    .registers = false,
    .trains = true,
    .sweep = kDslSweep,
    .messages = true,
    .walk = walk_dsl};

}  // namespace mb4::tool
