// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/live_axi.hpp"

#include <array>
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
constexpr Pin kNcs{8};
constexpr Pin kSclk{9};
constexpr Pin kMosi{10};
constexpr Pin kMiso{11};
constexpr SpiPins kSpiPins{kNcs, kSclk, kMosi, kMiso};
constexpr int kMa0 = 16;
constexpr int kSlo0 = 32;

constexpr std::pair<std::string_view, Pin> kPins[] = {{"axi_aresetn", kAresetn},
                                                      {"por_n", kPorN},
                                                      {"ext_sample_clk", kExtSampleClk},
                                                      {"sample_en", kSampleEn},
                                                      {"error", kError},
                                                      {"warn", kWarn},
                                                      {"sample_clk_output", kSampleClkOutput},
                                                      {"irq", kIrq},
                                                      {"ncs", kNcs},
                                                      {"sclk", kSclk},
                                                      {"mosi", kMosi},
                                                      {"miso", kMiso}};

// Frames of biss_spi.
constexpr std::uint8_t kOpcodeWrite = 0x02;
constexpr std::uint8_t kOpcodeRead = 0x03;
constexpr std::size_t kFrameBytes = 7;
constexpr std::size_t kAnswerByte = 2;
constexpr std::uint8_t kAnswerMask = 0xF3;  // without the sticky bits
constexpr std::uint8_t kUnderstood = 0x51;

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

std::optional<std::uint8_t> AxiSpiWords::write(std::uint32_t address, std::uint32_t data,
                                               std::uint8_t strobe) {
  if (strobe != 0xF) return kNotTaken;
  setup_.written(address, data, strobe);
  return exchange(kOpcodeWrite, address, data);
}

std::optional<std::uint8_t> AxiSpiWords::read(std::uint32_t address, std::uint32_t& data) {
  data = 0;
  return exchange(kOpcodeRead, address, data);
}

std::uint8_t AxiSpiWords::exchange(std::uint8_t opcode, std::uint32_t address,
                                   std::uint32_t& data) {
  std::array<std::uint8_t, kFrameBytes> tx{opcode, static_cast<std::uint8_t>(address)};
  std::array<std::uint8_t, kFrameBytes> rx{};
  for (std::size_t i = kAnswerByte + 1; i < kFrameBytes; ++i)
    tx.at(i) = static_cast<std::uint8_t>(data >> (8 * (kFrameBytes - 1 - i)));
  spi_.transfer(tx, rx);
  if ((rx.at(kAnswerByte) & kAnswerMask) != kUnderstood) return kNotTaken;
  if (opcode == kOpcodeWrite) return 0;
  data = 0;
  for (std::size_t i = kAnswerByte + 1; i < kFrameBytes; ++i) data = data << 8U | rx.at(i);
  return 0;
}

LiveAxi::LiveAxi(const MasterSetup& setup)
    : outside_(setup.outside),
      config_(setup.chip),
      lines_(setup.lines),
      model_((setup.host.interface == HostInterface::kSpi ? make_axi_spi_model : make_axi_model)(
          setup.chip, channels_of(setup.lines), setup.seed, setup.plain)),
      host_(outside_, *model_,
            setup.chip.f_clk_hz == 0 ? kPsPerUs : kPsPerSecond / setup.chip.f_clk_hz + 1),
      behind_spi_(setup.host.interface == HostInterface::kSpi),
      spi_(outside_, SpiTiming::for_frequency(setup.host.sclk_hz), kSpiPins),
      words_(spi_, host_.setup()) {
  if (setup.trace != nullptr) model_->start_wave(*setup.trace);
}

void LiveAxi::power_on() {
  outside_.run_until(kResetLow);
  outside_.set_pin(kPorN, true);
  outside_.set_pin(kAresetn, true);
}

HostModel* LiveAxi::host(std::string_view name) {
  if (!behind_spi_) return name == "axi" ? &host_ : nullptr;
  if (name == "spi") return &spi_;
  return name == "words" ? &words_ : nullptr;
}

bool LiveAxi::can_set(Pin pin) const {
  if (pin == kNcs || pin == kSclk || pin == kMosi) return behind_spi_;
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
  } else if (pin == kNcs || pin == kSclk || pin == kMosi) {
    SpiLevels levels = model_->spi();
    (pin == kNcs ? levels.ncs : pin == kSclk ? levels.sclk : levels.mosi) = level;
    model_->set_spi(now, levels);
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
  if (pin == kNcs) return model_->spi().ncs;
  if (pin == kSclk) return model_->spi().sclk;
  if (pin == kMosi) return model_->spi().mosi;
  if (pin == kMiso) return !model_->spi().ncs && (outputs & AxiModel::kMiso) != 0;
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
