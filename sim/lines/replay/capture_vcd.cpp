// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// VCD files: IEEE 1364, chapter 18.
#include <algorithm>
#include <optional>

#include "sim/core/number_text.hpp"
#include "sim/lines/replay/capture.hpp"

namespace mb4::sim {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

class VcdFile {
 public:
  VcdFile(std::string_view text, const std::string& name, const CaptureNames& signals)
      : text_(text), name_(name), tracked_{{signals.ma, {}, {}}, {signals.sl, {}, {}}} {}

  Capture parse() {
    header();
    changes();
    return {std::move(tracked_[0].signal), std::move(tracked_[1].signal), now_};
  }

 private:
  struct Tracked {
    std::string name;
    std::string id;
    CaptureSignal signal;
    bool known = false;
  };
  struct Variable {
    std::string id;
    std::string full_name;  // with its scopes
    bool one_bit;
    std::size_t line;
  };

  [[noreturn]] void fail(const std::string& message) const { fail_at_line(name_, line_, message); }

  // The next word, or nothing at the end. line_ is its line.
  std::string_view word() {
    while (at_ < text_.size() && kSpace.find(text_[at_]) != std::string_view::npos) {
      next_line_ += text_[at_++] == '\n' ? 1 : 0;
    }
    line_ = next_line_;
    const std::size_t end = std::min(text_.find_first_of(kSpace, at_), text_.size());
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end;
    return found;
  }

  // The words up to $end.
  std::vector<std::string_view> section(std::string_view keyword) {
    std::vector<std::string_view> words;
    for (;;) {
      const std::string_view next = word();
      if (next.empty()) fail("expected $end after " + std::string(keyword) + ", the file ends");
      if (next == "$end") return words;
      words.push_back(next);
    }
  }

  void timescale(const std::vector<std::string_view>& words) {
    std::string text;
    for (const std::string_view part : words) text += part;
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    const auto count = parse_word(text.substr(0, digits));
    const std::string unit = text.substr(digits);
    constexpr std::string_view kUnits[] = {"ps", "ns", "us", "ms", "s"};
    step_ = 1;
    for (const std::string_view known : kUnits) {
      if (unit == known && count && (*count == 1 || *count == 10 || *count == 100)) {
        step_ *= *count;
        return;
      }
      step_ *= 1000;
    }
    if (unit == "fs" && count) {
      femto_ = *count;
      return;
    }
    fail("expected $timescale of 1, 10 or 100 fs, ps, ns, us, ms or s, found '" + text + "'");
  }

  void header() {
    std::vector<std::string> scopes;
    for (;;) {
      const std::string_view keyword = word();
      if (keyword.empty()) fail("expected $enddefinitions, the file ends: is it a VCD file?");
      if (!keyword.starts_with('$')) {
        fail("expected a keyword such as $timescale, found '" + std::string(keyword.substr(0, 20)) +
             "': is it a VCD file?");
      }
      const auto words = section(keyword);
      if (keyword == "$enddefinitions") break;
      if (keyword == "$timescale") timescale(words);
      if (keyword == "$scope" && words.size() == 2) scopes.emplace_back(words[1]);
      if (keyword == "$upscope" && !scopes.empty()) scopes.pop_back();
      if (keyword == "$var") {
        if (words.size() < 4) fail("expected $var TYPE BITS ID NAME $end");
        std::string full;
        for (const std::string& scope : scopes) full += scope + ".";
        variables_.push_back(
            {std::string(words[2]), full + std::string(words[3]), words[1] == "1", line_});
      }
    }
    if (step_ == 0 && femto_ == 0) fail("expected $timescale before $enddefinitions");
    for (Tracked& tracked : tracked_) tracked.id = find(tracked.name);
  }

  std::string find(const std::string& name) const {
    std::vector<std::string> all;
    std::vector<const Variable*> found;
    for (const Variable& variable : variables_) {
      all.push_back(variable.full_name);
      if (variable.full_name == name || variable.full_name.ends_with("." + name)) {
        if (std::none_of(found.begin(), found.end(),
                         [&](auto* other) { return other->id == variable.id; })) {
          found.push_back(&variable);
        }
      }
    }
    if (found.empty()) fail("expected a signal '" + name + "', the file has " + quoted(all));
    if (found.size() > 1) {
      fail("expected one signal '" + name + "', found '" + found[0]->full_name + "' and '" +
           found[1]->full_name + "': name it with its scopes");
    }
    if (!found[0]->one_bit)
      fail_at_line(name_, found[0]->line, "expected '" + name + "' to have 1 bit");
    return found[0]->id;
  }

  void stamp(std::string_view digits) {
    const auto time = parse_word(digits);
    if (!time) fail("expected a time after #, found '" + std::string(digits) + "'");
    // Longer than 106 days is no time of the simulator.
    if (femto_ == 0 && *time > kEndOfTime / step_) fail("expected a time below 2^63 ps");
    const Time ps =
        femto_ != 0 ? *time / 1000 * femto_ + *time % 1000 * femto_ / 1000 : *time * step_;
    if (begun_ && ps < begin_ + now_) fail("expected a time after that of the line before");
    if (!begun_) begin_ = ps;
    begun_ = true;
    now_ = ps - begin_;
  }

  // `level` is 0, 1, x, z or a state of VHDL.
  void change(char level, std::string_view id) {
    for (Tracked& tracked : tracked_) {
      if (id != tracked.id) continue;
      const bool high = level == '1' || level == 'h' || level == 'H';
      if (!high && level != '0' && level != 'l' && level != 'L') {
        if (tracked.known) {
          fail("expected 0 or 1 of '" + tracked.name + "', found '" + level + "'");
        }
        continue;  // before the first level
      }
      if (!tracked.known) tracked.signal.first = high;
      tracked.known = true;
      tracked.signal.set(now_, high);
    }
  }

  void changes() {
    for (;;) {
      const std::string_view next = word();
      if (next.empty()) break;
      if (next.front() == '#') {
        stamp(next.substr(1));
      } else if (next == "$comment") {
        section(next);
      } else if (next.front() == '$') {
        // $dumpvars, $dumpall, $dumpon, $dumpoff and their $end hold changes.
      } else if (std::string_view("bBrRsS").find(next.front()) != std::string_view::npos) {
        const std::string_view id = word();
        if (id.empty())
          fail("expected the signal of '" + std::string(next.substr(0, 20)) + "', the file ends");
        change(next.back(), id);
      } else if (std::string_view("01xXzZuUwWlLhH-").find(next.front()) != std::string_view::npos &&
                 next.size() > 1) {
        change(next.front(), next.substr(1));
      } else {
        fail("expected a change or a time, found '" + std::string(next.substr(0, 20)) + "'");
      }
    }
    if (!begun_) fail("expected times and changes, the file ends");
    for (const Tracked& tracked : tracked_) {
      if (!tracked.known) fail("expected a level of '" + tracked.name + "', the file ends");
    }
  }

  std::string_view text_;
  const std::string& name_;
  Tracked tracked_[2];
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t next_line_ = 1;
  std::vector<Variable> variables_;
  Time step_ = 0;   // ps of a unit of time
  Time femto_ = 0;  // fs of it, if it is shorter than a picosecond
  Time begin_ = 0;
  bool begun_ = false;
  Time now_ = 0;
};

}  // namespace

Capture parse_vcd(std::string_view text, const std::string& name, const CaptureNames& signals) {
  return VcdFile(text, name, signals).parse();
}

}  // namespace mb4::sim
