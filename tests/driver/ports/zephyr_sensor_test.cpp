// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Zephyr's sensor driver (drivers/zephyr) on the simulated chip. The headers of Zephyr are stubs,
// so this shows what the driver does, not that Zephyr builds it.
#include <errno.h>
#include <gtest/gtest.h>
#include <openmb4/sensor.h>
#include <zephyr/drivers/spi.h>
#include <zephyr/kernel.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/lines/slave.hpp"

namespace {

mb4::sim::Simulator* chip = nullptr;  // null: SPI does not work
bool ready = true;
int locks = 0;
std::uint32_t fastest_hz = 0;

// The encoder of the devicetree that the test is compiled with.
constexpr char kEncoder[] = R"(
[[channel]]
number = 1
[[channel.slave]]
protocol = "biss-c"
data_bits = 30
crc = 0x43
data = 3
)";

constexpr auto kPosition = static_cast<sensor_channel>(SENSOR_CHAN_OPENMB4_POSITION);
constexpr auto kTurns = static_cast<sensor_channel>(SENSOR_CHAN_OPENMB4_TURNS);
constexpr auto kFlags = static_cast<sensor_channel>(SENSOR_CHAN_OPENMB4_FLAGS);

}  // namespace

extern "C" {

bool spi_is_ready_dt(const spi_dt_spec* /*spec*/) { return ready; }
int spi_transceive_dt(const spi_dt_spec* spec, const spi_buf_set* tx, const spi_buf_set* rx) {
  if (chip == nullptr) return -EIO;
  fastest_hz = spec->config.frequency > fastest_hz ? spec->config.frequency : fastest_hz;
  const auto* const bytes = static_cast<const std::uint8_t*>(tx->buffers[0].buf);
  std::vector<std::uint8_t> received(tx->buffers[0].len);
  chip->spi().transfer(std::span(bytes, received.size()), received);
  if (rx != nullptr) std::memcpy(rx->buffers[0].buf, received.data(), rx->buffers[0].len);
  return 0;
}
std::uint32_t k_cycle_get_32(void) {
  if (chip == nullptr) return 0;
  chip->advance(100 * mb4::sim::kPsPerNs);
  return static_cast<std::uint32_t>(chip->now() * 16 / 1'000'000);
}
std::uint32_t sys_clock_hw_cycles_per_sec(void) { return 16'000'000; }
int k_mutex_init(k_mutex* mutex) {
  mutex->count = 0;
  return 0;
}
int k_mutex_lock(k_mutex* mutex, k_timeout_t /*timeout*/) {
  ++locks;
  return ++mutex->count == 1 ? 0 : -EBUSY;
}
int k_mutex_unlock(k_mutex* mutex) { return --mutex->count == 0 ? 0 : -EINVAL; }

}  // extern "C"

namespace {

class ZephyrSensor : public testing::Test {
 protected:
  ZephyrSensor() : simulator(mb4::sim::parse_scenario(kEncoder, "test.toml")) {
    chip = &simulator;
    ready = true;
    locks = 0;
  }
  ~ZephyrSensor() override { chip = nullptr; }

  int start() { return dev->init(dev); }
  int get(sensor_channel channel) { return sensor_channel_get(dev, channel, &value); }

  mb4::sim::Simulator simulator;
  const device* const dev = &zephyr_device_0;
  sensor_value value{77, 77};
};

TEST_F(ZephyrSensor, BeforeTheFirstSample_ThereIsNoData) {
  ASSERT_EQ(start(), 0);
  EXPECT_EQ(get(SENSOR_CHAN_ROTATION), -ENODATA);
  EXPECT_EQ(value.val1, 77);
}

// Of 30 data bits two are flags and 26 one turn, so two count turns.
TEST_F(ZephyrSensor, Sample_IsAnglePositionTurnsAndFlags) {
  ASSERT_EQ(start(), 0);
  const struct {
    std::uint32_t turns, angle, flags;
    std::int32_t degrees, micro, bits;
  } rows[] = {{0, 0, 3, 0, 0, 0},
              {1, 1U << 25, 3, 180, 0, 0},
              {3, 0x3FF'FFFF, 2, 359, 999'994, 2},  // 360 / 2^26 below a turn; nW is 0
              {2, 1, 3, 0, 5, 0}};
  for (const auto& row : rows) {
    const std::uint32_t position = row.turns << 26 | row.angle;
    ASSERT_TRUE(simulator.slave(1)->set_data(position << 2 | row.flags));
    ASSERT_EQ(sensor_sample_fetch(dev), 0);
    ASSERT_EQ(get(SENSOR_CHAN_ROTATION), 0);
    EXPECT_EQ(value.val1, row.degrees);
    EXPECT_EQ(value.val2, row.micro);
    ASSERT_EQ(get(kPosition), 0);
    EXPECT_EQ(value.val1, static_cast<std::int32_t>(position));
    EXPECT_EQ(value.val2, 0);
    ASSERT_EQ(get(kTurns), 0);
    EXPECT_EQ(value.val1, static_cast<std::int32_t>(row.turns));
    ASSERT_EQ(get(kFlags), 0);
    EXPECT_EQ(value.val1, row.bits);
  }
  EXPECT_EQ(fastest_hz, 5'000'000U);
  EXPECT_EQ(locks, 4 * 5);
}

// The encoder's own error: fetch fails, flags tell it, and no channel has the position.
TEST_F(ZephyrSensor, SlaveError_IsAnErrorAndNoPosition) {
  ASSERT_EQ(start(), 0);
  ASSERT_TRUE(simulator.slave(1)->set_data(1000U << 2 | 1U));
  EXPECT_EQ(sensor_sample_fetch(dev), -EPROTO);
  EXPECT_EQ(get(kPosition), -ENODATA);
  ASSERT_EQ(get(kFlags), 0);
  EXPECT_EQ(value.val1, 1);
  ASSERT_TRUE(simulator.slave(1)->set_data(2000U << 2 | 3U));
  ASSERT_EQ(sensor_sample_fetch(dev), 0);
  ASSERT_TRUE(simulator.slave(1)->set_data(3000U << 2 | 0U));
  EXPECT_EQ(sensor_sample_fetch(dev), -EPROTO);
  ASSERT_EQ(get(kPosition), 0);
  EXPECT_EQ(value.val1, 2000);
  ASSERT_EQ(get(kFlags), 0);
  EXPECT_EQ(value.val1, 3);
}

TEST_F(ZephyrSensor, SilentEncoder_IsAnErrorAndTheLastSampleStays) {
  ASSERT_EQ(start(), 0);
  ASSERT_TRUE(simulator.slave(1)->set_data(0x1234'5677 & 0x3FFF'FFFF));
  ASSERT_EQ(sensor_sample_fetch(dev), 0);
  simulator.inject("[[fault]]\nkind = \"silent\"\nslave = 1\nat_us = 0\nfor_us = 20_000\n");
  const int error = sensor_sample_fetch(dev);
  EXPECT_TRUE(error == -EBADMSG || error == -ETIMEDOUT) << error;
  ASSERT_EQ(get(kPosition), 0);
  EXPECT_EQ(value.val1, (0x1234'5677 & 0x3FFF'FFFF) >> 2);
  simulator.advance(25'000 * mb4::sim::kPsPerUs);
  EXPECT_EQ(sensor_sample_fetch(dev), 0);
}

TEST_F(ZephyrSensor, ChipThatComesLate_IsConfiguredByTheNextFetch) {
  chip = nullptr;
  ASSERT_EQ(start(), 0);
  EXPECT_EQ(sensor_sample_fetch(dev), -EIO);
  chip = &simulator;
  EXPECT_EQ(sensor_sample_fetch(dev), 0);
  chip = nullptr;
  EXPECT_EQ(sensor_sample_fetch(dev), -EIO);
  // Another chip, which has not been configured.
  mb4::sim::Simulator next(mb4::sim::parse_scenario(kEncoder, "test.toml"));
  chip = &next;
  EXPECT_EQ(sensor_sample_fetch(dev), 0);
  EXPECT_EQ(next.slave(1)->frames(), 1U);
}

TEST_F(ZephyrSensor, WrongChannelAndBus_AreRefused) {
  ASSERT_EQ(start(), 0);
  const auto* const api = static_cast<const sensor_driver_api*>(dev->api);
  EXPECT_EQ(api->sample_fetch(dev, static_cast<sensor_channel>(3)), -ENOTSUP);
  EXPECT_EQ(get(static_cast<sensor_channel>(3)), -ENOTSUP);
  EXPECT_EQ(get(SENSOR_CHAN_ALL), -ENOTSUP);
  ready = false;
  EXPECT_EQ(start(), -ENODEV);
}

}  // namespace
