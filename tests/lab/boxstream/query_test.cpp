// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "pictures/drawing/png_file.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using Json = nlohmann::json;

TEST(Query, HelpNamesOptionsAndManagers) {
  const Outcome help = run_tool({"query", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* const word : {"--manager", "--compare", "--steps", "--scale", "--json", "--picture", "Examples",
                                 "tree_array", "ssap", "naive", "Exit code"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST(Query, TableOfAComparison) {
  const Outcome run = run_tool({"query", "query_bins", "--scale", "0.1", "--steps", "10", "--compare", "naive"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lasting_words(run), "");
  for (const char* const part :
       {"bin 55 (50 move)", "gripper 4 (4 move)", "boxstream ", "naive ", "gripper clearance", "parts in contact",
        "register, once", "answers equal yes, of all queries in every step"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " in " << run.out;
}

TEST(Query, JsonAddsUp) {
  const ScratchDirectory directory;
  const Outcome run = run_tool({"query", "query_arm", "--scale", "0.05", "--steps", "12", "--manager", "tree",
                                "--compare", "boxstream", "--json", directory.file("out.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(directory.count(), 1U);
  const Json result = Json::parse(directory.read("out.json"));
  EXPECT_EQ(result.at("format"), 1);
  EXPECT_EQ(result.at("answers_equal"), true);
  EXPECT_EQ(result.at("meta").at("objects"), 258);
  ASSERT_EQ(result.at("managers").size(), 2U);
  EXPECT_EQ(result.at("managers")[0].at("manager"), "tree");
  EXPECT_EQ(result.at("managers")[1].at("manager"), "boxstream");
  for (const Json& manager : result.at("managers")) {
    ASSERT_EQ(manager.at("steps").size(), 12U);
    for (std::size_t q = 0; q < manager.at("queries").size(); ++q) {
      const Json& query = manager.at("queries")[q];
      std::uint64_t callbacks = 0, pairs = 0, contacts = 0;
      double narrow = 0;
      for (const Json& step : manager.at("steps")) {
        callbacks += step.at("queries")[q].at("callbacks").get<std::uint64_t>();
        pairs += step.at("queries")[q].at("pairs").get<std::uint64_t>();
        contacts += step.at("queries")[q].at("contacts").get<std::uint64_t>();
        narrow += step.at("queries")[q].at("narrow_ms").get<double>();
      }
      EXPECT_EQ(query.at("callbacks"), callbacks);
      EXPECT_EQ(query.at("pairs"), pairs);
      EXPECT_EQ(query.at("contacts"), contacts);
      EXPECT_NEAR(query.at("narrow").at("total_ms").get<double>(), narrow, 1e-6 * (1 + narrow));
    }
  }
  const Json to_stdout =
      Json::parse(run_tool({"query", "query_arm", "--scale", "0.05", "--steps", "2", "--json", "-"}).out);
  EXPECT_FALSE(to_stdout.contains("answers_equal"));
}

TEST(Query, Picture) {
  const ScratchDirectory directory;
  const Outcome run = run_tool({"query", "query_bins", "--scale", "0.1", "--steps", "4", "--compare", "tree",
                                "--picture", directory.file("out.png")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(directory.count(), 1U);
  const picture::Image image = picture::read_png(directory.file("out.png"));
  EXPECT_EQ(image.width, 1600);
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
    colours.insert(std::uint32_t{image.rgb[i]} << 16 | std::uint32_t{image.rgb[i + 1]} << 8 | image.rgb[i + 2]);
  EXPECT_GT(colours.size(), 1000U);
}

TEST(Query, StatusLineOnATerminal) {
  const Outcome run = run_tool({"query", "query_convoy", "--steps", "120", "--scale", "0.3"}, {"", true});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("step "), std::string::npos);
  EXPECT_TRUE(run.err.ends_with("\r\x1b[K"));
}

/// Exit code 2, nothing on standard output, and one line on standard error that has all of `parts`.
void expect_refusal(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
  const Outcome outcome = run_tool(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " in " << outcome.err;
}

TEST(Query, BadInputIsOneLine) {
  const ScratchDirectory directory;
  expect_refusal({"query"}, {"SCENE"});
  expect_refusal({"query", "pile"}, {"pile: has no queries", "boxstream simulate pile"});
  expect_refusal({"simulate", "query_arm"}, {"query_arm: is a scene of queries", "boxstream query query_arm"});
  expect_refusal({"query", "query_arm", "--manager", "treee"}, {"'treee'", "did you mean 'tree'?"});
  expect_refusal({"query", "query_arm", "--compare", "x"},
                 {"'x'", "boxstream, boxstream_tight, hybrid, tree, tree_array", "naive"});
  expect_refusal({"query", "query_arm", "--steps", "0"}, {"--steps"});
  expect_refusal({"query", "query_arm", "--scale", "-1"}, {"--scale"});
  expect_refusal({"query", "query_arm", "--json", directory.file("no/such/out.json")}, {"No such file"});
  expect_refusal({"query", "query_arm", "--picture", directory.file("out.jpg")}, {"out.jpg", ".png", ".svg"});
  const std::string same = directory.file("out.png");
  expect_refusal({"query", "query_arm", "--json", same, "--picture", same}, {"named for two outputs"});
  expect_refusal({"query", directory.file("none.json")}, {"none.json: cannot be read: No such file"});
  const std::string bad = directory.write("bad.json", R"({"format": 1, "meta": {"name": "x", "about": 3}})");
  expect_refusal({"query", bad, "--json", directory.file("out.json")}, {bad + ": /meta/about: expected a string"});
  EXPECT_EQ(directory.count(), 1U) << "something was written";
}

}  // namespace
}  // namespace boxstream::tool_test
