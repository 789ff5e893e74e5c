// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

// Contacts of bodies that slide.
namespace boxstream::effects_test {
namespace {

using nlohmann::json;

/// How far a body of 5 m/s comes on a plane with friction 0.5, as a share of v^2 / 2 mu g, and how far aside.
std::pair<double, double> way_on_plane(const json& shape, double height) {
  json document = document_of("contacts");
  document.erase("expect");
  document["materials"]["smooth"] = {{"friction", std::sqrt(0.5)}};
  document["shapes"] = {shape, {{"name", "ground"}, {"type", "plane"}, {"normal", {0, 1, 0}}}};
  document["bodies"][0]["position"] = {0, height, 0};
  document["bodies"][0]["velocity"] = {4, 0, 3};
  document["bodies"][0]["sleep"] = false;
  document["bodies"][1]["position"] = {0, 0, 0};
  scenes::Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 120; ++i) simulation.advance();
  const btVector3& end = simulation.objects()[0]->getWorldTransform().getOrigin();
  const double x = double{end.x()}, z = double{end.z()};
  return {std::hypot(x, z) / (25 / (2 * 0.5 * 9.81)), std::abs(3 * x - 4 * z) / 5};
}

TEST(Sliding, OnAPlaneGoesStraightAndAsFarAsFrictionLetsIt) {
  const json plank = {{"name", "ball"}, {"type", "box"}, {"half_extents", {1, 0.1, 0.3}}},
             cube = {{"name", "ball"}, {"type", "box"}, {"half_extents", {0.5, 0.5, 0.5}}};
  for (const auto& [shape, height] : {std::pair{plank, 0.1}, std::pair{cube, 0.5}}) {
    const auto [way, aside] = way_on_plane(shape, height);
    EXPECT_NEAR(way, 1, 0.02) << shape;
    EXPECT_LT(aside, 0.03) << shape;
  }
}

}  // namespace
}  // namespace boxstream::effects_test
