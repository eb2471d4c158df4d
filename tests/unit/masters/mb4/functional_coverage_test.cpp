// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/functional_coverage.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "mb4_regs.hpp"
#include "mb4sim/simulator.hpp"

namespace mb4::sim {
namespace {

namespace reg = mb4::regs;

// A chip that is configured for one slave of 26 bits at BiSS C, by the host of the parameter.
class CoverageOfHost : public testing::TestWithParam<HostInterface> {
 protected:
  CoverageOfHost() : simulator_(scenario()) {
    simulator_.set_observer(&coverage_);
    write(reg::slave_cfg_address(1),
          {static_cast<std::uint8_t>(reg::ENSCD<1>::kMask | 25), 6});  // SCDLEN1, SCRCLEN1
    write(reg::kAddrFreq, {reg::FREQS::kMask});                        // FREQR = 0, FREQS maximum
    write(reg::kAddrCfgch, {reg::kCfgch1BissC | reg::kCfgch2Unused});
  }
  static Scenario scenario() {
    Scenario loaded = load_scenario(MB4_EXAMPLES "/resolute-26.toml");
    loaded.host.interface = GetParam();
    return loaded;
  }
  void write(std::uint8_t address, std::vector<std::uint8_t> bytes) {
    if (scenario().host.parallel()) {
      for (const std::uint8_t byte : bytes) simulator_.bus().write(address++, byte);
      return;
    }
    std::vector<std::uint8_t> rx;
    bytes.insert(bytes.begin(), {reg::kSpiOpcodeWriteRegisters, address});
    simulator_.spi().transfer(bytes, rx);
  }
  void instruct(std::uint8_t byte) { write(reg::kAddrInstr, {byte}); }
  // {kind of frame: {class: count}} of what was reached.
  std::map<std::string, std::map<std::string, std::uint64_t>> reached() {
    std::map<std::string, std::map<std::string, std::uint64_t>> found;
    std::istringstream lines(coverage_.text());
    for (std::string number, kind, value; std::getline(lines, number, '\t');) {
      std::getline(lines, kind, '\t');
      std::getline(lines, value);
      if (number != "0") found[kind][value] = std::stoull(number);
    }
    return found;
  }

  FunctionalCoverage coverage_;
  Simulator simulator_;
};

TEST_P(CoverageOfHost, NoFrame_ReachesNothing) {
  simulator_.advance(1000 * kPsPerUs);
  EXPECT_EQ(coverage_.reached(), 0U);
  EXPECT_GT(coverage_.points(), 1000U);
}

TEST_P(CoverageOfHost, OneFrame_CountsTheClassOfEveryField) {
  instruct(reg::kInstrCdm0);
  simulator_.advance(2000 * kPsPerUs);
  auto found = reached();
  ASSERT_EQ(found.size(), 1U);
  auto& frame = found["BiSS C frame, one"];
  for (const char* value : {"ENSCD1=1", "SCDLEN1=middle", "SCRCLEN1=middle", "FREQR=0",
                            "FREQS=maximum", "CFGCH1=1", "CFGCH2=3", "SCDLEN2=0", "REGVERS=0"}) {
    EXPECT_EQ(frame[value], 1U) << value;
  }
}

TEST_P(CoverageOfHost, AutomaticFrames_CountByTheirStart) {
  write(reg::kAddrFreqags, {reg::kFreqagsAgsMin});
  instruct(static_cast<std::uint8_t>(reg::kInstrCdm0 | reg::AGS::kMask));
  simulator_.advance(2000 * kPsPerUs);
  instruct(0);
  simulator_.advance(2000 * kPsPerUs);
  auto found = reached();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found["BiSS C frame, AGSMIN"]["ENSCD1=1"], simulator_.slave(1)->frames());
  EXPECT_EQ(found["BiSS C frame, AGSMIN"].count("FREQAGS=middle"), 0U);
}

TEST_P(CoverageOfHost, AccessAndInit_CountOnce) {
  write(reg::kAddrFreq, {0});
  write(reg::kAddrCtrl, {static_cast<std::uint8_t>(reg::kRegversBissC)});
  instruct(reg::INIT::kMask);
  simulator_.advance(2000 * kPsPerUs);
  write(reg::kAddrRegadr, {0x44, 0});
  write(reg::kAddrCtrl, {static_cast<std::uint8_t>(reg::kCtsRegisterAccess | reg::kRegversBissC)});
  instruct(reg::kInstrControl);
  simulator_.advance(2000 * kPsPerUs);
  auto found = reached();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found["BiSS C INIT"]["REGADR=0"], 1U);
  EXPECT_EQ(found["BiSS C register read"]["REGADR=middle"], 1U);
}

TEST_P(CoverageOfHost, ResetAndAnotherRun_AreTakenIn) {
  simulator_.set_pin(Pin::kNres, false);
  simulator_.advance(kPsPerUs);
  simulator_.set_pin(Pin::kNres, true);
  simulator_.advance(kPsPerUs);
  write(reg::kAddrCfgch, {reg::kCfgch1Ssi | reg::kCfgch2Unused});
  instruct(reg::kInstrCdm0);
  simulator_.advance(2000 * kPsPerUs);
  EXPECT_EQ(reached()["SSI frame, one"]["ENSCD1=0"], 1U);
  FunctionalCoverage other;
  other.add(coverage_.counts());
  other.add(coverage_.counts());
  EXPECT_EQ(other.reached(), coverage_.reached());
  EXPECT_NE(other.text(), coverage_.text());
}

INSTANTIATE_TEST_SUITE_P(Hosts, CoverageOfHost,
                         testing::Values(HostInterface::kSpi, HostInterface::kIntel,
                                         HostInterface::kMotorola),
                         [](const auto& host) {
                           return host.param == HostInterface::kSpi     ? "Spi"
                                  : host.param == HostInterface::kIntel ? "Intel"
                                                                        : "Motorola";
                         });

}  // namespace
}  // namespace mb4::sim
