// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One of the three edges in parts, or several that are the same: the build compiles this file with
// a header of model_parts.py, with its namespace MB4_EDGES, and with the names of those that it is
// to be: MB4_ONE_LINE, MB4_BOTH_LINES, MB4_SLOW_MA.
//
// The header relies on how Verilator 5.006 (Debian 12) writes a model.
#include "chip_edges.hpp"

#include <Vmb4_chip.h>
#include <Vmb4_chip___024root.h>

// Some packages of Verilator leave this number empty.
#if VERILATOR_VERSION_INTEGER + 0 == 5006000
#include <Vmb4_chip_edge.hpp>
#else
#define MODEL_RUNS_WHOLE
#endif
#ifdef MODEL_RUNS_WHOLE
#include "sim/model/whole_models.hpp"
#endif

namespace mb4::sim {
namespace {

#ifdef MODEL_RUNS_WHOLE

#ifdef MB4_ONE_LINE
const WholeModel kChipIsWhole("iC-MB4");
#endif

std::unique_ptr<ChipEdges> make() { return nullptr; }

#else

class Edges final : public ChipEdges {
 public:
  void all(const Root& root) override { kept_.all(root); }
  void rise(Root& root) override { MB4_EDGES::rise(&root, kept_); }
  void fall(Root& root) override { MB4_EDGES::fall(&root, kept_); }
  bool host(Root& root) override { return MB4_EDGES::host(&root, kept_); }
  void sl(Root& root) override {
    MB4_EDGES::follow_sl(&root, kept_);
    MB4_EDGES::sl_has_changed(kept_);
  }
  void time_passed() override { MB4_EDGES::time_has_changed(kept_); }

 private:
  MB4_EDGES::Kept kept_;
};

std::unique_ptr<ChipEdges> make() { return std::make_unique<Edges>(); }

#endif

}  // namespace

#ifdef MB4_ONE_LINE
std::unique_ptr<ChipEdges> edges_of_one_line() { return make(); }
#endif
#ifdef MB4_BOTH_LINES
std::unique_ptr<ChipEdges> edges_of_both_lines() { return make(); }
#endif
#ifdef MB4_SLOW_MA
std::unique_ptr<ChipEdges> edges_of_slow_ma() { return make(); }
#endif

}  // namespace mb4::sim
