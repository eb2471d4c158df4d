// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What a call of the driver of the DSL master can end with.

#ifndef DSL_ERROR_HPP_
#define DSL_ERROR_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstdint>

#include "enc/result.hpp"

namespace dsl {

enum class Error : std::uint8_t {
  kNone = 0,
  kBus,        // the port reported a failed access
  kAbsent,     // there is no DSL master behind the port, or it sends no messages
  kArgument,   // the call was wrong; nothing was written
  kTimeout,    // the limit has passed; after a message its channel was reset
  kNoLink,     // the encoder does not answer
  kUncertain,  // the position was not certain at the end of the frame (POS)
  kNoSafe,     // the last vertical frame had no good safe position in one of the channels
  kSafeOld,    // the last good one is older than allowed, or the two are not of one vertical frame
  kSafeCrc,    // its bytes do not fit its CRC
  kSafeState,  // STATUS2 or SAFE_STATUS has what must not be
  kSafeDiffers,  // the two channels have different positions
  kBusy,         // a message of this host runs, or the message channel is being reset
  kReset,        // the message channel was reset meanwhile: nobody knows whether a write was done
  kRefused,  // NAK, a broken answer, or the link has ended: nobody knows whether a write was done
  kEncoder,  // the encoder tells an error; ErrorInfo::encoder has its code
};

struct ErrorInfo {
  constexpr ErrorInfo(Error error = Error::kNone, std::uint16_t of_encoder = 0)
      : code(error), encoder(of_encoder) {}
  Error code;
  // kEncoder: the code, kind in the higher byte: 0x4110 is 41/10, "no access".
  std::uint16_t encoder;
  static constexpr std::uint32_t pack(ErrorInfo info) {
    return static_cast<std::uint32_t>(info.code) | std::uint32_t{info.encoder} << 8U;
  }
  static constexpr ErrorInfo unpack(std::uint32_t word) {
    return {static_cast<Error>(word & 0xFFU), static_cast<std::uint16_t>(word >> 8U & 0xFFFFU)};
  }
};

template <typename T>
using Result = enc::Result<T, ErrorInfo>;

}  // namespace dsl

#endif  // __cplusplus >= 201703L

#endif  // DSL_ERROR_HPP_
