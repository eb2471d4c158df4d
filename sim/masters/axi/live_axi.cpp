// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/live_axi.hpp"

#include <charconv>
#include <utility>

#include "sim/lines/clocked/clocked_end.hpp"

namespace mb4::sim {
namespace {

constexpr Pin kAresetn{0};
constexpr Pin kExtSampleClk{1};
constexpr Pin kSampleEn{2};
constexpr Pin kError{3};
constexpr Pin kWarn{4};
constexpr Pin kSampleClkOutput{5};
constexpr Pin kIrq{6};
constexpr Pin kPorN{7};
constexpr int kMa0 = 16;
constexpr int kSlo0 = 32;

constexpr std::pair<std::string_view, Pin> kPins[] = {{"axi_aresetn", kAresetn},
                                                      {"por_n", kPorN},
                                                      {"ext_sample_clk", kExtSampleClk},
                                                      {"sample_en", kSampleEn},
                                                      {"error", kError},
                                                      {"warn", kWarn},
                                                      {"sample_clk_output", kSampleClkOutput},
                                                      {"irq", kIrq}};

// Number of a line pin whose first one is `first`.
std::optional<unsigned> line_of(Pin pin, int first) {
  const int line = static_cast<int>(pin) - first;
  if (line < 0 || line >= static_cast<int>(kAxiChannels)) return std::nullopt;
  return static_cast<unsigned>(line);
}

unsigned channels_of(MasterModel::Outputs lines) {
  unsigned channels = 1;
  for (unsigned line = 0; line < kAxiChannels; ++line) {
    if ((lines & MasterModel::of_line(line, kMaPin)) != 0) channels = line + 1;
  }
  return channels;
}

}  // namespace

std::uint32_t AxiHost::read(std::uint32_t address) {
  std::uint32_t data = 0;
  read(address, data);
  return data;
}

std::optional<StreamBeat> AxiHost::next_beat() {
  if (model_.beats().empty()) return std::nullopt;
  StreamBeat beat = std::move(model_.beats().front());
  model_.beats().pop_front();
  return beat;
}

LiveAxi::LiveAxi(const MasterSetup& setup)
    : outside_(setup.outside),
      config_(setup.chip),
      lines_(setup.lines),
      model_(make_axi_model(setup.chip, channels_of(setup.lines), setup.seed, setup.plain)),
      host_(outside_, *model_,
            setup.chip.f_clk_hz == 0 ? kPsPerUs : kPsPerSecond / setup.chip.f_clk_hz + 1) {
  if (setup.trace != nullptr) model_->start_wave(*setup.trace);
}

void LiveAxi::power_on() {
  outside_.run_until(kResetLow);
  outside_.set_pin(kPorN, true);
  outside_.set_pin(kAresetn, true);
}

bool LiveAxi::can_set(Pin pin) const {
  if (const auto line = line_of(pin, kSlo0)) {
    return *line < model_->channels() && (lines_ & MasterModel::of_line(*line, kMaPin)) == 0;
  }
  return pin == kAresetn || pin == kPorN || pin == kExtSampleClk || pin == kSampleEn;
}

void LiveAxi::set_pin(Time now, Pin pin, bool level) {
  if (!can_set(pin)) return;
  if (pin == kAresetn) {
    aresetn_ = level;
    host_.setup().restart();
    model_->set_reset(now, !level);
  } else if (pin == kPorN) {
    por_n_ = level;
    if ((config_.quirks & kAxiPorPin) != 0) host_.setup().restart();
    model_->set_power_on_reset(now, !level);
  } else if (pin == kExtSampleClk) {
    model_->set_ext_sample_clk(now, level);
  } else if (pin == kSampleEn) {
    model_->set_sample_en(now, level);
  } else if (const auto line = line_of(pin, kSlo0)) {
    model_->set_inputs(now, *line, level ? 1 : 0);
  }
}

bool LiveAxi::pin(Pin pin) const {
  const MasterModel::Outputs outputs = model_->outputs();
  if (const auto line = line_of(pin, kMa0))
    return (outputs & MasterModel::of_line(*line, kMaPin)) != 0;
  if (const auto line = line_of(pin, kSlo0)) {
    return *line < model_->channels() && model_->slo(*line);
  }
  if (pin == kAresetn) return aresetn_;
  if (pin == kPorN) return por_n_;
  if (pin == kExtSampleClk) return model_->ext_sample_clk();
  if (pin == kSampleEn) return model_->sample_en();
  if (pin == kError) return (outputs & AxiModel::kError) != 0;
  if (pin == kWarn) return (outputs & AxiModel::kWarn) != 0;
  if (pin == kIrq) return (outputs & AxiModel::kIrq) != 0;
  return (outputs & AxiModel::kSampleClk) != 0;
}

std::optional<Pin> axi_pin_by_name(std::string_view name) {
  if (const auto pin = find_pin(kPins, name)) return pin;
  for (const auto& [begin, first] :
       {std::pair<std::string_view, int>{"ma", kMa0}, {"slo", kSlo0}}) {
    if (name.substr(0, begin.size()) != begin) continue;
    const std::string_view number = name.substr(begin.size());
    unsigned line = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), line);
    const bool plain = !number.empty() && (number.size() == 1 || number.front() != '0');
    if (error == std::errc{} && end == number.data() + number.size() && plain &&
        line < kAxiChannels) {
      return Pin{first + static_cast<int>(line)};
    }
  }
  return std::nullopt;
}

}  // namespace mb4::sim
