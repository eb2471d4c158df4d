// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Calls for an actuator beside sensors, on the Verilated chip, with one flipped bit on MOSI. The
// bit may put the bytes of a transfer into the word of a sensor that waits to be read: by an opcode
// that writes (0x03 and 0x0B), or by an address (0x08 and 0x00). With SpiCheck::kFull no such word
// is told as a position, and none that is old.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "mb4/mb4.hpp"
#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/driver/rtl/mean_bus.hpp"
#include "tests/support/environment.hpp"

namespace {

using namespace mb4test;  // NOLINT: the bus that fails
namespace sim = mb4::sim;
using mb4::Error;
using mb4::SpiCheck;

constexpr unsigned kSlaves = 3;
constexpr unsigned kPeriodUs = 70;
constexpr std::uint64_t kSensorWord = 0xD123456;
// The polynomial of the sensors: two words that differ by it have the same CRC.
constexpr std::uint64_t kSameCrc = 0x43;
using Memory = std::array<std::uint8_t, 8 * mb4::kSlaves>;  // SCDATA1 to 8

// Flips one bit on MOSI, and remembers what this has done to SCDATA.
class LookingBus {
 public:
  static constexpr unsigned kNever = ~0U;

  explicit LookingBus(sim::Simulator& simulator) : chip_(simulator) {}
  // From now on transfers count from 0. A transfer that is too short stays as it is.
  void plan(unsigned transfer, unsigned bit) {
    at_ = transfer;
    bit_ = bit;
    made.clear();
  }
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    const bool hit = made.size() == at_;
    made.push_back({tx[0], tx[1], static_cast<std::uint8_t>(tx.size()), !rx.empty()});
    std::vector<std::uint8_t> mosi(tx.begin(), tx.end());
    if (hit && bit_ / 8 < mosi.size()) {
      mosi[bit_ / 8] ^= static_cast<std::uint8_t>(0x80U >> bit_ % 8);
    }
    if (hit && looks) look(before);
    const bool done = chip_.transfer({mosi.data(), mosi.size()}, rx);
    if (hit && looks) look(after);
    return done;
  }

  std::vector<Transfer> made;
  bool looks = false;
  Memory before{};
  Memory after{};

 private:
  void look(Memory& memory) {
    std::array<std::uint8_t, 1 + sizeof(Memory)> tx{0x09};
    std::array<std::uint8_t, 1 + sizeof(Memory)> rx{};
    chip_.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
    std::copy(rx.begin() + 1, rx.end(), memory.begin());
  }

  mb4::tool::SimBus chip_;
  unsigned at_ = kNever;
  unsigned bit_ = 0;
};

struct Chain {
  unsigned actuator;  // its place in the chain
  unsigned bits;
  std::uint64_t word;
  bool both_banks;  // Device::plan_actuator(), or Automatic::plan_actuator()
  bool ramp;        // the sensors send another word in each frame
  SpiCheck check = SpiCheck::kFull;

  [[nodiscard]] std::string text() const {
    return "actuator " + std::to_string(actuator) + ", word " + std::to_string(word) + " of " +
           std::to_string(bits) + " bits, " + (both_banks ? "both banks" : "one bank") +
           (check == SpiCheck::kFull ? ", kFull" : ", kFullAndRelease");
  }
};

std::string scenario_of(const Chain& setup) {
  std::string text = "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\nmo = true\n";
  for (unsigned slave = 1; slave <= kSlaves; ++slave) {
    text += "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = ";
    text += slave == setup.actuator ? std::to_string(setup.bits) + "\nactuator = true\n"
            : setup.ramp ? "28\nflag_bits = 0\nsource = \"ramp\"\nstart = 1000\nstep = 1\n"
                         : "28\nflag_bits = 0\ndata = " + std::to_string(kSensorWord) + "\n";
  }
  return text;
}

mb4::Config config_of(const Chain& setup) {
  mb4::Config config;
  config.ma_hz = 10'000'000;
  config.mo = true;
  config.channels[0].protocol = mb4::Protocol::kBissC;
  for (unsigned slave = 1; slave <= kSlaves; ++slave) {
    mb4::SlaveConfig& one = config.slaves[slave - 1];
    one.enabled = true;
    one.flags = mb4::Flags::kNone;
    one.actuator = one.stop_bit = slave == setup.actuator;
    one.data_bits = static_cast<std::uint8_t>(one.actuator ? setup.bits : 28);
  }
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, kPeriodUs * 1000);
  config.spi_check = setup.check;
  return config;
}

class ChainRig {
 public:
  explicit ChainRig(const Chain& setup)
      : setup_(setup),
        simulator(sim::parse_scenario(scenario_of(setup), "words.toml")),
        bus(simulator),
        clock(simulator),
        device(bus, clock) {}

  // Both banks hold the word already, and words of the sensors wait.
  void prepare(unsigned phase) {
    if (!device.configured()) {
      ASSERT_TRUE(device.configure(config_of(setup_)).ok());
    }
    if (!device.automatic().running()) {
      ASSERT_TRUE(device.automatic().restart().ok());
    }
    simulator.advance(2 * period());
    poll();
    ASSERT_TRUE(device.write_actuator(number(), setup_.word).ok());
    simulator.advance(period());
    poll();
    const std::uint64_t sent = frames();
    while (frames() == sent) simulator.advance(sim::kPsPerUs);
    simulator.advance(period() + phase * period() / 8);
  }

  // The call, with a flipped bit; positions are read between its steps, where this is possible, and
  // behind it. `wait`: a period passes before each step but the first.
  Error call(unsigned transfer, unsigned bit, bool wait = false) {
    bus.plan(transfer, bit);
    mb4::Operation op;
    const mb4::Result<void> planned =
        setup_.both_banks ? device.plan_actuator(op, number(), setup_.word)
                          : device.automatic().plan_actuator(op, number(), setup_.word);
    EXPECT_TRUE(planned.ok()) << mb4::to_string(planned.error());
    bool over = false;
    for (bool ended = !planned.ok(); !ended;) {
      ended = device.finish(op, op.run(bus), clock.now_us());
      over = over || bus.made.size() > transfer;
      if (over && !bus.looks) poll();
      if (wait) simulator.advance(period());
    }
    if (transfer == LookingBus::kNever) transfers_ = bus.made;
    bus.plan(LookingBus::kNever, 0);
    return op.result().error();
  }

  // The words that wait. Each is one that its sensor has sent, and none is older than one before.
  void poll() {
    if (!device.automatic().running()) return;
    std::array<std::uint64_t, kSlaves> sent{};
    for (unsigned i = 0; i < kSlaves; ++i) sent[i] = simulator.slave(i + 1)->frames();
    mb4::Frame frame;
    if (!device.automatic().poll(frame)) return;
    for (unsigned i = 0; i < kSlaves; ++i) {
      const auto slave = static_cast<std::uint8_t>(i + 1);
      if (slave == setup_.actuator || !frame[slave].ok()) continue;
      ++good;
      const std::uint64_t position = frame[slave]->position;
      if (!setup_.ramp) {
        EXPECT_EQ(position, *simulator.slave(slave)->sent_in(sent[i])) << "slave " << i + 1;
        continue;
      }
      const std::uint64_t number = position - 1000;  // of frames before
      EXPECT_LE(number, sent[i] + 1) << "slave " << i + 1;
      // Frames run on while the bank is held (decision 15).
      EXPECT_GE(number + 8, sent[i]) << "slave " << i + 1;
      EXPECT_GT(position, last_[i]) << "slave " << i + 1;
      last_[i] = position;
    }
  }

  [[nodiscard]] sim::Time period() const { return kPeriodUs * sim::kPsPerUs; }
  [[nodiscard]] std::uint8_t number() const { return static_cast<std::uint8_t>(setup_.actuator); }
  [[nodiscard]] std::uint64_t frames() const {
    return const_cast<sim::Simulator&>(simulator).slave(setup_.actuator == 1 ? 2 : 1)->frames();
  }
  // Of an undisturbed call: the first, the second and the last one of each kind.
  [[nodiscard]] std::vector<unsigned> chosen() const {
    std::vector<unsigned> result;
    for (unsigned i = 0; i < transfers_.size(); ++i) {
      const auto like = [&](const Transfer& other) { return other.like(transfers_[i]); };
      const auto at = transfers_.begin() + i;
      const bool first = std::count_if(transfers_.begin(), at, like) < 2;
      if (first || std::none_of(at + 1, transfers_.end(), like)) result.push_back(i);
    }
    return result;
  }
  [[nodiscard]] const Transfer& transfer(unsigned i) const { return transfers_[i]; }

 private:
  Chain setup_;
  std::vector<Transfer> transfers_;
  std::array<std::uint64_t, kSlaves> last_{};

 public:
  sim::Simulator simulator;
  LookingBus bus;
  mb4::tool::SimClock clock;
  mb4::Device<LookingBus, mb4::tool::SimClock> device;
  std::uint64_t good = 0;
};

// A sensor's word that the bit has changed, and what it is then.
struct Foreign {
  std::uint8_t slave = 0;
  std::uint64_t word = 0;
};

Foreign foreign(const LookingBus& bus, const Chain& setup) {
  for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
    const std::size_t at = 8U * (slave - 1U);
    if (slave == setup.actuator || bus.after[at] == bus.before[at]) continue;
    std::uint64_t word = 0;
    for (unsigned i = 4; i-- > 0;) word = word << 8U | bus.after[at + i];
    return {slave, word};
  }
  return {};
}

// What the hardware may do at the worst: the word of the sensor is such that its CRC fits the
// foreign bytes.
TEST(DriverActuatorWords, OneFlippedBit_NoForeignPosition) {
  struct Word {
    unsigned bits;
    std::uint64_t word;
  };
  // Zeros; bytes that all differ; a word that stays the same by four bytes to the side; one that
  // takes all of SCDATAx.
  constexpr std::array kWords{Word{32, 0}, Word{32, 0x01234567}, Word{56, 0}, Word{64, 0},
                              Word{64, 0x0123456701234567}};
  const bool all = number("MB4_ALL_BITS", 0) != 0;
  unsigned cases = 0;
  unsigned reached = 0;
  for (unsigned actuator = 1; actuator <= (all ? kSlaves : 2U); ++actuator) {
    for (const Word& each : kWords) {
      for (const bool both_banks : {false, true}) {
        const Chain setup{actuator, each.bits, each.word, both_banks, false};
        ChainRig rig(setup);
        rig.prepare(0);
        EXPECT_EQ(rig.call(LookingBus::kNever, 0), Error::kNone);
        for (const unsigned transfer : rig.chosen()) {
          const unsigned bits = all ? 8U * rig.transfer(transfer).size : 16U;
          for (unsigned bit = 0; bit < bits; ++bit) {
            SCOPED_TRACE(setup.text() + ", transfer " + std::to_string(transfer) + ", bit " +
                         std::to_string(bit));
            rig.bus.looks = true;
            rig.prepare(0);
            static_cast<void>(rig.call(transfer, bit));
            rig.bus.looks = false;
            ++cases;
            const Foreign hit = foreign(rig.bus, setup);
            if (hit.slave == 0 || hit.word >> 28U != 0) continue;
            ++reached;
            rig.simulator.advance(2 * rig.period());
            rig.poll();
            ASSERT_TRUE(rig.simulator.slave(hit.slave)->set_data(hit.word ^ kSameCrc));
            for (unsigned phase = 0; phase < 8; phase += 2) {
              rig.prepare(phase);
              static_cast<void>(rig.call(transfer, bit));
              for (unsigned i = 0; i < 3; ++i) {
                rig.poll();
                rig.simulator.advance(rig.period());
              }
            }
            ASSERT_TRUE(rig.simulator.slave(hit.slave)->set_data(kSensorWord));
          }
        }
        EXPECT_GT(rig.good, 100U);
      }
    }
  }
  std::printf("%u bits, %u of them reach the word of a sensor\n", cases, reached);
  EXPECT_GE(reached, 90U);
}

// A frame was lost before, so that the other bank holds a word that nobody has read. The bits of
// 0xF4 are flipped at eight phases of the frames.
TEST(DriverActuatorWords, OneFlippedBitBehindALostFrame_NoOldPosition) {
  for (const SpiCheck check : {SpiCheck::kFull, SpiCheck::kFullAndRelease}) {
    for (const bool both_banks : {false, true}) {
      const Chain setup{1, 32, 0x01234567, both_banks, true, check};
      ChainRig rig(setup);
      rig.prepare(0);
      EXPECT_EQ(rig.call(LookingBus::kNever, 0), Error::kNone);
      for (const unsigned transfer : rig.chosen()) {
        const bool instructs = rig.transfer(transfer).opcode == 0x07;
        for (unsigned bit = 0; bit < 16; ++bit) {
          for (unsigned phase = 0; phase < (instructs && bit >= 8 ? 8U : 1U); ++phase) {
            for (const bool wait : {false, true}) {
              SCOPED_TRACE(setup.text() + ", transfer " + std::to_string(transfer) + ", bit " +
                           std::to_string(bit) + ", phase " + std::to_string(phase) +
                           (wait ? ", waits" : ""));
              rig.prepare(phase);
              rig.poll();
              static_cast<void>(rig.call(transfer, bit, wait));
              for (unsigned i = 0; i < 4; ++i) {
                rig.poll();
                rig.simulator.advance(rig.period());
              }
            }
          }
        }
      }
      EXPECT_GT(rig.good, 1'000U);
    }
  }
}

}  // namespace
