// SPDX-License-Identifier: MIT
#include "ask_ccd.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "truth.hpp"

namespace boxstream::poses {
namespace {

using ccd::Status;

ccd::Shape shape_of(const Solid& solid) {
  const auto& s = solid.size;
  switch (solid.kind) {
    case Kind::box:
      return ccd::Box{{s[0] / 2, s[1] / 2, s[2] / 2}};
    case Kind::sphere:
      return ccd::Sphere{s[0]};
    case Kind::capsule:
      return ccd::Capsule{s[0], s[1]};
    case Kind::cylinder:
      return ccd::Cylinder{s[0], s[1]};
    case Kind::cone:
      return ccd::Cone{s[0], s[1]};
    default:
      return ccd::ConvexHull{solid.points};
  }
}

/// Collects what the answers to one pair of convex shapes do not keep of what is promised.
class Check {
 public:
  Check(const Solid& a, const Solid& b, const ccd::Options& options)
      : a_(a), b_(b), truth_(signed_distance_of_convex(a, b)) {
    const double least = std::min(radius(a), radius(b)), size = least > 0 ? least : std::max(radius(a), radius(b));
    rounding_ = 256 * std::numeric_limits<double>::epsilon() * extent(a, b);
    tolerance_ = options.tolerance * size + rounding_;
  }

  void intersection(Status status, bool intersects) {
    note(status);
    expect(truth_ > -rounding_ || intersects, "an overlap is missed");
    expect(status != Status::ok || truth_ <= tolerance_ || !intersects, "a gap is taken for contact");
  }

  void penetration(const ccd::Penetration& p) {
    intersection(p.status, p.intersects);
    if (!p.intersects) return;
    expect(std::isfinite(p.depth) && p.on_a.allFinite() && p.on_b.allFinite(), "not a number");
    expect(std::abs(p.direction.norm() - 1) < 1e-9, "no direction");
    const double along = -static_cast<double>(gap_along(a_, b_, p.direction));
    expect(std::abs(std::max(along, 0.0) - p.depth) <= rounding_, "the depth is not that of its direction");
    expect(p.status != Status::ok || p.depth <= std::max<Real>(-truth_, 0) + tolerance_, "the depth is not the least");
    if (truth_ <= 0) value_ = -p.depth;
  }

  void distance(const ccd::Distance& d) {
    note(d.status);
    const Real apart = std::max<Real>(truth_, 0);
    expect(std::isfinite(d.distance) && d.on_a.allFinite() && d.on_b.allFinite(), "not a number");
    expect(d.distance >= apart - rounding_, "the distance is too small");
    expect(d.lower_bound <= apart + rounding_, "the lower bound is too large");
    expect(d.status != Status::ok || d.distance <= apart + tolerance_, "the distance is too large");
    if (truth_ > 0) value_ = d.distance;
  }

  Verdict verdict() const {
    const auto kind = !wrong_.empty()   ? Verdict::Kind::wrong
                      : honest_.empty() ? Verdict::Kind::right
                                        : Verdict::Kind::honest;
    return {kind, value_, static_cast<double>(truth_), wrong_.empty() ? honest_ : wrong_};
  }

 private:
  void note(Status status) {
    if (status == Status::invalid_input) expect(false, "invalid input");
    if (status != Status::ok) honest_ = ccd::name(status);
  }
  void expect(bool is_so, const char* otherwise) {
    if (!is_so && wrong_.empty()) wrong_ = otherwise;
  }

  const Solid& a_;
  const Solid& b_;
  Real truth_;
  double rounding_ = 0, tolerance_ = 0, value_ = std::numeric_limits<double>::quiet_NaN();
  std::string honest_, wrong_;
};

Verdict ask_about_convex(const Solid& a, const Solid& b, const ccd::Options& options) {
  if (a.kind == Kind::half_space || b.kind == Kind::half_space) return {Verdict::Kind::no_such_shape};
  const ccd::Shape shape_a = shape_of(a), shape_b = shape_of(b);
  const ccd::Pose pose_a(a.rotation, a.translation), pose_b(b.rotation, b.translation);
  Check check(a, b, options);
  const ccd::Intersection i = intersect(shape_a, pose_a, shape_b, pose_b, options);
  check.intersection(i.status, i.intersects);
  check.penetration(penetration(shape_a, pose_a, shape_b, pose_b, options));
  check.distance(ccd::distance(shape_a, pose_a, shape_b, pose_b, options));
  return check.verdict();
}

}  // namespace

const char* name(Verdict::Kind kind) {
  static const char* const names[] = {"right", "honest", "wrong", "no such shape"};
  return names[static_cast<int>(kind)];
}

Verdict ask_ccd(const Solid& a, const Solid& b, const ccd::Options& options) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Verdict all{Verdict::Kind::right, far, far};
  for (const Solid& part_a : parts(a))
    for (const Solid& part_b : parts(b)) {
      const Verdict one = ask_about_convex(part_a, part_b, options);
      if (one.kind > all.kind) all.kind = one.kind, all.why = one.why;
      all.value = std::min(all.value, one.value);
      all.truth = std::min(all.truth, one.truth);
    }
  return all;
}

}  // namespace boxstream::poses
