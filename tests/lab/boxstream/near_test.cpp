// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "refusal.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

/// A triangle with sides 3, 4 and 5, and one far away.
const std::string triangle =
    "# three corners\n"
    "0 0\n"
    "\n"
    "3, 0   # five from the next\r\n"
    "\t0 4\n"
    "1e3 0";

TEST(Near, CountsAndLists) {
  const ScratchDirectory directory;
  const std::string file = directory.write("points.txt", triangle);
  for (const char* const engine : {"production", "thick"}) {
    SCOPED_TRACE(engine);
    const Outcome count = run_tool({"near", file, "--radius", "4", "--engine", engine});
    EXPECT_EQ(count.exit_code, 0) << count.err;
    EXPECT_EQ(count.out, "objects 4, pairs 2\n");
    const Outcome list = run_tool({"near", "--list", "--radius", "5", "-", "--engine", engine}, {triangle, false});
    EXPECT_EQ(list.exit_code, 0) << list.err;
    EXPECT_EQ(list.out, "0 1\n0 2\n1 2\n");
    // One ulp less than 5 is not enough.
    EXPECT_EQ(run_tool({"near", file, "--radius", "4.999999999999999", "--engine", engine}).out,
              "objects 4, pairs 2\n");
  }
}

TEST(Near, DisksAndBalls) {
  const auto out = [](const std::string& rows, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"near", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_tool(arguments, {rows, false});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  // Three columns are points in space, or disks.
  EXPECT_EQ(out("0 0 1\n3 0 2\n", {"--radius", "0"}), "objects 2, pairs 0\n");
  EXPECT_EQ(out("0 0 1\n3 0 2\n", {"--radius", "0", "--dimensions", "2"}), "objects 2, pairs 1\n");
  EXPECT_EQ(out("0 0 0 1\n3 4 0 2\n", {"--radius", "2"}), "objects 2, pairs 1\n");
  EXPECT_EQ(out("0 0 0 1\n3 4 0 2\n", {"--radius", "1.9999999999999998"}), "objects 2, pairs 0\n");
  EXPECT_EQ(out("", {"--radius", "1"}), "objects 0, pairs 0\n");
  EXPECT_EQ(out("0 0\n0 0\n0 0\n", {"--radius", "0"}), "objects 3, pairs 3\n");
}

TEST(Near, NamesOfColumnsSayWhetherTheyAreRadii) {
  const auto run = [](const std::string& rows) { return run_tool({"near", "-", "--radius", "1"}, {rows, false}); };
  const std::string rows = "0,0,0,0.9\n1.5,0,0,0.9\n";
  for (const char* const header : {"", "x,y,z,r\n", "x y z Radius\n", "\xEF\xBB\xBFX, Y, Z, rad_m\n", "balls\n"})
    EXPECT_EQ(run(header + rows).out, "objects 2, pairs 1\n") << header;
  expect_refusal(run("x,y,z,intensity\n" + rows), {"the last column would be radii, and is called \"intensity\""});
  EXPECT_EQ(run("x,y,z\n0,0,0\n1.5,0,0\n").out, "objects 2, pairs 0\n");
}

/// Tables often have an index in front, with a name or without one.
TEST(Near, AnIndexIsNoCoordinate) {
  const auto run = [](const std::string& rows) { return run_tool({"near", "-", "--radius", "7"}, {rows, false}); };
  for (const char* const header : {",x,y,z\n", "x y z\n", "\"x\"\t\"y\"\t\"z\"\n"})
    expect_refusal(run(header + std::string("5,0.25,8,9\n")),
                   {"standard input:2: the first line names 3 columns, the row has 4 numbers"});
  expect_refusal(run("x\ty\n2,5\t3,25\n"), {"standard input:2: the first line names 2 columns, the row has 4 numbers"});
  expect_refusal(run("% x y\n7 8 9\n"), {"the first line names 2 columns, the row has 3 numbers"});
  expect_refusal(run("\"east\" \"north\"\n7 8 9\n"), {"the first line names 2 columns, the row has 3 numbers"});
  expect_refusal(run("x (m) y (m)\n7 8 9\n"), {"the first line names 2 columns, the row has 3 numbers"});
  EXPECT_EQ(run("% x y z\n1 2 3\n").out, "objects 1, pairs 0\n");
  EXPECT_EQ(run("//x y z\n1 2 3\n").out, "objects 1, pairs 0\n");
  EXPECT_EQ(run("x in m,y in m,z in m\n1,2,3\n").out, "objects 1, pairs 0\n");
  for (const char* const name : {"id", "Index", "frame", "t", "TIME", "\"\""}) {
    SCOPED_TRACE(name);
    expect_refusal(run(name + std::string(",x,y\n1,2,3\n")), {"standard input:2: column 1 would be x, and is called"});
    expect_refusal(run("x,y," + std::string(name) + "\n1,2,3\n"), {"column 3 would be z, and is called"});
  }
}

TEST(Near, ATitleMayHaveWords) {
  const auto run = [](const std::string& rows) { return run_tool({"near", "-", "--radius", "1"}, {rows, false}); };
  for (const char* const header : {"Points", "Trees in the park", "Scanned by hand in May", "x [m] y [m] z [m]",
                                   "x (mm) y (mm) z (mm)", "[x y z]", "east north up"})
    EXPECT_EQ(run(header + std::string("\n4 5 6\n")).out, "objects 1, pairs 0\n") << header;
}

TEST(Near, WritesTables) {
  const ScratchDirectory directory;
  const Outcome run = run_tool({"near", "-", "--radius", "4", "--csv", directory.file("pairs.csv"), "--save",
                                directory.file("points.csv"), "--json", "-"},
                               {triangle, false});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(directory.read("pairs.csv"), "a,b,gap\n0,1,3\n0,2,4\n");
  EXPECT_EQ(directory.read("points.csv"), "# x,y\n0,0\n3,0\n0,4\n1000,0\n");
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["meta"]["source"], "standard input");
  EXPECT_EQ(json["meta"]["dimensions"], 2);
  EXPECT_EQ(json["meta"]["objects"], 4);
  EXPECT_EQ(json["pairs"], 2);
  EXPECT_EQ(json["near"][1], (nlohmann::json{{"a", 0}, {"b", 2}, {"gap", 4.0}}));
}

/// What is made up is found alike by both engines, and again when it is read.
TEST(Near, TrafficIsTheSameForBothEnginesAndFromAFile) {
  for (const std::string name : {"air", "sea"}) {
    SCOPED_TRACE(name);
    const ScratchDirectory directory;
    const Outcome run = run_tool({"near", "--traffic", name, "--count", "1500", "--csv", directory.file("a.csv"),
                                  "--save", directory.file("objects.csv"), "--picture", directory.file("a.svg")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(lasting_words(run), "");
    EXPECT_EQ(run.out.rfind(name == "air" ? "aircraft 1500, pairs " : "ships 1500, pairs ", 0), 0u) << run.out;
    const std::string pairs = directory.read("a.csv");
    EXPECT_GT(std::count(pairs.begin(), pairs.end(), '\n'), 20);
    const std::string picture = directory.read("a.svg");
    EXPECT_NE(picture.find("<svg"), std::string::npos);
    EXPECT_GT(picture.size(), 100'000u);  // all of them are in it

    ASSERT_EQ(
        run_tool({"near", "--traffic", name, "--count", "1500", "--engine", "thick", "--csv", directory.file("b.csv")})
            .exit_code,
        0);
    EXPECT_EQ(directory.read("b.csv"), pairs);
    std::vector<std::string> again{"near", directory.file("objects.csv"), "--csv", directory.file("c.csv"), "--radius"};
    again.push_back(name == "air" ? "5" : "0.5");
    if (name == "sea") again.insert(again.end(), {"--dimensions", "2"});
    ASSERT_EQ(run_tool(again).exit_code, 0);
    EXPECT_EQ(directory.read("c.csv"), pairs);
    EXPECT_NE(run_tool({"near", "--traffic", name, "--count", "1500", "--seed", "2"}).out, run.out);
  }
}

TEST(Near, BadInputIsOneLine) {
  const ScratchDirectory directory;
  const std::string file = directory.write("points.txt", triangle);
  const std::vector<std::string> cases[] = {{"near"},
                                            {"near", file},
                                            {"near", file, "--radius", "-1"},
                                            {"near", file, "--radius", "inf"},
                                            {"near", file, "--radius", "nan"},
                                            {"near", file, "--traffic", "sea", "--radius", "1"},
                                            {"near", "--traffic", "rail"},
                                            {"near", "--traffic", "air", "--dimensions", "2"},
                                            {"near", file, "--radius", "1", "--count", "10"},
                                            {"near", file, "--radius", "1", "--engine", "steam"},
                                            {"near", file, "--radius", "1", "--dimensions", "3"},
                                            {"near", file, "--radius", "1", "--picture", directory.file("a.gif")},
                                            {"near", directory.file("nonesuch"), "--radius", "1"}};
  for (const auto& arguments : cases) {
    SCOPED_TRACE(arguments.back());
    expect_refusal(run_tool(arguments));
  }
  EXPECT_EQ(directory.count(), 1u);
}

TEST(Near, BadRowsAreNamedByLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"1 2 3", "3 numbers, 4 in the rows before"}, {"1 2 3 4 5", "more than 4 numbers"},
      {"1 2 x 4", "\"x\" is not a number"},         {"1 2 nan 4", "NaN is not a coordinate"},
      {"1 2 inf 4", "an infinity is no place"},     {"1 2 3 -4", "a radius below 0"}};
  for (const auto& [row, reason] : cases) {
    const Outcome outcome =
        run_tool({"near", "-", "--radius", "1"}, {"0 0 0 1\n# fine\n" + std::string(row) + "\n", false});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "boxstream: standard input:3: " + std::string(reason) + "\n");
  }
  EXPECT_EQ(run_tool({"near", "-", "--radius", "1"}, {"5\n", false}).err,
            "boxstream: standard input:1: 1 numbers, expected 3 or 4\n");
}

}  // namespace
}  // namespace boxstream::tool_test
