// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mb4::tool {

SlaveOutcome::Kind SessionFrame::kind(std::size_t index) const {
  const std::optional<Word>& word = results[index].word;
  if (!word) return SlaveOutcome::Kind::kFlagged;
  return sent[index] && *sent[index] != word->bits ? SlaveOutcome::Kind::kWrong
                                                   : SlaveOutcome::Kind::kRight;
}

bool SessionFrame::bad() const {
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (kind(i) != SlaveOutcome::Kind::kRight) return true;
  }
  return false;
}

std::vector<SlaveOutcome> SessionFrame::outcomes(const std::vector<ConnectedSlave>& slaves) const {
  std::vector<SlaveOutcome> list;
  for (std::size_t i = 0; i < results.size(); ++i) {
    SlaveOutcome outcome;
    outcome.slave = slaves[i].number;
    outcome.channel = slaves[i].channel;
    outcome.kind = kind(i);
    outcome.state = results[i].error;
    if (outcome.kind == SlaveOutcome::Kind::kWrong) outcome.state = "wrong data";
    list.push_back(std::move(outcome));
  }
  return list;
}

std::span<const WordColumn> all_word_columns() {
  static constexpr WordColumn kColumns[] = {
      {"raw", "raw", 18, false,
       [](const Word& word) {
         return fmt::format("0x{:0{}X}", word.bits, (word.data_bits + 3) / 4);
       }},
      {"position", "position", 20, true,
       [](const Word& word) {
         return fmt::format("{}", word.flag_bits >= 64 ? 0 : word.bits >> word.flag_bits);
       }},
      {"nE", "nE", 2, true,
       [](const Word& word) {
         return word.n_error ? fmt::format("{:d}", *word.n_error) : std::string();
       }},
      {"nW", "nW", 2, true,
       [](const Word& word) {
         return word.n_warning ? fmt::format("{:d}", *word.n_warning) : std::string();
       }},
      {"crc", "CRC", 6, false, [](const Word& word) {
         return word.crc ? fmt::format("0x{:02X}", *word.crc) : std::string();
       }}};
  return kColumns;
}

std::uint32_t RegisterMap::Field::value() const {
  return static_cast<std::uint32_t>(word >> lsb & ((std::uint64_t{1} << width) - 1U));
}

Session::Session(const sim::Scenario& scenario, const SessionOptions& options)
    : simulator_(scenario, options.simulator),
      slaves_(connected_slaves(simulator_.scenario())),
      logged_(options.bus_log) {
  if (options.actuators) return;
  std::erase_if(slaves_,
                [](const ConnectedSlave& slave) { return slave.config->traits().actuator; });
}

RegisterMap Session::registers() { return {}; }

std::string Session::access(const ControlRequest& /*request*/) {
  return "the master cannot access registers of slaves";
}

std::string Session::send(const std::string& /*line*/) { return "this master takes no SPI frames"; }

void Session::wait_for_begin() {
  const sim::Time frame = simulator_.scenario().host.frame;
  if (frame == 0) return;
  if (next_begin_ > simulator_.now()) simulator_.run_until(next_begin_);
  next_begin_ = simulator_.now() + frame;
}

RunSummary Session::summary() const {
  return {simulator_.now(), simulator_.clk_cycles(), simulator_.seed()};
}

}  // namespace mb4::tool
