// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A value that one context writes and any number of others read, without a lock: an interrupt reads
// the encoder, tasks and other interrupts take the newest reading.
//
//   enc::Snapshot<mb4::SafetyVerdict> latest;   // shared
//   latest.write(verdict);                      // in the interrupt
//   mb4::SafetyVerdict now;
//   if (latest.read(now)) ...                   // in the task
//
// There are two copies. The writer fills the one that is older and then makes it the newest. A
// reader copies the newest one and looks whether the writer has begun to fill the same copy
// meanwhile: it then has to read again. So a reader never gets parts of two values, and the writer
// never waits.
//
// Memory order: the words are written and read whole (32 bits), and barriers keep their order, as
// C++ defines it for threads on any number of cores. With one core the barriers only keep the
// compiler from moving the words: a Cortex-M0+ or M4 would not need the DMB that GCC puts there
// (five in a write and a read, some cycles each).

#ifndef ENC_SNAPSHOT_HPP_
#define ENC_SNAPSHOT_HPP_

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace enc {

namespace detail {

// How a Snapshot reaches words that others may write or read at the same time.
struct SharedMemory {
  static std::uint32_t load(const std::uint32_t& word) {
    return __atomic_load_n(&word, __ATOMIC_RELAXED);
  }
  static void store(std::uint32_t& word, std::uint32_t value) {
    __atomic_store_n(&word, value, __ATOMIC_RELAXED);
  }
  // What was loaded before is older than what is loaded after.
  static void acquire() { __atomic_thread_fence(__ATOMIC_ACQUIRE); }
  // What was stored before is seen before what is stored after.
  static void release() { __atomic_thread_fence(__ATOMIC_RELEASE); }
};

// The procedure, on 2 + 2 * `words` words in anybody's memory, 0 at first: the stamp of the write
// that has begun, that of the one that has ended, and two copies. Stamps are odd; 0: nothing was
// written. Snapshot and the C binding (mb4.h) hold such words.
template <typename Memory>
struct SnapshotWords {
  static constexpr std::size_t kStamps = 2;

  // `Word`: std::uint32_t, or what may stand for any type.
  template <typename Word>
  static void write(std::uint32_t* all, const Word* from, std::size_t words) {
    const std::uint32_t stamp = (Memory::load(all[1]) | 1U) + 2U;
    Memory::store(all[0], stamp);
    Memory::release();
    std::uint32_t* copy = all + start(stamp, words);
    for (std::size_t i = 0; i < words; ++i) {
      Memory::store(copy[i], from[i]);
    }
    Memory::release();
    Memory::store(all[1], stamp);
  }

  // False: `to` may hold anything.
  template <typename Word>
  static bool try_read(const std::uint32_t* all, Word* to, std::size_t words) {
    const std::uint32_t stamp = Memory::load(all[1]);
    Memory::acquire();
    if (stamp == 0) {
      return false;
    }
    const std::uint32_t* copy = all + start(stamp, words);
    for (std::size_t i = 0; i < words; ++i) {
      to[i] = Memory::load(copy[i]);
    }
    Memory::acquire();
    // One step on, the writer fills the other copy.
    return Memory::load(all[0]) - stamp <= 2U;
  }

  static bool is_written(const std::uint32_t* all) { return Memory::load(all[1]) != 0; }
  static std::uint32_t writes(const std::uint32_t* all) { return Memory::load(all[1]) >> 1U; }

 private:
  static constexpr std::size_t start(std::uint32_t stamp, std::size_t words) {
    return kStamps + ((stamp >> 1U & 1U) != 0 ? words : 0);
  }
};

}  // namespace detail

// `T` is copied byte by byte, so it must be trivially copyable. A Snapshot takes twice its size and
// eight bytes. `Memory` is for tests.
template <typename T, typename Memory = detail::SharedMemory>
class Snapshot {
  static_assert(std::is_trivially_copyable_v<T>,
                "enc: a Snapshot copies its value byte by byte, so the type must be trivially "
                "copyable");
  static_assert(sizeof(void*) >= sizeof(std::uint32_t),
                "enc: a Snapshot needs a processor that stores 32 bits at once");

 public:
  constexpr Snapshot() = default;
  // The contexts share one object.
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  // Makes `value` the newest. Never waits. All calls belong in one context: two writers that
  // interrupt each other destroy the value.
  void write(const T& value) {
    Words words{};
    __builtin_memcpy(words.data(), &value, sizeof(T));
    Procedure::write(all_.data(), words.data(), words.size());
  }

  // Copies the newest value. False: nothing was written yet, or the writer has written twice since
  // this call began; `value` is then unchanged. A reader that has interrupted the writer always
  // succeeds once something was written. Any context may call it.
  [[nodiscard]] bool try_read(T& value) const {
    Words words{};
    if (!Procedure::try_read(all_.data(), words.data(), words.size())) {
      return false;
    }
    __builtin_memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return true;
  }

  // As try_read(), but repeats until it has a value. False: nothing was written yet. It repeats
  // only if the writer comes twice while it copies; for a writer that comes so often it would not
  // end.
  [[nodiscard]] bool read(T& value) const {
    while (Procedure::is_written(all_.data())) {
      if (try_read(value)) {
        return true;
      }
    }
    return false;
  }

  // The number of writes, modulo 2^31. A reader tells by it whether there is a new value.
  [[nodiscard]] std::uint32_t writes() const { return Procedure::writes(all_.data()); }

 private:
  using Procedure = detail::SnapshotWords<Memory>;
  using Words =
      std::array<std::uint32_t, (sizeof(T) + sizeof(std::uint32_t) - 1) / sizeof(std::uint32_t)>;

  std::array<std::uint32_t, Procedure::kStamps + 2 * std::tuple_size_v<Words>> all_{};
};

}  // namespace enc

#endif  // ENC_SNAPSHOT_HPP_
