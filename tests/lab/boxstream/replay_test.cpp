// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/record/reader.hpp"
#include "formats/record/writer.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using Json = nlohmann::json;

std::string record_wall(const ScratchDirectory& directory) {
  const Outcome run = run_tool({"simulate", "wall", "--steps", "12", "--log", directory.file("wall.bsrec")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lasting_words(run), "");
  return directory.file("wall.bsrec");
}

/// The recording with the hash of its last batch changed.
std::string spoil(const ScratchDirectory& directory, const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  record::Reader reader(bytes);
  std::ofstream out(directory.file("spoilt.bsrec"), std::ios::binary);
  record::Writer writer(out, reader.header());
  std::uint64_t batches = 0;
  while (auto op = reader.next()) {
    if (auto* const batch = std::get_if<record::Batch>(&*op); batch != nullptr && ++batches == 12)
      batch->pairs.add({0, 1});
    writer.write(*op);
  }
  writer.finish();
  return directory.file("spoilt.bsrec");
}

void expect_refusal(const Outcome& outcome, const std::string& line) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "boxstream: " + line + "\n");
}

TEST(Replay, OfARecordedSceneOnEveryBroadphase) {
  const ScratchDirectory directory;
  const std::string file = record_wall(directory);
  EXPECT_EQ(directory.count(), 1U);
  for (const char* const name : {"boxstream", "dbvt", "dbvt-deferred", "sap", "simple"}) {
    const Outcome run = run_tool({"replay", file, "--broadphase", name});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(lasting_words(run), "");
    EXPECT_NE(run.out.find("wall on boxstream"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("pairs equal    yes, in every batch (12 batches"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find(std::string("\n") + name + " "), std::string::npos) << run.out;
  }
}

TEST(Replay, LogDoesNotShowInTheWorld) {
  const ScratchDirectory directory;
  const auto hashes = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"simulate", "ragdolls", "--steps", "6", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    std::vector<std::string> all;
    const Json result = Json::parse(run.out);
    for (const Json& step : result.at("worlds").at(0).at("steps")) all.push_back(step.at("state_hash"));
    return all;
  };
  const auto plain = hashes({});
  EXPECT_EQ(plain.size(), 6U);
  EXPECT_EQ(hashes({"--log", directory.file("out.bsrec")}), plain);
  EXPECT_EQ(hashes({"--log", directory.file("out.bsrec"), "--compare", "dbvt"}), plain);
  EXPECT_EQ(run_tool({"replay", directory.file("out.bsrec")}).exit_code, 0);
}

TEST(Replay, JsonHasEverything) {
  const ScratchDirectory directory;
  const std::string file = record_wall(directory);
  const Outcome run = run_tool({"replay", file, "--compare", "dbvt", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json result = Json::parse(run.out);
  EXPECT_EQ(result.at("format"), 1);
  EXPECT_EQ(result.at("meta").at("precision"), "float");
  EXPECT_EQ(result.at("batches"), 12);
  EXPECT_EQ(result.at("calls").at("batches"), 12);
  EXPECT_GT(result.at("calls").at("moves"), 0);
  EXPECT_GT(result.at("pairs"), 0);
  EXPECT_EQ(result.at("pairs_equal"), true);
  EXPECT_FALSE(result.contains("first_difference"));
  ASSERT_EQ(result.at("broadphases").size(), 2U);
  EXPECT_EQ(result.at("broadphases")[1].at("name"), "dbvt");
  EXPECT_GT(result.at("broadphases")[1].at("total_ms"), 0);
  EXPECT_EQ(run_tool({"replay", file, "--json", directory.file("out.json")}).exit_code, 0);
  EXPECT_EQ(Json::parse(directory.read("out.json")).at("batches"), 12);
}

TEST(Replay, ADifferenceIsOneLineAndExitCodeOne) {
  const ScratchDirectory directory;
  const std::string file = spoil(directory, directory.read((record_wall(directory), "wall.bsrec")));
  const Outcome run = run_tool({"replay", file});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(run.err.starts_with("boxstream: pairs differ: batch 12: recording ")) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find("recording has in excess the pair of proxies 0 and 1, box of 0: ["), std::string::npos)
      << run.err;
  EXPECT_NE(run.out.find("pairs equal    no: batch 12: "), std::string::npos) << run.out;
  const Json result = Json::parse(run_tool({"replay", file, "--json", "-"}).out);
  EXPECT_EQ(result.at("pairs_equal"), false);
  const Json& difference = result.at("first_difference");
  EXPECT_EQ(difference.at("batch"), 12);
  EXPECT_EQ(difference.at("who"), "recording");
  EXPECT_EQ(difference.at("kind"), "extra");
  EXPECT_EQ(difference.at("proxies"), (std::vector<int>{0, 1}));
  EXPECT_EQ(difference.at("boxes").at(1).size(), 6U);
  EXPECT_EQ(difference.at("counts").at("recording"), difference.at("counts").at("search").get<int>() + 1);
}

TEST(Replay, DumpHasOneLineForEachCall) {
  const ScratchDirectory directory;
  const std::string file = record_wall(directory);
  const Json calls = Json::parse(run_tool({"replay", file, "--json", "-"}).out).at("calls");
  const Outcome dump = run_tool({"replay", file, "--dump"});
  EXPECT_EQ(dump.exit_code, 0) << dump.err;
  const auto lines_with = [&](const std::string& start) {
    std::istringstream lines(dump.out);
    std::uint64_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with(start) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(lines_with("float, bounds ["), 1U);
  EXPECT_EQ(lines_with("create "), calls.at("created"));
  EXPECT_EQ(lines_with("move "), calls.at("moves"));
  EXPECT_EQ(lines_with("batch "), 12U);
  EXPECT_NE(dump.out.find(" (batch 12)\n"), std::string::npos);
}

TEST(Replay, BrokenFilesAreNamedWithThePlace) {
  const ScratchDirectory directory;
  const std::string whole = directory.read((record_wall(directory), "wall.bsrec"));
  const std::string cut = directory.write("cut.bsrec", whole.substr(0, whole.size() - 1));
  const std::string place = std::to_string(whole.size() - 1);
  expect_refusal(run_tool({"replay", cut}), cut + ": offset " + place + ": cut off: nothing follows");
  const Outcome dump = run_tool({"replay", cut, "--dump"});
  EXPECT_EQ(dump.exit_code, 2);
  EXPECT_NE(dump.out.find(" (batch 12)\n"), std::string::npos) << "what is before the place can be read";
  const Outcome partial = run_tool({"replay", directory.write("part", whole.substr(0, whole.size() - 9)), "--partial"});
  EXPECT_EQ(partial.exit_code, 0) << partial.err;
  EXPECT_NE(partial.out.find("yes, in every batch (11 batches"), std::string::npos) << partial.out;
  expect_refusal(run_tool({"replay", "-"}, {"{}", false}), "standard input: offset 0: no boxstream recording");
  expect_refusal(run_tool({"replay", directory.write("empty", "")}), directory.file("empty") + ": is empty");
  expect_refusal(run_tool({"replay", directory.file("none")}), directory.file("none") + ": No such file or directory");
  expect_refusal(run_tool({"replay", directory.file("")}), directory.file("") + ": Is a directory");
}

TEST(Replay, DoublePrecisionIsForDumpOnly) {
  const ScratchDirectory directory;
  {
    std::ofstream out(directory.file("double.bsrec"), std::ios::binary);
    record::Header header;
    header.scalar = record::Scalar::float64;
    record::Writer writer(out, header);
    writer.write(record::Create{0, 0, 1, -1, {{0.1, 0, 0}, {1, 1, 1}}});
    writer.finish();
  }
  const Outcome replay = run_tool({"replay", directory.file("double.bsrec")});
  EXPECT_EQ(replay.exit_code, 2);
  EXPECT_NE(replay.err.find("double precision"), std::string::npos) << replay.err;
  const Outcome dump = run_tool({"replay", directory.file("double.bsrec"), "--dump"});
  EXPECT_EQ(dump.exit_code, 0) << dump.err;
  EXPECT_NE(dump.out.find("box [0.1 0 0] to [1 1 1]"), std::string::npos) << dump.out;
}

TEST(Replay, SweepAndPruneGetsNoInvalidBoxes) {
  const ScratchDirectory directory;
  const std::string file = directory.file("inverted.bsrec");
  {
    std::ofstream out(file, std::ios::binary);
    record::Writer writer(out, {});
    writer.write(record::Create{0, 0, 1, -1, {{1, 0, 0}, {0, 1, 1}}});
    writer.write(record::Batch{});
    writer.finish();
  }
  expect_refusal(run_tool({"replay", file, "--compare", "sap"}),
                 file + ": sap takes no boxes with a NaN or min > max, of which there are 1 here");
  EXPECT_EQ(run_tool({"replay", file, "--compare", "dbvt"}).exit_code, 0);
}

TEST(Replay, Options) {
  const ScratchDirectory directory;
  const std::string file = record_wall(directory);
  EXPECT_EQ(run_tool({"replay"}).exit_code, 2);
  for (const char* const option : {"--broadphase", "--compare"}) {
    const Outcome run = run_tool({"replay", file, option, "dvbt"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find("unknown broad-phase 'dvbt'; did you mean 'dbvt'?"), std::string::npos) << run.err;
  }
  expect_refusal(run_tool({"replay", file, "--dump", "--compare", "dbvt"}),
                 "--dump replays nothing, so it goes with neither --compare nor --json");
  expect_refusal(run_tool({"simulate", "wall", "--log", "-"}), "--log -: a recording is a file");
  const std::string same = directory.file("same");
  expect_refusal(run_tool({"simulate", "wall", "--json", same, "--log", same}), same + ": named for two outputs");
  EXPECT_EQ(run_tool({"simulate", "wall", "--log", directory.file("no/such")}).exit_code, 2);
  EXPECT_EQ(directory.count(), 1U);
}

}  // namespace
}  // namespace boxstream::tool_test
