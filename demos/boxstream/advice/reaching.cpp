// SPDX-License-Identifier: MIT
#include "boxstream/advice/reaching.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "formats/geometry/frame.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/bullet_shapes.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::tool {
namespace {

using scenes::Body;
using scenes::Vec3;

bool is_turned(const Body& body) {
  return std::abs(body.rotation[3]) < 0.9999;
}

/// Whether there is more than falling that moves bodies from where they are: machines, fields, slopes.
bool is_pushed_about(const effects::Subject& subject) {
  const scenes::Scene& scene = subject.scene;
  const auto& shapes = subject.expanded.shapes;
  const auto pushes = [&](const Body& body) {
    const scenes::ShapeValue& shape = shapes[body.traits.shape].value;
    const bool is_surface =
        std::holds_alternative<scenes::MeshShape>(shape) || std::holds_alternative<scenes::HeightfieldShape>(shape);
    return !effects::is_dynamic(body) && (body.traits.type != scenes::BodyType::fixed || is_surface ||
                                          is_turned(body) || body.surface_velocity != Vec3{});
  };
  const Vec3& g = scene.world.gravity;
  const double size = std::sqrt(geometry::dot(g, g));
  const bool is_level = std::any_of(g.begin(), g.end(), [&](double along) { return std::abs(along) > 0.9999 * size; });
  return !is_level || scene.world.tumbling || !scene.fields.empty() || !scene.vehicles.empty() ||
         !scene.characters.empty() || !scene.soft_bodies.empty() || !subject.expanded.joints.empty() ||
         std::any_of(subject.expanded.bodies.begin(), subject.expanded.bodies.end(), pushes);
}

}  // namespace

Reaching::Reaching(const effects::Subject& subject)
    : subject_(subject),
      boxes_(subject.expanded.bodies.size()),
      seconds_(subject.scene.time.dt * subject.scene.time.steps),
      everywhere_(is_pushed_about(subject)) {
  scenes::ShapeSet shapes(subject.expanded.shapes);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Body& body = subject.expanded.bodies[i];
    shapes.get(body.traits.shape)
        .shape->getAabb(scenes::transform(body.position, body.rotation), boxes_[i].low, boxes_[i].high);
  }
  const Vec3& g = subject.scene.world.gravity;
  if (const double strength = std::sqrt(geometry::dot(g, g)); strength > 0)
    for (int d = 0; d < 3; ++d) up_[d] = static_cast<btScalar>(-g[static_cast<std::size_t>(d)] / strength);
}

double Reaching::size(std::size_t body) const {
  const btVector3 extent = boxes_[body].high - boxes_[body].low;
  return double{extent.x() + extent.y() + extent.z()} / 3;
}

bool Reaching::touch(std::size_t a, std::size_t b) const {
  const auto gap = static_cast<btScalar>(0.05 * std::min(size(a), size(b)));
  for (int d = 0; d < 3; ++d)
    if (boxes_[a].low[d] > boxes_[b].high[d] + gap || boxes_[b].low[d] > boxes_[a].high[d] + gap) return false;
  return true;
}

/// How far a body can come aside: by its speed, and by rolling or toppling off what it falls on.
double Reaching::way(std::size_t body, double fall) const {
  const Vec3& v = subject_.expanded.bodies[body].velocity;
  return std::sqrt(geometry::dot(v, v)) * seconds_ + std::max(0.0, fall);
}

bool Reaching::can_stack(std::size_t upper, std::size_t lower) const {
  const Box &above = boxes_[upper], &below = boxes_[lower];
  const btVector3 apart = (above.low + above.high - below.low - below.high) / 2;
  const double rise = double{up_.dot(apart)};
  if (rise <= 0) return false;
  if (everywhere_) return true;
  double aside = 0;
  for (int d = 0; d < 3; ++d) {
    if (std::abs(up_[d]) > btScalar(0.5)) continue;
    const double gap = double{std::max(above.low[d] - below.high[d], below.low[d] - above.high[d])};
    aside = std::max(aside, gap);
  }
  return aside <= way(upper, rise) + way(lower, 0);
}

}  // namespace boxstream::tool
