// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detail/rounded_up.hpp>
#include <boxstream/ray.hpp>

#include "status.hpp"

// Numbers of C are doubles, those of a world may be floats. Hosts may trap what rounds and flush what is denormal: so
// all of it happens in an environment of its own.
namespace boxstream::c {

using detail::DefaultFloatEnvironment;
using detail::rounded_up;

/// `x`, computed here: what is in registers alone the compiler may compute on the other side of a change of the
/// environment.
template <class T>
T computed(T x) {
  const volatile T here = x;
  return here;
}

/// A limit or a length, rounded so that nothing is lost.
template <class S>
S limit_of(double x) {
  const DefaultFloatEnvironment environment;
  return computed(detail::limit_of<S>(computed(x)));
}

template <class S>
double in_double(S x) {
  const DefaultFloatEnvironment environment;
  return computed(static_cast<double>(computed(x)));
}

inline void check_distance(double distance) {
  const DefaultFloatEnvironment environment;
  const double x = computed(distance);
  if (!(std::isfinite(x) && x >= 0)) throw std::invalid_argument("a distance is finite and not below 0");
}

/// The nearest numbers of S.
template <class S>
struct Point {
  explicit Point(const double* point) {
    need(point, "no point");
    const DefaultFloatEnvironment environment;
    for (int d = 0; d < 3; ++d) at[d] = computed(static_cast<S>(computed(point[d])));
  }
  S at[3];
};

template <class S>
BasicRay<S> ray_of(const double* origin, const double* direction, double length) {
  const Point<S> from(origin), along(direction);
  const S limit = limit_of<S>(length);
  const DefaultFloatEnvironment environment;
  BasicRay<S> ray =
      BasicRay<S>::along(from.at, {computed(along.at[0]), computed(along.at[1]), computed(along.at[2])}, limit);
  for (S& inverse : ray.inverse_direction) inverse = computed(inverse);
  ray.length = computed(ray.length);
  return ray;
}

/// A box of doubles, asked of a world of S.
template <class S>
class AskedBox {
 public:
  explicit AskedBox(const double* box) {
    need(box, "no box");
    const DefaultFloatEnvironment environment;
    for (int d = 0; d < 3; ++d) exact_.min[d] = computed(box[d]), exact_.max[d] = computed(box[3 + d]);
    if (!is_valid(exact_)) return;
    for (int d = 0; d < 3; ++d) {
      around_.min[d] = computed(-rounded_up<S>(-exact_.min[d]));
      around_.max[d] = computed(rounded_up<S>(exact_.max[d]));
    }
    is_rounded_ = computed(!(in_doubles(around_) == exact_));
  }

  /// The smallest box of S that contains it; invalid if it is.
  const BasicAabb<S>& around() const { return around_; }

  /// Of a box that touches `around`: whether it touches the one that was asked.
  bool touches(const BasicAabb<S>& box) const {
    if (!is_rounded_) return true;
    const DefaultFloatEnvironment environment;
    return computed(overlaps(exact_, in_doubles(box)));
  }

 private:
  static Aabb64 in_doubles(const BasicAabb<S>& box) {
    Aabb64 same;
    for (int d = 0; d < 3; ++d) same.min[d] = computed(box.min[d]), same.max[d] = computed(box.max[d]);
    return same;
  }

  Aabb64 exact_{};
  BasicAabb<S> around_{{1, 1, 1}, {-1, -1, -1}};
  bool is_rounded_ = false;
};

}  // namespace boxstream::c
