// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host makes the accesses of the calls in drivers/c/pm_bissc.c. These keep their state in
// globals, for one master a program, so the session does not call them.
#include "masters/clb/clb_session.hpp"

#include <fmt/core.h>

#include <array>

#include "clb_regs_table.hpp"
#include "sim/masters/clb/clb_master.hpp"
#include "word_port.hpp"
#include "word_registers.hpp"

namespace mb4::tool {
namespace {

namespace regs = biss_clb::regs;

constexpr unsigned kWordBits = 12;  // of the SPI, as the calls use it
constexpr unsigned kStartAndCds = 2;
constexpr unsigned kFlags = 2;
constexpr unsigned kMostCrcBits = 16;
constexpr unsigned kStateReceive = 3;                     // MA has ended
constexpr sim::Time kTimeout = 40 * sim::kPsPerUs;        // the longest of an encoder
constexpr sim::Time kPatience = 100'000 * sim::kPsPerUs;  // for a frame without watchdog

constexpr const char* kNoAnswer = "AXI: no answer, or an error answer";

// What the master is told of the frames.
struct FrameShape {
  unsigned position_bits = 0;
  unsigned flag_bits = 0;
  sim::Crc crc;

  unsigned clocks() const { return kStartAndCds + position_bits + flag_bits + crc.width(); }
  unsigned words() const { return (clocks() + kWordBits - 1) / kWordBits; }
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
  const unsigned width = slave.crc().width();
  if (width < 1 || width > kMostCrcBits) {
    fail_at(scenario, slave.source, "crc", "the host reads words with a CRC only");
  }
  if (slave.flag_bits() != kFlags) {
    fail_at(scenario, slave.source, "flag_bits",
            fmt::format("the host takes {} flags, nE and nW, not {}", kFlags, slave.flag_bits()));
  }
  if (slave.data_bits() <= kFlags) {
    fail_at(scenario, slave.source, "data_bits", "the host reads at least one bit of position");
  }
  return {slave.data_bits() - kFlags, kFlags, slave.crc()};
}

class ClbSession final : public Session {
 public:
  ClbSession(const sim::Scenario& scenario, const SessionOptions& options)
      : Session(scenario, options),
        port_(simulator_, log()),
        irq_(*simulator_.pin_by_name("irq_o")) {}

  std::string configure() override;
  SessionFrame read(std::uint64_t number) override;
  RegisterMap registers() override;

 private:
  bool write(unsigned address, std::uint32_t value) { return port_.write(address, value); }
  bool halt();
  bool setup();
  bool start();
  bool wait_for_timeout();
  void wait_for_frame();
  std::string take();
  SlaveResult result();
  std::uint64_t line_bits(unsigned index, unsigned count) const;

  WordPort port_;
  sim::Pin irq_;
  FrameShape shape_;
  std::uint32_t half_ = 0;                 // clocks of half a period of MA
  std::array<std::uint32_t, 16> words_{};  // of the last frame
};

bool ClbSession::halt() {
  return write(regs::kAddrClkGpreg, 0) && write(regs::kAddrFsmGpreg, regs::END_LEVEL::kMask) &&
         write(regs::kAddrClkLoadEn, 0) && write(regs::kAddrFsmLoadEn, 0);
}

// setFreq and setupPeriph.
std::string ClbSession::configure() {
  const sim::Scenario& scenario = simulator_.scenario();
  shape_ = shape_of(scenario);
  half_ = static_cast<std::uint32_t>(sim::clb_half(scenario.chip.f_clk_hz, scenario.host.ma_hz));
  const bool done =
      halt() && write(regs::kAddrClkCounter0Match1, half_ - 1) &&
      write(regs::kAddrClkCounter0Match2, 2 * half_ - 1) &&
      write(regs::kAddrClkCounter1Match1, half_ - 1) &&
      write(regs::kAddrClkCounter1Match2, 2 * half_ - 1) &&
      write(regs::kAddrIrqEnable, regs::RECEIVED_ENABLE::kMask | regs::ERROR_ENABLE::kMask);
  return done ? "" : kNoAnswer;
}

// Until MA has ended and the encoder has let go of SL, or no frame has begun.
bool ClbSession::wait_for_timeout() {
  const sim::Time end = simulator_.now() + kTimeout;
  while (true) {
    std::uint32_t state = 0;
    if (!port_.read(regs::kAddrFsmState, state)) return false;
    const std::uint32_t frame = regs::FRAME_STATE::get(state);
    if ((frame == 0 || frame == kStateReceive) && regs::SL_LEVEL::get(state) != 0) return true;
    if (simulator_.now() > end) return true;
  }
}

// setupSCDTransaction.
bool ClbSession::setup() {
  const std::uint32_t width = kWordBits - 1;
  const std::uint32_t clear = regs::RXFFINTCLR::kMask;
  return wait_for_timeout() && halt() && write(regs::kAddrSpiccr, width) &&
         write(regs::kAddrSpiffrx, regs::RXFFOVFCLR::kMask | clear) &&
         write(regs::kAddrSpiffrx,
               regs::RXFIFORESET::kMask | clear | regs::RXFFIENA::kMask | shape_.words()) &&
         write(regs::kAddrSpiccr, regs::SPISWRESET::kMask | width) &&
         write(regs::kAddrIrqStatus,
               regs::RECEIVED::kMask | regs::ERROR::kMask | regs::START_SEEN::kMask) &&
         write(regs::kAddrFsmCounter2Match1, shape_.words() * kWordBits) &&
         write(regs::kAddrFsmHlcR0, shape_.clocks()) &&
         write(regs::kAddrClkLoadEn, regs::CLK_GLOBAL_EN::kMask) &&
         write(regs::kAddrFsmLoadEn, regs::FSM_GLOBAL_EN::kMask);
}

// startOperation.
bool ClbSession::start() {
  return wait_for_timeout() && write(regs::kAddrClkCounter0Load, half_ - 1) &&
         write(regs::kAddrFsmGpreg, regs::END_LEVEL::kMask | regs::FSM_START_OPERATION::kMask) &&
         write(regs::kAddrClkGpreg, regs::CLK_START_OPERATION::kMask);
}

// Up to the interrupt.
void ClbSession::wait_for_frame() {
  const sim::Time step = sim::kPsPerUs / 2;
  const sim::Time end = simulator_.now() + kPatience;
  while (!simulator_.pin(irq_) && simulator_.now() < end) simulator_.advance(step);
}

// spiRxISR. Returns why there are no words.
std::string ClbSession::take() {
  std::uint32_t fifo = 0;
  if (!port_.read(regs::kAddrSpiffrx, fifo)) return kNoAnswer;
  if (regs::RXFFINT::get(fifo) == 0) {
    return write(regs::kAddrIrqStatus, regs::ERROR::kMask) ? "no start bit" : kNoAnswer;
  }
  for (unsigned i = 0; i < shape_.words(); ++i) {
    if (!port_.read(regs::kAddrSpirxbuf, words_[i])) return kNoAnswer;
  }
  const bool done = write(regs::kAddrSpiffrx,
                          regs::RXFIFORESET::kMask | regs::RXFFINTCLR::kMask | shape_.words()) &&
                    write(regs::kAddrIrqStatus, regs::RECEIVED::kMask | regs::ERROR::kMask);
  return done ? "" : kNoAnswer;
}

// Bits of the line from `index` on, where START is 0.
std::uint64_t ClbSession::line_bits(unsigned index, unsigned count) const {
  std::uint64_t value = 0;
  for (; count > 0; --count, ++index) {
    const unsigned place = kWordBits - 1 - index % kWordBits;
    value = value << 1U | (words_[index / kWordBits] >> place & 1U);
  }
  return value;
}

// receivePosition.
SlaveResult ClbSession::result() {
  if (line_bits(0, 1) == 0) return {std::nullopt, "no start bit"};
  const unsigned data_bits = shape_.position_bits + shape_.flag_bits;
  const std::uint64_t data = line_bits(kStartAndCds, data_bits);
  const std::uint64_t crc = line_bits(kStartAndCds + data_bits, shape_.crc.width());
  if (crc != shape_.crc.line_bits(data, data_bits)) return {std::nullopt, "CRC error"};
  Word word;
  word.bits = data;
  word.data_bits = data_bits;
  word.flag_bits = shape_.flag_bits;
  word.n_error = (data & 2U) != 0;
  word.n_warning = (data & 1U) != 0;
  word.crc = shape_.crc.compute(data, data_bits);
  return {word, ""};
}

SessionFrame ClbSession::read(std::uint64_t number) {
  wait_for_begin();
  SessionFrame out;
  out.number = number;
  out.begin = simulator_.now();
  if (setup() && start()) {
    wait_for_frame();
    const std::string error = take();
    out.results.push_back(error.empty() ? result() : SlaveResult{std::nullopt, error});
  } else {
    out.results.push_back({std::nullopt, kNoAnswer});
  }
  out.sent.push_back(simulator_.slave(slaves_.front().number)->sent_word());
  out.end = simulator_.now();
  return out;
}

// Reading SPIRXBUF takes a word out. It is shown as it is then.
RegisterMap ClbSession::registers() {
  return read_registers(port_, regs::kAddrWatchdog, regs::kFields, regs::kCodes);
}

// By MATCH1 of the MA counter, one less than half a period.
unsigned ma_clocks(std::uint64_t /*clk_hz*/, unsigned match1) {
  return match1 + 1 >= sim::kClbShortestHalf ? 2 * (match1 + 1) : 0;
}

}  // namespace

const MasterSupport kClbSupport{
    .type = "clb",
    .check = [](const sim::Scenario& scenario) { shape_of(scenario); },
    .open = [](const sim::Scenario& scenario, const SessionOptions& options)
        -> std::unique_ptr<Session> { return std::make_unique<ClbSession>(scenario, options); },
    .sweep = {.name = "MA_MATCH1",
              .most = sim::kClbLongestHalf - 1,
              .refuses = "half a period of MA has at least 4 clocks, MA_MATCH1 + 1; not MA_MATCH1",
              .divider = ma_clocks}};

}  // namespace mb4::tool
