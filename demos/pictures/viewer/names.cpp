// SPDX-License-Identifier: MIT
#include "pictures/viewer/names.hpp"

#include <btBulletDynamicsCommon.h>

#include "formats/scene_model/expand.hpp"

namespace boxstream::view {
namespace {

/// Of an object that is no rigid body: sensors come first, then characters, then soft bodies.
const std::string& name_of(const scenes::Scene& scene, std::size_t i) {
  if (i < scene.sensors.size()) return scene.sensors[i].name;
  i -= scene.sensors.size();
  return i < scene.characters.size() ? scene.characters[i].name : scene.soft_bodies[i - scene.characters.size()].name;
}

struct Pivots {
  btVector3 in_a, in_b;
};

template <class Joint>
Pivots of_frames(const btTypedConstraint& joint) {
  const auto& known = static_cast<const Joint&>(joint);
  return {known.getFrameOffsetA().getOrigin(), known.getFrameOffsetB().getOrigin()};
}

template <class Joint>
Pivots of_places(const btTypedConstraint& joint) {
  const auto& known = static_cast<const Joint&>(joint);
  return {known.getAFrame().getOrigin(), known.getBFrame().getOrigin()};
}

/// Of the kinds that scenes have. Fixed joints and springs are six degrees of freedom with nothing left, or all.
Pivots pivots_of(const btTypedConstraint& joint) {
  switch (joint.getConstraintType()) {
    case POINT2POINT_CONSTRAINT_TYPE: {
      const auto& ball = static_cast<const btPoint2PointConstraint&>(joint);
      return {ball.getPivotInA(), ball.getPivotInB()};
    }
    case HINGE_CONSTRAINT_TYPE:
      return of_places<btHingeConstraint>(joint);
    case CONETWIST_CONSTRAINT_TYPE:
      return of_places<btConeTwistConstraint>(joint);
    case SLIDER_CONSTRAINT_TYPE:
      return of_frames<btSliderConstraint>(joint);
    default:
      return of_frames<btGeneric6DofSpring2Constraint>(joint);
  }
}

Point pivot_at(const btVector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// From the number of an object, or -1, to its place among those that are kept; false if it is not.
bool renumber(std::int32_t& object, const Kept& kept) {
  if (object < 0) return true;
  const std::uint32_t place = kept.place_of(static_cast<std::uint32_t>(object));
  object = static_cast<std::int32_t>(place);
  return place != Kept::none;
}

}  // namespace

std::vector<std::string> names_of(const scenes::Simulation& simulation, const Kept& kept) {
  const scenes::Expanded& expanded = simulation.expanded();
  std::vector<std::string> names;
  for (const std::uint32_t object : kept.objects) {
    if (object >= expanded.bodies.size()) {
      names.push_back(name_of(simulation.scene(), object - expanded.bodies.size()));
      continue;
    }
    const scenes::Body& body = expanded.bodies[object];
    names.push_back(body.name.empty() ? expanded.shapes[body.traits.shape].name : body.name);
  }
  return names;
}

std::vector<Link> links_of(const scenes::Simulation& simulation, const Kept& kept) {
  const btDynamicsWorld& world = simulation.world();
  std::vector<Link> links;
  for (int i = 0; i < world.getNumConstraints(); ++i) {
    const btTypedConstraint& joint = *world.getConstraint(i);
    const Pivots pivots = pivots_of(joint);
    Link link{joint.getRigidBodyA().getUserIndex(), joint.getRigidBodyB().getUserIndex(), pivot_at(pivots.in_a),
              pivot_at(pivots.in_b)};
    // Bullet's own body for the world, which is no body of the scene, may come first.
    if (link.a < 0) link = {link.b, link.a, link.pivot_in_b, link.pivot_in_a};
    if (renumber(link.a, kept) && renumber(link.b, kept)) links.push_back(link);
  }
  return links;
}

}  // namespace boxstream::view
