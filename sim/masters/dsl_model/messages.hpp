// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The master's side of the parameter channel: it sends requests, repeats short ones, and checks
// answers.
//
// - A start that is seen before a frame begins leaves this frame an IDLE; the first nibble goes
// with
//   the next one. A request is a run of nibbles.
// - The first vertical frame of a link carries no request.
// - One sender: a short message of the main host, then one of the safe host, then a long one, which
//   waits until no short one is under way. A short one may go while a long answer is awaited.
// - A short request is repeated 64 frames after its last nibble, or at once when it is refused,
//   without end. A long one is never repeated.
// - An answer with another address, direction or length is dropped and counted.
// - After a repetition by time a second answer may still come: then the transaction ends 64 frames
//   after its last request, and drops it.
//
// The words of a host are those of the registers (host_bytes.hpp).
#ifndef MB4SIM_DSL_MODEL_MESSAGES_HPP_
#define MB4SIM_DSL_MODEL_MESSAGES_HPP_

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/masters/dsl_model/line_code.hpp"

namespace mb4::sim::dsl_model {

struct MessageRules {
  bool check_answers = true;  // false: any answer of its kind is taken, as published
  bool sdk_map = false;       // the two bytes of an error code change places
};

// What has ended with a frame.
struct MessageEvents {
  bool wrong_answer = false;         // ANS
  bool initialised = false;          // MIN
  bool long_free = false;            // FREL
  std::array<bool, 2> short_free{};  // FRES, by host
};

class Messages {
 public:
  enum Host : unsigned { kMain, kSafe };
  static constexpr unsigned kHosts = 2;
  static constexpr unsigned kDataBytes = 8;
  static constexpr std::uint8_t kIdleControl = 0x3F;
  static constexpr unsigned kWait = 64;  // frames

  explicit Messages(const MessageRules& rules) : rules_(rules) {}

  // --- the host ----------------------------------------------------------------------------------
  // Bit 7: read, bits 5 to 0: address. False: one is under way, or the value is 3Fh.
  bool start_short(Host host, std::uint8_t control);
  bool short_runs(Host host) const { return shorts_[host].runs; }
  std::uint8_t control(Host host) const;
  void set_data(Host host, std::uint8_t data);
  std::uint8_t data(Host host) const { return shorts_[host].data; }

  // The registers of a long message. Writes are ignored while one is under way.
  bool start_long();
  bool long_runs() const { return long_.runs; }
  void set_buffer(unsigned index, std::uint8_t data);
  std::uint8_t buffer(unsigned index) const { return buffer_[index]; }
  enum Address : unsigned { kAddressHigh, kAddressLow, kOffsetHigh, kOffsetLow };
  void set_address(Address which, std::uint8_t data);
  std::uint8_t address(Address which) const { return address_[which]; }

  // The message channel begins anew. It ends with an acknowledge of the encoder.
  void reset() { resetting_ = true; }
  bool resetting() const { return resetting_; }

  std::uint16_t foreign() const { return foreign_; }
  std::uint16_t retries() const { return retries_; }

  // --- the link ----------------------------------------------------------------------------------
  // The running frames begin.
  MessageEvents link_begins();
  MessageEvents link_ends();
  // Of the next running frame: a nibble, IDLE or INIT.
  unsigned symbol();
  // What came with this frame.
  MessageEvents frame(const Word& parameter);

 private:
  using Bytes = std::vector<std::uint8_t>;

  struct Short {
    bool runs = false;
    std::uint8_t control = kIdleControl;
    std::uint8_t data = 0;
  };
  struct Long {
    bool runs = false;
    bool begun = false;  // a nibble of it has gone
    bool open = false;   // its answer may come
  };
  // The short message that has the channel.
  struct Turn {
    std::optional<Host> host;
    bool begun = false;
    bool open = false;      // its answer may come
    bool due = false;       // it is to be sent
    bool by_time = false;   // ... because no answer came
    bool repeated = false;  // a request has gone again because no answer came
    bool answered = false;  // only the rest of its time is left
    unsigned since = 0;     // frames since the last nibble of its last whole request
  };
  enum class Kind { kNone, kShort, kLong };

  bool short_waits() const { return shorts_[kMain].runs || shorts_[kSafe].runs; }
  bool answer_comes() const { return turn_.open && receiving_ == Kind::kShort; }
  void choose();
  Bytes request(Kind kind) const;
  void send(Kind kind);
  void sent();
  void nibble(unsigned value, MessageEvents& events);
  void other(std::optional<unsigned> symbol, MessageEvents& events);
  void broken(Kind kind, MessageEvents& events);
  void whole(Kind kind, const Bytes& bytes, MessageEvents& events);
  void take_short(const Bytes& bytes, MessageEvents& events);
  void take_long(const Bytes& bytes, MessageEvents& events);
  void end_short(MessageEvents& events);
  void end_long(MessageEvents& events);
  void wait_for_long(MessageEvents& events);
  MessageEvents initialised();

  MessageRules rules_;
  std::array<Short, kHosts> shorts_{};
  Long long_;
  std::array<std::uint8_t, kDataBytes> buffer_{};
  std::array<std::uint8_t, 4> address_{0x80, 0, 0x80, 0};
  std::uint16_t foreign_ = 0;
  std::uint16_t retries_ = 0;

  Turn turn_;
  Kind armed_ = Kind::kNone;  // its first nibble goes with the next frame
  Kind sending_ = Kind::kNone;
  std::vector<std::uint8_t> out_;  // nibbles of the request
  std::size_t next_ = 0;
  unsigned quiet_ = 0;  // frames of the first vertical frame that are left
  bool resetting_ = false;
  bool init_ = false;  // this frame carries INIT

  Kind receiving_ = Kind::kNone;
  bool ignoring_ = false;  // up to the next symbol that is no nibble
  bool paused_ = false;    // a long answer
  // Its request was open when it began.
  bool short_expected_ = false;
  bool long_expected_ = false;
  unsigned pause_ = 0;  // frames of it
  std::vector<std::uint8_t> short_in_;
  std::vector<std::uint8_t> long_in_;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_MESSAGES_HPP_
