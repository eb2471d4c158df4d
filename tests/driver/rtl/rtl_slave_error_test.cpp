// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// An encoder whose nE is 0: each call that reads says kSlaveError and hands out no position. In
// every other way the word is a good one: the transfers of all calls are those of an encoder whose
// nE is 1, byte for byte.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "enc/trace.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "mb4/mb4.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/test_host.hpp"

namespace {

using mb4::Error;
using mb4::Reading;
using mb4::Result;
using mb4::SpiCheck;
namespace sim = mb4::sim;

constexpr std::uint32_t kPosition = 0x2ABCDEF;

std::string scenario(std::uint32_t flags) {
  const auto slave = [](std::uint32_t word) {
    return "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nregisters = { 0x20 = [0x5A] "
           "}\ndata = " +
           std::to_string(word) + "\n";
  };
  return "[[channel]]\nnumber = 1\n" + slave(kPosition << 2 | flags) + slave(0x1234 << 2 | 3);
}

struct Traced {
  std::vector<std::vector<std::uint8_t>>* log;
  void operator()(mb4::Span<const std::uint8_t> tx, mb4::Span<const std::uint8_t> /*rx*/,
                  bool /*transferred*/) const {
    log->emplace_back(tx.begin(), tx.end());
  }
};

class Encoder {
 public:
  Encoder(SpiCheck check, std::uint32_t flags, bool hold)
      : simulator(mb4test::with_test_host(sim::parse_scenario(scenario(flags), "test.toml"))),
        inner(simulator),
        bus(inner, Traced{&log}),
        clock(simulator),
        device(bus, clock) {
    mb4::Config config;
    config.ma_hz = 10'000'000;
    config.channels[0].protocol = mb4::Protocol::kBissC;
    config.slaves[0].enabled = true;
    config.slaves[0].data_bits = 28;
    config.slaves[0].crc_polynomial = 0x43;
    config.slaves[1] = config.slaves[0];
    config.spi_check = check;
    config.hold_beside_access = hold;
    config.frame_start = mb4::FrameStart::kPeriodic;
    config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 100'000);
    EXPECT_TRUE(device.configure(config).ok());
  }
  void start() { EXPECT_TRUE(device.automatic().start().ok()); }
  void wait() { simulator.run_until(simulator.now() + 150 * sim::kPsPerUs); }

  sim::Simulator simulator;
  std::vector<std::vector<std::uint8_t>> log;
  mb4::tool::SimBus inner;
  enc::TracedBus<mb4::tool::SimBus, Traced> bus;
  mb4::tool::SimClock clock;
  mb4::Device<enc::TracedBus<mb4::tool::SimBus, Traced>, mb4::tool::SimClock> device;
};

template <typename Read>
void finish(Encoder& encoder, Read& read) {
  bool transferred = false;
  do {
    transferred = read.run(encoder.bus);
  } while (!encoder.device.automatic().finish(read, transferred, encoder.clock.now_us()));
}

struct Call {
  const char* name;
  bool automatic;
  std::function<Result<Reading>(Encoder&)> read;
};

const std::vector<Call>& calls() {
  static const std::vector<Call> all{
      {"read_frame", false, [](Encoder& e) { return e.device.read_frame(); }},
      {"read_all", false,
       [](Encoder& e) {
         mb4::Frame frame;
         EXPECT_TRUE(e.device.read_all(frame).ok());
         EXPECT_TRUE(frame[2].ok());
         return frame[1];
       }},
      {"poll_slave", true, [](Encoder& e) { return e.device.automatic().poll_slave(1); }},
      {"poll", true,
       [](Encoder& e) {
         mb4::Frame frame;
         EXPECT_TRUE(e.device.automatic().poll(frame).ok());
         EXPECT_EQ(frame[2].ok() ? 0x1234U : 0U, frame[2].value_or(Reading()).position);
         return frame[1];
       }},
      {"next", true,
       [](Encoder& e) {
         mb4::Frame frame;
         EXPECT_TRUE(e.device.automatic().next(frame).ok());
         EXPECT_TRUE(frame[2].ok());
         return frame[1];
       }},
      {"plan_slave", true,
       [](Encoder& e) {
         mb4::CyclicRead read;
         EXPECT_TRUE(e.device.automatic().plan_slave(1, read).ok());
         finish(e, read);
         EXPECT_EQ(read.error(), read.result().error());
         if (read.error() == Error::kSlaveError) {
           EXPECT_TRUE(read.slave_error());
         }
         return read.result();
       }},
      {"plan", true, [](Encoder& e) {
         mb4::FrameRead read;
         EXPECT_TRUE(e.device.automatic().plan(read).ok());
         finish(e, read);
         mb4::Frame frame;
         EXPECT_TRUE(read.result(frame).ok());
         return frame[1];
       }}};
  return all;
}

class DriverSlaveError : public testing::TestWithParam<SpiCheck> {};

TEST_P(DriverSlaveError, EachCall_GivesNoPositionAndIsElseAGoodRead) {
  for (const Call& call : calls()) {
    std::vector<std::vector<std::uint8_t>> good_log;
    for (const std::uint32_t flags : {3U, 2U, 1U, 0U}) {
      Encoder encoder(GetParam(), flags, true);
      if (call.automatic) encoder.start();
      unsigned brought = 0;
      for (unsigned n = 0; n < 5; ++n) {
        encoder.wait();
        const Result<Reading> reading = call.read(encoder);
        if (reading.error() == Error::kNoData) continue;  // a read meets the end of a frame
        ++brought;
        ASSERT_EQ(reading.error(), (flags & 2U) != 0 ? Error::kNone : Error::kSlaveError)
            << call.name << ' ' << flags;
        EXPECT_EQ(reading.reading().position, kPosition);
        EXPECT_EQ(reading.reading().raw, kPosition << 2 | flags);
        EXPECT_EQ(reading.reading().slave_error, (flags & 2U) == 0);
        EXPECT_EQ(reading.reading().slave_warning, (flags & 1U) == 0);
      }
      EXPECT_GE(brought, 4U) << call.name;
      if (flags == 3) good_log = encoder.log;
      EXPECT_EQ(encoder.log, good_log) << call.name << ' ' << flags;
    }
  }
}

// Beside a register access, with HOLDBANK and without.
TEST_P(DriverSlaveError, BesideAnAccess_IsElseAGoodRead) {
  for (const bool hold : {true, false}) {
    std::vector<Error> good;
    std::vector<std::vector<std::uint8_t>> good_log;
    for (const std::uint32_t flags : {3U, 1U}) {
      Encoder encoder(GetParam(), flags, hold);
      encoder.start();
      mb4_c::PolledAccess steps(encoder.device);
      ASSERT_TRUE(steps.begin_read({1, 0}, 0x20, 1).ok());
      std::vector<Error> told;
      for (unsigned n = 0; n < 20; ++n) {
        encoder.wait();
        told.push_back(encoder.device.automatic().poll_slave(1).error());
      }
      if (flags == 3) {
        good = told;
        good_log = encoder.log;
        continue;
      }
      for (Error& error : good) error = error == Error::kNone ? Error::kSlaveError : error;
      EXPECT_GE(std::count(good.begin(), good.end(), Error::kSlaveError), 10);
      EXPECT_EQ(told, good);
      EXPECT_EQ(encoder.log, good_log);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Checks, DriverSlaveError,
                         testing::Values(SpiCheck::kOff, SpiCheck::kCrc, SpiCheck::kFull,
                                         SpiCheck::kFullAndRelease));

}  // namespace
