// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Finds calls that interrupt one another on one object, in debug builds:
//
//   enc::Guarded<mb4::Device<Bus, Clock>> device(bus, clock);
//   device->automatic().poll_slave(1);        // instead of device.automatic()...
//
// The guard spans the whole expression, so an expression uses one `->`. The compile-time switch
// ENC_CHECK_REENTRY turns it on, for all translation units alike: -DENC_CHECK_REENTRY. Without it a
// Guarded<T> is a T, and `->` costs nothing.
//
// A call that begins while another one runs, in an interrupt, in another thread or inside a
// transfer of the first one, calls OnReentry before it goes on. Calls one after the other are
// right, whatever contexts they come from, and so the guard says nothing about them: neither about
// a call between a plan call and its finish(), which the driver itself reports (operation.hpp).

#ifndef ENC_GUARDED_HPP_
#define ENC_GUARDED_HPP_

#include <cstdint>

namespace enc {

#ifdef ENC_CHECK_REENTRY
inline constexpr bool kCheckReentry = true;
#else
inline constexpr bool kCheckReentry = false;
#endif

// Stops the program (trap instruction), so that a debugger shows both calls.
struct StopOnReentry {
  void operator()() const { __builtin_trap(); }
};

namespace detail {

// Whether a call runs on an object.
template <bool kCheck>
class CallFlag {
 public:
  // False: a call runs already.
  bool enter() {
    // Cores without an atomic exchange (Cortex-M0+) are alone. An interrupt between the two
    // accesses has ended its own call before this context goes on.
    if constexpr (__atomic_always_lock_free(sizeof(std::uint32_t), nullptr)) {
      return __atomic_exchange_n(&runs_, 1, __ATOMIC_ACQUIRE) == 0;
    } else {
      const bool is_free = __atomic_load_n(&runs_, __ATOMIC_RELAXED) == 0;
      __atomic_store_n(&runs_, 1, __ATOMIC_RELAXED);
      __atomic_thread_fence(__ATOMIC_ACQUIRE);
      return is_free;
    }
  }
  void leave() { __atomic_store_n(&runs_, 0, __ATOMIC_RELEASE); }

 private:
  std::uint32_t runs_ = 0;
};

template <>
class CallFlag<false> {};

}  // namespace detail

// A `T` that is made of the same arguments. `OnReentry` is called without arguments.
template <typename T, typename OnReentry = StopOnReentry, bool kCheck = kCheckReentry>
class Guarded : private detail::CallFlag<kCheck> {
  using Flag = detail::CallFlag<kCheck>;

 public:
  template <typename... Arguments>
  constexpr explicit Guarded(Arguments&... arguments) : object_(arguments...) {}
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  // One expression that uses the object.
  class Call {
   public:
    explicit Call(Guarded& guarded) : guarded_(guarded) {
      if constexpr (kCheck) {
        entered_ = guarded.Flag::enter();
        if (!entered_) {
          OnReentry()();
        }
      }
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;
    ~Call() {
      if constexpr (kCheck) {
        if (entered_) {
          guarded_.Flag::leave();
        }
      }
    }
    [[nodiscard]] T* operator->() const { return &guarded_.object_; }

   private:
    Guarded& guarded_;
    bool entered_ = true;
  };

  [[nodiscard]] Call operator->() { return Call(*this); }

 private:
  T object_;
};

}  // namespace enc

#endif  // ENC_GUARDED_HPP_
