// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/control.hpp"

#include "tests/reference/pru/division.hpp"

namespace pru_judge {

std::optional<unsigned> Control::slot() const {
  if (!running_ || taken_ < kLeadIn) return std::nullopt;
  return taken_ - kLeadIn;
}

bool Control::cdm() const {
  const std::optional<unsigned> at = slot();
  if (!at) return false;
  return *at == 0 || (word_ >> (kSlots - *at) & 1U) != 0;
}

void Control::take(std::uint32_t word) {
  running_ = true;
  word_ = word;
  taken_ = 0;
  cds_.clear();
}

std::optional<ControlResult> Control::step(bool cds) {
  if (!running_) return std::nullopt;
  const std::optional<unsigned> at = slot();
  ++taken_;
  if (at && *at >= 20) cds_ += cds ? '1' : '0';
  if (!at || *at != kSlots - 1) return std::nullopt;
  running_ = false;
  const std::string data = cds_.substr(0, 8);
  const std::string crc = cds_.substr(8);
  return ControlResult{static_cast<std::uint8_t>(number(data)),
                       static_cast<std::uint8_t>(number(crc)), crc != control_crc(data)};
}

}  // namespace pru_judge
