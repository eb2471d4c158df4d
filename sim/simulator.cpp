// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/simulator.hpp"

#include <algorithm>
#include <utility>

#include "sim/core/random.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/faults/fault_target.hpp"
#include "sim/lines/line_kind.hpp"
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

}  // namespace

// What faults can reach.
class SimulatorFaults final : public FaultTarget {
 public:
  explicit SimulatorFaults(Simulator& simulator) : simulator_(simulator) {}
  Time now() const override { return simulator_.now(); }
  Line& line(unsigned channel) override { return *simulator_.line(channel); }
  Slave& slave(unsigned number) override { return *simulator_.slave(number); }
  unsigned wires() const override {
    return static_cast<unsigned>(simulator_.scenario().master->line->wires.size());
  }
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
  const LineKind& kind = *scenario_.master->line;
  Outputs connected = 0;
  for (const ChannelConfig& channel : scenario_.channels) {
    const unsigned index = channel.number - 1;
    auto line = kind.make({queue_, *channel.cable, channel.protocol(),
                           derive_seed(seed_, line_seed(index)), *this, index});
    unsigned number = scenario_.master->first_slave(channel.number);
    for (const SlaveConfig& slave : channel.slaves) {
      kind.add(*line, make_slave(slave, derive_seed(seed_, slave_seed(number))));
      ++number;
    }
    for (const auto& [frame, bits] : channel.cable->flips) line->flip(frame, bits);
    lines_[index].line = line.get();
    lines_[index].end = std::move(line);
    connected |= MasterModel::of_line(index, MasterModel::kLevels);
  }
  for (unsigned index = 0; index < lines_.size(); ++index) {
    if (lines_[index].end == nullptr) lines_[index].end = kind.make_open(*this, index);
  }
  master_ = scenario_.master->make(
      {scenario_.chip, scenario_.host, connected, *this, derive_seed(seed_, kMasterSeed),
       options.trace_path ? &trace_ : nullptr, options.plain_evaluation});
  use_model();
  tracing_ = options.trace_path.has_value();
  if (tracing_) set_probes(&Simulator::on_probe);
  fault_target_ = std::make_unique<SimulatorFaults>(*this);
  injector_ = std::make_unique<FaultInjector>(*fault_target_, queue_, scenario_.faults,
                                              derive_seed(seed_, kFaultSeed));
  // The lines are at rest. Any other level of the master is now a change.
  for (unsigned index = 0; index < lines_.size(); ++index) {
    seen_ |= MasterModel::of_line(index, kind.rest);
  }
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

void Simulator::use_model() {
  model_ = &master_->model();
  clock_ = model_;
}

void Simulator::stop(const std::string& reason) { throw ModelStopped(reason); }

// Tells each line whose outputs have changed, the first line first.
inline void Simulator::lines_changed(Outputs changed, Outputs levels) {
  for (const Place* place = lines_.data(); changed != 0; ++place) {
    if ((changed & MasterModel::kLevels) != 0) {
      place->end->drive(now_, static_cast<unsigned>(levels & MasterModel::kLevels));
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

void Simulator::set_inputs(Time /*now*/, unsigned line, unsigned levels) {
  model_->set_inputs(now_, line, levels);
  settle();
}

// What is not there is 1.
void Simulator::on_probe(Time now, void* receiver) {
  auto* simulator = static_cast<Simulator*>(receiver);
  const Master& master = *simulator->scenario_.master;
  const auto all = [](std::size_t bits) { return ~std::uint64_t{0} >> (64 - bits); };
  const auto clear = [](std::uint64_t& word, std::size_t bit, bool level) {
    if (!level) word &= ~(std::uint64_t{1} << bit);
  };
  std::uint64_t arrived = all(simulator->lines_.size());
  std::uint64_t sent = all(master.slaves);
  std::uint64_t ready = sent;
  for (std::size_t index = 0; index < simulator->lines_.size(); ++index) {
    const Line* line = simulator->lines_[index].line;
    if (line == nullptr) continue;
    clear(arrived, index, line->arrived());
    const unsigned first = master.first_slave(static_cast<unsigned>(index) + 1) - 1;
    for (std::size_t i = 0; i < line->size(); ++i) {
      clear(sent, first + i, line->sent(i));
      clear(ready, first + i, line->ready(i));
    }
  }
  simulator->model_->set_probes(now, arrived, sent, ready);
}

void Simulator::set_probes(Line::Probe probe) {
  for (const Place& place : lines_) {
    if (place.line != nullptr) place.line->set_probe(probe, this);
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
  for (unsigned index = 0; index < lines_.size(); ++index) {
    const bool follows = (followers_ & MasterModel::of_line(index, MasterModel::kLevels)) != 0;
    lines_[index].end->follow(follows, outputs(index + 1));
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
  return channel >= 1 && channel <= lines_.size() ? lines_[channel - 1].line : nullptr;
}

const Slave* Simulator::slave(unsigned number) const {
  if (number == 0) return nullptr;
  const unsigned channel = scenario_.channel_of(number);
  const Line* line = lines_[channel - 1].line;
  const unsigned index = number - scenario_.master->first_slave(channel);
  return line != nullptr && index < line->size() ? &line->slave(index) : nullptr;
}

Slave* Simulator::slave(unsigned number) {
  return const_cast<Slave*>(std::as_const(*this).slave(number));
}

std::vector<Hint> Simulator::hints(std::uint64_t missed) {
  std::vector<HintLine> lines;
  for (const ChannelConfig& channel : scenario_.channels) {
    const Line& line = *lines_[channel.number - 1].line;
    const LineProtocol protocol = channel.protocol();
    HintLine told{channel.number, line.round_trip(), protocol.key, protocol.title, {}};
    unsigned number = scenario_.master->first_slave(channel.number);
    for (std::size_t i = 0; i < channel.slaves.size(); ++i, ++number) {
      told.devices.push_back({number, &*channel.slaves[i].device, line.slave(i).sends_data()});
    }
    lines.push_back(std::move(told));
  }
  return master_->hints(lines, missed);
}

void Simulator::refresh_lines() {
  check_alive();
  for (const Place& place : lines_) {
    if (place.line != nullptr) place.line->refresh(now_);
  }
}

void Simulator::inject(std::string_view text) {
  check_alive();
  const Injection injection = parse_injection(text, "inject", scenario_, now_);
  scenario_.faults.insert(scenario_.faults.end(), injection.faults.begin(), injection.faults.end());
  injector_->add_new();
  for (const Injection::Event& each : injection.events) {
    Line* const place = line(each.channel);
    const LineAction action = each.event.action;
    at(each.event.time, [this, place, action] { place->act(now_, action); });
  }
  run_until(now_);  // what begins now has begun when this returns
}

void Simulator::flush_trace() { model_->finish_trace(); }

void Simulator::start_trace(const std::string& path) {
  check_alive();
  if (tracing_) throw TraceError(path + ": a waveform is being written already");
  master_->start_trace({path, now_, kNever});
  use_model();
  tracing_ = part_ = true;
  set_probes(&Simulator::on_probe);
}

bool Simulator::stop_trace() {
  if (!part_) return false;
  tracing_ = part_ = false;
  set_probes(nullptr);
  master_->stop_trace();
  use_model();
  return true;
}

}  // namespace mb4::sim
