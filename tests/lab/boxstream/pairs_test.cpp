// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "process.hpp"
#include "refusal.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

const std::string four_boxes =
    "# two that touch, one apart, one that covers all\n"
    "0 0 0 1 1 1\n"
    "\n"
    "1, 1, 1, 2, 2, 2   # a corner in common\r\n"
    "\t1e3 0 0 1001 1 1\n"
    "-inf -inf -inf inf inf inf";

TEST(Pairs, CountsAndLists) {
  const ScratchDirectory directory;
  const std::string file = directory.write("boxes.txt", four_boxes);
  const Outcome count = run_tool({"pairs", file});
  EXPECT_EQ(count.exit_code, 0) << count.err;
  EXPECT_EQ(count.out, "boxes 4, pairs 4\n");
  const Outcome list = run_tool({"pairs", "--list", "-"}, {four_boxes, false});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  std::vector<std::string> lines;
  std::istringstream text(list.out);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  EXPECT_EQ(lines, (std::vector<std::string>{"0 1", "0 3", "1 3", "2 3"}));
}

TEST(Pairs, AMarkOfByteOrderIsNoNumber) {
  const Outcome run = run_tool({"pairs", "-"}, {"\xEF\xBB\xBF"
                                                "0 0 0 1 1 1\n1 0 0 2 1 1\n",
                                                false});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "boxes 2, pairs 1\n");
}

TEST(Pairs, DoublesAreNotRounded) {
  // In float both numbers are 1.
  EXPECT_EQ(run_tool({"pairs", "-"}, {"0 0 0 1 1 1\n1.000000000000001 0 0 2 1 1\n", false}).out, "boxes 2, pairs 0\n");
  EXPECT_EQ(run_tool({"pairs", "-"}, {"0 0 0 1 1 1\n1.000000000000000 0 0 2 1 1\n", false}).out, "boxes 2, pairs 1\n");
}

TEST(Pairs, NumbersMayHaveAPlus) {
  EXPECT_EQ(run_tool({"pairs", "-"}, {"+0 0 0 +1.5 1 1\n+1.5e+0 0 0 2 1 1\n", false}).out, "boxes 2, pairs 1\n");
  for (const char* const word : {"+-1", "++1", "+"})
    expect_refusal(run_tool({"pairs", "-"}, {"0 0 0 1 1 1\n" + std::string(word) + " 0 0 1 1 1\n", false}),
                   {"standard input:2: \"" + std::string(word) + "\" is not a number"});
}

TEST(Pairs, NoBoxesAreNoPairs) {
  EXPECT_EQ(run_tool({"pairs", "-"}).out, "boxes 0, pairs 0\n");
}

/// (2, 4, 6) to (3, 5, 7), axis by axis, would pass for (2, 3, 4) to (5, 6, 7).
TEST(Pairs, ColumnsInAnotherOrderAreRefused) {
  const auto run = [](const std::string& rows) { return run_tool({"pairs", "-"}, {rows, false}); };
  const std::string row = "2,3,4,5,6,7\n";
  expect_refusal(run("xmin,xmax,ymin,ymax,zmin,zmax\n" + row),
                 {"standard input:2: the columns are called xmin, xmax, ymin, ymax, zmin, zmax: three minima come "
                  "first, then three maxima"});
  expect_refusal(run("x_hi,y_hi,z_hi,x_lo,y_lo,z_lo\n" + row), {"three minima come first"});
  expect_refusal(run("lon_max,lat_max,alt_max,lon_min,lat_min,alt_min\n" + row), {"three minima come first"});
  for (const char* const header :
       {"lon_min,lat_min,height_min,lon_max,lat_max,height_max\n", "slope_min_x,y_min,z_min,slope_max_x,y_max,z_max\n",
        "MinX,MinY,MinZ,MaxX,MaxY,MaxZ\n", "lx,ly,lz,hx,hy,hz\n",
        "low x,low y,low z,high "
        "x,high y,high z\n",
        "boxes\n"})
    EXPECT_EQ(run(header + row).out, "boxes 1, pairs 0\n") << header;
}

TEST(Pairs, AnEmptyFieldIsNoNumber) {
  for (const char* const row : {"0,0,0,,1,1,1", "0,0,0, ,1,1,1", "0,0,0,,1,1", ",,0,0,0,1,1,1", "0,0,0,1,1,1, ,"}) {
    SCOPED_TRACE(row);
    expect_refusal(run_tool({"pairs", "-"}, {row, false}), {"standard input:1: an empty field between two commas"});
  }
  EXPECT_EQ(run_tool({"pairs", "-"}, {"0,0,0,1,1,1,\n,,,,,\n", false}).out, "boxes 1, pairs 0\n");
}

TEST(Pairs, SpecialNumbersAreNoNames) {
  const auto run = [](const std::string& rows) { return run_tool({"pairs", "-"}, {rows, false}); };
  expect_refusal(run("nan nan 0,nan 1 nan\n0 0 0 1 1 1\n"), {"standard input:1: NaN is not a coordinate"});
  EXPECT_EQ(run("inf 2 2,inf 3 3\n0 2 2 inf 3 3\n").out, "boxes 2, pairs 1\n");
}

TEST(Pairs, BadRowsAreNamedByLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"0 0 0 1 1", ":3: 5 numbers, expected 6"},       {"0 0 0 1 1 1 1", ":3: more than 6 numbers"},
      {"0 0 0 1 x 1", ":3: \"x\" is not a number"},     {"0 0 0 1 1 1e999", ":3: \"1e999\" is out of range"},
      {"0 0 0 1 nan 1", ":3: NaN is not a coordinate"}, {"0 2 0 1 1 1", ":3: min > max on the y axis"}};
  for (const auto& [row, reason] : cases) {
    const Outcome outcome = run_tool({"pairs", "-"}, {"0 0 0 1 1 1\n# fine\n" + std::string(row) + "\n", false});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "boxstream: standard input" + std::string(reason) + "\n");
  }
}

TEST(Pairs, MissingFile) {
  const Outcome outcome = run_tool({"pairs", "/nonesuch/boxes.txt"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "boxstream: /nonesuch/boxes.txt: No such file or directory\n");
}

TEST(Pairs, EitherMethodFindsTheSame) {
  std::string rows;
  for (int i = 0; i < 400; ++i) {
    const int lo[] = {i * 7 % 97, i * 11 % 89, i * 13 % 83};
    for (const int side : {0, 9})
      for (const int x : lo) rows += std::to_string(x + side) + ' ';
    rows += '\n';
  }
  const auto lines = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"pairs", "--list", "-"});
    const Outcome run = run_tool(arguments, {rows, false});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    std::multiset<std::string> all;
    std::istringstream text(run.out);
    for (std::string line; std::getline(text, line);) all.insert(line);
    return all;
  };
  const auto planned = lines({});
  EXPECT_GT(planned.size(), 100U);
  EXPECT_EQ(lines({"--method", "hybrid"}), planned);
  EXPECT_EQ(lines({"--method", "hybrid", "--cutoff", "12"}), planned);
  EXPECT_EQ(run_tool({"pairs", "-", "--method", "fast"}).exit_code, 2);
}

}  // namespace
}  // namespace boxstream::tool_test
