// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// How the data of one frame is read from the chip, checked and decoded.

#ifndef MB4_DETAIL_FETCH_HPP_
#define MB4_DETAIL_FETCH_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/error.hpp"
#include "mb4/frame.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// SCDATA1 to 8 as fetched; bytes that no slave needs stay 0.
using DataImage = std::array<std::uint8_t, kSlaves * regs::kScdataStride>;

// The byte on MOSI while data is read with SpiCheck::kFull. A disturbed bit can turn the read into
// a write. That write must not store zeros, because zeros can pass as data with a CRC.
inline constexpr std::uint8_t kDataFiller = 0x5A;

// Reads SCDATA from `begin` upwards. For address 0x00 it uses opcode 0x09, which is one byte
// shorter than 0x03 and needs no stretched clock (I204).
template <typename Bus>
Result<void> read_run(Opcodes<Bus>& opcodes, const Config& config, Span<std::uint8_t> bytes,
                      std::uint8_t begin) {
  const std::uint8_t filler = config.spi_check == SpiCheck::kFull ? kDataFiller : 0;
  return begin == 0 ? opcodes.read_registers0(bytes, filler)
                    : opcodes.read_registers(begin, bytes, filler);
}

// Reads only the bytes that the slaves of `flags` (flag_of()) need: at most one transfer for each
// slave, none if `flags` is 0. Neighbours share a transfer when the bytes between them cost no more
// than another opcode and address.
template <typename Bus>
Result<void> read_data(Opcodes<Bus>& opcodes, const Config& config, std::uint16_t flags,
                       DataImage& image) {
  constexpr std::size_t kHeaderBytes = 2;
  constexpr std::size_t kOutOfReach = 0x100;
  std::size_t begin = 0;
  std::size_t end = 0;
  // The loop ends with a slave number whose address is out of reach, so that the last run is read.
  for (std::uint8_t slave = 1; slave <= kSlaves + 1; ++slave) {
    if (slave <= kSlaves && (flags & flag_of(slave)) == 0) {
      continue;
    }
    const std::size_t from = slave <= kSlaves ? regs::scdata_address(slave) : kOutOfReach;
    if (end != 0 && from - end > kHeaderBytes) {
      const Result<void> read =
          read_run(opcodes, config, Span<std::uint8_t>(&image[begin], end - begin),
                   static_cast<std::uint8_t>(begin));
      if (!read) {
        return read;
      }
      end = 0;
    }
    if (slave <= kSlaves) {
      begin = end == 0 ? from : begin;
      end = from + reading_bytes(config, slave);
    }
  }
  return {};
}

// Data as fetched, and which slaves' bytes were the same when they were read again.
struct FetchedData {
  DataImage image{};
  std::uint16_t stable = 0xFFFF;  // flag_of()
};

// SpiCheck::kFull: true for data that only a second reading proves. Without a stored CRC this is
// any data. With a CRC it is all zeros and all ones: a line that was stuck for a moment makes them,
// and the CRC may accept them.
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

// Calls read_data(). With SpiCheck::kFull it reads the data that needs_second_reading() once more.
template <typename Bus>
Result<void> fetch_data(Opcodes<Bus>& opcodes, const Config& config, std::uint16_t flags,
                        FetchedData& data) {
  data.stable = 0xFFFF;
  const Result<void> first = read_data(opcodes, config, flags, data.image);
  if (!first || config.spi_check != SpiCheck::kFull) {
    return first;
  }
  // `second` begins as a copy, so bytes that are not read again are equal in both images.
  DataImage second = data.image;
  std::uint16_t again = 0;
  for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
    const Span<const std::uint8_t> bytes(&data.image[regs::scdata_address(slave)],
                                         regs::kScdataStride);
    if ((flags & flag_of(slave)) != 0 && needs_second_reading(config, slave, bytes)) {
      again = static_cast<std::uint16_t>(again | flag_of(slave));
    }
  }
  const Result<void> read = read_data(opcodes, config, again, second);
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (data.image[i] != second[i]) {
      data.stable = static_cast<std::uint16_t>(
          data.stable & ~flag_of(static_cast<std::uint8_t>(i / regs::kScdataStride + 1)));
    }
  }
  return read;
}

// A flag beside flag_of(): of a slave without SVALID and without a stored CRC only nSCDERR tells.
inline constexpr std::uint16_t kUnproven = 1;

// The result of one frame.
struct Outcome {
  Status status;           // as read after the data
  std::uint16_t good = 0;  // slaves whose data is new and good; flag_of()
  std::uint16_t bad = 0;   // slaves whose data is new and bad; and kUnproven
};

// Decodes the data of one slave. `bytes`: the eight bytes of SCDATAx. `stable`: a second reading,
// if there was one, was equal.
inline Result<Reading> decode(const Config& config, std::uint8_t slave, const std::uint8_t* bytes,
                              bool stable) {
  return stable ? decode_bytes(config, slave, bytes) : Result<Reading>(Error::kCorrupted);
}

// Decodes all `slaves` of a frame.
inline void decode_all(const Config& config, std::uint8_t slaves, const Outcome& outcome,
                       const FetchedData& data, Frame& frame) {
  frame.status = outcome.status;
  for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
    if ((outcome.good & flag_of(slave)) != 0) {
      frame.set(slave, decode(config, slave, &data.image[regs::scdata_address(slave)],
                              (data.stable & flag_of(slave)) != 0));
    } else if (is_in(slaves, slave)) {
      frame.set(slave, (outcome.bad & flag_of(slave)) != 0 ? Error::kCrc : Error::kNoData);
    }
  }
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_FETCH_HPP_
