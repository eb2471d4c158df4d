// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "masters/axi/axi_session.hpp"
#if MB4SIM_WITH_CLB
#include "masters/clb/clb_session.hpp"
#endif
#if MB4SIM_WITH_DSL
#include "masters/dsl/dsl_session.hpp"
#endif
#include "masters/mb4/mb4_session.hpp"
#if MB4SIM_WITH_PRU
#include "masters/pru/pru_session.hpp"
#endif
#include "sim/masters/master.hpp"

namespace mb4::tool {
namespace {

// The only list of the masters that the commands know.
constexpr const MasterSupport* kAll[] = {
    &kMb4Support,
#if MB4SIM_WITH_AXI
    &kAxiSupport,
#endif
#if MB4SIM_WITH_CLB
    &kClbSupport,
#endif
#if MB4SIM_WITH_PRU
    &kPruSupport,
#endif
#if MB4SIM_WITH_DSL
    &kDslSupport, &kDslModelSupport,
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

}  // namespace mb4::tool
