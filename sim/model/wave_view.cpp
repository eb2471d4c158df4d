// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/wave_view.hpp"

#include <gtkwave/fstapi.h>

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
  std::string full;  // as GTKWave wants it
  bool vector = false;
  bool enumerated = false;  // the file names its values
};

// A group of the view: pins of the chip by the start of their name, and what lies inside the chip
// by a scope of its path.
struct Group {
  std::string_view name;
  bool open;  // unfolded when the view is loaded
  std::vector<std::string_view> pins;
  std::vector<std::string_view> scopes;
};

// In the order in which they stand in the view: first what a user of the chip sees.
const std::vector<Group>& groups() {
  static const std::vector<Group> list = {
      {"host", true, {"nres_i", "ncs_i", "ale_i", "db_", "eot_o", "ner_"}, {".u_spi.u_cmd."}},
      {"line", true, {"ma1_o", "sl1_i", "ma2_o", "sl2_i"}, {}},
      {"slaves", true, {"slaves_"}, {}},
      {"control", false, {"clk_i"}, {".u_control.", ".u_timebase."}},
      {"line engine", false, {"mo"}, {".gen_line[", ".u_line."}},
      {"registers", false, {}, {".u_regs."}},
      {"straps",
       false,
       {"osc_i", "cfgspi_i", "int_nmot_i", "nrd_rnw_i", "nwr_e_i", "getsens_i"},
       {}},
  };
  return list;
}

bool belongs(const Group& group, const Signal& signal) {
  const bool pin = signal.path.find('.') == std::string::npos;
  if (pin) {
    return std::any_of(group.pins.begin(), group.pins.end(),
                       [&](std::string_view word) { return signal.path.starts_with(word); });
  }
  // Of the inside only registers and outputs; the rest follows from them and is in the file.
  const std::string name = signal.path.substr(0, signal.path.find('[', signal.path.rfind('.')));
  if (!name.ends_with("_q") && !name.ends_with("_o")) return false;
  for (const std::string_view detail : {"_sync.", "sync.", ".u_ram."}) {
    if (signal.path.find(detail) != std::string::npos) return false;
  }
  return std::any_of(group.scopes.begin(), group.scopes.end(), [&](std::string_view word) {
    return signal.path.find(word) != std::string::npos;
  });
}

struct CloseReader {
  void operator()(void* reader) const { fstReaderClose(reader); }
};

struct Waveform {
  std::vector<Signal> signals;
  std::uint64_t begin = 0;  // ps
  std::uint64_t end = 0;
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
      // Without a name it refers to a table; the signal follows.
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
      signal.vector = entry->u.var.length > 1;
      // Verilator lists the ports of the top above it once more.
      if (scopes.size() > 1) signals.push_back(std::move(signal));
    }
  }
  return waveform;
}

void write_signal(std::ostream& out, const Signal& signal) {
  // Flags of GTKWave: right justified, with hexadecimal or binary digits, or the names of an enum.
  const char* format = signal.enumerated ? "@100000028\n" : signal.vector ? "@22\n" : "@28\n";
  out << format << signal.full << '\n';
}

}  // namespace

void write_wave_view(const std::string& fst_path, const std::string& view_path,
                     std::optional<Time> marker) {
  constexpr double kWindowPs = 150e6;    // configuration and the first frames of a usual scenario
  constexpr double kWindowPixels = 900;  // of an ordinary screen
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
  for (const Group& group : groups()) {
    out << (group.open ? "@800200\n-" : "@c00200\n-") << group.name << '\n';
    for (const Signal& signal : waveform.signals) {
      if (belongs(group, signal)) write_signal(out, signal);
    }
    out << (group.open ? "@1000200\n-" : "@1401200\n-") << group.name << '\n';
  }
  out.close();
  if (!out) throw std::runtime_error(view_path + ": cannot write");
}

}  // namespace mb4::sim
