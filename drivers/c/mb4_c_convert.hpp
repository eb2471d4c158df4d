// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Converts between the types of mb4.h and those of the driver, for the C binding and for Python.

#ifndef MB4_C_CONVERT_HPP_
#define MB4_C_CONVERT_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4.h"
#include "mb4/mb4.hpp"
#include "mb4/safety.hpp"

namespace mb4_c {

static_assert(static_cast<int>(mb4::Error::kJump) == MB4_JUMP);
static_assert(static_cast<int>(mb4::Error::kNoWord) == MB4_NO_WORD);
static_assert(static_cast<int>(mb4::Protocol::kUnused) == MB4_PROTOCOL_UNUSED);
static_assert(static_cast<int>(mb4::LineInterface::kLvds) == MB4_LINE_LVDS);
static_assert(static_cast<int>(mb4::ClockSource::kInternal) == MB4_CLOCK_INTERNAL);
static_assert(static_cast<int>(mb4::FrameStart::kPeriodic) == MB4_START_PERIODIC);
static_assert(static_cast<int>(mb4::SpiCheck::kFull) == MB4_SPI_CHECK_FULL);
static_assert(static_cast<int>(mb4::SafetyCheck::kLifeKnown) == MB4_SAFETY_LIFE_KNOWN);
static_assert(static_cast<int>(mb4::SafetyCheck::kSafetyError) == MB4_SAFETY_SAFETY_ERROR);
static_assert(enc::kNoBit == MB4_NO_BIT);

inline mb4_result to_c(const mb4::ErrorInfo& info) {
  return {static_cast<std::uint8_t>(info.code), static_cast<std::uint8_t>(info.field), info.number,
          info.detail};
}
template <typename T>
mb4_result to_c(const mb4::Result<T>& result) {
  return to_c(result.info());
}

inline mb4_reading to_c(const mb4::Reading& reading) {
  return {reading.raw,         reading.position,      reading.crc,  reading.crc_stored,
          reading.slave_error, reading.slave_warning, reading.slave};
}

inline mb4_result store(const mb4::Result<mb4::Reading>& result, mb4_reading* reading) {
  if (result.has_reading()) {
    *reading = to_c(result.reading());
  }
  return to_c(result);
}

inline mb4_result store(const mb4::Result<void>& result, const mb4::Frame& frame, mb4_frame* out) {
  *out = mb4_frame{};
  for (std::size_t slave = 1; slave <= mb4::kSlaves; ++slave) {
    out->code[slave - 1] = static_cast<std::uint8_t>(frame[slave].error());
    if (frame[slave].has_reading()) {
      out->reading[slave - 1] = to_c(frame[slave].reading());
    }
  }
  for (std::size_t i = 0; i < mb4::Status::kBytes; ++i) {
    out->status[i] = frame.status.bytes()[i];
  }
  out->one_frame = frame.one_frame;
  return to_c(result);
}

inline mb4_config to_c(const mb4::Config& config) {
  const auto number = [](auto value) { return static_cast<std::uint8_t>(value); };
  mb4_config out{};
  out.f_clk_hz = config.f_clk_hz;
  out.ma_hz = config.ma_hz;
  out.frame_period_clk = config.frame_period_clk;
  out.frame_timeout_us = config.frame_timeout_us;
  out.register_busy_us = config.register_busy_us;
  out.clock_source = number(config.clock_source);
  out.line_interface = number(config.line_interface);
  out.frame_start = number(config.frame_start);
  out.spi_check = number(config.spi_check);
  out.single_bank = config.single_bank;
  out.hold_cdm = config.hold_cdm;
  out.mo = config.mo;
  out.mo_busy = config.mo_busy;
  out.register_divider = config.register_divider;
  out.register_timeout_us = config.register_timeout_us;
  out.hold_beside_access = config.hold_beside_access;
  out.activate_at_initialize = config.activate_at_initialize;
  out.pin_period_us = config.pin_period_us;
  for (std::size_t i = 0; i < mb4::kChannels; ++i) {
    out.protocol[i] = number(config.channels[i].protocol);
  }
  for (std::size_t i = 0; i < mb4::kSlaves; ++i) {
    out.slaves[i] = mb4::detail::to_c(config.slaves[i]);
  }
  return out;
}

inline mb4::Config from_c(const mb4_config& config) {
  mb4::Config out;
  out.f_clk_hz = config.f_clk_hz;
  out.ma_hz = config.ma_hz;
  out.frame_period_clk = config.frame_period_clk;
  out.frame_timeout_us = config.frame_timeout_us;
  out.register_busy_us = config.register_busy_us;
  out.clock_source = static_cast<mb4::ClockSource>(config.clock_source);
  out.line_interface = static_cast<mb4::LineInterface>(config.line_interface);
  out.frame_start = static_cast<mb4::FrameStart>(config.frame_start);
  out.spi_check = static_cast<mb4::SpiCheck>(config.spi_check);
  out.single_bank = config.single_bank;
  out.hold_cdm = config.hold_cdm;
  out.mo = config.mo;
  out.mo_busy = config.mo_busy;
  out.register_divider = config.register_divider;
  out.register_timeout_us = config.register_timeout_us;
  out.hold_beside_access = config.hold_beside_access;
  out.activate_at_initialize = config.activate_at_initialize;
  out.pin_period_us = config.pin_period_us;
  for (std::size_t i = 0; i < mb4::kChannels; ++i) {
    out.channels[i].protocol = static_cast<mb4::Protocol>(config.protocol[i]);
  }
  for (std::size_t i = 0; i < mb4::kSlaves; ++i) {
    out.slaves[i].enabled = config.slaves[i].enabled;
    out.slaves[i].data_bits = config.slaves[i].data_bits;
    out.slaves[i].flags = static_cast<mb4::Flags>(config.slaves[i].flags);
    out.slaves[i].crc_start = config.slaves[i].crc_start;
    out.slaves[i].crc_polynomial = config.slaves[i].crc_polynomial;
    out.slaves[i].gray = config.slaves[i].gray;
    out.slaves[i].actuator = config.slaves[i].actuator;
    out.slaves[i].stop_bit = config.slaves[i].stop_bit;
  }
  return out;
}

inline mb4::Command from_c(const mb4_command& command) {
  mb4::Command out;
  out.channels = command.channels;
  out.ids = command.ids;
  out.code = command.code;
  out.test_acknowledge = command.test_acknowledge;
  return out;
}

inline mb4_safety_word to_c(const mb4::SafetyWord& word) {
  return {word.data_bits,     word.position_bits, word.position_place, word.error_place,
          word.warning_place, word.crc_start,     word.crc_polynomial};
}
inline mb4::SafetyWord from_c(const mb4_safety_word& word) {
  return {word.data_bits,     word.position_bits,  word.position_place, word.error_place,
          word.warning_place, word.crc_polynomial, word.crc_start};
}
inline mb4_safety_config to_c(const mb4::SafetyConfig& config) {
  return {to_c(config.control), to_c(config.safety),  config.life_bits,    config.life_place,
          config.life_first,    config.control_shift, config.safety_shift, config.safety_inverted,
          config.compare_bits,  config.safety_offset, config.tolerance};
}
inline mb4::SafetyConfig from_c(const mb4_safety_config& config) {
  return {from_c(config.control), from_c(config.safety),  config.life_bits,
          config.life_place,      config.life_first,      config.control_shift,
          config.safety_shift,    config.safety_inverted, config.compare_bits,
          config.safety_offset,   config.tolerance};
}

// The word of a slave (1..8) in a frame; null: no frame.
inline mb4::SafetyWordRead safety_word(const mb4_frame* frame, std::uint8_t slave) {
  if (frame == nullptr || slave < 1 || slave > mb4::kSlaves) {
    return {};
  }
  const auto error = static_cast<mb4::Error>(frame->code[slave - 1]);
  if (!mb4::detail::has_reading(frame->code[slave - 1])) {
    return mb4::safety_word(error);
  }
  const mb4_reading& from = frame->reading[slave - 1];
  mb4::Reading reading;
  reading.raw = from.raw;
  reading.crc = from.crc;
  reading.crc_stored = from.crc_stored;
  return mb4::safety_word(reading);
}

inline mb4::Span<const std::uint8_t> bytes(const std::uint8_t* data, std::size_t size) {
  return mb4::Span<const std::uint8_t>(data, size);
}
inline mb4::Span<std::uint8_t> bytes(std::uint8_t* data, std::size_t size) {
  return mb4::Span<std::uint8_t>(data, size);
}

}  // namespace mb4_c

#endif  // MB4_C_CONVERT_HPP_
