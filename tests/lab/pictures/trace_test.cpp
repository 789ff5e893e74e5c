// SPDX-License-Identifier: MIT
#include "pictures/viewer/trace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mixed.hpp"

namespace boxstream::view {
namespace {

using Json = nlohmann::json;

std::int64_t nanoseconds(const Json& microseconds) {
  return std::llround(microseconds.get<double>() * 1000);
}

TEST(Trace, PhasesNestInTheirStepsAndAddUpToThem) {
  const scenes::Scene scene = view_test::mixed_scene();
  scenes::Simulation simulation(scene, "boxstream");
  std::vector<scenes::StepResult> steps;
  for (int i = 0; i < 20; ++i) steps.push_back(simulation.step());
  std::ostringstream out;
  write_trace(out, scene, {{"boxstream", &steps}, {"dbvt", &steps}}, "made by \"x\"");
  const Json trace = Json::parse(out.str());
  EXPECT_EQ(trace["otherData"]["made_by"], "made by \"x\"");

  for (const int process : {1, 2}) {
    std::vector<Json> wholes;
    std::vector<std::vector<Json>> parts;
    std::map<std::string, std::vector<std::uint64_t>> counters;
    for (const Json& event : trace["traceEvents"]) {
      if (event["pid"] != process) continue;
      if (event["ph"] == "C") counters[event["name"]].push_back(event["args"]["value"]);
      if (event["ph"] != "X") continue;
      if (event["name"] == "step") {
        wholes.push_back(event);
        parts.emplace_back();
      } else {
        ASSERT_FALSE(parts.empty());
        parts.back().push_back(event);
      }
    }
    ASSERT_EQ(wholes.size(), steps.size());
    std::int64_t now = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(nanoseconds(wholes[i]["ts"]), now);
      EXPECT_EQ(wholes[i]["args"]["step"], i + 1);
      EXPECT_NEAR(static_cast<double>(nanoseconds(wholes[i]["dur"])), steps[i].step_ms * 1e6, 4);
      ASSERT_EQ(parts[i].size(), 5U);
      const double phases[] = {steps[i].update_aabbs_ms, steps[i].overlapping_pairs_ms, steps[i].dispatch_ms,
                               steps[i].solve_ms};
      for (std::size_t k = 0; k < parts[i].size(); ++k) {
        EXPECT_EQ(nanoseconds(parts[i][k]["ts"]), now) << parts[i][k]["name"];
        if (k < 4) {
          EXPECT_NEAR(static_cast<double>(nanoseconds(parts[i][k]["dur"])), phases[k] * 1e6, 1);
        }
        EXPECT_GE(nanoseconds(parts[i][k]["dur"]), 0);
        now += nanoseconds(parts[i][k]["dur"]);
      }
      EXPECT_EQ(parts[i][4]["name"], "rest");
      EXPECT_EQ(now, nanoseconds(wholes[i]["ts"]) + nanoseconds(wholes[i]["dur"]));
      EXPECT_EQ(counters["pairs"].at(i), steps[i].pairs);
      EXPECT_EQ(counters["pairs begun"].at(i), steps[i].begun);
      EXPECT_EQ(counters["pairs ended"].at(i), steps[i].ended);
      EXPECT_EQ(counters["objects"].at(i), steps[i].bodies);
    }
  }
}

}  // namespace
}  // namespace boxstream::view
