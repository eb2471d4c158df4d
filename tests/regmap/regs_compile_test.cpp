// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the field types promise, beyond the values of the map. All of it is decided at compile time.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "mb4_regs.hpp"
#include "mb4_regs_table.hpp"
#include "smp_regs.hpp"
#include "smp_regs_table.hpp"

namespace {

using namespace mb4::regs;

// get extracts and aligns, whatever else the byte holds.
static_assert(FREQR::get(0xBF) == 5 && FREQS::get(0xBF) == 0x1F);
static_assert(CFGCH<2>::get(0xF6) == 1);
static_assert(SCRCSTART_HI<8>::get(0xA5) == 0xA5);

// insert replaces its own bits only, and drops what does not fit.
static_assert(FREQR::insert(0xFF, 0) == 0x1F && FREQR::insert(0x00, 5) == 0xA0);
static_assert(SCDLEN<1>::insert(0xC0, 0x7F) == 0xFF);
static_assert(SVALID<1>::insert(0xFF, 0) == 0xFD);

// encode puts a constant in place.
static_assert(INSTR::encode<static_cast<std::uint8_t>(Instr::kControl)>() == 0x08);
static_assert((BREAK::encode<1>() | AGS::encode<1>()) == 0x81);

// of puts a code or a number in place, and drops what does not fit.
static_assert(INSTR::of(Instr::kControl) == 0x08 && INSTR::of(0xFF) == 0x0E);
static_assert(SCDLEN<3>::of(28) == 28 && FREQR::of(5) == 0xA0);

// Codes in place, and single bytes.
static_assert(kInstrControl == 0x08 && kBreakAbort == 0x80 && kCfgch2Unused == 0x0C);
static_assert(kEnscdYes == 0x40 && kSpiOpcodeReadRegisters0 == 0x09);

// What a register holds after reset, what a host can write, what never changes.
static_assert(kResetStatus0 == 0xFB && kConstStatus0 == 0x02 && kWmaskStatus0 == 0x00);
static_assert(kResetSlaveloc5 == 0x01 && kConstSlaveloc5 == 0xEF && kWmaskSlaveloc5 == 0x10);

// Members.
static_assert(EOT::kAddress == kAddrStatus0 && EOT::kMask == 0x01 && EOT::kReset == 1);
static_assert(!EOT::kWritable && HOLDCDM::kWritable && INIT::kWritable && SVALID<4>::kWritable);
static_assert(FREQS::kMax == 0x1F && FREQS::kMask == 0x1F && FREQR::kMask == 0xE0);
static_assert(std::is_same_v<CFGCH1, CFGCH<1>> && std::is_same_v<SL2, SL<2>>);
static_assert(IDS0::kMask == 0x80 && IDS7::kMask == 0x01 && IDS::kMask == 0xFF);
static_assert(CHSEL::kMask == 0x03 && ACTnSENS_ALL::kMask == 0xFF);

// Addresses, at compile time and at run time.
static_assert(scdata_address(1) == 0x00 && scdata_address(8) == 0x38);
static_assert(SCDATA<5>::kAddress == 0x20 && SCDATA<8, 7>::kAddress == 0x3F);
static_assert(slave_cfg_address(1) == 0xC0 && slave_cfg_address(8) == 0xDC);
static_assert(rdata_address(1) == 0x80 && rdata_address(64) == 0xBF);
static_assert(kFamilySvalid.address(4) == 0xF1 && kFamilySvalid.address(5) == 0xF2);
static_assert(kFamilySvalid.mask(4) == 0x80 && kFamilySvalid.mask(5) == 0x02);

// The table holds every address that has a field, in order, and names both meanings of dual-use
// bits.
constexpr bool ascending() {
  for (std::size_t i = 1; i < kFields.size(); ++i) {
    const FieldInfo& a = kFields[i - 1];
    const FieldInfo& b = kFields[i];
    if (a.address > b.address || (a.address == b.address && a.lsb <= b.lsb)) {
      return false;
    }
  }
  return true;
}
static_assert(ascending());

constexpr int dual_use() {
  int count = 0;
  for (const FieldInfo& field : kFields) {
    count += field.alternate != nullptr ? 1 : 0;
  }
  return count;
}
static_assert(dual_use() == 1 + 8 + 8 + 1);  // RDATA1, GRAYSx, SCRCLENx, SLAVEID

// Codes have names, which are those of the datasheet where it has some.
constexpr std::string_view code_name(std::string_view name, std::uint32_t code) {
  for (const FieldInfo& field : kFields) {
    if (field.name != name) continue;
    for (std::size_t i = 0; i < field.codes; ++i) {
      const CodeInfo& info = kCodes[field.first_code + i];
      if (code >= info.first && code <= info.last) return info.name;
    }
  }
  return "no such code";
}
static_assert(code_name("CFGCH1", static_cast<std::uint32_t>(Protocol::kBissC)) == "BiSS_C");
static_assert(code_name("FREQAGS", 0x7C) == "AGSMIN" &&
              code_name("FREQAGS", 0x7F) == "AGSINFINITE");
static_assert(code_name("FREQS", 4).empty() && code_name("SCDATA1(7:0)", 4) == "no such code");

// A map with registers of 32 bits, addresses of 12 bits and all kinds of access.
namespace smp = test::smp;
static_assert(std::is_same_v<decltype(smp::WHOLE::kMask), const std::uint32_t>);
static_assert(std::is_same_v<decltype(smp::WHOLE::kAddress), const std::uint16_t>);
static_assert(smp::WHOLE::kMask == 0xFFFFFFFF && smp::TOP::kMask == 0x80000000);
static_assert(smp::WHOLE::insert(0, 0xDEADBEEF) == smp::kResetWhole);
static_assert(smp::MODE::get(smp::kResetControl) == 5 && smp::kModeAlways == 0x5000);
static_assert(smp::DONE::kAccess == smp::Access::kWriteOneClears && smp::DONE::kWritable);
static_assert(smp::COUNT::kAccess == smp::Access::kReadClears && !smp::COUNT::kWritable);
static_assert(smp::KEY::kAccess == smp::Access::kWriteOnly && smp::START::kWritable);
static_assert(smp::ERROR<3>::kAddress == 0x124 && smp::line_address(3) == 0x120);
static_assert(smp::POSITION<2, 1>::kAddress == 0xF0C && smp::kFamilyDelay.mask(3) == 0xFFF);
static_assert(smp::kConstEvents == 0xF0000000 && smp::kWmaskEvents == 0x7);

}  // namespace

int main() { return 0; }
