// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The scan of a channel, against a device that answers as the test says.

#include "mb4/scan.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mb4/device.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace scan_test {

using mb4::Error;
using mb4::ErrorInfo;

ErrorInfo refused(std::uint8_t good_bytes) {
  ErrorInfo info(Error::kRegister);
  info.detail = good_bytes;
  return info;
}

// Slaves with the identity "DEVICE", "MM" and a first bank of the EDS each. An ID beyond them does
// not answer.
class FakeDevice {
 public:
  explicit FakeDevice(std::vector<std::uint8_t> banks) : banks_(std::move(banks)) {}

  [[nodiscard]] const mb4::Config& config() const { return config_; }
  FakeDevice& control() { return *this; }
  mb4::Result<void> read_registers(mb4::SlaveAddress slave, std::uint8_t address,
                                   mb4::Span<std::uint8_t> out) {
    if (slave.id == disturbed_id && disturbed_reads > 0) {
      --disturbed_reads;
      return refused(disturbed_after);
    }
    if (slave.id >= banks_.size()) return refused(0);
    constexpr std::array<std::uint8_t, 8> kIdentity{'D', 'E', 'V', 'I', 'C', 'E', 'M', 'M'};
    EXPECT_TRUE(address == 0x78 ? out.size() == 8 : address == 0x41 && out.size() == 1);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = address == 0x78 ? kIdentity[i] : banks_[slave.id];
    }
    return {};
  }

  unsigned disturbed_reads = 0;
  unsigned disturbed_id = 0;
  std::uint8_t disturbed_after = 0;

 private:
  mb4::Config config_ = mb4test::encoder26();
  std::vector<std::uint8_t> banks_;
};

// 0x41: 0x00 and 0xFF are no bank.
TEST(Scan, EdsBank_IsOneOrNone) {
  FakeDevice device({0x02, 0x00, 0xFF});
  std::array<mb4::SlaveIdentity, 3> found{};
  const mb4::Result<std::uint8_t> count = mb4::scan_bus(device, 1, found);
  ASSERT_TRUE(count.ok());
  EXPECT_EQ(*count, 3);
  EXPECT_TRUE(found[0].has_eds);
  EXPECT_EQ(found[0].eds_bank, 0x02);
  EXPECT_FALSE(found[1].has_eds);
  EXPECT_FALSE(found[2].has_eds);
  for (const mb4::SlaveIdentity& identity : found) {
    EXPECT_TRUE(identity.has_identity);
    EXPECT_EQ(identity.device_id[5], 'E');
    EXPECT_EQ(identity.manufacturer[0], 'M');
  }
}

// One disturbed frame hides no slave; a slave that fails after some bytes is there, so the second
// failure is an error and no end.
TEST(Scan, DisturbedSlave_IsReadTwice) {
  for (const unsigned reads : {1U, 2U}) {
    FakeDevice device({0x02, 0x02});
    device.disturbed_id = 1;
    device.disturbed_after = 3;
    device.disturbed_reads = reads;
    const mb4::Result<std::uint8_t> count = mb4::scan_bus(device, 1, {});
    EXPECT_EQ(count.error(), reads == 1 ? Error::kNone : Error::kRegister);
    EXPECT_EQ(count.info().bytes(), reads == 1 ? 0 : 3);
    EXPECT_EQ(count.value_or(0), reads == 1 ? 2 : 0);
  }
}

TEST(Scan, EightIds_AreTheMost) {
  FakeDevice device(std::vector<std::uint8_t>(8, 0x02));
  EXPECT_EQ(mb4::scan_bus(device, 1, {}).value_or(0), 8);
}

TEST(Scan, NoSuchChannel_IsInvalidArgumentWithoutTransfer) {
  mb4test::StrictBus bus;
  mb4test::FakeClock clock;
  mb4::Device<mb4test::StrictBus, mb4test::FakeClock> device(bus, clock);
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(mb4test::encoder26()).ok());
  for (const unsigned channel : {0U, 3U}) {
    EXPECT_EQ(mb4::scan_bus(device, static_cast<std::uint8_t>(channel), {}).error(),
              Error::kInvalidArgument);
  }
}

}  // namespace scan_test
}  // namespace
