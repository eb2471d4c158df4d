// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// BiSS Safety beside a read path: the set-up, and the check of one frame, which goes to the other
// contexts as a snapshot. The read itself is not here.

#include "mb4/safety.hpp"

#include "enc/snapshot.hpp"

extern "C" bool firmware(mb4::Safety& safety, const mb4::SafetyConfig* words,
                         const mb4::Result<mb4::Reading>& control,
                         const mb4::Result<mb4::Reading>& word,
                         enc::Snapshot<mb4::SafetyVerdict>& latest, mb4::SafetyVerdict& copy) {
  if (words != nullptr) {
    return safety.configure(*words) == mb4::SafetyField::kNone;
  }
  latest.write(safety.check(mb4::safety_sample(control, word)));
  return latest.read(copy) && copy.ok();
}
