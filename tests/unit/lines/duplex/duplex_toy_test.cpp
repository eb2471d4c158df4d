// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A half-duplex toy on a duplex line: a master that asks and a device that answers after a
// turn-round. The line never rests: between two frames the master sends 0101... No shared room
// knows either of them, and `mb4sim plot` draws its frames. Bits last 100 ns. A request is 1, 1, 1,
// 0 and eight bits; the answer is 0, the eight bits of the device XOR those of the request, and a
// parity bit, the lowest bit first.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "mb4sim.h"
#include "mb4sim/simulator.hpp"
#include "plot/pictures.hpp"
#include "plot/timing_svg.hpp"
#include "report/exit_status.hpp"
#include "session.hpp"
#include "sim/core/scenario_error.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/lines/duplex/duplex_line.hpp"
#include "sim/lines/duplex/duplex_lines.hpp"
#include "sim/lines/protocols.hpp"
#include "sim/masters/live_master.hpp"
#include "sim/masters/master.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {
namespace {

constexpr Time kBit = 100 * kPsPerNs;
constexpr unsigned kWordBits = 8;
constexpr unsigned kAnswerBits = 1 + kWordBits + 1;
constexpr LineProtocol kEcho{"echo", "Echo"};
constexpr SlaveFault kDeaf{"deaf", "% deaf", "this device hears all"};

bool parity(std::uint64_t word) { return __builtin_parityll(word) != 0; }

// ---- The device ---------------------------------------------------------------------------------

class EchoSlave final : public DuplexSlave {
 public:
  EchoSlave(std::uint64_t data, Time turn) : data_(data), turn_(turn) {}

  unsigned data_bits() const override { return kWordBits; }
  bool set_data(std::uint64_t raw) override {
    if (raw >> kWordBits != 0) return false;
    data_ = raw;
    return true;
  }
  std::optional<std::uint64_t> sent_word() const override { return sent_; }
  void set_fault(const SlaveFault& fault, bool on) override {
    if (fault == kDeaf) deaf_ = on;
    DuplexSlave::set_fault(fault, on);
  }
  bool idle() const override { return left_ == 0 && !answering_; }

  // It takes each bit in its middle, counted from the last edge.
  void line_changed(Time now, bool level) override {
    level_ = level;
    if (answering_) return;
    ++sampling_;
    call_at(now + kBit / 2, sampling_);
  }
  void timer(Time now, std::uint64_t word) override {
    if (answering_) {
      if (word == kAnswer) answer(now);
      return;
    }
    if (word != sampling_) return;  // an edge came
    take(now);
    if (!answering_) call_at(now + kBit, sampling_);
  }

 private:
  static constexpr std::uint64_t kAnswer = ~std::uint64_t{0};

  void take(Time now) {
    if (left_ == 0) {
      seen_ = (seen_ << 1U | (level_ ? 1U : 0U)) & 0xFU;
      if (seen_ != 0xEU || deaf_) return;
      flips_ = begin_frame(now);
      left_ = kWordBits;
      request_ = 0;
      return;
    }
    request_ |= std::uint64_t{level_ ? 1U : 0U} << (kWordBits - left_);
    if (--left_ != 0) return;
    sent_ = data_;
    const std::uint64_t word = data_ ^ request_;
    answer_ = word << 1U | std::uint64_t{parity(word) != wrong_crc() ? 1U : 0U} << (1 + kWordBits);
    for (const unsigned bit : flips_) answer_ ^= std::uint64_t{1} << bit;
    answering_ = true;
    place_ = 0;
    call_at(now + kBit / 2 + turn_, kAnswer);
  }
  void answer(Time now) {
    if (place_ < kAnswerBits) {
      set_drive(now, {(answer_ >> place_++ & 1U) != 0, true});
      call_at(now + kBit, kAnswer);
      return;
    }
    set_drive(now, {true, false});
    answering_ = false;
    seen_ = 0;
    count_frame();
    end_frame(now);
  }

  std::uint64_t data_;
  std::uint64_t sent_ = 0;
  Time turn_;
  bool deaf_ = false;
  bool level_ = true;
  bool answering_ = false;
  unsigned seen_ = 0xF;  // the last four bits; a line at rest is 1
  unsigned left_ = 0;    // bits of the request
  std::uint64_t request_ = 0;
  std::uint64_t answer_ = 0;
  unsigned place_ = 0;
  std::uint64_t sampling_ = 0;
  std::vector<unsigned> flips_;
};

struct EchoConfig final : DeviceConfig {
  std::uint64_t data = 0;
  Time turn = 0;

  std::unique_ptr<Slave> make_slave(std::uint64_t /*seed*/) const override {
    return std::make_unique<EchoSlave>(data, turn);
  }
  DeviceTraits traits() const override { return {.protocol = kEcho}; }
  std::string_view refuses(const SlaveFault& fault) const override {
    return fault == slave_fault::kBusy ? fault.refusal : std::string_view{};
  }
};

constexpr const SlaveFault* kFaults[] = {&kDeaf};
const Protocol kEchoProtocol{
    "echo",
    &kDuplexLines,
    [](TomlReader& reader) {
      reader.know({"data", "turn_ns"});
    },
    [] { return Device(EchoConfig()); },
    nullptr,
    [](TomlReader& reader, DeviceConfig& device, std::string& /*file*/) {
      auto& config = dynamic_cast<EchoConfig&>(device);
      config.data_bits = kWordBits;
      config.flag_bits = 0;
      config.data = static_cast<std::uint64_t>(reader.integer("data", 0, 255).value_or(0));
      config.turn = from_ns(reader.number("turn_ns", 0, 1e4).value_or(100));
    },
    kFaults};

// ---- The master ---------------------------------------------------------------------------------

// A frame has 40 bits. It takes each bit of the answer in its middle, for a line without delay.
class AskingModel final : public MasterModel {
 public:
  static constexpr unsigned kFrameBits = 40;
  static constexpr unsigned kAnswerAt = 13;  // turn-round: one bit

  AskingModel() { outputs_ = of_line(0, kOutPin); }
  Time run_clocks(Time limit) override {
    while (next_ <= limit) {
      const Time now = next_;
      next_ += kBit / 2;
      ++cycles_;
      const Outputs before = outputs_;
      half();
      if (outputs_ != before) return now;
    }
    return kNever;
  }
  void set_inputs(Time /*now*/, unsigned /*line*/, unsigned levels) override { in_ = levels != 0; }
  void set_clock(Time /*now*/, std::uint64_t /*hz*/) override {}
  unsigned half_clocks(unsigned /*line*/) const override { return 1; }

  std::uint8_t request = 0;
  // Of the last frame: nothing without a start bit or with a wrong parity.
  std::optional<std::uint64_t> answer;

 private:
  void half() {
    const unsigned bit = static_cast<unsigned>(halves_ / 2 % kFrameBits);
    if (halves_++ % 2 == 0) {
      outputs_ = of_line(0, sends(bit));
      return;
    }
    if (bit < kAnswerAt || bit >= kAnswerAt + kAnswerBits) return;
    taken_ |= std::uint64_t{in_ ? 1U : 0U} << (bit - kAnswerAt);
    if (bit + 1 != kAnswerAt + kAnswerBits) return;
    const std::uint64_t word = taken_ >> 1U & 0xFFU;
    const bool good = (taken_ & 1U) == 0 && parity(word) == ((taken_ >> (1 + kWordBits)) != 0);
    answer = good ? std::optional(word ^ request) : std::nullopt;
    taken_ = 0;
  }
  unsigned sends(unsigned bit) const {
    constexpr unsigned kOn = kEnablePin | kOutPin;
    if (bit < 4) return bit == 3 ? kEnablePin : kOn;
    if (bit < 12) return (request >> (bit - 4) & 1U) != 0 ? kOn : kEnablePin;
    if (bit < kAnswerAt + kAnswerBits + 1) return kOutPin;
    return bit % 2 == 0 ? kEnablePin : kOn;
  }

  Time next_ = kPsPerUs;
  std::uint64_t halves_ = 0;
  bool in_ = true;
  std::uint64_t taken_ = 0;
};

class LiveAsking final : public LiveMaster {
 public:
  MasterModel& model() override { return model_; }
  void power_on() override {}
  HostModel* host(std::string_view /*name*/) override { return nullptr; }

 private:
  AskingModel model_;
};

constexpr HostInterface kInterfaces[] = {{"none", false, "there is no host"}};
AskingModel* asking = nullptr;  // of the simulator made last
const Master kAsking{
    .type = "asking",
    .interfaces = kInterfaces,
    .line = &kDuplexLines,
    .channels = 1,
    .slaves = 1,
    .slaves_shared = 1,
    .min_clk_hz = 1'000'000,
    .max_clk_hz = 20'000'000,
    .min_osc_hz = 0,
    .max_osc_hz = 0,
    .read_quirks = [](TomlReader& /*reader*/, ChipConfig& /*chip*/) {},
    .read_host = [](TomlReader& /*reader*/, const ChipConfig& /*chip*/, HostConfig& /*host*/) {},
    .pin_by_name = nullptr,
    .make = [](const MasterSetup& /*setup*/) -> std::unique_ptr<LiveMaster> {
      auto master = std::make_unique<LiveAsking>();
      asking = dynamic_cast<AskingModel*>(&master->model());
      return master;
    },
    .wave_groups = nullptr};

// ---- The picture --------------------------------------------------------------------------------

// Where the driver of the master is on, what the master sees, and the fields of a frame.
class EchoPicture final : public tool::LinePicture, private LineObserver {
 public:
  EchoPicture(Simulator& simulator, const ChannelConfig& channel)
      : line_(*simulator.line(channel.number)),
        turn_(dynamic_cast<const EchoConfig&>(*channel.slaves.front().device).turn) {
    line_.observe(simulator.now(), this, true);
  }
  ~EchoPicture() override { line_.observe(0, nullptr, false); }

  void finish(Simulator& simulator) override { simulator.advance(kBit); }
  tool::Picture draw(const tool::PictureRequest& request, Time /*now*/) const override;
  std::vector<tool::Signal> signals() const override { return {{"EN", &enable_}, {"IN", &seen_}}; }

 private:
  void frame_begun() override {}
  void frame_over(const LineFrame& frame) override { frames_.push_back(frame); }
  void edge(Time now, unsigned place, bool level) override {
    if (place == MB4SIM_EDGE_EN) enable_.edge(now, level);
    if (place == MB4SIM_EDGE_IN) seen_.edge(now, level);
  }
  // The bits from `at` on, the lowest first.
  std::uint64_t bits(Time at, unsigned count) const {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < count; ++i) {
      value |= std::uint64_t{seen_.at(at + i * kBit + kBit / 2) ? 1U : 0U} << i;
    }
    return value;
  }

  Line& line_;
  Time turn_;
  tool::Wave enable_;
  tool::Wave seen_;
  std::vector<LineFrame> frames_;
};

tool::Picture EchoPicture::draw(const tool::PictureRequest& request, Time /*now*/) const {
  if (request.frame > frames_.size()) throw tool::UseError(request.scenario + ": no such frame");
  // The device finds the frame in the middle of the last bit in front of the request.
  const Time asks = frames_[request.frame - 1].start + kBit / 2;
  const Time answers = asks + kWordBits * kBit + turn_;
  const Time begin = asks - 4 * kBit;
  const auto cell = [&](Time time) {
    return (static_cast<double>(time) - static_cast<double>(begin)) / static_cast<double>(kBit);
  };
  const std::uint64_t asked = bits(asks, kWordBits);
  const std::uint64_t answer = bits(answers, kAnswerBits);
  const std::uint64_t word = answer >> 1U & 0xFFU;
  const bool right = parity(word) == (answer >> (1 + kWordBits) != 0);

  tool::Diagram diagram;
  diagram.title = request.title.empty() ? "Echo" : request.title;
  diagram.axis = "bits";
  diagram.length = cell(answers + (kAnswerBits + 1) * kBit);
  for (const tool::Signal& signal : signals()) {
    tool::DiagramRow row;
    row.name = signal.name;
    const tool::Wave part = signal.wave->between(begin, answers + (kAnswerBits + 1) * kBit);
    row.idle = part.idle;
    for (const tool::Edge& edge : part.edges) row.levels.push_back({cell(edge.time), edge.level});
    diagram.rows.push_back(row);
  }
  tool::DiagramRow fields;
  fields.type = tool::DiagramRow::Type::kFields;
  const auto field = [&](Time from, unsigned count, tool::FieldKind kind, const char* name,
                         std::uint64_t value, bool bad) {
    char label[40];
    std::snprintf(label, sizeof label, "%s 0x%02X", name, static_cast<unsigned>(value));
    fields.fields.push_back({{cell(from), cell(from + count * kBit)}, kind, {label, ""}, bad});
  };
  field(asks, kWordBits, tool::FieldKind::kControl, "asks", asked, false);
  field(answers + kBit, kWordBits, tool::FieldKind::kData, "data", word ^ asked, false);
  field(answers + (1 + kWordBits) * kBit, 1, tool::FieldKind::kCrc, "P", right ? 1 : 0, !right);
  diagram.rows.push_back(fields);
  return {diagram, (answer & 1U) == 0 && right};
}

const tool::PictureDecoder kEchoPicture{
    "echo", &kDuplexLines,
    [](Simulator& simulator, const ChannelConfig& channel) -> std::unique_ptr<tool::LinePicture> {
      return std::make_unique<EchoPicture>(simulator, channel);
    }};

// What `mb4sim plot` needs to let frames come.
class AskingSession final : public tool::Session {
 public:
  using Session::Session;
  std::string configure() override { return ""; }
  tool::SessionFrame read(std::uint64_t number) override {
    asking->request = 0xA5;
    simulator_.run_until(kPsPerUs + number * kFrame);
    return {};
  }
  tool::RegisterMap registers() override { return {}; }

 private:
  static constexpr Time kFrame = AskingModel::kFrameBits * kBit;
};

const tool::MasterSupport kAskingSupport{
    .type = "asking",
    .check = [](const Scenario& /*scenario*/) {},
    .open = [](const Scenario& scenario,
               const tool::SessionOptions& options) -> std::unique_ptr<tool::Session> {
      return std::make_unique<AskingSession>(scenario, options);
    }};

// ---- The tests ----------------------------------------------------------------------------------

std::string text(const std::string& rest) {
  [[maybe_unused]] static const bool added = [] {
    add_master(kAsking);
    add_protocol(kEchoProtocol);
    tool::add_picture(kEchoPicture);
    return true;
  }();
  return "[master]\ntype = \"asking\"\n[[channel]]\nnumber = 1\n" + rest;
}
constexpr char kDevice[] = "[[channel.slave]]\nprotocol = \"echo\"\ndata = 0x5C\n";
constexpr Time kFrame = AskingModel::kFrameBits * kBit;

std::string error_of(const std::string& rest) {
  try {
    parse_scenario(text(rest), "toy.toml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

TEST(DuplexToy, AsksAndIsAnswered_FrameByFrame) {
  Simulator simulator(parse_scenario(text(kDevice), "toy.toml"));
  simulator.run_until(kPsPerUs + kFrame);
  for (const unsigned request : {0x00U, 0xFFU, 0xA5U, 0x01U, 0x80U}) {
    asking->request = static_cast<std::uint8_t>(request);
    ASSERT_TRUE(simulator.slave(1)->set_data(request * 3 & 0xFFU));
    const std::uint64_t before = simulator.slave(1)->frames();
    simulator.advance(kFrame);
    EXPECT_EQ(asking->answer, request * 3 & 0xFFU);
    EXPECT_EQ(simulator.slave(1)->frames(), before + 1);
    EXPECT_EQ(simulator.slave(1)->sent_in(before + 1), request * 3 & 0xFFU);
  }
  EXPECT_EQ(duplex(simulator.line(1))->contention(simulator.now()).times, 0U);
}

TEST(DuplexToy, AnswerThatComesEarly_IsContention) {
  Simulator simulator(
      parse_scenario(text(std::string("enable_ns = 0\ndisable_ns = 150\n") + kDevice), "toy.toml"));
  simulator.run_until(kPsPerUs + 3 * kFrame);
  // The master's driver is off 150 ns after the request, the answer begins after 100 ns; it is off
  // 150 ns after its end, where the master's has been on for 50 ns.
  EXPECT_EQ(duplex(simulator.line(1))->contention(simulator.now()).times, 6U);
  EXPECT_EQ(duplex(simulator.line(1))->contention(simulator.now()).total, 6 * 50 * kPsPerNs);
}

TEST(DuplexToy, Faults_AreThoseOfTheScenario) {
  Simulator simulator(
      parse_scenario(text(std::string("flips = [[3, 2]]\n") + kDevice +
                          "[[channel.event]]\nat_us = 21\naction = \"unplug\"\n"
                          "[[channel.event]]\nat_us = 25\naction = \"plug\"\n"
                          "[[fault]]\nkind = \"deaf\"\nslave = 1\nat_us = 29\nfor_us = 4\n"
                          "[[fault]]\nkind = \"wrong-crc\"\nslave = 1\nat_us = 37\nfor_us = 4\n"),
                     "toy.toml"));
  std::string answers;
  for (unsigned frame = 1; frame <= 11; ++frame) {
    asking->answer = std::nullopt;
    simulator.run_until(kPsPerUs + frame * kFrame);
    answers += asking->answer == 0x5CU ? '+' : '-';
  }
  EXPECT_EQ(answers, "++-++-+-+-+");
}

TEST(DuplexToy, KeysAndFaults_AreChecked) {
  EXPECT_NE(error_of("[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n")
                .find("needs a line of the kind 'clocked', the master's are 'duplex'"),
            std::string::npos);
  EXPECT_NE(error_of("[[channel.slave]]\nprotocol = \"echo\"\ndata = 256\n").find("toy.toml:7"),
            std::string::npos);
  EXPECT_NE(error_of(std::string("mo = true\n") + kDevice).find("mo"), std::string::npos);
  EXPECT_EQ(error_of(kDevice), "");
}

struct Told {
  std::vector<std::uint64_t> frames;  // ns
  std::vector<std::string> edges;
};

// Frames and edges of the C interface.
TEST(DuplexToy, CInterface_TellsFramesAndEdges) {
  char error[200] = "";
  mb4sim* const sim = mb4sim_open(text(kDevice).c_str(), error, sizeof error);
  ASSERT_NE(sim, nullptr) << error;
  Told told;
  ASSERT_EQ(mb4sim_on_frame(
                sim,
                [](void* context, const mb4sim_frame* frame) {
                  static_cast<Told*>(context)->frames.push_back(frame->end_ns - frame->start_ns);
                },
                &told),
            0);
  ASSERT_EQ(
      mb4sim_on_edge(
          sim,
          [](void* context, unsigned channel, unsigned place, uint64_t /*time_ps*/, int level) {
            static_cast<Told*>(context)->edges.push_back(
                std::to_string(channel) + "." + std::to_string(place) + (level ? "+" : "-"));
          },
          &told),
      0);
  ASSERT_GE(told.edges.size(), 4U);
  EXPECT_EQ(told.edges[0].substr(0, 3), "1.4");  // MB4SIM_EDGE_OUT
  EXPECT_EQ(told.edges[3].substr(0, 3), "1.7");  // MB4SIM_EDGE_ENCODER
  told = {};
  mb4sim_advance_ns(sim, 12'000);
  EXPECT_EQ(told.frames.size(), 3U);
  // From the middle of the bit that begins the request, over eight bits, half a bit, the turn-round
  // and ten bits of the answer.
  for (const std::uint64_t length : told.frames)
    EXPECT_EQ(length * kPsPerNs, 8 * kBit + kBit / 2 + 11 * kBit);
  EXPECT_GT(told.edges.size(), 90U);
  mb4sim_close(sim);
}

std::string content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// `mb4sim plot` of the second frame. Returns its exit status.
int plot(const std::string& rest, std::string& svg, std::string& vcd) {
  tool::PlotOptions options;
  options.scenario = testing::TempDir() + "toy.toml";
  options.frame = 2;
  options.svg = testing::TempDir() + "toy.svg";
  options.vcd = testing::TempDir() + "toy.vcd";
  std::ofstream(options.scenario) << text(rest);
  const int status = tool::plot_command(options);
  svg = content(options.svg);
  vcd = content(options.vcd);
  return status;
}

TEST(DuplexToy, Picture_ShowsQuestionAndAnswer) {
  std::string svg, vcd;
  EXPECT_EQ(plot(kDevice, svg, vcd), tool::kGood);
  EXPECT_NE(svg.find("asks 0xA5"), std::string::npos) << svg;
  EXPECT_NE(svg.find("data 0x5C"), std::string::npos);
  EXPECT_NE(vcd.find("$var wire 1 ! EN1 $end\n$var wire 1 \" IN1 $end\n"), std::string::npos)
      << vcd;
  // Another turn-round moves the answer, and nothing else.
  std::string late;
  EXPECT_EQ(plot(std::string(kDevice) + "turn_ns = 300\n", late, vcd), tool::kGood);
  EXPECT_NE(late.find("data 0x5C"), std::string::npos);
  EXPECT_NE(late, svg);
  // The second frame begins at 5 us.
  EXPECT_EQ(plot(std::string(kDevice) + "[[fault]]\nkind = \"wrong-crc\"\nslave = 1\nat_us = 5\n"
                                        "for_us = 4\n",
                 svg, vcd),
            tool::kBad);
}

}  // namespace
}  // namespace mb4::sim

namespace mb4::tool {
const MasterSupport& support_of(const sim::Scenario& /*scenario*/) { return sim::kAskingSupport; }
}  // namespace mb4::tool
