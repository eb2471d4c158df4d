// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The judge: which bytes the memory of biss_pru has after each frame, from what the host wrote and
// the recorded edges of MA and SL. README.md says what it is written from, what it takes for
// granted and what the recorder has to supply. It shares no file with the RTL, the simulator and
// the driver.
#ifndef TESTS_REFERENCE_PRU_JUDGE_HPP_
#define TESTS_REFERENCE_PRU_JUDGE_HPP_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/reference/pru/average.hpp"
#include "tests/reference/pru/control.hpp"
#include "tests/reference/pru/frame.hpp"
#include "tests/reference/pru/ma.hpp"

namespace pru_judge {

// Byte addresses of map B.
enum Address : std::uint32_t {
  kDataLength = 0x000,
  kCrcErrWar = 0x001,
  kFrequency = 0x002,
  kCtrlWord = 0x004,
  kPosHi = 0x008,
  kPosLo = 0x00C,
  kCtrlResult = 0x010,
  kPosCrcErrors = 0x014,
  kFlags = 0x016,
  kPosCrc = 0x018,
  kCtrlCrc = 0x019,
  kRawData = 0x01A,
  kProcTime = 0x01C,
  kLineDelay = 0x01E,
  kMemoryEnd = 0x020,
  kId = 0x200,
  kVersion = 0x204,
  kFeatures = 0x208,
  kIrqStatus = 0x20C,
  kIrqEnable = 0x210,
  kTimeLow = 0x214,
  kTimeHigh = 0x218,
  kRun = 0x220,
  kTriggerPeriod = 0x224,
  kOverhead = 0x228,
  kProcTimeMax = 0x22C,
  kSignals = 0x230,
  kFrameCount = 0x234,
  kLatchTime = 0x238,
};

// Bits of FLAGS (seed Table 2).
enum Flag : std::uint8_t {
  kSmaFlag = 0x01,
  kProcTimeErr = 0x02,
  kCmdStartFlag = 0x04,
  kPosCrcErr = 0x08,
  kCmdCrcErr = 0x10,
  kNoSlaveFlag = 0x20,
};

// Bits of IRQ_STATUS.
enum Irq : std::uint8_t {
  kIrqFrame = 0x01,
  kIrqFlags = 0x02,
  kIrqControl = 0x04,
  kIrqTrigger = 0x08,
  kIrqLost = 0x10,
};

struct JudgeSetup {
  std::uint32_t clock_hz = 200'000'000;  // or 80'000'000
  std::uint32_t version = 0;             // what VERSION reads
  // quirks_i
  bool sma_wrap = false;
  bool first_low = false;
  bool extra_10 = true;

  // What the law leaves to an implementation.
  SamplePhase phase{};
  unsigned presence_clocks = 4;  // an edge of SL so near the presence test: either answer is right
  unsigned decision_clocks = 8;  // MA follows a sample so late, see ma_edges()
  unsigned update_clocks = 8;    // the memory changes so late after OVERHEAD
  Time time_zero = 0;            // rising edge of the clock after which TIME is 0
  int latch_clocks = 0;          // added to LATCH_TIME
};

// All that a frame may change for the host.
struct Picture {
  std::array<std::uint8_t, kMemoryEnd> memory{};
  std::uint32_t irq_status = 0;
  std::uint32_t signals = 0;
  std::uint32_t frame_count = 0;
  std::uint32_t latch_time = 0;
};
// One line for each byte and word in which they differ, with its address and name.
std::vector<std::string> differences(const Picture& expected, const Picture& seen);

struct FrameReport {
  FrameReading reading;
  FrameSettings settings;
  bool cdm = false;   // the bit that this frame sends
  bool good = false;  // kRead, and the CRC is right or there is none
  std::string crc;    // what was due; empty: no check
  MaEdges ma{};
  Time update_due = 0;                  // OVERHEAD after the last sample
  std::vector<std::string> complaints;  // about MA and the instant of the update
};

class Judge {
 public:
  explicit Judge(const JudgeSetup& setup);

  // The host writes a word; bit n of `strobes` is its byte n. `address` is a multiple of 4. What is
  // written before frame() counts in this frame.
  void write(std::uint32_t address, std::uint32_t data, unsigned strobes = 0xF);
  // The host reads a word, as R-P9 has it. TIME is no part of the judge and reads 0.
  std::uint32_t read(std::uint32_t address);

  // A frame has ended and the memory has changed. Only while RUN is 1; the first one after the rise
  // of RUN is the one at 1 MHz. A frame that a write of RUN = 0 has ended is no frame.
  FrameReport frame(const FrameRecord& record);
  // A trigger, of the timer or of the pin. `lost`: one was waiting already.
  void trigger(bool lost);

  std::uint8_t byte(std::uint32_t address) const { return picture_.memory.at(address); }
  std::uint32_t value(std::uint32_t address, unsigned bytes) const;
  std::uint64_t position() const;
  const Picture& picture() const { return picture_; }
  bool irq() const { return (picture_.irq_status & irq_enable_) != 0; }
  // CDM of the next frame, and whether a control frame runs.
  const Control& control() const { return control_; }
  // Rate of the next frame.
  unsigned mhz() const { return mhz_; }
  // Lengths of R-P20, of which the frames are.
  unsigned position_bits() const { return position_bits_; }
  unsigned check_bits() const { return check_bits_; }

 private:
  void start();
  bool average_on() const { return mhz_ != 10 && average_.ready(); }
  FrameSettings settings() const;
  bool sl_is_low(const FrameRecord& record, bool ma_moves, std::vector<std::string>& complaints);
  void post_process(FrameReport& report);
  void control_channel(const FrameReport& report);
  void frequency_selection();
  void sample_point(const FrameReport& report);
  void position(FrameReport& report);
  void flags(const FrameReport& report);
  void interrupts(std::uint8_t flags_before);
  void put(std::uint32_t address, unsigned bytes, std::uint64_t value);

  JudgeSetup setup_;
  Picture picture_;
  std::uint32_t irq_enable_ = 0;
  bool run_ = false;
  std::uint32_t trigger_period_;
  std::uint32_t overhead_;
  std::uint32_t proc_time_max_ = 0;
  bool control_armed_ = false;
  bool pos_lo_kept_ = false;
  std::uint32_t pos_lo_ = 0;

  unsigned position_bits_ = 1;
  unsigned check_bits_ = 0;
  unsigned mhz_ = 1;        // of the next frame
  unsigned legal_mhz_ = 1;  // the last legal value of FREQUENCY
  Average average_;
  Control control_;
  bool control_ended_ = false;  // with the frame that is judged
};

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_JUDGE_HPP_
