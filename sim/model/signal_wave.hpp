// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a waveform of pins and registers of a Verilated model that has no tracing of its own. It
// reads the model's variables, so it can begin at any time and changes nothing.
#ifndef MB4SIM_MODEL_SIGNAL_WAVE_HPP_
#define MB4SIM_MODEL_SIGNAL_WAVE_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/core/trace_file.hpp"

namespace mb4::sim {

// Some bits of a variable (signal_list.py makes tables of them).
struct WaveSignal {
  std::string_view path;  // scopes and name, with dots between
  const void* variable;   // an unsigned integer, or an array of 32-bit words, the lowest first
  std::size_t size;       // of the variable, bytes
  unsigned lsb;
  unsigned bits;
  std::string_view values = {};  // names of the values from 0 on, with blanks between
};

class SignalWave {
 public:
  // `top` is the scope around the signals, scopes with dots between. Signals of one variable stand
  // one after the other. The variables live as long as the waveform. Throws TraceError if the file
  // cannot be written.
  SignalWave(const TraceFile& file, std::string_view top, const std::vector<WaveSignal>& signals);
  ~SignalWave();
  SignalWave(const SignalWave&) = delete;
  SignalWave& operator=(const SignalWave&) = delete;

  // Writes what has changed. Several calls can have the same time: their values appear one
  // picosecond after the other, because the file takes only one set of values per time.
  void show(Time now);
  void flush();

 private:
  class Writer;

  // A signal in the file.
  struct Part {
    std::uint32_t handle;
    unsigned lsb, bits;
  };
  // A variable, what it was when it was last written, and its signals.
  struct Variable {
    const unsigned char* value;
    std::size_t size;
    std::vector<unsigned char> before;
    std::vector<Part> parts;
  };

  std::unique_ptr<Writer> writer_;
  std::vector<Variable> variables_;
  Time from_;
  Time to_;
  Time next_ = 0;
  bool begun_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_SIGNAL_WAVE_HPP_
