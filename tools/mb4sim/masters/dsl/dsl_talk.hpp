// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages to an encoder with DSL, as a host makes them: it starts one by the registers of the byte
// map and polls the events up to its end.
#ifndef MB4SIM_TOOL_DSL_TALK_HPP_
#define MB4SIM_TOOL_DSL_TALK_HPP_

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mb4sim/simulator.hpp"

namespace mb4::tool {

struct DslTalkError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The bytes of a master's map.
struct DslBytes {
  bool sdk_map = false;
  std::function<std::uint8_t(unsigned address)> read;
  std::function<void(unsigned address, std::uint8_t data)> write;
};

class DslTalk {
 public:
  // Throws DslTalkError if the master sends no messages.
  explicit DslTalk(sim::Simulator& simulator);

  // The next three throw DslTalkError if no good answer comes while [host] link_ms lasts.
  std::uint8_t read(std::uint8_t address);
  void write(std::uint8_t address, std::uint8_t data);
  struct Answer {
    std::vector<std::uint8_t> data;
    std::string error;  // its code, "error 41/10"; empty: none
  };
  // Reads 0, 2, 4 or 8 bytes of a resource.
  Answer ask(unsigned id, bool indirect, unsigned offset, unsigned length);

 private:
  void start_short(std::uint8_t control, const std::string& what);
  std::uint8_t wait(unsigned address, std::uint8_t bit, const std::string& what);

  sim::Simulator& simulator_;
  DslBytes bytes_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_TALK_HPP_
