// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One encoder on one cable, read by the iC-MB4, biss_axi and biss_clb.
#ifndef TESTS_CHIP_FAMILY_READERS_HPP_
#define TESTS_CHIP_FAMILY_READERS_HPP_

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "masters/mb4/sim_bus.hpp"
#include "mb4/device.hpp"
#include "tests/chip/axi/axi_bench.hpp"
#include "tests/chip/clb/clb_bench.hpp"
#include "tests/support/chip_fixture.hpp"

namespace mb4test::family {

inline constexpr std::uint64_t kStart = 4000;
inline constexpr std::uint64_t kStep = 77;
inline constexpr unsigned kFrames = 6;  // of the encoder

// The word, flags included, of each frame of the encoder, whose frames count from 1.
using Words = std::map<std::uint64_t, std::uint64_t>;

struct Line {
  const char* preset;
  unsigned bits;  // of position
  unsigned metres;
  unsigned mhz;

  std::string text() const {
    return "[[channel]]\nnumber = 1\ncable_m = " + std::to_string(metres) +
           ".0\n[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"" + preset +
           "\"\nsource = \"ramp\"\nstart = " + std::to_string(kStart) +
           "\nstep = " + std::to_string(kStep) + "\n";
  }
  std::uint32_t hz() const { return mhz * 1'000'000U; }
  // Of a frame, with nE and nW.
  std::uint64_t word(std::uint64_t frame) const {
    const std::uint64_t position = kStart + kStep * (frame - 1);
    return (position & ((std::uint64_t{1} << bits) - 1)) << 2U | 3U;
  }
};

inline Words through_mb4(const Line& line) {
  sim::Simulator simulator(sim::parse_scenario(line.text(), "mb4.toml"));
  mb4::tool::SimBus bus(simulator);
  mb4::tool::SimClock clock(simulator);
  mb4::Device<mb4::tool::SimBus, mb4::tool::SimClock> device(bus, clock);
  mb4::Config config = config26(line.hz());
  config.slaves[0].data_bits = static_cast<std::uint8_t>(line.bits + 2);
  EXPECT_TRUE(device.configure(config).ok());
  EXPECT_TRUE(device.initialize().ok());
  Words words;
  while (simulator.slave(1)->frames() < kFrames) {
    mb4::Frame frame;
    if (!device.read_all(frame).ok() || !frame[1].ok()) break;
    words[simulator.slave(1)->frames()] = frame[1]->raw;
  }
  return words;
}

inline Words through_axi(const Line& line) {
  AxiBench bench("[master]\ntype = \"axi\"\n[chip]\nf_clk_hz = 100_000_000\n" + line.text());
  bench.set_up(line.bits, 50 / line.mhz);
  Words words;
  while (bench.frames(1) < kFrames) {
    const auto beat = bench.frame(200 * sim::kPsPerUs);
    if (!beat || (beat->user & 1U) == 0) break;
    // The flags are the pins.
    words[bench.frames(1)] = std::uint64_t{beat->words[0]} << 2U | (bench.pin("error") ? 2U : 0U) |
                             (bench.pin("warn") ? 1U : 0U);
  }
  return words;
}

inline Words through_clb(const Line& line) {
  ClbBench bench(clb_scenario(line.text()));
  bench.set_up(line.bits, 100 / line.mhz);
  Words words;
  while (bench.simulator.slave(1)->frames() < kFrames) {
    if (bench.frame() != PM_BISSC_PASS) break;
    words[bench.simulator.slave(1)->frames()] =
        bench.encoder.position << 2U | unsigned{bench.encoder.error} << 1U | bench.encoder.warning;
  }
  return words;
}

// ---- Registers ---------------------------------------------------------------------------------

inline const std::string kRegisters =
    "[[channel]]\nnumber = 1\ncable_m = 20.0\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
    "data_bits = 26\ncrc = 0x43\nregisters = { 0x20 = [0x00, 0x00, 0x00, 0x00] }\n";

// One way to the encoder's registers.
class Way {
 public:
  virtual ~Way() = default;
  virtual bool write(std::uint8_t address, std::uint8_t value) = 0;
  virtual std::optional<std::uint8_t> read(std::uint8_t address) = 0;
  virtual sim::Simulator& simulator() = 0;
};

class Mb4Way final : public Way {
 public:
  Mb4Way() {
    mb4::Config config = config26(5'000'000);
    config.slaves[0].data_bits = 26;
    EXPECT_TRUE(chip_.device.configure(config).ok());
    EXPECT_TRUE(chip_.device.initialize().ok());
  }
  bool write(std::uint8_t address, std::uint8_t value) override {
    const std::array<std::uint8_t, 1> bytes{value};
    return chip_.device.control().write_registers({1, 0}, address, {bytes.data(), 1}).ok();
  }
  std::optional<std::uint8_t> read(std::uint8_t address) override {
    std::array<std::uint8_t, 1> bytes{};
    if (!chip_.device.control().read_registers({1, 0}, address, {bytes.data(), 1}).ok()) return {};
    return bytes[0];
  }
  sim::Simulator& simulator() override { return chip_.simulator; }

 private:
  Chip chip_{kRegisters};
};

class AxiWay final : public Way {
 public:
  AxiWay() {
    bench_.write(axireg::kAddrSampleDivider, 2000);  // 25 kHz
    bench_.write(axireg::kAddrPositionBits, 24);
    bench_.write(axireg::kAddrMaDivider, 10);
    bench_.write(axireg::kAddrChannelEnable, 1);
  }
  bool write(std::uint8_t address, std::uint8_t value) override {
    return run(true, address, value);
  }
  std::optional<std::uint8_t> read(std::uint8_t address) override {
    if (!run(false, address, 0)) return {};
    return static_cast<std::uint8_t>(bench_.read(axireg::kAddrAccessData));
  }
  sim::Simulator& simulator() override { return bench_.simulator; }

 private:
  bool run(bool write, std::uint8_t address, std::uint8_t value) {
    bench_.write(axireg::kAddrAccessData, value);
    std::uint32_t word = axireg::ACCESS_START::of(1U) | axireg::ACCESS_ADDRESS::of(address);
    if (write) word |= axireg::ACCESS_WRITE::of(1U);
    bench_.write(axireg::kAddrAccess, word);
    for (int i = 0; i < 500; ++i) {
      bench_.simulator.advance(20 * sim::kPsPerUs);
      const std::uint32_t status = bench_.read(axireg::kAddrAccessStatus);
      if (axireg::ACCESS_ACTIVE::get(status) == 0) return status == 0;
    }
    return false;
  }
  AxiBench bench_{
      "[master]\ntype = \"axi\"\n[chip]\nf_clk_hz = 100_000_000\nfeatures = \"full\"\n" +
      kRegisters};
};

class ClbWay final : public Way {
 public:
  ClbWay() { bench_.set_up(24, 20); }
  bool write(std::uint8_t address, std::uint8_t value) override {
    return bench_.access(PM_BISSC_REGISTER_WRITE, address, value) == PM_BISSC_CD_WRITE_PASS;
  }
  std::optional<std::uint8_t> read(std::uint8_t address) override {
    if (bench_.access(PM_BISSC_REGISTER_READ, address) != PM_BISSC_CD_READ_PASS) return {};
    return static_cast<std::uint8_t>(bench_.reg.rxData);
  }
  sim::Simulator& simulator() override { return bench_.simulator; }

 private:
  ClbBench bench_{clb_scenario(kRegisters)};
};

// A random byte goes through each way into a register, and is read through all of them. An encoder
// has one master, so what one master has written is put into the encoders of the others.
template <std::size_t Count>
void exchange_registers(const std::array<Way*, Count>& ways) {
  sim::Random random(1);
  for (unsigned round = 0; round < 4; ++round) {
    for (Way* writer : ways) {
      const auto address = static_cast<std::uint8_t>(0x20 + random.up_to(3));
      const auto value = static_cast<std::uint8_t>(random.next());
      ASSERT_TRUE(writer->write(address, value)) << round;
      const std::uint8_t stored = writer->simulator().slave(1)->reg_read(address);
      ASSERT_EQ(stored, value) << round;
      for (Way* reader : ways) {
        reader->simulator().slave(1)->reg_write(address, stored);
        ASSERT_EQ(reader->read(address), value) << round;
      }
    }
  }
}

}  // namespace mb4test::family

#endif  // TESTS_CHIP_FAMILY_READERS_HPP_
