// SPDX-License-Identifier: MIT
#include "simulation/effects/tunnelling.hpp"

#include <algorithm>
#include <limits>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include "simulation/effects/find.hpp"
#include "simulation/engine/hull_width.hpp"

namespace boxstream::effects {

using namespace scenes;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

bool is_moving(const Body& body) {
  return body.traits.type != BodyType::fixed;
}

bool is_any(const Body&) {
  return true;
}

/// Other things that move are as thin as can be; they are never excluded.
bool others_move(const Subject& subject) {
  return !subject.scene.soft_bodies.empty() || !subject.scene.characters.empty();
}

/// Whether the filter of the sensors' group lets a dynamic body in.
bool is_noticed(const Subject& subject, std::size_t body) {
  using Proxy = btBroadphaseProxy;
  const BodyTraits& traits = subject.expanded.bodies[body].traits;
  return !subject.scene.sensors.empty() && (traits.mask.value_or(0x7fffffff) & Proxy::SensorTrigger) != 0 &&
         (traits.group.value_or(Proxy::DefaultFilter) & ~(Proxy::SensorTrigger | Proxy::StaticFilter)) != 0;
}

double half_thickness(const std::vector<Shape>& shapes, std::size_t shape) {
  const auto of = [&]<class S>(const S& s) {
    if constexpr (std::is_same_v<S, HullShape>) {
      return hull_width(s.points) / 2;
    } else if constexpr (S::use == ShapeUse::part) {
      return s.half_thickness();
    } else if constexpr (S::use == ShapeUse::any_body) {
      double thinnest = infinite;
      for (const CompoundChild& child : s.children) thinnest = std::min(thinnest, half_thickness(shapes, child.shape));
      return thinnest;
    } else {
      return std::is_same_v<S, PlaneShape> ? infinite : 0.0;
    }
  };
  return std::visit(of, shapes[shape].value);
}

}  // namespace

std::vector<double> half_thicknesses(const std::vector<Shape>& shapes) {
  std::vector<double> all;
  for (std::size_t i = 0; i < shapes.size(); ++i) all.push_back(half_thickness(shapes, i));
  return all;
}

double safe_share(const Shape& shape) {
  if (std::holds_alternative<SphereShape>(shape.value)) return 1;
  // Without a margin there is less depth at which contacts still point the right way.
  const bool has_margin =
      !std::holds_alternative<ConeShape>(shape.value) && !std::holds_alternative<HullShape>(shape.value);
  return has_margin ? 0.5 : 0.375;
}

std::vector<double> safe_motions(const Subject& subject) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  const std::vector<double> thickness = half_thicknesses(subject.expanded.shapes);
  const std::vector<std::uint32_t> all = subject.collidable.count(is_any), moving = subject.collidable.count(is_moving);
  double thinnest_fixed = infinite;
  for (const Body& body : bodies)
    if (!is_moving(body)) thinnest_fixed = std::min(thinnest_fixed, thickness[body.traits.shape]);
  double thinnest_sensor = infinite;
  for (const Sensor& sensor : subject.scene.sensors)
    thinnest_sensor = std::min(thinnest_sensor, BoxShape{sensor.half_extents}.half_thickness());

  std::vector<double> safe(bodies.size(), infinite);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!is_dynamic(bodies[i]) || !bodies[i].traits.may_ccd || !subject.scene.world.ccd || subject.trees.has_body(i))
      continue;
    const std::size_t shape = bodies[i].traits.shape;
    const double own = thickness[shape], share = safe_share(subject.expanded.shapes[shape]);
    if (others_move(subject) || subject.collidable.partners(i, moving, is_moving) > 0)
      safe[i] = share * own;
    else if (subject.collidable.partners(i, all, is_any) > 0)
      safe[i] = share * (own + thinnest_fixed);
    if (is_noticed(subject, i)) safe[i] = std::min(safe[i], own + thinnest_sensor);
  }
  return safe;
}

bool can_hit(const Subject& subject, std::size_t body) {
  return others_move(subject) || is_noticed(subject, body) ||
         subject.collidable.partners(body, subject.collidable.count(is_any), is_any) > 0;
}

}  // namespace boxstream::effects
