// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// `Result<T>`, which carries either a value or an error.

#ifndef MB4_RESULT_HPP_
#define MB4_RESULT_HPP_

#include <cstdint>
#include <type_traits>
#include <utility>

#include "mb4/error.hpp"

namespace mb4 {

namespace detail {

// An ErrorInfo in one word. With four members compilers split and join them at every return, which
// was a tenth of the driver's size.
constexpr std::uint32_t pack(ErrorInfo info) {
  return static_cast<std::uint32_t>(info.code) | static_cast<std::uint32_t>(info.field) << 8U |
         std::uint32_t{info.number} << 16U | std::uint32_t{info.detail} << 24U;
}
constexpr Error code_of(std::uint32_t packed) { return static_cast<Error>(packed & 0xFFU); }
constexpr ErrorInfo unpack(std::uint32_t packed) {
  ErrorInfo info(code_of(packed), static_cast<ConfigField>(packed >> 8U & 0xFFU),
                 static_cast<std::uint8_t>(packed >> 16U));
  info.detail = static_cast<std::uint8_t>(packed >> 24U);
  return info;
}

}  // namespace detail

// The error of one Result, to be passed on in a Result of another type.
struct Failure {
  std::uint32_t packed;
};

// Either a value or an error, never both. Test it (`if (result)`) before value().
template <typename T>
class [[nodiscard]] Result {
 public:
  constexpr Result(T value) : value_(std::move(value)) {}
  // `error.code` must not be kNone, because there is no value; the program stops (trap
  // instruction).
  constexpr Result(ErrorInfo error) : packed_(detail::pack(error)) {
    require(error.code != Error::kNone);
  }
  constexpr Result(Error error) : Result(ErrorInfo(error)) {}
  constexpr Result(Failure failure) : packed_(failure.packed) { require(error() != Error::kNone); }

  [[nodiscard]] constexpr bool ok() const { return error() == Error::kNone; }
  [[nodiscard]] constexpr explicit operator bool() const { return ok(); }
  [[nodiscard]] constexpr Error error() const { return detail::code_of(packed_); }
  [[nodiscard]] constexpr ErrorInfo info() const { return detail::unpack(packed_); }
  [[nodiscard]] constexpr Failure failure() const { return {packed_}; }

  // The value. Calling it on an error is a programming mistake; it stops the program (trap
  // instruction) instead of handing out a position that was never read.
  [[nodiscard]] constexpr const T& value() const {
    require(ok());
    return value_;
  }
  [[nodiscard]] constexpr const T& operator*() const { return value(); }
  [[nodiscard]] constexpr const T* operator->() const { return &value(); }

  // The value, or `otherwise` for an error.
  [[nodiscard]] constexpr T value_or(T otherwise) const { return ok() ? value_ : otherwise; }

 private:
  static constexpr void require(bool condition) {
    if (!condition) {
      __builtin_trap();
    }
  }

  T value_{};
  std::uint32_t packed_ = 0;
};

// Success without a value, or an error.
template <>
class [[nodiscard]] Result<void> {
 public:
  constexpr Result() = default;
  // An ErrorInfo with kNone means success, so that a check's outcome can be returned as it is.
  constexpr Result(ErrorInfo error) : packed_(detail::pack(error)) {}
  constexpr Result(Error error) : packed_(static_cast<std::uint32_t>(error)) {}
  constexpr Result(Failure failure) : packed_(failure.packed) {}

  [[nodiscard]] constexpr bool ok() const { return error() == Error::kNone; }
  [[nodiscard]] constexpr explicit operator bool() const { return ok(); }
  [[nodiscard]] constexpr Error error() const { return detail::code_of(packed_); }
  [[nodiscard]] constexpr ErrorInfo info() const { return detail::unpack(packed_); }
  [[nodiscard]] constexpr Failure failure() const { return {packed_}; }

 private:
  std::uint32_t packed_ = 0;
};

}  // namespace mb4

#endif  // MB4_RESULT_HPP_
