// SPDX-License-Identifier: MIT
#include "simulation/effects/tunnelling.hpp"

#include <algorithm>
#include <limits>

#include "simulation/effects/find.hpp"
#include "simulation/engine/hull_width.hpp"

namespace boxstream::effects {

using namespace scenes;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

bool is_moving(const Body& body) {
  return body.traits.type != BodyType::fixed;
}

bool starts_fast(const Body& body) {
  return is_moving(body) && (body.velocity != Vec3{} || body.spin != Vec3{});
}

}  // namespace

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

std::vector<double> safe_motions(const Subject& subject) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  std::vector<double> thickness;  // of shapes
  for (std::size_t i = 0; i < subject.expanded.shapes.size(); ++i)
    thickness.push_back(half_thickness(subject.expanded.shapes, i));
  // Other things that move are as thin as can be; they are never excluded.
  const bool others_move = !subject.scene.soft_bodies.empty() || !subject.scene.characters.empty();
  const auto any = [](const Body&) { return true; };
  const std::vector<std::uint32_t> all = subject.meetings.count(any), moving = subject.meetings.count(is_moving);
  double thinnest_fixed = infinite;
  for (const Body& body : bodies)
    if (!is_moving(body)) thinnest_fixed = std::min(thinnest_fixed, thickness[body.traits.shape]);

  std::vector<double> safe(bodies.size(), infinite);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!is_dynamic(bodies[i]) || !bodies[i].traits.may_ccd || !subject.scene.world.ccd) continue;
    const double own = thickness[bodies[i].traits.shape];
    if (others_move || subject.meetings.partners(i, moving, is_moving) > 0)
      safe[i] = own;
    else if (subject.meetings.partners(i, all, any) > 0)
      safe[i] = own + thinnest_fixed;
  }
  return safe;
}

bool can_move(const Subject& subject) {
  const Scene& scene = subject.scene;
  return scene.world.gravity != Vec3{} || scene.world.tumbling || !scene.fields.empty() || !scene.characters.empty() ||
         !scene.soft_bodies.empty() || !subject.expanded.joints.empty() ||
         std::any_of(subject.expanded.bodies.begin(), subject.expanded.bodies.end(), starts_fast);
}

}  // namespace boxstream::effects
