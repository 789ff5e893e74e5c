// SPDX-License-Identifier: MIT
#include "format/experiment.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "experiment_kinds/kinds.hpp"
#include "source_path.hpp"

namespace boxstream::report {
namespace {

namespace fs = std::filesystem;

class ExperimentFile : public testing::Test {
 protected:
  ~ExperimentFile() override { fs::remove(file_); }

  Experiment read(const std::string& text, bool smoke = false) const {
    std::ofstream(file_) << text;
    return read_experiment(file_.string(), smoke);
  }

  std::string complaint(const std::string& text, bool smoke = false) const {
    try {
      (void)read(text, smoke);
    } catch (const BadExperiment& error) {
      return error.what();
    }
    return "none";
  }

  const fs::path file_ = fs::temp_directory_path() / ("E" + std::to_string(getpid()) + ".json");
};

TEST_F(ExperimentFile, IsNamedAfterItsFile) {
  const Experiment experiment = read(R"({"title": "T", "kind": "k", "measure": {"a": 1}})");
  EXPECT_EQ(experiment.id, file_.stem().string());
  EXPECT_EQ(experiment.title, "T");
  EXPECT_EQ(experiment.kind, "k");
  EXPECT_EQ(experiment.settings.dump(), R"({"a":1})");
}

TEST_F(ExperimentFile, SmokeIsAPatchOverTheSettings) {
  const char* const text =
      R"({"title": "T", "kind": "k", "measure": {"n": 9, "knobs": {"a": [1, 2], "b": [3]}},
          "smoke": {"n": 1, "knobs": {"a": [1], "b": null}}})";
  EXPECT_EQ(read(text).settings.dump(), R"({"knobs":{"a":[1,2],"b":[3]},"n":9})");
  EXPECT_EQ(read(text, true).settings.dump(), R"({"knobs":{"a":[1]},"n":1})");
}

TEST_F(ExperimentFile, SaysWhatIsWrongInOneLineAfterItsName) {
  const std::string name = file_.string() + ": ";
  EXPECT_EQ(complaint("[]"), name + "not an object");
  EXPECT_EQ(complaint(R"({"kind": "k"})"), name + "no text \"title\"");
  EXPECT_EQ(complaint(R"({"title": "T", "kind": 3})"), name + "no text \"kind\"");
  EXPECT_EQ(complaint(R"({"title": "T", "kind": "k", "measure": 3})"), name + "\"measure\" is not an object");
  EXPECT_EQ(complaint(R"({"title": "T", "kind": "k"})", true), name + "no block \"smoke\"");
  const std::string broken = complaint("{");
  EXPECT_EQ(broken.rfind(name, 0), 0U) << broken;
  EXPECT_EQ(broken.find('\n'), std::string::npos);
}

TEST_F(ExperimentFile, MayBeMissing) {
  EXPECT_THROW((void)read_experiment("no/such/file.json", false), BadExperiment);
}

/// Those that come with boxstream.
class Shipped : public testing::TestWithParam<std::string> {};

TEST_P(Shipped, HasAKnownKindAndASmokeRun) {
  const std::string file = tests::source_path("bench/report/experiments/" + GetParam() + ".json");
  const Experiment experiment = read_experiment(file, false);
  EXPECT_EQ(kind_of(experiment).name, experiment.kind);
  EXPECT_NE(read_experiment(file, true).settings, experiment.settings);
}

std::vector<std::string> shipped() {
  std::vector<std::string> ids;
  for (const auto& entry : fs::directory_iterator(tests::source_path("bench/report/experiments")))
    ids.push_back(entry.path().stem().string());
  std::sort(ids.begin(), ids.end());
  return ids;
}

INSTANTIATE_TEST_SUITE_P(All, Shipped, testing::ValuesIn(shipped()),
                         [](const testing::TestParamInfo<std::string>& shown) { return shown.param; });

}  // namespace
}  // namespace boxstream::report
