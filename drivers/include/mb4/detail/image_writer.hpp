// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Writes and compares the registers of a configuration.

#ifndef MB4_DETAIL_IMAGE_WRITER_HPP_
#define MB4_DETAIL_IMAGE_WRITER_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/detail/chip.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// REVISION and VERSION are constant. 0xE0, 0xE1 and 0xEE are reserved, and the datasheet does not
// say what they read. 0xE2..0xE5 change with each control communication: `running`.
constexpr bool is_compared(unsigned address, bool running) {
  const bool control = address >= regs::kAddrRegadr && address <= regs::kAddrCtrl;
  return !(control && running) && (address < 0xE0 || address > 0xE1) && address != 0xEE &&
         address != regs::kAddrRevision && address != regs::kAddrVersion;
}

template <typename Bus, typename Clock>
class ImageWriter {
 public:
  explicit constexpr ImageWriter(Chip<Bus, Clock>& chip) : chip_(chip) {}

  // Three transfers: BREAK, all registers, comparison.
  Result<void> write(const RegisterImage& image, std::uint8_t interface_byte) {
    chip_.image = image;
    const std::array<std::uint8_t, 2> stop_and_interface{regs::BREAK::encode<1>(), interface_byte};
    if (const Result<void> write = chip_.opcodes.write_instruction(stop_and_interface); !write) {
      return write;
    }
    if (const Result<void> write = chip_.opcodes.write_registers(kImageFirst, image); !write) {
      return write;
    }
    return compare(interface_byte, false);
  }

  // With the image that was written last.
  [[gnu::noinline]] Result<void> compare(std::uint8_t interface_byte, bool running) {
    std::array<std::uint8_t, regs::kAddrIface - kImageFirst + 1> bytes{};
    if (const Result<void> read = chip_.opcodes.read_registers(kImageFirst, bytes); !read) {
      return read;
    }
    // VERSION comes first: without a chip every register differs, and kVerify would say less.
    if (bytes[regs::kAddrVersion - kImageFirst] !=
        static_cast<std::uint8_t>(regs::DeviceVersion::kIcMb4)) {
      return Error::kNotDetected;
    }
    for (unsigned address = kImageFirst; address < regs::kAddrStatus0; ++address) {
      if (is_compared(address, running) &&
          bytes[address - kImageFirst] != chip_.image[address - kImageFirst]) {
        return ErrorInfo::at_register(Error::kVerify, static_cast<std::uint8_t>(address));
      }
    }
    if (bytes[regs::kAddrIface - kImageFirst] != interface_byte) {
      return ErrorInfo::at_register(Error::kVerify, regs::kAddrIface);
    }
    return {};
  }

 private:
  Chip<Bus, Clock>& chip_;
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_IMAGE_WRITER_HPP_
