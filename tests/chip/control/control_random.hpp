// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random control communication on random chains: registers written and read back, commands, busy
// slaves, one fault an access. The reports of the chip are compared with a model of the
// slaves' registers and with the weak places of the protocol that docs/choices.md names.
#ifndef TESTS_CHIP_CONTROL_CONTROL_RANDOM_HPP_
#define TESTS_CHIP_CONTROL_CONTROL_RANDOM_HPP_

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_slave.hpp"
#include "tests/chip/control/register_model.hpp"
#include "tests/support/control_host.hpp"

namespace mb4test {

// The chip has made a wrong report.
class WrongReport : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ControlAccess {
  enum class Kind { kRead, kWrite, kCommand };
  Kind kind = Kind::kRead;
  unsigned id = 0;
  unsigned address = 0;
  std::vector<std::uint8_t> data;  // as many as there are registers to read
  std::uint8_t ids = 0;            // bit 7 = ID 0
  bool tested = false;
};

struct ControlFault {
  // One bit inverted: CDM at all slaves or at the addressed one alone, CDS at the master's end, one
  // of the zeros before S, sensor data. Or a slave that does not answer, or answers wrongly.
  enum class Kind { kNone, kCdm, kCdmAlone, kCds, kZero, kData, kSilent, kWrongCrc };
  static constexpr unsigned kKinds = 8;
  Kind kind = Kind::kNone;
  unsigned slot = 0;
};

struct ControlTally {
  std::uint64_t reads = 0, writes = 0, commands = 0, bytes = 0;
  std::uint64_t faults[ControlFault::kKinds] = {};
  std::uint64_t reg_errors = 0, delay_errors = 0;
  std::uint64_t missing = 0;     // ID or register that no slave has
  std::uint64_t cut_writes = 0;  // reported as errors, but the slave has written part of a byte
  // Accesses that the chip reports as good although they were not done: the weak places.
  std::uint64_t lost_start = 0, early_start = 0, lost_execution = 0, lost_broadcast = 0,
                cut_reads = 0, false_acknowledge = 0;
};

// One chain on one line of one chip.
class ControlRun {
 public:
  explicit ControlRun(std::uint64_t seed);

  // One access; throws WrongReport.
  void step(ControlTally& tally);
  const std::string& scenario() const { return scenario_; }
  // What was done so far, one access a line.
  const std::string& log() const { return log_; }

 private:
  struct Device {
    sim::ClockedSlave* slave = nullptr;
    RegisterModel model;
  };
  struct Outcome {
    bool reg_error = false;
    bool delay_error = false;
    unsigned good_bytes = 0;
  };

  bool one_in(unsigned n) { return random_.up_to(n - 1) == 0; }
  unsigned below(unsigned n) { return static_cast<unsigned>(random_.up_to(n - 1)); }
  std::string make_scenario();
  void configure();
  ControlAccess draw_access();
  ControlFault draw_fault(const ControlAccess& access);
  void apply(const ControlAccess& access, const ControlFault& fault);
  Outcome run(const ControlAccess& access);
  void send_zeros(unsigned frames);
  void note(const ControlAccess& access, const ControlFault& fault);
  void note(const Outcome& outcome);

  // Slot in which the slave's start bit of each register comes.
  std::vector<unsigned> starts(const ControlAccess& access) const;
  // Registers before the first that the addressed slave does not have.
  unsigned existing(const ControlAccess& access) const;
  Device* target(const ControlAccess& access);
  struct CutByte {
    unsigned index;
    std::uint8_t value;
    bool written;
  };
  std::optional<CutByte> cut_byte(const ControlAccess& access, const ControlFault& fault) const;
  // The register that the master takes for written although the slave has refused it.
  std::optional<unsigned> weak_byte(const ControlAccess& access, const ControlFault& fault,
                                    bool& early) const;
  std::optional<CutByte> cut_read(const ControlAccess& access, const ControlFault& fault) const;
  void check_read(const ControlAccess& access, const ControlFault& fault, const Outcome& outcome,
                  ControlTally& tally);
  void check_write(const ControlAccess& access, const ControlFault& fault, const Outcome& outcome,
                   ControlTally& tally);
  void check_command(const ControlAccess& access, const ControlFault& fault, const Outcome& outcome,
                     ControlTally& tally);
  void check_rest(const ControlAccess& access, const ControlFault& fault, const Outcome& outcome);
  void require(bool good, const std::string& what) const;

  mb4::sim::Random random_;
  unsigned channel_ = 1;
  unsigned count_ = 1;                                        // slaves on it
  unsigned read_busy_ = 0, write_busy_ = 0, store_busy_ = 0;  // frames
  bool by_time_ = false;  // busy times in microseconds: slots are not known beforehand
  bool ags_ = true;
  std::vector<RegisterModel> models_;  // before the chip exists
  std::string scenario_;
  std::string log_;
  std::unique_ptr<Chip> chip_;
  std::unique_ptr<ControlHost> host_;
  std::vector<Device> devices_;           // by ID
  std::vector<std::uint64_t> executed_;   // commands seen by each device
  unsigned there_ = 0;                    // existing() before the access that runs
  std::optional<ControlAccess> written_;  // to be read back
};

}  // namespace mb4test

#endif  // TESTS_CHIP_CONTROL_CONTROL_RANDOM_HPP_
