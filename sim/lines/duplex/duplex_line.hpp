// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A line of one wire that both ends drive: a transceiver at the master, the cable, a transceiver at
// the one device. Each driver needs a time to come on and to go off. Where no driver is on the line
// reads 1; where both are on it reads 0 if one of them sends 0, and the line counts it. Each
// receiver is always on, so an end also sees what it drives itself.
#ifndef MB4SIM_DUPLEX_LINE_HPP_
#define MB4SIM_DUPLEX_LINE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/core/event_queue.hpp"
#include "sim/core/time.hpp"
#include "sim/core/wire.hpp"
#include "sim/core/wire_faults.hpp"
#include "sim/lines/duplex/duplex_slave.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {

struct LineSetup;

// The bits that a master drives on a duplex line; the one that it takes is the level that it sees.
inline constexpr unsigned kOutPin = 1;     // level to send
inline constexpr unsigned kEnablePin = 2;  // its driver is on

struct DuplexConfig : LineConfig {
  WireFaults out;            // master to device
  WireFaults in;             // device to master
  Time enable = 0;           // from the pin to a driver that is on, both ends, ps
  Time disable = 0;          // ... that is off
  double answer_errors = 0;  // chance that a bit of the device's is wrong when it sends it
  double master_errors = 0;  // ... that one of the master's is when the device takes it
};

// Times when both ends have driven, as a receiver at one of the ends sees it. One that is not over
// counts up to the present.
struct DuplexContention {
  std::uint64_t times = 0;
  Time total = 0;  // ps
  Time longest = 0;
  Time first = 0;  // when the first one began
};

class DuplexLine final : public Line {
 public:
  // Places in LineKind::wires. What happens to kBoth happens at both ends.
  static constexpr unsigned kBoth = 0;
  static constexpr unsigned kIn = 1;
  static constexpr unsigned kOut = 2;

  // The delay of `config` is that to the device and back; each way takes half of it. Its events are
  // posted at once. The line has no device before add().
  explicit DuplexLine(const LineSetup& setup);
  ~DuplexLine() override;

  // At most one device.
  void add(std::unique_ptr<DuplexSlave> slave);

  void drive(Time now, unsigned levels) override;

  // --- devices -----------------------------------------------------------------------------------
  std::size_t size() const override { return slave_ == nullptr ? 0 : 1; }
  DuplexSlave& slave(std::size_t /*index*/) override { return *slave_; }
  std::size_t attached() const override { return attached_ ? size() : 0; }
  void detach(Time now, std::size_t index) override;
  void slave_changed(Time now) override { changed(now, kDevice); }

  // --- the cable ---------------------------------------------------------------------------------
  Time round_trip() const override;
  void set_round_trip(Time round_trip) override;
  WireFaults wire_faults(unsigned wire) const override;
  void set_wire_faults(unsigned wire, const WireFaults& faults) override;
  void glitch(Time now, unsigned wire, Time width) override;
  void act(Time now, LineAction action) override;
  bool plugged() const override { return plugged_; }
  void refresh(Time /*now*/) override {}

  // --- frames: the device knows them -------------------------------------------------------------
  using Line::flip;
  void flip(std::uint64_t frame, std::vector<unsigned> bits, FlipWatch watch) override;
  std::uint64_t flip_frames() const override { return size() == 0 ? 0 : slave_->flip_frames(); }
  void observe(Time now, LineObserver* observer, bool edges) override;

  // --- for a waveform ----------------------------------------------------------------------------
  void set_probe(Probe probe, void* receiver) override;
  bool arrived() const override { return ends_[kDevice].seen; }
  bool sent(std::size_t /*index*/) const override { return ends_[kDevice].sends(); }
  bool ready(std::size_t /*index*/) const override { return slave_->idle(); }

  DuplexContention contention(Time now) const;
  // From the pin to a driver that is on.
  Time enable_time() const { return enable_; }

 private:
  friend class DuplexSlave;

  // Places in ends_. The wire of an end begins there.
  static constexpr unsigned kMaster = 0;
  static constexpr unsigned kDevice = 1;

  // One end of the cable.
  struct End {
    DuplexDrive pins;           // of the transceiver
    bool on = false;            // its driver is on
    bool mute = false;          // it drives nothing, whatever its pins say
    unsigned switches = 0;      // of the driver that were asked for: only the last one counts
    bool far = true;            // what has come from the other end; 1 while its driver is off
    bool far_on = false;        // ... whose driver is on
    std::optional<bool> stuck;  // its receiver is shorted
    bool seen = true;           // by its receiver
    bool drives() const { return on && !mute; }
    bool sends() const { return !drives() || pins.level; }
  };

  static void on_arrival(Time now, void* receiver, unsigned levels, unsigned end);
  static void at_master(Time now, void* receiver, unsigned levels);
  static void at_device(Time now, void* receiver, unsigned levels);
  static void on_switch(Time now, void* receiver, std::uint64_t word);
  static void on_event(Time now, void* receiver, std::uint64_t event);
  static void on_timer(Time now, void* receiver, std::uint64_t word);

  void set_pins(Time now, unsigned end, DuplexDrive pins);
  bool connected() const { return plugged_ && attached_; }
  void changed(Time now, unsigned end);
  void look(Time now, unsigned end);
  void watch_contention(Time now);
  std::array<bool, 4> levels() const;
  void tell_edges(Time now);
  void frame_begins(Time now);
  void frame_ends(Time now, std::optional<std::uint64_t> edges = std::nullopt);

  EventQueue& queue_;
  Wire out_;  // bit 0 is the level, bit 1 the driver
  Wire in_;
  std::array<End, 2> ends_{};
  Time enable_;
  Time disable_;
  BitErrors answer_errors_;
  BitErrors master_errors_;
  LineMaster& master_;
  unsigned index_;
  std::vector<LineEvent> events_;
  std::unique_ptr<DuplexSlave> slave_;
  bool plugged_ = true;
  bool attached_ = true;
  bool both_ = false;  // drive now
  Time both_since_ = 0;
  DuplexContention contention_;     // of those that are over; the times of all
  std::optional<LineFrame> frame_;  // that runs
  LineObserver* observer_ = nullptr;
  bool edges_ = false;
  std::array<bool, 4> told_{};                   // by tell_edges()
  std::vector<std::pair<Probe, void*>> probes_;  // with their receivers
};

// A duplex line, for a program that knows that it is one.
inline DuplexLine* duplex(Line* line) { return static_cast<DuplexLine*>(line); }
inline const DuplexConfig& duplex(const LineConfig& config) {
  return dynamic_cast<const DuplexConfig&>(config);
}

}  // namespace mb4::sim

#endif  // MB4SIM_DUPLEX_LINE_HPP_
