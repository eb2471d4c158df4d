// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells the end of every frame on the lines of a simulator, and if asked every edge; counts for
// each fault the frames that it touched. A frame is over when MA has rested for 1.5 periods
// (MaMonitor). The master tells its errors later: at EOT = 1, or when the next frame starts. The
// watch takes the tap of each line, the simulator's observer, and for edges the probe of each line.
#ifndef MB4SIM_FRAME_WATCH_HPP_
#define MB4SIM_FRAME_WATCH_HPP_

#include <array>
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
  std::uint64_t number = 0;  // on its channel, from 1 on
  MaFrame ma;
  bool fault = false;  // an injected fault lasted in it
};

// Frames that a fault touched.
struct FaultStory {
  std::uint64_t frames = 0;
  std::uint64_t ner_low = 0;  // of these, with pin NER low after their end
};

// Where an edge is: at a pin of the master, or SLO of the slave next to SL, at its end of the
// cable.
enum class EdgePlace : unsigned { kMa, kMo, kSl, kSlo };
constexpr std::size_t kEdgePlaces = 4;

class FrameWatch final : private PinObserver {
 public:
  using Callback = std::function<void(const SeenFrame& frame)>;
  using EdgeCallback = std::function<void(unsigned channel, EdgePlace place, Time now, bool level)>;

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
  struct Channel {
    FrameWatch* watch;
    unsigned number;
    Line* line;
    std::uint64_t told = 0;   // frames that are over and told
    std::uint64_t begun = 0;  // frames that have begun
    Time due = kNever;        // the next look
    std::size_t settled = 0;  // all faults before this one have ended before the running frame
    std::array<bool, kEdgePlaces> levels{};  // that have been told
  };

  void pin_changed(Pin pin, bool level) override;
  void take_ner();
  static void on_edge(Time now, void* receiver, Line::Signal signal, bool level);
  static void on_probe(Time now, void* receiver);
  void tell(Channel& channel, EdgePlace place, Time now, bool level);
  void plan(Channel& channel);
  void look(Channel& channel);
  bool touched(Channel& channel, const MaFrame& frame);

  Simulator& simulator_;
  std::optional<Pin> ner_;
  std::optional<Pin> eot_;
  Callback callback_;
  EdgeCallback edges_;
  std::vector<std::unique_ptr<Channel>> channels_;
  std::vector<FaultStory> stories_;
  std::vector<std::size_t> waiting_;  // faults of frames after which NER has not been read
};

}  // namespace mb4::sim

#endif  // MB4SIM_FRAME_WATCH_HPP_
