// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Single fields of the register map by type, on top of the opcodes.

#ifndef MB4_FIELDS_HPP_
#define MB4_FIELDS_HPP_

#include <cstdint>
#include <type_traits>

#include "mb4/opcodes.hpp"
#include "mb4/result.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Names a field type (mb4::regs::...) and reads or changes it in the chip:
//
//   fields.get<mb4::regs::SL1>()
//   fields.modify<mb4::regs::HOLDCDM, 1>()
//
// These writes do not compile: read-only fields, constants that do not fit, and fields of 0xF1,
// 0xF2 and 0xF4. Those registers hold bits that clear themselves or that a 0 clears. Writing such a
// register back would start, stop or clear something; Device has its own calls for them. ENTEST
// must stay 0 (page 31).
//
// Device does not know about changes made here. Change the members of Config with
// Device::configure(): otherwise Device decodes readings by the old configuration.
template <typename Bus>
class Fields {
 public:
  explicit constexpr Fields(Opcodes<Bus> opcodes) : opcodes_(opcodes) {}

  // Value of `Field`, right aligned. One transfer (0x03). kTransport. Changes nothing.
  template <typename Field>
  Result<std::uint8_t> get() {
    std::uint8_t value = 0;
    if (const Result<void> read = opcodes_.read_registers(Field::kAddress, one(value)); !read) {
      return read.failure();
    }
    return Field::get(value);
  }

  // Read-modify-write of the byte that holds `Field`. `value` is an integer or one of the code
  // enumerations of mb4::regs. Two transfers (0x03, 0x02); not atomic: nothing else may write this
  // register in between. Errors: kInvalidArgument when `value` does not fit (not touched),
  // kTransport (the register may or may not have changed).
  template <typename Field, typename Value>
  Result<void> modify(Value value) {
    static_assert(std::is_integral_v<Value> || std::is_enum_v<Value>,
                  "mb4: a field takes an integer or an enumeration of mb4::regs");
    check_modifiable<Field>();
    // A negative value becomes a huge one.
    if (static_cast<std::uint64_t>(value) > Field::kMax) {
      return Error::kInvalidArgument;
    }
    return replace<Field>(static_cast<std::uint8_t>(value));
  }

  // The same with a constant, which is checked at compile time.
  template <typename Field, std::uint8_t kValue>
  Result<void> modify() {
    check_modifiable<Field>();
    static_assert(kValue <= Field::kMax, "mb4: the value does not fit the field");
    return replace<Field>(kValue);
  }

 private:
  template <typename Field>
  static constexpr void check_modifiable() {
    static_assert(Field::kAccess != regs::Access::kReadOnly, "mb4: this field is read-only");
    static_assert(Field::kAddress != regs::kAddrInstr,
                  "mb4: writing the instruction register back would repeat or stop an instruction; "
                  "use the calls of mb4::Device");
    static_assert(Field::kAccess == regs::Access::kReadOnly ||
                      Field::kAccess == regs::Access::kReadWrite ||
                      Field::kAddress == regs::kAddrInstr,
                  "mb4: this field is self-clearing or cleared by writing 0; use the calls of "
                  "mb4::Device");
    static_assert(!std::is_same_v<Field, regs::ENTEST>,
                  "mb4: ENTEST is the factory test and must stay 0");
  }

  template <typename Field>
  Result<void> replace(std::uint8_t value) {
    std::uint8_t byte = 0;
    if (const Result<void> read = opcodes_.read_registers(Field::kAddress, one(byte)); !read) {
      return read;
    }
    byte = Field::insert(byte, value);
    return opcodes_.write_registers(Field::kAddress, Span<const std::uint8_t>(&byte, 1));
  }

  static constexpr Span<std::uint8_t> one(std::uint8_t& byte) {
    return Span<std::uint8_t>(&byte, 1);
  }

  Opcodes<Bus> opcodes_;
};

}  // namespace mb4

#endif  // MB4_FIELDS_HPP_
