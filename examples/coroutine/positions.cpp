// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Positions by a C++20 coroutine: it sleeps while the SPI frames of a step run, and wakes in the
// callback that ends them. Here main() is the scheduler and the simulator is the board.

#include <coroutine>
#include <cstdint>
#include <cstdio>
#include <exception>

#include "mb4/mb4.hpp"
#include "mb4sim.h"

namespace {

struct Board {  // Bus and Clock of the driver
  mb4sim* simulator;
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    return mb4sim_spi_transfer(simulator, tx.data(), rx.data(), tx.size()) == 0;
  }
  std::uint32_t now_us() { return static_cast<std::uint32_t>(mb4sim_time_ns(simulator) / 1000); }
};
using Device = mb4::Device<Board, Board>;

// ---- The coroutine: 40 lines ----

struct Task {
  struct promise_type {
    Task get_return_object() { return {std::coroutine_handle<promise_type>::from_promise(*this)}; }
    std::suspend_never initial_suspend() { return {}; }
    std::suspend_always final_suspend() noexcept { return {}; }
    void return_void() {}
    void unhandled_exception() { std::terminate(); }
  };
  std::coroutine_handle<promise_type> handle;
};

struct Dma {  // the frames that run, and who waits for them
  mb4::Steps* steps = nullptr;
  std::coroutine_handle<> waiting;
  bool transferred = false;
};

struct Transfer {  // co_await: starts the frames, true if they were made
  Dma& dma;
  mb4::Steps& steps;
  bool await_ready() const { return false; }
  void await_suspend(std::coroutine_handle<> caller) {
    dma.steps = &steps;
    dma.waiting = caller;
  }
  bool await_resume() const { return dma.transferred; }
};

Task print_positions(Device& device, Board& board, Dma& dma, int count) {
  mb4::CyclicRead read;
  while (count > 0 && device.automatic().plan_slave(1, read)) {
    bool ended = false;
    while (!ended) {
      const bool transferred = co_await Transfer{dma, read};
      ended = device.automatic().finish(read, transferred, board.now_us());
    }
    if (read.error() == mb4::Error::kNone) {
      std::printf("%llu\n", static_cast<unsigned long long>(read.position()));
      --count;
    } else if (read.error() != mb4::Error::kNoData) {
      std::printf("%s\n", mb4::to_string(read.error()));
      co_return;
    }
  }
}

}  // namespace

int main() {
  char error[200];
  Board board{
      mb4sim_open("[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
                  "data_bits = 28\nsource = \"ramp\"\nstart = 500\n",
                  error, sizeof error)};
  if (board.simulator == nullptr) return 1;
  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;
  config.spi_check = mb4::SpiCheck::kCrc;
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 1'000'000);
  Device device(board, board);
  if (!device.configure(config) || !device.automatic().start()) return 1;
  Dma dma;
  const Task task = print_positions(device, board, dma, 3);
  for (int ticks = 0; ticks < 100 && !task.handle.done(); ++ticks) {
    mb4sim_advance_ns(board.simulator, 100'000);  // other work
    dma.transferred = dma.steps->run(board);
    dma.waiting.resume();
  }
  const bool done = task.handle.done();
  task.handle.destroy();
  mb4sim_close(board.simulator);
  return done ? 0 : 1;
}
