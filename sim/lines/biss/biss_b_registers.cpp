// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/biss/biss_b_registers.hpp"

#include "sim/lines/crc.hpp"

namespace mb4::sim {
namespace {

constexpr Crc kRegisterCrc{0x13, 0};
constexpr unsigned kCrcBits = 4;
constexpr unsigned kHeaderBits = 11;  // ID, address, WNR
constexpr unsigned kDataBits = 8;

bool crc_fits(unsigned bits, unsigned data_bits) {
  return kRegisterCrc.line_bits(bits >> kCrcBits, data_bits) == (bits & 0xFU);
}

}  // namespace

void BissBRegisters::begin(bool by_mo) {
  by_mo_ = by_mo;
  out_ = false;
  cells_ = 0;
  state_ = config_.present ? State::kStart : State::kOff;
}

void BissBRegisters::end() {
  const bool between_bytes = state_ == State::kOff || state_ == State::kStart ||
                             state_ == State::kReadBusy || state_ == State::kReadStop ||
                             state_ == State::kWriteStart;
  if (!between_bytes) ++counters_.aborts;
  state_ = State::kOff;
  out_ = false;
}

void BissBRegisters::ma_edge(Time now, bool ma) {
  if (ma) {
    rising(now);
  } else {
    fall_ = now;
  }
}

void BissBRegisters::break_off() {
  ++counters_.protocol_errors;
  state_ = State::kOff;
  out_ = false;
}

void BissBRegisters::rising(Time now) {
  const Time period = now - rise_;
  const Time high = fall_ - rise_;
  const bool first = cells_++ == 0;
  rise_ = now;
  if (first) return;  // no cell has ended yet
  read_busy_.frame();
  store_busy_.frame();
  if (!expects_pwm()) {
    read_clock(now);
  } else if (8 * high < 3 * period) {
    take(now, false);
  } else if (8 * high > 5 * period) {
    take(now, true);
  } else {
    break_off();
  }
}

// A bit of the master has ended. `bit` is its value.
void BissBRegisters::take(Time now, bool bit) {
  switch (state_) {
    case State::kStart:
      if (!bit) return break_off();
      ++counters_.starts;
      bits_ = 0;
      count_ = 0;
      state_ = State::kHeader;
      break;
    case State::kHeader:
      bits_ = bits_ << 1U | (bit ? 1U : 0U);
      if (++count_ == kHeaderBits + kCrcBits) header_done();
      break;
    case State::kHeaderStop:
      if (bit) return break_off();
      if (writing_) {
        state_ = State::kWriteStart;
      } else {
        read_busy_.start(now, config_.read_busy);
        state_ = State::kReadBusy;
        answer_when_ready(now);
      }
      break;
    default:
      write_bit(now, bit);
      break;
  }
}

void BissBRegisters::header_done() {
  state_ = State::kOff;
  if (!crc_fits(bits_, kHeaderBits)) {
    ++counters_.header_errors;
    return;
  }
  const unsigned header = bits_ >> kCrcBits;
  const unsigned id = header >> 8U;
  const unsigned first = config_.first_id + (by_mo_ ? 1U : 0U);
  if (id < first || id >= first + config_.ids || silent_) return;
  block_ = (id - first) * RegisterFile::kPerId;
  address_ = (header >> 1U) & 0x7FU;
  writing_ = (header & 1U) != 0;
  state_ = State::kHeaderStop;
}

void BissBRegisters::read_clock(Time now) {
  switch (state_) {
    case State::kReadBusy:
      answer_when_ready(now);
      break;
    case State::kReadData:
      ++count_;
      out_ = ((answer_ >> (kDataBits + kCrcBits - count_)) & 1U) != 0;
      if (count_ == kDataBits + kCrcBits) {
        ++counters_.reads;
        state_ = State::kReadStop;
      }
      break;
    case State::kReadStop:
      out_ = false;
      address_ = (address_ + 1) % RegisterFile::kPerId;
      read_busy_.start(now, config_.read_busy, 1);
      state_ = State::kReadBusy;
      break;
    default:
      break;
  }
}

void BissBRegisters::answer_when_ready(Time now) {
  const unsigned address = block_ + address_;
  out_ = registers_.exists(address) && read_busy_.over(now) && store_busy_.over(now);
  if (!out_) return;
  const unsigned value = registers_.read(address);
  answer_ = value << kCrcBits | kRegisterCrc.line_bits(value, kDataBits);
  if (wrong_data_crc_) answer_ ^= 1U;
  count_ = 0;
  state_ = State::kReadData;
}

void BissBRegisters::write_bit(Time now, bool bit) {
  out_ = bit;
  const unsigned address = block_ + address_;
  switch (state_) {
    case State::kWriteStart:
      if (!bit) break;  // the master may wait any time
      if (!registers_.exists(address) || !store_busy_.over(now)) {
        state_ = State::kOff;
        out_ = false;
        break;
      }
      bits_ = 0;
      count_ = 0;
      state_ = State::kWriteData;
      break;
    case State::kWriteData:
      bits_ = bits_ << 1U | (bit ? 1U : 0U);
      if (++count_ < kDataBits + kCrcBits) break;
      if (crc_fits(bits_, kDataBits)) {
        registers_.write(address, static_cast<std::uint8_t>(bits_ >> kCrcBits));
        ++counters_.writes;
        store_busy_.start(now, config_.store_busy, 2);  // for the stop bit and the next start bit
      } else {
        ++counters_.data_errors;
      }
      state_ = State::kWriteStop;
      break;
    default:
      if (bit) return break_off();
      address_ = (address_ + 1) % RegisterFile::kPerId;
      state_ = State::kWriteStart;
      break;
  }
}

}  // namespace mb4::sim
