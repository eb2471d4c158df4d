// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/judge.hpp"

#include <algorithm>
#include <stdexcept>

#include "tests/reference/pru/division.hpp"

namespace pru_judge {
namespace {

constexpr unsigned kPositionCrcBits = 6;

// The bytes of a word that its strobes name.
std::uint32_t mask_of(unsigned strobes) {
  std::uint32_t mask = 0;
  for (unsigned byte = 0; byte < 4; ++byte) {
    if (strobes >> byte & 1U) mask |= 0xFFU << 8 * byte;
  }
  return mask;
}

std::string hex(std::uint32_t value) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text;
  for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[value >> shift & 0xFU];
  return "0x" + text;
}

const char* name_of(std::uint32_t address) {
  struct Field {
    std::uint32_t from;
    unsigned bytes;
    const char* name;
  };
  constexpr Field kFields[] = {{kDataLength, 1, "DATA_LENGTH"},
                               {kCrcErrWar, 1, "CRC_ERR_WAR"},
                               {kFrequency, 1, "FREQUENCY"},
                               {kCtrlWord, 4, "CTRL_WORD"},
                               {kPosHi, 4, "POS_HI"},
                               {kPosLo, 4, "POS_LO"},
                               {kCtrlResult, 4, "CTRL_RESULT"},
                               {kPosCrcErrors, 2, "POS_CRC_ERRORS"},
                               {kFlags, 1, "FLAGS"},
                               {kPosCrc, 1, "POS_CRC"},
                               {kCtrlCrc, 1, "CTRL_CRC"},
                               {kRawData, 1, "RAW_DATA"},
                               {kProcTime, 2, "PROC_TIME"},
                               {kLineDelay, 1, "LINE_DELAY"}};
  for (const Field& field : kFields) {
    if (address >= field.from && address < field.from + field.bytes) return field.name;
  }
  return "gap";
}

}  // namespace

std::vector<std::string> differences(const Picture& expected, const Picture& seen) {
  std::vector<std::string> lines;
  const auto compare = [&](std::uint32_t address, const char* name, std::uint32_t due,
                           std::uint32_t is) {
    if (due == is) return;
    lines.push_back(hex(address) + " " + name + " is " + hex(is) + ", not " + hex(due));
  };
  for (std::uint32_t address = 0; address < kMemoryEnd; ++address) {
    compare(address, name_of(address), expected.memory[address], seen.memory[address]);
  }
  compare(kIrqStatus, "IRQ_STATUS", expected.irq_status, seen.irq_status);
  compare(kSignals, "SIGNALS", expected.signals, seen.signals);
  compare(kFrameCount, "FRAME_COUNT", expected.frame_count, seen.frame_count);
  compare(kLatchTime, "LATCH_TIME", expected.latch_time, seen.latch_time);
  return lines;
}

Judge::Judge(const JudgeSetup& setup)
    : setup_(setup),
      trigger_period_(setup.clock_hz / 10'000),                                 // 100 us
      overhead_(static_cast<std::uint32_t>(setup.clock_hz / 1'000'000) * 27) {  // 27 us
  if (setup.clock_hz != 200'000'000 && setup.clock_hz != 80'000'000) {
    throw std::invalid_argument("Judge: the clock is 200 or 80 MHz");
  }
  picture_.signals = 3;
}

void Judge::put(std::uint32_t address, unsigned bytes, std::uint64_t value) {
  for (unsigned i = 0; i < bytes; ++i) {
    picture_.memory.at(address + i) = static_cast<std::uint8_t>(value >> 8 * i);
  }
}

std::uint32_t Judge::value(std::uint32_t address, unsigned bytes) const {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) value |= std::uint32_t{byte(address + i)} << 8 * i;
  return value;
}

std::uint64_t Judge::position() const {
  return std::uint64_t{value(kPosHi, 4)} << 32 | value(kPosLo, 4);
}

void Judge::write(std::uint32_t address, std::uint32_t data, unsigned strobes) {
  const std::uint32_t mask = mask_of(strobes);
  const auto change = [&](std::uint32_t& word, std::uint32_t bits) {
    word = ((word & ~mask) | (data & mask)) & bits;
  };
  switch (address) {
    case kDataLength:
    case kCtrlWord: {
      std::uint32_t word = value(address, 4);
      change(word, address == kDataLength ? 0x00FFFFFF : 0xFFFFFFFF);
      put(address, 4, word);
      // R-P17: the byte with CTS arms the word, one of 0 arms nothing.
      if (address == kCtrlWord && (strobes & 8U)) control_armed_ = word != 0;
      break;
    }
    case kIrqStatus:
      picture_.irq_status &= ~(data & mask);
      break;
    case kIrqEnable:
      change(irq_enable_, 0x1F);
      break;
    case kRun: {
      const bool ran = run_;
      if (strobes & 1U) run_ = (data & 1U) != 0;
      if (run_ && !ran) start();
      break;
    }
    case kTriggerPeriod:
      change(trigger_period_, 0xFFFFFF);
      break;
    case kOverhead:
      change(overhead_, 0xFFFF);
      break;
    case kProcTimeMax:
      change(proc_time_max_, 0x3FF);
      break;
    default:
      break;  // R-P21: no effect
  }
}

std::uint32_t Judge::read(std::uint32_t address) {
  if (address == kPosHi) {
    pos_lo_ = value(kPosLo, 4);
    pos_lo_kept_ = true;
  } else if (address == kPosLo && pos_lo_kept_) {
    pos_lo_kept_ = false;
    return pos_lo_;
  }
  if (address < kMemoryEnd) return value(address, 4);
  switch (address) {
    case kId:
      return 0x454E4303;
    case kVersion:
      return setup_.version;
    case kFeatures:
      return (setup_.clock_hz == 80'000'000 ? 1U << 1 : 0) | (setup_.sma_wrap ? 1U << 2 : 0) |
             (setup_.first_low ? 1U << 3 : 0) | (setup_.extra_10 ? 1U << 4 : 0);
    case kIrqStatus:
      return picture_.irq_status;
    case kIrqEnable:
      return irq_enable_;
    case kRun:
      return run_ ? 1 : 0;
    case kTriggerPeriod:
      return trigger_period_;
    case kOverhead:
      return overhead_;
    case kProcTimeMax:
      return proc_time_max_;
    case kSignals:
      return picture_.signals;
    case kFrameCount:
      return picture_.frame_count;
    case kLatchTime:
      return picture_.latch_time;
    default:
      return 0;
  }
}

void Judge::trigger(bool lost) {
  picture_.irq_status |= kIrqTrigger;
  if (lost) picture_.irq_status |= kIrqLost;
}

// R-P4, R-P20.
void Judge::start() {
  position_bits_ = std::max<unsigned>(byte(kDataLength), 1);
  check_bits_ = std::min<unsigned>(byte(kCrcErrWar), 32);
  position_bits_ = std::min(position_bits_, 64 - 1 - check_bits_);
  put(kPosCrcErrors, 2, 0);
  average_.clear();
  control_.stop();
  mhz_ = 1;
}

FrameSettings Judge::settings() const {
  FrameSettings settings;
  settings.rate = {setup_.clock_hz, mhz_};
  settings.phase = setup_.phase;
  settings.position_bits = position_bits_;
  settings.check_bits = check_bits_;
  settings.limit = proc_time_max_ != 0 ? proc_time_max_ : 40 * mhz_;  // 40 us
  settings.first_low = setup_.first_low;
  settings.sma_wrap = setup_.sma_wrap;
  settings.averages = average_on();
  settings.average = average_;
  return settings;
}

// The presence test. Near an edge of SL the master decides, and MA shows how.
bool Judge::sl_is_low(const FrameRecord& record, bool ma_moves,
                      std::vector<std::string>& complaints) {
  const Time near = setup_.presence_clocks * Rate{setup_.clock_hz, 1}.clock_ps();
  if (record.sl.steady(record.start - near, record.start + near) &&
      record.sl.before(record.start) != ma_moves) {
    complaints.push_back(ma_moves ? "MA moves although SL was 0 before the frame"
                                  : "MA stays although SL was 1 before the frame");
  }
  return !ma_moves;
}

FrameReport Judge::frame(const FrameRecord& record) {
  if (!run_) throw std::logic_error("Judge: a frame while RUN is 0");
  FrameReport report;
  report.settings = settings();
  report.cdm = control_.cdm();
  const std::vector<Edge> ma = record.ma.within(record.start, record.end);
  const std::optional<Time> rising = rising_edge_1(ma);
  if (sl_is_low(record, rising.has_value(), report.complaints)) {
    report.reading.last_sample = record.start;
    if (!ma.empty()) report.complaints.push_back("MA has an edge, but no frame");
  } else {
    report.reading = read_frame(report.settings, record.sl, *rising);
    report.ma = ma_edges(report.settings, report.reading, report.cdm,
                         setup_.decision_clocks * report.settings.rate.clock_ps());
    const std::vector<std::string> of_ma =
        check_ma(report.settings, report.reading, ma, record.ma.before(record.start), report.ma);
    report.complaints.insert(report.complaints.end(), of_ma.begin(), of_ma.end());
  }
  const Time clock = report.settings.rate.clock_ps();
  report.update_due = report.reading.last_sample + overhead_ * clock;
  if (record.updated) {
    const Time late = *record.updated - report.update_due;
    if (late < 0 || late > setup_.update_clocks * clock) {
      report.complaints.push_back("the memory changes " + std::to_string(late / 1000) +
                                  " ns after it is due");
    }
  }
  post_process(report);
  return report;
}

// The order of facts 1.3 item 5.
void Judge::post_process(FrameReport& report) {
  const std::uint8_t flags_before = byte(kFlags);
  control_channel(report);
  sample_point(report);
  frequency_selection();
  position(report);
  flags(report);
  picture_.frame_count = (picture_.frame_count + 1) & 0xFFFF;
  interrupts(flags_before);
}

void Judge::control_channel(const FrameReport& report) {
  control_ended_ = false;
  // R-P15: a frame without MA takes no bit; without START its CDS reads 0.
  if (report.reading.kind != FrameKind::kSlLow) {
    if (const std::optional<ControlResult> result = control_.step(report.reading.cds)) {
      control_ended_ = true;
      put(kCtrlResult, 4, result->data);
      put(kCtrlCrc, 1, result->crc);
      unsigned flags = byte(kFlags) & ~unsigned{kCmdCrcErr};
      if (result->crc_error) flags |= kCmdCrcErr;
      put(kFlags, 1, flags);
    }
  }
  const std::uint32_t word = value(kCtrlWord, 4);
  if (!control_.running() && control_armed_ && word != 0) {
    control_.take(word);
    control_armed_ = false;
    put(kCtrlWord, 4, 0);
  }
}

// R-P5, R-P12: what the next frame runs at. A change of the rate begins a new average.
void Judge::frequency_selection() {
  if (legal_mhz(byte(kFrequency))) legal_mhz_ = byte(kFrequency);
  if (mhz_ == legal_mhz_) return;
  mhz_ = legal_mhz_;
  average_.clear();
}

void Judge::sample_point(const FrameReport& report) {
  const FrameReading& reading = report.reading;
  put(kRawData, 1, reading.raw);
  if (reading.kind == FrameKind::kSlLow) return;
  const unsigned extra = setup_.extra_10 && report.settings.rate.mhz == 10 ? 2 : 0;
  put(kLineDelay, 1, std::min(reading.byte + extra, 255U));
  put(kProcTime, 2, reading.zeros);
  picture_.latch_time = static_cast<std::uint32_t>((reading.rising_edge_1 - setup_.time_zero) /
                                                       report.settings.rate.clock_ps() +
                                                   setup_.latch_clocks);
  if (reading.kind == FrameKind::kNoAcknowledge) return;
  average_.add(reading.own_place);
  picture_.signals = (picture_.signals & 3U) | bit_number(reading.own_place) << 8 |
                     bit_number(reading.used_place) << 12 |
                     (reading.used_place >= kSamples ? 1U << 16 : 0U);
}

// R-P18.
void Judge::position(FrameReport& report) {
  if (report.reading.kind != FrameKind::kRead) return;
  const std::string& bits = report.reading.bits;
  const unsigned crc_bits = check_bits_ >= kPositionCrcBits ? kPositionCrcBits : 0;
  const std::string before = bits.substr(0, bits.size() - crc_bits);
  const std::string received = bits.substr(before.size());
  if (crc_bits != 0) report.crc = position_crc(before);
  put(kPosCrc, 1, number(received));
  report.good = received == report.crc;
  if (!report.good) {
    put(kPosCrcErrors, 2, value(kPosCrcErrors, 2) + 1);
    return;
  }
  const std::uint64_t position = number(before.substr(0, position_bits_));
  put(kPosHi, 4, position >> 32);
  put(kPosLo, 4, position);
  // nE, then nW behind the position; 1 if a frame has none.
  const std::string signals = before.substr(position_bits_) + "11";
  picture_.signals =
      (picture_.signals & ~3U) | (signals[0] == '1' ? 1U : 0U) | (signals[1] == '1' ? 2U : 0U);
}

// R-P14. CMD_CRC_ERR stands since the last control frame.
void Judge::flags(const FrameReport& report) {
  const FrameKind kind = report.reading.kind;
  unsigned flags = byte(kFlags) & kCmdCrcErr;
  if (report.settings.averages) flags |= kSmaFlag;
  if (kind == FrameKind::kDropped) flags |= kProcTimeErr;
  if (control_.started()) flags |= kCmdStartFlag;
  if (kind == FrameKind::kRead && !report.good) flags |= kPosCrcErr;
  if (kind == FrameKind::kSlLow || kind == FrameKind::kNoAcknowledge) flags |= kNoSlaveFlag;
  put(kFlags, 1, flags);
}

void Judge::interrupts(std::uint8_t flags_before) {
  constexpr unsigned kShown = kProcTimeErr | kPosCrcErr | kCmdCrcErr | kNoSlaveFlag;
  if (picture_.irq_status & kIrqFrame) picture_.irq_status |= kIrqLost;
  picture_.irq_status |= kIrqFrame;
  if (byte(kFlags) & ~unsigned{flags_before} & kShown) picture_.irq_status |= kIrqFlags;
  if (control_ended_) picture_.irq_status |= kIrqControl;
}

}  // namespace pru_judge
