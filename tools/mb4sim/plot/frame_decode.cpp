// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/frame_decode.hpp"

#include <fmt/core.h>

namespace mb4::tool {
namespace {

class FrameDecoder {
 public:
  FrameDecoder(const LineRecording& recording, const FrameTrace& trace,
               const sim::ChannelConfig& channel)
      : sl_(recording.sl()), channel_(channel) {
    frame_.trace = trace;
    period_ = trace.period();
  }

  DecodedFrame run() {
    const bool ssi = !channel_.protocol().start_bit;
    if (frame_.trace.rising.size() < 2) return frame_;
    if (ssi ? begin_ssi() : begin_biss()) {
      frame_.good = true;
      for (std::size_t i = 0; i < channel_.slaves.size(); ++i) word(channel_.slaves[i], i);
      frame_.complete = true;
    }
    add_rest(ssi);
    return frame_;
  }

 private:
  sim::Time bit_at(unsigned index) const { return first_ + index * period_; }

  // The level in the middle of bit `index`.
  bool level(unsigned index) const { return sl_.at(bit_at(index) + period_ / 2); }

  void field(unsigned bits, FieldKind kind, std::vector<std::string> labels, bool bad = false) {
    frame_.sl.push_back({bit_at(next_), bit_at(next_ + bits), kind, std::move(labels), bad});
    for (unsigned i = 0; i < bits; ++i) frame_.bits.push_back(bit_at(next_ + i));
    next_ += bits;
  }

  std::uint64_t peek(unsigned bits) const {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < bits; ++i) value = (value << 1U) | (level(next_ + i) ? 1U : 0U);
    return value;
  }

  // The first bit of SSI comes with the first rising edge.
  bool begin_ssi() {
    first_ = frame_.trace.rising[0];
    // Every edge of the response gives the same delay, so the first one is used. Without a response
    // the delay is not known.
    for (const Edge& edge : sl_.edges) {
      if (edge.time < first_ || edge.time >= frame_.trace.clock_end) continue;
      frame_.delay = (edge.time - first_) % period_;
      break;
    }
    first_ += frame_.delay;
    return true;
  }

  // Acknowledge, start bit and, in BiSS C, CDS. False: there was no answer.
  bool begin_biss() {
    sim::Time ack = 0;
    for (const Edge& edge : sl_.edges) {
      if (edge.time >= frame_.trace.rising[1] && edge.time < frame_.trace.end && !edge.level) {
        ack = edge.time;
        break;
      }
    }
    if (ack == 0) return false;
    frame_.delay = ack - frame_.trace.rising[1];
    first_ = ack;
    unsigned low = 1;
    while (!level(low)) {
      if (bit_at(++low) >= frame_.trace.end) return false;
    }
    field(low, FieldKind::kFraming,
          low > 1 ? std::vector<std::string>{fmt::format("Ack, processing {} T_MA", low - 1), "Ack"}
                  : std::vector<std::string>{"Ack"});
    field(1, FieldKind::kFraming, {"start"});
    if (channel_.protocol().control) {
      frame_.cds = level(next_);
      field(1, FieldKind::kControl, {"CDS"});
    }
    return true;
  }

  void word(const sim::SlaveConfig& slave, std::size_t index) {
    const std::string who = channel_.slaves.size() > 1 ? fmt::format("{}: ", index + 1) : "";
    const sim::DeviceTraits traits = slave.traits();
    if (traits.actuator && traits.stop_bit) {
      field(1, FieldKind::kFraming, {"stop"});
    }
    const unsigned data_bits = slave.data_bits();
    const unsigned flag_bits = slave.flag_bits();
    const std::uint64_t raw = peek(data_bits);
    frame_.words.push_back(raw);
    const char* const what = traits.actuator ? "data" : "position";
    const std::string value = fmt::format("0x{:0{}X}", flag_bits < 64 ? raw >> flag_bits : 0,
                                          (data_bits - flag_bits + 3) / 4);
    if (traits.gray) {
      // Binary: each bit is the parity of the Gray bits from the MSB to it.
      std::uint64_t binary = flag_bits < 64 ? raw >> flag_bits : 0;
      for (unsigned shift = 1; shift < 64; shift *= 2) binary ^= binary >> shift;
      field(data_bits - flag_bits, FieldKind::kData,
            {fmt::format("Gray code {} = 0x{:0{}X} ({} bits)", value, binary,
                         (data_bits - flag_bits + 3) / 4, data_bits - flag_bits),
             fmt::format("Gray code {}", value), value});
    } else if (data_bits > flag_bits) {
      field(data_bits - flag_bits, FieldKind::kData,
            {fmt::format("{}{} {} ({} bits)", who, what, value, data_bits - flag_bits),
             fmt::format("{}{} {}", who, what, value), who + value, value});
    }
    for (unsigned i = flag_bits; i-- > 0;) {
      const bool named = flag_bits == 2 && channel_.protocol().start_bit;
      field(1, FieldKind::kFlag, {named ? (i == 1 ? "nE" : "nW") : fmt::format("f{}", i)});
    }
    const sim::Crc& crc = slave.crc();
    if (crc.width() == 0) return;
    const auto line = static_cast<std::uint32_t>(peek(crc.width()));
    const std::uint32_t mask = (1U << crc.width()) - 1;
    const std::uint32_t right = crc.line_bits(raw, data_bits);
    if (line != right) {
      frame_.good = false;
      std::vector<std::string> labels = wrong_crc(~line & mask, ~right & mask, crc.width());
      labels.insert(labels.begin(), who + labels.front());
      frame_.mistakes += (frame_.mistakes.empty() ? "" : "; ") + labels.front();
      field(crc.width(), FieldKind::kCrc, labels, true);
      return;
    }
    const std::string good = fmt::format("CRC 0x{:0{}X}", ~line & mask, (crc.width() + 3) / 4);
    field(crc.width(), FieldKind::kCrc, {who + good + " good", good, "CRC"});
  }

  // The time until SL is 1 again. It begins at the last edge of MA at the slave; the monoflop's
  // time begins at the last falling edge. The master sees its end half a delay later.
  void add_rest(bool ssi) {
    const sim::Time edge = ssi ? frame_.trace.last_falling : frame_.trace.clock_end;
    const sim::Time begun = edge + frame_.delay;
    const std::string us =
        fmt::format("{:.3g} us", sim::to_us(frame_.trace.end - std::min(frame_.trace.end, begun)));
    const auto rest = [&](const char* what, sim::Time from, sim::Time to) {
      return Field{from, to, FieldKind::kRest, {fmt::format("{} {}", what, us), what}, false};
    };
    if (ssi) {
      // The last bit has not ended on SL. The field is drawn below MA, without the delay.
      if (frame_.trace.end > begun) {
        frame_.ma.push_back(rest("monoflop", edge, frame_.trace.end - frame_.delay));
      }
      return;
    }
    const sim::Time from = frame_.sl.empty() ? edge : bit_at(next_);
    if (frame_.trace.end > std::max(from, edge)) {
      frame_.sl.push_back(rest("timeout", from, frame_.trace.end));
    }
    if (!channel_.protocol().control) return;
    frame_.cdm = !frame_.trace.rest;
    frame_.ma.push_back(
        {frame_.trace.clock_end,
         frame_.trace.end,
         FieldKind::kControl,
         {fmt::format("CDM = {}", frame_.cdm ? 1 : 0), fmt::format("CDM {}", frame_.cdm ? 1 : 0)},
         false});
  }

  const Wave& sl_;
  const sim::ChannelConfig& channel_;
  DecodedFrame frame_;
  sim::Time period_ = 0;
  sim::Time first_ = 0;  // where bit 0 begins on SL
  unsigned next_ = 0;
};

}  // namespace

std::vector<std::string> wrong_crc(std::uint32_t got, std::uint32_t right, unsigned bits) {
  const unsigned digits = (bits + 3) / 4;
  const std::string a = fmt::format("0x{:0{}X}", got, digits);
  const std::string b = fmt::format("0x{:0{}X}", right, digits);
  return {fmt::format("CRC {} wrong, {} right", a, b), fmt::format("{} wrong, {} right", a, b),
          fmt::format("{}, not {}", a, b), fmt::format("{}/{}", a, b), "CRC"};
}

DecodedFrame decode_frame(const LineRecording& recording, const FrameTrace& trace,
                          const sim::ChannelConfig& channel) {
  return FrameDecoder(recording, trace, channel).run();
}

}  // namespace mb4::tool
