// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A slave that plays the next recorded frame whenever a frame starts, after the last one the first.
// It does not know BiSS. In idle it answers the first falling edge of MA with the recorded edges of
// SL.
#ifndef MB4SIM_REPLAY_SLAVE_HPP_
#define MB4SIM_REPLAY_SLAVE_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/lines/clocked/clocked_slave.hpp"
#include "sim/lines/clocked/slave_timeout.hpp"
#include "sim/lines/device.hpp"
#include "sim/lines/replay/replay_recording.hpp"

namespace mb4::sim {

struct ReplaySlaveConfig : DeviceConfig {
  // kTime: each edge comes at its recorded time after the first falling edge of MA.
  // kClock: each edge comes after the rising edge of MA to which it belonged in the recording, with
  // the recorded remainder. So the recording can be played at another frequency. Edges whose clock
  // does not come are left out. SL goes to 1 when MA has been constant for the timeout.
  enum class Play { kTime, kClock };

  // The other properties of DeviceConfig are those of the recorded data. The slave itself does not
  // need them.
  ReplaySlaveConfig() {
    name = "replay";
    data_bits = 1;
    flag_bits = 0;
    crc = {};
  }

  ReplayRecording recording;
  Play play = Play::kTime;
  SlaveTimeout timeout;  // kClock only

  std::unique_ptr<Slave> make_slave(std::uint64_t seed) const override;
  DeviceTraits traits() const override;
  std::string_view refuses(const SlaveFault& fault) const override;
};

class ReplaySlave final : public ClockedSlave {
 public:
  explicit ReplaySlave(const ReplaySlaveConfig& config);

  void ma_edge(Time now, bool ma, bool sli_before, bool sli) override;
  void sli_changed(Time /*now*/, bool /*sli*/) override {}
  void timer(Time now, bool sli) override;

  unsigned data_bits() const override { return config_.data_bits; }
  bool set_data(std::uint64_t /*raw*/) override { return false; }

  const ReplaySlaveConfig& config() const { return config_; }

 private:
  // kClock: the rising edge of MA to which a recorded edge belongs, counted from 1, and the time
  // after it.
  struct Place {
    std::uint64_t rising;
    Time after;
  };
  Place place(std::size_t index) const;
  Time next_edge() const;
  void play_due(Time now);
  void wait();

  ReplaySlaveConfig config_;
  const std::vector<ReplayRecording::Edge>& edges() const;

  std::size_t frame_ = 0;  // of the recording
  bool active_ = false;
  bool ma_ = true;
  std::size_t next_ = 0;
  std::vector<Time> risings_;  // of the running frame
  Time first_falling_ = 0;
  Time last_edge_ = 0;
  Time timeout_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_REPLAY_SLAVE_HPP_
