// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Unpacks a deflated part of a ZIP file (RFC 1951), so that the simulator needs no library for it.
#ifndef MB4SIM_REPLAY_INFLATE_HPP_
#define MB4SIM_REPLAY_INFLATE_HPP_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mb4::sim {

// Nothing if `packed` is not whole, is no deflated data, or does not give `size` bytes.
std::optional<std::string> inflate(std::string_view packed, std::size_t size);

// The CRC of ZIP files.
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace mb4::sim

#endif  // MB4SIM_REPLAY_INFLATE_HPP_
