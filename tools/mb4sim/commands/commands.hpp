// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands of mb4sim. Each returns an exit status and throws UseError, Interrupted,
// sim::ScenarioError, sim::TraceError or sim::ModelStopped.
#ifndef MB4SIM_TOOL_COMMANDS_HPP_
#define MB4SIM_TOOL_COMMANDS_HPP_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mb4::tool {

struct RunOptions {
  std::string scenario;
  std::uint64_t frames = 10;
  std::string trace;  // empty: none
  std::optional<double> trace_from_us;
  std::optional<double> trace_to_us;
  std::optional<double> trace_error_us;  // only around the first bad frame
  std::string csv;                       // empty: none
  std::string bus_log;                   // empty: none
  std::string spi;  // file of lines that the host sends before the first frame; empty: none
  bool json = false;
  std::optional<std::uint64_t> seed;
};
int run_command(const RunOptions& options);

struct SpiOptions {
  std::string scenario;
};
int spi_command(const SpiOptions& options);

struct RegsOptions {
  std::string scenario;
  std::vector<std::string> names;  // parts of names of fields or registers; empty: all
  bool all = false;                // also what is as after reset
  std::uint64_t frames = 0;
  bool reset = false;
  bool json = false;
};
int regs_command(const RegsOptions& options);

struct SweepOptions {
  std::string scenario;
  std::string delays = "0:399:19";  // ns, number_list()
  std::string jitters = "0:50:5";   // % of T_MA, peak to peak
  std::string skews;                // % of T_MA, empty: as the scenario says
  std::string freqs;                // codes, "all", or empty: as the scenario says
  std::uint64_t frames = 20;        // at each point
  std::string csv;                  // empty: none
  std::string svg;                  // empty: none
  std::uint64_t jobs = 1;
  bool json = false;
  std::optional<std::uint64_t> seed;
};
int sweep_command(const SweepOptions& options);

struct ScanOptions {
  std::string scenario;
  bool eds = false;
  bool json = false;
};
int scan_command(const ScanOptions& options);

struct RegressOptions {
  std::vector<std::string> scenarios;  // merge: outputs of shards
  std::uint64_t seeds = 1;
  std::uint64_t first_seed = 1;
  std::uint64_t frames = 100;
  std::uint64_t jobs = 1;
  std::string shard;       // "K/N"; empty: all runs
  bool merge = false;      // print what shards have found
  std::string cover_path;  // empty: no functional coverage
  std::string junit;       // empty: none
  bool json = false;
};
int regress_command(const RegressOptions& options);

struct WatchOptions {
  std::string scenario;
  std::uint64_t milliseconds = 100;  // between two frames
  std::optional<std::uint64_t> seed;
};
int watch_command(const WatchOptions& options);

struct CheckOptions {
  std::vector<std::string> scenarios;
};
int check_command(const CheckOptions& options);

struct PresetsOptions {
  std::string name;  // empty: all
  bool json = false;
};
int presets_command(const PresetsOptions& options);

struct BenchOptions {
  std::string workloads;  // letters; empty: all
  std::uint64_t repeats = 5;
  std::uint64_t milliseconds = 200;  // processor time of each repeat, at least
  bool json = false;
};
int bench_command(const BenchOptions& options);

struct SpidevOptions {
  std::string scenario;  // empty: one encoder
  std::string device = "/dev/spidev0.0";
  bool simulated_time = false;
  std::string library;  // empty: the one beside the command
  std::string trace;    // empty: none
  std::optional<std::uint64_t> seed;
  std::vector<std::string> program;  // with its arguments
};
int spidev_command(const SpidevOptions& options);

struct BridgeOptions {
  std::string scenario;
  std::string unix_path;  // this or `tcp`
  std::string tcp;
  bool once = false;
  bool wall = false;
  std::string trace;  // empty: none
  std::optional<std::uint64_t> seed;
};
int bridge_command(const BridgeOptions& options);

struct PlotOptions {
  std::string scenario;
  unsigned channel = 1;
  unsigned frame = 1;    // counted from 1
  unsigned id = 0;       // of the slave whose registers are meant
  std::string read;      // "ADDRESS[:COUNT]"
  std::string write;     // "ADDRESS:BYTE,..."
  std::string command;   // "CODE[:ID,...]"
  std::string resource;  // "ID[:OFFSET]"; all empty: a frame
  std::string title;     // empty: made from the above
  std::string svg;       // empty: standard output, unless there is another file
  std::string wavejson;  // empty: none
  std::string vcd;       // empty: none
  std::optional<std::uint64_t> seed;
};
int plot_command(const PlotOptions& options);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_COMMANDS_HPP_
