// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "boxstream/explain/price_list.hpp"
#include "process.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/plan.hpp"

namespace boxstream::tool_test {
namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Gallery, IsFoundByNameAndExplained) {
  const Outcome run = run_tool({"simulate", "effects/wind", "--steps", "2"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Outcome plan = run_tool({"explain", "effects/wind"});
  EXPECT_NE(plan.out.find("/fields/0: wind"), std::string::npos) << plan.out;
  EXPECT_EQ(run_tool({"simulate", "effects/magic"}).exit_code, 2);
  EXPECT_EQ(run_tool({"simulate", "meshes/land"}).exit_code, 2) << "no scene";
  EXPECT_EQ(run_tool({"list"}).out.find("effects/"), std::string::npos);
}

TEST(Explain, CallsAPriceNoiseThatIsWithinItOrBelowZero) {
  EXPECT_EQ(tool::cost_text({17.26, 16, 19}, effects::wind), "17.3");
  EXPECT_EQ(tool::cost_text({0.4, -1.26, 2.04}, effects::wind), "within noise: -1.3 to 2.0");
  EXPECT_EQ(tool::cost_text({0.5, 0, 0.75}, effects::sleeping), "within noise: 0.0 to 0.8");
  EXPECT_EQ(tool::cost_text({-3.456, -4, -2}, effects::wind), "noise: -3.46");
  EXPECT_EQ(tool::cost_text({-123.4, -130, -120}, effects::sleeping), "saves 123");
}

TEST(Explain, HasTheRecordedPricesInItsTable) {
  const std::string table = run_tool({"explain", "effects/wind"}).out;
  const auto document = nlohmann::json::parse(run_tool({"explain", "effects/wind", "--json", "-"}).out);
  int prices = 0;
  for (const effects::Effect* const effect : effects::all_effects()) {
    const std::string name = effect->name;
    const auto& rows = document.at("effects");
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& each) { return each["effect"] == name; });
    ASSERT_NE(row, rows.end()) << name;
    if (!row->contains("interval_ns")) continue;
    ++prices;
    const auto& interval = row->at("interval_ns");
    const std::string text = tool::cost_text({row->at("ns_per_body_step"), interval[0], interval[1]}, *effect);
    const std::string line = table.substr(table.find("\n" + name + " ") + 1);
    EXPECT_NE(line.substr(0, line.find('\n')).find(" " + text + "   "), std::string::npos) << name << ": " << text;
  }
  EXPECT_GT(prices, 0);
}

class Prices : public testing::Test {
  void SetUp() override {
    if (tests::sanitized) GTEST_SKIP() << "times and counts are those without sanitizers";
  }
};

TEST_F(Prices, AreThereForEachEffectThatHasOne) {
  ScratchDirectory scratch;
  const std::string page = scratch.file("page.md"), json = scratch.file("prices.json");
  std::ofstream(page) << "Before.\n<!-- prices: begin -->\nold\n<!-- prices: end -->\nAfter.\n";
  const Outcome run = run_tool({"prices", "--quick", "--into", page, "--json", json});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto document = nlohmann::json::parse(text_of(json));
  EXPECT_EQ(document.at("format"), 1);
  EXPECT_NE(document.at("machine").get<std::string>().find("Bullet 3.24"), std::string::npos);
  const std::string written = text_of(page);
  EXPECT_TRUE(written.starts_with("Before.\n<!-- prices: begin -->\nMeasured on ")) << written;
  EXPECT_TRUE(written.ends_with("\n<!-- prices: end -->\nAfter.\n")) << written;
  EXPECT_EQ(written.find("old"), std::string::npos);
  for (const effects::Effect* const effect : effects::all_effects()) {
    EXPECT_NE(written.find("\n| " + std::string(effect->name) + " | "), std::string::npos) << effect->name;
    EXPECT_NE(run.out.find("\n" + std::string(effect->name) + " "), std::string::npos) << effect->name;
  }
  const auto& prices = document.at("effects");
  // What must show even on a busy machine: contacts are pairs, joints take memory, and cloth is dear.
  EXPECT_GE(prices.at("contacts").at("pairs_per_body").get<double>(), 1);
#if !defined(__SANITIZE_ADDRESS__)  // which has a heap of its own, that the tool cannot ask
  EXPECT_GT(prices.at("joints").at("bytes_per_body").get<double>(), 100);
#endif
  EXPECT_GT(prices.at("soft_bodies").at("ns_per_body_step").get<double>(), 100);
  EXPECT_FALSE(prices.at("planes").contains("uncalled_ns_per_body_step")) << "a kind of shape has no code of its own";
}

TEST_F(Prices, KeepTheInstructionsThatWereCounted) {
  ScratchDirectory scratch;
  const std::string json = scratch.file("prices.json");
  std::ofstream(json)
      << R"({"format": 1, "counted": "here", "effects": {"wind": {"instructions_per_body_step": 12.5}}})";
  const Outcome run = run_tool({"prices", "--quick", "--json", json});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto wind = nlohmann::json::parse(text_of(json)).at("effects").at("wind");
  EXPECT_EQ(wind.at("instructions_per_body_step"), 12.5);
  EXPECT_TRUE(wind.contains("ns_per_body_step"));
  EXPECT_NE(run.out.find(" 12.5 "), std::string::npos) << run.out;
}

TEST_F(Prices, TakeNoOtherFilesPlace) {
  ScratchDirectory scratch;
  const std::string json = scratch.file("list.json");
  std::ofstream(json) << "[1]";
  const Outcome run = run_tool({"prices", "--quick", "--json", json});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("list.json: no list of prices"), std::string::npos) << run.err;
  EXPECT_EQ(text_of(json), "[1]");
}

TEST_F(Prices, GoIntoAPageWithMarksOnly) {
  ScratchDirectory scratch;
  const std::string page = scratch.file("page.md");
  std::ofstream(page) << "No marks.\n";
  const Outcome run = run_tool({"prices", "--quick", "--into", page});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("page.md: no lines \"<!-- prices: begin -->\""), std::string::npos) << run.err;
  EXPECT_EQ(text_of(page), "No marks.\n");
}

}  // namespace
}  // namespace boxstream::tool_test
