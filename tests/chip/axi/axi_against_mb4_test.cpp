// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The same encoder on the same cable, read by the iC-MB4 and by the BiSS C master on AXI.
#include <algorithm>
#include <array>

#include "masters/mb4/sim_bus.hpp"
#include "mb4/device.hpp"
#include "mb4/line_delay.hpp"
#include "sim/core/random.hpp"
#include "tests/chip/axi/axi_bench.hpp"
#include "tests/support/chip_fixture.hpp"

namespace mb4test {
namespace {

constexpr unsigned kRuns = 64;

TEST(Axi, F10SixtyFourRandomEncoders_GiveThePositionsAndDelaysOfTheIcMb4) {
  sim::Random random(1);
  for (unsigned run = 0; run < kRuns; ++run) {
    const auto bits = static_cast<unsigned>(8 + random.up_to(24));
    const double delay_ns = static_cast<double>(random.up_to(1500));
    // 10, 5 and 1 MHz: dividers of 20 MHz and of 100 MHz.
    const std::uint32_t ma_hz = std::array{10'000'000U, 5'000'000U, 1'000'000U}[random.up_to(2)];
    const auto position =
        static_cast<std::uint32_t>(random.next() & ((std::uint64_t{1} << bits) - 1));
    const std::string keys = "busy_periods = " + std::to_string(random.up_to(6)) + "\n";
    const std::string channel =
        "[[channel]]\nnumber = 1\ndelay_ns = " + std::to_string(delay_ns) +
        "\n[[channel.slave]]\nprotocol = \"biss-c\"\ncrc = 0x43\ndata_bits = " +
        std::to_string(bits + 2) + "\n" + keys;
    const std::string what = "run " + std::to_string(run) + ": " + std::to_string(bits) +
                             " bits, " + std::to_string(delay_ns) + " ns, " +
                             std::to_string(ma_hz) + " Hz";

    sim::Simulator other(sim::parse_scenario(channel, "mb4.toml"));
    other.slave(1)->set_data(raw_word(position));
    mb4::tool::SimBus bus(other);
    mb4::tool::SimClock clock(other);
    mb4::Device<mb4::tool::SimBus, mb4::tool::SimClock> device(bus, clock);
    mb4::Config config = config26(ma_hz);
    config.slaves[0].data_bits = static_cast<std::uint8_t>(bits + 2);
    ASSERT_TRUE(device.configure(config).ok()) << what;
    const auto quarters = device.initialize();
    ASSERT_TRUE(quarters.ok()) << what;
    mb4::Frame frame;
    ASSERT_TRUE(device.read_all(frame).ok()) << what;
    ASSERT_TRUE(frame[1].ok()) << what;

    AxiBench bench(axi_scenario({{.bits = bits, .delay_ns = delay_ns, .slave = keys}}));
    bench.set_up(bits, 100'000'000 / (2 * ma_hz));
    bench.simulator.slave(1)->set_data(raw_word(position));
    const auto beat = bench.frame(200 * sim::kPsPerUs);
    ASSERT_TRUE(beat) << what;
    EXPECT_EQ(beat->user, 1U) << what;
    EXPECT_EQ(beat->words[0], position) << what;
    EXPECT_EQ(raw_word(beat->words[0]), frame[1]->raw) << what;
    // The coarser unit: a quarter of MA's period, or a clock of 10 ns.
    const double theirs = mb4::line_delay_ns(config, quarters->quarters[0]);
    const double ours = 10.0 * bench.read(axireg::kAddrLineDelay);
    EXPECT_NEAR(ours, theirs, std::max(1e9 / (4.0 * ma_hz), 10.0)) << what;
  }
}

}  // namespace
}  // namespace mb4test
