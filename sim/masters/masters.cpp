// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <iterator>
#include <vector>

#include "sim/masters/axi/axi_master.hpp"
#if MB4SIM_WITH_CLB
#include "sim/masters/clb/clb_master.hpp"
#endif
#if MB4SIM_WITH_DSL
#include "sim/masters/dsl/dsl_rtl_master.hpp"
#endif
#if MB4SIM_WITH_DSL_MODEL
#include "sim/masters/dsl_model/dsl_master.hpp"
#endif
#include "sim/masters/mb4/mb4_master.hpp"
#if MB4SIM_WITH_PRU
#include "sim/masters/pru/pru_master.hpp"
#endif

namespace mb4::sim {
namespace {

// The only list of the masters of this library.
constexpr const Master* kMasters[] = {
    &kMb4Master,
#if MB4SIM_WITH_AXI
    &kAxiMaster,
#endif
#if MB4SIM_WITH_CLB
    &kClbMaster,
#endif
#if MB4SIM_WITH_PRU
    &kPruMaster,
#endif
#if MB4SIM_WITH_DSL
    &kDslMaster,
#endif
#if MB4SIM_WITH_DSL_MODEL
    &kDslModelMaster,
#endif
};

// Those of the list, and those that the program has added.
std::vector<const Master*>& list() {
  static std::vector<const Master*> all(std::begin(kMasters), std::end(kMasters));
  return all;
}

}  // namespace

std::span<const Master* const> masters() { return list(); }

std::span<const LeftOut> masters_left_out() {
  static const std::vector<LeftOut> all = [] {
    std::vector<LeftOut> missing;
    if (!MB4SIM_WITH_AXI) missing.push_back({"axi", "-DMB4_AXI=ON"});
    if (!MB4SIM_WITH_CLB) missing.push_back({"clb", "-DMB4_CLB=ON"});
    if (!MB4SIM_WITH_PRU) missing.push_back({"pru", "-DMB4_PRU=ON"});
    if (!MB4SIM_WITH_DSL) missing.push_back({"dsl", "-DMB4_DSL=ON"});
    if (!MB4SIM_WITH_DSL_MODEL) missing.push_back({"dsl-model", "-DMB4_DSL=ON"});
    return missing;
  }();
  return all;
}

void add_master(const Master& master) { list().push_back(&master); }

}  // namespace mb4::sim
