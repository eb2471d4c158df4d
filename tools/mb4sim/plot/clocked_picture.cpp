// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/clocked_picture.hpp"

#include <fmt/core.h>

#include "plot/control_diagram.hpp"
#include "plot/frame_diagram.hpp"
#include "plot/line_recording.hpp"
#include "report/exit_status.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"

namespace mb4::tool {
namespace {

constexpr std::size_t kMaxEdges = 1000;  // of a frame that can be drawn
constexpr sim::Time kLongestEnd = sim::kPsPerSecond;

class ClockedPicture final : public LinePicture {
 public:
  ClockedPicture(sim::Simulator& simulator, const sim::ChannelConfig& channel)
      : line_(*clocked(simulator.line(channel.number))), channel_(channel), recording_(line_) {}

  // Its slaves are idle again.
  void finish(sim::Simulator& simulator) override {
    simulator.run_while_waiting([&] { return line_.chain().idle() && line_.sl(); },
                                simulator.now() + kLongestEnd);
    simulator.advance(10 * sim::kPsPerUs);
  }
  Picture draw(const PictureRequest& request, sim::Time now) const override {
    return request.control ? control(request, now) : frame(request, now);
  }
  std::vector<Signal> signals() const override {
    return {{"MA", &recording_.ma()}, {"MO", &recording_.mo()}, {"SL", &recording_.sl()}};
  }

 private:
  Picture frame(const PictureRequest& request, sim::Time now) const;
  Picture control(const PictureRequest& request, sim::Time now) const;

  sim::ClockedLine& line_;
  const sim::ChannelConfig& channel_;
  LineRecording recording_;
};

Picture ClockedPicture::frame(const PictureRequest& request, sim::Time now) const {
  const std::vector<FrameTrace> frames = recording_.frames(now);
  if (frames.size() < request.frame) {
    throw UseError(fmt::format("{}: only {} frame(s) on channel {} have ended", request.scenario,
                               frames.size(), channel_.number));
  }
  const FrameTrace& trace = frames[request.frame - 1];
  if (trace.rising.size() > kMaxEdges) {
    throw UseError(fmt::format("frame {} has {} clocks, more than {} are not drawn", request.frame,
                               trace.rising.size(), kMaxEdges));
  }
  const DecodedFrame decoded = decode_frame(recording_, trace, channel_);
  const std::string title =
      request.title.empty() ? fmt::format("Frame {} of channel {}", request.frame, channel_.number)
                            : request.title;
  return {frame_diagram(recording_, decoded, channel_, title), decoded.good};
}

Picture ClockedPicture::control(const PictureRequest& request, sim::Time now) const {
  std::vector<ControlBits> bits;
  for (const FrameTrace& trace : recording_.frames(now)) {
    const DecodedFrame decoded = decode_frame(recording_, trace, channel_);
    bits.push_back({decoded.cdm, decoded.cds});
  }
  const ControlFrame frame = decode_control(bits);
  if (frame.slots == 0) {
    throw UseError(fmt::format("{}: there was no control frame on channel {}", request.scenario,
                               channel_.number));
  }
  const std::string title = request.title.empty()
                                ? fmt::format("Control frame of channel {}", channel_.number)
                                : request.title;
  return {control_diagram(bits, frame, title), frame.good};
}

std::unique_ptr<LinePicture> record(sim::Simulator& simulator, const sim::ChannelConfig& channel) {
  return std::make_unique<ClockedPicture>(simulator, channel);
}

}  // namespace

std::span<const PictureDecoder> clocked_pictures() {
  static constexpr PictureDecoder kAll[] = {{"biss-c", &sim::kClockedLines, record},
                                            {"biss-b", &sim::kClockedLines, record},
                                            {"ssi", &sim::kClockedLines, record}};
  return kAll;
}

}  // namespace mb4::tool
