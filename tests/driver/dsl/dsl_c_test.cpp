// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C binding dsl.h and the published names of hdsl.h on the RTL.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/driver/dsl/dsl_program.h"
#include "tests/driver/dsl/dsl_rig.hpp"

namespace {

using mb4test::DslBus;
using mb4test::DslRig;

dsl_port port_of(DslBus& rig) {
  dsl_port port{};
  port.context = &rig;
  port.read = [](void* context, std::uint32_t offset, std::uint32_t* word) {
    return static_cast<DslBus*>(context)->read(offset, *word);
  };
  port.write = [](void* context, std::uint32_t offset, std::uint8_t byte) {
    return static_cast<DslBus*>(context)->write(offset, byte);
  };
  port.now_us = [](void* context) { return static_cast<DslBus*>(context)->now_us(); };
  return port;
}

void wait(void* context) { static_cast<DslBus*>(context)->frames(1); }

const char* const kResources =
    "access_level = 1\n"
    "[[channel.slave.resource]]\nid = 0x202\nname = \"TEMP\"\ntype = \"i16\"\nvalue = -5\n"
    "[[channel.slave.resource]]\nid = 0x203\nname = \"SECRET\"\ntype = \"u32\"\nvalue = 42\n"
    "read_level = 3\n"
    "[[channel.slave.resource]]\nid = 0x204\nname = \"TABLE\"\ntype = \"u16\"\nvalue = 9\n"
    "write_level = 1\n";

TEST(DslC, Program_ReadsWhatTheEncoderHas) {
  DslRig rig(kResources);
  dsl_program_report report{};
  const dsl_port port = port_of(rig);
  ASSERT_EQ(dsl_program(&port, wait, &report), 0);
  EXPECT_EQ(report.encoder.position_bits, mb4test::kDslBits);
  EXPECT_EQ(report.encoder.acceleration_bits, 11);
  EXPECT_TRUE(report.encoder.is_signed);
  EXPECT_EQ(report.quality.quality, 15);
  EXPECT_EQ(report.interrupts & 1, 1);
  EXPECT_EQ(report.ping[0], 0x41);
  EXPECT_EQ(report.ping[1], 0);  // of a write
  EXPECT_EQ(report.ping[2], 0x42);
  EXPECT_EQ(report.ping[3], 0x43);
  EXPECT_EQ(report.temp.size, 2);
  EXPECT_EQ(report.temp.data[0], 0xFF);
  EXPECT_EQ(report.temp.data[1], 0xFB);
  EXPECT_EQ(std::string(report.resource.name), "TEMP");
  EXPECT_EQ(report.resource.type, 0x08);
  // ROOT, seven of the encoder, three of the scenario: all of them are direct children of ROOT.
  EXPECT_EQ(report.resources, 11U);
  EXPECT_EQ(report.deepest, 1U);
  EXPECT_EQ(report.secret, 0x4112);
  EXPECT_EQ(report.wrong_address, DSL_ARGUMENT);
  EXPECT_EQ(report.published_error, -static_cast<int>(DSL_ARGUMENT));
  EXPECT_EQ(report.after_stop, DSL_NO_LINK);

  // By the published names.
  EXPECT_EQ(report.published_states[0], 0xFFFB);          // TEMP
  EXPECT_EQ(report.published_states[4], 15 << 8 | 0x8F);  // LINK and QM
  EXPECT_EQ(report.published_states[5] & 0xFF, 4);        // delay of 30 m and the encoder
  EXPECT_EQ(report.published_states[6] & 0xF, 11 - 8);    // bits of the acceleration
  EXPECT_EQ(report.published_states[7], 0);
  EXPECT_EQ(report.published_states[1] & 0x1000, 0x1000);  // a fixed bit
  // Safe position 2 is the inverse of safe position 1, in 40 bits.
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 40) - 1;
  EXPECT_EQ(report.published_position[1] ^ kMask, report.published_position[2]);
  const std::uint64_t fast = report.published_position[0] & ((1U << mb4test::kDslBits) - 1);
  bool known = false;
  for (const std::int64_t each : rig.truth)
    known |= (static_cast<std::uint64_t>(each) & ((1U << mb4test::kDslBits) - 1)) == fast;
  EXPECT_TRUE(known);
}

TEST(DslC, FailedBus_IsToldByEachCall) {
  DslRig rig;
  const dsl_port port = port_of(rig);
  dsl_master master;
  dsl_open(&master, &port);
  rig.arm({.fails = 0, .flips = {}, .hole = {}});
  EXPECT_EQ(HDSL_get_pos(&master, 0), ~std::uint64_t{0});
  rig.arm({.fails = 0, .flips = {}, .hole = {}});
  EXPECT_EQ(HDSL_set_pc_addr(&master, 0, 0, 0, 0), -static_cast<int>(DSL_BUS));
  rig.arm({.fails = 0, .flips = {}, .hole = {}});
  EXPECT_EQ(dsl_start(&master).error, DSL_BUS);
  rig.arm({.fails = 0, .flips = {}, .hole = {}});
  EXPECT_EQ(dsl_write_byte(&master, 1, 0).error, DSL_BUS);
  dsl_program_report report{};
  rig.arm({.fails = 2, .flips = {}, .hole = {}});
  EXPECT_NE(dsl_program(&port, wait, &report), 0);
}

}  // namespace
