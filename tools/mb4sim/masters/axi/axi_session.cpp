// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/axi/axi_session.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "axi_regs_table.hpp"
#include "biss_axi/device.hpp"
#include "biss_axi/page.hpp"
#include "register_table.hpp"
#include "report/exit_status.hpp"
#include "sim/masters/axi/axi_model.hpp"
#include "sim_clock.hpp"
#include "word_port.hpp"

namespace mb4::tool {
namespace {

namespace regs = biss_axi::regs;

constexpr unsigned kFlagBits = 2;  // nE and nW
constexpr unsigned kCrc = 0x43;    // of the document
constexpr std::uint32_t kNoAcknowledge = regs::LINE_DELAY::kMax;

// Words of one channel, which the index register chooses.
constexpr bool of_channel(unsigned address) {
  constexpr unsigned kAll[] = {regs::kAddrReceivedCrc,
                               regs::kAddrCalculatedCrc,
                               regs::kAddrSinglePointData,
                               regs::kAddrLineDelay,
                               regs::kAddrPositionHigh,
                               regs::kAddrFrameCount,
                               regs::kAddrCrcErrorCount,
                               regs::kAddrLateCount,
                               regs::kAddrDelayReference,
                               regs::kAddrLastStatus,
                               regs::kAddrLastPosition,
                               regs::kAddrLastPositionHigh,
                               regs::kAddrEye};
  return std::find(std::begin(kAll), std::end(kAll), address) != std::end(kAll);
}

// [chip] features = "full" or "frames".
bool has_extras(const sim::Scenario& scenario) { return scenario.chip.features != 0; }
bool has_eyes(const sim::Scenario& scenario) { return scenario.chip.features == sim::kAxiFrames; }

// With eyes: their width in percent of a bit, behind the other columns.
std::span<const WordColumn> eye_columns() {
  static const std::vector<WordColumn> kColumns = [] {
    std::vector<WordColumn> columns(all_word_columns().begin(), all_word_columns().end());
    columns.push_back({"eye_percent", "eye/%", 7, true, nullptr});
    return columns;
  }();
  return kColumns;
}

std::string describe(const biss_axi::ErrorInfo& error) {
  switch (error.code) {
    case biss_axi::Error::kNone:
      return "";
    case biss_axi::Error::kBus:
      return "AXI: no answer, or an error answer";
    case biss_axi::Error::kTimeout:
    case biss_axi::Error::kNoData:
      return "no good word";
    default:
      return "invalid configuration";
  }
}

void check_slave(const sim::Scenario& scenario, const sim::SlaveConfig& slave,
                 const sim::SlaveConfig& first) {
  const unsigned bits = first.data_bits();
  if (slave.traits().protocol.key != "biss-c") {
    fail_at(scenario, slave.source, "protocol", "the master reads BiSS C only");
  }
  const bool any = has_extras(scenario);
  const std::uint32_t polynomial = any ? first.crc().polynomial : kCrc;
  const std::uint32_t start = any ? first.crc().start : 0;
  if (slave.crc().polynomial != polynomial || slave.crc().start != start) {
    fail_at(scenario, slave.source, slave.crc().polynomial != polynomial ? "crc" : "crc_start",
            any ? "the master checks one CRC for all channels"
                : "the master checks CRC 0x43 with start value 0 only");
  }
  if (any && polynomial == 0) {
    fail_at(scenario, slave.source, "crc", "the master reads words with a CRC only");
  }
  if (slave.flag_bits() != kFlagBits) {
    fail_at(
        scenario, slave.source, "flag_bits",
        fmt::format("the master takes {} flags, nE and nW, not {}", kFlagBits, slave.flag_bits()));
  }
  if (slave.data_bits() != bits) {
    fail_at(scenario, slave.source, "data_bits",
            fmt::format("{}, but {} in the first channel: the master reads all channels with one "
                        "length; write data_bits = {}",
                        slave.data_bits(), bits, bits));
  }
}

biss_axi::Config make_config(const sim::Scenario& scenario) {
  require_slaves(scenario);
  const sim::SlaveConfig& first = scenario.channels.front().slaves.front();
  biss_axi::Config config;
  config.f_clk_hz = static_cast<std::uint32_t>(scenario.chip.f_clk_hz);
  config.ma_hz = static_cast<std::uint32_t>(scenario.host.ma_hz);
  config.channels = 0;
  for (const sim::ChannelConfig& channel : scenario.channels) {
    config.channels |= 1U << (channel.number - 1);
    check_slave(scenario, channel.slaves.front(), first);
  }
  config.wide = has_extras(scenario);
  config.enable_active_low = (scenario.chip.quirks & sim::kAxiEnableActiveLow) != 0;
  config.crc_bit_ignores = (scenario.chip.quirks & sim::kAxiCrcBitIgnores) != 0;
  config.position_bits = static_cast<std::uint8_t>(first.data_bits() - kFlagBits);
  switch (biss_axi::validate(config).field) {
    case biss_axi::Field::kClkHz:
      fail_at(scenario, scenario.chip.source, "f_clk_hz",
              fmt::format("{} is outside what the driver takes, 1 kHz to 1 GHz", config.f_clk_hz));
    case biss_axi::Field::kMaHz:
      fail_at(scenario, scenario.host.source, "ma_hz",
              fmt::format("the driver cannot make exactly {} Hz from {} Hz", config.ma_hz,
                          config.f_clk_hz));
    case biss_axi::Field::kPositionBits:
      fail_at(scenario, first.source, "data_bits",
              fmt::format("the master takes 3 to {}, position and flags, not {}",
                          (config.wide ? 64 : 32) + kFlagBits, first.data_bits()));
    default:
      return config;
  }
}

class AxiSession final : public Session {
 public:
  AxiSession(const sim::Scenario& scenario, const SessionOptions& options)
      : Session(scenario, options),
        port_(simulator_, log()),
        clock_(simulator_),
        device_(port_, clock_),
        page_(port_) {}

  std::string configure() override {
    const sim::Scenario& scenario = simulator_.scenario();
    config_ = make_config(scenario);
    const sim::Crc& crc = scenario.channels.front().slaves.front().crc();
    crc_bits_ = crc.width();
    if (has_extras(scenario)) {
      const auto set = page_.set_crc(crc.polynomial, crc.start);
      if (!set) return describe(set.info());
    }
    return describe(device_.configure(config_).info());
  }
  SessionFrame read(std::uint64_t number) override;
  RegisterMap registers() override;
  std::span<const WordColumn> columns() const override {
    return has_eyes(simulator_.scenario()) ? eye_columns() : Session::columns();
  }

 private:
  SlaveResult result_of(unsigned channel, bool good);
  std::string eye_of(unsigned channel);
  std::optional<bool> flag(const char* pin) const;

  biss_axi::Config config_;
  WordPort port_;
  SimClock clock_;
  biss_axi::Device<WordPort, SimClock> device_;
  biss_axi::Page<WordPort> page_;
  unsigned crc_bits_ = 0;
};

// Pins error and warn are the AND of nE and of nW of all channels: a 0 belongs to a channel only if
// there is one.
std::optional<bool> AxiSession::flag(const char* pin) const {
  const bool level = simulator_.pin(*simulator_.pin_by_name(pin));
  if (!level && slaves_.size() > 1) return std::nullopt;
  return level;
}

std::string AxiSession::eye_of(unsigned channel) {
  const auto eye = page_.eye(channel);
  if (!eye || !eye->valid) return "";
  const auto clocks = static_cast<unsigned>(config_.f_clk_hz / config_.ma_hz);
  return fmt::format("{}", (100U * eye->width + clocks / 2) / clocks);
}

SlaveResult AxiSession::result_of(unsigned channel, bool good) {
  const auto received = biss_axi::channel_word(port_, channel, regs::kAddrReceivedCrc);
  if (!received) return {std::nullopt, describe(received.info())};
  if (good) {
    // The flags come from the pins.
    Word word;
    std::uint32_t valid = 0, low = 0, high = 0;
    if (!port_.write(regs::kAddrChannelIndex, channel) ||
        !port_.read(regs::kAddrSinglePointValid, valid) ||
        !port_.read(regs::kAddrSinglePointData, low) ||
        !port_.read(regs::kAddrPositionHigh, high)) {
      return {std::nullopt, describe(biss_axi::Error::kBus)};
    }
    if ((valid >> channel & 1U) == 0) return {std::nullopt, describe(biss_axi::Error::kNoData)};
    word.bits = std::uint64_t{high} << 32U | low;
    word.data_bits = config_.position_bits;
    word.n_error = flag("error");
    word.n_warning = flag("warn");
    word.crc = ~*received & ((1U << crc_bits_) - 1);
    return {word, ""};
  }
  // These words are of this request.
  const auto delay = device_.line_delay(channel);
  const auto calculated = biss_axi::channel_word(port_, channel, regs::kAddrCalculatedCrc);
  if (!delay || !calculated) return {std::nullopt, describe(biss_axi::Error::kBus)};
  if (*delay == kNoAcknowledge) return {std::nullopt, "no acknowledge, or SLO was 0 at the start"};
  if (*received != *calculated) return {std::nullopt, "CRC error"};
  return {std::nullopt, "no start bit"};
}

SessionFrame AxiSession::read(std::uint64_t number) {
  wait_for_begin();
  SessionFrame out;
  out.number = number;
  out.begin = simulator_.now();
  const auto good = device_.read_all();
  out.error = describe(good.info());
  for (const ConnectedSlave& slave : slaves_) {
    const unsigned channel = slave.channel - 1;
    out.results.push_back(good ? result_of(channel, (*good >> channel & 1U) != 0)
                               : SlaveResult{std::nullopt, out.error});
    if (has_eyes(simulator_.scenario())) out.results.back().told = {eye_of(channel)};
    out.sent.push_back(simulator_.slave(slave.number)->sent_word());
    if (out.sent.back()) *out.sent.back() >>= kFlagBits;
  }
  out.end = simulator_.now();
  return out;
}

RegisterMap AxiSession::registers() {
  RegisterMap map;
  map.bits = 32;
  const auto read = [this](unsigned address) {
    std::uint32_t value = 0;
    if (!port_.read(address, value)) {
      throw UseError(
          fmt::format("the master does not answer at 0x{:02X}: its clock stands", address));
    }
    return value;
  };
  const std::uint32_t index = read(regs::kAddrChannelIndex);
  const unsigned last = has_eyes(simulator_.scenario())     ? regs::kAddrEyeAlarm
                        : has_extras(simulator_.scenario()) ? regs::kAddrLastPositionHigh
                                                            : regs::kAddrLineDelay;
  // Reading EYE begins its smallest width anew, so it is read once.
  std::map<unsigned, std::uint32_t> eyes;
  const auto eye = [&](unsigned channel) {
    if (eyes.count(channel) == 0) eyes[channel] = read(regs::kAddrEye);
    return eyes[channel];
  };
  for (unsigned address = 0; address <= last; address += sizeof(std::uint32_t)) {
    map.words.push_back(address == regs::kAddrEye ? eye(index) : read(address));
  }
  for (const regs::FieldInfo& field : regs::kFields) {
    if (field.address > last) continue;
    RegisterMap::Field shown =
        field_of(field, regs::kCodes, map.words[field.address / sizeof(std::uint32_t)]);
    if (!of_channel(field.address)) {
      map.fields.push_back(shown);
      continue;
    }
    for (const ConnectedSlave& slave : slaves_) {
      port_.write(regs::kAddrChannelIndex, slave.channel - 1);
      shown.name = fmt::format("{}[{}]", field.name, slave.channel - 1);
      shown.word = field.address == regs::kAddrEye ? eye(slave.channel - 1) : read(field.address);
      map.fields.push_back(shown);
    }
  }
  port_.write(regs::kAddrChannelIndex, index);
  return map;
}

unsigned ma_divider(std::uint64_t clk_hz, unsigned code) {
  const unsigned period = 2 * code;
  return code != 0 && clk_hz % period == 0 ? period : 0;
}

}  // namespace

const MasterSupport kAxiSupport{
    .type = "axi",
    .check = [](const sim::Scenario& scenario) { make_config(scenario); },
    .open = [](const sim::Scenario& scenario, const SessionOptions& options)
        -> std::unique_ptr<Session> { return std::make_unique<AxiSession>(scenario, options); },
    .sweep = {.name = "MA_DIVIDER",
              .most = regs::MA_DIVIDER::kMax,
              .refuses = "MA is the clock divided by twice MA_DIVIDER, exactly; not",
              .divider = ma_divider}};

}  // namespace mb4::tool
