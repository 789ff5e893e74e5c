// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "every_kind.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::scenes_test {
namespace {

using namespace scenes;

constexpr double radians = std::numbers::pi / 180;

const Scene& loaded() {
  static const Scene scene = load_scene(every_kind_file);
  return scene;
}

/// A scene of nothing but what has no default.
Scene bare() {
  return parse_scene(R"({"format": 1, "meta": {"name": "bare", "about": "Nothing."}, "time": {"dt": 0.02},
    "world": {"bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}}})",
                     "bare");
}

TEST(Load, TimeWorldAndSolver) {
  const Scene& scene = loaded();
  EXPECT_EQ(scene.time.dt, 0.01);
  EXPECT_EQ(scene.time.substeps, 2);
  EXPECT_EQ(scene.time.steps, 40);
  EXPECT_EQ(scene.time.warmup_steps, 5);
  ASSERT_TRUE(scene.world.tumbling);
  EXPECT_EQ(scene.world.tumbling->strength, 9.81);
  EXPECT_EQ(scene.world.tumbling->degrees_per_second, 30);
  EXPECT_EQ(scene.world.on_leave, OnLeave::freeze);
  EXPECT_EQ(scene.world.seed, 9u);
  EXPECT_EQ(scene.solver.iterations, 20);
  EXPECT_EQ(scene.solver.residual, 1e-6);
  EXPECT_FALSE(scene.solver.warmstart);
  EXPECT_EQ(scene.solver.erp, 0.3);
  EXPECT_EQ(scene.solver.slop, 0.001);
  EXPECT_EQ(scene.solver.contact_erp, 0.1);
  EXPECT_EQ(scene.solver.friction_directions, FrictionDirections::two_fixed);
  EXPECT_EQ(scene.solver.kind, SolverKind::nncg);
  EXPECT_EQ(scene.solver.bounces, Bounces::on_contact);
  EXPECT_EQ(scene.solver.precision, Precision::single);
  EXPECT_EQ(scene.broadphase.kind, "dbvt");
  EXPECT_EQ(scene.broadphase.threads, 2);
  EXPECT_TRUE(scene.broadphase.force_boxes);
}

TEST(Load, WhatIsAbsentHasItsDefault) {
  const Scene scene = bare();
  EXPECT_EQ(scene.time.substeps, 1);
  EXPECT_EQ(scene.time.steps, 600);
  EXPECT_EQ(scene.time.warmup_steps, 0);
  EXPECT_EQ(scene.world.gravity, (Vec3{0, -9.81, 0}));
  EXPECT_FALSE(scene.world.tumbling);
  EXPECT_EQ(scene.world.on_leave, OnLeave::nothing);
  EXPECT_TRUE(scene.solver.warmstart);
  EXPECT_EQ(scene.solver.erp, 0.2);
  EXPECT_EQ(scene.broadphase.kind, "boxstream");
  EXPECT_EQ(scene.broadphase.threads, 1);
  EXPECT_TRUE(scene.outputs.record.empty());
  EXPECT_EQ(scene.outputs.view + scene.outputs.csv + scene.outputs.trace, "");
}

TEST(Load, WholeNumbersMayBeWrittenLikeOthers) {
  nlohmann::json document = every_kind();
  document["time"]["steps"] = 1e2;
  document["world"]["seed"] = 12.0;
  const Scene scene = parse_scene(document.dump(), every_kind_file);
  EXPECT_EQ(scene.time.steps, 100);
  EXPECT_EQ(scene.world.seed, 12u);
}

TEST(Load, GravityAsAVector) {
  nlohmann::json document = every_kind();
  document["world"]["gravity"] = {1, 2, 3};
  const Scene scene = parse_scene(document.dump(), every_kind_file);
  EXPECT_FALSE(scene.world.tumbling);
  EXPECT_EQ(scene.world.gravity, (Vec3{1, 2, 3}));
}

/// `every_kind`, in the words that scene files had until 0.1.
nlohmann::json in_old_words() {
  nlohmann::json document = every_kind();
  document["apart"] = document["exclusions"];
  document.erase("exclusions");
  for (nlohmann::json& field : document["fields"])
    for (const auto& [now, old] : {std::pair("vortex", "swirl"), {"impulses", "kicks"}})
      if (field["type"] == now) field["type"] = old;
  for (nlohmann::json& generator : document["generators"]) {
    if (generator["type"] == "respawn") generator["type"] = "rain";
    if (!generator.contains("vortex")) continue;
    generator["swirl"] = generator["vortex"];
    generator.erase("vortex");
  }
  document["effects"] = {{"require", {"gravity", "observers"}}, {"forbid", {"leaving"}}};
  return document;
}

TEST(Load, OldWordsAreReadAndNamedOnce) {
  EXPECT_TRUE(loaded().old_words.empty());
  const Scene scene = parse_scene(in_old_words().dump(), every_kind_file);
  EXPECT_EQ(scene.old_words,
            (std::vector<std::string>{R"("apart" is "exclusions" now)", R"("swirl" is "vortex" now)",
                                      R"("kicks" is "impulses" now)", R"("rain" is "respawn" now)",
                                      R"("observers" is "monitors" now)", R"("leaving" is "out_of_bounds" now)"}));
  EXPECT_EQ(scene.exclusions, loaded().exclusions);
  ASSERT_EQ(scene.fields.size(), loaded().fields.size());
  for (std::size_t i = 0; i < scene.fields.size(); ++i) EXPECT_EQ(scene.fields[i].index(), loaded().fields[i].index());
  ASSERT_EQ(scene.generators.size(), loaded().generators.size());
  for (std::size_t i = 0; i < scene.generators.size(); ++i)
    EXPECT_EQ(scene.generators[i].index(), loaded().generators[i].index());
  EXPECT_EQ(scene.effects.require, (std::vector<std::string>{"gravity", "monitors"}));
  EXPECT_EQ(scene.effects.forbid, (std::vector<std::string>{"out_of_bounds"}));
}

TEST(Load, AnOldWordBesideTheNewOneIsRefused) {
  nlohmann::json document = every_kind();
  document["apart"] = document["exclusions"];
  EXPECT_THROW(parse_scene(document.dump(), every_kind_file), SceneError);
}

TEST(Load, TraitsOfBodies) {
  const Scene& scene = loaded();
  const BodyTraits& one = scene.bodies[1].traits;
  EXPECT_FALSE(one.ccd);
  EXPECT_FALSE(one.may_ccd);
  EXPECT_EQ(one.gyro, Gyro::conserving);
  EXPECT_FALSE(one.sleep);
  const BodyTraits& two = scene.bodies[2].traits;
  ASSERT_TRUE(two.ccd);
  EXPECT_TRUE(two.may_ccd);
  EXPECT_EQ(two.ccd->threshold, 0.5);
  EXPECT_EQ(two.ccd->radius, 0.2);
  EXPECT_FALSE(two.gyro);
  EXPECT_EQ(scene.bodies[0].surface_velocity, (Vec3{0.5, 0, 0}));
  EXPECT_EQ(scene.bodies[0].traits.material.anisotropic, (Vec3{1, 0.5, 1}));
  EXPECT_EQ(two.material.anisotropic, (Vec3{1, 1, 1}));
  EXPECT_EQ(std::get<GridGenerator>(scene.generators[1]).mix[0].traits.gyro, Gyro::explicit_step);
}

TEST(Load, Meshes) {
  const auto& net = std::get<MeshShape>(loaded().shapes[9].value);
  EXPECT_TRUE(net.internal_edges);
  const auto& sheet = std::get<MeshShape>(loaded().shapes[10].value);
  EXPECT_FALSE(sheet.internal_edges);
  EXPECT_EQ(sheet.vertices[1], (Vec3{-9, 0, 9}));
}

TEST(Load, JointsInRadiansAndMetres) {
  const std::vector<Joint>& joints = loaded().joints;
  const auto& hinge = std::get<HingeJoint>(joints[0].value);
  EXPECT_TRUE(joints[0].collide);
  EXPECT_EQ(hinge.limits, (std::array{-90 * radians, 90 * radians}));
  ASSERT_TRUE(hinge.motor);
  EXPECT_EQ(hinge.motor->speed, 3);
  EXPECT_EQ(hinge.motor->max_force, 50);
  EXPECT_FALSE(joints[1].b);
  const auto& cone = std::get<ConeTwistJoint>(joints[2].value);
  EXPECT_EQ((std::array{cone.swing1, cone.swing2, cone.twist}), (std::array{30 * radians, 45 * radians, 10 * radians}));
  const auto& slider = std::get<SliderJoint>(joints[3].value);
  EXPECT_EQ(slider.axis, (Vec3{0, 0, 1}));
  EXPECT_EQ(slider.limits, (std::array{-1.0, 2.0}));
  ASSERT_TRUE(slider.motor);
  EXPECT_EQ(slider.motor->speed, -1);
  EXPECT_EQ(std::get<FixedJoint>(joints[4].value).pivot, (Vec3{1, 1, 1}));
  const auto& six = std::get<SixDofJoint>(joints[5].value);
  EXPECT_GT(six.linear[0][0], six.linear[0][1]);  // free
  EXPECT_EQ(six.linear[1], (std::array{-1.0, 1.0}));
  EXPECT_EQ(six.linear[2], (std::array{0.0, 0.0}));  // locked
  EXPECT_EQ(six.angular[0], (std::array{-90 * radians, 45 * radians}));
  EXPECT_EQ(six.angular[1], (std::array{0.0, 0.0}));
  EXPECT_GT(six.angular[2][0], six.angular[2][1]);
  const auto& spring = std::get<SpringJoint>(joints[6].value);
  EXPECT_EQ(spring.stiffness, 100);
  EXPECT_EQ(spring.damping, 2);
  const auto& gear = std::get<GearJoint>(joints[7].value);
  EXPECT_EQ(gear.axis, (Vec3{0, 0, 1}));
  EXPECT_EQ(gear.axis_b, (Vec3{1, 0, 0}));
  EXPECT_EQ(gear.ratio, -2);
}

TEST(Load, AxesOfASixDofJointAreLockedIfAbsent) {
  nlohmann::json document = every_kind();
  document["joints"][5].erase("linear");
  document["joints"][5].erase("angular");
  const Scene scene = parse_scene(document.dump(), every_kind_file);
  const auto& six = std::get<SixDofJoint>(scene.joints[5].value);
  EXPECT_EQ(six.linear, (decltype(six.linear){}));
  EXPECT_EQ(six.angular, (decltype(six.angular){}));
}

TEST(Load, NamesBecomeIndices) {
  const Scene& scene = loaded();
  EXPECT_EQ(scene.exclusions, (std::vector<std::array<std::size_t, 2>>{{1, 2}, {0, 1}}));
  EXPECT_EQ(scene.joints[3].a, 3u);
  EXPECT_EQ(scene.joints[3].b, 1u);
  EXPECT_EQ(std::get<ContactQuery>(scene.queries[2]).body, 2u);
  EXPECT_EQ(scene.vehicles[0].chassis, 4u);
}

TEST(Load, Vehicles) {
  const Vehicle& car = loaded().vehicles.at(0);
  ASSERT_EQ(car.wheels.size(), 3u);
  EXPECT_EQ(car.wheels[0].at, (Vec3{0.5, -0.4, 0.5}));
  EXPECT_EQ(car.wheels[0].radius, 0.2);
  EXPECT_TRUE(car.wheels[0].steered);
  EXPECT_FALSE(car.wheels[0].driven);
  EXPECT_EQ(car.wheels[1].radius, 0.3);
  EXPECT_TRUE(car.wheels[2].driven);
  EXPECT_EQ(car.suspension, 0.3);
  EXPECT_EQ(car.stiffness, 30);
  EXPECT_EQ(car.grip, 1.2);
  EXPECT_EQ(car.engine, 500);
  EXPECT_EQ(car.brake, 1);
  EXPECT_EQ(car.steer, 30 * radians);
}

TEST(Load, FieldsAndQueries) {
  const Scene& scene = loaded();
  ASSERT_EQ(scene.fields.size(), 5u);
  EXPECT_EQ(std::get<VortexField>(scene.fields[0]).rate, 3);
  const auto& wind = std::get<WindField>(scene.fields[1]);
  EXPECT_EQ(wind.velocity, (Vec3{3, 0, 0}));
  EXPECT_EQ(wind.density, 1.3);
  EXPECT_EQ(wind.coefficient, 0.4);
  const auto& drag = std::get<DragField>(scene.fields[2]);
  EXPECT_EQ((std::array{drag.linear, drag.quadratic, drag.angular}), (std::array{0.1, 0.2, 0.3}));
  EXPECT_EQ((std::array{drag.density, drag.coefficient}), (std::array{1.1, 0.7}));
  const auto& buoyancy = std::get<BuoyancyField>(scene.fields[3]);
  EXPECT_EQ((std::array{buoyancy.level, buoyancy.density, buoyancy.drag}), (std::array{1.0, 900.0, 2.0}));
  const auto& impulses = std::get<ImpulsesField>(scene.fields[4]);
  EXPECT_EQ((std::array{impulses.share, impulses.speed}), (std::array{0.5, 3.0}));
  ASSERT_EQ(scene.queries.size(), 3u);
  EXPECT_EQ(std::get<RayFan>(scene.queries[0]).degrees, 2);
  EXPECT_EQ(std::get<BoxQuery>(scene.queries[1]).bounds.max, (Vec3{1, 1, 1}));
}

TEST(Load, EffectsChecksAndOutputs) {
  const Scene& scene = loaded();
  EXPECT_EQ(scene.effects.require, std::vector<std::string>{"joints"});
  EXPECT_EQ(scene.effects.forbid, std::vector<std::string>{"gravity"});
  ASSERT_EQ(scene.checks.size(), 5u);
  EXPECT_EQ(scene.checks[0].metric, Check::Metric::missed_pairs);
  EXPECT_EQ(scene.checks[0].op, Check::Op::equal);
  EXPECT_TRUE(scene.checks[0].at_end);
  EXPECT_EQ(scene.checks[1].metric, Check::Metric::max_penetration);
  EXPECT_EQ(scene.checks[1].op, Check::Op::less);
  EXPECT_EQ(scene.checks[1].value, 0.5);
  EXPECT_FALSE(scene.checks[1].at_end);
  EXPECT_EQ(scene.checks[1].at, 0u);
  EXPECT_EQ(scene.checks[2].op, Check::Op::greater);
  EXPECT_EQ(scene.checks[2].at, 20u);
  EXPECT_EQ(scene.checks[3].op, Check::Op::at_least);
  EXPECT_EQ(scene.checks[3].at, 0u);
  EXPECT_EQ(scene.checks[4].op, Check::Op::at_most);
  EXPECT_EQ(scene.outputs.record, (std::vector<std::string>{"run.bsrec", "out/run.aabbs", "run.glb"}));
  EXPECT_EQ(scene.outputs.view, "run.html");
  EXPECT_EQ(scene.outputs.csv, "run.csv");
  EXPECT_EQ(scene.outputs.trace, "run.json");
}

TEST(Load, MetricsAndOperatorsHaveTheNamesOfTheirEnumerators) {
  EXPECT_STREQ(name_of(Check::Metric::missed_pairs), "missed_pairs");
  EXPECT_STREQ(name_of(Check::Metric::energy_drift), "energy_drift");
  EXPECT_STREQ(name_of(Check::Metric::lowest), "lowest");
  EXPECT_EQ(metric_names().size(), static_cast<std::size_t>(Check::Metric::highest) + 1);
  EXPECT_STREQ(name_of(Check::Op::less), "<");
  EXPECT_STREQ(name_of(Check::Op::greater), ">");
  EXPECT_EQ(op_names().size(), static_cast<std::size_t>(Check::Op::greater) + 1);
}

}  // namespace
}  // namespace boxstream::scenes_test
