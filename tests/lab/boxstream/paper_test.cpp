// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

#include "process.hpp"
#include "refusal.hpp"
#include "sanitized.hpp"
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
  EXPECT_EQ(lasting_words(run), "");
  struct File {
    const char *name, *columns;
    std::size_t rows;
    bool drawn;
  };
  const File files[] = {{"level", "series,n,height,ms,pairs", 20, true},
                        {"figure-6", "series,n,boxes,ms,pairs", 20, true},
                        {"figure-7", "series,n,cutoff of the first level,ms,pairs", 6, true},
                        {"figure-8", "series,n,cutoff,ms,pairs", 10, true},
                        {"figure-9", "cutoff,node,parent,kind,dimension,intervals,points,spanning", 100, true},
                        {"trees", "boxes,nodes,places a box,bytes a box,Stream2-Scan ms,Hybrid ms,engine ms", 2, false},
                        {"table1", "series,n,cutoff,ms,pairs", 60, true},
                        {"order", "input,n,low ends,cutoff,012,021,102,120,201,210,restart,pairs", 32, false},
                        {"batches", "series,n,cutoff,ms,pairs", 44, true},
                        {"figure-10", "series,n,cutoff,ms,pairs", 10, true},
                        {"table2", "series,n,KiB,ns,pairs", 12, true},
                        {"figure-13", "series,n,boxes,ms,pairs", 10, true},
                        {"figure-14", "series,n,bytes,ms,pairs", 22, true},
                        {"figure-15", "series,n,structures,bytes,pairs", 2, true},
                        {"figure-18", "series,n,boxes,ms,pairs", 6, true},
                        {"figure-20", "series,n,boxes,ms,pairs", 6, true},
                        {"figure-21", "series,n,boxes,ms,pairs", 8, true},
                        {"figure-22", "series,n,triangles,ms,pairs", 15, true},
                        {"figure-23", "series,n,percent,ms,pairs", 48, true},
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
  EXPECT_EQ(lines_of(directory.read("new/csv/table1.csv"))[1].rfind("\"1 (1, 1, 0), alike\",2000,8,", 0), 0u);
  // Every experiment is in the help.
  const std::string help = run_tool({"paper", "hybrid", "--help"}).out;
  for (const char* name : {"6",  "7",  "8",  "9",      "10",     "13",     "14",    "15",    "18",      "20",
                           "21", "22", "23", "table1", "table2", "table3", "level", "order", "batches", "trees"})
    EXPECT_TRUE(std::regex_search(help, std::regex("\\b" + std::string(name) + "\\b"))) << name;
}

/// Pairs do not depend on the order of dimensions, or the run fails.
TEST(Paper, DimensionOrderAndRestart) {
  for (const std::vector<std::string>& knob :
       {std::vector<std::string>{"--order", "201"}, {"--restart"}, {"--order", "120", "--restart"}}) {
    std::vector<std::string> arguments = {"paper", "hybrid", "--quick", "--repeats", "1", "--figure", "7,10,table1"};
    arguments.insert(arguments.end(), knob.begin(), knob.end());
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, 0) << knob[0] << ": " << run.err;
    EXPECT_NE(run.out.find("figure-10: "), std::string::npos) << knob[0];
  }
}

/// All structures that can do a work must answer as the engine does, or the run fails.
TEST(Paper, EveryStructureIsComparedAndWritten) {
  if (tests::sanitized) GTEST_SKIP() << "takes long under a sanitizer, and papers.* tests the structures";
  const ScratchDirectory directory;
  const Outcome run = run_tool({"paper", "structures", "--quick", "--repeats", "1", "--csv", directory.file("csv"),
                                "--svg", directory.file("svg")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lasting_words(run), "");
  struct File {
    const char *name, *unit;
    std::vector<const char*> structures;
  };
  const File files[] = {{"build", "ns per box", {"k-d tree of boxes", "octree"}},
                        {"points", "us per query", {"scan", "k-d tree of points", "k-d tree of boxes"}},
                        {"boxes", "us per query", {"scan", "k-d tree of boxes", "k-d amortised", "k-d worst case"}},
                        {"rays", "us per ray", {"scan", "octree"}},
                        {"updates", "us per round", {"k-d amortised", "k-d worst case"}},
                        {"longest", "ms", {"k-d amortised", "k-d worst case"}},
                        {"pairs", "ns per box", {"boxstream batch", "k-d tree of boxes"}},
                        {"frames", "ns per box and frame", {"boxstream batch", "k-d tree of boxes"}}};
  for (const File& file : files) {
    SCOPED_TRACE(file.name);
    const auto lines = lines_of(directory.read("csv/structures-" + std::string(file.name) + ".csv"));
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(lines[0], "structure,batch,n," + std::string(file.unit) + ",times the engine's,found");
    EXPECT_EQ(lines[1].rfind("boxstream", 0), 0u) << lines[1];
    for (const char* structure : file.structures)
      EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.rfind(structure + std::string(","), 0) == 0;
      })) << structure;
    EXPECT_TRUE(std::filesystem::exists(directory.file("svg/structures-" + std::string(file.name) + ".svg")));
    EXPECT_NE(("\n" + run.out).find("\nstructures-" + std::string(file.name) + ": "), std::string::npos);
  }
  EXPECT_NE(run.out.find("  best: "), std::string::npos);
}

TEST(Paper, ThickExperimentsRunAndAreWritten) {
  const ScratchDirectory directory;
  const Outcome run = run_tool(
      {"paper", "thick", "--quick", "--repeats", "1", "--csv", directory.file("new"), "--svg", directory.file("new")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lasting_words(run), "");
  struct File {
    const char *name, *columns;
    std::size_t rows;
  };
  const File files[] = {{"thick-sort", "series,n,disks,ms,pairs", 8},
                        {"thick-naive", "series,n,pairs found,ms,pairs", 18},
                        {"thick-pairs", "series,n,pairs a disk,ms,pairs", 15},
                        {"thick-radii", "series,n,largest / smallest radius,ms,pairs", 16},
                        {"thick-space", "series,n,balls,ms,pairs", 4},
                        {"thick-traffic", "series,n,distance / usual distance,ms,pairs", 16}};
  for (const File& file : files) {
    SCOPED_TRACE(file.name);
    const auto lines = lines_of(directory.read("new/" + std::string(file.name) + ".csv"));
    ASSERT_EQ(lines.size(), file.rows + 1);
    EXPECT_EQ(lines[0], file.columns);
    EXPECT_TRUE(std::filesystem::exists(directory.file("new/" + std::string(file.name) + ".svg")));
    EXPECT_NE(("\n" + run.out).find("\n" + std::string(file.name) + ": "), std::string::npos);
  }
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
                                            {"paper", "hybrid", "--figure", "nobody"},
                                            {"paper", "hybrid", "--repeats", "0"},
                                            {"paper", "structures", "--work", "rest"},
                                            {"paper", "hybrid", "--figure", "7", "--quick", "--order", "002"},
                                            {"paper", "hybrid", "--figure", "7", "--quick", "--order", "01"},
                                            {"paper", "thick", "--figure", "6"},
                                            {"paper", "hybrid", "--figure", "table3", "--csv", file}};
  for (const auto& arguments : cases) {
    SCOPED_TRACE(arguments.back());
    expect_refusal(run_tool(arguments));
  }
  EXPECT_NE(run_tool(cases[2]).err.find("unknown figure 'nobody'; there are level, 6, 7"), std::string::npos);
  EXPECT_NE(run_tool(cases[4]).err.find("unknown work 'rest'; there are build, points, boxes"), std::string::npos);
}

}  // namespace
}  // namespace boxstream::tool_test
