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

inline constexpr const SlaveFault* kOfDsl[] = {&kWrongCrc2,   &kFastMarker, &kSafeMarker,
                                               &kSafe2Marker, &kNoVsync,    &kEarlyVsync};

}  // namespace mb4::sim::slave_fault

#endif  // MB4SIM_DSL_FAULTS_HPP_
