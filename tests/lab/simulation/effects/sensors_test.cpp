// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using effects::SensorEvent;
using nlohmann::json;

/// A ball of 1 m that drifts along x, and a gate of 1 m with its middle half a metre ahead, with a change.
std::vector<SensorEvent> events_of(const std::vector<json>& patch, int steps) {
  json document = document_of("sensors").patch(patch);
  document.erase("expect");
  scenes::Simulation simulation(scene_of(document), "boxstream");
  std::vector<SensorEvent> events;
  for (int i = 0; i < steps; ++i)
    for (const SensorEvent& event : simulation.step().sensor_events) events.push_back(event);
  return events;
}

json set_to(const char* pointer, const json& value) {
  return {{"op", "add"}, {"path", pointer}, {"value", value}};
}

const std::vector<SensorEvent> came{{0, 0, true}}, came_and_left{{0, 0, true}, {0, 0, false}};

TEST(Sensors, TellWhatCameInDuringWarmUpInTheFirstStep) {
  const json warm_up = set_to("/time/warmup_steps", 30);
  EXPECT_EQ(events_of({warm_up}, 1), came);
  EXPECT_EQ(events_of({warm_up, set_to("/bodies/0/velocity", {2, 0, 0})}, 60), came_and_left);
}

TEST(Sensors, SeeKinematicBodies) {
  const json still = {{"op", "remove"}, {"path", "/bodies/0/mass"}}, kinematic = set_to("/bodies/0/type", "kinematic");
  EXPECT_EQ(events_of({still, kinematic, set_to("/bodies/0/velocity", {2, 0, 0})}, 60), came_and_left);
  EXPECT_EQ(events_of({still, kinematic, set_to("/bodies/0/group", 1)}, 10), came) << "once";
  EXPECT_EQ(events_of({still, kinematic, set_to("/bodies/0/position", {9, 0, 0})}, 10), std::vector<SensorEvent>{});
}

TEST(Sensors, DoNotSeeFixedBodies) {
  const json no_mass = {{"op", "remove"}, {"path", "/bodies/0/mass"}};
  const json still = {{"op", "remove"}, {"path", "/bodies/0/velocity"}}, fixed = set_to("/bodies/0/type", "static");
  EXPECT_EQ(events_of({no_mass, still, fixed}, 2), std::vector<SensorEvent>{});
  EXPECT_EQ(events_of({no_mass, still, fixed, set_to("/bodies/0/group", 1)}, 2), std::vector<SensorEvent>{});
}

TEST(Sensors, TellWhereRainPutsABodyAnew) {
  const std::vector<json> rain{{{"op", "remove"}, {"path", "/bodies/0"}},
                               set_to("/generators", {{{"type", "respawn"},
                                                       {"count", 1},
                                                       {"every", 5},
                                                       {"origin", {0.5, 0.5, 0}},
                                                       {"size", {0.1, 0.1, 0.1}},
                                                       {"mix", {{{"shape", "ball"}, {"mass", 1}}}}}})};
  EXPECT_EQ(events_of(rain, 11),
            (std::vector<SensorEvent>{{0, 0, true}, {0, 0, false}, {0, 0, true}, {0, 0, false}, {0, 0, true}}));
}

}  // namespace
}  // namespace boxstream::effects_test
