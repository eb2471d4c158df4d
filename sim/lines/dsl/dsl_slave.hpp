// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// An encoder with DSL: a peer that sends every bit that a master looks at. What nobody
// outside knows of real encoders is a key of its configuration.
//
// - It finds a frame by SYNC and the edge of SAMPLE, where it takes its position, and counts all
//   else from there. In RESET and SYNC frames it is silent.
// - START, LEARN and CHECK get the test pattern, an ID request its identity, all else a frame of
//   data: a byte of each safe channel, S_PAR, the pipeline, the second difference of the position.
// - It is silent up to the first START. Then a symbol that is none is answered as IDLE. A frame
//   whose SYNC is not there gets no answer, and the count of its vertical frame goes on.
// - M_PAR and S_PAR carry messages, once VSYNC has come (dsl_messages.hpp).
// - A second difference that does not fit is the error marker K29.7; the position stays the true
//   one.
//
// A frame of the line is an H-frame, from the first bit of SYNC to the end of its stuffing, which
// shows 6.5 bits later. Frames that flip() counts are the running ones, those after the first
// VSYNC. Eighths of a bit in SAMPLE (REST of a drive in step with its own cycle) are not looked at.
#ifndef MB4SIM_DSL_SLAVE_HPP_
#define MB4SIM_DSL_SLAVE_HPP_

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/lines/dsl/dsl_code.hpp"
#include "sim/lines/dsl/dsl_messages.hpp"
#include "sim/lines/duplex/duplex_slave.hpp"
#include "sim/lines/sensor_config.hpp"

namespace mb4::sim {

// Whether an encoder looks at a bit of M_PAR.
enum class DslFollow { kIgnore, kFollow };

struct DslSlaveConfig : SensorConfig {
  DslSlaveConfig() {
    name = "dsl";
    data_bits = 32;
    flag_bits = 0;
    flags = 0;
    crc = {};
  }

  unsigned acceleration_bits = 11;  // 8 to 11; data_bits are those of the position, up to 40
  unsigned index = 0;               // the user's part of the identity, 0 to 15
  bool is_signed = false;
  std::uint8_t summary = 0;
  unsigned safe2_bits = 0;  // of the second safe position; 0: as many as the first
  std::uint8_t pipeline = 0;
  unsigned s_par_bits = 0;   // bits 6 and 5 of S_PAR
  unsigned sync_frames = 8;  // SYNC frames that it must have seen to answer START
  unsigned vsync_after = 3;  // frames with INIT up to the one with VSYNC
  DslFollow msync = DslFollow::kIgnore;
  DslFollow first = DslFollow::kIgnore;
  unsigned vsync_phase = 0;       // frames from a change of msync to RX0, 0 to 7
  bool positive = false;          // running disparity at the begin of an answer
  std::optional<bool> direction;  // the bit before the second safe channel; else it alternates
  Time lead = 0;                  // its driver is on that long before and after the answer
  bool lead_level = true;
  bool status2_k28 = true;       // STATUS2 is a special character
  Time latency = 95 * kPsPerNs;  // from the end of SWITCH to the first edge
  double clock_ppm = 0;          // of its own clock
  bool broken_identity = false;  // its two copies differ
  unsigned identity_flip = 0;    // bits of the identity that are wrong in both copies
  bool vertical_k28 = false;     // bytes of safe channel 1 that end with 28 are special characters
  unsigned wrong_pattern = 0;    // training frame whose test pattern is wrong once; 0: none
  dsl::MessageConfig messages;

  std::unique_ptr<Slave> make_slave(std::uint64_t seed) const override;
  DeviceTraits traits() const override;
  std::string_view refuses(const SlaveFault& fault) const override;
};

class DslSlave final : public DuplexSlave {
 public:
  explicit DslSlave(const DslSlaveConfig& config);

  unsigned data_bits() const override { return config_.data_bits; }
  bool set_data(std::uint64_t raw) override { return config_.hold(raw); }
  std::optional<std::uint64_t> sent_word() const override { return position_; }
  void set_fault(const SlaveFault& fault, bool on) override;
  bool idle() const override { return !in_frame_; }
  std::uint64_t flip_frames() const override { return running_; }

  void line_changed(Time now, bool level) override;
  void timer(Time now, std::uint64_t word) override;

  const DslSlaveConfig& config() const { return config_; }
  // Inverts a bit of the answer in a training frame, which count from 1 in each start. Once.
  void flip_training(unsigned frame, unsigned bit) { training_flip_ = {frame, bit}; }
  // Asks for each position instead of the source: a test's own motion.
  using Motion = std::uint64_t (*)(void* context);
  void set_motion(Motion motion, void* context) {
    motion_ = motion;
    motion_context_ = context;
  }
  // The position that it took `within` of a time, one of the last few; nothing if it took none.
  std::optional<std::uint64_t> sampled_near(Time at, Time within) const;
  dsl::ParameterChannel& messages() { return messages_; }
  // A second difference did not fit.
  bool overflowed() const { return overflowed_; }
  // Bits of the last answer that were inverted by errors of the line or by flip(); the first bit of
  // the answer is bit 60.
  std::uint64_t inverted() const { return inverted_; }

 private:
  static constexpr unsigned kAnswerBits = 61;
  static constexpr unsigned kVertical = 8;

  struct Edge {
    Time at;
    bool level;
  };
  struct Sample {
    Time at = kNever;
    std::uint64_t position = 0;
  };
  struct Channel {
    std::array<std::uint8_t, kVertical> bytes{};
    bool marked = false;  // the first byte of the position is a special character
  };

  Time bits(double count) const { return static_cast<Time>(count * bit_ + 0.5); }
  void look_for_sync(Time now);
  void begin(Time now);
  void sample(Time at);
  void go_on();
  void miss();
  void take_parameter(Time now);
  std::optional<std::uint8_t> parameter() const;
  void look_for_stuffing();
  bool level_at(double bits_behind_sample) const;
  std::uint64_t answer(unsigned symbol, std::optional<unsigned> seen);
  std::uint8_t s_par(std::optional<unsigned> symbol);
  bool vsync_now();
  void set_status0(std::uint8_t bits);  // in ENC_ST0
  std::uint64_t pattern();
  std::uint64_t identity() const;
  // What a running frame carries. Named bits that are to be wrong go into inverted_.
  std::uint64_t data_frame(std::optional<unsigned> symbol);
  std::uint64_t noise();
  void fill_channels();
  void send(Time now);
  void finish(Time now);

  DslSlaveConfig config_;
  double bit_;  // ps
  Motion motion_ = nullptr;
  void* motion_context_ = nullptr;

  // The line.
  bool level_ = true;
  Time last_edge_ = 0;
  std::array<unsigned, 4> lengths_{};  // of the last runs of equal bits, the latest first
  bool in_frame_ = false;
  bool listening_ = true;  // edges are those of the master
  Time sampled_at_ = 0;
  Time frame_time_ = 0;  // between the last two samples
  bool any_sample_ = false;
  std::vector<Edge> edges_;  // since the sample, but those of its own answer
  bool told_ = true;         // the end of the last frame
  unsigned extra_ = 0;       // ones more in SAMPLE
  unsigned stuffing_ = 0;    // bits
  bool lost_sync_ = false;   // in this frame, by a wrong bit
  unsigned wrong_parameter_ = 0;
  std::uint64_t turn_ = 0;  // number of the frame whose timers count

  // Its answer.
  std::uint64_t word_ = 0;
  unsigned next_bit_ = 0;
  Time answer_at_ = 0;

  // What it has seen of the master.
  unsigned syncs_ = 0;
  unsigned training_ = 0;
  bool started_ = false;
  bool pattern_was_wrong_ = false;
  std::pair<unsigned, unsigned> training_flip_{0, 0};
  unsigned inits_ = 0;
  bool vsync_sent_ = false;
  bool msync_ = false;
  bool msync_seen_ = false;

  // Motion.
  std::uint64_t samples_ = 0;
  std::optional<std::uint64_t> told_safe_;  // by the last vertical frame
  std::array<Sample, 16> last_{};           // by the number of the sample
  std::uint64_t position_ = 0;
  std::uint64_t before_ = 0;  // position of the frame before
  std::int64_t speed_ = 0;
  std::int64_t acceleration_ = 0;
  bool overflowed_ = false;

  unsigned place_ = 0;  // in the vertical frame
  Channel safe1_;
  Channel safe2_;
  bool toggle2_ = false;
  std::uint64_t running_ = 0;
  std::uint64_t inverted_ = 0;

  dsl::ParameterChannel messages_;

  bool wrong_crc2_ = false;
  bool fast_marker_ = false;
  bool safe_marker_ = false;
  bool safe2_marker_ = false;
  bool no_vsync_ = false;
  bool early_vsync_ = false;
  bool late_vsync_ = false;
  bool owes_vsync_ = false;  // the late one comes with the next frame
  bool stale_safe_ = false;
  bool mismatch2_ = false;
  bool stuck_toggle2_ = false;
  bool test2_ = false;
  bool error2_ = false;
  bool wrong_fix2_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_DSL_SLAVE_HPP_
