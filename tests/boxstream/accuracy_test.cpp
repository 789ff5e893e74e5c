// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "boxstream/accuracy/accuracy_page.hpp"
#include "boxstream/accuracy/accuracy_report.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Accuracy, WritesTableFileAndPlotOfEverySetting) {
  ScratchDirectory scratch;
  const std::string csv = scratch.file("a.csv"), json = scratch.file("a.json"), plot = scratch.file("a.svg");
  const Outcome run =
      run_tool({"accuracy", "hard/free_fall", "--knob", "substeps=1,2", "--knob", "iterations=5,10", "--metric",
                "trajectory", "--metric", "max_speed", "--repeats", "3", "--csv", csv, "--json", json, "--plot", plot});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lasting_words(run), "");
  EXPECT_EQ(lines_in(text_of(csv)), 5u);
  const auto document = nlohmann::json::parse(text_of(json));
  const auto& settings = document.at("settings");
  ASSERT_EQ(settings.size(), 4u);
  EXPECT_EQ(settings[1].at("knobs"), (nlohmann::json{{"substeps", 1}, {"iterations", 10}}));
  for (std::size_t i = 0; i < 4; ++i) {
    // A second's fall in steps of h is g h / 2 too deep. The reference is the sum of 3840 steps, each rounded by up to
    // half a unit in the last place of 10.
    const double h = 1.0 / 60 / (i < 2 ? 1 : 2);
    EXPECT_NEAR(settings[i].at("measures").at("trajectory").at("last"), 9.81 / 2 * (h - 1.0 / 60 / 64), 3840 * 0x1p-21);
    EXPECT_GT(settings[i].at("ms_per_s").at("median"), 0);
    EXPECT_NE(run.out.find(i < 2 ? "substeps=1 iterations=" : "substeps=2 iterations="), std::string::npos) << run.out;
  }
  EXPECT_NE(text_of(plot).find("<svg"), std::string::npos);
}

TEST(Accuracy, RefusesInOneLine) {
  ScratchDirectory scratch;
  const std::string csv = scratch.file("a.csv");
  const auto refused = [&](const std::string& knob, const std::string& metric, const std::string& reason) {
    const Outcome run = run_tool({"accuracy", "hard/free_fall", "--knob", knob, "--metric", metric, "--csv", csv});
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(lines_in(run.err), 1u) << run.err;
    EXPECT_NE(run.err.find(reason), std::string::npos) << run.err;
    EXPECT_FALSE(std::ifstream(csv).good());
  };
  refused("speed=1", "lowest", "unknown knob 'speed'; there are ");
  refused("substeps=0", "lowest", "/time/substeps: ");
  refused("substeps=1", "beauty", "unknown metric 'beauty'; there are ");
  refused("/bodies/9/mass=1", "lowest", "the scene has no such place");
}

/// Three settings, of which one failed.
tool::AccuracyResult with_a_failure() {
  tool::AccuracyResult result;
  result.sweep.scene.name = "made";
  result.request.knobs = {accuracy::parse_knob("substeps=1,2,4")};
  result.request.measures = {accuracy::parse_measure("penetration")};
  for (int i = 0; i < 3; ++i) {
    accuracy::Row row;
    row.setting = {1 << i};
    row.label = "substeps=" + std::to_string(1 << i);
    row.ms = {1.0 + i, 1, 4};
    row.series = {{3.0 - i, 0, 0, 0}};
    result.sweep.rows.push_back(row);
  }
  result.sweep.rows[1].failure = "a coordinate is not finite after step 7";
  result.sweep.rows[1].series[0].worst = std::nan("");
  result.front = {0, 2};
  return result;
}

TEST(AccuracyReport, KeepsWhatFailed) {
  const tool::AccuracyResult result = with_a_failure();
  EXPECT_NE(tool::accuracy_table(result).find("failed: a coordinate is not finite after step 7\n"), std::string::npos);
  EXPECT_NE(tool::accuracy_csv(result).find(",0,a coordinate is not finite after step 7\n"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(tool::accuracy_json(result)).at("settings").at(1).at("failure"),
            "a coordinate is not finite after step 7");
  const picture::Plot plot = tool::accuracy_plot(result);
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_TRUE(plot.lines[0].points[1].failed);
  EXPECT_EQ(plot.lines[0].points[2].label, "4");
  EXPECT_EQ(plot.lines[1].name, "front");
}

TEST(AccuracyPage, HasEveryRowInTheOrderOfTheReport) {
  tool::AccuracyResult result = with_a_failure();
  result.sweep.scene.about = "about </script>";
  const auto document = nlohmann::json::parse(tool::accuracy_page_json(result, "AAAA"));
  EXPECT_EQ(document.at("kind"), "scene");
  EXPECT_EQ(document.at("pictures").at("made"), "data:image/png;base64,AAAA");
  const auto& experiment = document.at("experiments").at(0);
  EXPECT_EQ(experiment.at("knobs").at("made"), "substeps");
  const auto& table = experiment.at("table");
  EXPECT_EQ(table.at("metrics"), nlohmann::json::array({"penetration"}));
  EXPECT_EQ(table.at("controls"), nlohmann::json::parse(R"([["made", 0.0]])"));
  ASSERT_EQ(table.at("points").size(), 3u);
  EXPECT_EQ(table.at("points")[0],
            nlohmann::json::parse(R"(["made", "", "1", 1, 1.0, 1.0, 4.0, null, null, [3.0], ""])"));
  EXPECT_EQ(table.at("points")[1][9], nlohmann::json::array({nullptr}));
  EXPECT_EQ(table.at("points")[1][10], "a coordinate is not finite after step 7");
}

TEST(AccuracyPage, IsWrittenOrRefusedInOneLine) {
  ScratchDirectory scratch;
  const std::string page = scratch.file("a.html"), other = scratch.file("a.txt");
  const auto run = [](const std::string& file) {
    return run_tool({"accuracy", "hard/free_fall", "--knob", "substeps=1,2", "--repeats", "1", "--page", file});
  };
  EXPECT_EQ(run(other).exit_code, 2);
  EXPECT_FALSE(std::ifstream(other).good());
  if (!tool::has_accuracy_page()) GTEST_SKIP() << "the page was not built in";
  const Outcome made = run(page);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string text = text_of(page), mark = "id=\"data\">";
  const std::size_t begin = text.find(mark) + mark.size();
  const auto document = nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
  EXPECT_EQ(document.at("experiments").at(0).at("table").at("points").size(), 2u);
}

TEST(AccuracyReport, StarsTheFront) {
  const std::string table = tool::accuracy_table(with_a_failure());
  EXPECT_NE(table.find("\n* substeps=1 "), std::string::npos) << table;
  EXPECT_NE(table.find("\n  substeps=2 "), std::string::npos) << table;
  EXPECT_NE(table.find("\n* substeps=4 "), std::string::npos) << table;
}

}  // namespace
}  // namespace boxstream::tool_test
