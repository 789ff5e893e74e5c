// SPDX-License-Identifier: MIT
#include "pictures/viewer/kept.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <btBulletDynamicsCommon.h>
#include <nlohmann/json.hpp>

#include "formats/scene_json/load_scene.hpp"
#include "mixed.hpp"
#include "pictures/viewer/model.hpp"
#include "pictures/viewer/page.hpp"
#include "pictures/viewer/recording.hpp"
#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {
namespace {

constexpr std::size_t grains = 3000, most = 500;
// A floor and a grain that the scene names, the walls and the floor of a container, boulders of five times the size.
constexpr std::size_t named = 2, walls = 5, boulders = 7;

const char* const scene_text = R"({
  "format": 1,
  "meta": {"name": "grains", "about": "Grains.", "source": "made for boxstream, MIT", "tags": ["test"]},
  "time": {"dt": 0.01, "steps": 10},
  "world": {"gravity": [0, -9.81, 0], "bounds": {"min": [-50, -50, -50], "max": [50, 50, 50]}, "seed": 1},
  "shapes": [
    {"name": "ground", "type": "plane", "normal": [0, 1, 0]},
    {"name": "grain", "type": "sphere", "radius": 0.1},
    {"name": "boulder", "type": "sphere", "radius": 0.5}
  ],
  "bodies": [
    {"name": "floor", "type": "static", "shape": "ground"},
    {"name": "one", "shape": "grain", "density": 1000, "position": [0, 9, 0]}
  ],
  "generators": [
    {"type": "container", "floor": [0, 0, 0], "size": [8, 4, 8], "thickness": 1},
    {"type": "grid", "count": 7, "columns": [7, 1], "spacing": [1.01, 1, 1], "origin": [0, 6, 0],
     "mix": [{"shape": "boulder", "density": 1000}]},
    {"type": "grid", "count": 3000, "columns": [15, 15], "spacing": [0.21, 0.19, 0.21], "origin": [0, 0.2, 0],
     "mix": [{"shape": "grain", "density": 1000}]}
  ]
})";

scenes::Scene grains_scene() {
  return scenes::parse_scene(scene_text, "grains");
}

bool has(const Kept& kept, std::size_t object) {
  return kept.place_of(static_cast<std::uint32_t>(object)) != Kept::none;
}

TEST(Kept, FewObjectsAreAllKept) {
  const scenes::Simulation simulation(view_test::mixed_scene(), "boxstream");
  const Kept kept = choose_kept(simulation, simulation.objects().size());
  EXPECT_TRUE(kept.is_all());
  EXPECT_EQ(kept.objects, keep_all(simulation).objects);
}

TEST(Kept, TheChoiceIsTheSameOnEveryBroadPhase) {
  const Kept kept = choose_kept(scenes::Simulation(grains_scene(), "boxstream"), most);
  EXPECT_EQ(kept.objects.size(), most);
  EXPECT_TRUE(std::is_sorted(kept.objects.begin(), kept.objects.end()));
  EXPECT_EQ(choose_kept(scenes::Simulation(grains_scene(), "boxstream"), most).objects, kept.objects);
  EXPECT_EQ(choose_kept(scenes::Simulation(grains_scene(), "dbvt"), most).objects, kept.objects);
}

TEST(Kept, WhatIsNamedFixedOrLargeComesFirst) {
  const scenes::Simulation simulation(grains_scene(), "boxstream");
  const Kept kept = choose_kept(simulation, most);
  ASSERT_EQ(kept.in_world, named + walls + boulders + grains);
  EXPECT_EQ(kept.landmarks, named + walls + boulders);
  for (std::size_t i = 0; i < kept.landmarks; ++i) EXPECT_TRUE(has(kept, i)) << i;
  // Of more landmarks than half of the room, the largest: not the grain that has a name.
  const Kept few = choose_kept(simulation, 2 * (walls + boulders + 1));
  EXPECT_EQ(few.landmarks, walls + boulders + 1);
  EXPECT_TRUE(has(few, 0));
  EXPECT_EQ(few.objects.size(), 2 * (walls + boulders + 1));
}

TEST(Kept, NextComesWhatIsNearestToTheEyeAndASampleOfTheRest) {
  const scenes::Simulation simulation(grains_scene(), "boxstream");
  const Kept kept = choose_kept(simulation, most);
  const Model all = model_of(simulation);
  Snapshot snapshot;
  snapshot.read(simulation, all);
  const Point eye = first_eye(crowd_of(snapshot));
  const auto away = [&](std::size_t i) {
    const Point& p = snapshot.poses[i].position;
    return std::hypot(p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]);
  };
  std::vector<std::size_t> others;
  for (std::size_t i = kept.landmarks; i < kept.in_world; ++i) others.push_back(i);
  std::sort(others.begin(), others.end(), [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
  for (std::size_t k = 0; k < kept.nearest; ++k) EXPECT_TRUE(has(kept, others[k])) << "the nearest but " << k;
  // Of what lies behind, about equally many in each tenth.
  const std::size_t rest = others.size() - kept.nearest, sampled = most - kept.landmarks - kept.nearest;
  for (std::size_t tenth = 0; tenth < 10; ++tenth) {
    std::size_t count = 0;
    for (std::size_t k = rest * tenth / 10; k < rest * (tenth + 1) / 10; ++k)
      count += has(kept, others[kept.nearest + k]);
    EXPECT_NEAR(static_cast<double>(count), static_cast<double>(sampled) / 10, 15);
  }
}

TEST(Kept, ARecordingHasThePairsAndContactsOfWhatIsKept) {
  scenes::Simulation simulation(grains_scene(), "boxstream");
  const Kept kept = choose_kept(simulation, most);
  const Model some = model_of(simulation, kept), all = model_of(simulation);
  Snapshot seen, whole;
  for (int step = 0; step < 5; ++step) simulation.step();
  seen.read(simulation, some);
  seen.read_contacts(simulation, some);
  whole.read(simulation, all);
  whole.read_contacts(simulation, all);
  std::vector<Pair> pairs;
  for (const Pair& pair : whole.pairs)
    if (has(kept, pair.a) && has(kept, pair.b)) pairs.push_back({kept.place_of(pair.a), kept.place_of(pair.b)});
  ASSERT_GT(pairs.size(), 100U);
  ASSERT_LT(pairs.size(), whole.pairs.size() / 2);
  EXPECT_EQ(seen.pairs, pairs);
  const auto both_kept = [&](const Contact& c) { return has(kept, c.objects.a) && has(kept, c.objects.b); };
  EXPECT_EQ(seen.contacts.size(),
            static_cast<std::size_t>(std::count_if(whole.contacts.begin(), whole.contacts.end(), both_kept)));
  for (std::size_t i = 0; i < most; ++i) EXPECT_EQ(seen.poses[i].position, whole.poses[kept.objects[i]].position);
}

TEST(Kept, ThePageSaysHowManyAndCountsAll) {
  scenes::Simulation simulation(grains_scene(), "boxstream");
  Recording recording(simulation, {4, 1, 60'000'000, most});
  std::vector<scenes::StepResult> results;
  for (int step = 0; step < 4; ++step) {
    results.push_back(simulation.step());
    recording.add_step();
  }
  recording.finish();
  const auto page = nlohmann::json::parse(describe({&recording, "", &results}, "test"));
  EXPECT_EQ(page.at("kept").at("inWorld"), simulation.objects().size());
  EXPECT_EQ(page.at("states").size(), most);
  EXPECT_EQ(page.at("names").at("of").size(), most);
  std::vector<std::uint32_t> objects;
  for (const auto& step : page.at("kept").at("steps"))
    objects.push_back((objects.empty() ? 0 : objects.back()) + step.get<std::uint32_t>());
  EXPECT_EQ(objects, recording.model().kept.objects);
  for (std::size_t step = 0; step < results.size(); ++step)
    EXPECT_EQ(page.at("series").at("pairs").at(step), results[step].pairs);
  EXPECT_GT(results.back().pairs, 3 * recording.model().kept.objects.size());
}

}  // namespace
}  // namespace boxstream::view
