// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// probe(), configure(), break_transmission() and the status calls, transfer by transfer.

#include "mb4/device.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "enc/trace.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace device_test {

using mb4::Error;
using mb4test::Bytes;
using mb4test::encoder26;
using mb4test::FakeClock;
using mb4test::join;
using mb4test::StrictBus;
using mb4test::StuckBus;
using mb4test::zeros;

class DeviceTest : public testing::Test {
 protected:
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
};

using Probe = DeviceTest;
using Configure = DeviceTest;
using Break = DeviceTest;
using StatusCalls = DeviceTest;

// Tables 41, 42: REVISION at 0xEA, VERSION at 0xEB.
TEST_F(Probe, RevisionY_IsReported) {
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x20, 0x84});
  const mb4::Result<mb4::Identity> identity = device.probe();
  ASSERT_TRUE(identity.ok());
  EXPECT_EQ(identity->version, 0x84);
  EXPECT_EQ(identity->revision, 0x20);
}

TEST_F(Probe, OtherRevision_IsReportedAsItIs) {
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x11, 0x84});
  EXPECT_EQ(device.probe()->revision, 0x11);
}

TEST_F(Probe, Mb3_IsNotDetected) {
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x20, 0x83});
  EXPECT_EQ(device.probe().error(), Error::kNotDetected);
}

TEST_F(Probe, TransportFailure_IsReported) {
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x20, 0x84}).fail_at(0);
  EXPECT_EQ(device.probe().error(), Error::kTransport);
}

TEST_F(Configure, ValidConfig_WritesReadsBackAndCompares) {
  mb4test::expect_configure(bus);
  EXPECT_TRUE(device.configure(encoder26()).ok());
  EXPECT_TRUE(device.configured());
  EXPECT_EQ(device.config().slaves[0].data_bits, 28);
}

// CLKENI = 1 goes out before the first configuration byte (table 7).
TEST_F(Configure, InternalClock_IsSwitchedOnFirst) {
  mb4::Config config = encoder26();
  config.clock_source = mb4::ClockSource::kInternal;
  mb4test::expect_image(bus, mb4test::configuration(), mb4test::read_back(0x01), 0x01);
  EXPECT_TRUE(device.configure(config).ok());
}

TEST_F(Configure, InvalidConfigAfterGoodOne_KeepsTheGoodOne) {
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(encoder26()).ok());
  EXPECT_EQ(device.configure(mb4::Config()).error(), Error::kInvalidConfig);
  EXPECT_TRUE(device.configured());
}

// Also when the chip was configured before: what is in it now is unknown.
TEST(ConfigureFailure, TransportAtEachTransfer_IsReportedAndLeavesUnconfigured) {
  for (std::size_t index = 0; index < mb4test::kConfigureTransfers; ++index) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4test::expect_configure(bus);
    ASSERT_TRUE(device.configure(encoder26()).ok());
    mb4test::expect_configure(bus);
    bus.fail_at(mb4test::kConfigureTransfers + index);
    EXPECT_EQ(device.configure(encoder26()).error(), Error::kTransport) << index;
    EXPECT_FALSE(device.configured()) << index;
    EXPECT_EQ(device.read_frame().error(), Error::kNotConfigured) << index;
  }
}

// Each bit of each compared register, one at a time; the reserved registers 0xE0, 0xE1, 0xEE, the
// identity and the status registers do not count.
TEST(ConfigureFailure, AnyWrongBit_IsVerifyWithItsAddress) {
  for (unsigned address = 0xC0; address <= 0xF5; ++address) {
    const bool reserved = address == 0xE0 || address == 0xE1 || address == 0xEE;
    const bool constant = address == 0xEA || address == 0xEB;
    const bool status = address >= 0xF0 && address <= 0xF4;
    if (constant || status) {
      continue;
    }
    for (unsigned bit = 0; bit < 8; ++bit) {
      StrictBus bus;
      FakeClock clock;
      mb4::Device<StrictBus, FakeClock> device(bus, clock);
      Bytes answer = mb4test::read_back();
      std::uint8_t& byte = answer[address - 0xC0];
      byte = static_cast<std::uint8_t>(byte ^ (1U << bit));
      mb4test::expect_image(bus, mb4test::configuration(), answer, 0x00,
                            reserved ? mb4test::kAll : address);
      const mb4::ErrorInfo info = device.configure(encoder26()).info();
      if (reserved) {
        EXPECT_EQ(info.code, Error::kNone) << address;
      } else {
        EXPECT_EQ(info.code, Error::kVerify) << address;
        EXPECT_EQ(info.address(), address);
        EXPECT_FALSE(device.configured());
      }
    }
  }
}

// SVALID is cleared by writing 0; a disturbed 1 there changes nothing, and the first frame would
// bring a word from before.
TEST_F(Configure, SvalidStays_IsVerify) {
  mb4test::expect_image(bus, mb4test::configuration(), mb4test::read_back(), 0x00, mb4test::kAll,
                        mb4test::status(0xFB, 0x02));
  const mb4::ErrorInfo info = device.configure(encoder26()).info();
  EXPECT_EQ(info.code, Error::kVerify);
  EXPECT_EQ(info.address(), 0xF1);
  EXPECT_FALSE(device.configured());
}

// A BREAK that was lost: an instruction waits, or a frame still runs. The first read then begins
// with BREAK.
TEST_F(Configure, SomethingRuns_IsVerifyOrBreak) {
  mb4test::expect_image(bus, mb4test::configuration(), mb4test::read_back(), 0x00, mb4test::kAll,
                        mb4test::status(0xFB, 0x00, 0x01));
  EXPECT_EQ(device.configure(encoder26()).info().address(), 0xF4);
  mb4test::expect_image(bus, mb4test::configuration(), mb4test::read_back(), 0x00, mb4test::kAll,
                        mb4test::status(0xFA, 0x00));
  ASSERT_TRUE(device.configure(encoder26()).ok());
  bus.expect_write(mb4test::kBreak).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
}

TEST_F(Configure, OtherVersion_IsNotDetected) {
  Bytes answer = mb4test::read_back();
  answer[0xEB - 0xC0] = 0x83;
  mb4test::expect_image(bus, mb4test::configuration(), answer, 0x00, 0xEB);
  EXPECT_EQ(device.configure(encoder26()).error(), Error::kNotDetected);
  EXPECT_FALSE(device.configured());
}

// A hook sees each frame, with what came back where it was wanted.
TEST(Trace, EachFrame_IsSeen) {
  StrictBus bus;
  FakeClock clock;
  std::vector<std::string> seen;
  enc::TracedBus traced(bus, [&seen](mb4::Span<const std::uint8_t> tx,
                                     mb4::Span<const std::uint8_t> rx, bool transferred) {
    seen.push_back(mb4test::hex(Bytes(tx.begin(), tx.end())) + "> " +
                   mb4test::hex(Bytes(rx.begin(), rx.end())) + (transferred ? "" : "failed"));
  });
  mb4::Device device(traced, clock);
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x20, 0x84});
  EXPECT_TRUE(device.probe().ok());
  bus.expect_write({0x07, 0x80}).fail_last();
  EXPECT_EQ(device.break_transmission().error(), Error::kTransport);
  EXPECT_EQ(seen, (std::vector<std::string>{"03 EA 00 00 > 00 00 20 84 ", "07 80 > failed"}));
}

// Table 47: BREAK is bit 7 of 0xF4; nothing else is set.
TEST_F(Break, Call_WritesBreakOnly) {
  bus.expect_write({0x07, 0x80});
  bus.expect_read({0x05, 0, 0, 0, 0, 0}, {0, 0xFB, 0, 0, 0, 0});
  EXPECT_TRUE(device.break_transmission().ok());
}

TEST_F(Break, TransportFailure_IsReported) {
  bus.expect_write({0x07, 0x80}).fail_at(0);
  EXPECT_EQ(device.break_transmission().error(), Error::kTransport);
}

// Tables 54 to 61: nERR, nAGSERR, nDELAYERR, nSCDERR, nREGERR, REGEND, 1, EOT.
TEST_F(StatusCalls, ReadStatus_DecodesFlags) {
  bus.expect_read({0x05, 0, 0, 0, 0, 0}, {0x00, 0x2A, 0xA8, 0x02, 0x80, 0x04});
  const mb4::Result<mb4::Status> status = device.read_status();
  ASSERT_TRUE(status.ok());
  EXPECT_FALSE(status->idle());
  EXPECT_TRUE(status->start_error());
  EXPECT_TRUE(status->scd_error());
  EXPECT_TRUE(status->ner_low());
  EXPECT_FALSE(status->instruction_done());
  EXPECT_EQ(status->get<mb4::regs::nDELAYERR>(), 1);
  EXPECT_EQ(status->get<mb4::regs::nREGERR>(), 1);
  EXPECT_EQ(status->get<mb4::regs::CDMTIMEOUT>(), 1);
  const std::array<bool, 8> valid{false, true, true, true, true, false, false, false};
  for (std::uint8_t slave = 1; slave <= 8; ++slave) {
    EXPECT_EQ(status->valid(slave), valid[slave - 1U]) << unsigned{slave};
  }
}

// Table 6: constant bits of 0xF0, 0xF1, 0xF2.
TEST(StatusSnapshot, WrongConstantBit_IsNotDetected) {
  const struct {
    std::size_t byte;
    std::uint8_t flip;
  } wrong[] = {{0, 0x02}, {1, 0x01}, {1, 0x04}, {1, 0x10}, {1, 0x40},
               {2, 0x01}, {2, 0x04}, {2, 0x10}, {2, 0x40}};
  for (const auto& one : wrong) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    Bytes answer = mb4test::kIdleStatus;
    answer[1 + one.byte] = static_cast<std::uint8_t>(answer[1 + one.byte] ^ one.flip);
    bus.expect_read(mb4test::kReadStatus, answer);
    EXPECT_EQ(device.read_status().error(), Error::kNotDetected) << one.byte;
  }
}

// Table 61: 0xF1 bits 1, 3, 5, 7 for slaves 1 to 4, 0xF2 for 5 to 8; only that bit is written 0.
TEST(ClearValid, EachSlave_WritesZeroToItsBitOnly) {
  const Bytes expected[8] = {{0x02, 0xF1, 0xFD, 0xFF}, {0x02, 0xF1, 0xF7, 0xFF},
                             {0x02, 0xF1, 0xDF, 0xFF}, {0x02, 0xF1, 0x7F, 0xFF},
                             {0x02, 0xF1, 0xFF, 0xFD}, {0x02, 0xF1, 0xFF, 0xF7},
                             {0x02, 0xF1, 0xFF, 0xDF}, {0x02, 0xF1, 0xFF, 0x7F}};
  for (std::uint8_t slave = 1; slave <= 8; ++slave) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    bus.expect_write(expected[slave - 1U]);
    EXPECT_TRUE(device.clear_valid(slave).ok());
  }
}

TEST_F(StatusCalls, ClearValidOfNoSlave_IsInvalidArgumentWithoutTransfer) {
  EXPECT_EQ(device.clear_valid(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.clear_valid(9).error(), Error::kInvalidArgument);
}

class StuckMiso : public testing::TestWithParam<unsigned> {};

TEST_P(StuckMiso, EveryCall_IsNotDetected) {
  StuckBus bus(static_cast<std::uint8_t>(GetParam()));
  FakeClock clock;
  mb4::Device<StuckBus, FakeClock> device(bus, clock);
  EXPECT_EQ(device.probe().error(), Error::kNotDetected);
  EXPECT_EQ(device.read_status().error(), Error::kNotDetected);
  EXPECT_EQ(device.configure(encoder26()).error(), Error::kNotDetected);
  EXPECT_EQ(device.read_frame().error(), Error::kNotConfigured);
}

INSTANTIATE_TEST_SUITE_P(Levels, StuckMiso, testing::Values(0x00U, 0xFFU),
                         [](const auto& test) { return test.param == 0 ? "Low" : "High"; });

}  // namespace device_test
}  // namespace
