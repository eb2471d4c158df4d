// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs the model of the master and the encoder with faults, and prints what a decoder of the line
// is judged by: each edge of a wire, `WIRE PICOSECONDS LEVEL` with the wire as in mb4sim_on_edge()
// (4 _OUT, 5 _EN, 6 _IN, 7 _ENCODER), and each answer as the master has taken it, `F SAMPLED STATE
// RESTART ANSWER GOOD ERRORS POSITION SAFE SAFE2`: time of the edge in SAMPLE, 1 if the link ends
// with it, 61 bits, 1 if the second difference is good, the number of words that are none, and the
// safe positions of a good vertical frame or -. A message that went well is `M REQUEST ANSWER`.
//
//   dsl_recording FRAMES
#include <bitset>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "sim/lines/dsl/dsl_faults.hpp"
#include "tests/unit/dsl/dsl_bench.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_test;
namespace at = dsl_model::host_address;
namespace on = dsl_model::host_bit;

struct Printer final : LineObserver {
  void frame_begun() override {}
  void frame_over(const LineFrame& /*frame*/) override {}
  void edge(Time now, unsigned place, bool level) override {
    std::printf("%u %llu %d\n", place, static_cast<unsigned long long>(now), level ? 1 : 0);
  }
};

void print(const LinkFrame& frame, LinkModel& model) {
  const bool training = frame.state == LinkState::kStart || frame.state == LinkState::kLearn ||
                        frame.state == LinkState::kCheck;
  const auto safe = [&](const dsl_model::SafeChannel& channel) {
    return frame.safe_new && channel.valid ? std::to_string(channel.position) : std::string("-");
  };
  const dsl_model::AnswerWords& words = frame.words;
  int errors = 0;
  for (const auto* word : {&words.vertical, &words.parameter, &words.pipeline,
                           &words.acceleration_high, &words.acceleration_low, &words.secondary}) {
    errors += word->error ? 1 : 0;
  }
  std::string state = name_of(frame.state);
  for (char& c : state) c = c == ' ' ? '_' : c;
  std::printf("F %llu %s %d %s %d %d %llu %s %s\n",
              static_cast<unsigned long long>(model.time_of(frame.sampled)), state.c_str(),
              frame.restart == Restart::kNone ? 0 : 1,
              training ? "-" : std::bitset<61>(frame.answer).to_string().c_str(),
              frame.acceleration_good ? 1 : 0, errors,
              static_cast<unsigned long long>(frame.position), safe(frame.safe1).c_str(),
              safe(frame.safe2).c_str());
}

// A host that sends one message after the other. What has become of a good one is printed: `M
// REQUEST ANSWER` in hex, without CRC.
class Host {
 public:
  explicit Host(dsl_model::HostBytes& host) : host_(host) {}

  // Once a frame.
  void acts() {
    if (!running_) {
      start(kMessages[next_ % std::size(kMessages)]);
      return;
    }
    const Message& now = kMessages[next_ % std::size(kMessages)];
    const std::uint8_t events = host_.read(at::kEventL);
    if ((events & (now.is_long ? on::kFrel : on::kFres)) == 0) return;
    if ((events & on::kAns) == 0) print(now);
    host_.write(at::kEventL, 0);
    running_ = false;
    ++next_;
  }

 private:
  struct Message {
    bool is_long;
    std::uint8_t first;   // SLAVE_REG_CTRL, PC_ADD_H
    std::uint8_t second;  // PC_DATA, PC_ADD_L
  };
  static constexpr Message kMessages[] = {
      {false, 0x7F, 0xAB}, {false, 0xFF, 0},   {true, 0xC8, 0x00}, {true, 0xCC, 0x81},
      {false, 0xC0, 0},    {true, 0xE4, 0x81}, {true, 0x94, 0x00}, {true, 0xD8, 0x82}};
  static constexpr std::uint8_t kOffset = 3;

  void start(const Message& message) {
    running_ = true;
    if (!message.is_long) {
      host_.write(at::kData, message.second);
      host_.write(at::kControl, message.first);
      return;
    }
    host_.write(at::kOffL, kOffset);
    host_.write(at::kBuffer0, 0x12);
    host_.write(at::kBuffer0 + 1, 0x34);
    host_.write(at::kAddH, message.first);
    host_.write(at::kAddL, message.second);
    host_.write(at::kCtrl, on::kStart);
  }
  void print(const Message& message) const {
    if (!message.is_long) {
      const bool read = (message.first & 0x80) != 0;
      const unsigned header = (message.first & 0x3FU) | (read ? 0x40U : 0U);
      if (read) {
        std::printf("M %02x %02x%02x\n", header, header, host_.read(at::kData));
      } else {
        std::printf("M %02x%02x %02x\n", header, message.second, header);
      }
      return;
    }
    std::printf("M %02x%02x", message.first | 0x80U, message.second);
    if ((message.first & 0x20) != 0) std::printf("80%02x", kOffset);
    if ((message.first & 0x40) == 0) std::printf("1234");
    const std::uint8_t header = host_.read(at::kAddH);
    const unsigned code = header >> 2U & 3U;
    std::printf(" %02x%02x", header, host_.read(at::kAddL));
    for (unsigned i = 0; i < (code == 0 ? 0U : 1U << code); ++i) {
      std::printf("%02x", host_.read(at::kBuffer0 + i));
    }
    std::printf("\n");
  }

  dsl_model::HostBytes& host_;
  std::size_t next_ = 0;
  bool running_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t frames = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10'000;
  BenchSetup setup;
  setup.metres(35);
  setup.cable.in.jitter = 8 * kPsPerNs;
  setup.cable.answer_errors = 1e-4;
  Bench bench(setup);
  RandomMotion motion(bench.encoder(), 42);
  Host host(bench.link().host());
  Printer printer;
  bench.line().observe(0, &printer, true);
  bench.on_frame = [&](const LinkFrame& frame) {
    print(frame, bench.model());
    // Faults that last a few frames, in turn.
    constexpr const SlaveFault* kFaults[] = {&slave_fault::kSilent,      &slave_fault::kFastMarker,
                                             &slave_fault::kWrongCrc,    &slave_fault::kSafeMarker,
                                             &slave_fault::kWrongCrc2,   &slave_fault::kNoVsync,
                                             &slave_fault::kSafe2Marker, &slave_fault::kEarlyVsync};
    if (frame.number == 0) return;
    host.acts();
    const SlaveFault& fault = *kFaults[frame.number / 500 % std::size(kFaults)];
    const std::uint64_t place = frame.number % 500;
    if (place == 100 || place == 112) {
      bench.encoder().set_fault(fault, place == 100);
      bench.line().slave_changed(bench.now());
    } else if (place == 0) {
      for (const SlaveFault* each : kFaults) bench.encoder().set_fault(*each, false);
      bench.line().slave_changed(bench.now());
    }
    // A silent encoder loses the link, whose frames begin again.
    if (frame.restart != Restart::kNone) {
      for (const SlaveFault* each : kFaults) bench.encoder().set_fault(*each, false);
    }
  };
  bench.run_frames(frames);
  return 0;
}
