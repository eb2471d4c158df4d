// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/chip/random/random_run.hpp"

#include <algorithm>

#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/bits.hpp"

namespace mb4test {
namespace {

namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr std::uint64_t kLimitNs = 200'000'000;

}  // namespace

void RandomRun::expect(bool good, const std::string& what) {
  if (good) return;
  session_.comment("here: " + what);
  throw Difference(what);
}

void RandomRun::set_freqags(unsigned code) {
  session_.write(reg::kAddrFreqags, {static_cast<std::uint8_t>(code)});
}

void RandomRun::wait_idle() {
  session_.wait_ns(400);  // pin EOT falls two or three clocks after the instruction
  auto& simulator = session_.simulator();
  // SL alone may still show the last data bit.
  const auto ended = [&](unsigned line, sim::Pin sl) {
    return !case_.used[line - 1] ||
           (clocked(simulator.line(line))->chain().idle() && simulator.pin(sl));
  };
  const bool idle = session_.wait_until(
      [&] {
        return simulator.pin(sim::Pin::kEot) && ended(1, sim::Pin::kSl1) &&
               ended(2, sim::Pin::kSl2);
      },
      kLimitNs);
  expect(idle, "the frame does not end");
}

std::uint64_t RandomRun::frames_seen() {
  return session_.simulator().slave(case_.used[0] ? 1 : 5)->frames();
}

// How often did the CRC not see a fault?
void RandomRun::count_faults(std::uint64_t frame) {
  if (frame >= RandomCase::kFrames) return;
  const mb4test::Lines lines = case_.frame(frame);
  for (unsigned line = 0; line < 2; ++line) {
    if (!case_.used[line]) continue;
    std::size_t at = case_.cds_bits(line);
    for (const Sensor& sensor : case_.lines[line]) {
      if (sensor.actuator) {
        at += sensor.slot_bits();
        continue;
      }
      const std::string sent =
          word_on_line(sensor.sent(frame), sensor.bits, sensor.crc, sensor.start);
      const std::string got = lines.bits[line].substr(at, sent.size());
      at += sent.size();
      ++counts_.words;
      if (got == sent || sensor.crc.width == 0) continue;
      ++counts_.faulty_words;
      if (crc_fits(got, sensor.bits, sensor.crc, sensor.start)) ++counts_.undetected;
    }
  }
}

void RandomRun::take_frames(std::uint64_t up_to) {
  for (; applied_ < up_to; ++applied_) {
    for (unsigned line = 0; line < 2; ++line)
      mo_[line] = reference_.mo_bits(case_.registers, line + 1);
    reference_.frame(case_.registers, case_.frame(applied_));
    ++counts_.frames;
    count_faults(applied_);
  }
}

// Each actuator has taken a word from every frame, and holds the word that MO had to send in the
// last one.
void RandomRun::check_actuators() {
  for (unsigned line = 0; line < 2; ++line) {
    std::size_t at = 0;
    for (const Sensor& sensor : case_.lines[line]) {
      const std::size_t slot = at;
      at += sensor.slot_bits();
      if (!sensor.actuator || !case_.used[line] || applied_ == 0) continue;
      const sim::Actuator& actuator =
          *clocked(session_.simulator().slave(sensor.slave))->actuator();
      const std::uint64_t word =
          from_bits(mo_[line].substr(slot + (sensor.stop_bit ? 1 : 0), sensor.bits));
      const std::string which = "actuator " + std::to_string(sensor.slave) + ": ";
      expect(
          actuator.words() == applied_ && actuator.crc_errors() == 0 && actuator.stop_errors() == 0,
          which + std::to_string(actuator.words()) + " good words, " +
              std::to_string(actuator.crc_errors()) + " wrong CRCs, " +
              std::to_string(actuator.stop_errors()) + " wrong stop bits in " +
              std::to_string(applied_) + " frames");
      expect(actuator.word() == word, which + to_bits(actuator.word(), sensor.bits) +
                                          ", expected " + to_bits(word, sensor.bits));
    }
  }
}

void RandomRun::check() {
  check_actuators();
  const auto status = session_.spi({reg::kSpiOpcodeReadStatus, 0, 0, 0, 0});
  const bool error = reference_.scd_error() || reference_.ags_error();
  const unsigned expected = (error ? 0U : reg::kNerrGood) |
                            (reference_.ags_error() ? 0U : reg::kNagserrGood) |
                            (reference_.scd_error() ? 0U : reg::kNscderrGood) | reg::kEotIdle;
  constexpr unsigned kCompared =
      reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask | reg::EOT::kMask;
  const std::string frame = " after frame " + std::to_string(applied_);
  expect((status[1] & kCompared) == expected, "status 0x" + to_bits(status[1], 8) + ", expected " +
                                                  to_bits(expected, 8) +
                                                  " in nERR, nAGSERR, nSCDERR, EOT" + frame);
  expect(status[2] == reference_.svalid_lo() && status[3] == reference_.svalid_hi(),
         "SVALID " + to_bits(status[3] * 256U + status[2], 16) + ", expected " +
             to_bits(reference_.svalid_hi() * 256U + reference_.svalid_lo(), 16) + frame);
  expect(session_.read(reg::kAddrSwbankfail, 1)[0] == (reference_.swbank_fail() ? 1 : 0),
         "SWBANKFAIL" + frame);
  std::vector<std::uint8_t> tx(65, 0);
  tx[0] = reg::kSpiOpcodeReadRegisters0;
  const auto memory = session_.spi(tx);
  for (unsigned address = 0; address < 64; ++address) {
    expect(memory[address + 1] == reference_.scdata(address),
           "SCDATA address " + std::to_string(address) + ": " +
               std::to_string(memory[address + 1]) + ", expected " +
               std::to_string(reference_.scdata(address)) + frame);
  }
}

// A byte that the host has written to SCDATA.
void RandomRun::written(unsigned address, std::uint8_t value) {
  if (((case_.channels >> address / 8U) & 1U) != 0) reference_.write(address, value);
}

void RandomRun::fill_bank() {
  std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters0};
  for (unsigned address = 0; address < 64; ++address) {
    const auto value = static_cast<std::uint8_t>(random_.below(256));
    tx.push_back(value);
    written(address, value);
  }
  session_.spi(tx);
  session_.wait_ns(1000);
}

void RandomRun::configure() {
  session_.wait_ns(10'000);  // the memories are cleared
  session_.write(reg::slave_cfg_address(1),
                 {case_.registers.slave.begin(), case_.registers.slave.end()});
  session_.write(reg::kAddrChsel,
                 {case_.chsel,
                  static_cast<std::uint8_t>(reg::kRegversBissC | (case_.en_mo ? 2 : 0) |
                                            (case_.hold_cdm ? 1 : 0)),
                  static_cast<std::uint8_t>(reg::FREQR::of(5) | case_.freqs),
                  static_cast<std::uint8_t>((case_.registers.nocrc ? 2 : 0) |
                                            (case_.registers.singlebank ? 1 : 0)),
                  reg::kFreqagsAgsMin, case_.mo_busy});
  session_.write(reg::kAddrSlaveloc5,
                 {static_cast<std::uint8_t>(case_.registers.slaveloc5
                                                ? reg::kResetSlaveloc5 | reg::kSlaveloc5Split
                                                : reg::kResetSlaveloc5),
                  case_.cfgch, 0x00, case_.registers.actnsens});
  // Fills both banks, because bytes that no frame writes must keep their values.
  fill_bank();
  toggle_swbank();
  fill_bank();
}

// One frame by INSTR, with HOLDBANK or without.
void RandomRun::instr_frame(unsigned hold) {
  set_freqags(reg::kFreqagsAgsMin);
  const unsigned instr =
      1 + random_.below(case_.late_cds ? 2 : 3);  // CDM = 1, CDM = 0, CDM = NOT CDSSEL = 1
  const auto before = frames_seen();
  const sim::Time start = session_.simulator().now();
  reference_.hold(hold != 0);
  session_.instruct(swbank_ | hold | instr << 1U);
  wait_idle();
  frame_ns_ = std::max(frame_ns_, (session_.simulator().now() - start) / sim::kPsPerNs);
  expect(frames_seen() == before + 1, "INSTR does not make one frame");
  take_frames(frames_seen());
  session_.wait_ns(frame_ns_ / 4);  // also the farthest slave has ended
  // Table 23: the lines that CHSEL selects, line 1 without any.
  const unsigned lines = case_.chsel == 0 ? 1 : case_.chsel;
  for (const unsigned line : {0U, 1U}) {
    // BiSS B has no CDM.
    if (!case_.used[line] || case_.protocol(line) == mb4test::Protocol::kBissB) continue;
    const bool cdm = instr != 2 && ((lines >> line) & 1U) != 0;
    expect(clocked(session_.simulator().slave(line == 0 ? 1 : 5))->last_cdm() == cdm,
           "CDM of the frame");
  }
  const unsigned held = swbank_ | hold;
  expect(session_.read(reg::kAddrInstr, 1)[0] == held, "0xF4 after the frame");
}

unsigned RandomRun::rate_code() const {
  const std::uint64_t needed_ns = frame_ns_ + frame_ns_ / 4 + 2000;
  for (unsigned code = 0; code < 0x100; ++code) {
    if (code >= reg::kFreqagsAgsMin && code < 0x80) continue;
    if (period_ns(code) >= needed_ns) return code;
  }
  return reg::kFreqagsAgsMin;
}

// Table 37; a frame's own time for AGSMIN.
std::uint64_t RandomRun::period_ns(unsigned code) const {
  if (code == reg::kFreqagsAgsMin) return frame_ns_;
  const std::uint64_t clocks = code < 0x80 ? 20ULL * (code + 1) : 625ULL * (code - 127);
  return clocks * 1'000'000'000 / case_.f_clk_hz;
}

void RandomRun::pulse_getsens() {
  session_.pin(sim::Pin::kGetsens, "GETSENS", true);
  session_.wait_ns(100);
  session_.pin(sim::Pin::kGetsens, "GETSENS", false);
  wait_idle();
  session_.wait_ns(frame_ns_ / 4);
}

void RandomRun::automatic(RandomCounts::Action action) {
  const unsigned instr = random_.below(case_.late_cds ? 3 : 4);
  const unsigned code = action == RandomCounts::kRate     ? rate_code()
                        : action == RandomCounts::kAgsMin ? reg::kFreqagsAgsMin
                                                          : reg::kFreqagsAgsInfinite;
  set_freqags(code);
  const auto before = frames_seen();
  const unsigned count = 2 + random_.below(3);
  if (action == RandomCounts::kGetsens) {
    session_.instruct(swbank_ | reg::AGS::kMask);  // with INSTR it would be one frame more
    session_.wait_ns(1000);  // AGS must have come to the core before the first pulse
    for (unsigned i = 0; i < count; ++i) pulse_getsens();
    session_.instruct(swbank_);
    wait_idle();
    expect(frames_seen() == before + count, "GETSENS pulses and frames are not the same number");
  } else {
    session_.instruct(swbank_ | reg::AGS::kMask | instr << 1U);
    session_.wait_ns(count * period_ns(code) + period_ns(code) / 2);
    session_.instruct(swbank_);
    wait_idle();
    const auto frames = frames_seen() - before;
    expect(frames >= count && (code == reg::kFreqagsAgsMin || frames <= count + 1),
           std::to_string(frames) + " frames in " + std::to_string(count) + " periods");
  }
  take_frames(frames_seen());
}

// HOLDBANK and a frame, perhaps another one that must not run or writes over the first, then the
// switch that was held back.
void RandomRun::held_frame() {
  instr_frame(reg::HOLDBANK::kMask);
  check();
  if (!case_.omits) {
    for (unsigned more = random_.below(3); more > 0; --more) {
      instr_frame(reg::HOLDBANK::kMask);
      check();
    }
  } else if (random_.one_in(2) && !case_.registers.singlebank) {
    const auto before = frames_seen();
    session_.instruct(swbank_ | reg::HOLDBANK::kMask | reg::kInstrCdm0);
    wait_idle();
    expect(frames_seen() == before, "a frame runs although the switch is held back");
    reference_.omitted_frame();
    check();
  }
  session_.instruct(swbank_);
  session_.wait_ns(1000);
  reference_.hold(false);
}

// HOLDBANK while frames come by themselves, with AGSERR_ON_HOLDBANK: one more frame whose switch
// waits, the next is left out.
void RandomRun::held_automatic() {
  const unsigned code = random_.one_in(2) ? reg::kFreqagsAgsMin : rate_code();
  set_freqags(code);
  session_.instruct(swbank_ | reg::AGS::kMask);
  session_.wait_ns(period_ns(code) * (8 + random_.below(16)) / 8);
  session_.instruct(swbank_ | reg::AGS::kMask | reg::HOLDBANK::kMask);
  session_.wait_ns(4 * std::max(period_ns(code), frame_ns_) + 2000);
  if (!case_.registers.singlebank) {
    const auto seen = frames_seen();
    take_frames(seen - 1);
    reference_.hold(true);
    take_frames(seen);
    reference_.omitted_frame();
    check();
  }
  session_.instruct(swbank_);
  wait_idle();
  reference_.hold(false);
  take_frames(frames_seen());
}

void RandomRun::toggle_swbank() {
  swbank_ ^= 0x20;
  session_.instruct(swbank_);
  session_.wait_ns(1000);
  reference_.swap_banks();
}

void RandomRun::write_scdata() {
  const unsigned address = random_.below(64);
  const unsigned count = 1 + random_.below(std::min(16U, 64 - address));
  std::vector<std::uint8_t> bytes;
  for (unsigned i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(random_.below(256)));
    written(address + i, bytes.back());
  }
  session_.write(static_cast<std::uint8_t>(address), bytes);
  session_.wait_ns(1000);
}

void RandomRun::write_svalid() {
  const auto value = static_cast<std::uint16_t>(random_.word());
  session_.write(reg::kAddrSvalidLo,
                 {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8U)});
  session_.wait_ns(1000);
  reference_.write_svalid(value);
}

void RandomRun::break_if_error() {
  if (!reference_.ags_error()) return;
  session_.instruct(swbank_ | reg::BREAK::kMask);
  session_.wait_ns(1000);
  reference_.clear_errors();
  check();
}

void RandomRun::run(RandomCounts& counts) {
  configure();
  check();
  instr_frame(0);
  check();
  const unsigned actions = 3 + random_.below(5);
  for (unsigned i = 0; i < actions; ++i) {
    const auto action = static_cast<RandomCounts::Action>(random_.below(9));
    ++counts_.actions[action];
    switch (action) {
      case RandomCounts::kInstr:
        instr_frame(0);
        break;
      case RandomCounts::kRate:
      case RandomCounts::kAgsMin:
      case RandomCounts::kGetsens:
        automatic(action);
        break;
      case RandomCounts::kHold:
        held_frame();
        break;
      case RandomCounts::kAgsHold:
        if (case_.omits) {
          held_automatic();
        } else {
          held_frame();
        }
        break;
      case RandomCounts::kSwBank:
        toggle_swbank();
        break;
      case RandomCounts::kWrite:
        write_scdata();
        break;
      case RandomCounts::kSvalid:
        write_svalid();
        break;
    }
    check();
    break_if_error();
  }
  counts.frames += counts_.frames;
  counts.words += counts_.words;
  counts.faulty_words += counts_.faulty_words;
  counts.undetected += counts_.undetected;
  for (std::size_t i = 0; i < counts.actions.size(); ++i) counts.actions[i] += counts_.actions[i];
}

}  // namespace mb4test
