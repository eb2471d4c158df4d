// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bus of the driver of biss_axi on top of a simulator.
#ifndef MB4SIM_TOOL_AXI_PORT_HPP_
#define MB4SIM_TOOL_AXI_PORT_HPP_

#include <fmt/core.h>

#include <cstdint>
#include <optional>
#include <string>

#include "mb4sim/simulator.hpp"
#include "sim/hosts/word_host.hpp"

namespace mb4::tool {

class AxiPort {
 public:
  // `log`: takes one line for each access, "write 14 00000005" or "read 34 00000001" in hex, and
  // "failed" behind it if it did.
  explicit AxiPort(sim::Simulator& simulator, std::string* log = nullptr)
      : host_(simulator.host<sim::WordHost>("axi")), log_(log) {}

  bool write(std::uint32_t offset, std::uint32_t value) {
    return done("write", offset, value, host_.write(offset, value, 0xF));
  }
  bool read(std::uint32_t offset, std::uint32_t& value) {
    const auto answer = host_.read(offset, value);
    return done("read", offset, value, answer);
  }

 private:
  bool done(const char* what, std::uint32_t offset, std::uint32_t value,
            std::optional<std::uint8_t> answer) {
    const bool good = answer == std::uint8_t{0};
    if (log_ != nullptr) {
      *log_ += fmt::format("{} {:02X} {:08X}{}\n", what, offset, value, good ? "" : " failed");
    }
    return good;
  }

  sim::WordHost& host_;
  std::string* log_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_AXI_PORT_HPP_
