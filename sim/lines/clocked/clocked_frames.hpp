// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells the frames of a clocked line and, if asked, every edge. A frame is over when MA has rested
// for 1.5 periods (MaMonitor). It takes the tap of the line and, for edges, a probe.
#ifndef MB4SIM_CLOCKED_FRAMES_HPP_
#define MB4SIM_CLOCKED_FRAMES_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/core/event_queue.hpp"
#include "sim/core/time.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {

class ClockedFrames {
 public:
  // From now on. The line must outlive it.
  ClockedFrames(Time now, EventQueue& queue, ClockedLine& line);

  // Tells `observer`, nobody if it is null.
  void tell(Time now, LineObserver* observer, bool edges);

 private:
  // The order of MB4SIM_EDGE_...: at a pin of the master, or SLO of the slave next to SL, at its
  // end of the cable.
  enum Place : unsigned { kMa, kMo, kSl, kSlo, kPlaces };

  static void on_edge(Time now, void* receiver, ClockedLine::Signal signal, bool level);
  static void on_probe(Time now, void* receiver);
  static void on_look(Time now, void* receiver, std::uint64_t due);
  void tell_edge(Time now, Place place, bool level);
  void plan(Time now);
  void look(Time now);

  EventQueue& queue_;
  ClockedLine& line_;
  LineObserver* observer_ = nullptr;
  bool edges_ = false;
  std::uint64_t told_ = 0;              // frames that are over and told
  std::uint64_t begun_ = 0;             // frames that have begun
  Time due_ = kNever;                   // the next look
  std::array<bool, kPlaces> levels_{};  // that have been told
};

}  // namespace mb4::sim

#endif  // MB4SIM_CLOCKED_FRAMES_HPP_
