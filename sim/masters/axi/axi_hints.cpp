// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/axi_hints.hpp"

#include <algorithm>
#include <string>

#include "axi_regs.hpp"
#include "sim/lines/device.hpp"
#include "sim/masters/axi/axi_model.hpp"

namespace mb4::sim {
namespace {

namespace regs = biss_axi::regs;

constexpr unsigned kAxiFlags = 2;           // nE and nW
constexpr std::uint32_t kPageBegin = 0x40;  // words from here on are written whole
constexpr unsigned kAllStrobes = 0xF;

std::string polynomial_text(std::uint32_t polynomial) {
  if (polynomial == 0) return "none";
  std::string text;
  for (; polynomial != 0; polynomial >>= 4U) {
    text.insert(text.begin(), "0123456789ABCDEF"[polynomial & 0xFU]);
  }
  return "0x" + text;
}

}  // namespace

bool AxiSetup::single_point() const {
  return (now_[regs::kAddrMode / 4] & regs::SINGLE_POINT::kMask) != 0;
}

void AxiSetup::written(std::uint32_t address, std::uint32_t data, std::uint8_t strobe) {
  if (address >= kEnd || (address >= kPageBegin && strobe != kAllStrobes)) return;
  std::uint32_t mask = 0;
  for (unsigned byte = 0; byte < 4; ++byte) {
    if ((strobe >> byte & 1U) != 0) mask |= 0xFFU << (8 * byte);
  }
  std::uint32_t& word = now_[address / 4];
  const bool was_asking = (now_[regs::kAddrRequest / 4] & regs::REQUEST::kMask) != 0;
  word = (word & ~mask) | (data & mask);
  const bool asks = (now_[regs::kAddrRequest / 4] & regs::REQUEST::kMask) != 0;
  if (!asks || was_asking || !single_point()) return;
  asked_ = true;
  taken_ = now_;
}

std::vector<Hint> AxiSetup::hints(const ChipConfig& chip, std::span<const HintLine> lines,
                                  std::uint64_t missed) const {
  if (!asked_ || !single_point()) return {};
  const bool full = chip.features != kAxiDocument;
  const unsigned most = full ? 64 : 32;
  unsigned position = taken_[regs::kAddrPositionBits / 4] & regs::POSITION_BITS::kMask;
  if (position == 0 || position > most) position = most;
  std::uint32_t enabled = taken_[regs::kAddrChannelEnable / 4];
  if ((chip.quirks & kAxiEnableActiveLow) != 0) enabled = ~enabled;
  const bool checks = ((taken_[regs::kAddrCrcCheck / 4] & regs::CRC_CHECK::kMask) != 0) !=
                      ((chip.quirks & kAxiCrcBitIgnores) != 0);
  const std::uint32_t written = full ? taken_[regs::kAddrCrcPolynomial / 4] : 0;
  Crc crc;
  crc.polynomial = written <= 1 ? 0x43 : written;
  const std::uint32_t mask = (1U << crc.width()) - 1;
  crc.start = full ? taken_[regs::kAddrCrcStart / 4] & mask : 0;

  std::vector<Hint> hints;
  bool any = false;
  for (const HintLine& line : lines) {
    if (line.devices.size() != 1) continue;
    const HintDevice& device = line.devices.front();
    const bool on = (enabled >> (line.channel - 1) & 1U) != 0;
    any = any || on;
    if (!on) {
      if ((missed >> (device.number - 1) & 1U) == 0) continue;
      hints.push_back({"enable", "channel " + std::to_string(line.channel),
                       "channel " + std::to_string(line.channel) +
                           " is not enabled: CHANNEL_ENABLE bit " +
                           std::to_string(line.channel - 1)});
      continue;
    }
    const std::string place = "slave " + std::to_string(device.number);
    const DeviceConfig& config = *device.config;
    if (position + kAxiFlags != config.data_bits) {
      hints.push_back({"length", place,
                       place + " sends " + std::to_string(config.data_bits) +
                           " bits, the master takes " + std::to_string(position + kAxiFlags) +
                           " (POSITION_BITS = " + std::to_string(position) + ", nE, nW)"});
    } else if (checks && config.crc.polynomial != crc.polynomial) {
      hints.push_back({"crc", place,
                       "the CRC of " + place + " is " + polynomial_text(config.crc.polynomial) +
                           ", that of the master " + polynomial_text(crc.polynomial)});
    } else if (checks && ((config.crc.start ^ crc.start) & mask) != 0) {
      hints.push_back({"crc", place,
                       "the CRC of " + place +
                           " and that of the master start with other values "
                           "(CRC_START)"});
    }
  }
  if (!any && hints.empty() && !lines.empty()) {
    hints.push_back({"enable", "chip", "no channel with an encoder is enabled: CHANNEL_ENABLE"});
  }
  return hints;
}

}  // namespace mb4::sim
