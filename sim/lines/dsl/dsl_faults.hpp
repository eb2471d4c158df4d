// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults that only an encoder with DSL can have. "wrong-crc" is that of safe channel 1.
#ifndef MB4SIM_DSL_FAULTS_HPP_
#define MB4SIM_DSL_FAULTS_HPP_

#include "sim/lines/slave_fault.hpp"

namespace mb4::sim::slave_fault {

inline constexpr const char* kOnlyDsl = "only a slave with protocol \"dsl\" can have it";

inline constexpr SlaveFault kWrongCrc2{"wrong-crc2", "wrong CRC of the second safe channel from %",
                                       kOnlyDsl};
inline constexpr SlaveFault kFastMarker{"fast-marker", "% reports no fast position", kOnlyDsl};
inline constexpr SlaveFault kSafeMarker{"safe-marker", "% reports no safe position", kOnlyDsl};
inline constexpr SlaveFault kSafe2Marker{"safe2-marker", "% reports no second safe position",
                                         kOnlyDsl};
inline constexpr SlaveFault kNoVsync{"no-vsync", "% sends no VSYNC", kOnlyDsl};
inline constexpr SlaveFault kEarlyVsync{"early-vsync", "% sends VSYNC a frame early as well",
                                        kOnlyDsl};

inline constexpr SlaveFault kLateVsync{"late-vsync", "% sends VSYNC a frame late", kOnlyDsl};
inline constexpr SlaveFault kStaleSafe{"stale-safe", "% repeats old safe positions", kOnlyDsl};
inline constexpr SlaveFault kSafe2Mismatch{"safe2-mismatch", "second safe position of % is another",
                                           kOnlyDsl};
inline constexpr SlaveFault kToggle2{"toggle2-stuck", "toggle bit of % stands still", kOnlyDsl};
inline constexpr SlaveFault kTest2{"test2", "% says that a test runs", kOnlyDsl};
inline constexpr SlaveFault kError2{"error2", "second safe channel of % reports an error",
                                    kOnlyDsl};
inline constexpr SlaveFault kFix2{"fix2", "fixed bits of STATUS2 of % are wrong", kOnlyDsl};

// Of messages: no frame shows them.
inline constexpr SlaveFault message_fault(std::string_view name, std::string_view happens) {
  return {.name = name, .happens = happens, .refusal = kOnlyDsl, .in_accesses = true};
}
inline constexpr SlaveFault kLostNibble =
    message_fault("lost-nibble", "% leaves a nibble of its messages out");
inline constexpr SlaveFault kWrongMessage =
    message_fault("wrong-message", "wrong CRC of messages from %");
inline constexpr SlaveFault kMessageNak = message_fault("message-nak", "% refuses messages");
inline constexpr SlaveFault kNoMessage = message_fault("no-message", "% answers no messages");
inline constexpr SlaveFault kLateMessage = message_fault("late-message", "messages of % come late");
inline constexpr SlaveFault kForeignAddress =
    message_fault("foreign-address", "% answers messages for another address");
inline constexpr SlaveFault kForeignDirection =
    message_fault("foreign-direction", "% answers messages of the other direction");
inline constexpr SlaveFault kForeignLength =
    message_fault("foreign-length", "% answers messages with another length");

inline constexpr const SlaveFault* kOfDsl[] = {
    &kWrongCrc2,    &kFastMarker, &kSafeMarker,  &kSafe2Marker,    &kNoVsync,
    &kEarlyVsync,   &kLateVsync,  &kStaleSafe,   &kSafe2Mismatch,  &kToggle2,
    &kTest2,        &kError2,     &kFix2,        &kLostNibble,     &kWrongMessage,
    &kMessageNak,   &kNoMessage,  &kLateMessage, &kForeignAddress, &kForeignDirection,
    &kForeignLength};

}  // namespace mb4::sim::slave_fault

#endif  // MB4SIM_DSL_FAULTS_HPP_
