// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "commands/commands.hpp"
#include "commands/run_outputs.hpp"
#include "interrupts.hpp"
#include "mb4sim/simulator.hpp"
#include "report/colour.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/frame_report.hpp"
#include "report/hint_lines.hpp"
#include "report/messages.hpp"
#include "report/output_file.hpp"
#include "report/progress.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/core/text_file.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

// Prints and writes what a session delivers.
class RunPrinter {
 public:
  RunPrinter(const RunOptions& options, Session& session, RunOutputs& outputs)
      : options_(options),
        outputs_(outputs),
        frames_(session.simulator().scenario(), session.columns()),
        progress_(options.frames) {}

  void begin(Session& session) {
    faults_.emplace(session.simulator().scenario(), session.simulator().faults());
    if (options_.json) {
      fmt::print("{}", frames_.json_header(options_.scenario, session.simulator().seed()));
    } else {
      fmt::print("{}", frames_.table_header());
    }
    if (outputs_.csv != nullptr) outputs_.csv->append(frames_.csv_header());
  }

  void frame(const SessionFrame& frame, Session& session) {
    faults_->add(frame, session);
    progress_.clear();
    if (!options_.json) fmt::print("{}", faults_->new_lines());
    for (std::size_t i = 0; i < session.slaves().size(); ++i) {
      const bool good = frames_.add(frame, session.slaves()[i].number, i).good();
      if (frame.kind(i) != SlaveOutcome::Kind::kRight) {
        missed_ |= std::uint64_t{1} << (session.slaves()[i].number - 1);
      }
      fmt::print("{}", options_.json ? frames_.json_row() : coloured(frames_.table_row(), good));
      if (outputs_.csv != nullptr) outputs_.csv->append(frames_.csv_row());
    }
    if (outputs_.bus_log != nullptr) outputs_.bus_log->append(session.take_bus_log());
    progress_.update(frame.number);
  }

  // Slaves with a bad word: Simulator::hints().
  std::uint64_t missed() const { return missed_; }

  // `error`: why the run ended early. Returns true if everything was good.
  bool end(const Session& session, const std::string& error = "") {
    progress_.clear();
    faults_->finish();
    const RunSummary summary = session.summary();
    if (options_.json) {
      std::string more = faults_->any() ? ", \"faults\": " + faults_->json() : "";
      if (!error.empty()) more += ", \"error\": " + json_text(error);
      fmt::print("{}", frames_.json_summary(summary, more));
    } else {
      fmt::print("{}{}{}", faults_->new_lines(), faults_->summary(),
                 frames_.table_summary(summary));
    }
    return frames_.bad() == 0 && faults_->ids_good();
  }

 private:
  const RunOptions& options_;
  RunOutputs& outputs_;
  FrameReport frames_;
  std::optional<FaultReport> faults_;
  std::uint64_t missed_ = 0;
  Progress progress_;
};

SessionOptions session_options(const RunOptions& options, const RunOutputs& outputs) {
  SessionOptions session;
  session.bus_log = outputs.bus_log != nullptr;
  session.simulator.seed = options.seed;
  if (!options.trace.empty() && !options.trace_error_us) {
    session.simulator.trace_path = outputs.trace.path();
    if (options.trace_from_us) session.simulator.trace_from = sim::from_us(*options.trace_from_us);
    if (options.trace_to_us) session.simulator.trace_to = sim::from_us(*options.trace_to_us);
  }
  return session;
}

// What the host does by hand before the first frame.
void send_lines(Session& session, const std::string& path) {
  std::istringstream lines(sim::read_text_file(path));
  unsigned number = 1;
  for (std::string line; std::getline(lines, line); ++number) {
    if (const std::string why = session.send(line); !why.empty()) {
      throw UseError(fmt::format("{}:{}: {}", path, number, why));
    }
  }
}

// Repeats the run until a little after its first bad frame, with a waveform around that frame.
void trace_around(const RunOptions& options, const sim::Scenario& scenario,
                  const Interrupts& interrupts, const RunOutputs& outputs,
                  const SessionFrame& bad) {
  const sim::Time margin = sim::from_us(*options.trace_error_us);
  SessionOptions around = session_options(options, outputs);
  around.bus_log = false;
  around.simulator.trace_path = outputs.trace.path();
  around.simulator.trace_from = bad.begin > margin ? bad.begin - margin : 0;
  around.simulator.trace_to = bad.end + margin;
  const std::unique_ptr<Session> session = support_of(scenario).open(scenario, around);
  if (!session->configure().empty()) return;
  if (!options.spi.empty()) send_lines(*session, options.spi);
  // The register accesses that faults need take time too, so they are repeated.
  FaultReport faults(session->simulator().scenario(), session->simulator().faults());
  for (std::uint64_t number = 1; number < bad.number; ++number) {
    interrupts.check();
    faults.add(session->read(number), *session);
  }
  session->read(bad.number);
  session->simulator().run_until(around.simulator.trace_to);
}

// Reads all frames; returns the first bad one. The output ends properly even if the run ends early.
std::optional<SessionFrame> read_frames(const RunOptions& options, const Interrupts& interrupts,
                                        Session& session, RunPrinter& printer, bool& good) {
  std::optional<SessionFrame> first_bad;
  printer.begin(session);
  try {
    for (std::uint64_t number = 1; number <= options.frames; ++number) {
      interrupts.check();
      SessionFrame frame = session.read(number);
      printer.frame(frame, session);
      if (!first_bad && frame.bad()) first_bad = std::move(frame);
    }
  } catch (const std::runtime_error& error) {  // sim::ModelStopped, Interrupted, UseError
    printer.end(session, error.what());
    throw;
  }
  good = printer.end(session);
  HintLines(options.json).print(hints_of_run(session.simulator(), printer.missed()));
  return first_bad;
}

}  // namespace

int run_command(const RunOptions& options) {
  const sim::Scenario scenario = open_scenario(options.scenario);
  const MasterSupport& support = support_of(scenario);
  support.check(scenario);
  // The scenario has been checked before the first file is opened.
  RunOutputs outputs = open_outputs(options, scenario);
  const Interrupts interrupts;
  std::optional<SessionFrame> first_bad;
  bool good = false;
  const bool traced = !options.trace.empty() && !options.trace_error_us;
  try {
    const std::unique_ptr<Session> session =
        support.open(scenario, session_options(options, outputs));
    if (const std::string why = session->configure(); !why.empty()) {
      const std::string error = fmt::format("{}: {}", support.not_begun, why);
      print_error(options.json, error, kBad);
      if (traced) session->simulator().flush_trace();
      outputs.csv.reset();
      outputs.bus_log.reset();
      if (options.json) {
        RunPrinter printer(options, *session, outputs);
        printer.begin(*session);
        printer.end(*session, error);
      }
    } else {
      if (!options.spi.empty()) send_lines(*session, options.spi);
      RunPrinter printer(options, *session, outputs);
      first_bad = read_frames(options, interrupts, *session, printer, good);
    }
  } catch (const sim::ModelStopped&) {
    // The waveform file is complete when the simulator has gone.
    if (traced) outputs.trace.write_view();
    throw;
  } catch (const Interrupted&) {
    if (traced) outputs.trace.write_view();
    throw;
  }
  if (traced) outputs.trace.write_view();
  if (options.trace_error_us) {
    if (first_bad) {
      trace_around(options, scenario, interrupts, outputs, *first_bad);
      outputs.trace.write_view(first_bad->begin);
      print_note(options.json, fmt::format("{} shows frame {}, the first bad one", options.trace,
                                           first_bad->number));
    } else {
      print_note(options.json, fmt::format("no bad frame, so {} was not written", options.trace));
    }
  }
  if (outputs.bus_log != nullptr) outputs.bus_log->commit();
  if (outputs.csv != nullptr) outputs.csv->commit();
  return good ? kGood : kBad;
}

}  // namespace mb4::tool
