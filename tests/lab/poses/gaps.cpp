// SPDX-License-Identifier: MIT
#include "gaps.hpp"

#include "faces.hpp"
#include "narrow_phase/pose.hpp"
#include "truth.hpp"

namespace boxstream::poses {
namespace {

using Vec = Eigen::Vector3d;

class Random : public report::narrow::RandomNumbers {
 public:
  using RandomNumbers::RandomNumbers;

  Vec sizes() { return {range(0.3, 2), range(0.3, 2), range(0.3, 2)}; }

  Solid box() {
    Solid solid;
    const Vec s = sizes();
    solid.size = {s.x(), s.y(), s.z(), 0};
    for (int i = 0; i < 8; ++i)
      solid.points.push_back(s.cwiseProduct(Vec(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5)));
    solid.faces = faces_of(solid.points);
    return solid;
  }
  /// Points on an ellipsoid are all corners.
  Solid hull() {
    Solid solid;
    solid.kind = Kind::hull;
    const Vec s = sizes();
    for (int i = 4 + static_cast<int>(range(0, 9)); i > 0; --i) solid.points.push_back(direction().cwiseProduct(s));
    solid.faces = faces_of(solid.points);
    return solid;
  }
};

void stack(Solid& a, Solid& b, double gap, Random& random) {
  a.rotation = b.rotation = random.rotation();
  a.translation = random.range(0, 2) * random.direction();
  const Vec beside(random.range(-0.1, 0.1), (a.size[1] + b.size[1]) / 2 + gap, random.range(-0.1, 0.1));
  b.translation = a.translation + a.rotation * beside;
}

/// Moves B straight towards A until the gap is left. A few times, since on the way other features become the closest.
void bring_together(Solid& a, Solid& b, double gap, Random& random) {
  a.rotation = random.rotation();
  b.rotation = random.rotation();
  a.translation = random.range(0, 2) * random.direction();
  b.translation = a.translation + 5 * random.direction();
  for (int i = 0; i < 8; ++i)
    b.translation += way_apart(a, b) * (gap - static_cast<double>(signed_distance_of_convex(a, b)));
}

}  // namespace

HardPose gap_pose(Family family, double gap, unsigned seed) {
  Random random(seed);
  HardPose pose;
  pose.query = Query::signed_distance;
  pose.a = family == Family::hulls ? random.hull() : random.box();
  pose.b = family == Family::hulls ? random.hull() : random.box();
  if (family == Family::stacked_boxes)
    stack(pose.a, pose.b, gap, random);
  else
    bring_together(pose.a, pose.b, gap, random);
  pose.truth = static_cast<double>(signed_distance_of_convex(pose.a, pose.b));
  return pose;
}

HardPose gap_pose(int index) {
  const int rest = index / static_cast<int>(gaps.size());
  return gap_pose(static_cast<Family>(rest % families), gap_of(index), static_cast<unsigned>(rest / families));
}

double gap_of(int index) {
  return gaps[static_cast<std::size_t>(index) % gaps.size()];
}

}  // namespace boxstream::poses
