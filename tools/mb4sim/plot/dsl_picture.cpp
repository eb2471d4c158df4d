// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/dsl_picture.hpp"

#include <fmt/core.h>

#include <array>
#include <optional>

#include "plot/dsl_decode.hpp"
#include "plot/dsl_message.hpp"
#include "plot/dsl_seen.hpp"
#include "plot/timing_svg.hpp"
#include "report/exit_status.hpp"
#include "sim/lines/duplex/duplex_line.hpp"
#include "sim/lines/duplex/duplex_lines.hpp"
#include "sim/masters/dsl_model/dsl_quirks.hpp"

namespace mb4::tool {
namespace {

using sim::dsl_model::kAnswerBits;
using sim::dsl_model::kTicksPerBit;

constexpr double kDslMargin = 1;  // cells in front of the frame, and behind it
constexpr double kTicksToSwitch = 18.0 * kTicksPerBit;  // from the edge in SAMPLE
constexpr unsigned kFirstWave = 4;                      // MB4SIM_EDGE_OUT

class DslPicture final : public LinePicture, private sim::LineObserver {
 public:
  DslPicture(sim::Simulator& simulator, const sim::ChannelConfig& channel)
      : line_(*duplex(simulator.line(channel.number))),
        rules_(sim::dsl_model::rules_of(simulator.scenario().chip)),
        channel_(channel),
        tick_(static_cast<double>(sim::kPsPerSecond) /
              static_cast<double>(simulator.scenario().chip.f_clk_hz)) {
    line_.observe(simulator.now(), this, true);
  }
  ~DslPicture() override { line_.observe(0, nullptr, false); }

  // The frame that was read last is drawn.
  void finish(sim::Simulator& simulator) override {
    seen_ = dsl_seen(simulator);
    if (!seen_) return;
    const double rest = 102 + 6.0 * rules_.start_blocks;  // bits
    simulator.run_until(seen_->sampled + static_cast<sim::Time>(rest * kTicksPerBit * tick_));
  }
  Picture draw(const PictureRequest& request, sim::Time now) const override;
  std::vector<Signal> signals() const override {
    return {{"OUT", &waves_[0]}, {"EN", &waves_[1]}, {"IN", &waves_[2]}, {"ENCODER", &waves_[3]}};
  }

 private:
  void frame_begun() override {}
  void frame_over(const sim::LineFrame& /*frame*/) override {}
  void edge(sim::Time now, unsigned place, bool level) override {
    waves_[place - kFirstWave].edge(now, level);
  }

  const Wave& line() const { return waves_[2]; }
  std::vector<std::string> notes(const DslFrame& frame) const;
  Diagram diagram(const DslFrame& frame) const;

  sim::DuplexLine& line_;
  sim::dsl_model::LinkRules rules_;
  const sim::ChannelConfig& channel_;
  double tick_;  // ps
  std::array<Wave, 4> waves_;
  std::optional<DslSeen> seen_;
};

// Position on the axis: a cell is a bit of the master.
double cell(const DslFrame& frame, sim::Time time) {
  return (static_cast<double>(time) - static_cast<double>(frame.begin)) / frame.bit + kDslMargin;
}

DiagramRow wave_row(std::string_view name, const Wave& wave, const DslFrame& frame) {
  const auto margin = static_cast<sim::Time>(kDslMargin * frame.bit);
  const Wave part =
      wave.between(frame.begin - std::min(frame.begin, margin), frame.at(frame.bits + kDslMargin));
  DiagramRow row;
  row.name = name;
  row.idle = part.idle;
  for (const Edge& edge : part.edges) row.levels.push_back({cell(frame, edge.time), edge.level});
  return row;
}

DiagramRow field_row(std::string_view name, const std::vector<Field>& fields,
                     const DslFrame& frame) {
  DiagramRow row;
  row.type = DiagramRow::Type::kFields;
  row.name = name;
  for (const Field& field : fields) {
    row.fields.push_back(
        {{cell(frame, field.from), cell(frame, field.to)}, field.kind, field.labels, field.bad});
  }
  return row;
}

std::vector<std::string> DslPicture::notes(const DslFrame& frame) const {
  std::string place;
  if (seen_->place) place = fmt::format(", RX{} of its vertical frame", *seen_->place);
  std::vector<std::string> notes{fmt::format(
      "{}, {:.4g} Mbit/s, {}{}, {} bits, {:.4g} us{}", channel_.protocol().title, 1e6 / frame.bit,
      parameter_text(frame.parameter), place, frame.bits, frame.bits * frame.bit / 1e6,
      frame.mistakes.empty() ? std::string() : "; " + frame.mistakes)};
  if (!frame.late || !seen_->told) return notes;
  const unsigned sample = seen_->sample_place;
  notes.push_back(fmt::format(
      "Answer {:.2f} bits behind SWITCH; DELAY {}, the learned sample is {} of the 8 in a slot, "
      "{:.2f} of a bit behind its begin",
      *frame.late, seen_->delay, sample % kTicksPerBit,
      (kTicksToSwitch + rules_.rx_start + sample) / kTicksPerBit - 19 - *frame.late));
  if (seen_->number == 0) return notes;
  notes.push_back(fmt::format(
      "Second difference {}, position {}{}, speed {}, QM {}",
      frame.words.second_difference ? fmt::format("{:+d}", *frame.words.second_difference)
                                    : std::string("missing"),
      seen_->position, seen_->lost ? " (not certain)" : "", seen_->speed, seen_->quality));
  return notes;
}

Diagram DslPicture::diagram(const DslFrame& frame) const {
  Diagram diagram;
  diagram.notes = notes(frame);
  diagram.rows.push_back(wave_row("line", line(), frame));
  // The bits: the master's in their middle, the encoder's where the master samples.
  DiagramRow bits;
  bits.type = DiagramRow::Type::kDigits;
  bits.name = "bits";
  const auto add = [&](sim::Time time) {
    bits.digits.push_back({cell(frame, time), line().at(time) ? "1" : "0"});
  };
  for (unsigned i = 0; i < frame.bits; ++i) {
    if (!frame.has_answer() || i < kDslSwitch || i >= kDslTrailer) add(frame.at(i + 0.5));
  }
  if (frame.late && seen_->told) {
    const double first = kTicksToSwitch + rules_.rx_start + seen_->sample_place;
    for (unsigned i = 0; i < kAnswerBits; ++i) {
      add(seen_->sampled + static_cast<sim::Time>((first + i * kTicksPerBit) * tick_));
    }
  }
  diagram.rows.push_back(bits);
  diagram.rows.push_back(field_row("master", frame.sent, frame));
  diagram.rows.push_back(field_row("answer", frame.answered, frame));
  diagram.rows.push_back(wave_row("driver", waves_[1], frame));
  constexpr unsigned kApart = 6;  // bits
  for (unsigned i = 0; i <= frame.bits; i += kApart) {
    diagram.ticks.push_back({kDslMargin + i, fmt::format("{}", i)});
  }
  diagram.axis = "bit";
  diagram.length = frame.bits + 2 * kDslMargin;
  return diagram;
}

Picture DslPicture::draw(const PictureRequest& request, sim::Time /*now*/) const {
  if (request.control) {
    auto message = dsl_message_picture(dsl_exchanges(line(), kTicksPerBit * tick_));
    if (!message) throw UseError(fmt::format("{}: there was no message", request.scenario));
    message->diagram.title = request.title.empty()
                                 ? fmt::format("Message on channel {}", channel_.number)
                                 : request.title;
    return *message;
  }
  if (!seen_) throw UseError(fmt::format("{}: there was no frame", request.scenario));
  const DslFrame frame = decode_dsl(line(), seen_->sampled, kTicksPerBit * tick_);
  Diagram all = diagram(frame);
  all.title = request.title.empty()
                  ? fmt::format("Frame {} of channel {}", request.frame, channel_.number)
                  : request.title;
  // The master has seen the same.
  const bool same =
      frame.training() || !seen_->answer || (frame.late && frame.answer == *seen_->answer);
  return {all, frame.mistakes.empty() && same && !seen_->restart};
}

std::unique_ptr<LinePicture> record_dsl(sim::Simulator& simulator,
                                        const sim::ChannelConfig& channel) {
  return std::make_unique<DslPicture>(simulator, channel);
}

}  // namespace

const PictureDecoder kDslPicture{"dsl", &sim::kDuplexLines, record_dsl};

}  // namespace mb4::tool
