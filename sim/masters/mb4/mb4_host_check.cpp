// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/mb4_host_check.hpp"

#include <algorithm>

namespace mb4::sim {
namespace {

constexpr Time kPhase = 10 * kPsPerNs;         // I001, I004 to I007, I010 to I013, I016, I2xx
constexpr Time kBusData = 15 * kPsPerNs;       // I002, I003, I014, I015
constexpr Time kMosi = 7'500;                  // I205, I206
constexpr Time kAddressHigh = 100 * kPsPerNs;  // I204
constexpr unsigned kOpcodeBits = 8;
constexpr unsigned kAddressBits = 16;
constexpr unsigned kOpcodeRead = 0x03;

bool is_data(Pin pin) { return pin >= Pin::kDb0 && pin <= Pin::kDb7; }

}  // namespace

Time Mb4HostCheck::data_changed() const {
  return *std::max_element(changed_.begin(), changed_.begin() + 8);
}

void Mb4HostCheck::edge(Time now, Pin pin, bool level) {
  if (this->level(pin) == level) return;
  levels_[static_cast<std::size_t>(pin)] = level;
  if (this->level(Pin::kNres)) {
    if (!this->level(Pin::kCfgspi)) {
      check_parallel(now, pin, level);
    } else {
      check_serial(now, spi_, pin, level);
      if (!this->level(Pin::kNwrE)) check_serial(now, spi2_, pin, level);
    }
  }
  changed(pin) = now;
}

void Mb4HostCheck::check_serial(Time now, Serial& serial, Pin pin, bool level) {
  if (pin == serial.sclk) {
    if (this->level(serial.ncs)) return;
    if (!level) {
      need(now, "I204", "SCLK high for", changed(serial.sclk), kPhase);
      if (serial.bits == kAddressBits && serial.opcode == kOpcodeRead) {
        serial.address_high = now - changed(serial.sclk);
      }
      return;
    }
    need(now, "I203", "SCLK low for", changed(serial.sclk), kPhase);
    need(now, "I201", "NCS low before SCLK rises for", changed(serial.ncs), kPhase);
    need(now, "I205", "MOSI stable before SCLK rises for", changed(serial.mosi), kMosi);
    if (serial.bits < kOpcodeBits) {
      serial.opcode = serial.opcode << 1U | (this->level(serial.mosi) ? 1U : 0U);
    } else if (serial.bits == kAddressBits && serial.address_high != kNever) {
      need(now, "I204", "SCLK high between address and data of 0x03 for", now - serial.address_high,
           kAddressHigh);
    }
    ++serial.bits;
  } else if (pin == serial.mosi) {
    if (!this->level(serial.ncs) && this->level(serial.sclk)) {
      need(now, "I206", "MOSI stable after SCLK has risen for", changed(serial.sclk), kMosi);
    }
  } else if (pin == serial.ncs) {
    if (level) {
      need(now, "I202", "NCS low after SCLK has fallen for", changed(serial.sclk), kPhase);
    } else {
      need(now, "I209", "NCS high for", changed(serial.ncs), kPhase);
      serial.bits = 0;
      serial.opcode = 0;
      serial.address_high = kNever;
    }
  }
}

void Mb4HostCheck::begin_strobe(Time now, bool read) {
  const bool intel = level(Pin::kIntNmot);
  const char* const item = !intel ? "I105" : read ? "I005" : "I011";
  need(now, item, "ALE low before the strobe for", changed(Pin::kAle), kPhase);
  if (!intel) {
    need(now, "I107", "RNW stable before E rises for", changed(Pin::kNrdRnw), kPhase);
  }
  strobe_begin_ = now;
}

void Mb4HostCheck::end_strobe(Time now, bool read) {
  const bool intel = level(Pin::kIntNmot);
  need(now, !intel ? "I109" : read ? "I007" : "I013", "strobe for", strobe_begin_, kPhase);
  if (!read) {
    need(now, intel ? "I014" : "I112", "data stable before the end of the strobe for",
         data_changed(), kBusData);
    written_ = now;
  }
  strobe_end_ = now;
  was_read_ = read;
}

void Mb4HostCheck::check_data(Time now) {
  const bool intel = level(Pin::kIntNmot);
  need(now, intel ? "I003" : "I103", "data stable after ALE has fallen for", address_latched_,
       kBusData);
  need(now, intel ? "I015" : "I113", "data stable after the strobe for", written_, kBusData);
}

void Mb4HostCheck::check_parallel(Time now, Pin pin, bool level) {
  const bool intel = this->level(Pin::kIntNmot);
  const bool selected = !this->level(Pin::kNcs);
  if (is_data(pin)) return check_data(now);
  if (pin == Pin::kNcs && level) {
    need(now,
         !intel      ? "I114"
         : was_read_ ? "I010"
                     : "I016",
         "NCS low after the strobe for", strobe_end_, kPhase);
  }
  if (!selected) return;
  if (pin == Pin::kAle && level) {
    need(now,
         !intel      ? "I106"
         : was_read_ ? "I006"
                     : "I012",
         "ALE low after the strobe for", strobe_end_, kPhase);
  } else if (pin == Pin::kAle) {
    need(now, intel ? "I001" : "I101", "NCS low before ALE falls for", changed(Pin::kNcs), kPhase);
    need(now, intel ? "I002" : "I102", "data stable before ALE falls for", data_changed(),
         kBusData);
    need(now, intel ? "I004" : "I104", "ALE high for", changed(Pin::kAle), kPhase);
    address_latched_ = now;
  } else if (intel && (pin == Pin::kNrdRnw || pin == Pin::kNwrE)) {
    const bool read = pin == Pin::kNrdRnw;
    if (level) {
      end_strobe(now, read);
    } else {
      begin_strobe(now, read);
    }
  } else if (!intel && pin == Pin::kNwrE) {
    if (level) {
      begin_strobe(now, this->level(Pin::kNrdRnw));
    } else {
      end_strobe(now, this->level(Pin::kNrdRnw));
    }
  } else if (!intel && pin == Pin::kNrdRnw) {
    need(now, "I108", "RNW stable after E has fallen for", strobe_end_, kPhase);
    if (this->level(Pin::kNwrE)) need(now, "I108", "RNW changes while E is high:", now, kPhase);
  }
}

}  // namespace mb4::sim
