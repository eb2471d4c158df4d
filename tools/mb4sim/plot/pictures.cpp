// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/pictures.hpp"

#include "plot/clocked_picture.hpp"
#if MB4SIM_WITH_DSL_MODEL
#include "plot/dsl_picture.hpp"
#endif
#include "sim/masters/master.hpp"

namespace mb4::tool {
namespace {

std::vector<const PictureDecoder*>& list() {
  static std::vector<const PictureDecoder*> all = [] {
    std::vector<const PictureDecoder*> own;
    for (const PictureDecoder& each : clocked_pictures()) own.push_back(&each);
#if MB4SIM_WITH_DSL_MODEL
    own.push_back(&kDslPicture);
#endif
    return own;
  }();
  return all;
}

}  // namespace

void add_picture(const PictureDecoder& decoder) { list().push_back(&decoder); }

const PictureDecoder* picture_of(const sim::Scenario& scenario, const sim::ChannelConfig& channel) {
  for (const PictureDecoder* each : list()) {
    if (each->protocol == channel.protocol().key && each->line == scenario.master->line)
      return each;
  }
  return nullptr;
}

}  // namespace mb4::tool
