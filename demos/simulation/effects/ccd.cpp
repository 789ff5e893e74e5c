// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// Half the thinnest extent of a shape: what a body may move in a step without jumping over something.
struct HalfThickness {
  const std::vector<Shape>& shapes;

  double operator()(const BoxShape& s) const {
    return std::min({s.half_extents[0], s.half_extents[1], s.half_extents[2]});
  }
  double operator()(const SphereShape& s) const { return s.radius; }
  double operator()(const CapsuleShape& s) const { return s.radius; }
  double operator()(const CylinderShape& s) const { return std::min(s.radius, s.height / 2); }
  double operator()(const ConeShape& s) const { return std::min(s.radius, s.height) / 2; }
  double operator()(const HullShape& s) const {
    double thinnest = std::numeric_limits<double>::max();
    for (std::size_t d = 0; d < 3; ++d) {
      const auto less = [d](const Vec3& a, const Vec3& b) { return a[d] < b[d]; };
      const auto [low, high] = std::minmax_element(s.points.begin(), s.points.end(), less);
      thinnest = std::min(thinnest, ((*high)[d] - (*low)[d]) / 2);
    }
    return thinnest;
  }
  double operator()(const CompoundShape& s) const {
    double thinnest = std::numeric_limits<double>::max();
    for (const CompoundChild& child : s.children)
      thinnest = std::min(thinnest, std::visit(*this, shapes[child.shape].value));
    return thinnest;
  }
  // No dynamic body has one of these.
  double operator()(const PlaneShape&) const { return std::numeric_limits<double>::max(); }
  double operator()(const HeightfieldShape&) const { return std::numeric_limits<double>::max(); }
  double operator()(const MeshShape&) const { return std::numeric_limits<double>::max(); }
};

/// What a body is swept with, and why; none if it need not be.
std::optional<Ccd> ccd_of(const Subject& subject, const Body& body, std::string* reason = nullptr) {
  const BodyTraits& traits = body.traits;
  if (!is_dynamic(body) || !traits.may_ccd) return std::nullopt;
  if (traits.ccd) {
    if (reason != nullptr) *reason = "asked for";
    return traits.ccd;
  }
  const double speed = std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]);
  const double way = speed * subject.scene.time.dt / subject.scene.time.substeps;
  if (way == 0) return std::nullopt;
  const double half = std::visit(HalfThickness{subject.expanded.shapes}, subject.expanded.shapes[traits.shape].value);
  if (way <= half) return std::nullopt;
  if (reason != nullptr) *reason = fmt::format("moves {:.3g} m in a step, half its thickness is {:.3g} m", way, half);
  return Ccd{half, half / 2};
}

std::optional<Call> called_for(const Subject& subject) {
  return first_body(subject, [&](const Body& body) {
    std::string reason;
    ccd_of(subject, body, &reason);
    return reason;
  });
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.continuous = true;
}

void dress(const Subject& subject, const Body& description, btRigidBody& body) {
  const std::optional<Ccd> ccd = ccd_of(subject, description);
  if (!ccd) return;
  body.setCcdMotionThreshold(real(ccd->threshold));
  body.setCcdSweptSphereRadius(real(ccd->radius));
}

}  // namespace

const Effect ccd{"ccd",
                 "fast bodies do not jump over what is in their way",
                 "boxes that cover the motion of a step; sweeps of fast bodies",
                 called_for,
                 {.prepare = prepare, .dress = dress}};

}  // namespace boxstream::effects
