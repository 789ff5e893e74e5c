// SPDX-License-Identifier: MIT
#include <numbers>

#include "formats/scene_model/expand_parts.hpp"

namespace boxstream::scenes {
namespace {

constexpr double pi = std::numbers::pi;

/// Proportions of a figure 1.8 m tall that stands at the origin with its arms stretched out along x.
struct Limb {
  double x, y;
  double radius, length;  // length between the centres of the end spheres
  bool lies_along_x;
  double share;  // of the whole mass
};

constexpr Limb limbs[] = {
    {0, 0.95, 0.13, 0.14, false, 0.15},       // 0 pelvis
    {0, 1.30, 0.15, 0.24, false, 0.33},       // 1 chest
    {0, 1.68, 0.10, 0.06, false, 0.08},       // 2 head
    {-0.11, 0.66, 0.075, 0.30, false, 0.10},  // 3 right thigh
    {-0.11, 0.24, 0.055, 0.32, false, 0.06},  // 4 right shank
    {0.11, 0.66, 0.075, 0.30, false, 0.10},   // 5 left thigh
    {0.11, 0.24, 0.055, 0.32, false, 0.06},   // 6 left shank
    {-0.32, 1.45, 0.05, 0.22, true, 0.035},   // 7 right upper arm
    {-0.61, 1.45, 0.04, 0.22, true, 0.025},   // 8 right forearm
    {0.32, 1.45, 0.05, 0.22, true, 0.035},    // 9 left upper arm
    {0.61, 1.45, 0.04, 0.22, true, 0.025},    // 10 left forearm
};

/// Hinges bend between two angles about `axis`; the others swing within a cone around it.
struct Link {
  std::size_t a, b;
  bool hinge;
  Vec3 pivot, axis;
  double first, second, twist;  // hinge: limits; cone-twist: the two swings
};

constexpr Link links[] = {
    {0, 1, true, {0, 1.12, 0}, {1, 0, 0}, -pi / 4, pi / 2, 0},
    {1, 2, false, {0, 1.56, 0}, {0, 1, 0}, pi / 4, pi / 4, pi / 3},
    {0, 3, false, {-0.11, 0.86, 0}, {0, -1, 0}, pi / 3, pi / 4, pi / 12},
    {0, 5, false, {0.11, 0.86, 0}, {0, -1, 0}, pi / 3, pi / 4, pi / 12},
    {3, 4, true, {-0.11, 0.45, 0}, {1, 0, 0}, -0.8 * pi, 0, 0},
    {5, 6, true, {0.11, 0.45, 0}, {1, 0, 0}, -0.8 * pi, 0, 0},
    {1, 7, false, {-0.17, 1.45, 0}, {-1, 0, 0}, pi / 2, pi / 2, pi / 6},
    {1, 9, false, {0.17, 1.45, 0}, {1, 0, 0}, pi / 2, pi / 2, pi / 6},
    {7, 8, true, {-0.47, 1.45, 0}, {0, 1, 0}, -0.7 * pi, 0, 0},
    {9, 10, true, {0.47, 1.45, 0}, {0, 1, 0}, 0, 0.7 * pi, 0},
};

constexpr double figure_height = 1.8;

}  // namespace

void RagdollGenerator::generate(Random& random, Expanded& out) const {
  const double s = height / figure_height;
  std::vector<std::size_t> shapes;
  for (const Limb& limb : limbs) shapes.push_back(add_shape(out, CapsuleShape{limb.radius * s, limb.length * s}));

  for (int i = 0; i < count; ++i) {
    // Figures turn as a whole about their middle, so that they land in all positions.
    const Vec3 middle = lattice_place(i, columns, spacing, origin);
    const Quat heading = random.rotation();
    const Vec3 turning = random.in_ball(spin);
    const auto place = [&](double x, double y, double z) {
      const Vec3 offset = turned(heading, {x * s, (y - figure_height / 2) * s, z * s});
      return Vec3{middle[0] + offset[0], middle[1] + offset[1], middle[2] + offset[2]};
    };
    const std::size_t first = out.bodies.size();
    for (std::size_t k = 0; k < std::size(limbs); ++k) {
      const Limb& limb = limbs[k];
      Body body;
      body.traits.shape = shapes[k];
      body.traits.material = material;
      body.traits.mass = mass * limb.share;
      body.traits.linear_damping = 0.05;
      body.traits.angular_damping = 0.85;
      body.position = place(limb.x, limb.y, 0);
      const Quat quarter_turn{0, 0, std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2};
      body.rotation = limb.lies_along_x ? product(heading, quarter_turn) : heading;
      const Vec3 r{body.position[0] - middle[0], body.position[1] - middle[1], body.position[2] - middle[2]};
      body.velocity = {turning[1] * r[2] - turning[2] * r[1], turning[2] * r[0] - turning[0] * r[2],
                       turning[0] * r[1] - turning[1] * r[0]};
      body.spin = turning;
      out.bodies.push_back(std::move(body));
    }
    for (const Link& link : links) {
      Joint joint;
      joint.a = first + link.a;
      joint.b = first + link.b;
      const Vec3 pivot = place(link.pivot[0], link.pivot[1], link.pivot[2]);
      const Vec3 axis = turned(heading, link.axis);
      if (link.hinge) {
        joint.value = HingeJoint{pivot, axis, std::array<double, 2>{link.first, link.second}};
      } else {
        joint.value = ConeTwistJoint{pivot, axis, link.first, link.second, link.twist};
      }
      out.joints.push_back(joint);
    }
  }
}

}  // namespace boxstream::scenes
