// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The parameter channel of an encoder: a nibble or a symbol each way in each frame. It takes short
// messages for its remote registers (40h to 7Fh) and long ones for its resources.
//
// A request is a run of nibbles. It is answered from the next frame on, or later by a latency. One
// request of each kind is under way: the same bytes again change nothing, other bytes take its
// place, and what they asked for before is not done. A request that is cut short or has a wrong CRC
// is refused with NAK, unless another one of its kind is under way. A short answer goes before a
// long one, which waits for it, with an IDLE before and behind; or behind the long one, as the
// configuration says.
//
// INIT, or the begin of a link, ends all that is under way.
#ifndef MB4SIM_DSL_MESSAGES_HPP_
#define MB4SIM_DSL_MESSAGES_HPP_

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/lines/dsl/dsl_resources.hpp"
#include "sim/lines/register_file.hpp"

namespace mb4::sim::dsl {

// What may go wrong with messages. Each is on as long as its fault lasts.
struct MessageFaults {
  bool lost_nibble = false;        // the third nibble of an answer is left out
  bool wrong_crc = false;          // the last bit of an answer is inverted
  bool nak = false;                // requests are refused
  bool silent = false;             // requests are not done and not answered
  bool late = false;               // answers come MessageConfig::late frames later
  bool foreign_address = false;    // the answer of another address, direction or length comes, and
  bool foreign_direction = false;  // what was asked for is not done
  bool foreign_length = false;

  bool foreign() const { return foreign_address || foreign_direction || foreign_length; }
};

struct MessageConfig {
  std::vector<Resource> resources;  // own ones
  unsigned turn_bits = 0;           // of the position; 0: 20, or all of them
  unsigned access_level = 0;
  std::uint8_t hardware_version = 1;  // what PING holds at first
  unsigned short_latency = 0;         // frames more between a request and its answer
  unsigned status_latency = 0;        // the same of 40h to 47h
  unsigned long_latency = 8;
  unsigned late = 100;            // frames, of the fault
  bool short_inside_long = true;  // a short answer may part a long one
  bool write_answer_data = true;  // the answer to a long write repeats its data
};

class ParameterChannel {
 public:
  // Symbols of the encoder.
  static constexpr unsigned kIdle = 0x10;
  static constexpr unsigned kShortNak = 0x15;
  static constexpr unsigned kLongNak = 0x1A;
  static constexpr unsigned kInitialised = 0x1F;

  // `registers` must live on: it holds the remote registers at 40h to 7Fh.
  ParameterChannel(const MessageConfig& config, const ResourceFacts& facts,
                   RegisterFile& registers);

  // A link begins, or the master sends INIT.
  void reset();
  // A frame, with the master's symbol (five bits) if it could be read. Returns that of the encoder.
  unsigned frame(std::optional<unsigned> symbol);
  // A frame in which the encoder is silent.
  void miss() { broken(); }

  MessageFaults& faults() { return faults_; }
  const ResourceTree& resources() const { return tree_; }
  // Is told of each request that has been done: its bytes without the CRC.
  std::function<void(std::span<const std::uint8_t>)> on_done;

 private:
  using Bytes = std::vector<std::uint8_t>;

  // A request that is under way, and its answer.
  struct Order {
    Bytes request;  // with its CRC; empty: none
    unsigned wait = 0;
    Bytes answer;             // with its CRC, once it has begun
    std::size_t nibbles = 0;  // of the answer that have been sent
    bool begun = false;

    bool there() const { return !request.empty(); }
  };

  void take(std::optional<unsigned> symbol);
  void broken();
  void whole();
  std::size_t expected() const;
  unsigned send();
  unsigned next_nibble(Order& order);
  void begin(Order& order, bool is_long);
  Bytes short_answer(const Bytes& request);
  Bytes long_answer(const Bytes& request);
  bool short_exists(std::uint8_t header) const;
  void done(const Bytes& request) const;

  MessageConfig config_;
  RegisterFile& registers_;
  ResourceTree tree_;
  MessageFaults faults_;

  std::vector<std::uint8_t> received_;  // nibbles of the request that comes
  bool ignoring_ = false;               // up to the next symbol that is no nibble
  Order short_;
  Order long_;
  Order* sending_ = nullptr;
  bool gap_ = true;  // an IDLE has been sent since the last nibble
  std::optional<unsigned> nak_;
};

}  // namespace mb4::sim::dsl

#endif  // MB4SIM_DSL_MESSAGES_HPP_
