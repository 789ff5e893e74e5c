// SPDX-License-Identifier: MIT
#include "narrow_phase/pose.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace boxstream::report::narrow {
namespace {

using Vec = Eigen::Vector3d;

class Random : public RandomNumbers {
 public:
  using RandomNumbers::RandomNumbers;

  RoundedBox solid(const std::string& kind, double scale) {
    RoundedBox solid;
    if (kind == "box" || kind == "slab")
      solid.half = scale * Vec(range(0.3, 1), range(0.3, 1), range(0.3, 1));
    else if (kind == "capsule")
      solid.half.z() = scale * range(0.3, 1);
    else if (kind == "pill")
      solid.half.z() = scale * 0.5;
    else if (kind != "sphere" && kind != "ball")
      throw std::invalid_argument("no shape \"" + kind + "\"; there are sphere, capsule, box, ball, pill, slab");
    if (kind == "sphere" || kind == "capsule") solid.margin = scale * range(0.3, 1);
    if (kind == "ball" || kind == "pill") solid.margin = scale * 0.5;
    solid.rotation = rotation();
    solid.centre = scale * range(0, 2) * direction();
    return solid;
  }
};

/// Moves B along `direction` from where the shapes overlap most until the gap is left: signed distance is convex along
/// a line, so it is met once.
void place(Pose& pose, const Vec& start, const Vec& direction, double gap) {
  double low = 0, high = 4 * (radius(pose.a) + radius(pose.b));
  for (int i = 0; i < 64; ++i) {
    const double middle = (low + high) / 2;
    pose.b.centre = start + middle * direction;
    (static_cast<double>(signed_distance(pose.a, pose.b)) < gap ? low : high) = middle;
  }
  pose.truth = static_cast<double>(signed_distance(pose.a, pose.b));
}

}  // namespace

std::vector<Pose> make_poses(const PoseRequest& request) {
  const std::size_t dash = request.pair.find('-');
  if (dash == std::string::npos) throw std::invalid_argument("\"" + request.pair + "\" is no pair of shapes");
  const std::string first = request.pair.substr(0, dash), second = request.pair.substr(dash + 1);
  if ((first == "slab") != (second == "slab")) throw std::invalid_argument("a slab pairs with a slab");
  if (request.count < 1) throw std::invalid_argument("at least one pose is needed");
  Random random(1);
  std::vector<Pose> poses(static_cast<std::size_t>(request.count));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Pose& pose = poses[i];
    pose.a = random.solid(first, request.scale);
    pose.b = random.solid(second, request.scale);
    pose.size = std::min(radius(pose.a), radius(pose.b));
    const double share = (static_cast<double>(i) + 0.5) / request.count;
    double gap = request.first_gap;
    if (request.first_gap != request.last_gap) gap *= std::pow(request.last_gap / request.first_gap, share);
    if (request.both_signs && i % 2 == 1) gap = -gap;
    Vec start = pose.a.centre, direction = random.direction();
    if (first == "slab") {
      pose.b.rotation = pose.a.rotation;
      const Vec beside = 0.2 * request.scale * Vec(random.range(-1, 1), 0, random.range(-1, 1));
      start += pose.a.rotation * beside;
      direction = pose.a.rotation.col(1);
    }
    place(pose, start, direction, gap * pose.size);
  }
  return poses;
}

}  // namespace boxstream::report::narrow
