// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// A run fails when two contestants find different pairs, so that an exit code of 0 says more than it seems.
TEST(Paper, EveryExperimentRunsAndIsWritten) {
  const ScratchDirectory directory;
  const Outcome run = run_tool({"paper", "hybrid", "--quick", "--repeats", "1", "--csv", directory.file("new/csv"),
                                "--svg", directory.file("new/svg")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  struct File {
    const char *name, *columns;
    std::size_t rows;
    bool drawn;
  };
  const File files[] = {{"level", "series,n,height,ms,pairs", 20, true},
                        {"figure-6", "series,n,boxes,ms,pairs", 16, true},
                        {"figure-7", "series,n,cutoff of the first level,ms,pairs", 6, true},
                        {"figure-8", "series,n,cutoff,ms,pairs", 10, true},
                        {"figure-9", "cutoff,node,parent,kind,dimension,intervals,points,spanning", 100, true},
                        {"table1", "series,n,cutoff,ms,pairs", 30, true},
                        {"batches", "series,n,cutoff,ms,pairs", 44, true},
                        {"figure-10", "series,n,cutoff,ms,pairs", 10, true},
                        {"figure-13", "series,n,boxes,ms,pairs", 10, true},
                        {"figure-14", "series,n,bytes,ms,pairs", 22, true},
                        {"figure-18", "series,n,boxes,ms,pairs", 6, true},
                        {"figure-20", "series,n,boxes,ms,pairs", 6, true},
                        {"figure-21", "series,n,boxes,ms,pairs", 8, true},
                        {"figure-22", "series,n,triangles,ms,pairs", 9, true},
                        {"figure-23", "series,n,percent,ms,pairs", 36, true},
                        {"table3", "version,case,objects,bytes per object,in the paper", 4, false}};
  for (const File& file : files) {
    SCOPED_TRACE(file.name);
    const auto lines = lines_of(directory.read("new/csv/" + std::string(file.name) + ".csv"));
    ASSERT_GT(lines.size(), file.rows);
    EXPECT_EQ(lines[0], file.columns);
    if (lines.size() < 100) {
      EXPECT_EQ(lines.size(), file.rows + 1);
    }
    const bool drawn = std::filesystem::exists(directory.file("new/svg/" + std::string(file.name) + ".svg"));
    EXPECT_EQ(drawn, file.drawn);
    EXPECT_NE(("\n" + run.out).find("\n" + std::string(file.name) + ": "), std::string::npos);
  }
  EXPECT_EQ(lines_of(directory.read("new/csv/table3.csv"))[1], "One,complete,boxes,36,36");
  // A field with commas is quoted.
  EXPECT_EQ(lines_of(directory.read("new/csv/table1.csv"))[1].rfind("\"1 (1, 1, 0)\",2000,8,", 0), 0u);
}

TEST(Paper, RunsOnlyTheFiguresNamed) {
  const Outcome run = run_tool({"paper", "hybrid", "--figure", "table3,6", "--quick"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("figure-6: "), std::string::npos);
  EXPECT_NE(run.out.find("table3: "), std::string::npos);
  EXPECT_EQ(run.out.find("figure-7"), std::string::npos);
}

TEST(Paper, BadInputIsOneLine) {
  const ScratchDirectory directory;
  const std::string file = directory.write("file", "");
  const std::vector<std::string> cases[] = {{"paper"},
                                            {"paper", "nobody"},
                                            {"paper", "hybrid", "--figure", "99"},
                                            {"paper", "hybrid", "--repeats", "0"},
                                            {"paper", "hybrid", "--figure", "table3", "--csv", file}};
  for (const auto& arguments : cases) {
    SCOPED_TRACE(arguments.back());
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.err.rfind("boxstream: ", 0), 0u) << run.err;
  }
  EXPECT_NE(run_tool(cases[2]).err.find("no figure '99'; there are level, 6, 7"), std::string::npos);
}

}  // namespace
}  // namespace boxstream::tool_test
