// SPDX-License-Identifier: MIT
#include "simulation/engine/windward.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

using std::numbers::pi;

/// Gauss's two points of a length from -1 to 1: what is quadratic along it is exact.
const double gauss = 1 / std::sqrt(3.0);

constexpr int cone_sides = 16;

}  // namespace

Windward::Windward(ShapeSet& shapes, std::size_t shape, const btTransform& frame) {
  for (const SolidPart& part : solid_parts(shapes, shape, frame)) {
    reach_ = std::max(reach_, double{part.pose.getOrigin().length()} + scenes::reach(part));
    add(part);
  }
}

/// Four spots, with the moments of a disc.
void Windward::add_disc(const btTransform& pose, double height, double radius, double sign) {
  const btVector3 area = pose.getBasis().getColumn(1) * real(sign * pi * radius * radius / 4);
  const double out = radius / std::sqrt(2.0);
  for (const auto& [x, z] : {std::pair{out, 0.0}, {-out, 0.0}, {0.0, out}, {0.0, -out}})
    flats_.push_back({pose * btVector3(real(x), real(height), real(z)), area});
}

/// Large triangles have three spots, of the same moments as the triangle's; small ones one.
void Windward::add_facets(const Facets& facets) {
  double all = 0;
  const auto area_of = [&](const std::array<std::uint32_t, 3>& t) {
    const btVector3 &a = facets.vertices[t[0]], &b = facets.vertices[t[1]], &c = facets.vertices[t[2]];
    return (b - a).cross(c - a) / 2;
  };
  for (const auto& t : facets.triangles) all += double{area_of(t).length()};
  for (const auto& t : facets.triangles) {
    const btVector3 &a = facets.vertices[t[0]], &b = facets.vertices[t[1]], &c = facets.vertices[t[2]];
    const btVector3 area = area_of(t);
    if (double{area.length()} < all / 24) {
      flats_.push_back({(a + b + c) / 3, area});
    } else {
      for (const btVector3& middle : {(a + b) / 2, (b + c) / 2, (c + a) / 2}) flats_.push_back({middle, area / 3});
    }
  }
}

void Windward::add(const SolidPart& part) {
  const btTransform& pose = part.pose;
  const btVector3 axis = pose.getBasis().getColumn(1);
  const auto on_axis = [&](double s) { return pose * btVector3(0, real(s), 0); };
  const auto add_side = [&](double radius, double height) {
    for (const double s : {-gauss * height / 2, gauss * height / 2})
      sides_.push_back({on_axis(s), axis, real(radius * height), real(radius * pi / 4)});
  };
  const auto of = [&]<class S>(const S& s) {
    if constexpr (std::is_same_v<S, SphereShape>) {
      balls_.push_back({pose.getOrigin(), real(pi * s.radius * s.radius)});
    } else if constexpr (std::is_same_v<S, BoxShape>) {
      const Vec3& h = s.half_extents;
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
        for (const double side : {-1.0, 1.0}) {
          const btVector3 area = pose.getBasis().getColumn(static_cast<int>(d)) * real(side * h[e] * h[f]);
          for (const double u : {-gauss, gauss}) {
            for (const double v : {-gauss, gauss}) {
              Vec3 place{};
              place[d] = side * h[d], place[e] = u * h[e], place[f] = v * h[f];
              flats_.push_back({pose * vector(place), area});
            }
          }
        }
      }
    } else if constexpr (std::is_same_v<S, CylinderShape>) {
      add_side(s.radius, s.height);
      add_disc(pose, s.height / 2, s.radius, 1);
      add_disc(pose, -s.height / 2, s.radius, -1);
    } else if constexpr (std::is_same_v<S, CapsuleShape>) {
      add_side(s.radius, s.height);
      for (const double end : {-1.0, 1.0})
        caps_.push_back({on_axis(end * s.height / 2), axis * real(end), real(pi * s.radius * s.radius / 2),
                         real(4 * s.radius / (3 * pi))});
    } else if constexpr (std::is_same_v<S, ConeShape>) {
      add_disc(pose, -s.height / 2, s.radius, -1);
      for (int i = 0; i < cone_sides; ++i) {
        const double angle = 2 * pi * (i + 0.5) / cone_sides, x = std::cos(angle), z = std::sin(angle);
        // A third up from the base, where the middle of a triangle to the tip is.
        const btVector3 place(real(s.radius * 2 / 3 * x), real(-s.height / 6), real(s.radius * 2 / 3 * z));
        const double share = pi * s.radius / cone_sides;
        flats_.push_back({pose * place, pose.getBasis() * btVector3(real(share * s.height * x), real(share * s.radius),
                                                                    real(share * s.height * z))});
      }
    } else {
      add_facets(facets(part));
    }
  };
  std::visit(of, *part.shape);
}

Windward::Push Windward::push(const btVector3& flow, const btVector3& spin) const {
  Push push;
  const auto add_push = [&](const btVector3& place, const btVector3& force) {
    push.force += force;
    push.torque += place.cross(force);
  };
  for (const Flat& flat : flats_) {
    const btVector3 local = flow - spin.cross(flat.place);
    if (const btScalar flux = -local.dot(flat.area); flux > 0) add_push(flat.place, local * flux);
  }
  for (const Ball& ball : balls_) {
    const btVector3 local = flow - spin.cross(ball.place);
    add_push(ball.place, local * (ball.area * local.length()));
  }
  for (const Side& side : sides_) {
    const btVector3 local = flow - spin.cross(side.place);
    const btVector3 across = local - side.axis * side.axis.dot(local);
    const btScalar speed = across.length();
    if (speed > 0) add_push(side.place - across * (side.depth / speed), local * (side.area * speed));
  }
  for (const Cap& cap : caps_) {
    const btVector3 local = flow - spin.cross(cap.place);
    const btScalar speed = local.length(), along = -cap.axis.dot(local);
    const btScalar met = speed + along;  // speed times 1 + cosine
    if (!(met > btScalar(1e-6) * speed)) continue;
    const btVector3 aside = cap.axis * speed + local * (along / speed);
    add_push(cap.place + aside * (cap.offset / met), local * (cap.area * met));
  }
  return push;
}

}  // namespace boxstream::scenes
