// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "boxstream/accuracy/accuracy_writers.hpp"
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
    // A second's fall in steps of h is g h / 2 too deep. The reference is the sum of 7680 steps, each rounded by up to
    // half a unit in the last place of 10.
    const double h = 1.0 / 60 / (i < 2 ? 1 : 2);
    EXPECT_NEAR(settings[i].at("measures").at("trajectory").at("last"), 9.81 / 2 * (h - 1.0 / 60 / 128),
                7680 * 0x1p-21);
    EXPECT_GT(settings[i].at("ms_per_s").at("median"), 0);
    EXPECT_NE(run.out.find(i < 2 ? "substeps=1 iterations=" : "substeps=2 iterations="), std::string::npos) << run.out;
    // The scene's checks are about its own step.
    EXPECT_EQ(settings[i].contains("unsound"), i >= 2);
  }
  EXPECT_NE(run.out.find("reference  128 substeps of 100 iterations"), std::string::npos) << run.out;
  const auto& lines = document.at("precision").at("trajectory").at("lines");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1].at("name"), "substeps=2");
  EXPECT_NE(text_of(plot).find("<svg"), std::string::npos);
}

/// The error of the only setting, with these words.
double error_of_run(const std::string& scene, const std::vector<std::string>& words, const std::string& metric) {
  std::vector<std::string> all{"accuracy", scene, "--knob", "substeps=1", "--repeats", "1", "--json", "-"};
  all.insert(all.end(), words.begin(), words.end());
  const Outcome run = run_tool(all);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out).at("settings").at(0).at("errors").at(metric).at("value").get<double>();
}

TEST(Accuracy, TakesTruthAsANumberAPointerAClosedFormOrAFile) {
  // After a second in steps of 1/60 s the ball is 10 - 9.81 / 2 (1 + 1/60) high, 81.75 mm too low.
  const double height = 10 - 9.81 / 2 * (1 + 1.0 / 60);
  const std::string ball = "hard/free_fall";
  EXPECT_NEAR(error_of_run(ball, {"--truth", "5.095", "--metric", "y.last", "--body", "ball"}, "y.last"),
              5.095 - height, 2e-5);
  // A kilogram 10 m above the origin.
  EXPECT_NEAR(error_of_run(ball, {"--truth", "/worlds/0/energy/start_j=98"}, "/worlds/0/energy/start_j"), 0.1, 1e-4);
  // 19.62 m by its name: what the ball falls in two seconds.
  EXPECT_NEAR(error_of_run(ball, {"--truth", "free_fall", "--metric", "y.last", "--body", "ball"}, "y.last"),
              19.62 - height, 2e-5);
  ScratchDirectory scratch;
  const std::string file = scratch.file("fall.csv");
  std::ofstream(file) << "seconds,x,y,z\n1,0,5.095,0\n";
  EXPECT_NEAR(error_of_run(ball, {"--truth", file, "--body", "ball"}, "truth"), 5.095 - height, 2e-5);
}

TEST(Accuracy, SaysWhatIsWrongWithATruth) {
  const auto refused = [](const std::vector<std::string>& words, const std::string& reason) {
    std::vector<std::string> all{"accuracy", "hard/free_fall", "--knob", "substeps=1"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome run = run_tool(all);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(lines_in(run.err), 1u) << run.err;
    EXPECT_NE(run.err.find(reason), std::string::npos) << run.err;
  };
  refused({"--truth", "free_fal"}, "did you mean 'free_fall'?");
  refused({"--truth", "free_fall"}, "of which --metric? It is 19.62 m");
  refused({"--truth", "/worlds/0=x"}, "no number behind the =");
  refused({"--truth", "no.csv", "--body", "ball"}, "no.csv: No such file or directory");
  refused({"--joint", "3", "--metric", "joint_error"}, "--joint 3: there is none; the scene has 0");
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

TEST(Accuracy, SettlesOrSaysThatItCannot) {
  const auto run = [](const char* steps) {
    return run_tool({"accuracy", "hard/tiny_boxes", "--knob", "iterations=10", "--steps", "5", "--repeats", "1",
                     "--metric", "height_loss", "--settle", steps, "--json", "-"});
  };
  const Outcome falling = run("5");
  EXPECT_EQ(falling.exit_code, 2);
  EXPECT_NE(falling.err.find("does not come to rest in 5 steps"), std::string::npos) << falling.err;
  EXPECT_EQ(lines_in(falling.err), 1u) << falling.err;
  const Outcome settled = run("300");
  ASSERT_EQ(settled.exit_code, 0) << settled.err;
  EXPECT_EQ(nlohmann::json::parse(settled.out).at("settled_steps"), 300);
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
  result.front = tool::front_of(result);
  return result;
}

TEST(AccuracyReport, KeepsWhatFailed) {
  const tool::AccuracyResult result = with_a_failure();
  EXPECT_NE(tool::accuracy_table(result).find("failed: a coordinate is not finite after step 7\n"), std::string::npos);
  EXPECT_NE(tool::accuracy_csv(result).find(",0,a coordinate is not finite after step 7,\n"), std::string::npos);
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
  const std::string page = scratch.file("a page.html"), other = scratch.file("a.txt");
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
  const auto& table = document.at("experiments").at(0).at("table");
  EXPECT_EQ(table.at("points").size(), 2u);
  EXPECT_EQ(table.at("facts").at("command"),
            "boxstream accuracy hard/free_fall --knob substeps=1,2 --repeats 1 --page '" + page + "'");
}

/// Settings that are the dearer the later they come, with these values.
tool::AccuracyResult with_values(const std::vector<std::string>& metrics,
                                 const std::vector<std::vector<double>>& rows) {
  tool::AccuracyResult result;
  result.sweep.scene.name = "made";
  result.request.knobs = {accuracy::parse_knob("substeps=1,2,4,8")};
  for (const std::string& metric : metrics) result.request.measures.push_back(accuracy::parse_measure(metric));
  for (const std::vector<double>& values : rows) {
    accuracy::Row row;
    const int substeps = 1 << result.sweep.rows.size();
    row.setting = {substeps};
    row.label = "substeps=" + std::to_string(substeps);
    row.ms = {1.0 * substeps, 1.0 * substeps, 1.0 * substeps};
    for (const double value : values) row.series.push_back({value, value, value, value, value});
    result.sweep.rows.push_back(row);
  }
  result.front = tool::front_of(result);
  return result;
}

using Places = std::vector<std::size_t>;

TEST(AccuracyReport, StarsTheFront) {
  const std::string table = tool::accuracy_table(with_a_failure());
  EXPECT_NE(table.find("\n* substeps=1 "), std::string::npos) << table;
  EXPECT_NE(table.find("\n! substeps=2 "), std::string::npos) << table;
  EXPECT_NE(table.find("\n* substeps=4 "), std::string::npos) << table;
}

TEST(AccuracyReport, WhatIsNotSoundHasNoStarAndIsNotAdvised) {
  tool::AccuracyResult result = with_values({"penetration"}, {{3}, {1}, {2}});
  result.sweep.rows[1].unsound = "gains 3 J that no work explains";
  result.front = tool::front_of(result);
  EXPECT_EQ(result.front, (Places{0, 2}));
  result.bound = 2.5;
  EXPECT_EQ(tool::advised(result), 2u);
  const std::string table = tool::accuracy_table(result);
  EXPECT_NE(table.find("\n! substeps=2 "), std::string::npos) << table;
  EXPECT_NE(table.find("  gains 3 J that no work explains\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\nadvice     substeps=4: the cheapest that is sound with penetration of at most 2.5"),
            std::string::npos)
      << table;
  const auto experiment = nlohmann::json::parse(tool::accuracy_page_json(result, "")).at("experiments")[0];
  EXPECT_EQ(experiment.at("table").at("points")[1][10], "not sound: gains 3 J that no work explains");
  EXPECT_EQ(experiment.at("take"), 2);
  EXPECT_EQ(experiment.at("plots")[0].at("bound"), 2.5);
  EXPECT_EQ(experiment.at("plots")[0].at("front"), (Places{0, 2}));
}

TEST(AccuracyReport, SaysThatABoundIsBelowWhatTheReferenceCanTell) {
  tool::AccuracyResult result = with_values({"trajectory"}, {{0.03}, {0.001}});
  for (accuracy::Row& row : result.sweep.rows) row.bands = {0.002};
  result.bound = 0.01;
  EXPECT_EQ(tool::accuracy_table(result).find("is not known"), std::string::npos);
  result.bound = 0.0015;
  EXPECT_NE(
      tool::accuracy_table(result).find("\nbound      0.0015 is less than the 0.002 that the reference may be off by"),
      std::string::npos)
      << tool::accuracy_table(result);
}

TEST(AccuracyReport, FrontIsOfWhatIsBetterForTheMetric) {
  EXPECT_EQ(with_values({"penetration"}, {{5}, {4}, {4}}).front, (Places{0, 1}));
  EXPECT_EQ(with_values({"agrees_for"}, {{0.467}, {0.4}, {5}}).front, (Places{0, 2}));
  EXPECT_EQ(with_values({"repeatable"}, {{0}, {1}}).front, (Places{0, 1}));
  EXPECT_EQ(with_values({"energy_change"}, {{0.5}, {-0.9}, {-0.1}}).front, (Places{0, 2}));
  const auto page = nlohmann::json::parse(tool::accuracy_page_json(with_values({"agrees_for"}, {{1}}), ""));
  EXPECT_EQ(page.at("experiments")[0].at("plots")[0].at("better"), "high");
}

TEST(AccuracyReport, LeavesOutWhatDoesNotApplyAndSaysSo) {
  const double none = std::nan("");
  const tool::AccuracyResult result =
      with_values({"joint_error", "momentum_drift", "penetration"}, {{none, HUGE_VAL, 3}, {none, HUGE_VAL, 2}});
  EXPECT_EQ(tool::applicable(result), Places{2});
  EXPECT_EQ(result.front, (Places{0, 1}));
  const std::string table = tool::accuracy_table(result);
  EXPECT_EQ(table.find("nan"), std::string::npos) << table;
  EXPECT_NE(table.find("\njoint_error does not apply to this scene: it needs joints\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\nmomentum_drift does not apply to this scene: it needs a momentum at the start\n"),
            std::string::npos)
      << table;
  EXPECT_EQ(tool::accuracy_plot(result).lines[0].points[1].y, 2);
  const auto experiment = nlohmann::json::parse(tool::accuracy_page_json(result, "")).at("experiments")[0];
  EXPECT_EQ(experiment.at("table").at("metrics"), nlohmann::json::array({"penetration"}));
  EXPECT_EQ(experiment.at("table").at("points")[1][9], nlohmann::json::array({2}));
  EXPECT_EQ(experiment.at("notes")[0].at("metric"), "joint_error");
  for (const auto& plot : experiment.at("plots")) EXPECT_EQ(plot.at("y"), "penetration");
}

TEST(AccuracyReport, NothingIsStarredWhereNothingApplies) {
  const tool::AccuracyResult result = with_values({"joint_error"}, {{std::nan("")}, {std::nan("")}});
  EXPECT_EQ(tool::judge(result), nullptr);
  EXPECT_EQ(tool::accuracy_table(result).find('*'), std::string::npos);
}

TEST(AccuracyReport, HintsAtErrorsThatNoSettingChanges) {
  const auto noted = [](tool::AccuracyResult result, std::uint64_t settled = 0) {
    if (settled > 0) {
      result.request.settling = accuracy::Settling{{}, settled};
      EXPECT_NE(tool::accuracy_table(result).find("after 100 steps to come to rest"), std::string::npos);
    }
    std::string text;
    for (const auto& [name, what] : tool::notes(result)) text += name + " " + what + "\n";
    return text;
  };
  const auto fall = with_values({"height_loss", "stands"}, {{0.8808, 1}, {0.8807, 1}});
  EXPECT_NE(noted(fall).find("height_loss is the same at all settings"), std::string::npos);
  EXPECT_NE(noted(fall).find("--settle"), std::string::npos);
  EXPECT_EQ(noted(fall, 100).find("--settle"), std::string::npos);
  EXPECT_EQ(noted(fall).find("stands"), std::string::npos);
  EXPECT_EQ(noted(with_values({"height_loss"}, {{0.88}, {0.8}})), "");
  EXPECT_EQ(noted(with_values({"penetration"}, {{0}, {0}})), "");
}

TEST(AccuracyPage, ComparesWithTheSceneAsItIs) {
  const auto compared = [](std::optional<std::size_t> own) {
    tool::AccuracyResult result = with_values({"penetration"}, {{3}, {2}, {1}});
    result.sweep.own = own;
    return nlohmann::json::parse(tool::accuracy_page_json(result, "")).at("experiments")[0].at("default");
  };
  EXPECT_EQ(compared(2), nlohmann::json::parse(R"({"series": "", "setting": "4", "own": true})"));
  EXPECT_EQ(compared(std::nullopt), nlohmann::json::parse(R"({"series": "", "setting": "1", "own": false})"));
}

}  // namespace
}  // namespace boxstream::tool_test
