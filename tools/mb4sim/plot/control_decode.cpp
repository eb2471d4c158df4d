// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/control_decode.hpp"

#include <fmt/core.h>

#include <optional>

#include "sim/lines/crc.hpp"

namespace mb4::tool {
namespace {

constexpr std::size_t kZerosBefore = 14;
constexpr std::size_t kHeaderCrc = 12;
constexpr std::size_t kHeaderEnd = 16;
constexpr unsigned kCrcBits = 4;
constexpr sim::Crc kControlCrc{0x13, 0};

class ControlDecoder {
 public:
  ControlDecoder(const std::vector<ControlBits>& bits, std::size_t start) : bits_(bits) {
    frame_.start = start;
  }

  ControlFrame run() {
    header();
    if (frame_.good) frame_.complete = cdm(1) ? registers() : command();
    frame_.good = frame_.good && frame_.complete;
    return frame_;
  }

 private:
  bool there(std::size_t slot) const { return frame_.start + slot < bits_.size(); }
  bool cdm(std::size_t slot) const { return there(slot) && bits_[frame_.start + slot].cdm; }
  bool cds(std::size_t slot) const { return there(slot) && bits_[frame_.start + slot].cds; }

  template <typename Row>
  unsigned number(Row row, std::size_t slot, unsigned bits) const {
    unsigned value = 0;
    for (unsigned i = 0; i < bits; ++i) value = (value << 1U) | ((this->*row)(slot + i) ? 1U : 0U);
    return value;
  }
  unsigned cdm_number(std::size_t slot, unsigned bits) const {
    return number(&ControlDecoder::cdm, slot, bits);
  }
  unsigned cds_number(std::size_t slot, unsigned bits) const {
    return number(&ControlDecoder::cds, slot, bits);
  }

  void reach(std::size_t to) { frame_.slots = std::max(frame_.slots, to); }
  void master(std::size_t from, std::size_t to, FieldKind kind, std::vector<std::string> labels,
              bool bad = false) {
    frame_.cdm.push_back({from, to, kind, std::move(labels), bad});
    frame_.good = frame_.good && !bad;
    reach(to);
  }
  void slave(std::size_t from, std::size_t to, FieldKind kind, std::vector<std::string> labels,
             bool bad = false) {
    frame_.cds.push_back({from, to, kind, std::move(labels), bad});
    frame_.good = frame_.good && !bad;
    reach(to);
  }

  // Checks the four CRC bits after `bits` bits of data; true if they are right.
  static bool fits(unsigned data, unsigned bits, unsigned line) {
    return kControlCrc.line_bits(data, bits) == line;
  }
  std::vector<std::string> crc_labels(unsigned data, unsigned bits, unsigned line) {
    const std::string got = fmt::format("CRC 0x{:X}", ~line & 0xFU);
    if (fits(data, bits, line)) return {got + " good", got, "CRC"};
    const std::vector<std::string> labels =
        wrong_crc(~line & 0xFU, ~kControlCrc.line_bits(data, bits) & 0xFU, kCrcBits);
    frame_.mistakes += (frame_.mistakes.empty() ? "" : "; ") + labels.front();
    return labels;
  }

  void header() {
    frame_.good = there(kHeaderEnd - 1);
    if (!frame_.good) return;
    master(0, 1, FieldKind::kFraming, {"S"});
    master(1, 2, FieldKind::kControl, {"CTS"});
    if (cdm(1)) {
      master(2, 5, FieldKind::kData, {fmt::format("ID {}", cdm_number(2, 3))});
      master(5, kHeaderCrc, FieldKind::kData,
             {fmt::format("address 0x{:02X}", cdm_number(5, 7)),
              fmt::format("0x{:02X}", cdm_number(5, 7))});
    } else {
      const unsigned ids = cdm_number(2, 8);
      master(2, 10, FieldKind::kData, {"IDS: " + ids_text(ids, "all")});
      master(10, kHeaderCrc, FieldKind::kData,
             {fmt::format("CMD {}", cdm_number(10, 2)), fmt::format("{:02b}", cdm_number(10, 2))});
    }
    const unsigned line = cdm_number(kHeaderCrc, kCrcBits);
    const unsigned head = cdm_number(1, 11);
    master(kHeaderCrc, kHeaderEnd, FieldKind::kCrc, crc_labels(head, 11, line),
           !fits(head, 11, line));
    const unsigned locked = cds_number(1, 8);
    slave(1, 9, FieldKind::kControl, {"IDL: " + ids_text(locked, "none"), "IDL"});
  }

  // Bit 7 is ID 0: "ID 3", "IDs 0,1".
  static std::string ids_text(unsigned bits, const char* none) {
    std::string list;
    for (unsigned id = 0; id < 8; ++id) {
      if (((bits >> (7 - id)) & 1U) != 0) list += fmt::format("{}{}", list.empty() ? "" : ",", id);
    }
    if (list.empty()) return none;
    return (list.size() > 1 ? "IDs " : "ID ") + list;
  }

  bool registers() {
    const bool read = cdm(16);
    const bool write = cdm(17);
    frame_.text = fmt::format("{} ID {}, 0x{:02X}:", read ? "read" : "write", cdm_number(2, 3),
                              cdm_number(5, 7));
    master(16, 17, FieldKind::kControl, {"R"}, read == write);
    master(17, 18, FieldKind::kControl, {"W"});
    if (!there(18)) return false;
    slave(17, 18, FieldKind::kControl, {"R"}, cds(17) != read);
    slave(18, 19, FieldKind::kControl, {"W"}, cds(18) != write);
    if (!frame_.good) {
      frame_.text += " not confirmed";
      return false;
    }
    std::size_t at = 18;
    while (cdm(at)) {
      if (!data(at, read)) return false;
      // After the stop bit comes the next S or the end.
    }
    return true;
  }

  // Decodes one byte. `at` is the slot of its S on CDM; it moves to the slot of the next S.
  bool data(std::size_t& at, bool read) {
    std::size_t answer = at + 1;
    while (there(answer) && !cds(answer)) ++answer;
    if (!there(answer + 13)) {
      frame_.text += " no answer";
      reach(answer);
      return false;
    }
    master(at, answer, FieldKind::kFraming, {answer - at > 1 ? "S, slave is busy" : "S", "S"});
    if (answer - at > 1) slave(at + 1, answer, FieldKind::kRest, {"busy"});
    slave(answer, answer + 1, FieldKind::kFraming, {"S"});
    const unsigned sent = cdm_number(answer, 8);
    const unsigned sent_crc = cdm_number(answer + 8, kCrcBits);
    const unsigned got = cds_number(answer + 1, 8);
    const unsigned got_crc = cds_number(answer + 9, kCrcBits);
    const std::string value = fmt::format("0x{:02X}", read ? got : sent);
    if (read) {
      master(answer, answer + 12, FieldKind::kRest, {"0"}, sent != 0 || sent_crc != 0);
      slave(answer + 1, answer + 9, FieldKind::kData, {"data " + value});
      slave(answer + 9, answer + 13, FieldKind::kCrc, crc_labels(got, 8, got_crc),
            !fits(got, 8, got_crc));
    } else {
      master(answer, answer + 8, FieldKind::kData, {"data " + value});
      master(answer + 8, answer + 12, FieldKind::kCrc, crc_labels(sent, 8, sent_crc),
             !fits(sent, 8, sent_crc));
      slave(answer + 1, answer + 9, FieldKind::kData, {fmt::format("echo 0x{:02X}", got)},
            got != sent);
      const bool same = got_crc == sent_crc;
      slave(answer + 9, answer + 13, FieldKind::kCrc,
            {same ? "echo of CRC"
                  : fmt::format("echo 0x{:X}, not 0x{:X}", ~got_crc & 0xFU, ~sent_crc & 0xFU),
             "CRC"},
            !same);
    }
    master(answer + 12, answer + 13, FieldKind::kFraming, {"P"}, cdm(answer + 12));
    slave(answer + 13, answer + 14, FieldKind::kFraming, {"P"}, cds(answer + 13));
    frame_.text += " " + value;
    at = answer + 13;
    return frame_.good;
  }

  bool command() {
    const unsigned ids = cdm_number(2, 8);
    const bool tested = !cdm(16);
    const std::size_t ex = tested ? 24 : 16;
    frame_.text = fmt::format("command {} to {}{}", cdm_number(10, 2), ids_text(ids, "all"),
                              tested ? ", acknowledge tested" : "");
    if (!there(ex + 1)) return false;
    if (tested) master(16, 24, FieldKind::kRest, {"0"});
    master(ex, ex + 1, FieldKind::kControl, {"EX"});
    master(ex + 1, ex + 2, FieldKind::kFraming, {"P"}, cdm(ex + 1));
    if (ids != 0 && there(24)) {
      const unsigned got = cds_number(17, 8);
      slave(17, 25, FieldKind::kControl, {"IDA: " + ids_text(got, "none"), "IDA"}, got != ids);
    }
    if (!cdm(ex)) frame_.text += ", not executed";
    return true;
  }

  const std::vector<ControlBits>& bits_;
  ControlFrame frame_;
};

}  // namespace

ControlFrame decode_control(const std::vector<ControlBits>& bits, std::size_t from) {
  std::size_t zeros = 0;
  for (std::size_t i = from; i < bits.size(); ++i) {
    if (!bits[i].cdm) {
      ++zeros;
      continue;
    }
    if (zeros >= kZerosBefore) return ControlDecoder(bits, i).run();
    zeros = 0;
  }
  return {};
}

}  // namespace mb4::tool
