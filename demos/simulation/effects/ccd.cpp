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

double half_thickness(const std::vector<Shape>& shapes, std::size_t shape) {
  const auto of = [&]<class S>(const S& s) {
    double thinnest = std::numeric_limits<double>::max();
    if constexpr (S::use == ShapeUse::part) {
      thinnest = s.half_thickness();
    } else if constexpr (S::use == ShapeUse::any_body) {
      for (const CompoundChild& child : s.children) thinnest = std::min(thinnest, half_thickness(shapes, child.shape));
    }  // No dynamic body has one of the others.
    return thinnest;
  };
  return std::visit(of, shapes[shape].value);
}

/// What a body is swept with, and why; none if it need not be.
std::optional<Ccd> ccd_of(const Subject& subject, const Body& body, std::string* reason = nullptr) {
  const BodyTraits& traits = body.traits;
  if (!is_dynamic(body) || !traits.may_ccd) return std::nullopt;
  if (traits.ccd) {
    if (reason != nullptr) *reason = "given";
    return traits.ccd;
  }
  const double speed = std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]);
  const double way = speed * subject.scene.time.dt / subject.scene.time.substeps;
  if (way == 0) return std::nullopt;
  const double half = half_thickness(subject.expanded.shapes, traits.shape);
  if (way <= half) return std::nullopt;
  if (reason != nullptr) *reason = fmt::format("moves {:.3g} m in a step, half its thickness is {:.3g} m", way, half);
  return Ccd{half, half / 2};
}

std::optional<Call> calls_for_ccd(const Subject& subject) {
  return first_body(subject, [&](const Body& body) {
    std::string reason;
    ccd_of(subject, body, &reason);
    return reason;
  });
}

void prepare_ccd(const Subject&, WorldRecipe& recipe) {
  recipe.continuous = true;
}

void dress_ccd(const Subject& subject, const Body& description, btRigidBody& body) {
  const std::optional<Ccd> ccd = ccd_of(subject, description);
  if (!ccd) return;
  body.setCcdMotionThreshold(real(ccd->threshold));
  body.setCcdSweptSphereRadius(real(ccd->radius));
}

}  // namespace

const Effect ccd{"ccd",
                 "fast bodies do not jump over what is in their way",
                 "boxes that cover the motion of a step; sweeps of fast bodies",
                 calls_for_ccd,
                 {.prepare = prepare_ccd, .dress = dress_ccd}};

}  // namespace boxstream::effects
