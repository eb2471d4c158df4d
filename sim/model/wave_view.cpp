// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/wave_view.hpp"

#include <gtkwave/fstapi.h>

#include <algorithm>
#include <array>
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
  std::string path;   // without the leading TOP and the name of the top
  std::string full;   // as GTKWave wants it
  bool vector = false;
};

struct Group {
  const char* name;
  // A signal belongs to the first group that has a word which occurs in its path.
  std::vector<std::string_view> words;
};

const std::array<Group, 5>& groups() {
  static const std::array<Group, 5> list = {{
      {"slaves", {"slaves_"}},
      {"host", {"nres_i", "ncs_i", "ale_i", "nrd_rnw_i", "nwr_e_i", "db_", "cfgspi", "int_nmot",
                "getsens", "eot_o", "ner_", "u_spi", "u_host"}},
      {"line", {"ma1_o", "ma2_o", "mo1_o", "mo2_o", "sl1_i", "sl2_i", "u_channel", "u_ch",
                "u_line", "u_timebase", "u_frame", "u_rx"}},
      {"control", {"u_seq", "u_ctrl", "u_init", "u_frame_timer", "u_command", "u_reg_access",
                   "u_word_list", "u_freqs", "clk_i", "osc_i"}},
      {"registers", {"u_cfg", "u_instr", "u_scd", "u_svalid", "u_bank", "u_rdata", "u_status",
                     "u_regs", "u_ram"}},
  }};
  return list;
}

// Order in which the groups stand in the view.
constexpr std::array<std::string_view, 5> kOrder = {"host", "registers", "control", "line",
                                                    "slaves"};

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
      // The top repeats the ports of the chip; Verilator lists its own ports above the top again.
      if (scopes.size() > 1) signals.push_back(std::move(signal));
    }
  }
  return signals;
}

const Group* group_of(const Signal& signal) {
  for (const Group& group : groups()) {
    for (const std::string_view word : group.words) {
      if (signal.path.find(word) != std::string::npos) return &group;
    }
  }
  return nullptr;
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
  for (const std::string_view name : kOrder) {
    out << "@800200\n-" << name << '\n';
    for (const Signal& signal : signals) {
      const Group* group = group_of(signal);
      // The ports of the chip are those of the top: once is enough.
      const bool port_again = signal.path.starts_with("u_chip.") &&
                              signal.path.find('.') == signal.path.rfind('.');
      if (group != nullptr && group->name == name && !port_again) write_signal(out, signal);
    }
    out << "@1000200\n-" << name << '\n';
  }
  out.close();
  if (!out) throw std::runtime_error(view_path + ": cannot write");
}

}  // namespace mb4::sim
