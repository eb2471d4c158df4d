// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands with a master that has only what it must: columns of its own, no codes of a
// frequency, no scan. A program of its own: it has support_of() instead of the list of masters.
#include "session.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "commands/commands.hpp"
#include "report/exit_status.hpp"
#include "report/frame_report.hpp"
#include "sim/core/scenario_error.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

constexpr char kScenario[] =
    "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 16\n";

class PlainSession final : public Session {
 public:
  using Session::Session;
  std::string configure() override { return ""; }
  SessionFrame read(std::uint64_t number) override {
    SessionFrame frame;
    frame.number = number;
    Word word;
    word.bits = 0x2A;
    frame.results.push_back(number == 1 ? SlaveResult{word, ""} : SlaveResult{{}, "no answer"});
    frame.sent.push_back(std::nullopt);
    return frame;
  }
  std::span<const WordColumn> columns() const override {
    static constexpr WordColumn kColumns[] = {
        {"turns", "turns", 7, true,
         [](const Word& word) { return std::to_string(word.bits >> 4); }},
        {"mark", "!", 1, false,
         [](const Word& word) { return std::string(word.bits & 2 ? "m" : ""); }}};
    return kColumns;
  }
  RegisterMap registers() override { return {}; }
};

const MasterSupport kPlain{.type = "ic-mb4",
                           .check = [](const sim::Scenario& /*scenario*/) {},
                           .open = [](const sim::Scenario& scenario,
                                      const SessionOptions& options) -> std::unique_ptr<Session> {
                             return std::make_unique<PlainSession>(scenario, options);
                           }};

TEST(SessionColumns, OwnColumns_AreThoseOfEveryOutput) {
  const std::unique_ptr<Session> session =
      kPlain.open(sim::parse_scenario(kScenario, "plain.toml"), {});
  FrameReport report(session->simulator().scenario(), session->columns());
  EXPECT_EQ(report.table_header(), "frame       time/us  slave    turns  !  state\n");
  EXPECT_EQ(report.csv_header(), "frame,time_us,slave,turns,mark,state\n");
  report.add(session->read(1), 1, 0);
  EXPECT_EQ(report.table_row(), "    1         0.000      1        2  m  ok\n");
  EXPECT_EQ(report.csv_row(), "1,0.000,1,2,m,ok\n");
  EXPECT_EQ(report.json_row(),
            "\n  {\"frame\": 1, \"time_us\": 0.000, \"slave\": 1, \"good\": true, \"turns\": 2, "
            "\"mark\": \"m\", \"state\": \"ok\"}");
  report.add(session->read(2), 1, 0);
  EXPECT_EQ(report.table_row(), "    2         0.000      1        -  -  no answer\n");
  EXPECT_EQ(report.csv_row(), "2,0.000,1,,,no answer\n");
  EXPECT_EQ(report.json_row(),
            ",\n  {\"frame\": 2, \"time_us\": 0.000, \"slave\": 1, \"good\": false, "
            "\"turns\": null, \"mark\": null, \"state\": \"no answer\"}");
}

// Columns of what the master tells beside the word are filled without one too.
TEST(SessionColumns, ToldWithoutAWord_IsShown) {
  constexpr WordColumn kColumns[] = {
      {"speed", "speed", 5, true, nullptr},
      {"bits", "bits", 4, true, [](const Word& word) { return std::to_string(word.bits); }},
      {"mood", "mood", 4, false, nullptr}};
  FrameReport report(sim::parse_scenario(kScenario, "plain.toml"), kColumns);
  SessionFrame frame;
  frame.results = {{std::nullopt, "lost", {"-3", "odd"}}};
  frame.sent = {std::nullopt};
  report.add(frame, 1, 0);
  EXPECT_EQ(report.csv_row(), "1,0.000,1,-3,,odd,lost\n");
  EXPECT_EQ(report.table_row(), "    1         0.000      1     -3     -   odd  lost\n");
  EXPECT_EQ(report.json_row(),
            "\n  {\"frame\": 1, \"time_us\": 0.000, \"slave\": 1, \"good\": false, \"speed\": -3, "
            "\"bits\": null, \"mood\": \"odd\", \"state\": \"lost\"}");
}

template <typename Error, typename Function>
std::string error_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string scenario_file() {
  std::string path = testing::TempDir() + "plain_master.toml";
  std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  std::fputs(kScenario, file.get());
  return path;
}

TEST(MasterSupport, WithoutCodesOrScan_CommandsSaySo) {
  const std::string path = scenario_file();
  SweepOptions sweep;
  sweep.scenario = path;
  EXPECT_EQ(error_of<UseError>([&] { sweep_command(sweep); }),
            path + ": the master \"ic-mb4\" has no codes of a frequency to sweep");
  ScanOptions scan;
  scan.scenario = path;
  EXPECT_NE(error_of<sim::ScenarioError>([&] { scan_command(scan); }).find("key 'type'"),
            std::string::npos);
}

}  // namespace

const MasterSupport& support_of(const sim::Scenario& /*scenario*/) { return kPlain; }

}  // namespace mb4::tool
