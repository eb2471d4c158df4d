// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver of the BiSS C master on AXI, in C++ and with the C calls of the hello-fpga manual
// (2.5), on the simulated master.
#include "biss_axi/device.hpp"
#include "biss_axi/page.hpp"
#include "biss_c.h"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {
namespace {

// What the C calls work on.
struct World {
  AxiBench* bench = nullptr;
  bool bus_fails = false;
  unsigned writes = 0;
};
World world;

struct SimTime {
  AxiBench& bench;
  std::uint32_t now_us() const {
    return static_cast<std::uint32_t>(bench.simulator.now() / sim::kPsPerUs);
  }
};

using Device = biss_axi::Device<AxiPort, SimTime>;

std::vector<AxiEncoder> two() { return {{.delay_ns = 35}, {.delay_ns = 435}}; }

// A simulated master with a driver.
struct Driven {
  explicit Driven(const std::string& scenario = axi_scenario(two())) : bench(scenario) {}
  AxiBench bench;
  AxiPort port{bench};
  SimTime time{bench};
  Device device{port, time};
  biss_axi::Config config;
};

class AxiDriver : public testing::Test, protected Driven {};

TEST_F(AxiDriver, ReadSingle_BringsTheWordsOfAllChannelsAndTheirDelays) {
  config.channels = 3;
  ASSERT_TRUE(device.configure(config).ok());
  for (std::uint32_t n = 1; n < 20; ++n) {
    bench.simulator.slave(1)->set_data(raw_word(n));
    bench.simulator.slave(2)->set_data(raw_word(1000 + n));
    const auto word = device.read_single(1);
    ASSERT_TRUE(word.ok());
    EXPECT_EQ(*word, 1000 + n);
    EXPECT_EQ(device.position(0).value_or(0), n);
    EXPECT_EQ(device.valid().value_or(0), 3U);
  }
  EXPECT_NEAR(device.line_delay(0).value_or(0), 3, 1);
  EXPECT_NEAR(device.line_delay(1).value_or(0), 43, 1);
  EXPECT_EQ(device.read_single(2).error(), biss_axi::Error::kChannel);
  EXPECT_EQ(device.position(16).error(), biss_axi::Error::kChannel);
}

TEST_F(AxiDriver, WordThatIsStillComing_IsNoPosition) {
  Driven slow(axi_scenario({{.delay_ns = 35}, {.slave = "busy_periods = 50\n"}}));
  slow.config.channels = 3;
  ASSERT_TRUE(slow.device.configure(slow.config).ok());
  slow.bench.simulator.slave(1)->set_data(raw_word(1));
  slow.bench.simulator.slave(2)->set_data(raw_word(2));
  ASSERT_EQ(slow.device.read_single(0).value_or(0), 1U);
  EXPECT_EQ(slow.device.position(1).error(), biss_axi::Error::kNoData);
  slow.bench.simulator.advance(20 * sim::kPsPerUs);
  EXPECT_EQ(slow.device.position(1).value_or(0), 2U);
}

// At 200 MHz 4000 clocks are 20 us; an encoder may need 40.
TEST_F(AxiDriver, TimeoutOfTheEncoder_PassesBeforeTheNextRequest) {
  Driven fast(axi_scenario({{.slave = "timeout = 39.0\n"}}, 200'000'000));
  fast.config.f_clk_hz = 200'000'000;
  ASSERT_TRUE(fast.device.configure(fast.config).ok());
  for (std::uint32_t n = 1; n < 5; ++n) {
    fast.bench.simulator.slave(1)->set_data(raw_word(n));
    EXPECT_EQ(fast.device.read_single(0).value_or(0), n);
  }
}

TEST_F(AxiDriver, ReadAll_WaitsForTheLastWordAndTellsWhichAreGood) {
  Driven slow(axi_scenario({{.delay_ns = 35}, {.slave = "busy_periods = 50\n"}}));
  slow.config.channels = 3;
  ASSERT_TRUE(slow.device.configure(slow.config).ok());
  slow.bench.simulator.slave(1)->set_data(raw_word(1));
  slow.bench.simulator.slave(2)->set_data(raw_word(2));
  EXPECT_EQ(slow.device.read_all().value_or(0), 3U);
  EXPECT_EQ(slow.device.position(0).value_or(0), 1U);
  EXPECT_EQ(slow.device.position(1).value_or(0), 2U);
  slow.bench.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 0\n");
  slow.bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(slow.device.read_all().value_or(0), 2U);
  EXPECT_EQ(slow.device.position(0).error(), biss_axi::Error::kNoData);
  EXPECT_EQ(slow.device.position(1).value_or(0), 2U);
}

TEST_F(AxiDriver, EncoderThatIsGone_IsATimeoutAndNeverAnOldWord) {
  ASSERT_TRUE(device.configure(config).ok());
  ASSERT_TRUE(device.read_single(0).ok());
  bench.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 0\n");
  bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(device.read_single(0).error(), biss_axi::Error::kTimeout);
  EXPECT_EQ(device.valid().value_or(9), 0U);
}

// The map does not show nE and nW; the CRC of the position and each pair of them is one of four.
TEST_F(AxiDriver, SlaveError_GivesNoPositionButAReading) {
  world = {&bench};
  for (const bool check : {true, false}) {
    config.check_crc = check;
    config.channels = 3;
    ASSERT_TRUE(device.configure(config).ok());
    for (std::uint32_t n = 0; n < 32; ++n) {
      const std::uint32_t position = n * 0x9E3779B9U >> 6U;
      const bool error = (n & 2U) == 0;
      bench.simulator.slave(1)->set_data(std::uint64_t{position} << 2U | (n & 3U));
      bench.simulator.slave(2)->set_data(raw_word(n));
      const auto word = device.read_single(0);
      ASSERT_EQ(word.error(), error ? biss_axi::Error::kSlaveError : biss_axi::Error::kNone) << n;
      EXPECT_EQ(word.reading().position, position);
      EXPECT_EQ(word.reading().slave_error, error);
      EXPECT_EQ(word.reading().slave_warning, (n & 1U) == 0);
      EXPECT_EQ(word.value_or(7), error ? 7U : position);
      EXPECT_EQ(device.position(0).error(), word.error());
      EXPECT_EQ(device.position(1).value_or(99), n);
      EXPECT_EQ(device.read_all().value_or(0), 3U);
      unsigned data = 0;
      bool valid = !error;
      EXPECT_EQ(BISS_C_ReadSinglePoint(7, 0, &data, &valid), error ? BISS_C_SLAVE_ERROR : 0);
      EXPECT_EQ(valid, !error);
      EXPECT_EQ(data, position);
    }
  }
  world = {};
}

// CALCULATED_CRC that fits no pair of flags: the flips 0x03, 0x06 and 0x05 turn one pair into
// another (x^6, x^7 modulo x^6 + x + 1); any other one is a CRC error.
TEST_F(AxiDriver, CrcThatFitsNoPair_IsCrc) {
  struct FlippedPort {
    AxiPort inner;
    std::uint32_t flip = 0;
    bool write(std::uint32_t offset, std::uint32_t value) const {
      return inner.write(offset, value);
    }
    bool read(std::uint32_t offset, std::uint32_t& value) const {
      const bool done = inner.read(offset, value);
      if (offset == axireg::kAddrCalculatedCrc) value ^= flip;
      return done;
    }
  };
  FlippedPort flipped{port};
  biss_axi::Device<FlippedPort, SimTime> other(flipped, time);
  ASSERT_TRUE(other.configure(config).ok());
  bench.simulator.slave(1)->set_data(raw_word(5));
  ASSERT_TRUE(other.read_single(0).ok());
  for (flipped.flip = 1; flipped.flip < 64; ++flipped.flip) {
    const auto word = other.position(0);
    const bool pair = flipped.flip == 3 || flipped.flip == 5 || flipped.flip == 6;
    if (!pair) {
      EXPECT_EQ(word.error(), biss_axi::Error::kCrc) << flipped.flip;
    } else {
      EXPECT_EQ(word.reading().slave_error, flipped.flip != 3);
      EXPECT_EQ(word.reading().slave_warning, flipped.flip != 6);
    }
  }
}

TEST_F(AxiDriver, WrongConfiguration_IsNamedAndNothingIsWritten) {
  using biss_axi::Config;
  using biss_axi::Field;
  const std::pair<Config, Field> cases[] = {
      {Config{.f_clk_hz = 0}, Field::kClkHz},
      {Config{.ma_hz = 0}, Field::kMaHz},
      {Config{.ma_hz = 3'000'000}, Field::kMaHz},
      {Config{.ma_hz = 100'000}, Field::kMaHz},
      {Config{.position_bits = 0}, Field::kPositionBits},
      {Config{.position_bits = 33}, Field::kPositionBits},
      {Config{.channels = 0}, Field::kChannels},
      {Config{.channels = 0x1'0000}, Field::kChannels},
      {Config{.start = biss_axi::Start::kInternalClock}, Field::kSampleHz}};
  for (const auto& [wrong, field] : cases) {
    const auto result = device.configure(wrong);
    EXPECT_EQ(result.error(), biss_axi::Error::kConfig);
    EXPECT_EQ(result.info().field, field);
  }
  for (unsigned address = 0; address < 0x40; address += 4) {
    EXPECT_EQ(bench.read(static_cast<std::uint8_t>(address)), 0U);
  }
}

TEST_F(AxiDriver, InternalClock_SamplesAtItsFrequency) {
  config.channels = 3;
  config.start = biss_axi::Start::kInternalClock;
  config.sample_hz = 20'000;
  ASSERT_TRUE(device.configure(config).ok());
  bench.simulator.advance(sim::kPsPerSecond / 100);
  EXPECT_NEAR(static_cast<double>(bench.host.beats_waiting()), 200.0, 1.0);
}

// ---- the page, [chip] features = "full"
// ----------------------------------------------------------

std::string full(const std::string& text) { return with_features(text, "full"); }

// With counters nothing is reset, and a request in a timeout is made again.
TEST_F(AxiDriver, ReadSingleWithCounters_ResetsNothingAndWaitsForTheTimeout) {
  Driven paged(
      full(axi_scenario({{.delay_ns = 35, .slave = "timeout = 30\n"}, {.delay_ns = 435}})));
  biss_axi::Page page(paged.port);
  EXPECT_EQ(page.features().value_or(0) & 0x1FFU, 0x1FFU);
  paged.config.channels = 3;
  ASSERT_TRUE(paged.device.configure(paged.config).ok());
  for (std::uint32_t n = 1; n <= 10; ++n) {
    paged.bench.simulator.slave(1)->set_data(raw_word(n));
    paged.bench.simulator.slave(2)->set_data(raw_word(1000 + n));
    EXPECT_EQ(paged.device.read_single(1).value_or(0), 1000 + n);
    EXPECT_EQ(paged.device.position(0).value_or(0), n);
  }
  EXPECT_EQ(page.counters(0)->frames, 10U);
  EXPECT_EQ(page.counters(1)->frames, 10U);
  EXPECT_GT(page.skipped_starts().value_or(0), 0U);
  EXPECT_EQ(paged.device.read_all().value_or(0), 3U);
  // An encoder that is gone, or whose SLO is 0: no old word, and no wait for the longest frame.
  paged.bench.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 0\n");
  paged.bench.simulator.advance(100 * sim::kPsPerUs);
  const sim::Time begin = paged.bench.simulator.now();
  EXPECT_EQ(paged.device.read_all().value_or(0), 2U);
  EXPECT_LT(paged.bench.simulator.now() - begin, 60 * sim::kPsPerUs);
  EXPECT_EQ(paged.device.position(0).error(), biss_axi::Error::kNoData);
  paged.bench.simulator.inject("[[fault]]\nkind = \"stuck\"\nchannel = 2\nlevel = 0\nat_us = 0\n");
  paged.bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(paged.device.read_all().value_or(9), 0U);
  EXPECT_EQ(page.counters(1)->late_starts, 1U);
}

// Without VALID_UNTIL_REQUEST the flag of an old word stays, so the driver resets as without the
// page.
TEST_F(AxiDriver, MasterThatKeepsValid_IsReadWithAReset) {
  Driven keeps(full(axi_scenario({{}}, 100'000'000, "", "VALID_UNTIL_REQUEST = false\n")));
  ASSERT_TRUE(keeps.device.configure(keeps.config).ok());
  keeps.bench.simulator.slave(1)->set_data(raw_word(5));
  EXPECT_EQ(keeps.device.read_single(0).value_or(0), 5U);
  keeps.bench.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 0\n");
  keeps.bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(keeps.device.read_single(0).error(), biss_axi::Error::kTimeout);
}

TEST_F(AxiDriver, SwitchesOfTheMaster_AreMembersOfTheConfiguration) {
  Driven other(
      axi_scenario(two(), 100'000'000, "", "ENABLE_ACTIVE_LOW = true\nCRC_BIT_IGNORES = true\n"));
  other.config.channels = 2;
  other.config.enable_active_low = other.config.crc_bit_ignores = true;
  ASSERT_TRUE(other.device.configure(other.config).ok());
  other.bench.simulator.slave(2)->set_data(raw_word(77));
  const auto frames = other.bench.frames(1);
  EXPECT_EQ(other.device.read_single(1).value_or(0), 77U);
  EXPECT_EQ(other.bench.frames(1), frames);
  other.bench.simulator.inject(
      "[[fault]]\nkind = \"bit-flip\"\nchannel = 2\nat_us = 0\nbits = [5]\n");
  EXPECT_EQ(other.device.read_single(1).error(), biss_axi::Error::kTimeout);
}

TEST_F(AxiDriver, Page_ReachesEveryExtra) {
  using biss_axi::AccessState;
  Driven wide(full(axi_scenario(
      {{.bits = 40, .delay_ns = 155, .slave = "crc_start = 3\nregisters = { 0x20 = [0x5A] }\n"}})));
  biss_axi::Page page(wide.port);
  wide.config.position_bits = 40;
  EXPECT_EQ(wide.device.configure(wide.config).info().field, biss_axi::Field::kPositionBits);
  wide.config.wide = true;
  ASSERT_TRUE(wide.device.configure(wide.config).ok());
  ASSERT_TRUE(page.set_crc(0x43, 3).ok());
  EXPECT_EQ(page.set_crc(1, 0).error(), biss_axi::Error::kConfig);
  EXPECT_EQ(page.set_crc(0x20000, 0).error(), biss_axi::Error::kConfig);
  wide.bench.simulator.slave(1)->set_data(raw_word(0xA5'1234'5678));
  EXPECT_EQ(wide.device.read_single(0).value_or(0), 0x1234'5678U);
  EXPECT_EQ(page.position(0).value_or(0), 0xA5'1234'5678U);
  EXPECT_EQ(page.position(1).error(), biss_axi::Error::kNoData);
  const auto stamp = page.sample_time();
  const auto now = page.time();
  ASSERT_TRUE(stamp.ok() && now.ok());
  EXPECT_GT(*now, *stamp);
  EXPECT_LT(*now, *stamp + 2000);
  EXPECT_EQ(page.take_events().value_or(0), biss_axi::kEventFrame);
  ASSERT_TRUE(page.enable_interrupt(biss_axi::kEventError).ok());
  ASSERT_TRUE(page.watch_delay(0, 20, 3).ok());  // it is 15
  EXPECT_TRUE(wide.device.read_single(0).ok());
  EXPECT_TRUE(wide.bench.pin("irq"));
  EXPECT_EQ(page.take_alarms().value_or(0), 1U);
  EXPECT_EQ(page.take_alarms().value_or(9), 0U);
  ASSERT_TRUE(page.set_timeout(1'000, true).ok());
  EXPECT_EQ(wide.bench.read(axireg::kAddrTimeout), 1U << 31U | 1'000U);
  EXPECT_EQ(page.set_timeout(1'048'576, true).error(), biss_axi::Error::kConfig);
  const auto finish = [&] {
    for (int i = 0; i < 200; ++i) {
      EXPECT_TRUE(wide.device.read_single(0).ok());
      const auto result = page.access_result();
      if (result->state != AccessState::kRunning) return *result;
    }
    return biss_axi::AccessResult{};
  };
  ASSERT_TRUE(page.begin_access({.address = 0x20}).ok());
  EXPECT_EQ(page.begin_access({.address = 0x21}).error(), biss_axi::Error::kConfig) << "one runs";
  const auto got = finish();
  EXPECT_EQ(got.state, AccessState::kDone);
  EXPECT_EQ(got.value, 0x5A);
  ASSERT_TRUE(page.begin_access({.address = 0x22, .write = true, .value = 0xC7}).ok());
  EXPECT_EQ(finish().state, AccessState::kDone);
  EXPECT_EQ(wide.bench.simulator.slave(1)->reg_read(0x22), 0xC7);
  ASSERT_TRUE(page.begin_access({.address = 0x22}).ok());
  ASSERT_TRUE(page.end_access().ok());
  EXPECT_EQ(page.access_result()->state, AccessState::kFailed);
  EXPECT_EQ(page.begin_access({.channel = 16}).error(), biss_axi::Error::kChannel);
  EXPECT_EQ(page.begin_access({.address = 0x80}).error(), biss_axi::Error::kConfig);
  EXPECT_EQ(page.begin_access({.slave = 8}).error(), biss_axi::Error::kConfig);
  wide.bench.simulator.slave(1)->set_data(std::uint64_t{0xA5'1234'5679} << 2U | 1U);
  EXPECT_EQ(wide.device.read_single(0).error(), biss_axi::Error::kSlaveError);
  EXPECT_EQ(page.position(0).error(), biss_axi::Error::kSlaveError);
  EXPECT_EQ(page.position(0).reading().position, 0xA5'1234'5679U);
}

TEST_F(AxiDriver, MasterWithoutPage_HasNoFeatures) {
  biss_axi::Page page(port);
  EXPECT_EQ(page.features().value_or(9), 0U);
}

TEST_F(AxiDriver, CallsOfTheManual_DoWhatItPrints) {
  world = {&bench};
  ASSERT_EQ(BISS_C_Init(7), 0);
  EXPECT_EQ(bench.read(axireg::kAddrMaDivider), 5U);  // 10 MHz
  ASSERT_EQ(BISS_C_ConfigPositionDatabits(7, 26), 0);
  ASSERT_EQ(BISS_C_ConfigChannels(7, 0x3), 0);
  ASSERT_EQ(BISS_C_ConfigMAClk(7, 10), 0);
  EXPECT_EQ(bench.read(axireg::kAddrMaDivider), 10U);
  bench.simulator.slave(1)->set_data(raw_word(0x111));
  bench.simulator.slave(2)->set_data(raw_word(0x222));
  unsigned data = 0;
  bool valid = false;
  ASSERT_EQ(BISS_C_ReadSinglePoint(7, 1, &data, &valid), 0);
  EXPECT_TRUE(valid);
  EXPECT_EQ(data, 0x222U);
  int ticks = -1;
  ASSERT_EQ(BISS_C_CheckAjustDelay(7, 1, &ticks), 0);
  EXPECT_NEAR(ticks, 43, 1);
  // 1 = ignore: 0x1C becomes 0.
  ASSERT_EQ(BISS_C_IgnoreCRC(7, 1), 0);
  EXPECT_EQ(bench.read(axireg::kAddrCrcCheck), 0U);
  ASSERT_EQ(BISS_C_IgnoreCRC(7, 0), 0);
  EXPECT_EQ(bench.read(axireg::kAddrCrcCheck), 1U);
  clocked(bench.simulator.line(1))->faults().stick(true);
  bench.simulator.refresh_lines();
  ASSERT_EQ(BISS_C_ReadSinglePoint(7, 0, &data, &valid), 0);
  EXPECT_FALSE(valid);
  EXPECT_EQ(data, 0U);
  ASSERT_EQ(BISS_C_ConfigSampleClk(7, 2500, false), 0);
  EXPECT_EQ(bench.read(axireg::kAddrSampleDivider), 2500U);
  EXPECT_EQ(bench.read(axireg::kAddrMode), 0U);
  ASSERT_EQ(BISS_C_ConfigSampleClk(7, 0, true), 0);
  EXPECT_EQ(bench.read(axireg::kAddrSampleClock), 1U);
  const unsigned writes = world.writes;
  EXPECT_NE(BISS_C_ConfigMAClk(7, 0), 0);
  EXPECT_NE(BISS_C_ConfigMAClk(7, 256), 0);
  EXPECT_NE(BISS_C_ConfigPositionDatabits(7, 33), 0);
  EXPECT_NE(BISS_C_ConfigChannels(7, -1), 0);
  EXPECT_NE(BISS_C_ConfigSampleClk(7, 0, false), 0);
  EXPECT_NE(BISS_C_ReadSinglePoint(7, 16, &data, &valid), 0);
  EXPECT_NE(BISS_C_CheckAjustDelay(7, 0, nullptr), 0);
  EXPECT_EQ(world.writes, writes);
  world.bus_fails = true;
  EXPECT_EQ(BISS_C_Init(7), BISS_C_BUS);
  EXPECT_EQ(BISS_C_ReadSinglePoint(7, 0, &data, &valid), BISS_C_BUS);
  world = {};
}

}  // namespace
}  // namespace mb4test

int biss_c_port_write(int hdev, uint32_t offset, uint32_t value) {
  using mb4test::world;
  ++world.writes;
  if (hdev != 7 || world.bus_fails) return 1;
  return world.bench->host.write(static_cast<std::uint8_t>(offset), value) == std::uint8_t{0} ? 0
                                                                                              : 1;
}
int biss_c_port_read(int hdev, uint32_t offset, uint32_t* value) {
  using mb4test::world;
  if (hdev != 7 || world.bus_fails) return 1;
  return world.bench->host.read(static_cast<std::uint8_t>(offset), *value) == std::uint8_t{0} ? 0
                                                                                              : 1;
}
uint32_t biss_c_port_now_us(int /*hdev*/) {
  return static_cast<uint32_t>(mb4test::world.bench->simulator.now() / mb4::sim::kPsPerUs);
}
uint32_t biss_c_port_clk_hz(int /*hdev*/) { return 100'000'000; }
