// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "gallery.hpp"
#include "probe.hpp"

namespace boxstream::effects_test {
namespace {

/// A counter that stays at 0 unless one of some effects is on, and for some of them does not.
struct Row {
  const char* counter;
  Names needs;      // one of them, or exactly 0
  Names witnesses;  // scenes of the gallery where it is more than 0
};

const std::vector<Row>& rows() {
  const Names collide{"contacts", "sensors", "characters", "soft_bodies", "vehicles", "queries"};
  const Names swept{"ccd", "ccd_on_demand"};
  static const std::vector<Row> all{
      {"boxes set", collide, collide},
      {"searches for pairs", collide, collide},
      {"boxes of sleepers set", {"forced_boxes"}, {"forced_boxes"}},
      {"sleeping bodies", {"sleeping"}, {"sleeping", "forced_boxes"}},
      {"rays", {"queries", "vehicles", "ccd", "ccd_on_demand"}, {"queries", "vehicles", "ccd"}},
      {"box queries", {"queries", "ccd_on_demand"}, {"queries"}},
      {"objects taken out", {"respawn", "out_of_bounds"}, {"respawn", "out_of_bounds"}},
      {"manifolds", {"contacts"}, {"contacts", "friction", "planes", "meshes", "heightfields", "compounds", "respawn"}},
      {"contact rows", {"contacts"}, {"contacts", "friction", "planes", "meshes", "heightfields", "compounds"}},
      {"friction rows", {"friction"}, {"friction", "friction_caching", "rolling_friction", "anisotropic_friction"}},
      {"rolling rows", {"rolling_friction", "spinning_friction"}, {"rolling_friction", "spinning_friction"}},
      {"joint rows", {"joints"}, {"joints", "joint_limits", "motors"}},
      {"limit rows", {"joint_limits"}, {"joint_limits"}},
      {"motor rows", {"motors"}, {"motors"}},
      {"rows of another solver", {"other_solver"}, {"other_solver"}},
      {"constraints", {"joints"}, {"joints", "joint_limits", "motors"}},
      {"ghost pairs", {"sensors", "characters"}, {"sensors", "characters"}},
      {"ghost callbacks", {"sensors", "characters"}, {"sensors", "characters"}},
      {"clamped motions", swept, swept},
      {"bodies that are swept", swept, swept},
      {"swept boxes", swept, swept},
      {"split impulse recoveries", {"split_impulse"}, {"split_impulse"}},
      {"split impulse", {"split_impulse"}, {"split_impulse"}},
      {"friction caching", {"friction_caching"}, {"friction_caching"}},
      {"kinematic bodies", {"kinematic", "conveyors"}, {"kinematic", "conveyors"}},
      {"bodies with friction", {"friction"}, {"friction"}},
      {"bodies with anisotropic friction", {"anisotropic_friction"}, {"anisotropic_friction"}},
      {"bodies with rolling friction", {"rolling_friction"}, {"rolling_friction"}},
      {"bodies with spinning friction", {"spinning_friction"}, {"spinning_friction"}},
      {"bodies that bounce", {"restitution"}, {"restitution", "bounces_on_contact"}},
      {"bodies with damping", {"damping"}, {"damping"}},
      {"bodies that fall", {"gravity", "tumbling_gravity"}, {"gravity", "tumbling_gravity"}},
      {"bodies with a contact callback", {"internal_edges"}, {"internal_edges"}},
      {"contact callbacks", {"internal_edges"}, {"internal_edges"}},
      {"bodies that ignore others", {"exclusions", "joints"}, {"exclusions"}},
      {"bodies with a group of their own", {"collision_filters"}, {"collision_filters"}},
      {"planes", {"planes"}, {"planes"}},
      {"height fields", {"heightfields"}, {"heightfields"}},
      {"meshes", {"meshes"}, {"meshes", "internal_edges"}},
      {"compounds", {"compounds"}, {"compounds"}},
      {"bodies whose contacts are found in units", {"unit_contacts"}, {"unit_contacts"}},
      {"soft worlds", {"soft_bodies"}, {"soft_bodies"}},
      {"actions", {"characters", "vehicles"}, {"characters", "vehicles"}},
  };
  return all;
}

/// Effects that call something of their own in each step; the others are a part of Bullet that is switched on.
const Names hooked{
    "tumbling_gravity", "kinematic",          "characters", "soft_bodies",   "vortex",  "wind",          "drag",
    "buoyancy",         "impulses",           "respawn",    "out_of_bounds", "queries", "ccd_on_demand", "sensors",
    "gyroscopic",       "bounces_on_contact", "multibodies"};

bool meet(const Names& a, const Names& b) {
  return std::any_of(a.begin(), a.end(), [&](const std::string& name) { return b.count(name) > 0; });
}

class CountersOf : public testing::TestWithParam<Exhibit> {};

TEST_P(CountersOf, AreZeroWhereTheirEffectIsOff) {
  const Names on = names_of(GetParam());
  const Counts counts = count(exhibit(GetParam().name));
  std::size_t seen = 0;
  for (const Row& row : rows()) {
    ASSERT_EQ(counts.count(row.counter), 1u) << row.counter;
    ++seen;
    const double value = counts.at(row.counter);
    if (!meet(row.needs, on)) {
      EXPECT_EQ(value, 0) << row.counter;
    }
    if (row.witnesses.count(GetParam().name) > 0) {
      EXPECT_GT(value, 0) << row.counter;
    }
  }
  for (const effects::Effect* const effect : effects::all_effects()) {
    ++seen;
    const double calls = counts.at(std::string("hooks of ") + effect->name);
    if (on.count(effect->name) == 0 || hooked.count(effect->name) == 0) {
      EXPECT_EQ(calls, 0) << effect->name;
    } else {
      EXPECT_GE(calls, exhibit(GetParam().name).time.steps) << effect->name;
    }
  }
  EXPECT_EQ(counts.size(), seen) << "a counter that no row speaks of";
}

INSTANTIATE_TEST_SUITE_P(Gallery, CountersOf, testing::ValuesIn(gallery()),
                         [](const auto& test) { return name_of_exhibit(test.param); });

TEST(Counters, EachEffectIsCounted) {
  // Of these nothing is in the world that could be counted.
  const Names uncounted{"monitors", "recording", "threads"};
  for (const effects::Effect* const effect : effects::all_effects()) {
    const bool is_counted =
        hooked.contains(effect->name) ||
        std::any_of(rows().begin(), rows().end(), [&](const Row& row) { return row.needs.contains(effect->name); });
    EXPECT_NE(is_counted, uncounted.contains(effect->name)) << effect->name;
  }
}

TEST(Counters, EachRowHasAWitness) {
  for (const Row& row : rows()) {
    EXPECT_FALSE(row.witnesses.empty()) << row.counter;
    for (const std::string& name : row.witnesses)
      EXPECT_TRUE(std::any_of(gallery().begin(), gallery().end(), [&](const Exhibit& e) { return e.name == name; }))
          << name;
  }
}

}  // namespace
}  // namespace boxstream::effects_test
