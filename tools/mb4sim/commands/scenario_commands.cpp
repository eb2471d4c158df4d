// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Options and help of the commands that run a scenario.
#include <algorithm>
#include <memory>
#include <string>

#include "command_line.hpp"
#include "commands/commands.hpp"
#include "worker_pool.hpp"

namespace mb4::tool {
namespace {

constexpr std::uint64_t kMaxFrames = 1'000'000'000;

void add_frames(CLI::App& command, std::uint64_t& frames, const char* description,
                std::uint64_t minimum) {
  command.add_option("--frames", frames, description)
      ->type_name("N")
      ->transform(whole_number(minimum, kMaxFrames));
}

void add_jobs(CLI::App& command, std::uint64_t& jobs) {
  constexpr std::uint64_t kMaxJobs = 256;
  jobs = std::min<std::uint64_t>(usable_cores(), kMaxJobs);
  command
      .add_option("--jobs", jobs,
                  "Processes that work at the same time (default: one for each processor)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxJobs));
}

void add_time(CLI::App& command, const char* option, std::optional<double>& us,
              const char* description) {
  command.add_option(option, us, description)->type_name("US")->check(microseconds());
}

void add_run(CLI::App& app, Action& action) {
  std::shared_ptr<RunOptions> options;
  CLI::App& run =
      *add_command(app, action, "run", "Configure the chip through the driver and read all slaves",
                   &run_command, options);
  add_scenario(run, options->scenario);
  add_frames(run, options->frames, "Frames to read (default 10)", 1);
  add_trace(run, options->trace);
  add_time(run, "--trace-from", options->trace_from_us, "Waveform from this time on");
  add_time(run, "--trace-to", options->trace_to_us, "Waveform up to this time");
  add_time(run, "--trace-error", options->trace_error_us,
           "Waveform of the first bad frame only, and so much before and behind it");
  add_output(run, "--csv", options->csv, "Also write the table as CSV");
  add_output(run, "--bus-log", options->bus_log, "Write what the driver sends and receives");
  add_output(run, "--spi", options->spi,
             "Send these lines, as 'spi' reads them, after the driver has configured the chip");
  run.add_flag("--json", options->json, "Print JSON instead of the table");
  add_seed(run, options->seed);
  run.footer(
      "Times (US) are microseconds since power-on, decimals allowed. View a waveform with: gtkwave "
      "run.gtkw\n"
      "Exit status 1: a frame was bad, that is, not delivered or not what the slave had sent.\n"
      "Example: mb4sim run examples/resolute-26.toml --frames 5 --trace run.fst");
}

void add_spi(CLI::App& app, Action& action) {
  std::shared_ptr<SpiOptions> options;
  CLI::App& spi = *add_command(app, action, "spi", "Exchange SPI frames given on standard input",
                               &spi_command, options);
  add_scenario(spi, options->scenario);
  spi.footer(
      "Each line of standard input is one of\n"
      "  02 ED 01       an SPI frame in hex; its MISO bytes are printed\n"
      "  +1000          let 1000 ns pass\n"
      "  pin GETSENS 1  set a pin\n"
      "  # comment\n"
      "Example: echo '03 EA 00 00' | mb4sim spi examples/resolute-26.toml");
}

void add_sweep(CLI::App& app, Action& action) {
  std::shared_ptr<SweepOptions> options;
  CLI::App& sweep =
      *add_command(app, action, "sweep",
                   "Count bad frames over line delay, jitter and frequency of MA (eye margin)",
                   &sweep_command, options);
  add_scenario(sweep, options->scenario);
  const auto add_list = [&](const char* name, std::string& list, const char* description) {
    sweep.add_option(name, list, description)->type_name("LIST");
  };
  add_list("--delays", options->delays,
           "Round-trip delays in ns, on all channels (default 0:399:19)");
  add_list("--jitters", options->jitters,
           "Jitter of SL in % of T_MA, on dsl of a bit, peak to peak (default 0:50:5)");
  add_list("--skews", options->skews,
           "Duty distortion of SL in % of T_MA: falling edges later, negative: rising edges later "
           "(default: as the scenario says)");
  add_list("--freqs", options->freqs,
           "Codes of the frequency of MA: FREQS, on biss_axi MA_DIVIDER; on dsl rules SAMPLE; "
           "or all (default: as the scenario says)");
  add_frames(sweep, options->frames, "Frames at each point (default 20)", 1);
  add_output(sweep, "--csv", options->csv, "Also write one line a point");
  add_output(sweep, "--svg", options->svg, "Also draw the eye margin (.png: by rsvg-convert)",
             "F.svg");
  add_jobs(sweep, options->jobs);
  sweep.add_flag("--json", options->json, "Print JSON instead of the tables");
  add_seed(sweep, options->seed);
  sweep.footer(
      "LIST is A, A,B,C or FROM:TO:STEP. The rest of the cable is as the scenario says. Exit "
      "status 1 if a word was bad with jitter up to 25 % (I305), on dsl up to 12, 35, 50 % "
      "by "
      "SAMPLE.\n"
      "Example: mb4sim sweep examples/resolute-26.toml --jitters 0:60:5 --freqs 0,3 --svg eye.svg");
}

void add_watch(CLI::App& app, Action& action) {
  constexpr std::uint64_t kSlowest = 60'000;
  std::shared_ptr<WatchOptions> options;
  CLI::App& watch = *add_command(app, action, "watch", "Show the positions until a key is pressed",
                                 &watch_command, options);
  add_scenario(watch, options->scenario);
  watch.add_option("--every", options->milliseconds, "Time from frame to frame (default 100 ms)")
      ->type_name("MS")
      ->transform(whole_number(1, kSlowest));
  add_seed(watch, options->seed);
  watch.footer("Exit status 1: a frame was bad.\nExample: mb4sim watch examples/ramp-sensor.toml");
}

void add_check(CLI::App& app, Action& action) {
  std::shared_ptr<CheckOptions> options;
  CLI::App& check = *add_command(app, action, "check", "Say whether scenarios can be run",
                                 &check_command, options);
  check.add_option("scenarios", options->scenarios, "Scenario files (TOML)")
      ->required()
      ->type_name("SCENARIO")
      ->check(file_name());
  check.footer(
      "Prints 'ok' for each file that run accepts, else what is wrong. Nothing is simulated.\n"
      "Example: mb4sim check examples/resolute-26.toml");
}

void add_regs(CLI::App& app, Action& action) {
  std::shared_ptr<RegsOptions> options;
  CLI::App& regs = *add_command(app, action, "regs", "Print the chip's registers, decoded",
                                &regs_command, options);
  add_scenario(regs, options->scenario);
  add_frames(regs, options->frames, "Frames to read before (default 0)", 0);
  regs.add_flag("--reset", options->reset, "As after reset, without configuring the chip")
      ->excludes("--frames");
  regs.add_option("names", options->names, "Only fields with one of these words in their name")
      ->type_name("NAME");
  regs.add_flag("--all", options->all, "Also what is as after reset");
  regs.add_flag("--json", options->json, "Print JSON instead of the table");
  regs.footer(
      "A field that is as after reset is left out, unless it is named. Frequencies follow from the "
      "clock.\n"
      "Examples: mb4sim regs examples/resolute-26.toml --frames 1\n"
      "  mb4sim regs examples/resolute-26.toml FREQ CFGCH");
}

void add_scan(CLI::App& app, Action& action) {
  std::shared_ptr<ScanOptions> options;
  CLI::App& scan = *add_command(app, action, "scan", "Ask a bus who is there, through the driver",
                                &scan_command, options);
  add_scenario(scan, options->scenario);
  scan.add_flag("--eds", options->eds, "Also read the electronic data sheets (EDS)");
  scan.add_flag("--json", options->json, "Print JSON instead of the table");
  scan.footer(
      "Each channel is asked by a chip that knows nothing of its slaves. BiSS C only; slaves "
      "without "
      "control communication do not answer. IDs count from the far end: ID 0 is the slave farthest "
      "from SL.\n"
      "With a DSL master: the resources of the encoder, read by messages.\n"
      "Examples: mb4sim scan examples/control-bus.toml --eds\n"
      "  mb4sim scan examples/dsl/messages.toml");
}

void add_regress(CLI::App& app, Action& action) {
  std::shared_ptr<RegressOptions> options;
  CLI::App& regress = *add_command(app, action, "regress", "Run scenarios with many seeds",
                                   &regress_command, options);
  regress
      .add_option("scenarios", options->scenarios,
                  "Scenario files (TOML); with --merge outputs of shards")
      ->required()
      ->type_name("SCENARIO")
      ->check(file_name());
  add_frames(regress, options->frames, "Frames of each run (default 100)", 1);
  regress
      .add_option("--seeds", options->seeds,
                  "Runs of each scenario, each with its own seed (default 1)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxFrames));
  regress.add_option("--first-seed", options->first_seed, "Seed of the first of them (default 1)")
      ->type_name("S")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  add_jobs(regress, options->jobs);
  regress
      .add_option("--shard", options->shard, "Only part K of N parts; the output is for --merge")
      ->type_name("K/N")
      ->check(file_name());
  CLI::Option* const merge = regress.add_flag(
      "--merge", options->merge, "Print what the shards have found that the files hold");
  for (const char* option : {"--frames", "--seeds", "--first-seed", "--jobs", "--shard"}) {
    regress.get_option(option)->excludes(merge);
  }
  regress
      .add_option("--cover", options->cover_path,
                  "Write how often each value of a field met each kind of frame")
      ->type_name("FILE")
      ->check(file_name());
  add_output(regress, "--junit", options->junit, "Also write the runs as JUnit XML", "F.xml");
  regress.add_flag("--json", options->json, "Print JSON instead of the table")->excludes("--shard");
  regress.footer(
      "The output does not depend on --jobs. Look at a failed run with: mb4sim run SCENARIO --seed "
      "S --frames N\n"
      "Examples: mb4sim regress examples/resolute-26.toml examples/two-channels.toml --seeds 20\n"
      "  mb4sim regress examples/resolute-26.toml --seeds 20 --shard 1/2 > 1.shard\n"
      "  mb4sim regress --merge *.shard");
}

}  // namespace

void add_scenario_commands(CLI::App& app, Action& action) {
  add_run(app, action);
  add_watch(app, action);
  add_check(app, action);
  add_spi(app, action);
  add_regs(app, action);
  add_scan(app, action);
  add_sweep(app, action);
  add_regress(app, action);
}

}  // namespace mb4::tool
