// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model with a waveform file.
#include <Vmb4_chip_trace.h>
#include <Vmb4_chip_trace___024root.h>
#include <verilated_fst_c.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "plain_steps.hpp"
#include "sim/core/trace_error.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  // public.vlt makes this signal visible.
  static bool osc_selected(const Vmb4_chip_trace& model) {
    return model.rootp->mb4sim_trace_top__DOT__u_chip__DOT__clkeni != 0;
  }
  static bool clk(const Vmb4_chip_trace& model) {
    return model.rootp->mb4sim_trace_top__DOT__u_chip__DOT__clk != 0;
  }
  static bool paired(const Vmb4_chip_trace& model) {
    return model.rootp->mb4sim_trace_top__DOT__u_chip__DOT__paired != 0;
  }
  static unsigned half_clocks(const Vmb4_chip_trace& model) {
    return model.rootp
        ->mb4sim_trace_top__DOT__u_chip__DOT__u_engine__DOT__u_lines__DOT__u_timebase__DOT__len_q;
  }
};

class FstTrace {
 public:
  FstTrace() = default;
  FstTrace(const FstTrace&) = delete;
  FstTrace& operator=(const FstTrace&) = delete;
  ~FstTrace() {
    if (file_ != nullptr) file_->close();
  }

  template <typename Model>
  void open(VerilatedContext& /*context*/, Model& model, const TraceFile& trace) {
    constexpr int kAllLevels = 99;
    // The FST writer removes any existing file of this name, also a device node.
    std::error_code ignored;
    const std::string& path = trace.path;
    from_ = trace.from;
    to_ = trace.to;
    const auto status = std::filesystem::status(path, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
      throw TraceError(path + ": cannot write the waveform: not a regular file");
    }
    file_ = std::make_unique<VerilatedFstC>();
    model.trace(file_.get(), kAllLevels);
    file_->open(path.c_str());
    if (!file_->isOpen()) throw TraceError(path + ": cannot write the waveform");
  }
  // Several evaluations can have the same time, for example if a slave answers without delay. The
  // file takes only one set of values per time. So they appear one picosecond after the other.
  void dump(Time now) {
    if (now < from_ || now > to_) return;
    next_ = std::max(now, next_);
    file_->dump(next_++);
  }
  void flush() {
    if (file_ != nullptr) file_->flush();
  }

 private:
  std::unique_ptr<VerilatedFstC> file_;
  Time next_ = 0;
  Time from_ = 0;
  Time to_ = kNever;
};

}  // namespace

std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, std::uint64_t seed,
                                            const TraceFile& trace) {
  using Chip = VerilatedChip<Vmb4_chip_trace, FstTrace, Inside, PlainSteps<Vmb4_chip_trace>>;
  return std::make_unique<Chip>(config, seed, trace);
}

}  // namespace mb4::sim
