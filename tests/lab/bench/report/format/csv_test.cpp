// SPDX-License-Identifier: MIT
#include "format/csv.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace boxstream::report {
namespace {

namespace fs = std::filesystem;

class Csv : public testing::Test {
 protected:
  Csv() { fs::remove_all(directory_); }
  ~Csv() override { fs::remove_all(directory_); }

  std::string read(const std::string& name) const {
    std::ifstream stream(directory_ / name);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  void write(const Results& results) const {
    write_results(directory_.string(), experiment_, results, {"./dev report E1", 3});
  }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(directory_)) found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
  }

  const fs::path directory_ = fs::temp_directory_path() / ("boxstream-csv-" + std::to_string(getpid()));
  const Experiment experiment_{"E1.json", "E1", "A title", "scene", {}};
};

std::string rows(const std::string& text) {
  std::istringstream stream(text);
  std::string out;
  for (std::string line; std::getline(stream, line);)
    if (line.empty() || line[0] != '#') out += line + "\n";
  return out;
}

Results one_of_each() {
  Results results;
  results.cost_unit = "ms";
  results.metrics = {"missed", "error_m"};
  results.points = {
      {"wall", "plain", "4", 4, {2.5, 2.25, 3, 2, 1000}, {0, 0.125}, ""},
      {"a, \"b\"", "line\nbreak", "1/60", NAN, {NAN, NAN, NAN, NAN, NAN}, {NAN, INFINITY}, "said \"no\""}};
  results.controls = {{"wall", 0.0125}};
  return results;
}

TEST_F(Csv, QuotesTextAndLeavesOutWhatDoesNotApply) {
  write(one_of_each());
  EXPECT_EQ(rows(read("E1.csv")),
            "panel,series,setting,x,cost,cost_low,cost_high,cost_min,instructions,missed,error_m,failure\n"
            "wall,plain,4,4,2.5,2.25,3,2,1000,0,0.125,\n"
            "\"a, \"\"b\"\"\",\"line\nbreak\",1/60,,,,,,,,inf,\"said \"\"no\"\"\"\n");
}

TEST_F(Csv, SaysWhereItComesFrom) {
  write(one_of_each());
  const std::string text = read("E1.csv");
  for (const char* line : {"# experiment: E1\n", "# title: A title\n", "# command: ./dev report E1\n", "# cost: ms\n",
                           "# repeats: 3\n", "# date: 20", "# compiler: ", "# twins: wall: 0.0125\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

TEST_F(Csv, WritesCurvesOnlyWhereThereAreSome) {
  Results results = one_of_each();
  write(results);
  EXPECT_EQ(names(), std::vector<std::string>{"E1.csv"});
  results.curves = {{"wall", "plain", "4", {{0, 1}, {0.5, 1e-9}}}};
  write(results);
  EXPECT_EQ(names(), (std::vector<std::string>{"E1.csv", "E1.curves.csv"}));
  EXPECT_EQ(rows(read("E1.curves.csv")), "panel,series,setting,at,value\nwall,plain,4,0,1\nwall,plain,4,0.5,1e-09\n");
}

TEST_F(Csv, ForgetsTheCurvesOfAnEarlierRun) {
  Results results = one_of_each();
  results.curves = {{"wall", "plain", "4", {{0, 1}}}};
  write(results);
  results.curves.clear();
  write(results);
  EXPECT_EQ(names(), std::vector<std::string>{"E1.csv"});
}

TEST_F(Csv, LeavesWhatWasThereWhenItCannotWrite) {
  write(one_of_each());
  const std::string before = read("E1.csv");
  // The place of the curves, which come first, is taken by a directory.
  fs::create_directories(directory_ / "E1.curves.csv");
  Results results = one_of_each();
  results.curves = {{"wall", "plain", "4", {{0, 1}}}};
  results.points.clear();
  EXPECT_THROW(write(results), std::runtime_error);
  EXPECT_EQ(read("E1.csv"), before);
}

TEST_F(Csv, RefusesAPointWithAnotherNumberOfValues) {
  Results results = one_of_each();
  results.points[0].values.pop_back();
  EXPECT_THROW(write(results), std::logic_error);
}

}  // namespace
}  // namespace boxstream::report
