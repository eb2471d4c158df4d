// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/mb4/mb4_workload.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "masters/mb4/chip_setup.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "mb4/device.hpp"
#include "mb4/opcodes.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

constexpr sim::Time kPoll = 100 * sim::kPsPerUs;    // between two looks at a register access
constexpr sim::Time kStart = 3000 * sim::kPsPerUs;  // until frames run, those of C too
constexpr std::uint8_t kFirstRegister = 0x40;

constexpr const char* kChannel = "[[channel]]\nnumber = ";
constexpr const char* kSlave =
    "\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\n";

std::string channel_of(char number, unsigned slaves) {
  std::string text = std::string(kChannel) + number + '\n';
  for (unsigned i = 0; i < slaves; ++i) text += kSlave;
  return text;
}

template <typename T>
void require(const Result<T>& result, const char* what) {
  if (!result) {
    throw std::runtime_error(std::string("workload: ") + what + ": " + describe(result.info()));
  }
}

// A chip with a driver, configured; frames run by themselves unless `frame_period_clk` is kNone.
class Bench : public Workload {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::uint32_t kBackToBack = 0;

  Bench(const std::string& scenario, std::uint32_t frame_period_clk)
      : scenario_(sim::parse_scenario(scenario, "workload")),
        simulator_(scenario_),
        bus_(simulator_),
        clock_(simulator_),
        device_(bus_, clock_) {
    Config config = make_config(scenario_);
    if (frame_period_clk != kNone && frame_period_clk != kBackToBack) {
      config.frame_start = FrameStart::kPeriodic;
      config.frame_period_clk = frame_period_clk;
    }
    require(device_.configure(config), "configuration");
    if (frame_period_clk == kNone) return;
    require(device_.automatic().start(), "automatic frames");
    simulator_.advance(kStart);
    if (count().frames == 0) throw std::runtime_error("workload: there are no frames");
  }

  void run(sim::Time duration) override { simulator_.advance(duration); }

  WorkCount count() const override {
    WorkCount count;
    count.clocks = simulator_.clk_cycles();
    count.time = simulator_.now();
    for (unsigned number = 1; number <= simulator_.scenario().master->slaves; ++number) {
      const sim::Slave* slave = simulator_.slave(number);
      if (slave != nullptr) count.frames += slave->frames();
    }
    return count;
  }

 protected:
  const sim::Scenario scenario_;
  sim::Simulator simulator_;
  SimBus bus_;
  SimClock clock_;
  Device<SimBus, SimClock> device_;
};

// The host looks after the access every 100 us and begins the next one, with the next slave.
class RegisterAccess final : public Bench {
 public:
  RegisterAccess() : Bench(channel_of('1', 4) + channel_of('2', 4), kBackToBack) {}

  void run(sim::Time duration) override {
    const sim::Time end = simulator_.now() + duration;
    while (simulator_.now() < end) {
      if (!running_) begin();
      simulator_.advance(kPoll);
      if (device_.finish(access_, access_.run(bus_), clock_.now_us())) end_access();
    }
  }

  WorkCount count() const override {
    WorkCount count = Bench::count();
    count.accesses = accesses_;
    return count;
  }

 private:
  static constexpr unsigned kSlavesPerChannel = 4;

  void begin() {
    const SlaveAddress slave{static_cast<std::uint8_t>(1 + (accesses_ & 1U)),
                             static_cast<std::uint8_t>((accesses_ / 2) % kSlavesPerChannel)};
    require(device_.control().plan_read(access_, slave, kFirstRegister, values_),
            "register access");
    running_ = true;
  }

  void end_access() {
    require(access_.result(), "register access");
    running_ = false;
    ++accesses_;
  }

  Operation access_;
  std::array<std::uint8_t, kMaxRegistersPerAccess> values_{};
  std::uint64_t accesses_ = 0;
  bool running_ = false;
};

// Bursts over the registers without a pause, written and read in turn.
class SpiTraffic final : public Bench {
 public:
  SpiTraffic() : Bench(channel_of('1', 1), kNone) {}

  void run(sim::Time duration) override {
    const sim::Time end = simulator_.now() + duration;
    while (simulator_.now() < end) {
      ++bursts_;
      for (std::size_t i = 2; i < write_.size(); ++i) {
        write_[i] = static_cast<std::uint8_t>(bursts_ + i);
      }
      bus_.transfer(write_, {});
      bus_.transfer(read_, back_);
      for (std::size_t i = 2; i < write_.size(); ++i) {
        if (back_[i] != write_[i]) throw std::runtime_error("workload: SPI: not read as written");
      }
    }
  }

  WorkCount count() const override {
    WorkCount count = Bench::count();
    count.spi_bytes = bursts_ * 2 * write_.size();
    return count;
  }

 private:
  static constexpr std::size_t kBurst = 66;  // opcode, address and RDATA1 to RDATA64
  static constexpr std::uint8_t kRdata = 0x80;

  std::uint64_t bursts_ = 0;
  std::array<std::uint8_t, kBurst> write_{
      static_cast<std::uint8_t>(regs::SpiOpcode::kWriteRegisters), kRdata};
  std::array<std::uint8_t, kBurst> read_{static_cast<std::uint8_t>(regs::SpiOpcode::kReadRegisters),
                                         kRdata};
  std::array<std::uint8_t, kBurst> back_{};
};

using SpiFrame = std::vector<std::uint8_t>;

// The 54 bytes that the driver writes from 0xC0 on for one slave of 28 bits with CRC 0x43, MA at
// 10 MHz, and what it sends around them. `freqags`: the byte of FREQAGS.
std::vector<SpiFrame> recorded_setup(std::uint8_t freqags) {
  SpiFrame write(56);
  write[0] = 0x02;
  write[1] = 0xC0;
  write[2] = 0x5B;
  write[3] = 0x06;
  write[39] = 0x40;
  write[40] = 0xA0;
  write[42] = freqags;
  write[46] = 0x01;
  write[47] = 0x0D;
  SpiFrame read(56);
  read[0] = 0x03;
  read[1] = 0xC0;
  return {{0x07, 0x80, 0x00}, write, read};
}

// What `mb4sim run` and Automatic::poll_slave() have sent for a frame, byte for byte. The bytes are
// recorded, so a change of the driver does not change this workload.
const SpiFrame kStatus = {0x05, 0, 0, 0, 0, 0};
const SpiFrame kReadWord = {0x09, 0, 0, 0, 0, 0, 0, 0, 0};
const SpiFrame kClearValid = {0x02, 0xF1, 0xFD, 0xFF};
const std::vector<SpiFrame> kSingleFrame = {{0x07, 0x04}, kStatus, kStatus, kReadWord, kClearValid};
const std::vector<SpiFrame> kHeldFrame = {{0x07, 0x41}, kStatus,     kReadWord,
                                          kStatus,      kClearValid, {0x07, 0x01}};

struct Recording {
  std::uint8_t freqags;
  std::vector<SpiFrame> start;  // after the configuration
  std::vector<SpiFrame> cycle;  // for one frame
  sim::Time period;             // from the begin of a cycle to that of the next; 0: no pause
};

const Recording kReadSingle{0x7C, {}, kSingleFrame, 0};
const Recording kReadAutomatic{0x87, {{0x07, 0x01}}, kHeldFrame, 250 * sim::kPsPerUs};

// Firmware that reads one encoder over SPI.
class Firmware final : public Workload {
 public:
  explicit Firmware(const Recording& recording)
      : simulator_(sim::parse_scenario(channel_of('1', 1), "workload")), recording_(recording) {
    send(recorded_setup(recording.freqags));
    send(recording.start);
    next_ = simulator_.now() + recording.period;
    simulator_.run_until(next_);
    while (good_ == 0) cycle();
  }

  void run(sim::Time duration) override {
    const sim::Time end = simulator_.now() + duration;
    while (simulator_.now() < end) cycle();
  }

  WorkCount count() const override {
    WorkCount count;
    count.clocks = simulator_.clk_cycles();
    count.time = simulator_.now();
    count.frames = good_;
    count.spi_bytes = bytes_;
    return count;
  }

 private:
  static constexpr unsigned kCyclesUntilData = 4;

  void send(const std::vector<SpiFrame>& frames) {
    for (const SpiFrame& frame : frames) {
      back_.resize(frame.size());
      simulator_.spi().transfer(frame, back_);
      bytes_ += frame.size();
      if (frame[0] == kReadWord[0]) word_ = back_;
    }
  }
  void cycle() {
    send(recording_.cycle);
    next_ = std::max(next_ + recording_.period, simulator_.now());
    simulator_.run_until(next_);
    // The encoder counts up, so a word that has come twice was not read.
    if (word_ != last_) ++good_;
    if (++cycles_ > good_ + kCyclesUntilData) throw std::runtime_error("workload: no new word");
    last_ = word_;
  }

  sim::Simulator simulator_;
  const Recording& recording_;
  sim::Time next_ = 0;
  SpiFrame back_;
  SpiFrame word_;
  SpiFrame last_;
  std::uint64_t cycles_ = 0;
  std::uint64_t good_ = 0;
  std::uint64_t bytes_ = 0;
};

// A simulator is made, configured and has read its first frame, again and again.
class StartUp final : public Workload {
 public:
  void run(sim::Time duration) override {
    for (const sim::Time end = total_.time + duration; total_.time < end;) {
      const WorkCount one = Firmware(kReadSingle).count();
      total_.clocks += one.clocks;
      total_.frames += one.frames;
      total_.spi_bytes += one.spi_bytes;
      total_.time += one.time;
    }
  }
  WorkCount count() const override { return total_; }

 private:
  WorkCount total_;
};

constexpr std::uint32_t kMillisecondClk = 20'000;

constexpr WorkloadInfo kWorkloads[] = {
    {'A', "1 slave of 26 bits, AGSMIN, MA 10 MHz",
     []() -> std::unique_ptr<Workload> {
       return std::make_unique<Bench>(channel_of('1', 1), Bench::kBackToBack);
     }},
    {'B', "8 slaves on 2 channels, AGSMIN, register access running",
     []() -> std::unique_ptr<Workload> { return std::make_unique<RegisterAccess>(); }},
    {'C', "1 slave, 1000 frames/s, idle in between",
     []() -> std::unique_ptr<Workload> {
       return std::make_unique<Bench>(channel_of('1', 1), kMillisecondClk);
     }},
    {'D', "SPI traffic only, SCLK 10 MHz",
     []() -> std::unique_ptr<Workload> { return std::make_unique<SpiTraffic>(); }},
    {'E', "firmware reads 1 slave frame by frame, SCLK 10 MHz",
     []() -> std::unique_ptr<Workload> { return std::make_unique<Firmware>(kReadSingle); }},
    {'F', "firmware reads 1 slave at 4 kHz, AGS, SCLK 10 MHz",
     []() -> std::unique_ptr<Workload> { return std::make_unique<Firmware>(kReadAutomatic); }},
    {'G', "start-up: a new simulator, configuration, first frame",
     []() -> std::unique_ptr<Workload> { return std::make_unique<StartUp>(); }},
    {'K', "1 slave of 26 bits, AGSMIN, MA 1 MHz",
     []() -> std::unique_ptr<Workload> {
       return std::make_unique<Bench>("[host]\nma_hz = 1_000_000\n" + channel_of('1', 1),
                                      Bench::kBackToBack);
     }},
};

}  // namespace

std::span<const WorkloadInfo> mb4_workloads() { return kWorkloads; }

}  // namespace mb4::tool
