// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <boxstream/detector.hpp>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "formats/aabbs/reader.hpp"
#include "formats/aabbs/writer.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using Json = nlohmann::json;

void expect_refusal(const Outcome& outcome, const std::string& line) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "boxstream: " + line + "\n");
}

/// Three unit cubes: the second one touches the first, then all meet, then none.
std::string three_cubes(const ScratchDirectory& directory) {
  const float places[3][3] = {{0, 1, 5}, {0, 0.5f, 0.75f}, {0, 2, 4}};
  std::ofstream out(directory.file("cubes.aabbs"), std::ios::binary);
  aabbs::Writer writer(out, {"meeting", "Cubes", 3, 2, {{-10, -10, -10}, {10, 10, 10}}});
  for (const auto& row : places) {
    std::vector<Aabb> boxes;
    for (const float x : row) boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
    writer.frame(boxes);
  }
  writer.finish();
  return directory.file("cubes.aabbs");
}

TEST(Aabbs, CountsPairsOfEachFrameOnEveryBroadphase) {
  const ScratchDirectory directory;
  const std::string file = three_cubes(directory);
  for (const char* const name : {"world", "boxstream", "dbvt", "dbvt-deferred", "sap", "simple"}) {
    const Outcome run = run_tool({"aabbs", file, "--broadphase", name, "--compare", "world", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(lasting_words(run), "");
    const Json result = Json::parse(run.out);
    EXPECT_EQ(result.at("pairs_equal"), true);
    EXPECT_EQ(result.at("meta").at("scene"), "meeting");
    EXPECT_EQ(result.at("meta").at("objects"), 3);
    EXPECT_EQ(result.at("broadphases").at(0).at("name"), name);
    EXPECT_GT(result.at("broadphases").at(1).at("total_ms"), 0);
    std::vector<int> pairs;
    for (const Json& frame : result.at("frames")) {
      pairs.push_back(frame.at("pairs"));
      EXPECT_EQ(frame.at("ms").size(), 2U);
    }
    EXPECT_EQ(pairs, (std::vector<int>{1, 3, 0})) << name;
  }
  const Outcome text = run_tool({"aabbs", file});
  EXPECT_NE(text.out.find("meeting (Cubes)"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("4 in all, 3 in one frame at most"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("pairs equal"), std::string::npos) << text.out;
  EXPECT_EQ(run_tool({"aabbs", "-", "--compare", "dbvt"}, {directory.read("cubes.aabbs"), false}).exit_code, 0);
}

TEST(Aabbs, OfARecordedSceneHasItsPairs) {
  const ScratchDirectory directory;
  const std::string file = directory.file("fall.aabbs");
  // Compared, so that two look on at once.
  const Outcome simulated = run_tool({"simulate", "broadmark_fall_cubes", "--scale", "0.2", "--steps", "10",
                                      "--compare", "dbvt", "--record", file, "--json", "-"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_EQ(directory.count(), 1U);
  std::ifstream in(file, std::ios::binary);
  aabbs::Reader reader(in);
  EXPECT_EQ(reader.header().scene, "broadmark_fall_cubes");
  EXPECT_EQ(reader.header().objects, 206U);
  EXPECT_EQ(reader.header().steps, 10U);
  const Outcome run = run_tool({"aabbs", file, "--compare", "sap", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json steps = Json::parse(simulated.out).at("worlds").at(0).at("steps"), result = Json::parse(run.out);
  ASSERT_EQ(result.at("frames").size(), 11U);
  // Each of the six walls touches four others, which engines do not look at and files of boxes do.
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(result.at("frames").at(i + 1).at("pairs"), steps.at(i).at("pairs").get<int>() + 12) << i;
}

TEST(Aabbs, FollowABodyThatMeetsNothing) {
  const ScratchDirectory directory;
  const std::string file = directory.file("gravity.aabbs");
  ASSERT_EQ(run_tool({"simulate", "effects/gravity", "--record", file}).exit_code, 0);
  std::ifstream in(file, std::ios::binary);
  aabbs::Reader reader(in);
  std::vector<float> lows;
  for (std::vector<Aabb> boxes; reader.next(boxes);) lows.push_back(boxes[0].min[1]);
  ASSERT_EQ(lows.size(), 61U);
  // Boxes are those that the broad-phase of the step had, of where the step began.
  EXPECT_NEAR(lows[60] - lows[0], -9.81 * 59 * 60 / 2 / 3600, 0.1);
}

TEST(Aabbs, RecordingDoesNotShowInTheWorld) {
  const ScratchDirectory directory;
  const auto hashes = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"simulate", "character", "--steps", "6", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<std::string> all;
    const Json result = Json::parse(run_tool(arguments).out);
    for (const Json& step : result.at("worlds").at(0).at("steps")) all.push_back(step.at("state_hash"));
    return all;
  };
  const auto plain = hashes({});
  EXPECT_EQ(plain.size(), 6U);
  EXPECT_EQ(hashes({"--record", directory.file("a.aabbs"), "--record", directory.file("b.aabbs")}), plain);
  EXPECT_EQ(directory.read("a.aabbs"), directory.read("b.aabbs"));
}

TEST(Aabbs, InvalidBoxesAreCountedAndKeptFromSweepAndPrune) {
  const ScratchDirectory directory;
  const std::string file = directory.file("odd.aabbs");
  {
    std::ofstream out(file, std::ios::binary);
    aabbs::Writer writer(out, {"odd", "", 3, 1, {{-1, -1, -1}, {1, 1, 1}}});
    const std::vector<Aabb> odd{{{1, 1, 1}, {-1, -1, -1}},
                                {{-1, -1, -1}, {1, 1, 1}},
                                {{std::numeric_limits<float>::quiet_NaN(), 0, 0}, {1, 1, 1}}};
    writer.frame(odd);
    writer.frame(odd);
    writer.finish();
  }
  const Outcome run = run_tool({"aabbs", file, "--compare", "boxstream", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json result = Json::parse(run.out);
  EXPECT_EQ(result.at("meta").at("invalid_boxes"), 4);
  EXPECT_EQ(result.at("frames").at(1).at("pairs"), 0);
  expect_refusal(run_tool({"aabbs", file, "--compare", "sap"}),
                 file + ": sap takes no boxes with a NaN or min > max, of which frame 1 has 2");
}

TEST(Aabbs, BadInputIsOneLine) {
  const ScratchDirectory directory;
  const std::string file = three_cubes(directory);
  const std::string bytes = directory.read("cubes.aabbs");
  expect_refusal(run_tool({"aabbs", directory.file("none")}), directory.file("none") + ": No such file or directory");
  expect_refusal(run_tool({"aabbs", directory.file("")}), directory.file("") + ": Is a directory");
  expect_refusal(run_tool({"aabbs", directory.write("empty", "")}),
                 directory.file("empty") + ": 0 bytes; the header alone takes 304");
  expect_refusal(run_tool({"aabbs", directory.write("short", bytes.substr(0, bytes.size() - 8))}),
                 directory.file("short") + ": 280 bytes of boxes, but 3 objects in 1 + 2 frames would take 288");
  expect_refusal(run_tool({"aabbs", "-"}, {bytes.substr(0, 310), false}),
                 "standard input: cut off in frame 1 of 1 + 2");
  EXPECT_NE(run_tool({"aabbs", file, "--compare", "bvh"}).err.find("there are world, boxstream, hybrid, dbvt"),
            std::string::npos);
  const std::string flat = directory.file("flat.aabbs");
  {
    std::ofstream out(flat, std::ios::binary);
    aabbs::Writer(out, {"flat", "", 1, 1, {{0, 0, 0}, {0, 1, 1}}}).frame(std::vector<Aabb>{{{0, 0, 0}, {1, 1, 1}}});
  }
  expect_refusal(run_tool({"aabbs", flat, "--broadphase", "sap"}),
                 flat + ": sap needs a world with sides; this one is from 0 to 0 on the x axis");
}

/// Two frames of boxes of which a hundred fit in the least memory, on average five to a box.
std::vector<std::vector<Aabb>> write_crowd(const std::string& file) {
  std::mt19937 random(7);
  const auto coordinate = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f * 12; };
  std::vector<std::vector<Aabb>> frames(2, std::vector<Aabb>(3000));
  std::ofstream out(file, std::ios::binary);
  aabbs::Writer writer(out, {"crowd", "Cubes", 3000, 1, {{0, 0, 0}, {13, 13, 13}}});
  for (auto& boxes : frames) {
    for (Aabb& box : boxes)
      for (int d = 0; d < 3; ++d) box.max[d] = (box.min[d] = coordinate()) + 1;
    boxes[5].min[0] = std::numeric_limits<float>::quiet_NaN();
    writer.frame(boxes);
  }
  writer.finish();
  return frames;
}

TEST(Aabbs, FramesLargerThanMemoryHaveTheSamePairs) {
  const ScratchDirectory directory;
  const std::string file = directory.file("crowd.aabbs");
  const auto frames = write_crowd(file);
  std::vector<std::string> truth;
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    for (const Pair pair : find_pairs(frames[frame]))
      truth.push_back(std::to_string(frame) + "," + std::to_string(pair.a) + "," + std::to_string(pair.b));
  const Outcome run = run_tool({"aabbs", file, "--memory", "64K", "--temporary", directory.file(""), "--pairs", "-",
                                "--json", directory.file("run.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::istringstream text(run.out);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.front(), "frame,a,b");
  lines.erase(lines.begin());
  std::sort(lines.begin(), lines.end());
  std::sort(truth.begin(), truth.end());
  EXPECT_EQ(lines, truth);
  const Json result = Json::parse(directory.read("run.json"));
  EXPECT_EQ(result.at("meta").at("memory"), 65536);
  ASSERT_EQ(result.at("frames").size(), 2U);
  for (const Json& frame : result.at("frames")) {
    EXPECT_EQ(frame.at("boxes_read"), 6000);
    EXPECT_EQ(frame.at("invalid"), 1);
    EXPECT_GT(frame.at("copies"), 3000);
  }
  EXPECT_EQ(directory.count(), 2U);
  EXPECT_NE(run_tool({"aabbs", file, "--memory", "1G"}).out.find("3 000"), std::string::npos);
}

TEST(Aabbs, LargeFramesRefuseWhatTheyCannotDo) {
  const ScratchDirectory directory;
  const std::string file = three_cubes(directory);
  expect_refusal(run_tool({"aabbs", "-", "--memory", "1G"}, {directory.read("cubes.aabbs"), false}),
                 "standard input: --memory reads frames more than once, which takes a file");
  expect_refusal(run_tool({"aabbs", file, "--memory", "1G", "--temporary", "no/such"}),
                 "--temporary no/such: no such folder");
  for (const char* const memory : {"63K", "1X", "-1"})
    EXPECT_EQ(run_tool({"aabbs", file, "--memory", memory}).exit_code, 2) << memory;
  EXPECT_EQ(run_tool({"aabbs", file, "--memory", "1G", "--compare", "dbvt"}).exit_code, 2);
  EXPECT_EQ(run_tool({"aabbs", file, "--pairs", "pairs.csv"}).exit_code, 2);
}

/// Once the name of the tool, and why.
TEST(Aabbs, LargeFramesSayWhyTheyCannotGoOn) {
  const ScratchDirectory directory;
  const std::string file = directory.file("crowd.aabbs");
  write_crowd(file);
  const Outcome full =
      run_tool({"aabbs", file, "--memory", "64K", "--pairs", "/dev/full", "--json", directory.file("run.json")});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_EQ(lasting_words(full), "boxstream: /dev/full: cannot be written: No space left on device\n");
  const Outcome no_file = run_tool({"aabbs", file, "--memory", "64K", "--temporary", "/proc/self"});
  EXPECT_EQ(no_file.exit_code, 1);
  EXPECT_EQ(lasting_words(no_file).rfind("boxstream: the temporary file in /proc/self cannot be made: ", 0), 0U)
      << no_file.err;
  EXPECT_EQ(directory.count(), 1U);
}

TEST(Record, RefusesWhatItCannotWrite) {
  const ScratchDirectory directory;
  expect_refusal(run_tool({"simulate", "wall", "--record", "run.mp4"}),
                 "--record run.mp4: expected a file FILE.aabbs or FILE.glb");
  const std::string same = directory.file("same.aabbs");
  expect_refusal(run_tool({"simulate", "wall", "--record", same, "--record", same}), same + ": named for two outputs");
  EXPECT_EQ(run_tool({"simulate", "wall", "--record", directory.file("no/such.aabbs")}).exit_code, 2);
  EXPECT_EQ(directory.count(), 0U);
}

TEST(Scale, IsCheckedAndApplied) {
  expect_refusal(run_tool({"simulate", "pile", "--scale", "1000"}),
                 "--scale 1000: that makes more than 4000000 bodies");
  EXPECT_EQ(run_tool({"simulate", "pile", "--scale", "0"}).exit_code, 2);
  const Outcome run = run_tool({"simulate", "pile", "--scale", "0.01", "--steps", "2", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out).at("meta").at("dynamic"), 80);
}

}  // namespace
}  // namespace boxstream::tool_test
