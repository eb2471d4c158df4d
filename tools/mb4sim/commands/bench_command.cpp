// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "build_info.hpp"
#include "commands/commands.hpp"
#include "report/exit_status.hpp"
#include "report/messages.hpp"
#include "sim/model/whole_models.hpp"
#include "workload.hpp"

namespace mb4::tool {
namespace {

constexpr sim::Time kSlice = 1000 * sim::kPsPerUs;  // simulated between two looks at the clock

// Processor time of this thread: other programs on the machine do not count.
double cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const auto begin = line.find_first_not_of(" \t:", std::string_view("model name").size());
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown processor";
}

struct Rate {
  const WorkloadInfo* workload = nullptr;
  double median = 0;  // clocks per second of processor time
  double slowest = 0;
  double fastest = 0;
  double real_time = 0;  // simulated time by processor time, of the median
  WorkCount work;        // of all repeats
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

Rate measure(const WorkloadInfo& info, const BenchOptions& options) {
  const std::unique_ptr<Workload> workload = info.make();
  workload->run(kSlice);  // fills caches and branch predictors
  std::vector<double> rates;
  std::vector<double> real_times;
  for (std::uint64_t repeat = 0; repeat < options.repeats; ++repeat) {
    const WorkCount before = workload->count();
    const double begin = cpu_seconds();
    double used = 0;
    do {
      workload->run(kSlice);
      used = cpu_seconds() - begin;
    } while (used * 1000 < static_cast<double>(options.milliseconds) || used <= 0);
    const WorkCount after = workload->count();
    rates.push_back(static_cast<double>(after.clocks - before.clocks) / used);
    real_times.push_back(sim::to_us(after.time - before.time) * 1e-6 / used);
  }
  Rate rate;
  rate.workload = &info;
  rate.median = median(rates);
  rate.real_time = median(real_times);
  const auto [slowest, fastest] = std::minmax_element(rates.begin(), rates.end());
  rate.slowest = *slowest;
  rate.fastest = *fastest;
  rate.work = workload->count();
  return rate;
}

// "AD" or "a,d"; empty: all.
std::vector<const WorkloadInfo*> chosen(const std::string& letters) {
  std::vector<const WorkloadInfo*> list;
  for (const WorkloadInfo& info : workloads()) {
    if (letters.empty()) list.push_back(&info);
  }
  for (const char c : letters) {
    if (c == ',') continue;
    const int letter = std::toupper(static_cast<unsigned char>(c));
    const auto found =
        std::find_if(workloads().begin(), workloads().end(),
                     [&](const WorkloadInfo& info) { return info.letter == letter; });
    if (found == workloads().end()) {
      throw UseError(fmt::format("--workload: there is no workload '{}', only {} to {}", c,
                                 workloads().front().letter, workloads().back().letter));
    }
    list.push_back(&*found);
  }
  if (list.empty()) throw UseError("--workload: names no workload");
  return list;
}

constexpr const char* kBenchRow = "{:<1}  {:<58}  {:>9}  {:>15}  {:>7}  {:>9}\n";

void print_row(const Rate& rate) {
  fmt::print(kBenchRow, rate.workload->letter, rate.workload->description,
             fmt::format("{:.2f} M", rate.median / 1e6),
             fmt::format("{:.2f}..{:.2f}", rate.slowest / 1e6, rate.fastest / 1e6),
             fmt::format("{:.1f}", 1e9 / rate.median), fmt::format("{:.2f} x", rate.real_time));
  std::fflush(stdout);
}

void print_json(const Rate& rate, bool last) {
  fmt::print(
      "  {{\"workload\": \"{}\", \"description\": {}, \"clk_per_s\": {:.0f}, \"slowest\": {:.0f}, "
      "\"fastest\": {:.0f}, \"real_time\": {:.4f}, \"clocks\": {}, \"frames\": {}, \"accesses\": "
      "{}, \"spi_bytes\": {}}}{}\n",
      rate.workload->letter, json_text(rate.workload->description), rate.median, rate.slowest,
      rate.fastest, rate.real_time, rate.work.clocks, rate.work.frames, rate.work.accesses,
      rate.work.spi_bytes, last ? "" : ",");
}

}  // namespace

int bench_command(const BenchOptions& options) {
  const auto list = chosen(options.workloads);
  const std::string machine =
      fmt::format("{}, {} threads", processor(), std::thread::hardware_concurrency());
  if (options.json) {
    fmt::print(
        "{{\"machine\": {}, \"compiler\": {}, \"flags\": {}, \"verilator\": {}, \"repeats\": {}, "
        "\"rates\": [\n",
        json_text(machine), json_text(build::kCompiler), json_text(build::kFlags),
        json_text(build::kVerilator), options.repeats);
  } else {
    fmt::print("machine   {}\ncompiler  {}, flags {}\nmodel     {}\n", machine, build::kCompiler,
               build::kFlags, build::kVerilator);
    for (const std::string_view name : sim::whole_models()) {
      fmt::print("note      {} runs whole, at a third of its speed or less\n", name);
    }
    fmt::print("clk/s     system clocks simulated in a second of processor time on one core, ");
    fmt::print("median of {}, each {} ms or more\n\n", options.repeats, options.milliseconds);
    fmt::print(kBenchRow, "", "workload", "clk/s", "range, M", "ns/clk", "real time");
  }
  for (const WorkloadInfo* info : list) {
    const Rate rate = measure(*info, options);
    if (options.json) {
      print_json(rate, info == list.back());
    } else {
      print_row(rate);
    }
  }
  if (options.json) fmt::print("]}}\n");
  return kGood;
}

}  // namespace mb4::tool
