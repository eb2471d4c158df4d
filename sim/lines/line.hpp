// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One line of a master, outside of it: the cable and the devices at its far end, whatever kind of
// line it is. The rest of the simulator knows only what stands here. A kind of line (line_kind.hpp)
// has a room of its own.
#ifndef MB4SIM_LINE_HPP_
#define MB4SIM_LINE_HPP_

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/master_clock.hpp"
#include "sim/core/time.hpp"
#include "sim/core/wire_faults.hpp"
#include "sim/lines/flip_watch.hpp"
#include "sim/lines/slave.hpp"

namespace mb4::sim {

// A wire of the cable that can be shorted, and that has jitter and glitches of its own.
struct WireName {
  std::string_view key;    // value of `on` in a fault; with "-low" and so on an action
  std::string_view title;  // for the user
};

// Something that happens to the cable: it is unplugged at the devices' end or plugged in, or one of
// its wires is shorted to a level or released.
struct LineAction {
  enum class What { kUnplug, kPlug, kLow, kHigh, kFree };
  What what = What::kUnplug;
  unsigned wire = 0;  // of LineKind::wires; not for the first two

  bool operator==(const LineAction&) const = default;
};

struct LineEvent {
  Time time = 0;  // since power-on, ps
  LineAction action;
};

// A cable as a scenario describes it. Each kind of line derives its own.
struct LineConfig {
  Time delay = 0;  // round trip with transceivers, ps
  std::vector<LineEvent> events;
  // The inverted bits of each frame by its number, as Line::flip() takes them.
  std::map<std::uint64_t, std::vector<unsigned>> flips;

  virtual ~LineConfig() = default;

 protected:
  LineConfig() = default;
  LineConfig(const LineConfig&) = default;
  LineConfig& operator=(const LineConfig&) = default;
};

// What a line can reach of the simulation.
class LineMaster {
 public:
  // The bits that the master takes from the line have changed.
  virtual void set_inputs(Time now, unsigned line, unsigned levels) = 0;
  // The clock of the master, which is there when it drives a line.
  MasterClock& clock() { return *clock_; }
  // Ends the simulation: the master has broken a rule of the line.
  [[noreturn]] virtual void stop(const std::string& reason) = 0;

 protected:
  ~LineMaster() = default;

  MasterClock* clock_ = nullptr;
};

// The master's end of a line. A channel that the scenario does not have is such an end with nothing
// behind it.
class LineEnd {
 public:
  LineEnd() = default;
  LineEnd(const LineEnd&) = delete;
  LineEnd& operator=(const LineEnd&) = delete;
  virtual ~LineEnd() = default;

  // The bits that the master drives; at least one of them has changed.
  virtual void drive(Time now, unsigned levels) = 0;
  // From now on the master's outputs only follow those of another line, or are its own again. Their
  // levels now may have changed for this reason.
  virtual void follow(bool /*follows*/, unsigned /*levels*/) {}
};

// A frame that is over. Each kind of line says what a frame is.
struct LineFrame {
  std::uint64_t number = 0;  // on its line, from 1 on
  Time start = 0;            // ps
  Time end = 0;
  std::uint64_t edges = 0;  // what mb4sim_frame counts
  bool rests_low = false;   // the master's clock is 0 after it
};

// Is told of the frames and edges of a line.
class LineObserver {
 public:
  // A frame has begun.
  virtual void frame_begun() = 0;
  virtual void frame_over(const LineFrame& frame) = 0;
  // `place`: MB4SIM_EDGE_... of mb4sim.h.
  virtual void edge(Time now, unsigned place, bool level) = 0;

 protected:
  ~LineObserver() = default;
};

class Line : public LineEnd {
 public:
  // --- devices, the nearest to the master first --------------------------------------------------
  virtual std::size_t size() const = 0;
  virtual Slave& slave(std::size_t index) = 0;
  const Slave& slave(std::size_t index) const { return const_cast<Line*>(this)->slave(index); }
  // The number of devices that are plugged in.
  virtual std::size_t attached() const = 0;
  // Unplugs the device `index` and those behind it; size(): all of them are plugged in.
  virtual void detach(Time now, std::size_t index) = 0;
  // Applies a changed SlaveFault.
  virtual void slave_changed(Time now) = 0;

  // --- the cable; changes are valid for edges that leave from now on -----------------------------
  virtual Time round_trip() const = 0;
  // Round trip in ps, as LineConfig::delay.
  virtual void set_round_trip(Time round_trip) = 0;
  // Faults of a wire, by its place in LineKind::wires. The rate of glitches keeps its constructed
  // value.
  virtual WireFaults wire_faults(unsigned wire) const = 0;
  virtual void set_wire_faults(unsigned wire, const WireFaults& faults) = 0;
  // One glitch of `width` ps at the far end of a wire.
  virtual void glitch(Time now, unsigned wire, Time width) = 0;
  virtual void act(Time now, LineAction action) = 0;
  virtual bool plugged() const = 0;
  // Applies faults that were set without a time.
  virtual void refresh(Time now) = 0;

  // --- frames ------------------------------------------------------------------------------------
  // Inverts these bits of frame number `frame`, which must not have come yet. Frames count from 1.
  // Several calls for a frame add up. `watch` is told when the frame has come.
  virtual void flip(std::uint64_t frame, std::vector<unsigned> bits, FlipWatch watch) = 0;
  void flip(std::uint64_t frame, std::vector<unsigned> bits) { flip(frame, std::move(bits), {}); }
  // Number of frames that flip() has counted.
  virtual std::uint64_t flip_frames() const = 0;
  // At most one observer is told of the frames and, with `edges`, of the present levels and of
  // every edge.
  virtual void observe(Time now, LineObserver* observer, bool edges) = 0;

  // --- for a waveform ----------------------------------------------------------------------------
  // Called after any change at the devices' end of the cable. Each receiver has at most one probe,
  // and a null pointer takes it away.
  using Probe = void (*)(Time now, void* receiver);
  virtual void set_probe(Probe probe, void* receiver) = 0;
  // Level that has arrived at the devices.
  virtual bool arrived() const = 0;
  // What a device drives, and whether it waits for a frame.
  virtual bool sent(std::size_t index) const = 0;
  virtual bool ready(std::size_t index) const = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_LINE_HPP_
