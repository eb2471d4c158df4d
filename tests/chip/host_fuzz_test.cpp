// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random activity at every host pin, legal and not, over SPI, SPI2, Intel and Motorola: no
// assertion in the RTL fails, no pulse at MA is short, and after a clean reset every access works.
// A case is a string of bytes; each is made from a seed, or a mutation of one that was kept.
// MB4_FUZZ_CASES sets the number (default 300), MB4_FUZZ_SECONDS a time instead, MB4_SEED the first
// seed. A failure prints its seed and bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>

#include "bits.hpp"
#include "chip_fixture.hpp"

namespace {

namespace sim = mb4::sim;
using sim::Pin;
using Bytes = std::vector<std::uint8_t>;

constexpr sim::HostInterface kInterfaces[] = {sim::HostInterface::kSpi, sim::HostInterface::kSpi2,
                                              sim::HostInterface::kIntel,
                                              sim::HostInterface::kMotorola};

struct FuzzCounts {
  std::uint64_t cases = 0;
  std::uint64_t operations = 0;
  std::uint64_t frames = 0;
  sim::Time time = 0;
};

// Sets the straps for an interface, all other host pins to rest.
void rest(sim::Simulator& simulator, sim::HostInterface interface) {
  const bool parallel =
      interface == sim::HostInterface::kIntel || interface == sim::HostInterface::kMotorola;
  const bool motorola = interface == sim::HostInterface::kMotorola;
  simulator.set_pin(Pin::kCfgspi, !parallel);
  simulator.set_pin(Pin::kIntNmot, !motorola);
  simulator.set_pin(Pin::kNcs, true);
  simulator.set_pin(Pin::kAle, false);
  simulator.set_pin(Pin::kNrdRnw, true);
  simulator.set_pin(Pin::kNwrE, !motorola && interface != sim::HostInterface::kSpi2);
  for (unsigned bit = 0; bit < 8; ++bit) {
    simulator.set_pin(static_cast<Pin>(bit), bit == 4 && !parallel);
  }
}

// The reader of a case: past the end everything is 0.
class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}
  bool more() const { return at_ < bytes_.size(); }
  unsigned next() { return more() ? bytes_[at_++] : 0U; }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

void frame_of_bytes(sim::SpiHost& host, Reader& reader) {
  Bytes tx{static_cast<std::uint8_t>(reader.next() % 12)};
  for (unsigned left = reader.next() % 12; left > 0; --left) {
    tx.push_back(static_cast<std::uint8_t>(reader.next()));
  }
  host.transfer(tx, {});
}

void operate(mb4test::Chip& chip, Reader& reader) {
  static constexpr Pin kPins[] = {Pin::kNcs,     Pin::kAle, Pin::kNrdRnw, Pin::kNwrE,
                                  Pin::kDb0,     Pin::kDb1, Pin::kDb2,    Pin::kDb3,
                                  Pin::kDb4,     Pin::kDb5, Pin::kDb6,    Pin::kDb7,
                                  Pin::kGetsens, Pin::kNer, Pin::kSl2,    Pin::kNres};
  auto& simulator = chip.simulator;
  const unsigned operation = reader.next();
  switch (operation % 16) {
    default: {
      const unsigned what = reader.next();
      // NRES rarely: most of the activity would fall into a reset.
      const unsigned pins = (what & 0x70U) == 0 ? 16 : 15;
      simulator.set_pin(kPins[what % pins], (what & 0x80U) != 0);
      simulator.advance(reader.next() * 100);
      break;
    }
    case 8:
      simulator.advance(reader.next() * sim::kPsPerNs);
      break;
    case 9:
      simulator.advance(reader.next() * 50 * sim::kPsPerNs);
      break;
    case 10:
      frame_of_bytes(simulator.spi(), reader);
      break;
    case 11:
      frame_of_bytes(simulator.spi2(), reader);
      break;
    case 12:
      simulator.bus().write(static_cast<std::uint8_t>(reader.next()),
                            static_cast<std::uint8_t>(reader.next()));
      break;
    case 13:
      simulator.bus().read(static_cast<std::uint8_t>(reader.next()));
      break;
    case 14: {
      // Another timing from now on, down to nothing.
      const auto time = [&] { return sim::Time{reader.next()} * 100; };
      simulator.bus().set_timing({time(), time(), time(), time(), time(), time(), time(), time()});
      simulator.spi().set_timing({time(), time(), time(), time(), time(), time()});
      break;
    }
    case 15:
      if (reader.next() % 4 == 0) {
        rest(simulator, kInterfaces[reader.next() % 4]);  // straps that move
      } else {
        // A frame of the encoder, one after the other, or control communication.
        chip.configure_slave1(28, 0x06, static_cast<std::uint8_t>(reader.next() % 4), 0x7C);
        chip.instruct(static_cast<std::uint8_t>(reader.next()));
      }
      break;
  }
}

// A clean reset with straps for `interface`; then registers, memories and a frame must work.
void check_after_reset(mb4test::Chip& chip, sim::HostInterface interface) {
  auto& simulator = chip.simulator;
  rest(simulator, interface);
  simulator.set_pin(Pin::kNer, true);
  simulator.set_pin(Pin::kGetsens, false);
  simulator.set_pin(Pin::kSl2, true);
  simulator.spi().set_timing({});
  simulator.bus().set_timing(sim::ParallelTiming::for_cycle(1000 * sim::kPsPerNs));
  simulator.advance(sim::kPsPerUs);
  simulator.set_pin(Pin::kNres, false);
  simulator.advance(250 * sim::kPsPerNs);
  simulator.set_pin(Pin::kNres, true);
  // The encoder's timeout, the memories' clearing, a clock switch.
  simulator.advance(100 * sim::kPsPerUs);
  ASSERT_EQ(chip.read(0xEA, 2), (Bytes{0x20, 0x84}));
  ASSERT_EQ(chip.read(0xC0, 4), (Bytes{0, 0, 0, 0}));
  ASSERT_EQ(chip.status(), 0xFB);
  chip.configure_slave1(28, 0x06, 0x00, 0x7C);
  ASSERT_EQ(chip.read(0xC0), 0x5B);
  chip.write(0x85, {0x5A, 0xA5});
  chip.advance_us(1);
  ASSERT_EQ(chip.read(0x85, 2), (Bytes{0x5A, 0xA5}));
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot(500));
  ASSERT_EQ(chip.read(0x00, 4), (Bytes{0xBF, 0x37, 0xAF, 0x0A}));
  ASSERT_EQ(chip.status(), 0xFB);
}

std::string hex(const Bytes& bytes) {
  std::string text;
  char two[3];
  for (const std::uint8_t byte : bytes) {
    std::snprintf(two, sizeof(two), "%02X", byte);
    text += two;
  }
  return text;
}

void run_case(const Bytes& bytes, std::uint64_t seed, FuzzCounts& counts) {
  const char* const kNames[] = {"spi", "spi2", "intel", "motorola"};
  Reader reader(bytes);
  const unsigned which = reader.next() % 4;
  mb4test::Chip chip(std::string("[sim]\nseed = ") + std::to_string(seed) +
                     "\n[host]\ninterface = \"" + kNames[which] +
                     "\"\n[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
                     "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ncontrol = false\n");
  try {
    while (reader.more()) {
      operate(chip, reader);
      ++counts.operations;
    }
    check_after_reset(chip, kInterfaces[which]);
  } catch (const sim::ModelStopped& stopped) {
    ADD_FAILURE() << stopped.what();
  }
  counts.time += chip.simulator.now();
  counts.frames += chip.simulator.slave(1)->frames();
  ++counts.cases;
  chip.simulator.host_check().clear();  // illegal on purpose
}

Bytes make_case(std::mt19937_64& random, const std::vector<Bytes>& kept) {
  Bytes bytes;
  if (!kept.empty() && random() % 2 == 0) {
    bytes = kept[random() % kept.size()];
    for (unsigned i = 0; i <= random() % 8; ++i) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    const Bytes& other = kept[random() % kept.size()];
    if (random() % 4 == 0) {
      bytes.insert(bytes.end(), other.begin(),
                   other.begin() + static_cast<std::ptrdiff_t>(random() % other.size()));
    }
    bytes.resize(std::min<std::size_t>(bytes.size(), 1500));
  } else {
    bytes.resize(20 + random() % 600);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  }
  return bytes;
}

TEST(HostFuzz, AnyPinActivity_NoAssertionAndACleanResetHelps) {
  const std::uint64_t cases = mb4test::number_from("MB4_FUZZ_CASES", 300);
  const std::uint64_t seconds = mb4test::number_from("MB4_FUZZ_SECONDS", 0);
  const std::uint64_t first = mb4test::number_from("MB4_SEED", 1);
  std::mt19937_64 random(first);
  std::vector<Bytes> kept;
  FuzzCounts counts;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  while (seconds != 0 ? elapsed() < static_cast<double>(seconds) : counts.cases < cases) {
    const Bytes bytes = make_case(random, kept);
    const std::uint64_t frames = counts.frames;
    run_case(bytes, first + counts.cases, counts);
    if (testing::Test::HasFailure()) {
      FAIL() << "MB4_SEED=" << first << ", case " << counts.cases << ": " << hex(bytes);
    }
    // Worth keeping: frames ran beside the one of the check.
    if (counts.frames > frames + 3 && kept.size() < 500) kept.push_back(bytes);
  }
  std::printf("%llu cases, %llu operations, %llu frames, %.1f ms simulated, %.1f s, kept %zu\n",
              static_cast<unsigned long long>(counts.cases),
              static_cast<unsigned long long>(counts.operations),
              static_cast<unsigned long long>(counts.frames),
              static_cast<double>(counts.time) * 1e-9, elapsed(), kept.size());
}

}  // namespace
