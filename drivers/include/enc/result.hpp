// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// `Result<T, Info>`, which carries either a value or an error.
//
// `Info` is what a driver says of an error; the driver names `Result<T>` with its own Info. It is
// made from its code alone and has:
//
//   code                               an enumeration of one byte; kNone = 0 is no error
//   static std::uint32_t pack(Info)    all members in one word, the code in its lowest byte
//   static Info unpack(std::uint32_t)  the reverse

#ifndef ENC_RESULT_HPP_
#define ENC_RESULT_HPP_

#include <cstdint>
#include <utility>

namespace enc {

// The error of one Result, to be passed on in a Result of another type.
template <typename Info>
struct Failure {
  std::uint32_t packed;
};

namespace detail {

// nE = 0 in a reading, or in a value that holds one.
template <typename T>
constexpr auto slave_error(const T& value) -> decltype(value.slave_error) {
  return value.slave_error;
}
template <typename T>
constexpr auto slave_error(const T& value) -> decltype(value.reading.slave_error) {
  return value.reading.slave_error;
}

}  // namespace detail

// Either a value or an error. Only kSlaveError has both, and value() refuses it; see reading().
// Test it (`if (result)`) before value(). It holds the Info in one word: with its members compilers
// split and join them at every return, which was a tenth of a driver's size.
template <typename T, typename Info>
class [[nodiscard]] Result {
 public:
  using Error = decltype(Info::code);

  constexpr Result(T value) : value_(std::move(value)) {}
  // `error.code` must not be kNone, because there is no value; the program stops (trap
  // instruction).
  constexpr Result(Info error) : packed_(Info::pack(error)) { require(error.code != Error::kNone); }
  constexpr Result(Error error) : Result(Info(error)) {}
  constexpr Result(Failure<Info> failure) : packed_(failure.packed) {
    require(error() != Error::kNone);
  }
  // A reading with kSlaveError, see reading(), or with kNone.
  constexpr Result(T value, Error error)
      : value_(std::move(value)), packed_(static_cast<std::uint32_t>(error)) {}

  [[nodiscard]] constexpr bool ok() const { return error() == Error::kNone; }
  [[nodiscard]] constexpr explicit operator bool() const { return ok(); }
  [[nodiscard]] constexpr Error error() const { return static_cast<Error>(packed_ & 0xFFU); }
  [[nodiscard]] constexpr Info info() const { return Info::unpack(packed_); }
  [[nodiscard]] constexpr Failure<Info> failure() const { return {packed_}; }

  // The value. Calling it on an error is a programming mistake; it stops the program (trap
  // instruction) instead of handing out a position that was never read.
  [[nodiscard]] constexpr const T& value() const {
    require(ok());
    return value_;
  }
  [[nodiscard]] constexpr const T& operator*() const { return value(); }
  [[nodiscard]] constexpr const T* operator->() const { return &value(); }

  // There is a reading(): ok(), or kSlaveError with what the slave has sent.
  [[nodiscard]] constexpr bool has_reading() const { return ok() || detail::slave_error(value_); }

  // What the slave has sent, also if it reports an error (kSlaveError, nE = 0): for a message or a
  // log, not for a drive. Any other error stops the program as in value(), and so does a
  // kSlaveError that came from the failure() of another Result. Only for a T that holds a reading.
  [[nodiscard]] constexpr const T& reading() const {
    require(has_reading());
    return value_;
  }

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
template <typename Info>
class [[nodiscard]] Result<void, Info> {
 public:
  using Error = decltype(Info::code);

  constexpr Result() = default;
  // An Info with kNone means success, so that a check's outcome can be returned as it is.
  constexpr Result(Info error) : packed_(Info::pack(error)) {}
  constexpr Result(Error error) : packed_(static_cast<std::uint32_t>(error)) {}
  constexpr Result(Failure<Info> failure) : packed_(failure.packed) {}

  [[nodiscard]] constexpr bool ok() const { return error() == Error::kNone; }
  [[nodiscard]] constexpr explicit operator bool() const { return ok(); }
  [[nodiscard]] constexpr Error error() const { return static_cast<Error>(packed_ & 0xFFU); }
  [[nodiscard]] constexpr Info info() const { return Info::unpack(packed_); }
  [[nodiscard]] constexpr Failure<Info> failure() const { return {packed_}; }

 private:
  std::uint32_t packed_ = 0;
};

}  // namespace enc

#endif  // ENC_RESULT_HPP_
