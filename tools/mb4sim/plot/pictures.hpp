// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The pictures of what is on a line, by the protocol of its devices. pictures.cpp holds the list of
// those that come with the command; a program adds its own.
#ifndef MB4SIM_TOOL_PICTURES_HPP_
#define MB4SIM_TOOL_PICTURES_HPP_

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "plot/timing_svg.hpp"
#include "plot/wave.hpp"
#include "sim/lines/line_kind.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

struct PictureRequest {
  unsigned frame = 1;    // counted from 1
  bool control = false;  // of a control frame, or of a message
  std::string scenario;  // its name, for messages
  std::string title;     // empty: made from the above
};

struct Picture {
  Diagram diagram;
  bool good = false;  // what is on the line is complete, and every check of it is right
};

// A recorded signal. The number of the channel follows the name.
struct Signal {
  std::string_view name;
  const Wave* wave;
};

// Records a line as long as it lives.
class LinePicture {
 public:
  LinePicture() = default;
  LinePicture(const LinePicture&) = delete;
  LinePicture& operator=(const LinePicture&) = delete;
  virtual ~LinePicture() = default;

  // Lets time pass until the last frame is over.
  virtual void finish(sim::Simulator& simulator) = 0;
  // Throws UseError if the line did not have what is asked for.
  virtual Picture draw(const PictureRequest& request, sim::Time now) const = 0;
  // For a VCD file.
  virtual std::vector<Signal> signals() const = 0;
};

struct PictureDecoder {
  std::string_view protocol;  // LineProtocol::key
  const sim::LineKind* line;  // that it can record
  // The simulator and the channel, one of its scenario, outlive the picture.
  std::unique_ptr<LinePicture> (*record)(sim::Simulator& simulator,
                                         const sim::ChannelConfig& channel);
};

// `decoder` must live on.
void add_picture(const PictureDecoder& decoder);

// Null if there is no picture of the protocol, or none on lines of the master's kind.
const PictureDecoder* picture_of(const sim::Scenario& scenario, const sim::ChannelConfig& channel);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_PICTURES_HPP_
