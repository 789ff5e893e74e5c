// SPDX-License-Identifier: MIT
#include "boxstream/advice/coarse_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/words.hpp"
#include "formats/geometry/frame.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/bullet_shapes.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::tool {
namespace {

using effects::is_dynamic;
using scenes::Body;
using scenes::Vec3;

struct Box {
  Vec3 low, high;
};

/// Where two boxes begin to touch as one of them moves.
struct Entry {
  double part;  // of the motion
  std::size_t axis;
};

/// By axes, as straight motion is; nothing if they do not come to touch.
std::optional<Entry> entry(const Box& moving, const Vec3& motion, const Box& other) {
  Entry first{0, 3};
  double last = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const double ahead = motion[d] >= 0 ? other.low[d] - moving.high[d] : moving.low[d] - other.high[d];
    const double behind = motion[d] >= 0 ? other.high[d] - moving.low[d] : moving.high[d] - other.low[d];
    if (behind < 0 || (ahead > 0 && motion[d] == 0)) return std::nullopt;
    if (motion[d] == 0) continue;
    const double speed = std::abs(motion[d]);
    if (ahead / speed > first.part) first = {ahead / speed, d};
    last = std::min(last, behind / speed);
  }
  return first.part <= last ? std::optional(first) : std::nullopt;
}

std::vector<bool> joined(const effects::Subject& subject) {
  std::vector<bool> found(subject.expanded.bodies.size());
  for (const scenes::Joint& joint : subject.expanded.joints) {
    found[joint.a] = true;
    if (joint.b) found[*joint.b] = true;
  }
  return found;
}

std::vector<Box> boxes_of(const effects::Subject& subject) {
  scenes::ShapeSet shapes(subject.expanded.shapes);
  std::vector<Box> boxes;
  for (const Body& body : subject.expanded.bodies) {
    btVector3 low, high;
    shapes.get(body.traits.shape).shape->getAabb(scenes::transform(body.position, body.rotation), low, high);
    boxes.push_back({{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}});
  }
  return boxes;
}

struct Landing {
  std::size_t body, other;
  double depth, share;  // metres, and of the thinner of the two
  double motion;        // in that step
  double half;          // thickness of the body
  bool swept;
};

class Flights {
 public:
  explicit Flights(const effects::Subject& subject)
      : subject_(subject),
        boxes_(boxes_of(subject)),
        half_(effects::half_thicknesses(subject.expanded.shapes)),
        safe_(effects::safe_motions(subject)),
        step_(subject.scene.time.dt / subject.scene.time.substeps),
        steps_(static_cast<std::uint64_t>(subject.scene.time.steps) *
               static_cast<std::uint64_t>(subject.scene.time.substeps)) {}

  /// None of a body that hits nothing, or what is no fixed box, or that begins within reach of a contact.
  std::optional<Landing> landing(std::size_t i, std::uint64_t most_steps) const {
    const Body& body = subject_.expanded.bodies[i];
    Box box = boxes_[i];
    Vec3 velocity = body.velocity;
    const double kept = std::pow(1 - body.traits.linear_damping, step_);  // of it in a step
    for (std::uint64_t k = 0; k < std::min(steps_, most_steps); ++k) {
      velocity = geometry::plus(scenes::times(velocity, kept), scenes::times(subject_.scene.world.gravity, step_));
      const Vec3 motion = scenes::times(velocity, step_);
      std::optional<Entry> first;
      std::size_t hit = 0;
      for (std::size_t j = 0; j < boxes_.size(); ++j) {
        if (j == i || !subject_.collidable.can_touch(i, j)) continue;
        const std::optional<Entry> met = entry(box, motion, boxes_[j]);
        if (!met || (first && first->part <= met->part)) continue;
        first = met;
        hit = j;
      }
      if (first) return is_fixed_box(hit) ? depth(i, hit, motion, *first) : std::nullopt;
      box = {geometry::plus(box.low, motion), geometry::plus(box.high, motion)};
    }
    return std::nullopt;
  }

 private:
  const Body& body(std::size_t i) const { return subject_.expanded.bodies[i]; }
  double thickness(std::size_t i) const { return 2 * half_[body(i).traits.shape]; }

  bool is_fixed_box(std::size_t i) const {
    const scenes::ShapeValue& shape = subject_.expanded.shapes[body(i).traits.shape].value;
    return body(i).traits.type == scenes::BodyType::fixed && std::abs(body(i).rotation[3]) > 0.9999 &&
           std::holds_alternative<scenes::BoxShape>(shape);
  }

  std::optional<Landing> depth(std::size_t i, std::size_t other, const Vec3& motion, const Entry& met) const {
    // What is that near has a contact before it comes nearer, which stops it at the surface.
    constexpr double near = 0.02;
    const double way = std::sqrt(geometry::dot(motion, motion)), size = std::min(1.0, thickness(i));
    if (met.axis == 3 || met.part * way <= near * size) return std::nullopt;
    const scenes::BodyTraits& traits = body(i).traits;
    const double half = thickness(i) / 2;
    const bool swept = way > safe_[i] || (traits.ccd && way > traits.ccd->threshold);
    const double deep =
        swept ? half - (traits.ccd ? traits.ccd->radius : half / 2) : (1 - met.part) * std::abs(motion[met.axis]);
    return Landing{i, other, deep, deep / std::min(thickness(i), thickness(other)), way, half, swept};
  }

  const effects::Subject& subject_;
  std::vector<Box> boxes_;
  std::vector<double> half_, safe_;
  double step_;
  std::uint64_t steps_;
};

}  // namespace

std::optional<CoarseStep> deep_landing(const effects::Subject& subject) {
  constexpr double most_share = 0.5;
  constexpr std::uint64_t most_looks = 10'000'000;  // a tenth of a second
  const std::vector<Body>& bodies = subject.expanded.bodies;
  if (!subject.scene.fields.empty() || subject.scene.world.tumbling || bodies.empty()) return std::nullopt;
  const std::uint64_t most_steps = most_looks / (bodies.size() * bodies.size());
  const std::vector<bool> held = joined(subject);
  const Flights flights(subject);
  std::optional<Landing> worst;
  for (std::size_t i = 0; i < bodies.size() && most_steps > 0; ++i) {
    if (!is_dynamic(bodies[i]) || held[i] || subject.trees.has_body(i)) continue;
    const std::optional<Landing> found = flights.landing(i, most_steps);
    if (found && found->share > (worst ? worst->share : most_share)) worst = found;
  }
  if (!worst) return std::nullopt;
  const auto name = [&](std::size_t i) {
    return bodies[i].name.empty() ? fmt::format("body {}", i)
                                  : fmt::format("body {} (\"{}\")", i, files::printable(bodies[i].name));
  };
  const double thin = worst->depth / worst->share;
  return CoarseStep{
      fmt::format("{} moves by {:.2g} m in the step in which it meets {}: it comes {:.2g} m deep, {:.0f} % of the "
                  "thinner of the two",
                  name(worst->body), worst->motion, name(worst->other), worst->depth, 100 * worst->share),
      worst->swept
          ? fmt::format("\"ccd\": {{\"threshold\": {0:.2g}, \"radius\": {0:.2g}}} of that body, which sweeps a larger "
                        "ball, lets it come in by a quarter",
                        worst->half - thin / 4)
          : fmt::format("{:.0f} substeps let it come in by less than half",
                        std::ceil(subject.scene.time.substeps * worst->motion / (most_share * thin))),
      "collision_3_0"};
}

}  // namespace boxstream::tool
