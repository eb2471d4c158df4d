// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A scenario with a host that configures the master through its driver and reads all slaves, frame
// by frame: what the commands need of any master. Each master has a session of its own (masters/),
// which its MasterSupport names.
#ifndef MB4SIM_TOOL_SESSION_HPP_
#define MB4SIM_TOOL_SESSION_HPP_

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "connected_slaves.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// A word that the master has delivered as good.
struct Word {
  std::uint64_t bits = 0;       // right aligned
  unsigned data_bits = 0;       // how many they are
  unsigned flag_bits = 0;       // the lowest of them, which are not part of the position
  std::optional<bool> n_error;  // nE and nW, where the master tells them
  std::optional<bool> n_warning;
  std::optional<unsigned> crc;  // not inverted, where the master tells it
};

// What a table, CSV or JSON shows of a frame.
struct WordColumn {
  std::string_view key;    // in CSV; JSON
  std::string_view title;  // of the table
  unsigned width;          // of the table
  bool number;             // a number of JSON, else a string
  // Of a word; empty where it does not have it. Null: the next one of SlaveResult::told.
  std::string (*text)(const Word& word);
};

// Word, position, nE, nW and CRC.
std::span<const WordColumn> all_word_columns();

struct SlaveResult {
  std::optional<Word> word;
  std::string error;  // why there is no word: "CRC error", ...
  // What the master tells of the frame even if it has no word, for the columns without a text of
  // the word, in their order; empty: nothing.
  std::vector<std::string> told{};
};

// The result of a frame for one slave.
struct SlaveOutcome {
  enum class Kind { kRight, kFlagged, kWrong };  // kWrong: as good, but not the word sent
  unsigned slave = 1;
  unsigned channel = 1;
  Kind kind = Kind::kRight;
  std::string state;  // "CRC error", ...
};

struct SessionFrame {
  std::uint64_t number = 1;
  sim::Time begin = 0;  // when the host asked for it
  sim::Time end = 0;    // when the host had the results
  std::string error;    // why no slave could be read; empty: each result tells
  // By slave, in the order of Session::slaves().
  std::vector<SlaveResult> results;
  std::vector<std::optional<std::uint64_t>> sent;  // Word::bits as the slave sent them, if known

  SlaveOutcome::Kind kind(std::size_t index) const;
  bool bad() const;
  std::vector<SlaveOutcome> outcomes(const std::vector<ConnectedSlave>& slaves) const;
};

struct RunSummary {
  sim::Time time = 0;
  std::uint64_t clocks = 0;
  std::uint64_t seed = 0;
  std::string note{};  // what else a user must know of the run; empty: nothing
};

// The registers as the host reads them.
struct RegisterMap {
  // What codes of a field mean. A meaning may be a formula of the clock: f_CLK / 20 / (code + 1).
  struct Code {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::string_view name{};  // empty: none
    std::string_view meaning{};
  };
  struct Field {
    std::string name;
    std::string alternate;  // other meaning of the same bits; empty: none
    unsigned address = 0;
    unsigned lsb = 0;
    unsigned width = 1;
    std::uint32_t word = 0;  // the whole register
    std::string description;
    bool data = false;  // part of a longer value, which `data_rows` show
    std::uint32_t reset = 0;
    std::vector<Code> codes{};  // empty: any value

    std::uint32_t value() const;
  };
  unsigned bits = 8;                 // of a register: 8 or 32
  std::uint64_t clk_hz = 0;          // f_CLK; 0: unknown
  std::vector<std::uint32_t> words;  // all registers, the lowest address first
  // Longer values, which are shown before the fields.
  struct DataRow {
    unsigned address = 0;
    std::string name;
    std::string bytes;  // "00 1F"
    bool at_reset = false;
  };
  std::vector<DataRow> data_rows;
  std::vector<Field> fields;
};

// An access to registers of slaves, or a command to them; with messages, a read of a resource too.
struct ControlRequest {
  enum class Kind { kRead, kWrite, kCommand, kResource };
  Kind kind = Kind::kRead;
  unsigned channel = 1;
  unsigned id = 0;                  // kRead, kWrite
  std::uint8_t address = 0;         // kRead, kWrite
  std::vector<std::uint8_t> bytes;  // to write; to be read: as many
  std::uint8_t code = 0;            // kCommand
  std::uint8_t ids = 0;             // kCommand: bit n is ID n; 0: all
  unsigned resource = 0;            // kResource
  unsigned offset = 0;              // kResource: what is read of it; 0: its name
};

struct SessionOptions {
  sim::SimulatorOptions simulator;
  bool bus_log = false;
  // Actuators are written and the host is checked as the scenario's faults need it. false: only
  // sensors are read.
  bool actuators = true;
};

class Session {
 public:
  // Every call may throw sim::ScenarioError, sim::TraceError or sim::ModelStopped.
  Session(const sim::Scenario& scenario, const SessionOptions& options);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;

  // Configures the master as the scenario says. Returns why this failed, or empty.
  virtual std::string configure() = 0;
  // The next frame of all channels.
  virtual SessionFrame read(std::uint64_t number) = 0;
  // What is shown of each word.
  virtual std::span<const WordColumn> columns() const { return all_word_columns(); }
  // Only if the master has MasterSupport::registers.
  virtual RegisterMap registers();
  // For masters with MasterSupport::control or ::messages. Returns why this failed, or empty.
  virtual std::string access(const ControlRequest& request);

  // What the host does by hand, a line as `mb4sim spi` reads it. Returns what is wrong with it, or
  // empty.
  virtual std::string send(const std::string& line);

  // How often the master had to begin anew before configure() was over.
  virtual std::uint64_t failed_starts() const { return 0; }

  // Frames after a fault in which the master may still tell of it.
  virtual unsigned late_frames() const { return 0; }
  // What the master has told of a frame of the line that was no frame of the session, as
  // Line::flip_frames() counts them; empty: nothing bad, or it was one.
  virtual std::string told_between(std::uint64_t /*frame*/) const { return ""; }

  // Compares the ID that a slave tells with its own. Returns the error, or empty.
  virtual std::string check_id(unsigned /*slave*/) { return ""; }

  const std::vector<ConnectedSlave>& slaves() const { return slaves_; }
  sim::Simulator& simulator() { return simulator_; }
  virtual RunSummary summary() const;
  // What the driver has sent and received since the last call.
  std::string take_bus_log() { return std::exchange(bus_log_, {}); }

 protected:
  // Lets time pass up to the begin of the next frame, as [host] frame_us asks. A frame that was
  // longer is followed at once.
  void wait_for_begin();
  // Null unless the bus is to be logged.
  std::string* log() { return logged_ ? &bus_log_ : nullptr; }

  sim::Simulator simulator_;
  std::vector<ConnectedSlave> slaves_;  // that are read

 private:
  std::string bus_log_;
  bool logged_;
  sim::Time next_begin_ = 0;
};

// What `sweep` tries beside delay and jitter: the codes of the frequency of the line's clock in the
// registers, or those of another rule of the master.
struct SweepCodes {
  std::string_view name{};     // of the field
  unsigned most = 0;           // the highest code
  std::string_view refuses{};  // "... code 16"
  // Clocks in a period of MA, or in a bit; 0 if master or driver cannot make it. Null: there are no
  // codes.
  unsigned (*divider)(std::uint64_t clk_hz, unsigned code) = nullptr;
  std::string_view jitter_item{};    // where it is written what jitter is allowed
  std::string_view period = "T_MA";  // what a jitter is a part of
  // Jitter up to which every word must be good, in thousandths of a percent. Null: 25 %.
  long long (*allowed)(unsigned code) = nullptr;
  unsigned unmeasured = 0;  // frames at first that do not count: the master learns from them
  // --- codes that are no frequencies ---
  unsigned (*present)(const sim::Scenario& scenario) = nullptr;  // what the scenario says
  void (*set)(sim::Scenario& scenario, unsigned code) = nullptr;
  std::string (*title)(unsigned code) = nullptr;
  // --- lines that are not clocked ---
  void (*set_jitter)(sim::LineConfig& cable, sim::Time jitter) = nullptr;
};

// A slave that has answered to a scan.
struct ScannedSlave {
  unsigned channel = 1;
  unsigned id = 0;
  bool has_identity = false;  // else the next two are empty
  std::vector<std::uint8_t> device_id;
  std::vector<std::uint8_t> manufacturer;
  std::optional<unsigned> eds_bank;              // of the first page of its electronic data sheet
  std::optional<std::vector<std::uint8_t>> eds;  // its common page, if it was asked for
};

struct ScanRequest {
  unsigned channel = 1;
  bool eds = false;
  // Called when the slaves have been asked, before their data sheets are read.
  std::function<void(const sim::Simulator&)> asked;
};

struct ScanResult {
  std::vector<ScannedSlave> slaves;
  std::string error;  // why there are none; empty: nobody else has answered
};

// A resource of an encoder, as its messages tell it.
struct EncoderResource {
  unsigned id = 0;
  unsigned depth = 0;  // in the tree
  std::string name{};
  unsigned type = 0;  // its code
  std::string_view type_name{};
  unsigned size = 0;  // bytes
  unsigned read_level = 0;
  unsigned write_level = 0;
  unsigned timeout_ms = 0;
  std::string value{};  // for the user
};

struct EncoderTree {
  std::vector<EncoderResource> resources;  // each node before what is below it
  std::string error;                       // why they are not all; empty: they are
  std::vector<sim::FaultRecord> faults;
};

// What the commands know of a master.
struct MasterSupport {
  std::string_view type;  // as sim::Master::type
  // Throws sim::ScenarioError with the scenario's key that master or driver does not support.
  void (*check)(const sim::Scenario& scenario);
  std::unique_ptr<Session> (*open)(const sim::Scenario& scenario, const SessionOptions& options);
  // --- what a master may leave out ---
  std::string_view not_begun = "cannot configure the chip";  // before what configure() returns
  bool registers = true;                                     // Session::registers()
  bool trains = false;  // it learns its line first, which a bad line does not allow
  SweepCodes sweep{};
  bool control = false;   // Session::access() to registers of slaves, and commands
  bool messages = false;  // Session::access() to a register, a byte each, and to resources
  bool coverage = false;  // sim::FunctionalCoverage knows it
  // Asks the slaves of a channel, of which nothing is known, who they are. Null: it cannot.
  ScanResult (*scan)(const sim::Scenario& scenario, const ScanRequest& request) = nullptr;
  // Reads the resources of the encoder on its only line. Null: it cannot.
  EncoderTree (*walk)(const sim::Scenario& scenario) = nullptr;
};

// Throws sim::ScenarioError if the commands do not know the scenario's master.
const MasterSupport& support_of(const sim::Scenario& scenario);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SESSION_HPP_
