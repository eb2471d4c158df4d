// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Every instruction, INIT and access must end, and the chip must recover. BREAK ends the
// exceptions: the clock stands still, a line waits (decisions 3 and 4), or the access waits for the
// host or GETSENS.
#include <algorithm>
#include <array>
#include <optional>

#include "mb4_regs.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/chip/fuzz/chip_fuzz_run.hpp"
#include "tests/support/bits.hpp"

namespace mb4test {
namespace {

namespace reg = mb4::regs;
namespace sim = mb4::sim;
using sim::Pin;

constexpr unsigned kSettleClocks = 30;
constexpr unsigned kAtOnceClocks = 200;

std::string hex(const std::array<std::uint8_t, 5>& status) {
  std::string text;
  for (const std::uint8_t byte : status) {
    static const char* const kDigits = "0123456789ABCDEF";
    text += {' ', kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
  return text;
}

}  // namespace

void FuzzRun::ensure_clock() {
  if (host_.wait_clocks(4)) return;
  count(FuzzCounts::kWaitsClock);
  const unsigned iface = host_.written(reg::kAddrIface);
  if ((iface & reg::CLKENI::kMask) != 0) fail("clock", "stands still with CLKENI = 1");
  host_.write(reg::kAddrIface, {static_cast<std::uint8_t>(iface | reg::CLKENI::kMask)});
  if (!host_.wait_clocks(4)) fail("clock", "stands still after CLKENI = 1");
}

// Waits until done(), which looks at status_, or until `bound` clocks have passed.
template <typename Done>
FuzzRun::End FuzzRun::wait_until(std::uint64_t bound, Done done) {
  const std::uint64_t start = host_.clocks();
  std::uint64_t step_ns = 30 * host_.clock_ns();
  bool eot = false;
  for (unsigned looks = 0;; ++looks) {
    // Most of the awaited events come together with EOT = 1.
    if (looks % 4 == 0 || host_.simulator().pin(Pin::kEot)) {
      status_ = host_.status();
      if (done(eot)) return End::kDone;
    }
    const std::uint64_t before = host_.clocks();
    if (before - start > bound && looks % 4 == 0) return End::kWaits;
    if (before - start > most_clocks_) return End::kTooLong;
    host_.session().watch_ns(step_ns, [&] { eot = eot || host_.simulator().pin(Pin::kEot); });
    if (host_.clocks() == before) ensure_clock();
    step_ns = std::min(step_ns * 2, 2 + bound / 8 * host_.clock_ns());
  }
}

// Longest time that an instruction may take while its lines answer: a frame that runs, the slaves'
// timeouts, another frame or INIT; register mode of BiSS B.
std::uint64_t FuzzRun::frame_bound() const {
  const Possible& possible = host_.possible();
  constexpr std::uint64_t kTimeoutPeriods = 3 * 1024;
  std::uint64_t bound = (2 * possible.frame_periods + kTimeoutPeriods) * possible.ma_clocks + 6000;
  if (possible.biss_b_control && possible.control_asked) {
    bound += (possible.bytes + 4) * possible.limit;
  }
  return bound;
}

// Longest time of an access of BiSS C whose frames follow each other. A frame that hangs ends it
// after 9/8 of the limit.
std::uint64_t FuzzRun::access_bound() const {
  const Possible& possible = host_.possible();
  return (60 + 20 * possible.bytes) *
             (2 * possible.ags_period + std::uint64_t{possible.frame_periods} * possible.ma_clocks +
              1500) +
         (possible.bytes + 3) * possible.limit * 9 / 8 + frame_bound();
}

// As the status that was read last says.
bool FuzzRun::access_ended() const {
  return (status_[0] & reg::REGEND::kMask) != 0 && !is_control(status_[4]);
}

// Waits until no frame and no INIT runs; with AGS = 1 until a frame has ended or none runs.
FuzzRun::End FuzzRun::wait_end() {
  ensure_clock();
  if (!host_.wait_clocks(kSettleClocks)) ensure_clock();
  return wait_until(frame_bound(), [&](bool eot) {
    if ((status_[4] & reg::INIT::kMask) != 0) return false;
    const bool now = (status_[0] & reg::EOT::kMask) != 0;
    return (status_[4] & reg::AGS::kMask) != 0 ? eot || now
                                               : now && (status_[4] & reg::INSTR::kMask) == 0;
  });
}

void FuzzRun::not_ended(End end) {
  if (end == End::kTooLong) return end_by_break(FuzzCounts::kWaitsTooLong);
  classify_wait();
}

// An instruction has not ended. Finds out whether a line does not answer.
void FuzzRun::classify_wait() {
  const Possible& possible = host_.possible();
  struct Seen {
    Pin sl, ma;
    bool first_sl = false, first_ma = false;
    bool sl_changed = false, ma_changed = false;
    bool ma_now = false, sl_moved = false;
    std::array<std::optional<bool>, 2> sl_at{};  // SL at the edges of MA, falling and rising
  };
  std::array<Seen, 2> lines{Seen{Pin::kSl1, Pin::kMa1}, Seen{Pin::kSl2, Pin::kMa2}};
  auto& simulator = host_.simulator();
  for (Seen& line : lines) {
    line.first_sl = simulator.pin(line.sl);
    line.first_ma = line.ma_now = simulator.pin(line.ma);
  }
  host_.session().watch_ns(100 * possible.ma_clocks * host_.clock_ns(), [&] {
    for (Seen& line : lines) {
      const bool ma = simulator.pin(line.ma);
      const bool sl = simulator.pin(line.sl);
      line.ma_changed = line.ma_changed || ma != line.first_ma;
      if (ma != line.ma_now) {
        std::optional<bool>& before = line.sl_at.at(ma ? 1 : 0);
        line.sl_moved = line.sl_moved || before.value_or(sl) != sl;
        before = sl;
        line.ma_now = ma;
      }
      line.sl_changed = line.sl_changed || sl != line.first_sl;
    }
  });
  // A slave that repeats MA, as one of SSI whose timeout is shorter than half a period, shows the
  // same bit in each period: it does not answer.
  for (Seen& line : lines) line.sl_changed = line.sl_changed && (line.sl_moved || !line.ma_changed);
  for (unsigned i = 0; i < 2; ++i) {
    const Seen& line = lines[i];
    const bool nothing_seen = i == 1 && possible.paired;
    if (!possible.used[i] || (line.sl_changed && !nothing_seen)) continue;
    // MA may be hidden: forced, or pin MA2 is the inverse of MA1.
    const bool clocked =
        line.ma_changed || possible.ma_forced || possible.ma_may_rest || nothing_seen;
    if (!line.first_sl && possible.agsmin && !line.ma_changed) {
      return end_by_break(FuzzCounts::kWaitsSlLow);
    }
    if (!possible.biss[i] || !clocked) continue;
    // Decision 24: the access ends all the same.
    const bool held = chip_.agserr_on_hold && (status_[4] & reg::HOLDBANK::kMask) != 0;
    if (is_control(status_[4]) && host_.access_clean() && !possible.biss_b_control && !held &&
        !is_agsinfinite(host_.written(reg::kAddrFreqags))) {
      // The frame goes on with the end of a fault. Then the access waits for the host's next write
      // (23), or needs as many frames as any other.
      const bool fault_ends = host_.simulator().now() / sim::kPsPerNs <
                              chip_.faults_end_ns + frame_bound() * host_.clock_ns();
      const auto frame_ended = [&](bool eot) {
        return fault_ends &&
               ((status_[4] & reg::AGS::kMask) != 0 ? eot : (status_[0] & reg::EOT::kMask) != 0);
      };
      bool ended = false;
      const End end = wait_until(possible.limit * 9 / 8 + frame_bound(), [&](bool eot) {
        ended = access_ended();
        return ended || frame_ended(eot);
      });
      if (end == End::kTooLong) return end_by_break(FuzzCounts::kWaitsTooLong);
      if (end == End::kWaits) {
        fail("access", "does not end while a slave is silent (24), status" + hex(status_));
      }
      if (!ended) return check_access_ends();
      count(FuzzCounts::kAccessesEnd);
    }
    return end_by_break(FuzzCounts::kWaitsSlave);
  }
  // A fault of a line has just ended: the frame goes on.
  if ((lines[0].sl_changed || lines[1].sl_changed) && wait_end() == End::kDone) return;
  fail("instruction", "does not end, 0xF0 to 0xF4 read" + hex(status_));
}

void FuzzRun::end_by_break(FuzzCounts::What wait) {
  count(wait);
  ensure_clock();
  const unsigned bank = host_.banks();
  if (one_in(4)) {
    host_.instruct_twice(bank | reg::BREAK::kMask, one_in(2) ? bank : bank ^ reg::HOLDBANK::kMask);
  } else {
    host_.instruct(bank | reg::BREAK::kMask);
  }
  if (!host_.wait_clocks(2 * kSettleClocks + 2 * host_.possible().ma_clocks)) ensure_clock();
  status_ = host_.status();
  const unsigned agserr = chip_.agserr_on_write ? 0 : reg::nAGSERR::kMask;
  constexpr unsigned kAfterBreak =
      reg::kNdelayerrGood | reg::kNscderrGood | reg::kNregerrGood | reg::kEotIdle;
  constexpr unsigned kOther = kAfterBreak | reg::REGEND::kMask;
  if ((status_[4] & (reg::INIT::kMask | reg::INSTR::kMask | reg::AGS::kMask)) != 0 ||
      (status_[0] & (kOther | agserr)) != (kAfterBreak | agserr)) {
    fail("BREAK", "0xF0 to 0xF4 read" + hex(status_));
  }
  count(FuzzCounts::kBreaks);
  host_.access_ended();
  host_.at_rest();
}

void FuzzRun::check_cannot_run() {
  if (!host_.access_open() || !host_.access_clean() || host_.access_can_run()) return;
  const End end = wait_until(kAtOnceClocks, [&](bool /*eot*/) {
    return !is_control(status_[4]) &&
           (status_[0] & (reg::REGEND::kMask | reg::nREGERR::kMask)) == reg::REGEND::kMask;
  });
  if (end != End::kDone) fail("access that cannot run (37)", "0xF0 to 0xF4 read" + hex(status_));
  count(FuzzCounts::kAccessesCannotRun);
  host_.access_ended();
}

// Sends requests until the access has ended.
void FuzzRun::drive_on(bool by_getsens) {
  const Possible& possible = host_.possible();
  const std::uint64_t most = access_bound();
  const std::uint64_t start = host_.clocks();
  const unsigned most_requests = 120 + 20 * possible.bytes;
  for (unsigned requests = 1;; ++requests) {
    if (by_getsens) {
      host_.pin(Pin::kGetsens, "GETSENS", true);
      host_.wait_ns(3 * host_.clock_ns());
      host_.pin(Pin::kGetsens, "GETSENS", false);
    } else {
      // With the quirk HOLDBANK keeps frames back, and the access would get none.
      host_.instruct((host_.banks() & (chip_.agserr_on_hold ? reg::SWBANK::kMask : ~0U)) |
                     reg::kInstrControl);
    }
    if (const End end = wait_end(); end != End::kDone) return not_ended(end);
    if (access_ended()) {
      count(FuzzCounts::kAccessesEnd);
      host_.access_ended();
      return;
    }
    if (requests > most_requests && host_.clocks() - start > most) {
      const bool low = (possible.used[0] && !host_.simulator().pin(Pin::kSl1)) ||
                       (possible.used[1] && !host_.simulator().pin(Pin::kSl2));
      if (by_getsens && low) return end_by_break(FuzzCounts::kWaitsSlLow);
      fail("access", "does not end with " + std::to_string(requests) +
                         " requests, 0xF0 to 0xF4 read" + hex(status_));
    }
    if (host_.clocks() - start > most_clocks_) return end_by_break(FuzzCounts::kWaitsTooLong);
    if (requests > 100) host_.wait_clocks(most / 64);
  }
}

void FuzzRun::check_access_ends() {
  check_cannot_run();
  if (!host_.access_open()) return;
  if (access_ended()) {
    count(FuzzCounts::kAccessesEnd);
    host_.access_ended();
    return;
  }
  const Possible& possible = host_.possible();
  const bool ags = (status_[4] & reg::AGS::kMask) != 0;
  if (!ags) {
    if (one_in(2)) return end_by_break(FuzzCounts::kWaitsHost);
    count(FuzzCounts::kWaitsHost);
    return drive_on(false);
  }
  if (is_agsinfinite(host_.written(reg::kAddrFreqags))) {
    if (one_in(2)) return end_by_break(FuzzCounts::kWaitsGetsens);
    count(FuzzCounts::kWaitsGetsens);
    if (!is_control(status_[4]))
      host_.instruct(host_.banks() | reg::AGS::kMask | reg::kInstrControl);
    return drive_on(true);
  }
  if (chip_.agserr_on_hold && (status_[4] & reg::HOLDBANK::kMask) != 0) {
    return end_by_break(FuzzCounts::kWaitsHold);
  }
  // Another INSTR was written before it began, or while it ran (then it goes on).
  if (!is_control(status_[4])) host_.instruct(host_.banks() | reg::AGS::kMask | reg::kInstrControl);
  const End later = wait_until(access_bound(), [&](bool /*eot*/) { return access_ended(); });
  if (later == End::kTooLong) return end_by_break(FuzzCounts::kWaitsTooLong);
  if (later == End::kDone) {
    count(FuzzCounts::kAccessesEnd);
    host_.access_ended();
    return;
  }
  const bool low = (possible.used[0] && !host_.simulator().pin(Pin::kSl1)) ||
                   (possible.used[1] && !host_.simulator().pin(Pin::kSl2));
  if (possible.biss_b_control && low) return end_by_break(FuzzCounts::kWaitsSlLow);
  // Only BiSS C begins beside a running frame, and ends beside one that hangs (24). Any other
  // INSTR 100 or 111, also one that cannot run, is taken after the frame (19), which a line that
  // does not answer holds (4).
  const bool biss_c = (host_.written(reg::kAddrCtrl) & reg::REGVERS::kMask) != 0;
  if ((!biss_c || !host_.access_can_run()) && (status_[0] & reg::EOT::kMask) == 0) {
    const End frame = wait_end();
    if (frame != End::kDone) return not_ended(frame);
  }
  fail("access", "does not end with AGS = 1, 0xF0 to 0xF4 read" + hex(status_));
}

void FuzzRun::check_end() {
  // Most sessions have no time for the slowest settings.
  most_clocks_ = one_in(64) ? 8'000'000 : 300'000;
  check_ended();
  if (one_in(3) && at_rest()) check_read_back();
  if (one_in(2) || !at_rest()) return;
  // An access that nothing disturbs; the lines are as the phase has left them.
  if (one_in(4)) {
    host_.write(reg::kAddrCfgch, {static_cast<std::uint8_t>(one_in(2) ? 0x0F : byte())});
  }
  ask_for_access();
  check_ended();
}

// AGS = 0 and nothing runs.
bool FuzzRun::at_rest() {
  return !host_.access_open() && (host_.written(reg::kAddrInstr) & reg::AGS::kMask) == 0;
}

void FuzzRun::check_ended() {
  count(FuzzCounts::kEndsAsked);
  if (const End end = wait_end(); end != End::kDone) {
    not_ended(end);
  } else {
    count(FuzzCounts::kInstructionsEnd);
    check_access_ends();
  }
  if ((host_.written(reg::kAddrInstr) & reg::AGS::kMask) != 0) {
    if (one_in(3)) return;
    host_.instruct(host_.banks());
    if (const End end = wait_end(); end != End::kDone) return not_ended(end);
  }
  if (at_rest()) host_.at_rest();
}

// Bytes of SCDATA or RDATA, read straight behind their writes, while nothing runs that writes them
// too (decision 36). SPI2 reads only the memory.
void FuzzRun::check_read_back() {
  constexpr unsigned kAlways = 4;  // bytes, with any clock
  constexpr unsigned kMost = 40;
  constexpr std::uint64_t kSlowestNs = 100;  // 10 MHz
  constexpr std::uint64_t kAnyCycleNs = 50;  // 20 MHz
  constexpr unsigned kLeastCycleNs = 100;    // with a slower clock
  if (chip_.spi2 || !host_.wait_clocks(64 * kSettleClocks)) return;
  const bool all =
      !chip_.clk_stops && host_.clock_ns() <= kSlowestNs &&
      (!chip_.parallel || chip_.cycle_ns >= kLeastCycleNs || host_.clock_ns() <= kAnyCycleNs);
  std::vector<std::uint8_t> bytes(1 + below(all ? kMost : kAlways));
  for (auto& value : bytes) value = byte();
  const unsigned first = (one_in(2) ? reg::kAddrScdata : reg::kAddrRdata) +
                         below(static_cast<unsigned>(reg::kRdataCount - bytes.size() + 1));
  host_.write(first, bytes);
  if (host_.read(first, bytes.size()) != bytes) {
    fail("read back", std::to_string(bytes.size()) + " bytes from " + std::to_string(first) +
                          " do not read as they were written (36)");
  }
  count(FuzzCounts::kReadBacks);
}

// Waits until the slaves' timeouts are over and, after INIT, SL is 1.
void FuzzRun::wait_slaves(bool sl_high) {
  const auto idle = [&](unsigned line, Pin sl) {
    return !chip_.lines[line].present ||
           (clocked(host_.simulator().line(line + 1))->chain().idle() &&
            (!sl_high || host_.simulator().pin(sl)));
  };
  if (!host_.session().wait_until([&] { return idle(0, Pin::kSl1) && idle(1, Pin::kSl2); },
                                  3'000'000, 1000)) {
    fail("recovery", "the slaves' timeouts do not end");
  }
}

// Configures anew with a running clock and force bits 0; then BREAK, INIT and a frame must work.
void FuzzRun::recover() {
  auto& simulator = host_.simulator();
  if (const std::uint64_t now_ns = simulator.now() / sim::kPsPerNs; now_ns < chip_.faults_end_ns) {
    host_.wait_ns(chip_.faults_end_ns - now_ns);
  }
  host_.pin(Pin::kGetsens, "GETSENS", false);
  host_.pin(Pin::kNer, "NER", true);
  if (!chip_.lines[0].present) host_.pin(Pin::kSl1, "SL1", true);
  if (!chip_.lines[1].present) host_.pin(Pin::kSl2, "SL2_NSL1", true);
  const bool osc = chip_.f_clk_hz == 0 || chip_.clk_stops_for_ever || one_in(2);
  host_.write(reg::kAddrIface, {static_cast<std::uint8_t>(osc ? reg::CLKENI::kMask : 0U)});
  configure(true);
  misfit_ = {};
  if (!host_.wait_clocks(100)) fail("recovery", "the clock does not run");
  host_.instruct(host_.banks() & reg::SWBANK::kMask);
  end_by_break(FuzzCounts::kRecoveries);
  host_.instruct(host_.banks() & reg::SWBANK::kMask);
  // MO that fell with EN_MO less than a timeout ago selects register mode of BiSS B.
  host_.wait_ns(40'000);
  wait_slaves(false);
  // A command may have switched a slave off: its data channel is not there then. A slave carries
  // the command out when its timeout ends the frame with the last bit, which may be after the
  // BREAK. INIT is no frame: from here on no command takes effect.
  std::vector<std::pair<const FuzzSlave*, unsigned>> there;
  for (unsigned line = 0; line < 2; ++line) {
    for (const FuzzSlave& slave : chip_.lines[line].slaves) {
      sim::ControlSlave* const control = clocked(simulator.slave(slave.number))->control();
      if (control != nullptr && !control->data_active()) {
        host_.write(reg::slave_cfg_address(slave.channel + 1), {0});
      } else if (!slave.actuator) {
        there.emplace_back(&slave, line);
      }
    }
  }
  const unsigned bank = host_.banks() & reg::SWBANK::kMask;
  host_.instruct(bank | reg::INIT::kMask);
  check_init();
  wait_slaves(true);
  host_.instruct(bank | reg::kInstrCdm0);
  if (wait_end() != End::kDone) fail("recovery", "the frame does not end, status" + hex(status_));
  if (!is_good()) fail("recovery", "after the frame" + hex(status_));
  const auto svalid = host_.read(reg::kAddrSvalidLo, 2);
  for (const auto& [slave, line] : there) {
    const unsigned x = slave->channel;
    const auto data = host_.read(reg::scdata_address(x + 1), 8);
    if ((svalid[x / 4] >> (2 * (x % 4) + 1) & 1U) == 0) {
      fail("recovery", "SVALID" + std::to_string(x + 1) + " is 0");
    }
    compare_word(line, *slave, data);
    std::uint64_t word = 0;
    for (unsigned i = (slave->bits + 7) / 8; i-- > 0;) word = word << 8U | data[i];
    if (word != simulator.slave(slave->number)->sent_word()) {
      fail("recovery", "SCDATA" + std::to_string(x + 1) + " is not the word of the last frame");
    }
    count(FuzzCounts::kRecoveredWords);
  }
  check_init_behind_break();
}

// The status that was read last shows no error and nothing that runs.
bool FuzzRun::is_good() const {
  const unsigned agserr = chip_.agserr_on_write ? reg::nAGSERR::kMask | reg::nERR::kMask : 0U;
  return (status_[0] | agserr) == (reg::kResetStatus0 | agserr);
}

// INIT has been written. Waits for its end and returns the line delays that it has measured.
std::array<std::uint8_t, 2> FuzzRun::check_init() {
  if (wait_end() != End::kDone) fail("INIT", "does not end, status" + hex(status_));
  if (!is_good()) fail("INIT", "after its end" + hex(status_));
  std::array<std::uint8_t, 2> delays{};
  // Without BiSS C nothing is measured. An SSI line takes no part in INIT (docs/choices.md).
  if ((host_.written(reg::kAddrCtrl) & reg::REGVERS::kMask) == 0) return delays;
  const std::array<bool, 2>& biss = host_.possible().biss;
  if ((biss[0] || biss[1]) && (status_[1] != 0 || status_[2] != 0)) {
    fail("SVALID after INIT (35)", "status" + hex(status_));
  }
  for (const unsigned line : {0U, 1U}) {
    if (biss[line]) delays[line] = host_.read(reg::scdata_address(4 * line + 1), 1)[0];
  }
  return delays;
}

// BREAK cuts a frame, automatic frames or INIT, or comes in the slaves' timeout. INIT comes in the
// same byte or soon behind it: it ends without an error and measures the delays that INIT measures
// on idle lines (decision 46).
void FuzzRun::check_init_behind_break() {
  const bool measures = (host_.written(reg::kAddrCtrl) & reg::REGVERS::kMask) != 0;
  const unsigned bank = host_.banks() & reg::SWBANK::kMask;
  wait_slaves(true);
  host_.instruct(bank | reg::INIT::kMask);
  const std::array<std::uint8_t, 2> delays = check_init();
  for (unsigned left = 1 + below(4); left > 0; --left) {
    // No delay is left from the INIT before.
    for (const unsigned line : {0U, 1U}) {
      host_.write(reg::scdata_address(4 * line + 1), {static_cast<std::uint8_t>(~delays[line])});
    }
    wait_slaves(true);
    const unsigned kind = below(4);
    host_.instruct(bank | (kind == 0 && measures ? reg::INIT::kMask
                           : kind == 1           ? reg::AGS::kMask
                                                 : reg::kInstrCdm0));
    const std::uint64_t frame = std::uint64_t{host_.possible().frame_periods} *
                                host_.possible().ma_clocks * host_.clock_ns();
    host_.wait_ns(1 + below(static_cast<unsigned>(one_in(2) ? frame : frame + 30'000)));
    switch (below(3)) {
      case 0:
        host_.instruct(bank | reg::BREAK::kMask | reg::INIT::kMask);
        break;
      case 1:
        host_.instruct_twice(bank | reg::BREAK::kMask, bank | reg::INIT::kMask);
        break;
      default:
        host_.instruct(bank | reg::BREAK::kMask);
        host_.wait_ns(6 * host_.clock_ns() + below(60'000));
        host_.instruct(bank | reg::INIT::kMask);
        break;
    }
    const std::array<std::uint8_t, 2> again = check_init();
    count(FuzzCounts::kInitsBehind);
    for (const unsigned line : {0U, 1U}) {
      if (again[line] != delays[line]) {
        fail("INIT behind BREAK (46)", "delay of line " + std::to_string(line + 1) + " is " +
                                           std::to_string(again[line]) + ", not " +
                                           std::to_string(delays[line]));
      }
      if (measures && host_.possible().biss[line]) count(FuzzCounts::kDelaysAgain);
    }
  }
}

}  // namespace mb4test
