// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/scene_json/load_scene.hpp"
#include "pictures/drawing/png_file.hpp"
#include "process.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using Json = nlohmann::json;

TEST(Command, HelpAndVersion) {
  const Outcome help = run_tool({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* const word : {"simulate", "replay", "aabbs", "list", "pairs", "--version", "Examples"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  const Outcome simulate = run_tool({"simulate", "--help"});
  EXPECT_EQ(simulate.exit_code, 0);
  for (const char* const word : {"--broadphase", "--compare", "--steps", "--scale", "--json", "--picture", "--log",
                                 "--record", "Examples", "drift"})
    EXPECT_NE(simulate.out.find(word), std::string::npos) << word;
  EXPECT_EQ(run_tool({"pairs", "--help"}).exit_code, 0);
  const Outcome version = run_tool({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.out.starts_with("boxstream " BOXSTREAM_TEST_VERSION " ")) << version.out;
}

/// Of the scenes that are simulated, or of those that are queried.
std::vector<std::string> scene_names(bool queries = false) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped()))
    if (entry.path().extension() == ".json" && entry.path().stem().string().starts_with("query_") == queries)
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Command, ListNamesEachSceneOnce) {
  const Outcome list = run_tool({"list"});
  ASSERT_EQ(list.exit_code, 0) << list.err;
  std::vector<std::string> listed;
  std::istringstream lines(list.out);
  for (std::string line; std::getline(lines, line);) listed.push_back(line.substr(0, line.find(' ')));
  std::vector<std::string> expected = scene_names();
  for (const std::string& name : scene_names(true)) expected.push_back(name);
  EXPECT_EQ(listed, expected);
  EXPECT_TRUE(std::find(listed.begin(), listed.end(), "pile") != listed.end());
  const Outcome details = run_tool({"list", "--long"});
  EXPECT_EQ(std::count(details.out.begin(), details.out.end(), '\n'), static_cast<std::ptrdiff_t>(expected.size()));
  EXPECT_NE(details.out.find("(8000 dynamic, 5 static; tags: rest, dense; made for boxstream, MIT)"), std::string::npos)
      << details.out;
}

TEST(Command, ListMarksWhatCannotRun) {
  const ScratchDirectory directory;
  const std::string tool = directory.file("boxstream"), scenes = directory.file("scenes");
  std::filesystem::create_directory(scenes);
  std::filesystem::copy_file(tool_program(), tool);
  std::filesystem::copy_file(std::filesystem::path(scenes::shipped()) / "pile.json", scenes + "/pile.json");
  std::ofstream(scenes + "/broken.json") << "{";
  std::ofstream(scenes + "/foreign.json") << R"({"meta": {"about": "a robot"}, "time": {"steps": 7}, "shapes": 5})";
  const Outcome list = run_program(tool, {"list"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_EQ(std::count(list.out.begin(), list.out.end(), '\n'), 3) << list.out;
  EXPECT_NE(list.out.find("broken      0 steps   [not here: "), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("foreign     7 steps   a robot [not here: "), std::string::npos) << list.out;
  EXPECT_EQ(list.out.find(scenes), std::string::npos) << "a reason names no folder: " << list.out;
}

/// Checks one world of the JSON result and returns its state hashes.
std::vector<std::string> check_world(const Json& world, const std::string& broadphase, std::size_t steps,
                                     std::uint64_t objects) {
  EXPECT_EQ(world.at("broadphase"), broadphase);
  EXPECT_EQ(world.at("steps").size(), steps);
  std::vector<std::string> hashes;
  std::uint64_t pairs = 0;
  double step_total = 0;
  for (const Json& step : world.at("steps")) {
    EXPECT_EQ(step.at("step"), hashes.size() + 1);
    EXPECT_EQ(step.at("bodies"), objects);
    const std::uint64_t now = step.at("pairs");
    EXPECT_EQ(pairs + step.at("begun").get<std::uint64_t>() - step.at("ended").get<std::uint64_t>(), now);
    pairs = now;
    const double broad = step.at("broadphase_ms");
    EXPECT_NEAR(broad, step.at("update_aabbs_ms").get<double>() + step.at("overlapping_pairs_ms").get<double>(), 1e-6);
    EXPECT_GT(broad, 0);
    EXPECT_GE(step.at("dispatch_ms").get<double>(), 0);
    EXPECT_GE(step.at("step_ms").get<double>(), broad);
    step_total += step.at("step_ms").get<double>();
    const std::string hash = step.at("state_hash");
    EXPECT_EQ(hash.size(), 16U);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
    hashes.push_back(hash);
  }
  EXPECT_NEAR(world.at("summary").at("step").at("total_ms").get<double>(), step_total, 1e-6 * (1 + step_total));
  return hashes;
}

class Scenes : public testing::TestWithParam<std::string> {};

TEST_P(Scenes, CompareGivesEqualPairsAndCompleteJson) {
  const ScratchDirectory directory;
  const Outcome run =
      run_tool({"simulate", GetParam(), "--steps", "4", "--compare", "dbvt", "--json", directory.file("out.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  // Nothing but the result in a pipe, and what the file of a robot has that scenes have no word for.
  if (GetParam() == "arm")
    EXPECT_TRUE(
        lasting_words(run).ends_with("arm.urdf: limit of speed of joint \"turn\", \"shoulder\", \"elbow\", "
                                     "\"lift\": left out\n"))
        << run.err;
  else
    EXPECT_EQ(lasting_words(run), "");
  EXPECT_EQ(run.out.find('\r'), std::string::npos);
  EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
  EXPECT_NE(run.out.find("pairs equal"), std::string::npos);
  EXPECT_NE(run.out.find("yes, in every step (4 steps"), std::string::npos) << run.out;

  const Json result = Json::parse(directory.read("out.json"));
  EXPECT_EQ(result.at("pairs_equal"), true);
  ASSERT_EQ(result.at("worlds").size(), 2U);
  const std::uint64_t objects = result.at("meta").at("objects");
  EXPECT_GT(objects, 0U);
  const auto hashes = check_world(result.at("worlds")[0], "boxstream", 4, objects);
  check_world(result.at("worlds")[1], "dbvt", 4, objects);
  EXPECT_EQ(std::set<std::string>(hashes.begin(), hashes.end()).size(), 4U) << "the world does not move";
  EXPECT_EQ(directory.count(), 1U);
}

/// All of them, or every third under sanitizers.
std::vector<std::string> scenes_to_compare() {
  const std::vector<std::string> all = scene_names(false);
  std::vector<std::string> some;
  for (std::size_t i = 0; i < all.size(); i += tests::sanitized ? 3 : 1) some.push_back(all[i]);
  return some;
}

INSTANTIATE_TEST_SUITE_P(Shipped, Scenes, testing::ValuesIn(scenes_to_compare()), [](const auto& test) {
  std::string name = test.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(Command, SameRunGivesSameHashes) {
  const auto hashes = [] {
    const Outcome run = run_tool({"simulate", "ragdolls", "--steps", "6", "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const Json result = Json::parse(run.out);
    return check_world(result.at("worlds").at(0), "boxstream", 6, result.at("meta").at("objects"));
  };
  EXPECT_EQ(hashes(), hashes());
}

TEST(Command, EveryBroadphaseAgreesWithEveryOther) {
  for (const char* const first : {"hybrid", "dbvt", "dbvt-deferred", "sap", "simple", "boxstream"}) {
    const Outcome run =
        run_tool({"simulate", "ragdolls", "--steps", "3", "--broadphase", first, "--compare", "boxstream"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("yes, in every step (3 steps"), std::string::npos) << run.out;
  }
}

TEST(Command, OfRepeatedOptionsTheLastCounts) {
  const Outcome run =
      run_tool({"simulate", "wall", "--steps", "9", "--compare", "sap", "--steps", "2", "--compare", "simple"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("beside simple"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("(2 steps"), std::string::npos) << run.out;
  EXPECT_EQ(run_tool({"simulate", "wall", "pile", "--steps", "1"}).exit_code, 2);
}

TEST(Command, StatusLineOnATerminalOnly) {
  const std::vector<std::string> arguments{"simulate", "wall", "--steps", tests::sanitized ? "60" : "200"};
  const Outcome terminal = run_tool(arguments, {"", true});
  EXPECT_EQ(terminal.exit_code, 0);
  for (const char* const part : {"\r", "step ", "bodies", "pairs", "left"})
    EXPECT_NE(terminal.err.find(part), std::string::npos) << part;
  EXPECT_NE(terminal.err.find("left\r\x1b[K"), std::string::npos) << "the line is still there";
  EXPECT_EQ(terminal.out.find('\r'), std::string::npos);
  EXPECT_EQ(lasting_words(run_tool({"simulate", "wall", "--steps", "10", "--compare", "sap"})), "");
}

TEST(Command, PngPicture) {
  if (tests::sanitized) GTEST_SKIP() << "takes long under a sanitizer, and another picture is drawn there";
  const ScratchDirectory directory;
  const Outcome run =
      run_tool({"simulate", "wall", "--steps", "3", "--compare", "dbvt", "--picture", directory.file("out.png")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(directory.count(), 1U);
  const picture::Image image = picture::read_png(directory.file("out.png"));
  EXPECT_EQ(image.width, 1600);
  EXPECT_GT(image.height, 900);
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
    colours.insert(std::uint32_t{image.rgb[i]} << 16 | std::uint32_t{image.rgb[i + 1]} << 8 | image.rgb[i + 2]);
  EXPECT_GT(colours.size(), 1000U);
}

/// Follows the tags of an XML document and returns how many elements it has; -1 if they do not nest.
int count_elements(const std::string& xml) {
  std::vector<std::string> open;
  int elements = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return -1;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.starts_with("?") || tag.starts_with("!")) continue;
    const std::string name = tag.substr(tag.starts_with("/") ? 1 : 0, tag.find_first_of(" \n/", 1));
    if (tag.starts_with("/")) {
      if (open.empty() || "/" + open.back() != tag) return -1;
      open.pop_back();
      continue;
    }
    ++elements;
    if (!tag.ends_with("/")) open.push_back(name);
  }
  return open.empty() ? elements : -1;
}

TEST(Command, SvgPictureIsWellFormed) {
  const ScratchDirectory directory;
  const Outcome run = run_tool({"simulate", "wall", "--steps", "3", "--picture", directory.file("out.SVG")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string svg = directory.read("out.SVG");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("<image"), std::string::npos);
  EXPECT_NE(svg.find("data:image/png;base64,"), std::string::npos);
  EXPECT_GT(count_elements(svg), 50);
}

TEST(Command, ReplacesAnEarlierResultThroughALink) {
  const ScratchDirectory directory;
  directory.write("real.json", "earlier");
  std::filesystem::create_symlink("real.json", directory.file("link.json"));
  ASSERT_EQ(run_tool({"simulate", "wall", "--steps", "1", "--json", directory.file("link.json")}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(directory.file("link.json")));
  EXPECT_EQ(Json::parse(directory.read("real.json")).at("meta").at("steps"), 1);
  EXPECT_EQ(directory.count(), 2U);
}

}  // namespace
}  // namespace boxstream::tool_test
