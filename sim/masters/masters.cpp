// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <iterator>
#include <vector>

#include "sim/masters/axi/axi_master.hpp"
#include "sim/masters/mb4/mb4_master.hpp"

namespace mb4::sim {
namespace {

// The only list of the masters of this library.
constexpr const Master* kMasters[] = {
    &kMb4Master,
#if MB4SIM_WITH_AXI
    &kAxiMaster,
#endif
};

#if MB4SIM_WITH_AXI
constexpr std::span<const LeftOut> kLeftOut;
#else
constexpr LeftOut kLeftOut[] = {{"axi", "-DMB4_AXI=ON"}};
#endif

// Those of the list, and those that the program has added.
std::vector<const Master*>& list() {
  static std::vector<const Master*> all(std::begin(kMasters), std::end(kMasters));
  return all;
}

}  // namespace

std::span<const Master* const> masters() { return list(); }

std::span<const LeftOut> masters_left_out() { return kLeftOut; }

void add_master(const Master& master) { list().push_back(&master); }

}  // namespace mb4::sim
