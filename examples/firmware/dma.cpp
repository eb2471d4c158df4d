// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Firmware without a blocking transfer after configure(): INIT, comparison, start, positions,
// registers of the slave and restart in steps. main() plans and sleeps; the interrupt that ends a
// transfer makes the next one, and calls finish() after the last one of a step. Runs in QEMU
// against `mb4sim bridge`, as main.cpp does.
//
// QEMU's MPS2 has no DMA channel at this port. The receive interrupt of the UART takes its place:
// Transfer::start() and the callback done() are what a DMA channel of SPI has too. The pause before
// a step and the time come from the simulator, as from a timer of the board.

#include "board.hpp"
#include "mb4/mb4.hpp"

namespace {

constexpr mb4::Config make_config() {
  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.spi_check = mb4::SpiCheck::kCrc;  // a read of a position is one chain
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 100'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;
  return config;
}
constexpr mb4::Config kConfig = make_config();
static_assert(mb4::validate(kConfig).ok());

using Device = mb4::Device<board::Bus, board::Clock>;

// One request to the bridge. Its answer comes by interrupts.
struct Transfer {
  std::uint8_t* to = nullptr;
  std::size_t left = 0;    // of the answer's bytes, header included
  std::size_t header = 0;  // of its header
  bool good = false;

  void start(char kind, const std::uint8_t* from, std::uint8_t* into, std::size_t size) {
    to = into;
    header = 3;
    left = 3 + size;
    good = true;
    board::Bridge::begin(kind, size);
    for (std::size_t i = 0; i < size; ++i) board::Uart::put(from[i]);
  }
  // The next byte of the answer. True: it was the last one.
  bool take(std::uint8_t byte) {
    if (header == 3) good = byte == 0;
    if (header > 0) {
      --header;
    } else if (to != nullptr) {
      *to++ = byte;
    }
    return --left == 0;
  }
};

// What runs: the steps, and the call that takes what came back.
struct Job {
  enum class Phase : std::uint8_t { kPause, kFrames, kTime };
  Device* device = nullptr;
  mb4::Steps* steps = nullptr;
  mb4::Operation* operation = nullptr;  // it is one of these two
  mb4::CyclicRead* read = nullptr;
  Phase phase = Phase::kPause;
  std::size_t frame = 0;
  bool transferred = false;
  volatile bool ended = false;
  bool once = false;  // main() goes on after each step
  std::uint8_t time[8] = {};
  Transfer transfer;

  void wait_ns(std::uint64_t ns) {
    for (unsigned i = 0; i < 8; ++i) time[i] = static_cast<std::uint8_t>(ns >> (8 * i));
    transfer.start('W', time, time, sizeof time);
  }
  void begin() {
    frame = 0;
    transferred = true;
    phase = Phase::kPause;
    ended = false;
    wait_ns(steps->pause_us() * 1000ULL);
  }
  std::uint32_t now_us() const {
    std::uint64_t ns = 0;
    for (unsigned i = 0; i < 8; ++i) ns |= static_cast<std::uint64_t>(time[i]) << (8 * i);
    return static_cast<std::uint32_t>(ns / 1000);
  }

  // The callback: a transfer has ended.
  void done() {
    transferred = transferred && transfer.good;
    if (phase == Phase::kTime) {
      const bool all = operation != nullptr
                           ? device->finish(*operation, transferred, now_us())
                           : device->automatic().finish(*read, transferred, now_us());
      if (all) {
        operation = nullptr;
        read = nullptr;
        ended = true;
      } else if (once) {
        ended = true;
      } else {
        begin();
      }
      return;
    }
    frame += phase == Phase::kFrames ? 1 : 0;
    phase = Phase::kFrames;
    if (transferred && frame < steps->frames()) {
      const mb4::Span<const std::uint8_t> tx = steps->tx(frame);
      const mb4::Span<std::uint8_t> rx = steps->rx(frame);
      transfer.start('T', tx.data(), rx.empty() ? nullptr : rx.data(), tx.size());
    } else {
      phase = Phase::kTime;
      wait_ns(1000);
    }
  }
};
Job job;

void sleep_until_done() {
  asm volatile("cpsid i" : : : "memory");
  while (!job.ended) {
    asm volatile("wfi\n\tcpsie i\n\tisb\n\tcpsid i" : : : "memory");
  }
  asm volatile("cpsie i" : : : "memory");
}
void run(mb4::Operation& operation, bool once = false) {
  job.operation = &operation;
  job.steps = &operation;
  job.once = once;
  job.begin();
  sleep_until_done();
}
void run(mb4::CyclicRead& read) {
  job.read = &read;
  job.steps = &read;
  job.once = false;
  job.begin();
  sleep_until_done();
}

template <typename T>
void require(const mb4::Result<T>& result, const char* what) {
  board::print(what);
  board::print(": ");
  board::print(mb4::to_string(result.error()));
  board::print("\n");
  if (!result) board::exit(static_cast<std::uint32_t>(result.error()));
}

// Reads until a new position is there.
void print_position(mb4::CyclicRead& read) {
  do {
    static_cast<void>(job.device->automatic().plan_slave(1, read));
    run(read);
  } while (read.error() == mb4::Error::kNoData);
  if (read.error() != mb4::Error::kNone) {
    board::print("read: ");
    board::print(mb4::to_string(read.error()));
    board::print("\n");
    board::exit(static_cast<std::uint32_t>(read.error()));
  }
  board::print("position ");
  board::print_hex(read.position(), 7);
  board::print("\n");
}

}  // namespace

extern "C" void uart_received() {
  board::Uart::clear_received();
  while (board::Uart::has_byte()) {
    if (job.transfer.take(board::Uart::get())) {
      job.done();
      return;
    }
  }
}

int main() {
  board::Uart::open();
  board::Bus bus;
  board::Clock clock;
  Device device(bus, clock);
  require(device.configure(kConfig), "configure");

  job.device = &device;
  board::Uart::interrupt_on_receive();
  static mb4::Operation operation;
  static mb4::CyclicRead read;

  static_cast<void>(device.plan_initialize(operation));
  run(operation);
  require(operation.result(), "initialize");
  static_cast<void>(device.plan_verify(operation));
  run(operation);
  require(operation.result(), "verify");
  static_cast<void>(device.automatic().plan_start(operation));
  run(operation);
  require(operation.result(), "start");
  for (int i = 0; i < 3; ++i) print_position(read);

  // Registers, and a position between any two steps.
  static std::uint8_t serial[4];
  require(device.control().plan_read(operation, {1, 0}, 0x44, serial), "plan_read");
  do {
    run(operation, true);
    static_cast<void>(device.automatic().plan_slave(1, read));
    mb4::Operation* pending = job.operation;
    job.operation = nullptr;
    run(read);
    job.operation = pending;
  } while (job.operation != nullptr);
  require(operation.result(), "read");
  board::print("serial ");
  for (const std::uint8_t byte : serial) board::print_hex(byte, 2);
  board::print("\n");

  static_cast<void>(device.automatic().plan_restart(operation));
  run(operation);
  require(operation.result(), "restart");
  print_position(read);
  board::exit(0);
}
