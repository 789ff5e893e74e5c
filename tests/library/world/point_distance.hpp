// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/multiprecision/cpp_int.hpp>

#include <boxstream/aabb.hpp>

namespace boxstream::tests {

/// How far a point is from a valid box. Compared in integers that hold everything, unless sums in long double, whose
/// range has the square of every double, are exact or too far apart to be wrong.
class PointDistance {
 public:
  PointDistance() = default;

  template <class S>
  PointDistance(const S (&point)[3], const BasicAabb<S>& box) {
    for (int d = 0; d < 3; ++d) {
      const S x = point[d];
      if (std::isless(x, box.min[d]))
        set(d, x, box.min[d]);
      else if (std::isgreater(x, box.max[d]))
        set(d, box.max[d], x);
    }
  }

  friend bool operator<(const PointDistance& a, const PointDistance& b) {
    constexpr long double inf = std::numeric_limits<long double>::infinity(), slack = 1e-17L;
    if (a.about_ < b.about_ * (1 - slack)) return true;
    if (b.about_ < a.about_ * (1 - slack) || (a.about_ == inf && b.about_ == inf)) return false;
    if (a.is_exact_ && b.is_exact_) return a.about_ < b.about_;
    if (std::equal(a.least_, a.least_ + 3, b.least_) && std::equal(a.most_, a.most_ + 3, b.most_)) return false;
    return a.squared() < b.squared();
  }

 private:
  using Integer = boost::multiprecision::cpp_int;

  void set(int axis, double least, double most) {
    least_[axis] = least;
    most_[axis] = most;
    const long double gap = static_cast<long double>(most) - least;
    about_ += gap * gap;
    is_exact_ = is_exact_ && is_short(least) && is_short(most);
  }

  /// 16 bits before the point and 8 after it at most: three squares of such differences fit into 53 bits.
  static bool is_short(double x) { return std::abs(x) < 0x1p16 && x * 0x1p8 == std::trunc(x * 0x1p8); }

  /// In units of the smallest double.
  static Integer whole(double x) {
    int exponent = 0;
    const auto digits = static_cast<long long>(std::ldexp(std::frexp(x, &exponent), 53));
    const int shift = exponent - 53 + 1074;
    return shift < 0 ? Integer(digits) / (Integer(1) << -shift) : Integer(digits) * (Integer(1) << shift);
  }

  Integer squared() const {
    Integer sum = 0;
    for (int d = 0; d < 3; ++d) {
      const Integer gap = whole(most_[d]) - whole(least_[d]);
      sum += gap * gap;
    }
    return sum;
  }

  double least_[3] = {}, most_[3] = {};
  long double about_ = 0;
  bool is_exact_ = true;
};

}  // namespace boxstream::tests
