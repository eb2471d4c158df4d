// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Slots of the bits of a BiSS C control frame, counted in frames from its start bit S (slot 0). CDM
// goes to the slaves at the end of a frame. CDS comes back after the start bit of a frame. The CDS
// that answers a CDM is one slot later.
//
// Sources: iC-MB4 Rev D2, pages 27 to 29; TI TIDEP0022 (register access); docs/choices.md for
// commands, where the datasheet's figures leave points open.
#ifndef MB4SIM_CONTROL_SLOTS_HPP_
#define MB4SIM_CONTROL_SLOTS_HPP_

namespace mb4::sim::control_slot {

// Number of frames with CDM = 0 before a start bit. The same number inside a control frame ends it.
inline constexpr unsigned kZerosBeforeStart = 14;

// CDM, register access and command.
inline constexpr unsigned kStart = 0;
inline constexpr unsigned kCts = 1;         // 1: register access, 0: command
inline constexpr unsigned kHeaderEnd = 11;  // last of the 11 bits that the header CRC covers
inline constexpr unsigned kCrcEnd = 15;
// CDM, register access.
inline constexpr unsigned kRead = 16;
inline constexpr unsigned kWrite = 17;
inline constexpr unsigned kAccessStart = 18;
inline constexpr unsigned kAccessBits = 12;  // 8 data bits and 4 CRC bits, then the stop bit P
// CDM, command: the execution bit EX, without and with a test of IDA. P follows EX.
inline constexpr unsigned kExImmediate = 16;
inline constexpr unsigned kExTested = 24;
// CDS, eight bits each, ID 0 first.
inline constexpr unsigned kIdl = 1;
inline constexpr unsigned kIda = 17;
inline constexpr unsigned kIds = 8;  // number of IDs
// CDS, register access without busy time.
inline constexpr unsigned kReadEcho = 17;
inline constexpr unsigned kWriteEcho = 18;
inline constexpr unsigned kAnswerStart = 19;
inline constexpr unsigned kAnswer = 20;
inline constexpr unsigned kAnswerEnd = 31;

}  // namespace mb4::sim::control_slot

#endif  // MB4SIM_CONTROL_SLOTS_HPP_
