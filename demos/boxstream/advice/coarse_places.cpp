// SPDX-License-Identifier: MIT
#include "boxstream/advice/coarse_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/words.hpp"
#include "formats/geometry/frame.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/tunnelling.hpp"

namespace boxstream::tool {
namespace {

using scenes::Body;
using scenes::Precision;

// What is right within a hundredth. Cubes lie off their height by one to two of these spacings, so that four of a
// thickness are that of half of it; each step of a steady motion is off by half of one (docs/internals/closed-forms.md,
// far_rest and far_glide).
constexpr double of_thickness = 0.0025, of_way = 0.02;

/// How far a number is from the next.
double spacing(double number, Precision precision) {
  if (precision == Precision::doubled) return std::nextafter(number, std::numeric_limits<double>::infinity()) - number;
  const auto rounded = static_cast<float>(number);
  return double{std::nextafter(rounded, std::numeric_limits<float>::infinity())} - double{rounded};
}

/// The largest coordinate that a body has at the start or, where nothing pulls at it, at the end.
double farthest(const scenes::Scene& scene, const Body& body) {
  const bool flies = !scene.world.tumbling && scene.world.gravity == scenes::Vec3{};
  const double seconds = flies ? scene.time.dt * scene.time.steps : 0;
  double far = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double end = body.position[d] + body.velocity[d] * seconds;
    far = std::max({far, std::abs(body.position[d]),
                    std::abs(std::clamp(end, scene.world.bounds.min[d], scene.world.bounds.max[d]))});
  }
  return far;
}

}  // namespace

std::optional<CoarseStep> coarse_places(const effects::Subject& subject) {
  const scenes::Scene& scene = subject.scene;
  const Precision precision = scene.solver.precision;
  const double step = scene.time.dt / scene.time.substeps;
  const std::vector<double> half = effects::half_thicknesses(subject.expanded.shapes);
  // Where gravity pulls, no way is that of a first step for long.
  const bool flies = !scene.world.tumbling && scene.world.gravity == scenes::Vec3{};
  std::optional<CoarseStep> found;
  double worst = 1;
  for (std::size_t i = 0; i < subject.expanded.bodies.size(); ++i) {
    const Body& body = subject.expanded.bodies[i];
    const double thickness = 2 * half[body.traits.shape];
    const double way = std::sqrt(geometry::dot(body.velocity, body.velocity)) * step;
    if (!effects::is_dynamic(body) || !(thickness > 0) || std::isinf(thickness)) continue;
    const double far = farthest(scene, body), apart = spacing(far, precision);
    const double by_thickness = apart / (of_thickness * thickness),
                 by_way = way > 0 && flies ? apart / (of_way * way) : 0;
    if (std::max(by_thickness, by_way) <= worst) continue;
    worst = std::max(by_thickness, by_way);
    const std::string name = body.name.empty() ? "" : fmt::format(" (\"{}\")", files::printable(body.name));
    found = CoarseStep{
        fmt::format(
            "body {}{} comes as far as {:.3g} m from the origin, where numbers of {} precision tell places apart by "
            "{:.2g} m, and {}",
            i, name, far, precision == Precision::single ? "single" : "double", apart,
            by_thickness >= by_way ? fmt::format("is {:.2g} m thick: it rests and swings wrongly", thickness)
                                   : fmt::format("moves by {:.2g} m in a step: its way is rounded", way)),
        precision == Precision::single ? "\"solver\": {\"precision\": \"double\"} gets it right"
                                       : "closer to the origin it is right",
        by_thickness >= by_way ? "far_rest_0.1_9000" : "far_glide_90000"};
  }
  return found;
}

}  // namespace boxstream::tool
