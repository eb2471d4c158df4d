// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The C binding of dsl.h.

#include <algorithm>
#include <cstdint>
#include <new>
#include <type_traits>

#include "dsl.h"
#include "dsl/device.hpp"
#include "dsl/messages.hpp"
#include "dsl/resources.hpp"

namespace {

static_assert(static_cast<int>(dsl::Error::kBus) == DSL_BUS);
static_assert(static_cast<int>(dsl::Error::kUncertain) == DSL_UNCERTAIN);
static_assert(static_cast<int>(dsl::Error::kSafeDiffers) == DSL_SAFE_DIFFERS);
static_assert(static_cast<int>(dsl::Error::kEncoder) == DSL_ENCODER);

// Bus and clock of the caller.
struct Outside {
  dsl_port port;
  bool read(std::uint32_t offset, std::uint32_t& word) {
    return port.read(port.context, offset, &word);
  }
  bool write(std::uint32_t offset, std::uint8_t byte) {
    return port.write(port.context, offset, byte);
  }
  std::uint32_t now_us() { return port.now_us(port.context); }
};

using Talk = dsl::Messages<Outside, Outside>;

struct Opened {
  explicit Opened(const dsl_port& port)
      : outside{port},
        device(outside),
        main(device, outside, dsl::Host::kMain),
        safe(device, outside, dsl::Host::kSafe) {}
  Talk& host(dsl_host which) { return which == DSL_SAFE_HOST ? safe : main; }

  Outside outside;
  dsl::Device<Outside> device;
  Talk main;
  Talk safe;
};

static_assert(sizeof(Opened) <= sizeof(dsl_master), "dsl: dsl_master in dsl.h is too small");
static_assert(alignof(Opened) <= alignof(dsl_master));
static_assert(std::is_trivially_destructible_v<Opened>);

Opened& of(dsl_master* master) { return *reinterpret_cast<Opened*>(master->opaque); }

dsl_result to_c(dsl::ErrorInfo info) { return {static_cast<dsl_error>(info.code), info.encoder}; }

dsl_result to_c(const dsl::Result<void>& result) { return to_c(result.info()); }

// The value as `convert` makes it of the driver's.
template <typename T, typename C, typename Convert>
dsl_result store(const dsl::Result<T>& result, C* out, Convert convert) {
  if (result) *out = convert(*result);
  return to_c(result.info());
}

template <typename T>
dsl_result store(const dsl::Result<T>& result, T* out) {
  return store(result, out, [](const T& value) { return value; });
}

dsl::LongRequest from_c(const dsl_long_request& request) {
  dsl::LongRequest made;
  made.resource = request.resource;
  made.write = request.write;
  made.indirect = request.indirect;
  made.offset = request.offset;
  made.size = request.size;
  std::copy(std::begin(request.data), std::end(request.data), made.data.begin());
  return made;
}

dsl_long_answer answer_to_c(const dsl::LongAnswer& answer) {
  dsl_long_answer made{};
  made.size = answer.size;
  std::copy(answer.data.begin(), answer.data.end(), std::begin(made.data));
  return made;
}

dsl_resource resource_to_c(const dsl::Resource& resource) {
  dsl_resource made{};
  made.id = resource.id;
  std::copy(resource.name.begin(), resource.name.end(), std::begin(made.name));
  made.size = resource.size;
  made.read_level = resource.read_level;
  made.write_level = resource.write_level;
  made.time_ms = resource.time_ms;
  made.type = static_cast<std::uint8_t>(resource.type);
  return made;
}

}  // namespace

void dsl_open(dsl_master* master, const dsl_port* port) {
  ::new (static_cast<void*>(master->opaque)) Opened(*port);
}

dsl_result dsl_start(dsl_master* master) { return to_c(of(master).device.start()); }
dsl_result dsl_stop(dsl_master* master) { return to_c(of(master).device.stop()); }
dsl_result dsl_linked(dsl_master* master, bool* linked) {
  return store(of(master).device.linked(), linked);
}
dsl_result dsl_wait_for_link(dsl_master* master, uint32_t limit_us, dsl_encoder* encoder) {
  Opened& opened = of(master);
  return store(opened.device.wait_for_link(opened.outside, limit_us), encoder,
               [](const dsl::Encoder& found) {
                 return dsl_encoder{found.position_bits, found.acceleration_bits, found.is_signed};
               });
}
dsl_result dsl_read_position(dsl_master* master, dsl_position* position) {
  dsl::Position now;
  const dsl::Error error = of(master).device.read_position(now);
  if (error == dsl::Error::kNone) *position = {now.position, now.speed, now.frame, now.quality};
  return to_c(dsl::ErrorInfo(error));
}
dsl_safe_rules dsl_safe_rules_default(void) {
  const dsl::SafeRules rules;
  return {rules.bits2, rules.tolerance, rules.max_age, rules.bad_states};
}
dsl_result dsl_read_safe(dsl_master* master, const dsl_safe_rules* rules,
                         dsl_safe_position* position) {
  dsl::SafeRules made;
  made.bits2 = rules->bits2;
  made.tolerance = rules->tolerance;
  made.max_age = rules->max_age;
  made.bad_states = rules->bad_states;
  return store(of(master).device.safe(made), position, [](const dsl::SafePosition& safe) {
    return dsl_safe_position{safe.position, safe.summary, safe.toggle, safe.age};
  });
}
dsl_result dsl_read_quality(dsl_master* master, dsl_quality* quality) {
  return store(of(master).device.quality(), quality, [](const dsl::Quality& now) {
    return dsl_quality{now.quality,        now.rssi,     now.delay_bits,   now.edges,
                       now.restart_reason, now.restarts, now.illegal_words};
  });
}
dsl_result dsl_take_events(dsl_master* master, dsl_events* events) {
  return store(of(master).device.take_events(), events, [](const dsl::Events& now) {
    return dsl_events{now.high, now.low, now.safe};
  });
}
dsl_result dsl_mask_events(dsl_master* master, const dsl_events* events, uint8_t summary) {
  dsl::Events made;
  made.high = events->high;
  made.low = events->low;
  made.safe = events->safe;
  return to_c(of(master).device.mask_events(made, summary));
}
dsl_result dsl_enable_interrupts(dsl_master* master, uint8_t mask) {
  return to_c(of(master).device.enable_interrupts(mask));
}
dsl_result dsl_take_interrupts(dsl_master* master, uint8_t* pending) {
  return store(of(master).device.take_interrupts(), pending);
}

dsl_result dsl_short_read(dsl_master* master, dsl_host host, uint8_t address, uint32_t limit_us,
                          uint8_t* value) {
  return store(of(master).host(host).read(address, limit_us), value);
}
dsl_result dsl_short_write(dsl_master* master, dsl_host host, uint8_t address, uint8_t value,
                           uint32_t limit_us) {
  return to_c(of(master).host(host).write(address, value, limit_us));
}
dsl_result dsl_short_begin_read(dsl_master* master, dsl_host host, uint8_t address,
                                uint32_t limit_us) {
  return to_c(of(master).host(host).begin_read(address, limit_us));
}
dsl_result dsl_short_begin_write(dsl_master* master, dsl_host host, uint8_t address, uint8_t value,
                                 uint32_t limit_us) {
  return to_c(of(master).host(host).begin_write(address, value, limit_us));
}
dsl_result dsl_short_poll(dsl_master* master, dsl_host host, uint8_t* value) {
  return store(of(master).host(host).poll_short(), value);
}

dsl_result dsl_ask(dsl_master* master, const dsl_long_request* request, uint32_t limit_us,
                   dsl_long_answer* answer) {
  return store(of(master).main.ask(from_c(*request), limit_us), answer, answer_to_c);
}
dsl_result dsl_long_begin(dsl_master* master, const dsl_long_request* request, uint32_t limit_us) {
  return to_c(of(master).main.begin(from_c(*request), limit_us));
}
dsl_result dsl_long_poll(dsl_master* master, dsl_long_answer* answer) {
  return store(of(master).main.poll_long(), answer, answer_to_c);
}
dsl_result dsl_reset_messages(dsl_master* master) {
  return to_c(of(master).device.reset_messages());
}

dsl_result dsl_describe(dsl_master* master, uint16_t id, uint32_t limit_us,
                        dsl_resource* resource) {
  return store(dsl::describe(of(master).main, id, limit_us), resource, resource_to_c);
}
dsl_result dsl_walk(dsl_master* master, uint32_t limit_us,
                    void (*found)(void* context, const dsl_resource* resource, unsigned depth),
                    void* context) {
  return to_c(dsl::walk(of(master).main, limit_us,
                        [found, context](const dsl::Resource& resource, unsigned depth) {
                          const dsl_resource made = resource_to_c(resource);
                          found(context, &made, depth);
                        }));
}

dsl_result dsl_read_byte(dsl_master* master, uint8_t address, uint8_t* value) {
  std::uint32_t word = 0;
  if (!of(master).outside.read(dsl::word_of(address), word)) return {DSL_BUS, 0};
  *value = dsl::byte_of(word, address);
  return {DSL_OK, 0};
}
dsl_result dsl_write_byte(dsl_master* master, uint8_t address, uint8_t value) {
  return {of(master).outside.write(address, value) ? DSL_OK : DSL_BUS, 0};
}
