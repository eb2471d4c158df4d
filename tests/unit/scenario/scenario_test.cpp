// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/scenario_place.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

const BissCSlaveConfig& biss_c(const Scenario& scenario, std::size_t index = 0) {
  return scenario.channels.at(0).slaves.at(index).device.as<BissCSlaveConfig>();
}

std::string slave(const std::string& keys) {
  return "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n" + keys + "\n";
}

// A scenario with many keys; the test looks at every value.
TEST(Scenario, ExampleOfTheDesign_IsReadCompletely) {
  const Scenario scenario = parse_scenario(R"([chip]
f_clk_hz = 20_000_000
f_osc_hz = 20_000_000
[chip.quirks]
[host]
interface = "spi"
sclk_hz = 10_000_000
[[channel]]
number = 1
delay_ns = 0.0
[[channel.slave]]
protocol = "biss-c"
preset = "resolute-26"
data_bits = 28
crc = 0x43
crc_start = 0
data = 0x2ABCDEF
timeout = "adaptive"
busy_periods = 0
registers = { 0x44 = [0x00, 0xD9, 0x01, 0x32] }
)",
                                           "design.toml");
  EXPECT_EQ(scenario.chip.f_clk_hz, 20'000'000U);
  EXPECT_EQ(scenario.chip.quirks, 0U);
  EXPECT_EQ(scenario.host.sclk_hz, 10'000'000U);
  EXPECT_EQ(scenario.host.ma_hz, 10'000'000U);
  EXPECT_EQ(biss_c(scenario).data_bits, 28U);
  EXPECT_EQ(biss_c(scenario).crc.polynomial, 0x43U);
  EXPECT_EQ(biss_c(scenario).source.constant, 0x2ABCDEFU);
  EXPECT_TRUE(biss_c(scenario).timeout.adaptive());
  EXPECT_EQ(scenario.channels[0].slaves[0].registers.at(0x45), 0xD9);
  EXPECT_EQ(scenario.channels[0].slaves[0].registers.at(0x47), 0x32);
}

// In a slave without protocol, and in a fault without kind, a key is unknown only if no protocol or
// kind knows it.
TEST(Scenario, KeysOfAnyKind_AreKnownWithoutTheKind) {
  std::ifstream file(MB4_EXAMPLES "/../sim/README.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  std::set<std::string> words;  // what stands alone between two backticks
  for (std::size_t at = 0; (at = manual.find('`', at)) != std::string::npos; ++at) {
    const std::size_t end =
        manual.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_", at + 1);
    if (end != std::string::npos && manual[end] == '`') {
      words.insert(manual.substr(at + 1, end - at - 1));
    }
  }
  const std::string channel = "[[channel]]\nnumber = 1\n[[channel.slave]]\n";
  const std::string fault = slave("data_bits = 8") + "[[fault]]\n";
  struct Table {
    std::string head;
    std::string key;
    std::vector<std::string> kinds;
    unsigned expected;  // keys at least
  };
  const auto sources = [](std::vector<std::string> kinds) {
    for (const char* source : {"ramp", "sine", "file"}) {
      kinds.push_back(std::string("\"biss-c\"\ndata_bits = 8\nsource = \"") + source + '"');
    }
    return kinds;
  };
  for (const Table& table :
       {Table{channel, "protocol",
              sources({"\"biss-c\"", "\"biss-c\"\nactuator = true\ndata_bits = 8", "\"biss-b\"",
                       "\"ssi\"", "\"ssi\"\ncontrol = true\ndata_bits = 8", "\"replay\"",
                       "\"replay\"\nplay = \"clock\"\ndata_bits = 8"}),
              39},
        Table{"[master]\ntype = \"dsl-model\"\n" + channel,
              "protocol",
              {"\"dsl\"", "\"dsl\"\nsource = \"ramp\"", "\"dsl\"\nsource = \"sine\"",
               "\"dsl\"\nsource = \"file\""},
              30},
        Table{fault,
              "kind",
              {"\"bit-flip\"", "\"glitch\"", "\"stuck\"", "\"jitter\"", "\"silent\"", "\"abort\"",
               "\"clock-frequency\"", "\"silent\"\nslave = 1\nper_s = 1"},
              14}}) {
    const auto unknown = [&](const std::string& line, const std::string& word) {
      try {
        parse_scenario(table.head + line + word + " = [[[]]]\n", "s");  // right nowhere
      } catch (const ScenarioError& error) {
        return std::string(error.what()).find("'" + word + "': unknown key") != std::string::npos;
      }
      return false;
    };
    unsigned known = 0;
    for (const std::string& word : words) {
      if (word == table.key) continue;
      bool taken = false;
      for (const std::string& kind : table.kinds) {
        const std::string line = table.key + " = " + kind + '\n';
        if (line.find('\n' + word + " =") != std::string::npos) continue;
        taken = taken || !unknown(line, word);
      }
      EXPECT_EQ(unknown("", word), !taken) << table.key << ' ' << word;
      known += taken ? 1 : 0;
    }
    EXPECT_GE(known, table.expected) << table.key;
  }
}

TEST(Scenario, Master_IsTheIcMb4) {
  for (const char* text : {"", "[master]\n", "[master]\ntype = \"ic-mb4\"\n"}) {
    EXPECT_EQ(parse_scenario(text, "s").master->type, "ic-mb4") << text;
  }
}

TEST(Scenario, HostInterfaces_AreReadWithTheirKeys) {
  const auto host = [](const std::string& keys) {
    return parse_scenario("[host]\n" + keys, "s").host;
  };
  EXPECT_EQ(host("").interface, HostInterface::kSpi);
  EXPECT_EQ(host("interface = \"spi2\"\nsclk_hz = 5_000_000").interface, HostInterface::kSpi2);
  EXPECT_EQ(host("sclk_hz = 5_000_000").sclk2_hz, 5'000'000U);
  EXPECT_EQ(host("sclk_hz = 5_000_000\nsclk2_hz = 20_000_000").sclk2_hz, 20'000'000U);
  EXPECT_EQ(host("interface = \"intel\"").interface, HostInterface::kIntel);
  EXPECT_EQ(host("interface = \"intel\"").cycle, 1000 * kPsPerNs);
  EXPECT_EQ(host("interface = \"motorola\"\ncycle_ns = 60").cycle, 60 * kPsPerNs);
  EXPECT_TRUE(host("interface = \"motorola\"").parallel());
  EXPECT_FALSE(host("interface = \"spi2\"").parallel());
}

TEST(Scenario, CableLength_Is5Point3NanosecondsPerMetreEachWay) {
  const Scenario scenario = parse_scenario("[[channel]]\nnumber = 1\ncable_m = 10.0\n", "s");
  EXPECT_EQ(scenario.channels[0].cable->delay, 106'000U);
}

TEST(Scenario, Flips_AreListedByFrame) {
  const Scenario scenario =
      parse_scenario("[[channel]]\nnumber = 1\nflips = [[3, 2, 9], [5, 0], [3, 4]]\n", "s");
  const std::map<std::uint64_t, std::vector<unsigned>> expected{{3, {2, 9, 4}}, {5, {0}}};
  EXPECT_EQ(scenario.channels[0].cable->flips, expected);
}

TEST(Scenario, Quirks_SetTheirBits) {
  const auto quirks = [](const std::string& keys) {
    return parse_scenario("[chip.quirks]\n" + keys, "s").chip.quirks;
  };
  EXPECT_EQ(quirks("IDA_TEST_INVERT = true"), 0b000001U);
  EXPECT_EQ(quirks("AGSERR_ON_INSTR_WRITE = true"), 0b000010U);
  EXPECT_EQ(quirks("AGSERR_ON_HOLDBANK = true"), 0b000100U);
  EXPECT_EQ(quirks("AGS_CLEARED_ON_ERROR = true"), 0b001000U);
  EXPECT_EQ(quirks("REVISION = 0x20"), 0b000000U);
  EXPECT_EQ(quirks("REVISION = 0x10"), 0b010000U);
  EXPECT_EQ(quirks("REVISION = 0x11"), 0b100000U);
}

TEST(Scenario, Word64Bits_IsWrittenAsString) {
  const Scenario scenario =
      parse_scenario(slave("data_bits = 64\ndata = \"0xFFFF_FFFF_FFFF_FFFF\""), "s");
  EXPECT_EQ(biss_c(scenario).source.constant, UINT64_MAX);
}

TEST(Scenario, ControlKeys_AreReadCompletely) {
  const Scenario scenario = parse_scenario(slave(R"(data_bits = 8
ids = 2
banks = { 1 = { 0x00 = [1, 2], 0x3F = 3 }, 0x20 = {} }
missing = [0x50, "0x60-0x62"]
write_protected = ["0x44"]
read_busy_frames = 7
write_busy_us = 12.5
store_busy_frames = "forever")"),
                                           "s");
  const ControlConfig& control = biss_c(scenario).control;
  EXPECT_TRUE(control.present);
  EXPECT_EQ(control.ids, 2U);
  ASSERT_EQ(control.banks.size(), 2U);
  EXPECT_EQ(control.banks.at(1)[1], 2);
  EXPECT_EQ(control.banks.at(1)[0x3F], 3);
  EXPECT_EQ(control.missing.count(), 4U);
  EXPECT_TRUE(control.missing[0x50] && control.missing[0x60] && control.missing[0x62]);
  EXPECT_EQ(control.write_protected.count(), 1U);
  EXPECT_TRUE(control.write_protected[0x44]);
  EXPECT_EQ(control.read_busy.frames, 7U);
  EXPECT_EQ(control.write_busy.time, from_us(12.5));
  EXPECT_EQ(control.store_busy.frames, BusyTime::kForever);
}

TEST(Scenario, ControlOff_MakesAUnidirectionalSlave) {
  EXPECT_FALSE(
      biss_c(parse_scenario(slave("data_bits = 8\ncontrol = false"), "s")).control.present);
  EXPECT_FALSE(biss_c(parse_scenario(slave("preset = \"resolute-26\""), "s")).control.present);
  EXPECT_TRUE(biss_c(parse_scenario(slave("preset = \"resolute-26\"\ncontrol = true"), "s"))
                  .control.present);
}

TEST(Scenario, SecondChannel_TakesSlaves5To8) {
  const Scenario scenario = parse_scenario(
      "[[channel]]\nnumber = 2\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 8\n", "s");
  EXPECT_EQ(scenario.channel(1), nullptr);
  ASSERT_NE(scenario.channel(2), nullptr);
}

// ---- What a scenario may leave out --------------------------------------------------------------

TEST(Scenario, PresetWithoutProtocol_HasItsOwn) {
  const Scenario scenario = parse_scenario(
      "[[channel]]\n[[channel.slave]]\npreset = \"posital-ssi-25\"\n"
      "[[channel]]\n[[channel.slave]]\npreset = \"ic-nq\"\n",
      "s");
  ASSERT_NE(scenario.channel(1), nullptr);
  ASSERT_NE(scenario.channel(2), nullptr);
  EXPECT_EQ(scenario.channel(1)->protocol().key, "ssi");
  EXPECT_EQ(scenario.channel(1)->slaves[0].data_bits(), 25U);
  EXPECT_EQ(scenario.channel(2)->protocol().key, "biss-b");
}

TEST(Scenario, ChannelsWithoutNumber_HaveThatOfTheirPlace) {
  const std::string event = "[[channel]]\ndelay_ns = ";
  const Scenario scenario = parse_scenario(event + "1\n" + event + "2\nnumber = 2\n", "s");
  EXPECT_EQ(clocked(*scenario.channel(1)->cable).delay, from_ns(1));
  EXPECT_EQ(clocked(*scenario.channel(2)->cable).delay, from_ns(2));
}

// 1000 counts in 10 ms, or a quarter of the positions: 2 flags of 8 bits leave 64.
TEST(Scenario, SineAlone_IsSmallAndSlow) {
  const auto source = [](const char* bits) {
    const Scenario scenario =
        parse_scenario(slave(std::string("source = \"sine\"\ndata_bits = ") + bits), "s");
    return scenario.channels[0].slaves[0].device.as<BissCSlaveConfig>().source;
  };
  EXPECT_EQ(source("28").amplitude, 1000);
  EXPECT_EQ(source("28").period, from_us(10'000));
  EXPECT_EQ(source("28").offset, 0);
  EXPECT_EQ(source("8").amplitude, 16);
}

TEST(Scenario, FaultOfTheOnlySlave_NeedsNoNumber) {
  const std::string fault = "\n[[fault]]\nkind = \"silent\"\nat_us = 1\n";
  EXPECT_EQ(parse_scenario(slave("data_bits = 8") + fault, "s").faults.at(0).slave, 1U);
}

struct BadScenario {
  const char* name;
  std::string text;
  const char* message;  // complete
};

void PrintTo(const BadScenario& bad, std::ostream* out) { *out << bad.name; }

class Scenarios : public testing::TestWithParam<BadScenario> {};

TEST_P(Scenarios, BadInput_GivesOneLineWithPlaceAndKey) {
  try {
    parse_scenario(GetParam().text, "s.toml");
    FAIL() << "accepted";
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.what(), with_section(GetParam().text, GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bad, Scenarios,
    testing::Values(
        BadScenario{"UnknownTable", "[chips]\n",
                    "s.toml:1:2: key 'chips': unknown key, did you mean '[chip]'?"},
        BadScenario{
            "Master", "[master]\ntype = \"ic-mb9\"\n",
            "s.toml:2:8: key 'type': unknown value 'ic-mb9', expected one of: ic-mb4, axi, clb, "
            "pru, dsl, dsl-model; did you mean \"ic-mb4\"?"},
        BadScenario{"MasterKey", "[master]\nname = \"ic-mb4\"\n",
                    "s.toml:2:1: key 'name': unknown key, known here: type"},
        BadScenario{"UnknownKey", "[chip]\nf_clk_hz = 20_000_000\nf_clk = 3\n",
                    "s.toml:3:1: key 'f_clk': unknown key, did you mean 'f_clk_hz'?"},
        BadScenario{"WrongType", "[chip]\nf_clk_hz = \"fast\"\n",
                    "s.toml:2:12: key 'f_clk_hz': expected an integer, found a string"},
        BadScenario{"WholeNumberAsFloat", "[chip]\nf_clk_hz = 2e7\n",
                    "s.toml:2:12: key 'f_clk_hz': expected an integer, found a floating-point "
                    "number; write f_clk_hz = 20_000_000"},
        BadScenario{"BrokenNumber", "[chip]\nf_clk_hz = 20.5\n",
                    "s.toml:2:12: key 'f_clk_hz': expected an integer, found a floating-point "
                    "number"},
        BadScenario{"Infinite", "[chip]\nf_clk_hz = inf\n",
                    "s.toml:2:12: key 'f_clk_hz': expected an integer, found a floating-point "
                    "number"},
        BadScenario{"Negative", "[chip]\nf_clk_hz = -1\n",
                    "s.toml:2:12: key 'f_clk_hz': -1 is outside 0 to 200000000"},
        BadScenario{"TooSlow", "[chip]\nf_clk_hz = 10\n",
                    "s.toml:2:12: key 'f_clk_hz': 10 is below 1000 (0 = not connected)"},
        BadScenario{"Oscillator", "[chip]\nf_osc_hz = 30_000_000\n",
                    "s.toml:2:12: key 'f_osc_hz': 30000000 is outside 10000000 to 25000000"},
        BadScenario{"SlowOscillator", "[chip]\nf_osc_hz = 9_999_999\n",
                    "s.toml:2:12: key 'f_osc_hz': 9999999 is outside 10000000 to 25000000"},
        BadScenario{"Quirk", "[chip.quirks]\nNO_SUCH = true\n",
                    "s.toml:2:1: key 'NO_SUCH': unknown key, known here: AGSERR_ON_HOLDBANK, "
                    "AGSERR_ON_INSTR_WRITE, AGS_CLEARED_ON_ERROR, IDA_TEST_INVERT, REVISION"},
        BadScenario{"QuirkType", "[chip.quirks]\nIDA_TEST_INVERT = 2\n",
                    "s.toml:2:19: key 'IDA_TEST_INVERT': expected true or false, found an integer"},
        BadScenario{"Revision", "[chip.quirks]\nREVISION = 0x21\n",
                    "s.toml:2:12: key 'REVISION': expected 0x20 (Y), 0x10 (Z) or 0x11 (Z1)"},
        BadScenario{"CycleNs", "[host]\ncycle_ns = 59\n",
                    "s.toml:2:12: key 'cycle_ns': 59 is outside 60 to 1000000"},
        BadScenario{"Interface", "[host]\ninterface = \"i2c\"\n",
                    "s.toml:2:13: key 'interface': unknown value 'i2c', expected one of: spi, "
                    "spi2, intel, motorola, axi, wb"},
        BadScenario{"Sclk", "[host]\nsclk_hz = 60_000_000\n",
                    "s.toml:2:11: key 'sclk_hz': 60000000 is outside 1000 to 50000000"},
        BadScenario{"Ma", "[host]\nma_hz = 4_000_000\n",
                    "s.toml:2:9: key 'ma_hz': the chip cannot make 4000000 Hz from 20000000 Hz; "
                    "nearest: 3333333 and 5000000"},
        BadScenario{"ChannelNumber", "[[channel]]\nnumber = 3\n",
                    "s.toml:2:10: key 'number': 3 is outside 1 to 2"},
        BadScenario{"NoNumberLeft", "[[channel]]\n[[channel]]\n[[channel]]\ndelay_ns = 1\n",
                    "s.toml:3:1: key 'number': the master has no channel 3"},
        BadScenario{"NumberOfTheOrderTaken", "[[channel]]\nnumber = 2\n[[channel]]\n",
                    "s.toml:3:1: key 'number': channel 2 is given twice, first in line 2; write "
                    "number = 1"},
        BadScenario{"TwoOnes", "[[channel]]\nnumber = 1\n[[channel]]\nnumber = 1\n",
                    "s.toml:4:10: key 'number': channel 1 is given twice, first in line 2; write "
                    "number = 2"},
        BadScenario{"Delay", "[[channel]]\nnumber = 1\ndelay_ns = -0.5\n",
                    "s.toml:3:12: key 'delay_ns': -0.5 is outside 0 to 1e+06"},
        BadScenario{"DelayNan", "[[channel]]\nnumber = 1\ndelay_ns = nan\n",
                    "s.toml:3:12: key 'delay_ns': nan is outside 0 to 1e+06"},
        BadScenario{"DelayAndCable", "[[channel]]\nnumber = 1\ndelay_ns = 1\ncable_m = 1\n",
                    "s.toml:4:11: key 'cable_m': cannot be given together with delay_ns"},
        BadScenario{"Flips", "[[channel]]\nnumber = 1\nflips = 3\n",
                    "s.toml:3:9: key 'flips': expected lists of a frame from 1 on and bits of 0 to "
                    "4095"},
        BadScenario{"FlipsWithoutBit", "[[channel]]\nnumber = 1\nflips = [[1, 2], [3]]\n",
                    "s.toml:3:18: key 'flips': expected lists of a frame from 1 on and bits of 0 "
                    "to 4095"},
        BadScenario{"FlipsInFrame0", "[[channel]]\nnumber = 1\nflips = [[0, 2]]\n",
                    "s.toml:3:11: key 'flips': expected lists of a frame from 1 on and bits of 0 "
                    "to 4095"},
        BadScenario{"FlipsOfANegativeBit", "[[channel]]\nnumber = 1\nflips = [[1, -2]]\n",
                    "s.toml:3:14: key 'flips': expected lists of a frame from 1 on and bits of 0 "
                    "to 4095"},
        BadScenario{"NoProtocol", "[[channel]]\nnumber = 1\n[[channel.slave]]\ndata_bits = 8\n",
                    "s.toml:3:1: key 'protocol': missing, and there is no preset"},
        BadScenario{"NoLength", slave(""), "s.toml:3:1: key 'data_bits': missing"},
        BadScenario{"Length", slave("data_bits = 65"),
                    "s.toml:5:13: key 'data_bits': 65 is outside 1 to 64"},
        BadScenario{"Crc", slave("data_bits = 8\ncrc = 0x42"),
                    "s.toml:6:7: key 'crc': not a full polynomial such as 0x43 (0 = no CRC)"},
        BadScenario{
            "Data", slave("data_bits = 8\ndata = 0x100"),
            "s.toml:6:8: key 'data': does not fit into 8 bits: 0x100 needs data_bits = 9, the "
            "highest is 0xFF"},
        BadScenario{
            "Timeout", slave("data_bits = 8\ntimeout = \"soon\""),
            "s.toml:6:11: key 'timeout': expected \"adaptive\" or a number of microseconds"},
        BadScenario{"TimeoutZero", slave("data_bits = 8\ntimeout = 0"),
                    "s.toml:6:11: key 'timeout': 0 is outside 0.05 to 1e+06"},
        BadScenario{"Busy", slave("data_bits = 8\nbusy_periods = -1"),
                    "s.toml:6:16: key 'busy_periods': -1 is outside 0 to 1000000"},
        BadScenario{"DataAndSource", slave("data_bits = 8\nsource = \"ramp\"\ndata = 1"),
                    "s.toml:7:8: key 'data': cannot be given together with source"},
        BadScenario{"RampKeyWithoutRamp", slave("data_bits = 8\nstep = 1"),
                    "s.toml:6:1: key 'step': unknown key; it goes with source = \"ramp\""},
        BadScenario{"Register", slave("data_bits = 8\nregisters = { 0x144 = 1 }"),
                    "s.toml:6:15: key '0x144': expected a register address of 0x00 to 0xFF (in "
                    "[channel.slave.registers])"},
        BadScenario{
            "RegisterValue", slave("data_bits = 8\nregisters = { 0x44 = [256] }"),
            "s.toml:6:23: key '0x44': expected bytes of 0 to 255 (in [channel.slave.registers])"},
        BadScenario{
            "RegisterPastEnd", slave("data_bits = 8\nregisters = { 0xFF = [1, 2] }"),
            "s.toml:6:26: key '0xFF': runs past register 0xFF (in [channel.slave.registers])"},
        BadScenario{
            "RegisterTwice", slave("data_bits = 8\nregisters = { 0x44 = 1, 68 = 2 }"),
            "s.toml:6:30: key '68': register 0x44 is given twice (in [channel.slave.registers])"},
        BadScenario{
            "RegistersOverlap",
            slave("data_bits = 8\nregisters = { 0x44 = [1, 2], 0x43 = [3, 4] }"),
            "s.toml:6:41: key '0x43': register 0x44 is given twice (in [channel.slave.registers])"},
        BadScenario{"Control", slave("data_bits = 8\ncontrol = 2"),
                    "s.toml:6:11: key 'control': expected true or false, found an integer"},
        BadScenario{"IdsWithoutControl", slave("data_bits = 8\ncontrol = false\nids = 1"),
                    "s.toml:7:7: key 'ids': needs control = true"},
        BadScenario{"IdsOfUnidirectional", slave("preset = \"resolute-26\"\nids = 1"),
                    "s.toml:6:7: key 'ids': needs control = true"},
        BadScenario{"Ids", slave("data_bits = 8\nids = 9"),
                    "s.toml:6:7: key 'ids': 9 is outside 1 to 8"},
        BadScenario{
            "Bank", slave("data_bits = 8\nbanks = { 256 = { 0 = 1 } }"),
            "s.toml:6:11: key '256': expected a bank of 1 to 255 (in [channel.slave.banks])"},
        BadScenario{
            "Bank0", slave("data_bits = 8\nbanks = { 0 = { 0 = 1 } }"),
            "s.toml:6:11: key '0': bank 0 is registers 0x00 to 0x3F (in [channel.slave.banks])"},
        BadScenario{"BankTwice", slave("data_bits = 8\nbanks = { 1 = { 0 = 1 }, 0x1 = { } }"),
                    "s.toml:6:26: key '0x1': bank 1 is given twice (in [channel.slave.banks])"},
        BadScenario{"BankNoTable", slave("data_bits = 8\nbanks = { 1 = 3 }"),
                    "s.toml:6:15: key '1': expected a table of bytes by address (in "
                    "[channel.slave.banks])"},
        BadScenario{"BankAddress", slave("data_bits = 8\nbanks = { 1 = { 0x40 = 1 } }"),
                    "s.toml:6:17: key '0x40': expected a register address of 0x00 to 0x3F (in "
                    "[channel.slave.banks.1])"},
        BadScenario{
            "BankPastEnd", slave("data_bits = 8\nbanks = { 1 = { 0x3F = [1, 2] } }"),
            "s.toml:6:28: key '0x3F': runs past register 0x3F (in [channel.slave.banks.1])"},
        BadScenario{"Missing", slave("data_bits = 8\nmissing = 0x44"),
                    "s.toml:6:11: key 'missing': expected a list of register addresses"},
        BadScenario{"MissingAddress", slave("data_bits = 8\nmissing = [0x44, 0x100]"),
                    "s.toml:6:18: key 'missing': expected an address of 0x00 to 0xFF or a range "
                    "such as \"0x44-0x47\""},
        BadScenario{"ProtectedRange", slave("data_bits = 8\nwrite_protected = [\"0x47-0x44\"]"),
                    "s.toml:6:20: key 'write_protected': expected an address of 0x00 to 0xFF or a "
                    "range such as \"0x44-0x47\""},
        BadScenario{"ReadBusy", slave("data_bits = 8\nread_busy_frames = \"long\""),
                    "s.toml:6:20: key 'read_busy_frames': expected \"forever\" or a number of "
                    "frames"},
        BadScenario{"WriteBusy", slave("data_bits = 8\nwrite_busy_frames = -1"),
                    "s.toml:6:21: key 'write_busy_frames': -1 is outside 0 to 1000000"},
        BadScenario{"StoreBusyTwice",
                    slave("data_bits = 8\nstore_busy_frames = 1\nstore_busy_us = 2"),
                    "s.toml:7:17: key 'store_busy_us': cannot be given together with "
                    "store_busy_frames"},
        BadScenario{"SineOverflow",
                    slave("data_bits = 8\nsource = \"sine\"\noffset = -5e18\namplitude = 5e18\n"
                          "period_us = 1"),
                    "s.toml:8:13: key 'amplitude': with offset -5e+18 at most 4e+18"},
        BadScenario{
            "ControlCharacters", "[host]\ninterface = \"\\u001B\\u0000\\u0085\\r\"\n",
            "s.toml:2:13: key 'interface': unknown value '\\x1b\\x00\\x85\\r', expected one "
            "of: spi, spi2, intel, motorola, axi, wb"},
        BadScenario{"ControlCharactersInKey", "\"a\\n\\u0007\" = 1\n",
                    "s.toml:1:1: key 'a\\n\\x07': unknown key, known here: [[channel]], [chip], "
                    "[[fault]], [host], [master], [sim]"},
        BadScenario{"NulInFileName",
                    slave("data_bits = 8\nsource = \"file\"\nfile = \"a\\u0000b\""),
                    "s.toml:7:8: key 'file': a file name cannot hold a NUL character"},
        BadScenario{"NulInEdgeFileName",
                    "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"replay\"\n"
                    "data_bits = 8\nedges = \"a\\u0000b\"\n",
                    "s.toml:6:9: key 'edges': a file name cannot hold a NUL character"},
        BadScenario{"NoEdges",
                    "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"replay\"\n"
                    "data_bits = 8\nedges = \"/no/such/file\"\n",
                    "s.toml:6:9: key 'edges': /no/such/file: cannot read: No such file or "
                    "directory"}),
    [](const auto& entry) { return entry.param.name; });

TEST(Scenario, UnknownPreset_ListsTheKnownOnes) {
  try {
    parse_scenario(slave("preset = \"resolute-27\""), "s.toml");
    FAIL() << "accepted";
  } catch (const ScenarioError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("s.toml:5:10: key 'preset': unknown preset 'resolute-27'", 0), 0U);
    EXPECT_NE(message.find("resolute-26"), std::string::npos);
  }
}

TEST(Scenario, NinthSlave_IsRefused) {
  std::string text = "[[channel]]\nnumber = 1\n";
  for (int i = 0; i < 9; ++i) text += "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 8\n";
  try {
    parse_scenario(text, "s.toml");
    FAIL() << "accepted";
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(
        error.what(),
        "s.toml:27:1: key 'slave': more than 8 slaves on a channel (in [[channel.slave]])");
  }
}

TEST(Scenario, BrokenToml_IsNamedWithItsPlaceInOneLine) {
  try {
    parse_scenario("[chip\n", "s.toml");
    FAIL() << "accepted";
  } catch (const ScenarioError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("s.toml:1:6: not valid TOML: ", 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(Scenario, MissingFile_IsNamed) {
  try {
    load_scenario("/no/such.toml");
    FAIL() << "accepted";
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(error.what(), "/no/such.toml: cannot read: No such file or directory");
  }
}

}  // namespace
}  // namespace mb4test
