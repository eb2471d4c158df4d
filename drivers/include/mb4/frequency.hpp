// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Clock dividers: frequency at MA and repetition of automatic frames (datasheet page 30).

#ifndef MB4_FREQUENCY_HPP_
#define MB4_FREQUENCY_HPP_

#include <cstdint>

#include "mb4/result.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// ---- MA frequency: table 35 ---------------------------------------------------------------------

inline constexpr std::uint8_t kFreqsCodes = 32;

// f_CLK / f_MA for a FREQS code 0..31; 0 for code 0x10 (not permitted) and for codes above 31.
[[nodiscard]] constexpr std::uint32_t ma_divider(std::uint8_t freqs_code) {
  if (freqs_code < 0x10) {
    return 2U * (freqs_code + 1U);
  }
  if (freqs_code > 0x10 && freqs_code < kFreqsCodes) {
    return 20U * (freqs_code - 15U);
  }
  return 0;
}

// FREQS code whose frequency, rounded down to whole hertz, is `ma_hz`. kInvalidConfig (kMaHz) when
// there is none.
[[nodiscard]] constexpr Result<std::uint8_t> freqs_code(std::uint32_t f_clk_hz,
                                                        std::uint32_t ma_hz) {
  for (std::uint8_t code = 0; code < kFreqsCodes; ++code) {
    const std::uint32_t divider = ma_divider(code);
    if (divider != 0 && f_clk_hz / divider == ma_hz && ma_hz != 0) {
      return code;
    }
  }
  return ErrorInfo(Error::kInvalidConfig, ConfigField::kMaHz, 0);
}

// Highest frequency of table 35 that does not exceed `limit_hz`, in whole hertz, rounded down;
// 0 when even f_CLK / 320 is too fast.
[[nodiscard]] constexpr std::uint32_t ma_hz_at_most(std::uint32_t f_clk_hz,
                                                    std::uint32_t limit_hz) {
  std::uint32_t best_hz = 0;
  for (std::uint8_t code = 0; code < kFreqsCodes; ++code) {
    const std::uint32_t divider = ma_divider(code);
    if (divider == 0) {
      continue;
    }
    const std::uint32_t ma_hz = f_clk_hz / divider;
    // The comparison is exact: f / divider <= limit, without the rounding.
    const std::uint32_t rounded_up = ma_hz + (f_clk_hz % divider != 0 ? 1U : 0U);
    if (rounded_up <= limit_hz && ma_hz > best_hz) {
      best_hz = ma_hz;
    }
  }
  return best_hz;
}

// ---- Frame repetition: table 37 -----------------------------------------------------------------

// System clocks from frame to frame for a FREQAGS code; 0 for AGSMIN and AGSINFINITE (0x7C..0x7F).
[[nodiscard]] constexpr std::uint32_t ags_period_clk(std::uint8_t freqags_code) {
  if (freqags_code < static_cast<std::uint8_t>(regs::AgsRate::kAgsMin)) {
    return 20U * (freqags_code + 1U);
  }
  return freqags_code < 0x80 ? 0U : 625U * (freqags_code - 127U);
}

// FREQAGS code of a period in system clocks: 20 to 2480 in steps of 20, 625 to 80'000 in steps of
// 625. kInvalidConfig (kFramePeriodClk) for any other.
[[nodiscard]] constexpr Result<std::uint8_t> freqags_code(std::uint32_t period_clk) {
  for (unsigned code = 0; code <= 0xFF; ++code) {
    if (period_clk != 0 && ags_period_clk(static_cast<std::uint8_t>(code)) == period_clk) {
      return static_cast<std::uint8_t>(code);
    }
  }
  return ErrorInfo(Error::kInvalidConfig, ConfigField::kFramePeriodClk, 0);
}

// Shortest period of table 37, in system clocks, that is at least `period_ns`; 0 when 80'000 clocks
// are shorter.
[[nodiscard]] constexpr std::uint32_t frame_period_clk_at_least(std::uint32_t f_clk_hz,
                                                                std::uint32_t period_ns) {
  std::uint32_t best_clk = 0;
  for (unsigned code = 0; code <= 0xFF; ++code) {
    const std::uint32_t clk = ags_period_clk(static_cast<std::uint8_t>(code));
    // Exact: clk / f_clk >= period, without rounding.
    if (clk != 0 && clk * std::uint64_t{1'000'000'000} >= std::uint64_t{period_ns} * f_clk_hz &&
        (best_clk == 0 || clk < best_clk)) {
      best_clk = clk;
    }
  }
  return best_clk;
}

// Shortest period of table 37, in system clocks, whose rate does not exceed `limit_hz`; 0 when
// there is none.
[[nodiscard]] constexpr std::uint32_t frame_period_clk_at_most_hz(std::uint32_t f_clk_hz,
                                                                  std::uint32_t limit_hz) {
  std::uint32_t best_clk = 0;
  for (unsigned code = 0; code <= 0xFF; ++code) {
    const std::uint32_t clk = ags_period_clk(static_cast<std::uint8_t>(code));
    if (clk != 0 && std::uint64_t{clk} * limit_hz >= f_clk_hz &&
        (best_clk == 0 || clk < best_clk)) {
      best_clk = clk;
    }
  }
  return best_clk;
}

}  // namespace mb4

#endif  // MB4_FREQUENCY_HPP_
