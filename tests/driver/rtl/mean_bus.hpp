// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The Verilated chip on an SPI bus that fails once as hardware does: a transfer that stores nothing
// leaves in the caller's buffer what was there before, never zeros.

#ifndef TESTS_DRIVER_RTL_MEAN_BUS_HPP_
#define TESTS_DRIVER_RTL_MEAN_BUS_HPP_

#include <ucontext.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "masters/mb4/sim_bus.hpp"
#include "mb4/result.hpp"
#include "mb4sim/simulator.hpp"

namespace mb4test {

enum class MeanKind : std::uint8_t {
  kNone,
  kFlipMosi,    // one bit of MOSI, from the first byte's top bit
  kFlipMiso,    // one bit of MISO
  kLeftOut,     // nothing reaches the chip, and nothing is stored; success
  kNotStored,   // the chip has seen it all, and nothing is stored; success
  kLate,        // what came back is stored at the start of the next transfer; success
  kShort,       // NCS rises after `place` bytes, and these are stored; success
  kToldFailed,  // all is well, but transfer() returns false
};
inline constexpr unsigned kMeanKinds = 8;

inline const char* to_string(MeanKind kind) {
  constexpr const char* kNames[] = {"none",       "flip on MOSI", "flip on MISO", "left out",
                                    "not stored", "stored late",  "cut short",    "told as failed"};
  return kNames[static_cast<unsigned>(kind)];
}

// One fault of one transfer. `place`: the bit, or the bytes before the cut.
struct MeanFault {
  MeanKind kind = MeanKind::kNone;
  unsigned transfer = 0;  // since MeanBus::plan()
  unsigned place = 0;
};

// A transfer as the driver has asked for it.
struct Transfer {
  std::uint8_t opcode = 0;
  std::uint8_t second = 0;  // address or instruction
  std::uint8_t size = 0;
  bool reads = false;

  // Transfers of one kind do the same.
  [[nodiscard]] bool like(const Transfer& other) const {
    return opcode == other.opcode && second == other.second && size == other.size;
  }
};

class MeanBus {
 public:
  explicit MeanBus(mb4::sim::Simulator& simulator) : inner_(simulator) {}

  // From now on transfers count from 0.
  void plan(const MeanFault& fault) {
    fault_ = fault;
    made_.clear();
    struck_ = false;
  }
  // Beside that: at most one fault between two plan(), at random. `one_in`: a byte of each
  // direction, where one bit is flipped, and a transfer that stores nothing. Null ends it.
  void at_random(std::mt19937_64* random, unsigned one_in) {
    random_ = random;
    one_in_ = one_in;
  }
  // The fault of this plan(), and the transfer that it has hit; null: none yet.
  [[nodiscard]] const MeanFault* struck(Transfer& hit) const {
    if (fault_.kind == MeanKind::kNone || made_.size() <= fault_.transfer) return nullptr;
    hit = made_[fault_.transfer];
    return &fault_;
  }
  // Faults of at_random() so far.
  [[nodiscard]] std::uint64_t faults() const { return faults_; }
  [[nodiscard]] const std::vector<Transfer>& made() const { return made_; }
  // A call has ended whose stack begins at `memory`: what is late and was meant for a buffer there
  // is lost.
  void call_has_ended(const char* memory, std::size_t size) {
    const auto* at = reinterpret_cast<const char*>(late_at_);
    if (at >= memory && at < memory + size) late_.clear();
  }
  // Collects a line for each transfer.
  void log(std::string* text) { log_ = text; }

  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    store_late();
    if (random_ != nullptr && !struck_) draw(tx.size(), rx.size());
    const bool hit = fault_.kind != MeanKind::kNone && made_.size() == fault_.transfer;
    made_.push_back({tx[0], tx[1], static_cast<std::uint8_t>(tx.size()), !rx.empty()});
    const MeanKind kind = hit ? fault_.kind : MeanKind::kNone;
    std::vector<std::uint8_t> mosi(tx.begin(), tx.end());
    std::vector<std::uint8_t> miso(rx.size());
    if (kind == MeanKind::kFlipMosi) flip(mosi, fault_.place);
    if (kind == MeanKind::kShort) mosi.resize(fault_.place);
    if (kind != MeanKind::kLeftOut && !mosi.empty()) {
      inner_.transfer({mosi.data(), mosi.size()}, {miso.data(), miso.size()});
    }
    if (kind == MeanKind::kFlipMiso && !miso.empty()) flip(miso, fault_.place);
    if (kind == MeanKind::kLate) {
      late_ = miso;
      late_at_ = rx.data();
    } else if (kind != MeanKind::kLeftOut && kind != MeanKind::kNotStored) {
      const std::size_t stored = kind == MeanKind::kShort ? fault_.place : rx.size();
      for (std::size_t i = 0; i < rx.size() && i < stored; ++i) rx[i] = miso[i];
    }
    if (log_ != nullptr) write_log(kind, mosi, miso);
    return kind != MeanKind::kToldFailed;
  }

 private:
  void draw(std::size_t sent, std::size_t received) {
    const unsigned place = static_cast<unsigned>(made_.size());
    for (std::size_t i = 0; i < sent + received && !struck_; ++i) {
      if ((*random_)() % one_in_ != 0) continue;
      const unsigned bit = static_cast<unsigned>((i < sent ? i : i - sent) * 8 + (*random_)() % 8);
      fault_ = {i < sent ? MeanKind::kFlipMosi : MeanKind::kFlipMiso, place, bit};
      struck_ = true;
    }
    if (!struck_ && received != 0 && (*random_)() % one_in_ == 0) {
      fault_ = {MeanKind::kNotStored, place, 0};
      struck_ = true;
    }
    faults_ += struck_ ? 1 : 0;
  }
  static void flip(std::vector<std::uint8_t>& bytes, unsigned bit) {
    bytes.at(bit / 8) ^= static_cast<std::uint8_t>(0x80U >> bit % 8);
  }
  void store_late() {
    for (std::size_t i = 0; i < late_.size(); ++i) late_at_[i] = late_[i];
    late_.clear();
  }
  void write_log(MeanKind kind, const std::vector<std::uint8_t>& mosi,
                 const std::vector<std::uint8_t>& miso) {
    static constexpr char kDigits[] = "0123456789ABCDEF";
    const auto put = [this](std::uint8_t byte) {
      *log_ += {' ', kDigits[byte >> 4U], kDigits[byte & 15U]};
    };
    *log_ += " ";
    for (const std::uint8_t byte : mosi) put(byte);
    *log_ += " >";
    for (const std::uint8_t byte : miso) put(byte);
    if (kind != MeanKind::kNone) *log_ += std::string("   <- ") + to_string(kind);
    *log_ += '\n';
  }

  mb4::tool::SimBus inner_;
  MeanFault fault_;
  std::vector<Transfer> made_;
  std::vector<std::uint8_t> late_;
  std::uint8_t* late_at_ = nullptr;
  std::string* log_ = nullptr;
  std::mt19937_64* random_ = nullptr;
  unsigned one_in_ = 1000;
  bool struck_ = false;
  std::uint64_t faults_ = 0;
};

// Memory on which calls of the driver run. The buffers that a blocking call makes on its stack hold
// what the same call has left there, as on a processor whose task calls it again and again: nothing
// else uses this memory.
class CallStack {
 public:
  CallStack() : memory_(kBytes) {}
  CallStack(const CallStack&) = delete;
  CallStack& operator=(const CallStack&) = delete;

  // Runs `call` from the top of the memory. Exceptions pass on.
  template <typename Call>
  void run(MeanBus& bus, Call&& call) {
    function_ = [](void* object) { (*static_cast<std::remove_reference_t<Call>*>(object))(); };
    object_ = &call;
    running_ = this;
    // What a call finds in memory that it has not written is the same in each run of a test.
    std::fill(memory_.end() - kFilled, memory_.end(), char{0x5A});
    getcontext(&inner_);
    inner_.uc_stack.ss_sp = memory_.data();
    inner_.uc_stack.ss_size = memory_.size();
    inner_.uc_link = &outer_;
    makecontext(&inner_, &CallStack::enter, 0);
    swapcontext(&outer_, &inner_);
    bus.call_has_ended(memory_.data(), memory_.size());
    if (error_) {
      const std::exception_ptr error = error_;
      error_ = nullptr;
      std::rethrow_exception(error);
    }
  }

 private:
  static constexpr std::size_t kBytes = std::size_t{1} << 20U;
  static constexpr std::size_t kFilled = std::size_t{1} << 14U;  // deeper than a call goes

  static void enter() {
    try {
      running_->function_(running_->object_);
    } catch (...) {
      running_->error_ = std::current_exception();
    }
  }

  inline static CallStack* running_ = nullptr;
  std::vector<char> memory_;
  ucontext_t outer_{};
  ucontext_t inner_{};
  void (*function_)(void*) = nullptr;
  void* object_ = nullptr;
  std::exception_ptr error_;
};

}  // namespace mb4test

#endif  // TESTS_DRIVER_RTL_MEAN_BUS_HPP_
