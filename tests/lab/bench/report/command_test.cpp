// SPDX-License-Identifier: MIT
// boxstream_report as ./dev report runs it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "process.hpp"

namespace boxstream::report {
namespace {

namespace fs = std::filesystem;
using tool_test::Outcome;

class Command : public testing::Test {
 protected:
  Command() {
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  ~Command() override { fs::remove_all(directory_); }

  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
    return (directory_ / name).string();
  }

  /// One scene with few bodies, and one setting.
  std::string good() const {
    return file("good.json", R"({"title": "T", "kind": "scene", "measure": {
      "scenes": ["demos/scenes/wall.json"], "steps": 2, "knobs": {"iterations": [1, 4]}, "metrics": ["penetration"]}})");
  }

  Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--repeats", "1", "--into", into().string()});
    return tool_test::run_tool(arguments);
  }

  /// Refused in one line, with nothing written.
  void expect_refused(const std::string& bad, const std::string& part) const {
    const Outcome outcome = run({good(), bad});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(into()));
  }

  fs::path into() const { return directory_ / "tables"; }

  const fs::path directory_ = fs::temp_directory_path() / ("boxstream-report-" + std::to_string(getpid()));
};

TEST_F(Command, WritesATable) {
  const Outcome outcome = run({good()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("good: 2 points, 0 failed"), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::exists(into() / "good.csv"));
}

/// 90 km up, where floats are 8 mm apart: a cube of 10 cm.
TEST_F(Command, RunsWorldsInBothPrecisions) {
  const Outcome outcome = run({"bench/report/experiments/S13.json", "--smoke"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::ifstream table(into() / "S13.csv");
  double single = -1, twice = -1;
  for (std::string line; std::getline(table, line);) {
    if (line.find("built without doubles") != std::string::npos) GTEST_SKIP() << line;
    std::vector<std::string> cells;
    std::stringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    if (cells.size() > 9 && cells[1].starts_with("precision=single")) single = std::stod(cells[9]);
    if (cells.size() > 9 && cells[1].starts_with("precision=double")) twice = std::stod(cells[9]);
  }
  EXPECT_GT(single, 0.01);
  EXPECT_GE(twice, 0);
  EXPECT_LT(twice, 0.001);
}

TEST_F(Command, RefusesAnUnknownKindBeforeItMeasures) {
  expect_refused(file("bad.json", R"({"title": "T", "kind": "magic"})"), "no kind \"magic\" here; there are:");
}

TEST_F(Command, RefusesWhatIsNoJson) {
  expect_refused(file("bad.json", "{"), "bad.json: ");
}

TEST_F(Command, RefusesSettingsThatItsKindDoesNotUnderstand) {
  const std::string bad = file("bad.json", R"({"title": "T", "kind": "scene", "measure": {
    "scenes": ["demos/scenes/wall.json"], "knobs": {"iterations": [1]}, "metrics": ["beauty"]}})");
  const Outcome outcome = run({bad});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("bad.json: unknown metric 'beauty'"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(into()));
}

TEST_F(Command, RefusesASceneThatIsNotThere) {
  const std::string bad = file("bad.json", R"({"title": "T", "kind": "scene", "measure": {
    "scenes": ["demos/scenes/nowhere.json"], "knobs": {"iterations": [1]}, "metrics": ["penetration"]}})");
  const Outcome outcome = run({bad});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(outcome.err.rfind(bad + ": ", 0), 0U) << outcome.err;
}

TEST_F(Command, RefusesAValueThatTheSceneCannotHave) {
  const std::string bad = file("bad.json", R"({"title": "T", "kind": "scene", "measure": {
    "scenes": ["demos/scenes/wall.json"], "knobs": {"iterations": [-1]}, "metrics": ["penetration"]}})");
  const Outcome outcome = run({bad});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("iterations"), std::string::npos) << outcome.err;
}

TEST_F(Command, HasHelp) {
  const Outcome outcome = tool_test::run_tool({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("--smoke"), std::string::npos);
}

}  // namespace
}  // namespace boxstream::report
