// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The waveform of a Verilated master, with levels at its encoders.
#ifndef MB4SIM_MODEL_MODEL_WAVE_HPP_
#define MB4SIM_MODEL_MODEL_WAVE_HPP_

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "sim/core/trace_error.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/model/signal_wave.hpp"

namespace mb4::sim {

class ModelWave {
 public:
  // Levels at the encoders, bit n = line n.
  struct Probes {
    std::uint64_t arrived = ~std::uint64_t{0};
    std::uint64_t sent = ~std::uint64_t{0};
    std::uint64_t ready = ~std::uint64_t{0};
  };

  // From now on, with the signals of the encoders between pins and registers. Throws TraceError.
  void begin(const TraceFile& file, const char* title, std::vector<WaveSignal> signals,
             const std::vector<WaveSignal>& encoders) {
    if (signals.empty()) throw TraceError(file.path + ": this model writes no waveform");
    const auto registers = std::find_if(signals.begin(), signals.end(), [](const WaveSignal& one) {
      return one.path.ends_with("_q") || one.path.find('.') != std::string_view::npos;
    });
    signals.insert(registers, encoders.begin(), encoders.end());
    writer_ = std::make_unique<SignalWave>(file, title, signals);
    writer_->show(file.from);
  }
  void stop() { writer_.reset(); }
  bool on() const { return writer_ != nullptr; }
  void show(Time now) {
    if (on()) writer_->show(now);
  }
  void flush() {
    if (on()) writer_->flush();
  }
  void set_probes(Time now, const Probes& probes) {
    probes_ = probes;
    show(now);
  }
  const Probes& probes() const { return probes_; }
  // Those of the encoder of a master with one line. `arrived`: the signal's name.
  std::vector<WaveSignal> encoder(std::string_view arrived, std::string_view sent) const {
    return {{arrived, &probes_.arrived, sizeof probes_.arrived, 0, 1},
            {sent, &probes_.sent, sizeof probes_.sent, 0, 1},
            {"encoder_ready", &probes_.ready, sizeof probes_.ready, 0, 1}};
  }

 private:
  std::unique_ptr<SignalWave> writer_;
  Probes probes_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_MODEL_WAVE_HPP_
