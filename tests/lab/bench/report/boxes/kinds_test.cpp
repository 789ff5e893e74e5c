// SPDX-License-Identifier: MIT
// Kinds of experiments about boxes, at sizes where effects that are known show.
#include <gtest/gtest.h>

#include <algorithm>

#include "experiment_kinds/kinds.hpp"

namespace boxstream::report {
namespace {

class Measured {
 public:
  Measured(const char* kind, const char* settings)
      : results_(run_experiment({"test.json", "test", "", kind, nlohmann::json::parse(settings)}, 1,
                                [](const std::string&) {})) {}

  const std::vector<Point>& points() const { return results_.points; }

  double value(const std::string& series, const std::string& setting, const std::string& metric) const {
    const auto column = std::find(results_.metrics.begin(), results_.metrics.end(), metric) - results_.metrics.begin();
    for (const Point& point : results_.points)
      if (point.series == series && (setting.empty() || point.setting == setting))
        return point.values.at(static_cast<std::size_t>(column));
    ADD_FAILURE() << "no point " << series << " " << setting;
    return NAN;
  }

  /// All have a cost and a value for each metric; none failed.
  void expect_sound(std::size_t count) const {
    EXPECT_EQ(results_.points.size(), count);
    for (const Point& point : results_.points) {
      EXPECT_EQ(point.failure, "") << point.series << " " << point.setting;
      EXPECT_EQ(point.values.size(), results_.metrics.size());
      EXPECT_GT(point.cost.median, 0) << point.series;
    }
  }

 private:
  Results results_;
};

TEST(BoxExperiments, FramesFindRoomsThatCostExtraPairs) {
  const Measured measured("frames", R"({
    "inputs": [{"name": "a", "batch": "D", "step": 0.01}], "sizes": [500], "frames": 3, "boxes_in_all": 1500,
    "ways": ["detector", "world", "dbvt", {"way": "rooms", "room": 0.2}, {"way": "rooms-tested", "room": 0.2}]})");
  measured.expect_sound(5);
  EXPECT_EQ(measured.value("detector", "", "extra_per_box"), 0);
  EXPECT_EQ(measured.value("rooms-tested", "20 %", "extra_per_box"), 0);
  EXPECT_GT(measured.value("rooms", "20 %", "extra_per_box"), 1);
  EXPECT_GT(measured.value("dbvt", "", "extra_per_box"), 0);
}

TEST(BoxExperiments, FramesHaveOneKnob) {
  const Measured measured("frames", R"({
    "inputs": [{"name": "a", "batch": "U", "shares": [0, 0.5]}], "sizes": [300], "frames": 2, "boxes_in_all": 600,
    "ways": ["detector", "world"]})");
  measured.expect_sound(4);
  EXPECT_EQ(measured.value("world", "50 %", "missed"), 0);
  EXPECT_THROW(Measured("frames", R"({"inputs": [{"name": "a", "batch": "U"}], "sizes": [200, 300],
                                         "ways": [{"way": "rooms", "room": 0}]})"),
               BadExperiment);
}

TEST(BoxExperiments, FarBoxesLoseTheirGapsByKindOfNumber) {
  const Measured measured("far-boxes", R"({
    "edge": 4, "offsets": [0, 100000000], "inputs": [{"name": "a", "side": 1, "gap": 0.001}],
    "numbers": ["double", "float", "float, outward", "AxisSweep16", "AxisSweep32"]})");
  measured.expect_sound(10);
  for (const char* const numbers : {"double", "float", "float, outward", "AxisSweep16", "AxisSweep32"}) {
    EXPECT_EQ(measured.value(numbers, "0 m", "extra_per_box"), 0) << numbers;
    EXPECT_EQ(measured.value(numbers, "1e+08 m", "missed"), 0) << numbers;
  }
  EXPECT_EQ(measured.value("double", "1e+08 m", "extra_per_box"), 0);
  // A float there steps by 8 m: everything touches everything when it is rounded outward.
  EXPECT_EQ(measured.value("float, outward", "1e+08 m", "extra_per_box"), 31.5);
  EXPECT_EQ(measured.value("AxisSweep16", "1e+08 m", "extra_per_box"), 31.5);
  EXPECT_GT(measured.value("float", "1e+08 m", "share_cut_off"), 0.9);
  EXPECT_EQ(measured.value("float, outward", "1e+08 m", "share_cut_off"), 0);
}

TEST(BoxExperiments, TightBoxesSpareRodsTheNarrowPhase) {
  const Measured measured("fcl-boxes", R"({"name": "a", "rods": 60, "spacing": 3, "aspects": [1, 30]})");
  measured.expect_sound(8);
  EXPECT_LT(measured.value("boxstream, tight", "30 : 1", "narrow_calls"),
            0.5 * measured.value("boxstream, loose", "30 : 1", "narrow_calls"));
  EXPECT_EQ(measured.value("boxstream, tight", "30 : 1", "narrow_calls"),
            measured.value("FCL's tree, tight", "30 : 1", "narrow_calls"));
}

TEST(BoxExperiments, ManagersAllSayTheSame) {
  const Measured measured("fcl-managers", R"({"objects": 60, "inputs": [
    {"name": "a", "query": "pairs", "spacing": 1.2}, {"name": "b", "query": "distance", "spacing": 2.2}]})");
  EXPECT_GE(measured.points().size(), 8u);
  EXPECT_EQ(measured.value("ours", "", "missed"), 0);
  for (const Point& point : measured.points()) EXPECT_EQ(point.failure, "") << point.panel << " " << point.series;
}

TEST(BoxExperiments, EveryFormOfOutputIsRight) {
  const Measured measured("outputs", R"({"boxes": 200, "shares": [0.01, 1],
    "outputs": ["counted", "streamed", "listed", "sorted", "changes, merged", "changes, world", "cgal:100"]})");
  measured.expect_sound(14);
  EXPECT_GT(measured.points().front().x, 0.005);
  EXPECT_LT(measured.points().front().x, 0.02);
  EXPECT_GT(measured.points().back().x, 0.95);
}

TEST(BoxExperiments, AllCellsAreAlike) {
  const Measured measured("cells", R"({"boxes": 500, "batches": ["M"], "most_threads": 2})");
  EXPECT_GE(measured.points().size(), 2u);
  measured.expect_sound(measured.points().size());
  for (const Point& point : measured.points()) EXPECT_EQ(point.values.back(), 0) << point.series;
}

TEST(BoxExperiments, KindsOfBoxesMissNothing) {
  const Measured measured("box-kinds", R"({
    "scenes": [{"scene": "demos/scenes/broadmark_fall_cubes.json", "scale": 0.2, "before": 1}],
    "steps": 2, "look_every": 1, "boxes": ["bullet", "tight", {"box": "margin", "values": [0.2]},
    {"box": "float", "values": [1e6]}, {"box": "float, outward", "values": [1e6]}, {"box": "16 bit", "values": [1000]},
    "cube", "sphere"]})");
  measured.expect_sound(8);
  EXPECT_EQ(measured.value("tight", "", "extra"), 0);
  EXPECT_GT(measured.value("sphere", "", "extra"), measured.value("bullet", "", "extra"));
  EXPECT_EQ(measured.value("bullet", "", "steps_alike"), 3);
}

TEST(BoxExperiments, ErrorsInSettingsNameTheFile) {
  const auto complaint = [](const char* kind, const char* settings) -> std::string {
    try {
      Measured(kind, settings);
    } catch (const BadExperiment& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(
      complaint("frames", R"({"ways": ["sideways"], "inputs": []})").rfind("test.json: no method \"sideways\"", 0), 0u);
  EXPECT_EQ(complaint("frames", "{}").rfind("test.json: ", 0), 0u);
  EXPECT_EQ(complaint("far-boxes", R"({"edge": 40, "offsets": [], "inputs": [{"name": "a"}], "numbers": []})"),
            "test.json: \"edge\" is from 2 to 30");
  EXPECT_EQ(complaint("box-kinds", R"({"scenes": [{"scene": "nowhere.json"}]})").rfind("test.json: ", 0), 0u);
  EXPECT_EQ(complaint("cells", R"({"boxes": 10, "batches": ["Q"]})").rfind("test.json: no batch", 0), 0u);
}

}  // namespace
}  // namespace boxstream::report
