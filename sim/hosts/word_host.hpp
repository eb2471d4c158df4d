// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host on a bus of 32-bit words, for example a manager of AXI4-Lite. A master offers it under the
// name of its interface (HostInterface::key).
#ifndef MB4SIM_WORD_HOST_HPP_
#define MB4SIM_WORD_HOST_HPP_

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/hosts/host_pins.hpp"

namespace mb4::sim {

// One beat of a stream of words beside the bus.
struct StreamBeat {
  Time time = 0;  // of the clock edge that took it
  std::vector<std::uint32_t> words;
  std::uint32_t user = 0;
  bool last = false;
};

// The sink of a stream that is always ready.
class StreamSink {
 public:
  // The oldest beat that has not been read.
  virtual std::optional<StreamBeat> next_beat() = 0;

 protected:
  ~StreamSink() = default;
};

// The access that writes one byte.
struct ByteWrite {
  constexpr ByteWrite(std::uint32_t at, std::uint8_t byte)
      : address(at & ~std::uint32_t{3}),
        data(std::uint32_t{byte} << 8U * (at & 3U)),
        strobe(static_cast<std::uint8_t>(1U << (at & 3U))) {}
  std::uint32_t address;
  std::uint32_t data;
  std::uint8_t strobe;
};

class WordHost : public HostModel {
 public:
  // One access at a byte address, which is a multiple of 4 and not above last_address(). It lets
  // time pass until the bus has answered. Returns the answer, 0 for a good one, or nothing if none
  // comes: the clock stands still, or the master is in reset. The access is then over.
  // `strobe`: bit b lets byte b be written.
  virtual std::optional<std::uint8_t> write(std::uint32_t address, std::uint32_t data,
                                            std::uint8_t strobe) = 0;
  // `data` becomes 0 without an answer.
  virtual std::optional<std::uint8_t> read(std::uint32_t address, std::uint32_t& data) = 0;
  // The highest byte address.
  virtual std::uint32_t last_address() const = 0;
  // Null if the master has none.
  virtual StreamSink* stream() { return nullptr; }
};

}  // namespace mb4::sim

#endif  // MB4SIM_WORD_HOST_HPP_
