// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/model/signal_wave.hpp"

#if defined(MB4_TRACE) && __has_include(<gtkwave/fstapi.h>)
#include <gtkwave/fstapi.h>
#define MB4_FST_WRITER
#endif

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "sim/core/trace_error.hpp"

namespace mb4::sim {
namespace {

// Bit `index` of a variable, as the host's byte order has it.
bool bit_of(const unsigned char* value, std::size_t size, unsigned index) {
  const auto read = [&](auto word) {
    std::memcpy(&word, value, sizeof word);
    return ((word >> index) & 1U) != 0;
  };
  if (size == 1) return read(std::uint8_t{});
  if (size == 2) return read(std::uint16_t{});
  if (size == 8) return read(std::uint64_t{});
  std::uint32_t word = 0;
  std::memcpy(&word, value + sizeof word * (index / 32), sizeof word);
  return ((word >> (index % 32)) & 1U) != 0;
}

#ifdef MB4_FST_WRITER
std::vector<std::string> split(std::string_view text, char between) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> parts;
  for (std::string part; std::getline(in, part, between);) parts.push_back(part);
  return parts;
}
#endif

}  // namespace

#ifdef MB4_FST_WRITER
class SignalWave::Writer {
 public:
  explicit Writer(const std::string& path) : file_(fstWriterCreate(path.c_str(), 1)) {
    if (file_ == nullptr) throw TraceError(path + ": cannot write the waveform");
    constexpr int kPicoseconds = -12;
    fstWriterSetTimescale(file_, kPicoseconds);
    fstWriterSetPackType(file_, FST_WR_PT_LZ4);
  }
  ~Writer() { fstWriterClose(file_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  std::uint32_t add(const std::string& top, const WaveSignal& signal) {
    std::vector<std::string> scopes = split(top + '.' + std::string(signal.path), '.');
    std::string name = std::move(scopes.back());
    scopes.pop_back();
    std::size_t same = 0;
    while (same < std::min(scopes.size(), scopes_.size()) && scopes[same] == scopes_[same]) ++same;
    for (std::size_t i = same; i < scopes_.size(); ++i) fstWriterSetUpscope(file_);
    for (std::size_t i = same; i < scopes.size(); ++i) {
      fstWriterSetScope(file_, FST_ST_VCD_MODULE, scopes[i].c_str(), nullptr);
    }
    scopes_ = std::move(scopes);
    if (signal.bits > 1) name += " [" + std::to_string(signal.bits - 1) + ":0]";
    if (!signal.values.empty()) fstWriterEmitEnumTableRef(file_, table(signal));
    return fstWriterCreateVar(file_, FST_VT_VCD_WIRE, FST_VD_IMPLICIT, signal.bits, name.c_str(),
                              0);
  }
  void time(Time now) { fstWriterEmitTimeChange(file_, now); }
  void value(std::uint32_t handle, const std::string& bits) {
    fstWriterEmitValueChange(file_, handle, bits.c_str());
  }
  void flush() { fstWriterFlushContext(file_); }

 private:
  // The names of the values, once for all signals that have the same.
  fstEnumHandle table(const WaveSignal& signal) {
    for (const auto& [values, handle] : tables_) {
      if (values == signal.values) return handle;
    }
    const std::vector<std::string> names = split(signal.values, ' ');
    std::vector<std::string> values;
    for (std::size_t number = 0; number < names.size(); ++number) {
      std::string bits;
      for (unsigned bit = signal.bits; bit-- > 0;) bits += ((number >> bit) & 1U) != 0 ? '1' : '0';
      values.push_back(bits);
    }
    std::vector<const char*> name_texts, value_texts;
    for (const std::string& name : names) name_texts.push_back(name.c_str());
    for (const std::string& value : values) value_texts.push_back(value.c_str());
    const std::string name = "enum" + std::to_string(tables_.size());
    const fstEnumHandle handle =
        fstWriterCreateEnumTable(file_, name.c_str(), static_cast<std::uint32_t>(names.size()),
                                 signal.bits, name_texts.data(), value_texts.data());
    tables_.emplace_back(signal.values, handle);
    return handle;
  }

  void* file_;
  std::vector<std::string> scopes_;
  std::vector<std::pair<std::string_view, fstEnumHandle>> tables_;
};
#else
// A Verilator without the writer of FST files, or a build without waveforms.
class SignalWave::Writer {
 public:
  explicit Writer(const std::string& path) {
    throw TraceError(path + ": this build writes no waveform");
  }
  std::uint32_t add(const std::string& /*top*/, const WaveSignal& /*signal*/) { return 0; }
  void time(Time /*now*/) {}
  void value(std::uint32_t /*handle*/, const std::string& /*bits*/) {}
  void flush() {}
};
#endif

SignalWave::SignalWave(const TraceFile& file, std::string_view top,
                       const std::vector<WaveSignal>& signals)
    : from_(file.from), to_(file.to) {
  // The FST writer removes any existing file of this name, also a device node.
  std::error_code ignored;
  const auto status = std::filesystem::status(file.path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw TraceError(file.path + ": cannot write the waveform: not a regular file");
  }
  if (!std::ofstream(file.path, std::ios::app)) {
    throw TraceError(file.path + ": cannot write the waveform");
  }
  writer_ = std::make_unique<Writer>(file.path);
  for (const WaveSignal& signal : signals) {
    const std::uint32_t handle = writer_->add(std::string(top), signal);
    const auto* const value = static_cast<const unsigned char*>(signal.variable);
    if (variables_.empty() || variables_.back().value != value) {
      variables_.push_back({value, signal.size, std::vector<unsigned char>(signal.size), {}});
    }
    variables_.back().parts.push_back({handle, signal.lsb, signal.bits});
  }
}

SignalWave::~SignalWave() = default;

void SignalWave::show(Time now) {
  if (now < from_ || now > to_) return;
  const bool all = !std::exchange(begun_, true);
  bool timed = false;
  std::string bits;
  for (Variable& variable : variables_) {
    if (!all && std::memcmp(variable.before.data(), variable.value, variable.size) == 0) continue;
    if (!std::exchange(timed, true)) {
      next_ = std::max(now, next_);
      writer_->time(next_++);
    }
    for (const Part& part : variable.parts) {
      bits.clear();
      bool changed = all;
      for (unsigned bit = part.lsb + part.bits; bit-- > part.lsb;) {
        const bool level = bit_of(variable.value, variable.size, bit);
        bits += level ? '1' : '0';
        changed = changed || level != bit_of(variable.before.data(), variable.size, bit);
      }
      if (changed) writer_->value(part.handle, bits);
    }
    std::memcpy(variable.before.data(), variable.value, variable.size);
  }
}

void SignalWave::flush() { writer_->flush(); }

}  // namespace mb4::sim
