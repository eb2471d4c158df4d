// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Messages to a DSL encoder: its registers (short) and its resources (long). Each call exists in
// steps and blocking. Freestanding C++17.
//
// The main host has short and long messages, the safe host short ones. A short and a long message
// of one host may run at the same time. The time limits are those of the caller: the master itself
// repeats a short message and waits for a long one without end. After kTimeout the message channel
// is reset for both hosts; the next message may begin when the encoder has acknowledged that.

#ifndef DSL_MESSAGES_HPP_
#define DSL_MESSAGES_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <array>
#include <cstdint>

#include "dsl/device.hpp"
#include "enc/bus.hpp"

namespace dsl {

enum class Host : std::uint8_t { kMain, kSafe };

// A long message. A direct one tells what a resource is, an indirect one reaches its value.
struct LongRequest {
  std::uint16_t resource = 0;  // 0 to 3FFh
  bool write = false;
  bool indirect = false;
  std::uint16_t offset = 0;            // 0 to 7FFFh; 0 is not sent
  std::uint8_t size = 0;               // bytes to read or to write: 0, 2, 4, 8
  std::array<std::uint8_t, 8> data{};  // of a write, in their order on the line
};

struct LongAnswer {
  std::uint8_t size = 0;
  std::array<std::uint8_t, 8> data{};
  // The whole answer as one number, the first byte the highest.
  [[nodiscard]] constexpr std::uint64_t number() const {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < size; ++i) value = value << 8U | data[i];
    return value;
  }
};

// Port and Clock: dsl/port.hpp, enc/bus.hpp. The device must have been started, and lives as long
// as this. One object a host.
template <typename Port, typename Clock>
class Messages {
  static_assert(enc::kIsClock<Clock>, "Clock needs std::uint32_t now_us()");

 public:
  Messages(Device<Port>& device, Clock& clock, Host host = Host::kMain)
      : device_(device), clock_(clock), host_(host) {}

  // ---- short messages: `address` 40h to 7Fh, `limit_us` up to 2^31 ----
  // Blocking. kArgument, kAbsent, kBus, kBusy, kTimeout, kReset.
  Result<std::uint8_t> read(std::uint8_t address, std::uint32_t limit_us) {
    if (const Result<void> begun = begin_read(address, limit_us); !begun) return begun.failure();
    return finish([this] { return poll_short(); }, limit_us);
  }
  Result<void> write(std::uint8_t address, std::uint8_t value, std::uint32_t limit_us) {
    if (const Result<void> begun = begin_write(address, value, limit_us); !begun) return begun;
    const Result<std::uint8_t> done = finish([this] { return poll_short(); }, limit_us);
    return done ? Result<void>() : Result<void>(done.failure());
  }
  // In steps: begin, then poll_short() until it ends. kArgument, kAbsent, kBus, kBusy.
  Result<void> begin_read(std::uint8_t address, std::uint32_t limit_us) {
    return begin_short(address, true, 0, limit_us);
  }
  Result<void> begin_write(std::uint8_t address, std::uint8_t value, std::uint32_t limit_us) {
    return begin_short(address, false, value, limit_us);
  }
  // The state of the message that was begun: kBusy while it runs, then once its end: the byte that
  // was read (of a write 0), kTimeout or kReset. kArgument: none was begun. kBus: it still runs.
  Result<std::uint8_t> poll_short() {
    if (!short_.runs) return Error::kArgument;
    const Places at = places();
    std::uint32_t events = 0, control = 0, data = 0;
    if (!device_.read(word_of(at.events), events) || !device_.read(word_of(at.control), control))
      return Error::kBus;
    const std::uint8_t seen = byte_of(events, at.events);
    if (byte_of(control, at.control) != kIdle || (seen & at.free) == 0)
      return timed_out(short_) ? give_up(short_) : Error::kBusy;
    if (!device_.read(word_of(at.data), data)) return Error::kBus;
    short_.runs = false;
    if ((seen & at.reset) != 0) return Error::kReset;
    return short_.read ? byte_of(data, at.data) : std::uint8_t{0};
  }

  // ---- long messages of the main host ----
  // Blocking. kArgument (a field is out of range, or this is the safe host), kAbsent, kBus, kBusy,
  // kTimeout, kReset, kRefused, kEncoder.
  Result<LongAnswer> ask(const LongRequest& request, std::uint32_t limit_us) {
    if (const Result<void> begun = begin(request, limit_us); !begun) return begun.failure();
    return finish([this] { return poll_long(); }, limit_us);
  }
  // In steps. kArgument, kAbsent, kBus, kBusy.
  Result<void> begin(const LongRequest& request, std::uint32_t limit_us) {
    if (!valid(request) || host_ != Host::kMain) return Error::kArgument;
    if (const Result<void> ready = may_begin(); !ready) return ready;
    if (long_.runs) return Error::kBusy;
    size_ = request.size;
    // FREL falls with the start. What an old message has left goes before it.
    const std::uint32_t cleared = regs::ANS::kMask | regs::MIN::kMask;
    bool done = write_address(request);
    for (unsigned i = 0; done && request.write && i < request.size; ++i)
      done = device_.write(regs::kAddrPcBuffer0 + i, request.data[i]);
    done = done && device_.write(regs::kAddrEventL, ~cleared) &&
           device_.write(regs::kAddrPcCtrl, regs::LSTA::kMask);
    if (!done) return Error::kBus;
    start(long_, limit_us);
    return {};
  }
  // As poll_short(); kRefused and kEncoder are ends too.
  Result<LongAnswer> poll_long() {
    if (!long_.runs) return Error::kArgument;
    std::uint32_t events = 0, address = 0;
    if (!device_.read(word_of(regs::kAddrEventL), events)) return Error::kBus;
    const std::uint8_t seen = byte_of(events, regs::kAddrEventL);
    if ((seen & regs::FREL::kMask) == 0) return timed_out(long_) ? give_up(long_) : Error::kBusy;
    LongAnswer answer;
    answer.size = size_;
    if (!device_.read(word_of(regs::kAddrPcAddH), address) || !read_buffer(answer))
      return Error::kBus;
    long_.runs = false;
    if ((seen & regs::MIN::kMask) != 0) return Error::kReset;
    if ((seen & regs::ANS::kMask) != 0) return Error::kRefused;
    if ((byte_of(address, regs::kAddrPcAddH) & regs::LOFF::kMask) != 0)
      return ErrorInfo(Error::kEncoder, error_code(answer));
    return answer;
  }

  // ---- the message channel ----
  // Ends all messages of both hosts; those that run end with kReset. kBus.
  Result<void> reset() { return device_.reset_messages(); }

 private:
  static constexpr std::uint8_t kIdle = 0x3F;  // SLAVE_REG_CTRL: no message runs

  // Registers of a host's short messages, and bits of its events.
  struct Places {
    std::uint8_t control, data, events, free, reset;
  };
  struct Running {
    bool runs = false;
    bool read = false;
    std::uint32_t begin_us = 0;
    std::uint32_t limit_us = 0;
  };

  bool sdk_map() const { return page::SDK_MAP::get(device_.features()) != 0; }
  // The SDK has one short message: the safe host's, by the control register of the main host.
  Places places() const {
    if (host_ == Host::kMain && !sdk_map()) {
      return {regs::kAddrSlaveRegCtrl, regs::kAddrPcData, regs::kAddrEventL, regs::FRES::kMask,
              regs::MIN::kMask};
    }
    return {sdk_map() ? regs::kAddrSlaveRegCtrl : regs::kAddrSSlaveRegCtrl, regs::kAddrSPcData,
            regs::kAddrEventS, regs::S_FRES::kMask, regs::S_MIN::kMask};
  }

  // No reset of the channel is under way, and this master has messages.
  Result<void> may_begin() {
    std::uint32_t control = 0;
    if (page::MESSAGES_EVENTS::get(device_.features()) == 0) return Error::kAbsent;
    if (!device_.read(regs::kAddrSysCtrl, control)) return Error::kBus;
    return (control & regs::MRST::kMask) != 0 ? Error::kBusy : Error::kNone;
  }

  Result<void> begin_short(std::uint8_t address, bool read, std::uint8_t value,
                           std::uint32_t limit_us) {
    constexpr std::uint32_t kRead = 0x80;
    if (address < 0x40 || address > 0x7F) return Error::kArgument;
    if (const Result<void> ready = may_begin(); !ready) return ready;
    const Places at = places();
    std::uint32_t control = 0;
    if (!device_.read(word_of(at.control), control)) return Error::kBus;
    if (short_.runs || byte_of(control, at.control) != kIdle) return Error::kBusy;
    const bool done = (read || device_.write(at.data, value)) &&
                      device_.write(at.events, ~std::uint32_t{at.reset}) &&
                      device_.write(at.control, (read ? kRead : 0U) | address);
    if (!done) return Error::kBus;
    short_.read = read;
    start(short_, limit_us);
    return {};
  }

  static bool valid(const LongRequest& request) {
    const bool size =
        request.size == 0 || request.size == 2 || request.size == 4 || request.size == 8;
    return size && request.resource <= 0x3FF && request.offset <= 0x7FFF;
  }
  bool write_address(const LongRequest& request) {
    const std::uint32_t length = request.size == 8 ? 3U : request.size / 2U;
    const std::uint32_t high = (request.write ? 0U : std::uint32_t{regs::LRW::kMask}) |
                               (request.offset != 0 ? std::uint32_t{regs::LOFF::kMask} : 0U) |
                               (request.indirect ? std::uint32_t{regs::LIND::kMask} : 0U) |
                               regs::LLEN::of(length) | std::uint32_t{request.resource} >> 8U;
    return device_.write(regs::kAddrPcAddH, high) &&
           device_.write(regs::kAddrPcAddL, request.resource) &&
           device_.write(regs::kAddrPcOffH, std::uint32_t{request.offset} >> 8U) &&
           device_.write(regs::kAddrPcOffL, request.offset);
  }
  // Both words, whatever the size: an error code has two bytes.
  bool read_buffer(LongAnswer& answer) {
    for (std::uint32_t at = 0; at < answer.data.size(); at += 4) {
      std::uint32_t word = 0;
      if (!device_.read(regs::kAddrPcBuffer0 + at, word)) return false;
      for (std::uint32_t i = 0; i < 4; ++i) answer.data[at + i] = byte_of(word, i);
    }
    return true;
  }
  std::uint16_t error_code(const LongAnswer& answer) const {
    const std::uint32_t first = answer.data[0], second = answer.data[1];
    return static_cast<std::uint16_t>(sdk_map() ? first << 8U | second : second << 8U | first);
  }

  void start(Running& message, std::uint32_t limit_us) {
    message.runs = true;
    message.begin_us = clock_.now_us();
    message.limit_us = limit_us;
  }
  bool timed_out(const Running& message) {
    return clock_.now_us() - message.begin_us > message.limit_us;
  }
  Error give_up(Running& message) {
    message.runs = false;
    return reset() ? Error::kTimeout : Error::kBus;
  }
  // Polls until the message ends.
  template <typename Poll>
  auto finish(Poll poll, std::uint32_t limit_us) -> decltype(poll()) {
    for (std::uint64_t left = most_polls(limit_us); left != 0; --left) {
      const auto now = poll();
      if (now || now.error() != Error::kBusy) return now;
    }
    short_.runs = long_.runs = false;
    return reset() ? Error::kTimeout : Error::kBus;
  }

  Device<Port>& device_;
  Clock& clock_;
  Host host_;
  Running short_{};
  Running long_{};
  std::uint8_t size_ = 0;
};

}  // namespace dsl

#endif  // __cplusplus >= 201703L

#endif  // DSL_MESSAGES_HPP_
