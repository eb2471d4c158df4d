// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes the waveform of a Verilated model with tracing.
#ifndef MB4SIM_MODEL_FST_TRACE_HPP_
#define MB4SIM_MODEL_FST_TRACE_HPP_

#include <verilated_fst_c.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "sim/core/time.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/core/trace_file.hpp"

namespace mb4::sim {

class FstTrace {
 public:
  static constexpr bool kTraces = true;

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

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_FST_TRACE_HPP_
