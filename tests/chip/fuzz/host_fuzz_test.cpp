// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random activity at every host pin, legal and not, over SPI, SPI2, Intel and Motorola: no
// assertion in the RTL fails, no pulse at MA is short, and after a clean reset every access works.
// A case is a string of bytes; each is made from a seed, or a mutation of one that was kept.
// MB4_FUZZ_CASES sets the number (default 300), MB4_FUZZ_SECONDS a time instead, MB4_SEED the first
// seed. A failure prints its seed and bytes. The chip has one of four kinds of slaves on its lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "sim/lines/registers/control_slots.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/control_host.hpp"

namespace {

namespace reg = mb4::regs;
namespace sim = mb4::sim;
using sim::Pin;
using Bytes = std::vector<std::uint8_t>;

constexpr sim::HostInterface kInterfaces[] = {sim::HostInterface::kSpi, sim::HostInterface::kSpi2,
                                              sim::HostInterface::kIntel,
                                              sim::HostInterface::kMotorola};

struct FuzzCounts {
  std::uint64_t cases = 0;
  std::uint64_t switched_off = 0;
  std::uint64_t operations = 0;
  std::uint64_t frames = 0;
  std::uint64_t accesses = 0;
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
      } else if (clocked(chip.simulator.slave(1))->control() != nullptr && reader.next() % 2 == 0) {
        // Registers or a command, one line or two, in frames whole, reduced or of BiSS B.
        chip.configure_slave1(
            28, reg::kScrclenCrc6, static_cast<std::uint8_t>(reader.next() % 4),
            static_cast<std::uint8_t>(reader.next() % 2 == 0 ? reg::kFreqagsAgsMin : 0x09));
        chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 15, reg::kScrclenCrc6, 0x00, 0x00});
        chip.write(reg::kAddrSlaveloc5,
                   {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
                    static_cast<std::uint8_t>(reg::kCfgch1BissC | (reader.next() & 0x0CU))});
        chip.write(reg::kAddrRegadr, {static_cast<std::uint8_t>(reader.next()),
                                      static_cast<std::uint8_t>(reader.next() % 3),
                                      static_cast<std::uint8_t>(reader.next())});
        chip.write(reg::kAddrCtrl, {static_cast<std::uint8_t>(reader.next())});
        chip.instruct(static_cast<std::uint8_t>(reg::kInstrControl | (reader.next() & 0x07U)));
      } else {
        // A frame of the encoder, one after the other, or control communication.
        chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(reader.next() % 4),
                              reg::kFreqagsAgsMin);
        chip.instruct(static_cast<std::uint8_t>(reader.next()));
      }
      break;
  }
}

// Registers of the encoder are written and read back.
void check_control(mb4test::Chip& chip) {
  mb4test::ControlHost host(chip);
  host.set_write(0, 0x31, {0x6B});
  ASSERT_NE(host.run_single(100), 0U);
  ASSERT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone);
  ASSERT_EQ(chip.simulator.slave(1)->reg_read(0x31), 0x6B);
  host.set_read(0, 0x31, 1);
  ASSERT_NE(host.run_single(100), 0U);
  ASSERT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone);
  ASSERT_EQ(host.rdata(1)[0], 0x6B);
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
  ASSERT_EQ(chip.read(reg::kAddrRevision, 2), (Bytes{reg::kRevisionY, reg::kVersionIcMb4}));
  ASSERT_EQ(chip.read(reg::slave_cfg_address(1), 4), (Bytes{0, 0, 0, 0}));
  ASSERT_EQ(chip.status(), reg::kResetStatus0);
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  ASSERT_EQ(chip.read(reg::slave_cfg_address(1)), reg::kEnscdYes | 27);
  chip.write(reg::rdata_address(6), {0x5A, 0xA5});
  chip.advance_us(1);
  ASSERT_EQ(chip.read(reg::rdata_address(6), 2), (Bytes{0x5A, 0xA5}));
  // A command of the fuzz may have switched off data or control communication of the encoder. A
  // reset of the chip does not switch them on again.
  const auto* const control = clocked(chip.simulator.slave(1))->control();
  if (control != nullptr && !control->data_active()) return;
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot(500));
  ASSERT_EQ(chip.read(reg::kAddrScdata, 4), (Bytes{0xBF, 0x37, 0xAF, 0x0A}));
  ASSERT_EQ(chip.status(), reg::kResetStatus0);
  if (control == nullptr) return;
  // The reset may have cut a control frame. If its bits and the zeros after them are the header of
  // a command, the encoder counts no zeros up to the slot of a late EX (decision 31).
  for (unsigned frame = 0; frame < sim::control_slot::kExTested; ++frame) {
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot(500));
  }
  // A command whose EX came before the reset takes effect with one of these frames.
  if (control->data_active() && control->control_active()) check_control(chip);
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

Bytes from_hex(const std::string& text) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

// What is on the lines: one encoder without control communication (the kept cases are made for it)
// or with it, beside it on line 2 one of each protocol.
std::string slaves(std::uint64_t kind) {
  const std::string encoder =
      "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
      "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\n";
  if (kind == 0) return encoder + "control = false\n";
  const char* const kProtocols[] = {"biss-c", "biss-b", "ssi"};
  return encoder + "[[channel]]\nnumber = 2\ndelay_ns = 150.0\n[[channel.slave]]\nprotocol = \"" +
         kProtocols[kind - 1] + "\"\ndata_bits = 16\ndata = 0x1234\n";
}

void run_case(const Bytes& bytes, std::uint64_t seed, FuzzCounts& counts, std::uint64_t kind) {
  const char* const kNames[] = {"spi", "spi2", "intel", "motorola"};
  Reader reader(bytes);
  const unsigned which = reader.next() % 4;
  mb4test::Chip chip(std::string("[sim]\nseed = ") + std::to_string(seed) +
                     "\n[host]\ninterface = \"" + kNames[which] + "\"\n" + slaves(kind));
  try {
    while (reader.more()) {
      operate(chip, reader);
      ++counts.operations;
    }
    counts.frames += chip.simulator.slave(1)->frames();
    check_after_reset(chip, kInterfaces[which]);
  } catch (const sim::ModelStopped& stopped) {
    ADD_FAILURE() << stopped.what();
  }
  counts.time += chip.simulator.now();
  if (const auto* const control = clocked(chip.simulator.slave(1))->control()) {
    counts.accesses += control->counters().starts;
    if (!control->data_active() || !control->control_active()) ++counts.switched_off;
  }
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

// Cases that once failed, by seed.
struct KeptCase {
  std::uint64_t seed;
  std::uint64_t kind;  // slaves()
  const char* bytes;
};
constexpr KeptCase kKept[] = {
    // A reset ends CFGIF = 11 while MA2 itself is low and its pin, the inverse of MA1, is high: the
    // rest of the low half period is no pulse of the frame.
    {927898, 0,
     "B493C3EEC7C8FB904EF883BE2C0DFAA6872B8C71BB6A1F67C8DAED48F5E2E1CADDCB4C77202042C51ADA2E4C"
     "B4268A85F87113D806749E29A78AAA1C80A6F32B9EF334296EF52CA71FFFF3B9F547476DE5AAC95DCC02FD7B"
     "EDEAAA051CC137A41B09E009983DAB6804452A814593DAEA404DBA79AA2DCB454B169F12C34CE3B59084413B"
     "4824897DC1AE2C99C0CCC156F5BAE068D52485F4FE72806774892D117EB79F78FD653222781EC35856EABBD6"
     "B9DF1FE442B51A6FD836BDC7C565C7E185010F121B43205496D6E9152AB1271A0FB2B3D64A6031BBD7E33293"
     "2D90B00D1906B8FA16A81EA35C84BE3801EF2AD4E4AE6114BBA776819FADCC7EBD6D807B4E883EE7F0E08195"
     "ACA99DCC1AC3FB0A6B4C77F74017DA5A55E4C570B9136D58C24F49587C280E81AAFD324619BD1A319214C788"
     "8974DD5ABCDD434790F07AB27C3043E4DAFB27E755D82AF0104C6A02A3E2650CD996F761B83F4820A20DCA9E"
     "683C5C037B76EFF44088F5A3E35C0FF80B8920BA6F3B6BCC3A1D16D972C3B719617FC77D5DE1AD70D01A9D22"
     "41A5DB15222A3B8A351EB9B56C4D23D3C7678ECD3AAA77A852EFE2BFF32AB44E75EB10AA8BFD8C17A8BACE1A"
     "66CD2B6C6D86BB34D0B9BE51DE737FF045BCCF313B6B3A9D60B788583214A6A2269CDFD7F4ED2C47F224C517"
     "FE00F4984F3E57A525362EDBF6A6DFC1C6C401883909401A9E8D52F837301AE9237DD08F462F7A46DF1D30BE"
     "4F75BE761DB53D44DF9414EB331260A534A9E420860CE0284764FDFA89EBCD6CBC7CE6896BD05B6F102D86BD"
     "E4E5D64AEBB6014CC3AD3BAD30D394115C83AF1DA1482CEA67028C5D09522B72172D29B3A43F6281477EF8A4"
     "2D8FB1"},
    // A reset cuts a control frame whose bits and the zeros of the next frames are a command.
    {1185, 1,
     "76566330E06B01D7266E5DBEB4A04A517B5531A4F09303801F21D252DD0851B513A2147FE218D4197CEFCE3B"
     "69EA9AB83AFE588F4606A209E11E397B4168F12F823EFEDD3A169E9BA46A3359C859EC2EF6BA2999A9C98A02"
     "3378BACA09DF755742FD49B83558959CD6982BB2861852321D26810242627C0C35453D8CE9D00F7A71EC0F5A"
     "289EA8322AC50E026FDF48BC4B066F9A6940892693BDE21CBFB8AC72984CF1DEA02A3BCB7FD822ECF687D99A"
     "5DDF2AFB692CCC261D5E27445BF4ED0F8504F3DB2981F7712151B014ACAA652552A85EDCB9363E3A5821C992"
     "EE1AF0221E1ADD6B69C298ABFB4D17E51F08506413A897852B56F5CADCFFA25B95B1CC71AC71C1E73469DA47"
     "39B2EF0D7E97509D729647AB7FBEDD258D677FC5"},
};

TEST(HostFuzz, KeptCases_StayGood) {
  FuzzCounts counts;
  for (const KeptCase& kept : kKept) {
    run_case(from_hex(kept.bytes), kept.seed, counts, kept.kind);
  }
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
  // One case again, as a failure has printed it.
  if (const char* const repeated = std::getenv("MB4_FUZZ_BYTES"); repeated != nullptr) {
    run_case(from_hex(repeated), first, counts, first % 4);
    return;
  }
  while (seconds != 0 ? elapsed() < static_cast<double>(seconds) : counts.cases < cases) {
    const Bytes bytes = make_case(random, kept);
    const std::uint64_t frames = counts.frames;
    run_case(bytes, first + counts.cases, counts, (first + counts.cases) % 4);
    if (testing::Test::HasFailure()) {
      FAIL() << "MB4_SEED=" << first + counts.cases - 1 << " MB4_FUZZ_BYTES=" << hex(bytes);
    }
    // Worth keeping: frames ran before the check.
    if (counts.frames > frames + 2 && kept.size() < 500) kept.push_back(bytes);
  }
  std::printf(
      "%llu cases, %llu of them with the encoder switched off, %llu operations, %llu frames, %llu "
      "accesses, %.1f ms simulated, %.1f s, kept %zu\n",
      static_cast<unsigned long long>(counts.cases),
      static_cast<unsigned long long>(counts.switched_off),
      static_cast<unsigned long long>(counts.operations),
      static_cast<unsigned long long>(counts.frames),
      static_cast<unsigned long long>(counts.accesses), static_cast<double>(counts.time) * 1e-9,
      elapsed(), kept.size());
}

}  // namespace
