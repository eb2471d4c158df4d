// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Misuse that must not compile, one case each; check_compile.py compiles them and looks for the
// message behind "error:". Case 0 does the same things rightly.

#include "mb4_regs.hpp"

using namespace mb4::regs;

#if MB4_CASE == 0  // compiles
constexpr std::uint8_t kInsert = HOLDCDM::insert(0x00, 1);
constexpr std::uint8_t kEncode = HOLDCDM::encode<1>();
constexpr std::uint8_t kLargest = FREQS::encode<31>();
constexpr std::uint8_t kNumber = ENSCD<8>::kAddress;
constexpr std::uint8_t kByte = SCDATA<8, 7>::kAddress;
static_assert(kInsert == 1 && kEncode == 1 && kLargest == 31 && kNumber == 0xDC && kByte == 0x3F);
#elif MB4_CASE == 1  // error: this field is read-only
constexpr std::uint8_t kInsert = EOT::insert(0x00, 1);
#elif MB4_CASE == 2  // error: this field is read-only
constexpr std::uint8_t kEncode = REVISION::encode<1>();
#elif MB4_CASE == 3  // error: the value does not fit the field
constexpr std::uint8_t kLargest = FREQS::encode<32>();
#elif MB4_CASE == 4  // error: the number of this field is out of range
constexpr std::uint8_t kNumber = ENSCD<9>::kAddress;
#elif MB4_CASE == 5  // error: the number of this field is out of range
constexpr std::uint8_t kNumber = SVALID<0>::kAddress;
#elif MB4_CASE == 6  // error: the number of this field is out of range
constexpr std::uint8_t kByte = SCDATA<8, 8>::kAddress;
#endif

int main() { return 0; }
