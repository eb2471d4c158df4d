// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/simulator.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "chip_model.hpp"
#include "sim/core/random.hpp"
#include "sim/faults/fault_target.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kChipSeed = 0;  // part numbers of derive_seed(); slaves use 1 to 8
constexpr std::uint64_t kFirstLineSeed = 9;
constexpr std::uint64_t kFaultSeed = 11;

std::unique_ptr<Slave> make_slave(const SlaveConfig& config, std::uint64_t seed) {
  std::unique_ptr<Slave> slave = config.device->make_slave(seed);
  for (const auto& [address, value] : config.registers) slave->reg_write(address, value);
  return slave;
}

[[noreturn]] void stop_for_pulse(std::size_t index, const std::string& violation) {
  throw ModelStopped("MA" + std::to_string(index + 1) + ": " + violation);
}

constexpr std::size_t index_of(Pin pin) { return static_cast<std::size_t>(pin); }

}  // namespace

// What faults can reach.
class SimulatorFaults final : public FaultTarget {
 public:
  explicit SimulatorFaults(Simulator& simulator) : simulator_(simulator) {}
  Line& line(unsigned channel) override { return *simulator_.line(channel); }
  Slave& slave(unsigned number) override { return *simulator_.slave(number); }
  void abort_transfer(std::uint64_t bits) override { simulator_.spi().abort_next(bits); }
  void set_clock(Time now, std::optional<std::uint64_t> hz) override {
    simulator_.chip_->set_clock(now, hz.value_or(simulator_.scenario().chip.f_clk_hz));
  }

 private:
  Simulator& simulator_;
};

Simulator::Simulator(const Scenario& scenario, const SimulatorOptions& options)
    : scenario_(scenario),
      seed_(options.seed.value_or(scenario.seed)),
      sl_pins_{SlPin{this, Pin::kSl1}, SlPin{this, Pin::kSl2}},
      spi_(*this, SpiTiming::for_frequency(scenario.host.sclk_hz)),
      spi2_(*this, SpiTiming::for_frequency(scenario.host.sclk2_hz), kSpi2Pins),
      bus_(*this,
           scenario.host.interface == HostInterface::kMotorola ? ParallelMode::kMotorola
                                                               : ParallelMode::kIntel,
           ParallelTiming::for_cycle(scenario.host.cycle)) {
  const std::uint64_t chip_seed = derive_seed(seed_, kChipSeed);
  for (std::size_t index = 0; index < index_of(Pin::kEot); ++index) {
    const Pin pin = static_cast<Pin>(index);
    levels_[index] = pulled_up(pin) || pin == Pin::kCfgspi;  // CFGSPI is a strap
    if (levels_[index]) host_check_.edge(0, pin, true);
  }
  for (const ChannelConfig& channel : scenario_.channels) {
    const std::size_t index = channel.number - 1;
    auto line = std::make_unique<Line>(queue_, channel.delay, &Simulator::on_sl, &sl_pins_[index],
                                       channel.cable, derive_seed(seed_, kFirstLineSeed + index));
    unsigned number = scenario_.master->first_slave(channel.number);
    for (const SlaveConfig& slave : channel.slaves) {
      line->chain().add(make_slave(slave, derive_seed(seed_, number)));
      ++number;
    }
    if (!channel.protocol().start_bit) line->faults().set_no_start_bit();
    for (const auto& [frame, bits] : channel.flips) line->faults().flip_frame(frame, bits);
    lines_[index] = std::move(line);
  }
  const TraceFile trace{options.trace_path.value_or(""), options.trace_from, options.trace_to};
  chip_ = options.trace_path         ? make_traced_chip(scenario_.chip, chip_seed, trace)
          : options.plain_evaluation ? make_plain_chip(scenario_.chip, chip_seed)
                                     : make_fast_chip(scenario_.chip, chip_seed);
  if (options.trace_path) {
    for (const auto& line : lines_) {
      if (line != nullptr) line->set_probe(&Simulator::on_probe, this);
    }
    on_probe(0, this);
  }
  fault_target_ = std::make_unique<SimulatorFaults>(*this);
  injector_ = std::make_unique<FaultInjector>(*fault_target_, queue_, scenario_.faults,
                                              derive_seed(seed_, kFaultSeed));
  // For the lines MA rests at 1 and MO at 0. Any other level of the chip is now a change.
  seen_ = ChipModel::kMa1 | ChipModel::kMa2;
  settle();
  set_straps();
  run_until(kResetLow);
  set_pin(Pin::kNres, true);
  run_until(kReady);
}

Simulator::~Simulator() = default;

void Simulator::set_straps() {
  if (scenario_.host.parallel()) {
    bus_.rest();
  } else if (scenario_.host.interface == HostInterface::kSpi2) {
    set_pin(Pin::kDb4, true);  // NCS of SPI2
    set_pin(Pin::kNwrE, false);
  }
}

void Simulator::check_alive() const {
  if (stopped_) throw ModelStopped(*stopped_);
}

bool Simulator::step(Time limit) {
  const Time event = queue_.next_time();
  const Time until = std::min(limit, event);
  // Clock edges come before events of the same time: an input that changes together with the clock
  // is too late for that edge.
  if (const Time changed = chip_->run_clocks(until); changed != kNever) {
    now_ = changed;
    settle();
    return true;
  }
  now_ = until;
  if (event > limit) return false;
  queue_.run_next();
  return true;
}

void Simulator::run_until(Time time) {
  check_alive();
  if (time < now_) return;
  try {
    while (step(time)) {
    }
  } catch (const ModelStopped& error) {
    stopped_ = error;
    throw;
  }
}

void Simulator::advance(Time duration) {
  const Time left = now_ < kEndOfTime ? kEndOfTime - now_ : 0;
  run_until(now_ + std::min(duration, left));
}

bool Simulator::run_while_waiting(const std::function<bool()>& done, Time limit) {
  check_alive();
  try {
    while (!done()) {
      if (!step(limit)) return done();
    }
  } catch (const ModelStopped& error) {
    stopped_ = error;
    throw;
  }
  return true;
}

std::uint64_t Simulator::clk_cycles() const { return chip_->cycles(); }
std::uint64_t Simulator::clk_cycles_left_out() const { return chip_->left_out(); }

void Simulator::drive_chip(Pin pin, bool level) {
  chip_->set_input(now_, pin, level);
  // Host pins and reset change CFGIF. It decides whether MA2 is the inverse of another pin.
  if (pin != Pin::kSl1 && pin != Pin::kSl2 && chip_->paired() != paired_) {
    paired_ = !paired_;
    ma_checks_[1].restart((chip_->watched() & ChipModel::kMa2) != 0);
    if (lines_[1] == nullptr) drive_sl(Pin::kSl2, !(drives_pair() && this->pin(Pin::kSl1)));
  }
  settle();
}

inline void Simulator::check_ma(std::size_t index, bool level) {
  // A pin that follows MA1 has no pulses of its own.
  if (index == 1 && paired_) {
    ma_checks_[index].restart(level);
    return;
  }
  const std::string* violation = ma_checks_[index].edge(now_, level, chip_->cycles(),
                                                        chip_->half_clocks(), chip_->min_clock());
  if (violation != nullptr) stop_for_pulse(index, *violation);
}

// `ma`, `mo`: the bits of the line's pins in `changed` and `outputs`.
inline void Simulator::drive_line(std::size_t index, unsigned changed, unsigned outputs,
                                  unsigned ma, unsigned mo) {
  if ((changed & ma) != 0) check_ma(index, (outputs & ma) != 0);
  if ((changed & (ma | mo)) == 0 || lines_[index] == nullptr) return;
  lines_[index]->drive(now_, (outputs & ma) != 0, (outputs & mo) != 0);
}

// Handles outputs that have changed. This may change inputs, which calls settle() again; that inner
// call returns at once and the loop here sees its changes.
void Simulator::settle() {
  if (settling_) return;
  settling_ = true;
  struct Leave {
    bool& flag;
    ~Leave() { flag = false; }
  } leave{settling_};
  for (unsigned now = chip_->watched(); now != seen_; now = chip_->watched()) {
    const unsigned changed = now ^ seen_;
    seen_ = now;
    drive_line(0, changed, now, ChipModel::kMa1, ChipModel::kMo1);
    drive_line(1, changed, now, ChipModel::kMa2, ChipModel::kMo2);
    if ((changed & ChipModel::kEot) != 0 && observer_ != nullptr) {
      observer_->pin_changed(Pin::kEot, (now & ChipModel::kEot) != 0);
    }
    if ((changed & ChipModel::kNerLow) != 0) chip_->set_input(now_, Pin::kNer, pin(Pin::kNer));
  }
}

void Simulator::on_sl(Time /*now*/, void* receiver, bool level) {
  const auto* sl = static_cast<SlPin*>(receiver);
  sl->simulator->drive_sl(sl->pin, level);
  if (sl->simulator->drives_pair()) sl->simulator->drive_sl(Pin::kSl2, !level);
}

void Simulator::drive_sl(Pin pin, bool level) {
  levels_[index_of(pin)] = level;
  drive_chip(pin, level);
}

void Simulator::on_probe(Time now, void* receiver) {
  auto* simulator = static_cast<Simulator*>(receiver);
  unsigned ma = 0;
  unsigned slo = 0;
  unsigned idle = 0;
  for (unsigned channel = 1; channel <= 2; ++channel) {
    const Line* line = simulator->lines_[channel - 1].get();
    if (line == nullptr || line->chain().ma()) ma |= 1U << (channel - 1);
  }
  for (unsigned number = 1; number <= simulator->scenario_.master->slaves; ++number) {
    const Slave* slave = simulator->slave(number);
    if (slave == nullptr || slave->slo()) slo |= 1U << (number - 1);
    if (slave == nullptr || slave->idle()) idle |= 1U << (number - 1);
  }
  simulator->chip_->set_probes(now, ma, slo, idle);
}

bool Simulator::can_set(Pin pin) const {
  if (is_output(pin)) return false;
  if (pin == Pin::kSl1) return lines_[0] == nullptr;
  if (pin == Pin::kSl2) return lines_[1] == nullptr && !drives_pair();
  if (pin == Pin::kClk) return scenario_.chip.f_clk_hz == 0;
  return true;
}

void Simulator::set_observer(PinObserver* observer) {
  observer_ = observer;
  if (observer == nullptr) return;
  for (std::size_t index = 0; index <= index_of(Pin::kEot); ++index) {
    const Pin pin = static_cast<Pin>(index);
    observer->pin_changed(pin, is_output(pin) ? this->pin(pin) : levels_[index]);
  }
}

void Simulator::set_pin(Pin pin, bool level) {
  check_alive();
  if (!can_set(pin)) return;
  try {
    if (pin == Pin::kNer) {
      ner_pulled_ = !level;
      drive_chip(pin, this->pin(pin));
      return;
    }
    if (levels_[index_of(pin)] == level) return;
    levels_[index_of(pin)] = level;
    host_check_.edge(now_, pin, level);
    if (observer_ != nullptr) observer_->pin_changed(pin, level);
    drive_chip(pin, level);
  } catch (const ModelStopped& error) {
    stopped_ = error;
    throw;
  }
}

bool Simulator::pin(Pin pin) const {
  const unsigned outputs = chip_->watched();
  switch (pin) {
    case Pin::kEot:
      return (outputs & ChipModel::kEot) != 0;
    case Pin::kMa1:
      return (outputs & ChipModel::kMa1) != 0;
    case Pin::kMa2:
      return (outputs & ChipModel::kMa2) != 0;
    case Pin::kMo1:
      return (outputs & ChipModel::kMo1) != 0;
    case Pin::kMo2:
      return (outputs & ChipModel::kMo2) != 0;
    case Pin::kClk:
      return chip_->clk();
    case Pin::kNer:
      return !ner_pulled_ && (outputs & ChipModel::kNerLow) == 0;
    default:
      break;
  }
  const std::size_t index = index_of(pin);
  if (index <= index_of(Pin::kDb7) && ((chip_->db_enable() >> index) & 1U) != 0) {
    return ((chip_->db_out() >> index) & 1U) != 0;
  }
  return levels_[index];
}

Line* Simulator::line(unsigned channel) {
  return channel >= 1 && channel <= lines_.size() ? lines_[channel - 1].get() : nullptr;
}

const Slave* Simulator::slave(unsigned number) const {
  if (number == 0) return nullptr;
  const unsigned channel = scenario_.channel_of(number);
  const Line* line = lines_[channel - 1].get();
  const unsigned index = number - scenario_.master->first_slave(channel);
  return line != nullptr && index < line->chain().size() ? &line->chain().slave(index) : nullptr;
}

Slave* Simulator::slave(unsigned number) {
  return const_cast<Slave*>(std::as_const(*this).slave(number));
}

void Simulator::refresh_lines() {
  check_alive();
  for (const auto& line : lines_) {
    if (line != nullptr) line->refresh(now_);
  }
}

void Simulator::flush_trace() { chip_->finish_trace(); }

}  // namespace mb4::sim
