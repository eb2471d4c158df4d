// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The master starts its frames itself. The host waits for the interrupt behind each, and reads the
// memory before the next one ends.
#include "masters/pru/pru_session.hpp"

#include <fmt/core.h>

#include <array>
#include <vector>

#include "pru_regs_table.hpp"
#include "sim/masters/pru/pru_master.hpp"
#include "word_port.hpp"
#include "word_registers.hpp"

namespace mb4::tool {
namespace {

namespace regs = biss_pru::regs;

constexpr unsigned kCrc = 0x43;
constexpr unsigned kCrcBits = 6;
constexpr unsigned kMostFlags = 2;
constexpr unsigned kMostBits = 63;  // of position, nE, nW and CRC
constexpr sim::Time kUsualPeriod = 100 * sim::kPsPerUs;
constexpr sim::Time kLongestFrame = 2'000 * sim::kPsPerUs;
constexpr std::uint64_t kHzOfMhz = 1'000'000;
constexpr unsigned kAveraged = 4;  // frames behind a change of the rate, before there is an average

constexpr const char* kNoAnswer = "AXI: no answer, or an error answer";

// What the master is told of the frames.
struct FrameShape {
  unsigned position_bits = 0;
  unsigned flag_bits = 0;
  unsigned crc_bits = 0;

  std::uint32_t lengths(std::uint64_t ma_hz) const {
    return regs::DATA_LENGTH::of(position_bits) | regs::CRC_ERR_WAR::of(flag_bits + crc_bits) |
           regs::FREQUENCY::of(static_cast<std::uint32_t>(ma_hz / kHzOfMhz));
  }
};

FrameShape shape_of(const sim::Scenario& scenario) {
  require_slaves(scenario);
  const sim::SlaveConfig& slave = scenario.channels.front().slaves.front();
  if (slave.traits().protocol.key != "biss-c") {
    fail_at(scenario, slave.source, "protocol", "the master reads BiSS C only");
  }
  if (slave.traits().actuator) {
    fail_at(scenario, slave.source, "protocol", "the master sends no words to an actuator");
  }
  const std::uint32_t polynomial = slave.crc().polynomial;
  if (polynomial != 0 && polynomial != kCrc) {
    fail_at(scenario, slave.source, "crc", "the master checks CRC 0x43 only");
  }
  if (polynomial != 0 && (slave.crc().start & ((1U << kCrcBits) - 1)) != 0) {
    fail_at(scenario, slave.source, "crc_start", "the master's CRC starts with 0 only");
  }
  if (slave.flag_bits() > kMostFlags) {
    fail_at(scenario, slave.source, "flag_bits",
            fmt::format("the master shows {} flags at most, nE and nW, not {}", kMostFlags,
                        slave.flag_bits()));
  }
  if (slave.data_bits() <= slave.flag_bits()) {
    fail_at(scenario, slave.source, "data_bits", "the master reads at least one bit of position");
  }
  const unsigned crc_bits = slave.crc().width();
  if (slave.data_bits() + crc_bits > kMostBits) {
    fail_at(scenario, slave.source, "data_bits",
            fmt::format("the master takes {} bits at most, position, flags and CRC, not {}",
                        kMostBits, slave.data_bits() + crc_bits));
  }
  return {slave.data_bits() - slave.flag_bits(), slave.flag_bits(), crc_bits};
}

class PruSession final : public Session {
 public:
  PruSession(const sim::Scenario& scenario, const SessionOptions& options)
      : Session(scenario, options),
        port_(simulator_, log()),
        irq_(*simulator_.pin_by_name("irq_o")) {}

  std::string configure() override;
  SessionFrame read(std::uint64_t number) override;
  std::span<const WordColumn> columns() const override;
  std::string told_between(std::uint64_t frame) const override {
    return frame == 1 ? first_error_ : "";
  }
  RegisterMap registers() override;

 private:
  bool write(unsigned address, std::uint32_t value) { return port_.write(address, value); }
  void wait_for_frame();
  SlaveResult take();
  SlaveResult result();

  // The memory of a frame.
  struct Memory {
    std::uint32_t high = 0;
    std::uint32_t low = 0;
    std::uint32_t status = 0;
    std::uint32_t received = 0;
    std::uint32_t times = 0;
    std::uint32_t signals = 0;
  };

  WordPort port_;
  sim::Pin irq_;
  FrameShape shape_;
  sim::Time period_ = 0;
  Memory memory_;
  std::string first_error_;  // of the frame of RUN; empty: it was good
};

// RUN makes a frame at 1 MHz at once. The frames of the session follow it.
std::string PruSession::configure() {
  const sim::Scenario& scenario = simulator_.scenario();
  shape_ = shape_of(scenario);
  period_ = scenario.host.frame != 0 ? scenario.host.frame : kUsualPeriod;
  const std::uint64_t clocks = period_ / (sim::kPsPerSecond / scenario.chip.f_clk_hz);
  const bool done =
      write(regs::kAddrLengths, shape_.lengths(scenario.host.ma_hz)) &&
      write(regs::kAddrTriggerPeriod, static_cast<std::uint32_t>(clocks == 0 ? 1 : clocks)) &&
      write(regs::kAddrIrqEnable, regs::FRAME_ENDED_ENABLE::kMask) &&
      write(regs::kAddrRun, regs::RUN::kMask);
  if (!done) return kNoAnswer;
  wait_for_frame();
  first_error_ = take().error;
  return first_error_ == kNoAnswer ? kNoAnswer : "";
}

// Up to the interrupt.
void PruSession::wait_for_frame() {
  const sim::Time end = simulator_.now() + 2 * period_ + kLongestFrame;
  simulator_.run_while_waiting([this] { return simulator_.pin(irq_); }, end);
}

// POS_HI copies POS_LO, so it comes first.
SlaveResult PruSession::take() {
  if (!simulator_.pin(irq_)) return {std::nullopt, "no frame"};
  const bool done = port_.read(regs::kAddrPosHi, memory_.high) &&
                    port_.read(regs::kAddrPosLo, memory_.low) &&
                    port_.read(regs::kAddrStatus, memory_.status) &&
                    port_.read(regs::kAddrReceived, memory_.received) &&
                    port_.read(regs::kAddrTimes, memory_.times) &&
                    port_.read(regs::kAddrSignals, memory_.signals) &&
                    write(regs::kAddrIrqStatus, regs::FRAME_ENDED::kMask);
  if (!done) return {std::nullopt, kNoAnswer};
  SlaveResult out = result();
  out.told = {fmt::format("{}", regs::LINE_DELAY::get(memory_.times)),
              fmt::format("{}", regs::PROC_TIME::get(memory_.times))};
  return out;
}

SlaveResult PruSession::result() {
  if (regs::NO_SLAVE_FLAG::get(memory_.status) != 0) {
    return {std::nullopt, "no acknowledge, or SLO was 0 at the start"};
  }
  if (regs::PROC_TIME_ERR::get(memory_.status) != 0) return {std::nullopt, "no start bit"};
  if (regs::POS_CRC_ERR::get(memory_.status) != 0) return {std::nullopt, "CRC error"};
  const unsigned flags = regs::NE::get(memory_.signals) << 1U | regs::NW::get(memory_.signals);
  Word word;
  word.bits = std::uint64_t{memory_.high} << 32U | memory_.low;
  word.bits = word.bits << shape_.flag_bits | flags >> (kMostFlags - shape_.flag_bits);
  word.data_bits = shape_.position_bits + shape_.flag_bits;
  word.flag_bits = shape_.flag_bits;
  if (shape_.flag_bits > 0) word.n_error = (flags & 2U) != 0;
  if (shape_.flag_bits > 1) word.n_warning = (flags & 1U) != 0;
  if (shape_.crc_bits != 0) {
    word.crc = ~regs::POS_CRC::get(memory_.received) & ((1U << kCrcBits) - 1);
  }
  return {word, ""};
}

SessionFrame PruSession::read(std::uint64_t number) {
  SessionFrame out;
  out.number = number;
  out.begin = simulator_.now();
  wait_for_frame();
  out.sent.push_back(simulator_.slave(slaves_.front().number)->sent_word());
  out.results.push_back(take());
  out.end = simulator_.now();
  return out;
}

std::span<const WordColumn> PruSession::columns() const {
  static const std::vector<WordColumn> all = [] {
    const std::span<const WordColumn> words = all_word_columns();
    std::vector<WordColumn> columns(words.begin(), words.end());
    columns.push_back({"line_delay", "line", 4, true, nullptr});
    columns.push_back({"processing", "proc", 4, true, nullptr});
    return columns;
  }();
  return all;
}

RegisterMap PruSession::registers() {
  return read_registers(port_, regs::kAddrLatchTime, regs::kFields, regs::kCodes);
}

unsigned ma_clocks(std::uint64_t clk_hz, unsigned mhz) {
  return sim::pru_has_frequency(mhz) ? static_cast<unsigned>(clk_hz / (mhz * kHzOfMhz)) : 0;
}

}  // namespace

const MasterSupport kPruSupport{
    .type = "pru",
    .check = [](const sim::Scenario& scenario) { shape_of(scenario); },
    .open = [](const sim::Scenario& scenario, const SessionOptions& options)
        -> std::unique_ptr<Session> { return std::make_unique<PruSession>(scenario, options); },
    .sweep = {.name = "FREQUENCY",
              .most = 10,
              .refuses = "FREQUENCY is 1, 2, 5 or 10; not",
              .divider = ma_clocks,
              .unmeasured = kAveraged}};

}  // namespace mb4::tool
