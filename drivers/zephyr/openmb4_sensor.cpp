// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Zephyr's sensor API on the C++ driver. sensor_sample_fetch() makes one frame and reads it,
// sensor_channel_get() converts it. Both may be called from several threads, not from an interrupt.
//
// sensor_sample_fetch() returns 0 or a negative error: -EIO, SPI does not work or no chip answers;
// -ETIMEDOUT, a frame did not end; -EBADMSG, the encoder is silent or its CRC is wrong; -EPROTO,
// the encoder itself reports an error (nE = 0); -ENOTSUP, no such channel. The last good sample
// stays; after -EPROTO SENSOR_CHAN_OPENMB4_FLAGS is that of the word that was refused.
// sensor_channel_get() returns -ENODATA before the first good sample. If the chip does not answer,
// while the system starts or later, the next fetch configures it again.

#define DT_DRV_COMPAT openmb4_ic_mb4

#include <errno.h>
#include <zephyr/device.h>
#include <zephyr/devicetree.h>
#include <zephyr/drivers/sensor.h>
#include <zephyr/kernel.h>

#include <cstdint>
#include <new>
#include <type_traits>

#include "mb4/mb4.hpp"
#include "mb4/ports/zephyr.hpp"
#include "openmb4/sensor.h"

namespace {

using Chip = mb4::Device<mb4::ports::ZephyrBus, mb4::ports::ZephyrClock>;

struct Settings {
  spi_dt_spec spi;
  const mb4::Config* config;
  std::uint8_t single_turn_bits;
};

struct Parts {
  explicit Parts(const spi_dt_spec& spi) : bus(spi), chip(bus, clock) {}
  mb4::ports::ZephyrBus bus;
  mb4::ports::ZephyrClock clock;
  Chip chip;
};

// Zephyr runs the constructors of static objects after it has started its devices. So start() makes
// the parts, in memory that has no constructor.
struct State {
  k_mutex lock;
  alignas(Parts) unsigned char memory[sizeof(Parts)];
  Parts* parts;
  bool configured;
  bool sampled;
  bool told;           // flags are there
  std::uint8_t flags;  // bit 0: nE = 0, bit 1: nW = 0
  mb4::Reading reading;
};
static_assert(std::is_trivially_destructible_v<State>, "nothing runs at exit");

struct Lock {
  explicit Lock(State& locked) : state(locked) { k_mutex_lock(&state.lock, K_FOREVER); }
  ~Lock() { k_mutex_unlock(&state.lock); }
  State& state;
};

constexpr mb4::Config make_config(bool own_clock, std::uint32_t clock_hz, std::uint32_t ma_hz,
                                  bool ssi, const mb4::SlaveConfig& encoder) {
  mb4::Config config;
  config.clock_source = own_clock ? mb4::ClockSource::kInternal : mb4::ClockSource::kExternal;
  config.f_clk_hz = clock_hz;
  config.ma_hz = mb4::ma_hz_at_most(clock_hz, ma_hz);
  config.channels[0].protocol = ssi ? mb4::Protocol::kSsi : mb4::Protocol::kBissC;
  config.slaves[0] = encoder;
  return config;
}

// The devicetree has 32 bits for each of them; what does not fit makes an invalid configuration.
constexpr mb4::SlaveConfig make_encoder(std::uint32_t data_bits, bool flags,
                                        std::uint32_t crc_polynomial, std::uint32_t crc_start,
                                        bool gray) {
  mb4::SlaveConfig encoder;
  encoder.enabled = true;
  encoder.data_bits =
      static_cast<std::uint8_t>(data_bits <= 64 && crc_start <= UINT16_MAX ? data_bits : 0);
  encoder.flags = flags ? mb4::Flags::kErrorWarning : mb4::Flags::kNone;
  encoder.crc_polynomial = crc_polynomial;
  encoder.crc_start = static_cast<std::uint16_t>(crc_start);
  encoder.gray = gray;
  return encoder;
}

int to_errno(mb4::Error error) {
  switch (error) {
    case mb4::Error::kNone:
      return 0;
    case mb4::Error::kTimeout:
      return -ETIMEDOUT;
    case mb4::Error::kCrc:
    case mb4::Error::kNoData:
    case mb4::Error::kNoWord:
    case mb4::Error::kLineError:
      return -EBADMSG;
    case mb4::Error::kSlaveError:
      return -EPROTO;
    default:
      return -EIO;
  }
}

State& state_of(const device* dev) { return *static_cast<State*>(dev->data); }
const Settings& settings_of(const device* dev) {
  return *static_cast<const Settings*>(dev->config);
}

int configure(const device* dev) {
  State& state = state_of(dev);
  if (state.configured) return 0;
  const mb4::Result<void> done = state.parts->chip.configure(*settings_of(dev).config);
  state.configured = done.ok();
  return to_errno(done.error());
}

int start(const device* dev) {
  State& state = state_of(dev);
  k_mutex_init(&state.lock);
  if (!spi_is_ready_dt(&settings_of(dev).spi)) return -ENODEV;
  state.configured = state.sampled = state.told = false;
  state.parts = new (state.memory) Parts(settings_of(dev).spi);
  static_cast<void>(configure(dev));  // the next fetch tries again
  return 0;
}

bool is_known(sensor_channel channel) {
  switch (static_cast<int>(channel)) {
    case SENSOR_CHAN_ALL:
    case SENSOR_CHAN_ROTATION:
    case SENSOR_CHAN_OPENMB4_POSITION:
    case SENSOR_CHAN_OPENMB4_TURNS:
    case SENSOR_CHAN_OPENMB4_FLAGS:
      return true;
    default:
      return false;
  }
}

int fetch(const device* dev, sensor_channel channel) {
  if (!is_known(channel)) return -ENOTSUP;
  const Lock lock(state_of(dev));
  State& state = lock.state;
  if (const int error = configure(dev); error != 0) return error;
  const mb4::Result<mb4::Reading> frame = state.parts->chip.read_frame();
  if (frame.has_reading()) {
    const mb4::Reading& sent = frame.reading();
    state.flags =
        static_cast<std::uint8_t>((sent.slave_error ? 1U : 0U) | (sent.slave_warning ? 2U : 0U));
    state.told = true;
  }
  if (!frame.ok()) {
    const int error = to_errno(frame.error());
    state.configured = error != -EIO;  // the chip may have lost its supply
    return error;
  }
  state.reading = *frame;
  state.sampled = true;
  return 0;
}

void set_angle(std::uint64_t in_turn, std::uint8_t bits, sensor_value* value) {
  constexpr std::uint64_t kDegrees = 360;
  constexpr std::uint64_t kMicro = 1'000'000;
  const std::uint64_t parts = in_turn * kDegrees;  // of a turn, 2^bits; at most 41 bits
  value->val1 = static_cast<std::int32_t>(parts >> bits);
  value->val2 = static_cast<std::int32_t>(((parts & enc::low_bits(bits)) * kMicro) >> bits);
}

int get(const device* dev, sensor_channel channel, sensor_value* value) {
  if (!is_known(channel) || channel == SENSOR_CHAN_ALL) return -ENOTSUP;
  const Lock lock(state_of(dev));
  const State& state = lock.state;
  if (static_cast<int>(channel) == SENSOR_CHAN_OPENMB4_FLAGS) {
    if (!state.told) return -ENODATA;
    value->val1 = state.flags;
    value->val2 = 0;
    return 0;
  }
  if (!state.sampled) return -ENODATA;
  const std::uint8_t bits = settings_of(dev).single_turn_bits;
  const std::uint64_t position = state.reading.position;
  value->val2 = 0;
  switch (static_cast<int>(channel)) {
    case SENSOR_CHAN_ROTATION:
      set_angle(position & enc::low_bits(bits), bits, value);
      break;
    case SENSOR_CHAN_OPENMB4_TURNS:
      if (position >> bits > INT32_MAX) return -ERANGE;
      value->val1 = static_cast<std::int32_t>(position >> bits);
      break;
    default:
      value->val1 = static_cast<std::int32_t>(static_cast<std::uint32_t>(position));
      value->val2 = static_cast<std::int32_t>(static_cast<std::uint32_t>(position >> 32));
      break;
  }
  return 0;
}

constexpr sensor_driver_api make_api() {
  sensor_driver_api made{};
  made.sample_fetch = fetch;
  made.channel_get = get;
  return made;
}

// Zephyr 4 wants drivers' tables in a section of their own.
#ifdef DEVICE_API
DEVICE_API(sensor, api) = make_api();
#else
constexpr sensor_driver_api api = make_api();
#endif

}  // namespace

#define OPENMB4_IS_SSI(inst) DT_INST_ENUM_IDX(inst, protocol) == 1
#define OPENMB4_DEFINE(inst)                                                                       \
  static constexpr mb4::Config openmb4_config_##inst =                                             \
      make_config(!DT_INST_NODE_HAS_PROP(inst, clock_frequency),                                   \
                  DT_INST_PROP_OR(inst, clock_frequency, 20000000),                                \
                  DT_INST_PROP(inst, ma_frequency), OPENMB4_IS_SSI(inst),                          \
                  make_encoder(DT_INST_PROP(inst, data_bits), !DT_INST_PROP(inst, no_flags),       \
                               DT_INST_PROP(inst, crc_polynomial), DT_INST_PROP(inst, crc_start),  \
                               DT_INST_PROP(inst, gray_code)));                                    \
  static_assert(mb4::validate(openmb4_config_##inst).ok(),                                         \
                "openmb4,ic-mb4: the chip cannot do what the devicetree asks for");                \
  static_assert(                                                                                   \
      DT_INST_PROP(inst, single_turn_bits) >= 1 && DT_INST_PROP(inst, single_turn_bits) <= 32,     \
      "openmb4,ic-mb4: single-turn-bits is 1 to 32");                                              \
  static State openmb4_state_##inst = {};                                                          \
  static const Settings openmb4_settings_##inst = {                                                \
      SPI_DT_SPEC_INST_GET(inst, SPI_WORD_SET(8) | SPI_TRANSFER_MSB, 0), &openmb4_config_##inst,   \
      DT_INST_PROP(inst, single_turn_bits)};                                                       \
  SENSOR_DEVICE_DT_INST_DEFINE(inst, start, nullptr, &openmb4_state_##inst,                        \
                               &openmb4_settings_##inst, POST_KERNEL, CONFIG_SENSOR_INIT_PRIORITY, \
                               &api);

DT_INST_FOREACH_STATUS_OKAY(OPENMB4_DEFINE)
