// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "biss_c.h"

#include "biss_axi/device.hpp"

namespace {

namespace regs = biss_axi::regs;

constexpr std::uint32_t kMostMaHz = 10'000'000;

struct Port {
  int hdev;
  bool write(std::uint32_t offset, std::uint32_t value) const {
    return biss_c_port_write(hdev, offset, value) == 0;
  }
  bool read(std::uint32_t offset, std::uint32_t& value) const {
    return biss_c_port_read(hdev, offset, &value) == 0;
  }
};

struct Clock {
  int hdev;
  std::uint32_t now_us() const { return biss_c_port_now_us(hdev); }
};

int set(int hdev, std::uint32_t offset, std::uint32_t value) {
  return Port{hdev}.write(offset, value) ? 0 : BISS_C_BUS;
}

bool within(int value, int least, std::uint32_t most) {
  return value >= least && static_cast<std::uint32_t>(value) <= most;
}

}  // namespace

int BISS_C_Init(int hdev) {
  const std::uint32_t half = biss_axi::divider_at_most(biss_c_port_clk_hz(hdev), kMostMaHz);
  const Port port{hdev};
  const bool done = half >= 1 && half <= regs::MA_DIVIDER::kMax &&
                    port.write(regs::kAddrSoftReset, 1) && port.write(regs::kAddrMode, 1) &&
                    port.write(regs::kAddrRequest, 0) && port.write(regs::kAddrSampleClock, 0) &&
                    port.write(regs::kAddrMaDivider, half) &&
                    port.write(regs::kAddrPositionBits, 32) && port.write(regs::kAddrCrcCheck, 1) &&
                    port.write(regs::kAddrChannelEnable, 1) && port.write(regs::kAddrSoftReset, 0);
  return done ? 0 : BISS_C_BUS;
}

int BISS_C_IgnoreCRC(int hdev, int ignoreCRC) {
  return set(hdev, regs::kAddrCrcCheck, ignoreCRC != 0 ? 0 : 1);
}

int BISS_C_CheckAjustDelay(int hdev, int channelIndex, int* maSloDelayTicks) {
  if (maSloDelayTicks == nullptr || !within(channelIndex, 0, regs::kChannels - 1))
    return BISS_C_ARGUMENT;
  Port port{hdev};
  const auto delay =
      biss_axi::channel_word(port, static_cast<unsigned>(channelIndex), regs::kAddrLineDelay);
  if (!delay) return BISS_C_BUS;
  *maSloDelayTicks = static_cast<int>(*delay);
  return 0;
}

int BISS_C_ConfigSampleClk(int hdev, int highlowTicksNum, bool isExtSampleClk) {
  if (!within(highlowTicksNum, isExtSampleClk ? 0 : 1, regs::SAMPLE_DIVIDER::kMax))
    return BISS_C_ARGUMENT;
  const Port port{hdev};
  const bool done =
      port.write(regs::kAddrSampleDivider, static_cast<std::uint32_t>(highlowTicksNum)) &&
      port.write(regs::kAddrSampleClock, isExtSampleClk ? 1 : 0) && port.write(regs::kAddrMode, 0);
  return done ? 0 : BISS_C_BUS;
}

int BISS_C_ConfigMAClk(int hdev, int highlowTicksNum) {
  if (!within(highlowTicksNum, 1, regs::MA_DIVIDER::kMax)) return BISS_C_ARGUMENT;
  return set(hdev, regs::kAddrMaDivider, static_cast<std::uint32_t>(highlowTicksNum));
}

int BISS_C_ConfigPositionDatabits(int hdev, int bitsNum) {
  if (!within(bitsNum, 1, 32)) return BISS_C_ARGUMENT;
  return set(hdev, regs::kAddrPositionBits, static_cast<std::uint32_t>(bitsNum));
}

int BISS_C_ConfigChannels(int hdev, int channelEnable) {
  if (!within(channelEnable, 0, regs::CHANNEL_ENABLE::kMax)) return BISS_C_ARGUMENT;
  return set(hdev, regs::kAddrChannelEnable, static_cast<std::uint32_t>(channelEnable));
}

int BISS_C_ReadSinglePoint(int hdev, int channelIndex, unsigned int* data, bool* isValid) {
  if (data == nullptr || isValid == nullptr || !within(channelIndex, 0, regs::kChannels - 1))
    return BISS_C_ARGUMENT;
  *data = 0;
  *isValid = false;
  Port port{hdev};
  Clock clock{hdev};
  std::uint32_t divider = 0;
  std::uint32_t bits = 0;
  if (!port.write(regs::kAddrMode, 1) || !port.read(regs::kAddrMaDivider, divider) ||
      !port.read(regs::kAddrPositionBits, bits)) {
    return BISS_C_BUS;
  }
  const biss_axi::WaitTimes times = biss_axi::wait_times(
      biss_c_port_clk_hz(hdev), divider == 0 ? 1 : divider, bits == 0 || bits > 32 ? 32 : bits);
  const auto channel = static_cast<unsigned>(channelIndex);
  const auto good = biss_axi::single_point(port, clock, times, 1U << channel);
  if (!good) return BISS_C_BUS;
  if ((*good >> channel & 1U) == 0) return 0;
  const auto word = biss_axi::read_position<std::uint32_t>(port, channel);
  if (word.has_reading()) *data = word.reading().position;
  *isValid = word.ok();
  switch (word.error()) {
    case biss_axi::Error::kNone:
      return 0;
    case biss_axi::Error::kSlaveError:
      return BISS_C_SLAVE_ERROR;
    case biss_axi::Error::kCrc:
      return BISS_C_CRC;
    default:
      return BISS_C_BUS;
  }
}
