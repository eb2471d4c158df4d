// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells the end of every frame on the lines of a simulator, and if asked every edge; counts for
// each fault the frames that it touched. The line says what a frame is. The master tells its errors
// later: at its end of transmission, or when the next frame starts. The watch is the observer of
// each line and of the simulator.
#ifndef MB4SIM_FRAME_WATCH_HPP_
#define MB4SIM_FRAME_WATCH_HPP_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/core/time.hpp"

namespace mb4::sim {

// A frame that is over.
struct SeenFrame {
  unsigned channel = 0;
  LineFrame frame;
  bool fault = false;  // an injected fault lasted in it
};

// Frames that a fault touched.
struct FaultStory {
  std::uint64_t frames = 0;
  std::uint64_t error_low = 0;  // of these, with the pin for errors low after their end
};

class FrameWatch final : private PinObserver {
 public:
  using Callback = std::function<void(const SeenFrame& frame)>;
  using EdgeCallback = std::function<void(unsigned channel, unsigned place, Time now, bool level)>;

  // The simulator must outlive the watch, and must not run any more when the watch has gone.
  explicit FrameWatch(Simulator& simulator);
  ~FrameWatch();
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

  // `callback` is called for every frame. An empty callback is never called.
  void set_callback(Callback callback) { callback_ = std::move(callback); }
  // `callback` is called at once for the present level of every place, then for every change. An
  // empty callback is never called.
  void set_edges(EdgeCallback callback);
  // In the order of Simulator::faults().
  const std::vector<FaultStory>& stories();

 private:
  struct Channel final : LineObserver {
    Channel(FrameWatch& its_watch, unsigned its_number, Line& its_line)
        : watch(its_watch), number(its_number), line(its_line) {}
    void frame_begun() override { watch.take_error(); }
    void frame_over(const LineFrame& frame) override { watch.frame_over(*this, frame); }
    void edge(Time now, unsigned place, bool level) override {
      watch.edges_(number, place, now, level);
    }

    FrameWatch& watch;
    unsigned number;
    Line& line;
    std::size_t settled = 0;  // all faults before this one have ended before the running frame
  };

  void pin_changed(Pin pin, bool level) override;
  void take_error();
  void frame_over(Channel& channel, const LineFrame& frame);
  bool touched(Channel& channel, const LineFrame& frame);

  Simulator& simulator_;
  std::optional<Pin> error_;  // Master::error_pin, end_pin
  std::optional<Pin> end_;
  Callback callback_;
  EdgeCallback edges_;
  std::vector<std::unique_ptr<Channel>> channels_;
  std::vector<FaultStory> stories_;
  std::vector<std::size_t>
      waiting_;  // faults of frames after which the pin for errors has not been read
};

}  // namespace mb4::sim

#endif  // MB4SIM_FRAME_WATCH_HPP_
