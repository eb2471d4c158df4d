// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers of biss_pru without its line: what a host sees of frames and control frames, as
// regmap/pru.rdl and rulings R-P4 to R-P21 say, not as the RTL does it. Each access takes a time;
// a test may act before each of them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "biss_pru.h"

namespace mb4test {

// One control frame's answer: data and CRC as received.
struct PruAnswer {
  std::uint32_t data = 0, crc = 0;
  bool crc_bad = true;
};

class FakePru {
 public:
  explicit FakePru(bool clock_80 = false) { power_on(clock_80 ? PRU_CLOCK_80_MASK : 0); }

  biss_pru_port port() {
    return {
        this,
        [](void* self, std::uint32_t offset) { return static_cast<FakePru*>(self)->read(offset); },
        [](void* self, std::uint32_t offset, std::uint32_t value) {
          static_cast<FakePru*>(self)->write(offset, value);
        },
        [](void* self) { return static_cast<FakePru*>(self)->time(); }};
  }

  // ---- What frames bring. Each is one update of the memory.
  void good(std::uint64_t position, bool nerr = true, bool nwarn = true) {
    position_ = position;
    regs[PRU_ADDR_SIGNALS] = (nerr ? PRU_NE_MASK : 0) | (nwarn ? PRU_NW_MASK : 0);
    set_flags(0);
    end(true);
  }
  void bad_crc() {
    set(PRU_ADDR_STATUS, PRU_POS_CRC_ERRORS_MASK, regs[PRU_ADDR_STATUS] + 1);
    set_flags(PRU_POS_CRC_ERR_MASK);
    end(true);
  }
  void processing() {
    set_flags(PRU_PROC_TIME_ERR_MASK);
    end(true);
  }
  void no_slave(bool ma) {
    set_flags(PRU_NO_SLAVE_FLAG_MASK);
    end(ma);
  }
  void reset() {
    const std::uint32_t features = regs[PRU_ADDR_FEATURES];
    regs.clear();
    power_on(features);
    position_ = 0;
    copied_ = false;
    left_ = 0;
  }
  bool runs() const { return regs.count(PRU_ADDR_RUN) != 0 && regs.at(PRU_ADDR_RUN) == 1; }

  std::map<std::uint32_t, std::uint32_t> regs;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> writes;
  std::vector<std::uint32_t> words;   // control words taken
  std::function<void()> before;       // before each access
  std::function<void()> before_time;  // before each look at the clock
  std::function<PruAnswer(std::uint32_t)> answer = [](std::uint32_t) { return PruAnswer{}; };
  std::uint32_t now_us = 0;
  std::uint32_t access_us = 1;
  unsigned accesses = 0;

 private:
  void power_on(std::uint32_t features) {
    regs[PRU_ADDR_ID] = PRU_RESET_ID;
    regs[PRU_ADDR_FEATURES] = features;
    regs[PRU_ADDR_SIGNALS] = PRU_RESET_SIGNALS;
  }
  std::uint32_t time() {
    if (before_time) before_time();
    return now_us;
  }
  void set(std::uint32_t offset, std::uint32_t mask, std::uint32_t value) {
    regs[offset] = (regs[offset] & ~mask) | (value & mask);
  }
  void set_flags(std::uint32_t frame_flags) {
    constexpr std::uint32_t kFrame =
        PRU_NO_SLAVE_FLAG_MASK | PRU_POS_CRC_ERR_MASK | PRU_PROC_TIME_ERR_MASK;
    set(PRU_ADDR_STATUS, kFrame, frame_flags);
  }
  void end(bool ma) {
    if (ma && left_ > 0) {
      --left_;
      if (left_ == 31) regs[PRU_ADDR_STATUS] |= PRU_CMD_START_FLAG_MASK;
      if (left_ == 0) end_control();
    }
    if (left_ == 0 && regs[PRU_ADDR_CTRL] != 0) {
      words.push_back(regs[PRU_ADDR_CTRL]);
      regs[PRU_ADDR_CTRL] = 0;
      left_ = 14 + 1 + 31;  // CDM = 0, START, bits 31 to 1
    }
    regs[PRU_ADDR_FRAME_COUNT] = (regs[PRU_ADDR_FRAME_COUNT] + 1) & PRU_FRAME_COUNT_MASK;
    regs[PRU_ADDR_IRQ_STATUS] |= PRU_FRAME_ENDED_MASK;
  }
  void end_control() {
    const PruAnswer got = answer(words.back());
    regs[PRU_ADDR_CTRL_RESULT] = got.data;
    set(PRU_ADDR_RECEIVED, PRU_CTRL_CRC_MASK, got.crc << PRU_CTRL_CRC_SHIFT);
    set(PRU_ADDR_STATUS, PRU_CMD_START_FLAG_MASK | PRU_CMD_CRC_ERR_MASK,
        got.crc_bad ? PRU_CMD_CRC_ERR_MASK : 0);
    regs[PRU_ADDR_IRQ_STATUS] |= PRU_CTRL_ENDED_MASK;
  }
  void pass() {
    ++accesses;
    now_us += access_us;
    if (before) before();
  }
  std::uint32_t read(std::uint32_t offset) {
    pass();
    if (offset == PRU_ADDR_POS_HI) {
      copy_ = static_cast<std::uint32_t>(position_);
      copied_ = true;
      return static_cast<std::uint32_t>(position_ >> 32);
    }
    if (offset == PRU_ADDR_POS_LO) {
      const bool copied = copied_;
      copied_ = false;
      return copied ? copy_ : static_cast<std::uint32_t>(position_);
    }
    return regs[offset];
  }
  void write(std::uint32_t offset, std::uint32_t value) {
    pass();
    writes.emplace_back(offset, value);
    if (offset == PRU_ADDR_IRQ_STATUS) {
      regs[offset] &= ~value;
      return;
    }
    if (offset == PRU_ADDR_RUN && value == 0) left_ = 0;
    regs[offset] = value;
  }

  std::uint64_t position_ = 0;
  std::uint32_t copy_ = 0;
  bool copied_ = false;
  unsigned left_ = 0;  // frames of the control frame
};

}  // namespace mb4test
