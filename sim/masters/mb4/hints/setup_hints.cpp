// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/hints/setup_hints.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "mb4_page_regs.hpp"
#include "sim/core/number_text.hpp"
#include "sim/lines/device.hpp"
#include "sim/lines/presets.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"

namespace mb4::sim {
namespace {

namespace reg = mb4::regs;

constexpr unsigned kLines = reg::kChannels;
constexpr unsigned kWords = reg::kSlaves;
constexpr unsigned kSecondLine = 5;  // first data channel of line 2

// In the order of CFGCH.
constexpr std::array<std::string_view, 3> kProtocols{"biss-b", "biss-c", "ssi"};
constexpr std::array<std::string_view, 3> kTitles{"BiSS B", "BiSS C", "SSI"};
constexpr unsigned kBissB = 0;
constexpr unsigned kSsi = 2;
constexpr unsigned kUnused = 3;

constexpr std::array<std::uint8_t, 6> kOpcodes{
    reg::kSpiOpcodeWriteRegisters,   reg::kSpiOpcodeReadRegisters,  reg::kSpiOpcodeReadStatus,
    reg::kSpiOpcodeWriteInstruction, reg::kSpiOpcodeReadRegisters0, reg::kSpiOpcodeWriteRegisters0};

std::string text_of(unsigned number) { return std::to_string(number); }

std::string hex(std::uint32_t value, unsigned digits = 1) {
  std::string text;
  for (; value != 0 || text.size() < digits; value >>= 4U) {
    text.insert(text.begin(), "0123456789ABCDEF"[value & 0xFU]);
  }
  return "0x" + text;
}

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// A time as short as it can be.
std::string time_text(Time time) {
  return time % kPsPerUs == 0 ? std::to_string(time / kPsPerUs) + " us"
                              : plain(static_cast<double>(time) / kPsPerNs) + " ns";
}

// A data channel of the chip as its four registers say.
struct WordSetup {
  unsigned number = 1;  // x of SCDATAx
  bool enabled = false;
  bool bit7 = false;  // GRAYSx, LSTOPx
  bool actuator = false;
  unsigned bits = 1;
  std::uint8_t crc_code = 0;
  Crc crc;

  bool same_crc(const Crc& other) const {
    const std::uint32_t mask = (std::uint32_t{1} << crc.width()) - 1;
    return crc.polynomial == other.polynomial && ((crc.start ^ other.start) & mask) == 0;
  }
};

std::uint32_t polynomial_of(std::uint8_t code) {
  constexpr unsigned kByPolynomial = reg::kSelcrcsByPolynomial;
  if ((code & kByPolynomial) != 0) {
    const unsigned upper = code & ~kByPolynomial;
    return upper == 0 ? 0 : upper << 1U | 1U;
  }
  switch (code) {
    case reg::kScrclenCrc3:
      return 0xB;
    case reg::kScrclenCrc4:
      return 0x13;
    case reg::kScrclenCrc5:
      return 0x25;
    case reg::kScrclenCrc6:
      return 0x43;
    case reg::kScrclenCrc7:
      return 0x89;
    case reg::kScrclenCrc8:
      return 0x12F;
    case reg::kScrclenCrc16:
      return 0x190D9;
    default:
      return 0;
  }
}

WordSetup word_of(const WrittenSetup& setup, unsigned number) {
  const unsigned base = reg::kAddrSlaveCfg + reg::kSlaveCfgStride * (number - 1);
  const unsigned length = setup[base + reg::kSlaveCfgLengthOffset];
  WordSetup word;
  word.number = number;
  word.enabled = (length & reg::kFamilyEnscd.mask(1)) != 0;
  word.bit7 = (length & reg::kFamilyGrays.mask(1)) != 0;
  word.bits = (length & reg::kFamilyScdlen.mask(1)) + 1;
  word.actuator =
      (setup[reg::kFamilyActnsens.address(number)] & reg::kFamilyActnsens.mask(number)) != 0;
  word.crc_code = setup[base + reg::kSlaveCfgCrcOffset];
  word.crc.polynomial = polynomial_of(word.crc_code);
  word.crc.start = setup[base + reg::kSlaveCfgCrcstartLoOffset] |
                   static_cast<unsigned>(setup[base + reg::kSlaveCfgCrcstartHiOffset]) << 8U;
  return word;
}

std::string crc_text(const Crc& crc) { return crc.width() == 0 ? "none" : hex(crc.polynomial); }
std::string crc_register(const WordSetup& word) {
  const bool by_polynomial = (word.crc_code & reg::kSelcrcsByPolynomial) != 0;
  return (by_polynomial ? "SCRCPOLY" : "SCRCLEN") + text_of(word.number) + " = " +
         hex(word.crc_code & 0x7FU, 2);
}
std::string length_register(const WordSetup& word) {
  return "SCDLEN" + text_of(word.number) + " = " + hex(word.bits - 1, 2);
}
std::string place_of(const HintDevice& device) { return "slave " + text_of(device.number); }

// The encoders known by name whose length and CRC the chip has; the first of them.
std::string_view preset_for(const WordSetup& word, std::string_view protocol) {
  for (const Preset& preset : presets()) {
    const DeviceConfig& device = *preset.device;
    if (device.data_bits == word.bits && device.traits().protocol.key == protocol &&
        word.same_crc(device.crc)) {
      return preset.name;
    }
  }
  return "";
}

// One line of the scenario and what the chip has for it.
class LineHints {
 public:
  // `period`: of MA; 0: unknown.
  LineHints(const WrittenSetup& setup, std::uint32_t features, const HintLine& line, bool ssi,
            Time period, std::uint64_t missed)
      : line_(line), ssi_(ssi), period_(period), missed_(missed) {
    const bool split = (setup[reg::kAddrSlaveloc5] & reg::SLAVELOC5::kMask) != 0;
    first_ = line.channel == 1 ? 1 : kSecondLine;
    last_ = split && line.channel == 1 ? kSecondLine - 1 : kWords;
    // A smaller chip has fewer data channels, and ignores what is written to the others.
    const unsigned most = features == 0 ? kWords : page::SLAVES::get(features);
    last_ = std::min(last_, first_ + most - 1);
    for (unsigned x = 1; x <= kWords; ++x) all_[x - 1] = word_of(setup, x);
    for (const HintDevice& device : line.devices) {
      if (device.sends) sending_.push_back(&device);
    }
    for (unsigned x = first_; x <= last_; ++x) {
      if (all_[x - 1].enabled) words_.push_back(&all_[x - 1]);
    }
  }

  bool takes_words() const { return !words_.empty(); }
  bool misses() const {
    return std::any_of(line_.devices.begin(), line_.devices.end(),
                       [this](const HintDevice& one) { return is_missed(one); });
  }

  std::optional<Hint> hint() const {
    if (auto found = too_slow()) return found;
    if (auto found = too_late()) return found;
    for (std::size_t i = 0; i < std::min(words_.size(), sending_.size()); ++i) {
      if (auto found = compare(*words_[i], *sending_[i], i + 1 == words_.size())) {
        if (auto left_out = not_enabled(i)) return left_out;
        return found;
      }
    }
    if (words_.size() > sending_.size() && !repeats()) return too_many();
    for (const HintDevice* device : sending_) {
      if (is_missed(*device) && device->number <= kWords && !all_[device->number - 1].enabled) {
        return Hint{"enable", place_of(*device),
                    "the chip takes no word of " + place_of(*device) + ": ENSCD" +
                        text_of(device->number) + " = 0"};
      }
    }
    return std::nullopt;
  }

  // No word of this line is in the frame.
  Hint no_words() const {
    std::string others;
    for (const WordSetup& word : all_) {
      if (word.enabled) others += (others.empty() ? "" : ", ") + ("ENSCD" + text_of(word.number));
    }
    const std::string channel = "channel " + text_of(line_.channel);
    return {"enable", channel,
            "the chip takes no word of " + channel + ": ENSCD" + text_of(first_) + " = 0" +
                (others.empty() ? "" : "; " + others + " = 1 is of the other channel")};
  }

 private:
  bool repeats() const { return !sending_.empty() && sending_.back()->config->traits().repeats; }
  bool is_missed(const HintDevice& device) const {
    return (missed_ >> (device.number - 1) & 1U) != 0;
  }

  // The encoder's timeout runs out between two edges of MA. A recording has none: it is alone on
  // a line with a start bit.
  std::optional<Hint> too_slow() const {
    if (period_ == 0) return std::nullopt;
    const Time longest = ssi_ ? period_ : period_ / 2;
    for (const HintDevice& device : line_.devices) {
      const DeviceTraits traits = device.config->traits();
      if (traits.timeout == 0 || longest <= traits.timeout) continue;
      if (traits.protocol.start_bit && !traits.alone.empty()) continue;
      return Hint{"ma", place_of(device),
                  "MA has " + std::to_string(kPsPerSecond / period_) + " Hz, so " +
                      time_text(longest) + (ssi_ ? " between falling edges" : " between edges") +
                      "; the timeout of " + place_of(device) + " is " + time_text(traits.timeout) +
                      ": a higher FREQS frequency"};
    }
    return std::nullopt;
  }

  // SSI has no start bit from which the chip could measure the delay.
  std::optional<Hint> too_late() const {
    if (!ssi_ || period_ == 0 || line_.devices.empty()) return std::nullopt;
    const Time late = line_.round_trip + line_.devices.front().config->traits().response;
    if (late < period_) return std::nullopt;
    return Hint{"delay", "channel " + text_of(line_.channel),
                "SSI: a bit comes " + plain(static_cast<double>(late) / kPsPerNs) +
                    " ns after its edge of MA, a period of MA is " +
                    plain(static_cast<double>(period_) / kPsPerNs) +
                    " ns: a lower FREQS frequency or a shorter cable"};
  }

  std::optional<Hint> compare(const WordSetup& word, const HintDevice& device, bool last) const {
    const DeviceConfig& config = *device.config;
    const DeviceTraits traits = config.traits();
    const std::string place = place_of(device);
    const std::string x = text_of(word.number);
    if (!ssi_ && word.actuator != traits.actuator) {
      return Hint{"direction", place,
                  place +
                      (traits.actuator ? " is an actuator, the chip reads it as a sensor"
                                       : " is a sensor, the chip sends to it as an actuator") +
                      ": ACTnSENS" + x + " = " + (word.actuator ? "1" : "0")};
    }
    if (traits.actuator && word.bit7 != traits.stop_bit) {
      return Hint{"length", place,
                  place + (traits.stop_bit ? " has" : " has no") + " stop bit, the chip sends " +
                      (word.bit7 ? "one" : "none") + ": LSTOP" + x + " = " +
                      (word.bit7 ? "1" : "0")};
    }
    const unsigned crc_bits = config.crc.width();
    // The host checks the CRC itself.
    const bool software = word.crc.width() == 0 && crc_bits != 0;
    if (software && word.bits == config.data_bits + crc_bits) return std::nullopt;
    // It takes the repeated word too.
    if (traits.repeats && word.bits > 2 * config.data_bits) return std::nullopt;
    const bool same_length = word.bits == config.data_bits;
    // The last word may leave the CRC on the line.
    const bool same_crc =
        word.same_crc(config.crc) || (last && same_length && word.crc.width() == 0);
    if (!same_length) return other_length(word, device, same_crc);
    if (!same_crc) return other_crc(word, device);
    if (ssi_ && word.bit7 && !traits.gray) {
      return Hint{"gray", place,
                  place + " sends binary, the chip converts from Gray code: GRAYS" + x + " = 1"};
    }
    if (ssi_ && !word.bit7 && traits.gray && is_missed(device)) {
      return Hint{"gray", place,
                  place + " sends Gray code, the chip takes it as binary: GRAYS" + x + " = 0"};
    }
    return std::nullopt;
  }

  Hint other_length(const WordSetup& word, const HintDevice& device, bool same_crc) const {
    const DeviceConfig& config = *device.config;
    const std::string place = place_of(device);
    const std::string lengths = place + " sends " + plural(config.data_bits, "bit") +
                                ", the chip takes " + text_of(word.bits) + " (" +
                                length_register(word) + ")";
    if (same_crc) return {"length", place, lengths};
    const std::string both = lengths + "; its CRC is " + crc_text(config.crc) +
                             ", that of the chip " + crc_text(word.crc) + " (" +
                             crc_register(word) + ")";
    const std::string_view preset = preset_for(word, line_.protocol);
    if (preset.empty() || word.crc.width() == 0) return {"length", place, both};
    return {"preset", place,
            both + "; the chip is set up for \"" + std::string(preset) + "\", " + place + " is \"" +
                config.name + "\""};
  }

  static Hint other_crc(const WordSetup& word, const HintDevice& device) {
    const Crc& crc = device.config->crc;
    const std::string place = place_of(device);
    const bool only_start = word.crc.polynomial == crc.polynomial;
    const std::uint32_t mask = (std::uint32_t{1} << crc.width()) - 1;
    return {"crc", place,
            only_start ? "the CRC of " + place + " starts with " + hex(crc.start & mask) +
                             ", that of the chip with " + hex(word.crc.start & mask) +
                             " (SCRCSTART" + text_of(word.number) + ")"
                       : "the CRC of " + place + " is " + crc_text(crc) + ", that of the chip " +
                             crc_text(word.crc) + " (" + crc_register(word) + ")"};
  }

  // Whether word `index` does not fit because one before it is not enabled: the data channel of the
  // slave's place has the right length and CRC, but is off.
  std::optional<Hint> not_enabled(std::size_t index) const {
    const std::size_t place = first_ - 1 + index;
    if (words_.size() >= sending_.size() || place >= last_) return std::nullopt;
    const WordSetup& own = all_[place];
    const HintDevice& device = *sending_[index];
    if (own.enabled || compare(own, device, false)) return std::nullopt;
    return Hint{"enable", place_of(device),
                "the chip takes the word of " + place_of(device) + " for SCDATA" +
                    text_of(words_[index]->number) + ": ENSCD" + text_of(own.number) + " = 0"};
  }

  Hint too_many() const {
    std::string which;
    for (const WordSetup* word : words_) {
      which += (which.empty() ? "ENSCD" : ", ENSCD") + text_of(word->number);
    }
    const std::string channel = "channel " + text_of(line_.channel);
    return {"enable", channel,
            channel + " has " + plural(sending_.size(), "slave") +
                (sending_.size() < line_.devices.size() ? " that sends data" : "") +
                ", the chip takes " + plural(words_.size(), "word") + ": " + which + " = 1"};
  }

  const HintLine& line_;
  bool ssi_;
  Time period_;
  std::uint64_t missed_;
  unsigned first_ = 1;
  unsigned last_ = kWords;
  std::array<WordSetup, kWords> all_;
  std::vector<const HintDevice*> sending_;
  std::vector<const WordSetup*> words_;  // that are in the frame
};

unsigned protocol_code(const WrittenSetup& setup, unsigned line) {
  return setup[reg::kAddrCfgch] >> reg::kFamilyCfgch.shift(line) & kUnused;
}

bool used(const WrittenSetup& setup, unsigned line) {
  return protocol_code(setup, line) != kUnused &&
         (line == 1 || (setup[reg::kAddrSlaveloc5] & reg::SLAVELOC5::kMask) != 0);
}

std::string cfgch(const WrittenSetup& setup, unsigned line) {
  return "CFGCH" + text_of(line) + " = " + text_of(protocol_code(setup, line));
}

Hint unused_line(const WrittenSetup& setup, const HintLine& line) {
  const std::string channel = "channel " + text_of(line.channel);
  return {"channel", channel,
          "the chip does not use " + channel + ", where " + plural(line.devices.size(), "slave") +
              (line.devices.size() == 1 ? " is: " : " are: ") +
              (protocol_code(setup, line.channel) == kUnused ? cfgch(setup, line.channel)
                                                             : "SLAVELOC5 = 0")};
}

// What the line needs and a smaller chip lacks; empty: nothing.
std::string lacks(std::uint32_t features, unsigned line, unsigned protocol) {
  if (features == 0) return "";  // the full chip
  const auto has = [&](std::uint32_t mask) { return (features & mask) != 0; };
  if (line == 2 && !has(page::TWO_LINES::kMask)) return "a second line";
  if (protocol == kSsi && !has(page::SSI::kMask)) return "SSI";
  if (protocol == kBissB && !has(page::BISS_B::kMask)) return "BiSS B";
  return "";
}

std::uint8_t reversed(std::uint8_t byte) {
  unsigned out = 0;
  for (unsigned bit = 0; bit < 8; ++bit) out |= (byte >> bit & 1U) << (7 - bit);
  return static_cast<std::uint8_t>(out);
}

bool is_opcode(std::uint8_t byte) {
  return std::find(kOpcodes.begin(), kOpcodes.end(), byte) != kOpcodes.end();
}

}  // namespace

std::vector<Hint> setup_hints(const WrittenSetup& setup, std::uint32_t features,
                              const SetupClock& clock, std::span<const HintLine> lines,
                              std::uint64_t missed) {
  const bool oscillator =
      clock.oscillator_hz != 0 && (setup[reg::kAddrIface] & reg::CLKENI::kMask) != 0;
  const std::optional<std::uint64_t> clk_hz =
      oscillator ? std::optional(clock.oscillator_hz) : clock.pin_hz;
  if (clk_hz == std::uint64_t{0}) {
    return {{"clock", "chip",
             "the chip has no clock: pin CLK is not connected (f_clk_hz = 0) and CLKENI = 0"}};
  }
  const unsigned freqs = setup[reg::kAddrFreq] & reg::FREQS::kMask;
  const Time period = clk_hz ? 2 * half_ma_clocks(freqs) * kPsPerSecond / *clk_hz : 0;
  std::vector<Hint> hints;
  std::vector<const HintLine*> unused;
  std::optional<Hint> no_words;
  bool any_words = false;
  bool any_used = false;
  for (const HintLine& line : lines) {
    if (line.channel > kLines) continue;
    if (!used(setup, line.channel)) {
      if (!line.devices.empty()) unused.push_back(&line);
      continue;
    }
    any_used = any_used || !line.devices.empty();
    const unsigned code = protocol_code(setup, line.channel);
    if (!line.devices.empty() && line.protocol != kProtocols[code]) {
      const std::string channel = "channel " + text_of(line.channel);
      hints.push_back({"protocol", channel,
                       channel + " has " + std::string(line.protocol_title) + ", the chip speaks " +
                           std::string(kTitles[code]) + ": " + cfgch(setup, line.channel)});
      continue;
    }
    if (const std::string what = lacks(features, line.channel, code); !what.empty()) {
      const std::string channel = "channel " + text_of(line.channel);
      hints.push_back(
          {"features", channel,
           channel + " needs " + what + ", which this chip does not have: [chip] features"});
      continue;
    }
    const LineHints one(setup, features, line, code == kSsi, period, missed);
    any_words = any_words || one.takes_words();
    if (!one.takes_words()) {
      if (line.devices.empty()) continue;
      if (!no_words) no_words = one.no_words();
      if (one.misses()) {
        hints.push_back(one.no_words());
        no_words.reset();
      }
    } else if (const auto hint = one.hint()) {
      hints.push_back(*hint);
    }
  }
  if (hints.empty() && !any_words && no_words) hints.push_back(*no_words);
  for (const HintLine* line : unused) {
    const bool missing = std::any_of(
        line->devices.begin(), line->devices.end(),
        [missed](const HintDevice& one) { return (missed >> (one.number - 1) & 1U) != 0; });
    // A host may well leave one of two lines out.
    if (missing || (!any_used && line == unused.front()))
      hints.push_back(unused_line(setup, *line));
  }
  return hints;
}

std::vector<Hint> host_hints(std::span<const std::uint8_t> opcodes, const HostCheck& check) {
  std::vector<Hint> hints;
  std::string known;
  for (const std::uint8_t opcode : kOpcodes) {
    known += (known.empty() ? "" : ", ") + hex(opcode, 2);
  }
  for (const std::uint8_t opcode : opcodes) {
    const std::uint8_t other = reversed(opcode);
    hints.push_back({"opcode", "host",
                     "SPI opcode " + hex(opcode, 2) + " does nothing; the chip has " + known +
                         (is_opcode(other)
                              ? "; it is " + hex(other, 2) + " with the least significant bit first"
                              : "")});
  }
  for (const HostCheck::Violation& violation : check.violations()) {
    const bool phase =
        violation.item == "I203" || violation.text.find("SCLK high for") != std::string::npos;
    if (!phase) continue;
    hints.push_back({"sclk", "host", "SCLK is faster than 50 MHz: " + violation.text});
    break;
  }
  return hints;
}

}  // namespace mb4::sim
