// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The port of a driver of 32-bit words on top of a simulator.
#ifndef MB4SIM_TOOL_WORD_PORT_HPP_
#define MB4SIM_TOOL_WORD_PORT_HPP_

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "mb4sim/simulator.hpp"
#include "sim/hosts/word_host.hpp"

namespace mb4::tool {

class WordPort {
 public:
  // `log`: takes one line for each access, "write 14 00000005" or "read 34 00000001" in hex, and
  // "failed" behind it if it did.
  explicit WordPort(sim::Simulator& simulator, std::string* log = nullptr)
      : host_(simulator.word_bus()), log_(log) {}

  // False without a host on such a bus.
  bool write(std::uint32_t offset, std::uint32_t value, std::uint8_t strobes = 0xF) {
    return host_ != nullptr && done("write", offset, value, host_->write(offset, value, strobes));
  }
  bool read(std::uint32_t offset, std::uint32_t& value) {
    if (host_ == nullptr) return false;
    const auto answer = host_->read(offset, value);
    return done("read", offset, value, answer);
  }

 private:
  bool done(const char* what, std::uint32_t offset, std::uint32_t value,
            std::optional<std::uint8_t> answer) {
    const bool good = answer == std::uint8_t{0};
    if (log_ != nullptr) {
      std::array<char, 40> line{};
      std::snprintf(line.data(), line.size(), "%s %02X %08X%s\n", what, unsigned{offset},
                    unsigned{value}, good ? "" : " failed");
      *log_ += line.data();
    }
    return good;
  }

  sim::WordHost* host_;
  std::string* log_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_WORD_PORT_HPP_
