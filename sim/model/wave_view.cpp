// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/wave_view.hpp"

#include <gtkwave/fstapi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mb4::sim {
namespace {

struct Signal {
  std::string path;  // below the top module
  std::string full;  // as GTKWave wants it
  bool vector = false;
};

// A group of the view: pins of the chip by the start of their name, and what lies inside the chip
// by a scope of its path.
struct Group {
  std::string_view name;
  std::vector<std::string_view> pins;
  std::vector<std::string_view> scopes;
};

// In the order in which they stand in the view.
const std::vector<Group>& groups() {
  static const std::vector<Group> list = {
      {"host",
       {"nres_i", "cfgspi_i", "int_nmot_i", "ncs_i", "ale_i", "nrd_rnw_i", "nwr_e_i", "db_",
        "getsens_i", "eot_o", "ner_"},
       {".u_spi.", ".u_host."}},
      {"registers", {}, {".u_regs."}},
      {"control", {"clk_i", "osc_i"}, {".u_sequencer.", ".u_timebase.", ".u_ctrl."}},
      {"line", {"ma", "mo", "sl1_i", "sl2_i"}, {".gen_line[", ".u_line."}},
      {"slaves", {"slaves_"}, {}},
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

std::vector<Signal> read_signals(const std::string& fst_path) {
  const std::unique_ptr<void, CloseReader> reader(fstReaderOpen(fst_path.c_str()));
  if (reader == nullptr) throw std::runtime_error(fst_path + ": cannot read the waveform");
  std::vector<Signal> signals;
  std::vector<std::string> scopes;
  while (const fstHier* entry = fstReaderIterateHier(reader.get())) {
    if (entry->htyp == FST_HT_SCOPE) {
      scopes.emplace_back(entry->u.scope.name);
    } else if (entry->htyp == FST_HT_UPSCOPE && !scopes.empty()) {
      scopes.pop_back();
    } else if (entry->htyp == FST_HT_VAR) {
      Signal signal;
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
  return signals;
}

void write_signal(std::ostream& out, const Signal& signal) {
  out << (signal.vector ? "@22\n" : "@28\n") << signal.full << '\n';
}

}  // namespace

void write_wave_view(const std::string& fst_path, const std::string& view_path) {
  const std::vector<Signal> signals = read_signals(fst_path);
  std::ofstream out(view_path);
  out << "[*] View of an openmb4 waveform\n"
      << "[dumpfile] \"" << std::filesystem::path(fst_path).filename().string() << "\"\n"
      << "[savefile] \"" << std::filesystem::path(view_path).filename().string() << "\"\n"
      << "[timestart] 0\n[sst_expanded] 1\n";
  for (const Group& group : groups()) {
    out << "@800200\n-" << group.name << '\n';
    for (const Signal& signal : signals) {
      if (belongs(group, signal)) write_signal(out, signal);
    }
    out << "@1000200\n-" << group.name << '\n';
  }
  out.close();
  if (!out) throw std::runtime_error(view_path + ": cannot write");
}

}  // namespace mb4::sim
