// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/contact_points.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/engine/contacts/separation.hpp"

namespace boxstream::scenes {
namespace {

/// Candidates for the points: corners of a face that was cut by the sides of another.
struct Candidates {
  static constexpr std::size_t most = 2 * Flat::most;

  void add(const ContactPoints::Point& point) {
    if (count < most) points[count++] = point;
  }

  std::array<ContactPoints::Point, most> points;
  std::size_t count = 0;
};

struct Cut {
  std::array<Vec3, Candidates::most> corners;
  std::size_t count = 0;

  void add(const Vec3& corner) {
    if (count < corners.size()) corners[count++] = corner;
  }

  /// What lies on the side of the plane that its normal points away from.
  void by(const Vec3& on_plane, const Vec3& normal) {
    Cut kept;
    const std::size_t sides = count == 2 ? 1 : count;
    const auto height = [&](const Vec3& p) { return dot(normal, minus(p, on_plane)); };
    if (count == 2 && height(corners[0]) <= 0) kept.add(corners[0]);
    for (std::size_t i = 0; i < sides; ++i) {
      const Vec3 &from = corners[i], &to = corners[(i + 1) % count];
      const double low = height(from), high = height(to);
      if (count > 2 && low <= 0) kept.add(from);
      if ((low < 0 && high > 0) || (low > 0 && high < 0))
        kept.add(plus(from, times(minus(to, from), low / (low - high))));
    }
    if (count == 2 && height(corners[1]) <= 0) kept.add(corners[1]);
    *this = kept;
  }
};

/// The face cut to what is over the other one, as seen along the normal.
Cut over(const Flat& flat, const Flat& face, const Vec3& normal) {
  Cut cut;
  for (std::size_t i = 0; i < flat.count; ++i) cut.add(flat.corners[i]);
  Vec3 middle{};
  for (std::size_t i = 0; i < face.count; ++i)
    middle = plus(middle, times(face.corners[i], 1.0 / static_cast<double>(face.count)));
  for (std::size_t i = 0; i < face.count && cut.count > 1; ++i) {
    const Vec3& corner = face.corners[i];
    Vec3 side = cross(minus(face.corners[(i + 1) % face.count], corner), normal);
    if (dot(side, minus(middle, corner)) > 0) side = times(side, -1);
    cut.by(corner, side);
  }
  return cut;
}

/// What two segments that lie along each other share, of the first.
Cut beside(const Flat& a, const Flat& b) {
  const Vec3 along = minus(b.corners[1], b.corners[0]), way = minus(a.corners[1], a.corners[0]);
  constexpr double parallel = 0.05;  // the sine of an angle
  const double lengths = length(along) * length(way);
  Cut cut;
  if (!(lengths > 0) || length(cross(along, way)) > parallel * lengths) return cut;
  cut.add(a.corners[0]), cut.add(a.corners[1]);
  cut.by(b.corners[0], times(along, -1));
  if (cut.count > 1) cut.by(b.corners[1], along);
  return cut;
}

/// The deepest, the one farthest from it, the one farthest from both, and the farthest on the other side of these.
void choose(const ContactPoints::Point* from, std::size_t count, ContactPoints& out) {
  out.count = 0;
  if (count == 0) return;
  const auto take = [&](auto worth) {
    std::size_t best = 0;
    double most = worth(from[0]);
    for (std::size_t i = 1; i < count; ++i)
      if (const double w = worth(from[i]); w > most) most = w, best = i;
    if (out.count == 0 || most > 0) out.points[out.count++] = from[best];
    return out.count;
  };
  take([](const ContactPoints::Point& p) { return -p.distance; });
  const Vec3 first = out.points[0].on_b;
  if (take([&](const ContactPoints::Point& p) { return length(minus(p.on_b, first)); }) < 2) return;
  const Vec3 along = minus(out.points[1].on_b, first);
  const auto aside = [&](const Vec3& p) { return dot(out.normal, cross(along, minus(p, first))); };
  const double least = 1e-6 * dot(along, along);
  if (take([&](const ContactPoints::Point& p) { return std::abs(aside(p.on_b)) - least; }) < 3) return;
  const double sign = aside(out.points[2].on_b) > 0 ? -1 : 1;
  // Beyond any side of the triangle of the three.
  const std::array<Vec3, 3> corners{out.points[0].on_b, out.points[1].on_b, out.points[2].on_b};
  take([&](const ContactPoints::Point& p) {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& corner = corners[i];
      const Vec3 side = minus(corners[(i + 1) % 3], corner);
      most = std::max(most, sign * dot(out.normal, cross(side, minus(p.on_b, corner))));
    }
    return most - least;
  });
}

}  // namespace

void choose_four(const ContactPoints::Point* points, std::size_t count, ContactPoints& out) {
  choose(points, count, out);
}

ContactPoints contact_points(const PlacedConvex& a, const PlacedConvex& b, double reach) {
  ContactPoints out;
  const Separation nearest = separation(a, b, reach);
  if (!(nearest.distance <= reach)) return out;
  const Vec3& n = nearest.normal;
  out.normal = n;
  Candidates candidates;
  const double round = a.radius() + b.radius();
  const auto add = [&](const Vec3& core_of_b, double apart) {
    if (apart - round <= reach) candidates.add({plus(core_of_b, times(n, b.radius())), apart - round});
  };
  const Flat of_a = a.facing(times(n, -1)), of_b = b.facing(n);
  const double lean_a = of_a.is_face() ? -dot(of_a.normal, n) : 0, lean_b = of_b.is_face() ? dot(of_b.normal, n) : 0;
  constexpr double steep = 0.1;
  if (lean_b >= lean_a && lean_b > steep && of_a.count > 1) {
    const Cut cut = over(of_a, of_b, n);
    for (std::size_t i = 0; i < cut.count; ++i) {
      const double apart = dot(minus(cut.corners[i], of_b.corners[0]), of_b.normal) / lean_b;
      add(minus(cut.corners[i], times(n, apart)), apart);
    }
  } else if (lean_a > lean_b && lean_a > steep && of_b.count > 1) {
    const Cut cut = over(of_b, of_a, n);
    for (std::size_t i = 0; i < cut.count; ++i)
      add(cut.corners[i], dot(minus(cut.corners[i], of_a.corners[0]), of_a.normal) / lean_a);
  } else if (of_a.count == 2 && of_b.count == 2) {
    const Cut cut = beside(of_a, of_b);
    const Vec3 along = minus(of_b.corners[1], of_b.corners[0]);
    for (std::size_t i = 0; i < cut.count; ++i) {
      const double t = dot(minus(cut.corners[i], of_b.corners[0]), along) / dot(along, along);
      const Vec3 core_of_b = plus(of_b.corners[0], times(along, t));
      add(core_of_b, dot(n, minus(cut.corners[i], core_of_b)));
    }
  }
  double deepest = reach;
  for (std::size_t i = 0; i < candidates.count; ++i) deepest = std::min(deepest, candidates.points[i].distance);
  const double size = std::min(a.size(), b.size());
  if (candidates.count == 0 || deepest > nearest.distance + 1e-4 * size)
    candidates.add({nearest.on_b, nearest.distance});
  choose(candidates.points.data(), candidates.count, out);
  return out;
}

ContactPoints contact_points(const PlacedConvex& a, const Vec3& normal, double offset, double reach) {
  ContactPoints out;
  out.normal = normal;
  const Vec3 down = times(normal, -1);
  Candidates candidates;
  const auto add = [&](const Vec3& core) {
    const double apart = dot(normal, core) - offset - a.radius();
    if (apart <= reach) candidates.add({minus(core, times(normal, apart + a.radius())), apart});
  };
  const Vec3 lowest = a.support(down);
  if (dot(normal, lowest) - offset - a.radius() > reach) return out;
  const Flat face = a.facing(down);
  for (std::size_t i = 0; i < face.count; ++i) add(face.corners[i]);
  add(lowest);
  choose(candidates.points.data(), candidates.count, out);
  return out;
}

}  // namespace boxstream::scenes
