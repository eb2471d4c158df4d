// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A master made of MA edges only: one CDM bit out and one CDS bit in per frame, and control frames
// from texts of '0' and '1'. It shares no code with the chip, and no CRC with the slaves.
#ifndef TESTS_UNIT_LINES_REGISTERS_CONTROL_BENCH_HPP_
#define TESTS_UNIT_LINES_REGISTERS_CONTROL_BENCH_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/lines/clocked/chain_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

// CRC4 of x^4 + x + 1 over a text of bits, as it goes over the line (inverted).
inline std::string crc4(const std::string& bits) {
  // By polynomial division of the bits and four zeros, most significant bit first.
  std::string rest = bits + "0000";
  for (std::size_t i = 0; i + 4 < rest.size(); ++i) {
    if (rest[i] == '0') continue;
    for (const std::size_t term : {0U, 3U, 4U}) rest[i + term] ^= 1;  // '0' <-> '1'
  }
  std::string crc = rest.substr(rest.size() - 4);
  for (char& bit : crc) bit ^= 1;
  return crc;
}

// S, CTS, ID, address and their CRC.
inline std::string access_header(unsigned id, unsigned address) {
  const std::string header = std::string("1") + binary(id, 3) + binary(address, 7);
  return std::string("1") + header + crc4(header);
}
// S, CTS, IDS (bit 7 = ID 0), CMD and their CRC.
inline std::string command_header(unsigned ids, unsigned code) {
  const std::string header = std::string("0") + binary(ids, 8) + binary(code, 2);
  return std::string("1") + header + crc4(header);
}
inline std::string data_with_crc(unsigned byte) { return binary(byte, 8) + crc4(binary(byte, 8)); }

// S and the 32 bits after it.
inline std::string start_and(std::uint32_t frame) {
  return std::string(1, '1').append(binary(frame, 32));
}

class ControlBench : public ChainBench {
 public:
  static constexpr Time kPeriod = 200 * kPsPerNs;

  BissCSlave& add(const BissCSlaveConfig& config) {
    BissCSlave& slave = ChainBench::add(config);
    line_bits_ += config.data_bits + config.crc.width();
    return slave;
  }
  BissCSlave& add_slave() { return add(constant_slave(8, 0xA7, 0x43)); }

  // One frame that ends with `cdm`; returns its CDS.
  bool exchange(bool cdm) {
    const Time start = now + kPeriod;
    if (!chain.ma()) ma(now + kPeriod / 2, true);  // HOLDCDM: MA rises just before the next frame
    last_frame = frame(start, kPeriod, line_bits_ + 5, !cdm);
    run_until(now + 4 * kPeriod);
    if (cdm && !hold_cdm) ma(now, true);
    return last_frame[3] == '1';
  }
  // A frame for each bit; returns their CDS bits.
  std::string send(const std::string& cdm) {
    std::string cds;
    for (const char bit : cdm) cds += exchange(bit == '1') ? '1' : '0';
    return cds;
  }
  void zeros(unsigned count = 14) { send(std::string(count, '0')); }

  // CDM up to the slave's S: repeats S while the slave is busy; false after `limit` frames. The S
  // of the slave comes with the frame that carries `first_of_data`, the bit after S.
  bool wait_for_start(bool first_of_data, unsigned limit) {
    exchange(true);  // S
    for (unsigned i = 0; i < limit; ++i) {
      // CDS comes before CDM in a frame, so the CDM can depend on it.
      if (exchange_after_cds([&](bool cds) { return cds ? first_of_data : true; })) return true;
    }
    return false;
  }
  // The CDM is chosen when the CDS of the same frame is known.
  template <typename Choose>
  bool exchange_after_cds(Choose choose) {
    const Time start = now + kPeriod;
    if (!chain.ma()) ma(now + kPeriod / 2, true);
    last_frame = frame(start, kPeriod, line_bits_ + 5, true);
    const bool cds = last_frame[3] == '1';
    const bool cdm = choose(cds);
    if (cdm) ma(now + kPeriod / 2, false);
    run_until(now + 4 * kPeriod);
    if (cdm && !hold_cdm) ma(now, true);
    return cds;
  }

  enum class Result { kOk, kNoEcho, kNoStart, kBadData };
  // Registers from `address` on; `data` says how many and takes what has been read.
  Result read(unsigned id, unsigned address, std::vector<std::uint8_t>& data) {
    return access(id, address, data, true);
  }
  Result write(unsigned id, unsigned address, std::vector<std::uint8_t> data) {
    return access(id, address, data, false);
  }
  // A command without test of IDA; returns the eight IDA bits.
  std::string command(unsigned ids, unsigned code) {
    zeros();
    send(command_header(ids, code) + "1");  // EX
    return send("00000000");
  }

  unsigned wait_limit = 20;
  bool hold_cdm = false;
  std::string last_frame;  // SLO after each rising edge
  std::string idl;         // of the last read() or write()

  // Bits of data and CRC that the master clocks: shorter after channels have been switched off.
  void set_line_bits(unsigned bits) { line_bits_ = bits; }

 private:
  Result access(unsigned id, unsigned address, std::vector<std::uint8_t>& data, bool reading) {
    zeros();
    const std::string head = send(access_header(id, address));
    idl = head.substr(1, 8);
    // R is answered in the frame of W, W in the frame of S.
    exchange(reading);
    if (exchange(!reading) != reading) return end(Result::kNoEcho);
    for (std::size_t i = 0; i < data.size(); ++i) {
      const std::string out = reading ? std::string(12, '0') : data_with_crc(data[i]);
      if (!wait_for_start(out[0] == '1', wait_limit)) return end(Result::kNoStart);
      // The rest of the bits and P; the CDS of P belongs to the next frame.
      const std::string in = send(out.substr(1) + "0");
      if (reading) {
        data[i] = static_cast<std::uint8_t>(std::stoul(in.substr(0, 8), nullptr, 2));
        if (in != data_with_crc(data[i])) return end(Result::kBadData);
      } else if (in != out) {
        return end(Result::kBadData);
      }
    }
    return end(Result::kOk);
  }
  Result end(Result result) {
    exchange(false);
    return result;
  }

  unsigned line_bits_ = 0;
};

}  // namespace mb4test

#endif  // TESTS_UNIT_LINES_REGISTERS_CONTROL_BENCH_HPP_
