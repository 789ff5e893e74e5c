// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pictures/viewer/page.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"
#include "source_path.hpp"

namespace boxstream::tool_test {
namespace {

using Json = nlohmann::json;

const std::string mixed = tests::source_path("tests/lab/pictures/mixed.json");

std::vector<std::string> hashes(const Json& result) {
  std::vector<std::string> list;
  for (const Json& step : result.at("worlds").at(0).at("steps")) list.push_back(step.at("state_hash"));
  return list;
}

TEST(ViewCommand, RecordingsAppearAndTheRunIsTheSame) {
  const ScratchDirectory directory;
  std::vector<std::string> words{"simulate", mixed, "--steps", "40", "--json", "-"};
  const Outcome plain = run_tool(words);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;

  std::vector<std::string> files{"a.glb", "b.glb", "run.json"};
  words.insert(words.end(), {"--record", directory.file("a.glb"), "--record", directory.file("b.glb")});
  words.insert(words.end(), {"--trace", directory.file("run.json")});
  if (view::has_pages()) {
    words.insert(words.end(), {"--view", directory.file("run.html"), "--view-every", "3"});
    files.push_back("run.html");
  }
  const Outcome recorded = run_tool(words);
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  EXPECT_EQ(lasting_words(recorded), "");
  EXPECT_EQ(hashes(Json::parse(plain.out)), hashes(Json::parse(recorded.out)));
  EXPECT_EQ(hashes(Json::parse(plain.out)).size(), 40U);
  for (const std::string& file : files) EXPECT_GT(directory.read(file).size(), 1000U) << file;
  EXPECT_EQ(directory.count(), files.size());
  EXPECT_EQ(directory.read("a.glb"), directory.read("b.glb"));
}

TEST(ViewCommand, TheTraceHasBothWorldsOfAComparison) {
  const ScratchDirectory directory;
  const Outcome outcome =
      run_tool({"simulate", mixed, "--steps", "5", "--compare", "dbvt", "--trace", directory.file("run.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json trace = Json::parse(directory.read("run.json"));
  std::vector<std::string> names;
  for (const Json& event : trace.at("traceEvents"))
    if (event.at("name") == "process_name") names.push_back(event.at("args").at("name"));
  EXPECT_EQ(names, (std::vector<std::string>{"mixed on boxstream", "mixed on dbvt"}));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ViewCommand, ThePageHasBothWorldsOfAComparison) {
  if (!view::has_pages()) GTEST_SKIP() << "the viewer was not built in";
  const ScratchDirectory directory;
  const Outcome outcome =
      run_tool({"simulate", mixed, "--steps", "5", "--compare", "dbvt", "--view", directory.file("run.html")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(count_of(directory.read("run.html"), "id=\"world-"), 2U);
}

#ifdef BOXSTREAM_HAS_ACCURACY
TEST(ViewCommand, AccuracyShowsTwoSettings) {
  if (!view::has_pages()) GTEST_SKIP() << "the viewer was not built in";
  const ScratchDirectory directory;
  std::vector<std::string> words{"accuracy",  mixed, "--steps", "6",
                                 "--repeats", "1",   "--view",  directory.file("run.html")};
  words.insert(words.end(), {"--knob", "dt=1/60,1/120"});
  const Outcome outcome = run_tool(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(count_of(directory.read("run.html"), "id=\"world-"), 2U);
  words.back() = "dt=1/60";
  const Outcome alone = run_tool(words);
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("shows two settings, and there is one"), std::string::npos) << alone.err;
}
#endif

struct Refusal {
  std::vector<std::string> words;
  std::string reason;
};

TEST(ViewCommand, RefusesInOneLineAndWritesNothing) {
  const ScratchDirectory directory;
  std::vector<Refusal> refusals{
      {{"--record", directory.file("a.gltf")}, "expected a file FILE.aabbs or FILE.glb"},
      {{"--record", directory.file("a.glb"), "--record", directory.file("a.glb")}, "named for two outputs"},
      {{"--record", directory.file("no/a.glb")}, "cannot be written"},
      {{"--trace", directory.file("a.txt")}, "must end in .json"},
      {{"--trace", directory.file("a.json"), "--json", directory.file("a.json")}, "named for two outputs"},
      {{"--record-every", "2"}, "--record-every: goes with --record"},
      {{"--view-every", "2"}, "--view-every: goes with --view"},
      {{"--view-bodies", "2"}, "--view-bodies: goes with --view"},
      {{"--view", directory.file("a.html"), "--view-bodies", "0"}, "--view-bodies"},
      {{"--view", directory.file("a.htm")}, "must end in .html"},
      {{"--view", directory.file("a.html"), "--view-every", "0"}, "--view-every"}};
  if (view::has_pages())
    refusals.push_back({{"--view", directory.file("no/a.html")}, "cannot be written"});
  else
    refusals.push_back({{"--view", directory.file("a.html")}, "built without the viewer, which takes node and npm"});
  for (const Refusal& refusal : refusals) {
    std::vector<std::string> words{"simulate", mixed, "--steps", "2"};
    words.insert(words.end(), refusal.words.begin(), refusal.words.end());
    const Outcome outcome = run_tool(words);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(refusal.reason), std::string::npos) << outcome.err;
    EXPECT_EQ(directory.count(), 0U);
  }
}

}  // namespace
}  // namespace boxstream::tool_test
