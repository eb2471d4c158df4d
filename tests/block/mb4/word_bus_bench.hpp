// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A bus top (mb4_axil, mb4_wb) with a bus manager, two free clocks and a BiSS C slave on each line.
// The clocks are in picoseconds; the core's may be stopped. A slave answers with a word whose eight
// bytes are equal, so that parts of two words never look like one.
#ifndef TESTS_BLOCK_MB4_WORD_BUS_BENCH_HPP_
#define TESTS_BLOCK_MB4_WORD_BUS_BENCH_HPP_

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "tests/block/biss/edge_slave.hpp"
#include "tests/support/model_context.hpp"

namespace mb4test {

// What an access of the bus gave.
struct Answer {
  std::uint32_t data = 0;
  bool error = false;
  unsigned clocks = 0;  // of the bus
};

template <typename Model>
class WordBusBench {
 public:
  // A frame as its slave saw it.
  struct Frame {
    std::uint8_t value = 0;         // of each byte of the word
    std::uint64_t latch_clock = 0;  // number of the core's edge at which the slave latched
  };

  WordBusBench(std::uint64_t bus_ps, std::uint64_t core_ps, std::uint64_t phase_ps = 0,
               unsigned quirks = 0)
      : bus_ps_(bus_ps), core_ps_(core_ps), next_bus_(1000), next_core_(1000 + phase_ps) {
    for (Slave& slave : slaves_) slave.timeout = 12 * core_ps;
    model->clk_i = 0;
    model->por_ni = 0;
    model->ner_i = 1;
    model->getsens_i = 0;
    model->quirks_i = static_cast<std::uint8_t>(quirks);
    model->sl1_i = model->sl2_i = 1;
    bus_clock(false);
    // A reset is an edge to Verilator: the bus is reset first, so that the reset of the core has
    // one.
    core_runs_ = false;
    model->por_ni = 1;
    // Random values from before the reset are no state of the chip.
    model->contextp()->assertOn(false);
    for (const bool active : {false, true, true, false, false, false, true}) {
      model->por_ni = !active;
      reset(active);
      model->eval();
      clock();
    }
    start_core();
    while (core_edges < 4) clock();
    model->contextp()->assertOn(true);
    model->por_ni = 1;
    reset(false);
    for (int i = 0; i < 8; ++i) clock();
    while (core_edges < 70) clock();  // the memories are cleared
  }

  Answer read(std::uint32_t address) { return access(address, false, 0, 0xF); }
  Answer write(std::uint32_t address, std::uint32_t data, unsigned enables = 0xF) {
    return access(address, true, data, enables);
  }
  // For tests that expect no error.
  std::uint32_t get(std::uint32_t address) {
    const Answer answer = read(address);
    EXPECT_FALSE(answer.error) << std::hex << address;
    return answer.data;
  }
  void put(std::uint32_t address, std::uint32_t data, unsigned enables = 0xF) {
    EXPECT_FALSE(write(address, data, enables).error) << std::hex << address;
  }

  // Channel 1 on line 1 with 64 bits and channel 5 on line 2 with 32 bits, no CRC, MA at half the
  // clock, frames one after the other.
  void configure() {
    put(0xC0, 0x0000007F);
    put(0xD0, 0x0000005F);
    put(0xE4, 0x00004000);  // REGVERS: BiSS C, FREQS = 0
    put(0xE8, 0x0000007C);  // AGSMIN
    put(0xEC, 0x00000510);  // SLAVELOC5, both lines BiSS C
  }

  void stop_core() { core_runs_ = false; }
  void start_core() {
    core_runs_ = true;
    if (next_core_ < now_) next_core_ = now_ + core_ps_;
  }
  bool core_runs() const { return core_runs_; }
  // One clock of the bus.
  void clock() {
    before_edge();
    edge();
  }
  // Begins a read and takes it back after some clocks. The address changes with it. Returns whether
  // it was taken back in time.
  bool withdraw(std::uint32_t address, unsigned clocks, std::uint32_t next) {
    if constexpr (kAxi) {
      model->s_axi_araddr = static_cast<std::uint16_t>(address);
      model->s_axi_arvalid = model->s_axi_rready = 1;
      bool taken = false;
      for (unsigned i = 0; i < clocks && !taken; ++i) {
        before_edge();
        taken = model->s_axi_arready;
        edge();
      }
      model->s_axi_arvalid = 0;
      model->s_axi_araddr = static_cast<std::uint16_t>(next);
      for (unsigned i = 0; i < 4; ++i) clock();
      model->s_axi_rready = 0;
      return !taken;
    } else {
      model->wb_adr_i = static_cast<std::uint16_t>(address >> 2);
      model->wb_we_i = 0;
      model->wb_cyc_i = model->wb_stb_i = 1;
      bool done = false;
      for (unsigned i = 0; i < clocks && !done; ++i) {
        before_edge();
        done = model->wb_ack_o || model->wb_err_o;
        edge();
      }
      model->wb_cyc_i = model->wb_stb_i = 0;
      model->wb_adr_i = static_cast<std::uint16_t>(next >> 2);
      for (unsigned i = 0; i < 4; ++i) clock();
      return !done;
    }
  }

  Owned<Model> model;
  std::array<std::vector<Frame>, 2> frames;  // of the lines
  std::uint64_t core_edges = 0;
  std::function<void()> after_core_edge;
  std::function<void()> before_bus_edge;

 private:
  static constexpr bool kAxi = requires(Model & m) { m.s_axi_aclk; };

  void bus_clock(bool level) {
    if constexpr (kAxi) {
      model->s_axi_aclk = level;
    } else {
      model->wb_clk_i = level;
    }
  }
  void reset(bool active) {
    if constexpr (kAxi) {
      model->s_axi_aresetn = !active;
      model->s_axi_awvalid = model->s_axi_wvalid = model->s_axi_arvalid = 0;
      model->s_axi_bready = model->s_axi_rready = 0;
    } else {
      model->wb_rst_i = active;
      model->wb_cyc_i = model->wb_stb_i = 0;
    }
  }

  // Everything up to, but without, the next rising edge of the bus.
  void before_edge() {
    while (core_runs_ && next_core_ < next_bus_) {
      now_ = next_core_;
      model->clk_i = core_level_ = !core_level_;
      model->eval();
      if (core_level_) {
        ++core_edges;
        lines();
        if (after_core_edge) after_core_edge();
      }
      next_core_ += core_ps_ / 2;
    }
    now_ = next_bus_;
    model->eval();
    if (before_bus_edge) before_bus_edge();
  }
  void edge() {
    bus_clock(true);
    model->eval();
    bus_clock(false);
    model->eval();
    next_bus_ += bus_ps_;
  }
  void lines() {
    const std::array<bool, 2> ma{model->ma1_o != 0, model->ma2_o != 0};
    for (unsigned i = 0; i < 2; ++i) {
      Slave& slave = slaves_[i];
      if (ma[i] != ma_[i]) {
        slave.edge(ma[i], now_);
        if (ma[i] && slave.in_frame && slave.rises == 1) {
          const auto value = static_cast<std::uint8_t>(1 + frames[i].size() * (i == 0 ? 1 : 3));
          frames[i].push_back({value, core_edges});
          slave.payload = "0";  // CDS
          for (unsigned byte = 0; byte < (i == 0 ? 8U : 4U); ++byte)
            slave.payload += bits_of(value, 8);
        }
      }
      ma_[i] = ma[i];
      slave.step(ma[i], now_);
    }
    model->sl1_i = slaves_[0].out;
    model->sl2_i = slaves_[1].out;
    model->eval();
  }

  Answer access(std::uint32_t address, bool write, std::uint32_t data, unsigned enables) {
    Answer answer;
    if constexpr (kAxi) {
      bool waits = true;  // for the handshake of the request
      if (write) {
        model->s_axi_awaddr = static_cast<std::uint16_t>(address);
        model->s_axi_wdata = data;
        model->s_axi_wstrb = static_cast<std::uint8_t>(enables);
        model->s_axi_awvalid = model->s_axi_wvalid = model->s_axi_bready = 1;
      } else {
        model->s_axi_araddr = static_cast<std::uint16_t>(address);
        model->s_axi_arvalid = model->s_axi_rready = 1;
      }
      for (bool done = false; !done; ++answer.clocks) {
        if (answer.clocks > kPatience) {
          ADD_FAILURE() << "no answer";
          break;
        }
        before_edge();
        const bool taken = write ? model->s_axi_awready : model->s_axi_arready;
        done = write ? model->s_axi_bvalid : model->s_axi_rvalid;
        if (done) {
          answer.error = (write ? model->s_axi_bresp : model->s_axi_rresp) != 0;
          answer.data = model->s_axi_rdata;
          EXPECT_FALSE(waits);
        }
        edge();
        if (taken) {
          waits = false;
          model->s_axi_awvalid = model->s_axi_wvalid = model->s_axi_arvalid = 0;
        }
      }
      model->s_axi_bready = model->s_axi_rready = 0;
    } else {
      model->wb_adr_i = static_cast<std::uint16_t>(address >> 2);
      model->wb_we_i = write;
      model->wb_dat_i = data;
      model->wb_sel_i = static_cast<std::uint8_t>(enables);
      model->wb_cyc_i = model->wb_stb_i = 1;
      for (bool done = false; !done; ++answer.clocks) {
        if (answer.clocks > kPatience) {
          ADD_FAILURE() << "no answer";
          break;
        }
        before_edge();
        done = model->wb_ack_o || model->wb_err_o;
        answer.error = model->wb_err_o;
        answer.data = model->wb_dat_o;
        edge();
      }
      model->wb_cyc_i = model->wb_stb_i = 0;
    }
    return answer;
  }

  static constexpr unsigned kPatience = 20'000;
  std::uint64_t bus_ps_, core_ps_, next_bus_, next_core_, now_ = 0;
  bool core_level_ = false, core_runs_ = true;
  std::array<Slave, 2> slaves_;
  std::array<bool, 2> ma_{true, true};
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_MB4_WORD_BUS_BENCH_HPP_
