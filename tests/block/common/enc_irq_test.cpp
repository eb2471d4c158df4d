// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Events and interrupts alone, between two clocks: IRQ_STATUS and IRQ_ENABLE of a bus top's page
// (docs/buses.md, regmap/mb4_page.rdl).
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "Venc_irq.h"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kFrameEnded = 1, kLost = 16;

struct Clocks {
  unsigned core, bus;  // periods
};
constexpr std::array kClocks{Clocks{10, 10}, Clocks{10, 3}, Clocks{3, 10}, Clocks{7, 100},
                             Clocks{100, 7}};

class Irq {
 public:
  explicit Irq(Clocks periods) : period(periods), core_at(1), bus_at(1 + periods.bus / 3) {
    m.clk_i = m.bus_clk_i = m.rst_ni = m.bus_rst_ni = 1;
    m.event_i = m.status_we_i = m.enable_we_i = m.data_i = 0;
    m.eval();
    m.rst_ni = m.bus_rst_ni = 0;
    m.eval();
    m.rst_ni = m.bus_rst_ni = 1;
    m.eval();
  }
  // Up to the next edge of the core (or the bus), with it; what happens there is then over.
  void clock(bool core) {
    for (bool done = false; !done;) {
      const bool is_core = running && core_at <= bus_at;
      (is_core ? m.clk_i : m.bus_clk_i) = 0;
      m.eval();
      (is_core ? m.clk_i : m.bus_clk_i) = 1;
      m.eval();
      (is_core ? core_at : bus_at) += is_core ? period.core : period.bus;
      if (is_core) m.event_i = 0;
      if (!is_core) m.status_we_i = m.enable_we_i = 0;
      m.eval();
      EXPECT_EQ(m.irq_o != 0, (m.status_o & m.enable_o) != 0);
      done = is_core == core;
    }
  }
  void event(unsigned bits) {
    m.event_i = static_cast<std::uint8_t>(bits);
    clock(true);
  }
  void write(bool enable, unsigned bits) {
    (enable ? m.enable_we_i : m.status_we_i) = 1;
    m.data_i = static_cast<std::uint8_t>(bits);
    clock(false);
  }
  // The time within which an event is seen: three clocks of each, or twice this.
  void settle(unsigned times = 1) {
    for (unsigned i = 0; i < 3 * times; ++i) clock(true);
    for (unsigned i = 0; i < 3 * times; ++i) clock(false);
  }
  unsigned status() const { return m.status_o; }

  mb4test::Owned<Venc_irq> owner;
  Venc_irq& m = *owner;
  Clocks period;
  std::uint64_t core_at, bus_at;
  bool running = true;
};

// Each bit is set by its event, a 1 clears it, a 0 leaves it; the interrupt is what is enabled.
TEST(IrqBlock, EveryEvent_SetsItsBitUntilAOneClearsIt) {
  for (const Clocks clocks : kClocks) {
    Irq irq(clocks);
    EXPECT_EQ(irq.status() | irq.m.enable_o, 0U);
    for (unsigned bit = 0; bit < 5; ++bit) {
      irq.event(1U << bit);
      irq.settle();
      ASSERT_EQ(irq.status(), 1U << bit) << clocks.core << " " << clocks.bus;
      EXPECT_EQ(irq.m.irq_o, 0);
      irq.write(true, ~(1U << bit) & 31U);
      EXPECT_EQ(irq.m.irq_o, 0);
      irq.write(true, 1U << bit);
      EXPECT_EQ(irq.m.irq_o, 1);
      irq.write(false, ~(1U << bit) & 31U);
      EXPECT_EQ(irq.status(), 1U << bit);
      irq.write(false, 1U << bit);
      EXPECT_EQ(irq.status(), 0U);
      EXPECT_EQ(irq.m.irq_o, 0);
      irq.settle(4);
      EXPECT_EQ(irq.status(), 0U) << "once";
    }
  }
}

// Events while others cross are not lost.
TEST(IrqBlock, EventsInEveryClock_AllAreSeen) {
  for (const Clocks clocks : kClocks) {
    Irq irq(clocks);
    mb4test::Dice dice;
    for (int round = 0; round < 100; ++round) {
      unsigned expected = 0;
      for (unsigned i = dice.below(6); i > 0; --i) {
        const unsigned bits = dice.below(16) << 1;  // without ends of frames
        expected |= bits;
        irq.event(bits);
      }
      irq.settle(2);
      ASSERT_EQ(irq.status(), expected);
      irq.write(false, 31);
    }
  }
}

// Bit 4: a frame ends while bit 0 is still set, or is still on its way there.
TEST(IrqBlock, SecondFrameEnd_IsAFrameLost) {
  for (const Clocks clocks : kClocks) {
    for (unsigned apart = 0; apart < 30; ++apart) {
      Irq irq(clocks);
      const unsigned before = apart % 2 * 2;  // another event that crosses meanwhile
      irq.event(before);
      irq.event(kFrameEnded);
      for (unsigned i = 0; i < apart / 2; ++i) irq.clock(true);
      irq.event(kFrameEnded);
      irq.settle(3);
      ASSERT_EQ(irq.status(), kFrameEnded | kLost | before) << apart;
      irq.write(false, 31);
      irq.event(kFrameEnded);
      irq.settle();
      ASSERT_EQ(irq.status(), kFrameEnded) << "the first after a clear";
    }
  }
}

// A bit that is set and cleared with one edge stays set: at some delay the clear meets the set.
TEST(IrqBlock, ClearAtAnyTime_LosesNoEvent) {
  for (const Clocks clocks : kClocks) {
    for (unsigned delay = 0; delay < 60; ++delay) {
      Irq irq(clocks);
      irq.event(2);
      unsigned seen = irq.status();
      for (unsigned i = 0; i < delay && seen == 0; ++i) {
        irq.clock(false);
        seen = irq.status();
      }
      irq.write(false, 2);
      irq.settle();
      ASSERT_EQ(irq.status(), seen == 0 ? 2U : 0U) << delay;
    }
  }
}

TEST(IrqBlock, CoreClockStandsStill_RegistersWork) {
  Irq irq({10, 7});
  irq.event(4);
  irq.settle();
  irq.running = false;
  irq.write(true, 21);
  EXPECT_EQ(irq.m.enable_o, 21);
  EXPECT_EQ(irq.m.irq_o, 1);
  irq.write(false, 4);
  EXPECT_EQ(irq.status(), 0U);
}

}  // namespace
