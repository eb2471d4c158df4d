// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// [master] type = "dsl-model": a master of DSL for simulation only, without RTL,
// registers or a bus. A program gets at it as a host of the name "none".
#ifndef MB4SIM_DSL_MODEL_DSL_MASTER_HPP_
#define MB4SIM_DSL_MODEL_DSL_MASTER_HPP_

#include <deque>
#include <optional>

#include "sim/hosts/host_pins.hpp"
#include "sim/masters/dsl_model/dsl_quirks.hpp"
#include "sim/masters/dsl_model/link_model.hpp"
#include "sim/masters/master.hpp"

namespace mb4::sim {

extern const Master kDslModelMaster;

namespace dsl_model {

// Keeps the frames of the master until the program takes them, oldest first.
class LinkHost final : public HostModel, public LinkListener {
 public:
  static constexpr std::size_t kKept = 1024;

  explicit LinkHost(LinkModel& model) : model_(model) { model.link().set_listener(this); }

  void answered(const LinkFrame& frame) override {
    if (frames_.size() == kKept) frames_.pop_front();
    frames_.push_back(frame);
  }
  bool any() const { return !frames_.empty(); }
  std::optional<LinkFrame> take();
  LinkModel& model() { return model_; }

 private:
  LinkModel& model_;
  std::deque<LinkFrame> frames_;
};

}  // namespace dsl_model
}  // namespace mb4::sim

#endif  // MB4SIM_DSL_MODEL_DSL_MASTER_HPP_
