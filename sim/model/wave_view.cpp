// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "wave_view.hpp"

#if __has_include(<gtkwave/fstapi.h>)
#include <gtkwave/fstapi.h>
#define MB4_FST_READER
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mb4::sim {
namespace {

struct Signal {
  std::string path;  // below the top module
  std::string full;  // name for GTKWave
  unsigned bits = 1;
  bool vector = false;
  bool enumerated = false;  // the file has names for its values
};

bool belongs(const WaveGroup& group, const Signal& signal) {
  // Inside the chip the view has registers and outputs only. The other signals follow from them and
  // are in the file.
  const std::string name = signal.path.substr(0, signal.path.find('[', signal.path.rfind('.')));
  const bool member = name.find("_q.") != std::string::npos;  // of a register
  if (!member && !name.ends_with("_q") && !name.ends_with("_o")) return false;
  for (const std::string_view detail : {"_sync.", "sync.", ".u_ram."}) {
    if (signal.path.find(detail) != std::string::npos) return false;
  }
  return std::any_of(group.scopes.begin(), group.scopes.end(), [&](std::string_view word) {
    return signal.path.find(word) != std::string::npos;
  });
}

struct Waveform {
  std::vector<Signal> signals;
  std::uint64_t begin = 0;  // ps
  std::uint64_t end = 0;
};

#ifdef MB4_FST_READER
struct CloseReader {
  void operator()(void* reader) const { fstReaderClose(reader); }
};

Waveform read_waveform(const std::string& fst_path) {
  const std::unique_ptr<void, CloseReader> reader(fstReaderOpen(fst_path.c_str()));
  if (reader == nullptr) throw std::runtime_error(fst_path + ": cannot read the waveform");
  Waveform waveform;
  waveform.begin = fstReaderGetStartTime(reader.get());
  waveform.end = fstReaderGetEndTime(reader.get());
  std::vector<Signal>& signals = waveform.signals;
  std::vector<std::string> scopes;
  bool enumerated = false;
  while (const fstHier* entry = fstReaderIterateHier(reader.get())) {
    if (entry->htyp == FST_HT_SCOPE) {
      scopes.emplace_back(entry->u.scope.name);
    } else if (entry->htyp == FST_HT_UPSCOPE && !scopes.empty()) {
      scopes.pop_back();
    } else if (entry->htyp == FST_HT_ATTRBEGIN) {
      // An attribute without a name refers to a table, and the signal follows.
      enumerated = entry->u.attr.typ == FST_AT_MISC && entry->u.attr.subtype == FST_MT_ENUMTABLE &&
                   entry->u.attr.name_length == 0;
    } else if (entry->htyp == FST_HT_VAR) {
      Signal signal;
      signal.enumerated = std::exchange(enumerated, false);
      for (std::size_t i = 0; i < scopes.size(); ++i) {
        signal.full += scopes[i] + ".";
        if (i > 1) signal.path += scopes[i] + ".";
      }
      std::string name = entry->u.var.name;
      name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
      signal.full += name;
      signal.path += name;
      signal.bits = entry->u.var.length;
      signal.vector = signal.bits > 1;
      // Verilator lists the ports of the top a second time above it.
      if (scopes.size() > 1) signals.push_back(std::move(signal));
    }
  }
  return waveform;
}
#else
// This Verilator has no reader for FST files: the view has its groups, but no signals.
Waveform read_waveform(const std::string& /*fst_path*/) { return {}; }
#endif

// The file has a signal of this group.
bool has_signals(const WaveGroup& group, const std::vector<Signal>& signals) {
  return std::any_of(signals.begin(), signals.end(), [&](const Signal& signal) {
    return belongs(group, signal) ||
           std::any_of(group.pins.begin(), group.pins.end(), [&](const WavePin& pin) {
             return signal.path.substr(0, signal.path.find('[')) == pin.signal;
           });
  });
}

// Writes a pin. Writes nothing if the file has no such signal.
void write_pin(std::ostream& out, const WavePin& pin, const std::vector<Signal>& signals) {
  for (const Signal& signal : signals) {
    if (signal.path.substr(0, signal.path.find('[')) != pin.signal) continue;
    out << (signal.vector && pin.bit < 0 ? "@22\n" : "@28\n");
    if (!pin.name.empty()) out << "+{" << pin.name << "} ";
    // GTKWave counts the bits from the left.
    if (pin.bit >= 0) out << '(' << static_cast<int>(signal.bits) - 1 - pin.bit << ')';
    out << signal.full << '\n';
    return;
  }
}

void write_signal(std::ostream& out, const Signal& signal) {
  // Flags of GTKWave: right justified, with hexadecimal or binary digits or the names of an enum.
  const char* format = signal.enumerated ? "@100000028\n" : signal.vector ? "@22\n" : "@28\n";
  out << format << signal.full << '\n';
}

}  // namespace

void write_wave_view(const std::string& fst_path, const std::string& view_path,
                     std::span<const WaveGroup> groups, std::optional<Time> marker) {
  constexpr double kWindowPs = 150e6;    // configuration and the first frames of a usual scenario
  constexpr double kWindowPixels = 900;  // width on an ordinary screen
  constexpr double kZoomUnit = 200;      // GTKWave: a pixel is 2^zoom / 200 time units
  const Waveform waveform = read_waveform(fst_path);
  const double shown =
      std::clamp(static_cast<double>(waveform.end - waveform.begin), 1.0, kWindowPs);
  std::ofstream out(view_path);
  out << "[*] View of an openmb4 waveform\n"
      << "[dumpfile] \"" << std::filesystem::path(fst_path).filename().string() << "\"\n"
      << "[savefile] \"" << std::filesystem::path(view_path).filename().string() << "\"\n"
      << "[timestart] " << waveform.begin
      << "\n[size] 1400 900\n[signals_width] 230\n[sst_expanded] 0\n"
      << "*-" << std::log2(shown / kWindowPixels * kZoomUnit) << ' '
      << marker.value_or(waveform.begin);
  for (int letter = 0; letter < 26; ++letter) out << " -1";
  out << '\n';
  for (const WaveGroup& group : groups) {
    // A group for parts that this master does not have. Without a reader all groups are empty.
    if (!waveform.signals.empty() && !has_signals(group, waveform.signals)) continue;
    out << (group.open ? "@800200\n-" : "@c00200\n-") << group.name << '\n';
    for (const WavePin& pin : group.pins) write_pin(out, pin, waveform.signals);
    for (const Signal& signal : waveform.signals) {
      if (belongs(group, signal)) write_signal(out, signal);
    }
    out << (group.open ? "@1000200\n-" : "@1401200\n-") << group.name << '\n';
  }
  out.close();
  if (!out) throw std::runtime_error(view_path + ": cannot write");
}

}  // namespace mb4::sim
