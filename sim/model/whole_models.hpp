// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Models that the build could not take apart (sim/model/parts/README.md): each edge is Verilator's
// eval(), at a third of the speed or less, with the same results.
#ifndef MB4SIM_MODEL_WHOLE_MODELS_HPP_
#define MB4SIM_MODEL_WHOLE_MODELS_HPP_

#include <span>
#include <string_view>

namespace mb4::sim {

// An object in the file that makes such a model tells of it, as the program starts.
class WholeModel {
 public:
  // `name` must live on.
  explicit WholeModel(std::string_view name);
};

// Their names. None if all models that may run in parts do so.
std::span<const std::string_view> whole_models();

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_WHOLE_MODELS_HPP_
