// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The words from 0x100 on that the chip has on a bus of words: identity, features, interrupts, time
// and snapshots. Fields: mb4_page_regs.hpp.

#ifndef MB4_WORDS_PAGE_HPP_
#define MB4_WORDS_PAGE_HPP_

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/result.hpp"
#include "mb4/words/port.hpp"
#include "mb4_page_regs.hpp"

namespace mb4 {

struct PageIdentity {
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint8_t patch = 0;
  std::uint32_t features = 0;  // fields of page::kAddrFeatures, for example page::TWO_LINES::get()
};

// One data channel at one moment, of the bank that the host has.
struct Snapshot {
  std::uint64_t word = 0;     // SCDATAx
  std::uint64_t latched = 0;  // clock of the core at which the slave latched its position
  std::uint32_t frame = 0;   // number of the line's frame that brought the word, from 1 on; 0: none
  bool valid = false;        // SVALIDx
  bool cds = false;          // of the line
  bool bank_failed = false;  // SWBANKFAIL
};

// Events, a bit each: page::FRAME::kMask, ERROR, REGISTER_END, SENSE, LOST.
using Events = std::uint8_t;

// Every call but probe() has one error, kTransport: the port has returned false, because the core's
// clock stands still. The calls change nothing in the chip but the interrupts.
//
// Interrupt safety: two reads of snapshot() of one slave, or of time(), must not interrupt each
// other, because they share the copy behind the low word. MemoryBus reads the time too. All other
// calls may interrupt each other and those of a Device.
template <typename Port>
class Page {
  static_assert(kIsWordPort<Port>,
                "mb4: the Port type needs read and write; see mb4/words/port.hpp");

 public:
  // The port must outlive this object.
  explicit constexpr Page(Port& port) : port_(&port) {}

  // Two or three accesses. kTransport; kNotDetected: there is no page of an iC-MB4.
  Result<PageIdentity> probe() {
    std::uint32_t id = 0;
    std::uint32_t version = 0;
    PageIdentity identity;
    if (!port_->read(page::kAddrId, id)) {
      return Error::kTransport;
    }
    if (id != page::kResetId) {
      return Error::kNotDetected;
    }
    if (!port_->read(page::kAddrVersion, version) ||
        !port_->read(page::kAddrFeatures, identity.features)) {
      return Error::kTransport;
    }
    identity.major = static_cast<std::uint8_t>(version >> 24U);
    identity.minor = static_cast<std::uint8_t>(version >> 16U);
    identity.patch = static_cast<std::uint8_t>(version >> 8U);
    return identity;
  }

  // Clocks of the core since its reset. Two accesses. kTransport.
  Result<std::uint64_t> time() { return pair(page::kAddrTimeLow, page::kAddrTimeHigh); }

  // One step of the chip for the whole group: its words belong together, and no frame waits. Six
  // accesses. kTransport; kInvalidArgument: `slave` is not 1..8.
  Result<Snapshot> snapshot(std::uint8_t slave) {
    if (!is_in(0xFF, slave)) {
      return Error::kInvalidArgument;
    }
    const std::uint32_t group = page::snapshot_address(slave);
    Snapshot snapshot;
    std::uint32_t flags = 0;
    const Result<std::uint64_t> word =
        pair(group + page::kSnapshotLowOffset, group + page::kSnapshotHighOffset);
    if (!word || !port_->read(group + page::kSnapshotFlagsOffset, flags) ||
        !port_->read(group + page::kSnapshotFrameOffset, snapshot.frame)) {
      return Error::kTransport;
    }
    const Result<std::uint64_t> latched =
        pair(group + page::kSnapshotTimeLowOffset, group + page::kSnapshotTimeHighOffset);
    if (!latched) {
      return Error::kTransport;
    }
    snapshot.word = *word;
    snapshot.latched = *latched;
    snapshot.valid = page::SNAPSHOT_VALID<1>::get(flags) != 0;
    snapshot.cds = page::SNAPSHOT_CDS<1>::get(flags) != 0;
    snapshot.bank_failed = page::SNAPSHOT_BANK_FAIL<1>::get(flags) != 0;
    return snapshot;
  }

  // The interrupt is active while one of these events has happened and was not taken. kTransport.
  Result<void> enable(Events events) { return write(page::kAddrIrqEnable, events); }

  // The events since the last call; forgets them. An event that comes meanwhile is told by the next
  // call. One or two accesses. kTransport.
  Result<Events> take_events() {
    std::uint32_t events = 0;
    if (!port_->read(page::kAddrIrqStatus, events)) {
      return Error::kTransport;
    }
    const auto taken = static_cast<Events>(events);
    if (const Result<void> cleared =
            taken == 0 ? Result<void>() : write(page::kAddrIrqStatus, taken);
        !cleared) {
      return cleared.failure();
    }
    return taken;
  }

 private:
  static constexpr std::uint8_t kWord = 0xF;  // all strobes

  Result<void> write(std::uint32_t offset, std::uint32_t value) {
    return port_->write(offset, value, kWord) ? Result<void>() : Error::kTransport;
  }
  // The low word is read first: it copies the high one.
  Result<std::uint64_t> pair(std::uint32_t low_offset, std::uint32_t high_offset) {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    if (!port_->read(low_offset, low) || !port_->read(high_offset, high)) {
      return Error::kTransport;
    }
    return low | std::uint64_t{high} << 32U;
  }

  Port* port_;
};

}  // namespace mb4

#endif  // MB4_WORDS_PAGE_HPP_
