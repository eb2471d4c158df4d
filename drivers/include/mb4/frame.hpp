// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What one frame delivered for all slaves, how it is fetched, and how it is judged.

#ifndef MB4_FRAME_HPP_
#define MB4_FRAME_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// All slaves of one frame. The caller provides it; about 330 bytes.
class Frame {
 public:
  // The result of slave 1..8: a Reading, or what is wrong with it: kCrc, kNoData (no new frame
  // since the last read, or none for this slave), kCorrupted. kInvalidArgument: not enabled.
  [[nodiscard]] const Result<Reading>& operator[](std::size_t slave) const {
    return results_[slave - 1];
  }
  void set(std::size_t slave, const Result<Reading>& result) { results_[slave - 1] = result; }

  // Every slave of `mask` (bit 0 is slave 1) has a Reading.
  [[nodiscard]] bool good(std::uint8_t mask) const {
    for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
      if ((mask >> (slave - 1) & 1U) != 0 && !results_[slave - 1]) {
        return false;
      }
    }
    return true;
  }

  // Status read after the data.
  Status status;

 private:
  static constexpr Error kNone = Error::kInvalidArgument;
  std::array<Result<Reading>, kSlaves> results_{
      {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone}};
};

namespace detail {

// SCDATA1 to 8 as fetched; bytes that no slave needs stay 0.
using DataImage = std::array<std::uint8_t, kSlaves * regs::kScdataStride>;

// What MOSI carries while data is read, with SpiCheck::kFull: should a disturbed bit turn the read
// into a write, then not into one of zeros, which pass for data with a CRC.
inline constexpr std::uint8_t kDataFiller = 0x5A;

// Reads bytes `begin` to `end - 1` of SCDATA. From 0x00 upwards opcode 0x09 is one byte shorter
// than 0x03 and needs no stretched clock (I204).
template <typename Bus>
Result<void> read_run(Opcodes<Bus>& opcodes, const Config& config, DataImage& image,
                      std::size_t begin, std::size_t end) {
  const Span<std::uint8_t> bytes(&image[begin], end - begin);
  const std::uint8_t filler = config.spi_check == SpiCheck::kFull ? kDataFiller : 0;
  return begin == 0 ? opcodes.read_registers0(bytes, filler)
                    : opcodes.read_registers(static_cast<std::uint8_t>(begin), bytes, filler);
}

// Fetches just the bytes that the slaves of `mask` need: at least one transfer, at most one a
// slave. Neighbours share a transfer when skipping the bytes between them costs no more than
// another opcode and address.
template <typename Bus>
Result<void> read_data(Opcodes<Bus>& opcodes, const Config& config, std::uint8_t mask,
                       DataImage& image) {
  constexpr std::size_t kHeaderBytes = 2;
  std::size_t begin = 0;
  std::size_t end = 0;
  for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
    if ((mask >> (slave - 1) & 1U) == 0) {
      continue;
    }
    const std::size_t from = regs::scdata_address(static_cast<unsigned>(slave));
    if (end != 0 && from - end > kHeaderBytes) {
      if (const Result<void> read = read_run(opcodes, config, image, begin, end); !read) {
        return read;
      }
      end = 0;
    }
    if (end == 0) {
      begin = from;
    }
    end = from + reading_bytes(config, static_cast<std::uint8_t>(slave));
  }
  return end == 0 ? Result<void>() : read_run(opcodes, config, image, begin, end);
}

// Data as fetched, and which slaves' bytes were the same when they were read again.
struct FetchedData {
  DataImage image{};
  std::uint8_t stable = 0xFF;  // bit 0 is slave 1
};

// SpiCheck::kFull: data that nothing else proves. Without a stored CRC that is any data. All zeros
// and all ones, a line that was stuck for a moment, may pass with one.
[[nodiscard]] constexpr bool needs_second_reading(const Config& config, std::uint8_t slave,
                                                  Span<const std::uint8_t> bytes) {
  const SlaveConfig& slave_config = config.slaves[slave - 1U];
  if (!crc_is_stored(config, slave_config)) {
    return true;
  }
  std::uint8_t all_and = 0xFF;
  std::uint8_t all_or = 0;
  for (std::size_t i = 0; i < data_bytes(slave_config); ++i) {
    all_and = static_cast<std::uint8_t>(all_and & bytes[i]);
    all_or = static_cast<std::uint8_t>(all_or | bytes[i]);
  }
  return all_or == 0 || all_and == 0xFF;
}

// read_data(), and with SpiCheck::kFull as many transfers again for what needs it.
template <typename Bus>
Result<void> fetch_data(Opcodes<Bus>& opcodes, const Config& config, std::uint8_t mask,
                        FetchedData& data) {
  const Result<void> first = read_data(opcodes, config, mask, data.image);
  if (!first || config.spi_check != SpiCheck::kFull) {
    return first;
  }
  unsigned again = 0;
  for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
    const Span<const std::uint8_t> bytes(&data.image[regs::scdata_address(slave)],
                                         regs::kScdataStride);
    if ((mask >> (slave - 1U) & 1U) != 0 && needs_second_reading(config, slave, bytes)) {
      again |= 1U << (slave - 1U);
    }
  }
  DataImage second{};
  if (const Result<void> read =
          read_data(opcodes, config, static_cast<std::uint8_t>(again), second);
      !read) {
    return read;
  }
  for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
    const std::size_t from = regs::scdata_address(slave);
    for (std::size_t i = 0; i < regs::kScdataStride; ++i) {
      if ((again >> (slave - 1U) & 1U) != 0 && i < reading_bytes(config, slave) &&
          data.image[from + i] != second[from + i]) {
        data.stable = static_cast<std::uint8_t>(data.stable & ~(1U << (slave - 1U)));
      }
    }
  }
  return {};
}

// Decodes slave 1..8 out of the data.
inline Result<Reading> decode(const Config& config, std::uint8_t slave, const FetchedData& data) {
  if ((data.stable >> (slave - 1U) & 1U) == 0) {
    return Error::kCorrupted;
  }
  return decode_reading(config, slave,
                        Span<const std::uint8_t>(&data.image[regs::scdata_address(slave)],
                                                 reading_bytes(config, slave)));
}

// SVALIDx of the enabled slaves; bit 0 is slave 1.
inline std::uint8_t valid_slaves(const Config& config, const Status& status) {
  unsigned mask = 0;
  for (unsigned slave = 1; slave <= kSlaves; ++slave) {
    mask |= (status.valid(static_cast<std::uint8_t>(slave)) ? 1U : 0U) << (slave - 1);
  }
  return static_cast<std::uint8_t>(mask & enabled_slaves(config));
}

// What the status after a frame (EOT = 1, INSTR = 0) says about one slave.
//
// SVALIDx comes first: it was cleared before the request, so 1 proves that the requested frame
// ran, whatever nAGSERR says. A chip may set nAGSERR = 0 at each write of 0xF4 (page 34 can be
// read so; AGSERR_ON_INSTR_WRITE = 1). nAGSERR only tells why there is no data, and only after
// nSCDERR, which is 0 when a frame ran. On a chip as above kNoData shows as kLineError.
inline Error judge(const Config& config, std::uint8_t slave, const Status& status) {
  if (!status.valid(slave)) {
    if (status.scd_error()) {
      return Error::kCrc;
    }
    return status.start_error() ? Error::kLineError : Error::kNoData;
  }
  // With nSCDERR = 0 some slave's CRC was wrong; SVALIDx identifies it (page 34). If another
  // slave's flag is 0 it is that one, and this slave's data is good. If all are 1 the chip
  // contradicts itself and nothing of it is believed.
  const bool all_valid = valid_slaves(config, status) == enabled_slaves(config);
  return status.scd_error() && all_valid ? Error::kCrc : Error::kNone;
}

}  // namespace detail
}  // namespace mb4

#endif  // MB4_FRAME_HPP_
