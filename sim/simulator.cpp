// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/simulator.hpp"

#include <algorithm>
#include <utility>

#include "sim/core/random.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/faults/fault_target.hpp"
#include "sim/masters/master.hpp"
#include "sim/scenario/injection.hpp"

namespace mb4::sim {
namespace {

using Outputs = MasterModel::Outputs;

// Part numbers of derive_seed(): master 0, slaves 1 to 8, lines 1 and 2 at 9 and 10, faults 11.
// Further slaves have numbers above 0x100, further lines above 0x200.
constexpr std::uint64_t kMasterSeed = 0;
constexpr std::uint64_t kFaultSeed = 11;
constexpr std::uint64_t slave_seed(unsigned number) {
  return number <= 8 ? number : 0x100 + number;
}
constexpr std::uint64_t line_seed(unsigned index) { return index < 2 ? 9 + index : 0x200 + index; }

std::unique_ptr<Slave> make_slave(const SlaveConfig& config, std::uint64_t seed) {
  std::unique_ptr<Slave> slave = config.device->make_slave(seed);
  for (const auto& [address, value] : config.registers) slave->reg_write(address, value);
  return slave;
}

[[noreturn]] void stop_for_pulse(unsigned index, const std::string& violation) {
  throw ModelStopped("MA" + std::to_string(index + 1) + ": " + violation);
}

}  // namespace

// What faults can reach.
class SimulatorFaults final : public FaultTarget {
 public:
  explicit SimulatorFaults(Simulator& simulator) : simulator_(simulator) {}
  Line& line(unsigned channel) override { return *simulator_.line(channel); }
  Slave& slave(unsigned number) override { return *simulator_.slave(number); }
  void abort_transfer(std::uint64_t bits) override { simulator_.master_->abort_transfer(bits); }
  void set_clock(Time now, std::optional<std::uint64_t> hz) override {
    simulator_.model_->set_clock(now, hz.value_or(simulator_.scenario().chip.f_clk_hz));
  }

 private:
  Simulator& simulator_;
};

Simulator::Simulator(const Scenario& scenario, const SimulatorOptions& options)
    : scenario_(scenario),
      seed_(options.seed.value_or(scenario.seed)),
      lines_(scenario.master->channels),
      trace_{options.trace_path.value_or(""), options.trace_from, options.trace_to} {
  for (unsigned index = 0; index < lines_.size(); ++index) {
    lines_[index].simulator = this;
    lines_[index].index = index;
  }
  Outputs connected = 0;
  for (const ChannelConfig& channel : scenario_.channels) {
    const unsigned index = channel.number - 1;
    auto line = std::make_unique<Line>(queue_, channel.delay, &Simulator::on_sl, &lines_[index],
                                       channel.cable, derive_seed(seed_, line_seed(index)));
    unsigned number = scenario_.master->first_slave(channel.number);
    for (const SlaveConfig& slave : channel.slaves) {
      line->chain().add(make_slave(slave, derive_seed(seed_, slave_seed(number))));
      ++number;
    }
    if (!channel.protocol().start_bit) line->faults().set_no_start_bit();
    for (const auto& [frame, bits] : channel.flips) line->faults().flip_frame(frame, bits);
    lines_[index].line = std::move(line);
    connected |= MasterModel::ma_of(index);
  }
  master_ = scenario_.master->make(
      {scenario_.chip, scenario_.host, connected, *this, derive_seed(seed_, kMasterSeed),
       options.trace_path ? &trace_ : nullptr, options.plain_evaluation});
  model_ = &master_->model();
  tracing_ = options.trace_path.has_value();
  if (tracing_) set_probes(&Simulator::on_probe);
  fault_target_ = std::make_unique<SimulatorFaults>(*this);
  injector_ = std::make_unique<FaultInjector>(*fault_target_, queue_, scenario_.faults,
                                              derive_seed(seed_, kFaultSeed));
  // For the lines MA rests at 1 and MO at 0. Any other level of the master is now a change.
  for (unsigned index = 0; index < lines_.size(); ++index) seen_ |= MasterModel::ma_of(index);
  settle();
  master_->power_on();
  run_until(kReady);
}

Simulator::~Simulator() = default;

void Simulator::check_alive() const {
  if (stopped_) throw ModelStopped(*stopped_);
}

bool Simulator::step(Time limit) {
  const Time event = queue_.next_time();
  const Time until = std::min(limit, event);
  // Clock edges come before events of the same time: an input that changes together with the clock
  // is too late for that edge.
  if (const Time changed = model_->run_clocks(until); changed != kNever) {
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

std::uint64_t Simulator::clk_cycles() const { return model_->cycles(); }
std::uint64_t Simulator::clk_cycles_left_out() const { return model_->left_out(); }

inline void Simulator::check_ma(LineEnd& end, bool level) {
  // A pin that follows another one has no pulses of its own.
  if (end.follows) {
    end.ma_check.restart(level);
    return;
  }
  const std::string* violation = end.ma_check.edge(
      now_, level, model_->cycles(), model_->half_clocks(end.index), model_->min_clock());
  const bool cut = model_->take_cut(MasterModel::ma_of(end.index));
  if (violation == nullptr) return;
  if (!cut) stop_for_pulse(end.index, *violation);
  end.ma_check.count_cut();
}

// Tells each line whose MA or MO has changed, the first line first.
inline void Simulator::lines_changed(Outputs changed, Outputs levels) {
  constexpr Outputs kMa = MasterModel::ma_of(0);
  constexpr Outputs kMo = MasterModel::mo_of(0);
  for (LineEnd* end = lines_.data(); changed != 0; ++end) {
    if ((changed & kMa) != 0) check_ma(*end, (levels & kMa) != 0);
    if ((changed & (kMa | kMo)) != 0 && end->line != nullptr) {
      end->line->drive(now_, (levels & kMa) != 0, (levels & kMo) != 0);
    }
    changed >>= MasterModel::kBitsOfLine;
    levels >>= MasterModel::kBitsOfLine;
  }
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
  constexpr Outputs kLines = MasterModel::own(0) - 1;
  for (Outputs now = model_->outputs(); now != seen_; now = model_->outputs()) {
    const Outputs changed = now ^ seen_;
    seen_ = now;
    lines_changed(changed & kLines, now);
    if ((changed & ~kLines) != 0) master_->own_outputs_changed(now_, changed);
  }
}

void Simulator::on_sl(Time /*now*/, void* receiver, bool level) {
  const auto* end = static_cast<LineEnd*>(receiver);
  end->simulator->model_->set_sl(end->simulator->now_, end->index, level);
  end->simulator->settle();
}

void Simulator::on_probe(Time now, void* receiver) {
  auto* simulator = static_cast<Simulator*>(receiver);
  std::uint64_t ma = 0;
  std::uint64_t slo = 0;
  std::uint64_t idle = 0;
  for (const LineEnd& end : simulator->lines_) {
    if (end.line == nullptr || end.line->chain().ma()) ma |= std::uint64_t{1} << end.index;
  }
  for (unsigned number = 1; number <= simulator->scenario_.master->slaves; ++number) {
    const Slave* slave = simulator->slave(number);
    const std::uint64_t bit = std::uint64_t{1} << (number - 1);
    if (slave == nullptr || slave->slo()) slo |= bit;
    if (slave == nullptr || slave->idle()) idle |= bit;
  }
  simulator->model_->set_probes(now, ma, slo, idle);
}

void Simulator::set_probes(Line::Probe probe) {
  for (const LineEnd& end : lines_) {
    if (end.line != nullptr) end.line->set_probe(probe, this);
  }
  if (probe != nullptr) probe(now_, this);
}

std::optional<Pin> Simulator::pin_by_name(std::string_view name) const {
  const auto find = scenario_.master->pin_by_name;
  return find == nullptr ? std::nullopt : find(name);
}

bool Simulator::can_set(Pin pin) const { return master_->can_set(pin); }
bool Simulator::pin(Pin pin) const { return master_->pin(pin); }

void Simulator::change_followers() {
  followers_ = model_->followers();
  for (LineEnd& end : lines_) {
    const Outputs ma = MasterModel::ma_of(end.index);
    const bool follows = (followers_ & ma) != 0;
    if (end.follows == follows) continue;
    end.follows = follows;
    end.ma_check.restart((model_->outputs() & ma) != 0);
  }
}

void Simulator::set_observer(PinObserver* observer) { master_->set_observer(observer); }

void Simulator::set_pin(Pin pin, bool level) {
  check_alive();
  try {
    master_->set_pin(now_, pin, level);
    if (model_->followers() != followers_) change_followers();
    if (model_->outputs() != seen_) settle();
  } catch (const ModelStopped& error) {
    stopped_ = error;
    throw;
  }
}

Line* Simulator::line(unsigned channel) {
  return channel >= 1 && channel <= lines_.size() ? lines_[channel - 1].line.get() : nullptr;
}

const Slave* Simulator::slave(unsigned number) const {
  if (number == 0) return nullptr;
  const unsigned channel = scenario_.channel_of(number);
  const Line* line = lines_[channel - 1].line.get();
  const unsigned index = number - scenario_.master->first_slave(channel);
  return line != nullptr && index < line->chain().size() ? &line->chain().slave(index) : nullptr;
}

Slave* Simulator::slave(unsigned number) {
  return const_cast<Slave*>(std::as_const(*this).slave(number));
}

void Simulator::refresh_lines() {
  check_alive();
  for (const LineEnd& end : lines_) {
    if (end.line != nullptr) end.line->refresh(now_);
  }
}

void Simulator::inject(std::string_view text) {
  check_alive();
  const Injection injection = parse_injection(text, "inject", scenario_, now_);
  scenario_.faults.insert(scenario_.faults.end(), injection.faults.begin(), injection.faults.end());
  injector_->add_new();
  for (const Injection::Event& each : injection.events) {
    Line* const place = line(each.channel);
    const CableEvent::Action action = each.event.action;
    at(each.event.time, [this, place, action] { place->act(now_, action); });
  }
  run_until(now_);  // what begins now has begun when this returns
}

void Simulator::flush_trace() { model_->finish_trace(); }

void Simulator::start_trace(const std::string& path) {
  check_alive();
  if (tracing_) throw TraceError(path + ": a waveform is being written already");
  master_->start_trace({path, now_, kNever});
  model_ = &master_->model();
  tracing_ = part_ = true;
  set_probes(&Simulator::on_probe);
}

bool Simulator::stop_trace() {
  if (!part_) return false;
  tracing_ = part_ = false;
  set_probes(nullptr);
  master_->stop_trace();
  model_ = &master_->model();
  return true;
}

}  // namespace mb4::sim
