// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The faults that only a BiSS C slave can have. Each says what it changes, and so when it acts: a
// word and its counter are taken where the slave latches, the first rising edge of MA.
#ifndef MB4SIM_BISS_C_FAULTS_HPP_
#define MB4SIM_BISS_C_FAULTS_HPP_

#include "sim/lines/slave_fault.hpp"

namespace mb4::sim::slave_fault {

// The slave answers to the IDs one above its own, from the next header of a control frame on.
inline constexpr SlaveFault kWrongId{.name = "wrong-id",
                                     .happens = "% answers to a wrong ID",
                                     .refusal = "this slave has no ID",
                                     .in_accesses = true};
// It sends the word of its last frame again.
inline constexpr SlaveFault kStuckWord{"stuck-word", "% sends its last word again",
                                       "only a BiSS C sensor can have it"};
// Its life counter stands still.
inline constexpr SlaveFault kStuckCounter{"stuck-counter", "life counter of % stands still",
                                          "this slave has no life counter"};
// Its life counter goes two steps on with each frame.
inline constexpr SlaveFault kSkippedWord{"skipped-word", "life counter of % goes two steps at once",
                                         "this slave has no life counter"};
// Its data and those of the slave behind it come in exchanged order (SlaveChain), if the fault is
// there where the data begin.
inline constexpr SlaveFault kSwappedWords{.name = "swapped-words",
                                          .happens = "words of % and of the one behind it swapped",
                                          .refusal = "only a BiSS C sensor can have it",
                                          .needs_next = true};

inline constexpr const SlaveFault* kOfBissC[] = {&kWrongId, &kStuckWord, &kStuckCounter,
                                                 &kSkippedWord, &kSwappedWords};

}  // namespace mb4::sim::slave_fault

#endif  // MB4SIM_BISS_C_FAULTS_HPP_
