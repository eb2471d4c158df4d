// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "masters/axi/axi_session.hpp"
#if MB4SIM_WITH_DSL_MODEL
#include "masters/dsl_model/dsl_session.hpp"
#endif
#include "masters/mb4/mb4_session.hpp"
#include "report/exit_status.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/masters/master.hpp"

namespace mb4::tool {
namespace {

// The only list of the masters that the commands know.
constexpr const MasterSupport* kAll[] = {
    &kMb4Support,
#if MB4SIM_WITH_AXI
    &kAxiSupport,
#endif
#if MB4SIM_WITH_DSL_MODEL
    &kDslModelSupport,
#endif
};

}  // namespace

const MasterSupport& support_of(const sim::Scenario& scenario) {
  for (const MasterSupport* each : kAll) {
    if (each->type == scenario.master->type) return *each;
  }
  throw sim::ScenarioError(scenario.name, {}, "type",
                           fmt::format("mb4sim cannot configure \"{}\"", scenario.master->type));
}

void require_clocked(const sim::Scenario& scenario, std::string_view command) {
  if (scenario.master->line == &sim::kClockedLines) return;
  throw UseError(fmt::format(
      "{}: {} knows lines of the kind \"{}\" only, those of \"{}\" are \"{}\"", scenario.name,
      command, sim::kClockedLines.key, scenario.master->type, scenario.master->line->key));
}

}  // namespace mb4::tool
