// SPDX-License-Identifier: MIT
#include "mesh/orientation.hpp"

#include <cmath>
#include <vector>

namespace boxstream::mesh {
namespace {

/// A number as the sum of doubles, exact: what rounding takes away from one term is kept in another (J. R. Shewchuk,
/// "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997).
///
/// Exact as long as nothing overflows and no product of two terms underflows. Slow: for what a filter cannot decide.
class Expansion {
 public:
  Expansion() = default;

  /// a - b.
  static Expansion difference(double a, double b);

  friend Expansion operator+(const Expansion& a, const Expansion& b);
  friend Expansion operator-(const Expansion& a, const Expansion& b);
  friend Expansion operator*(const Expansion& a, const Expansion& b);

  /// -1, 0 or 1.
  int sign() const;

 private:
  void add(double term);
  Expansion times(double factor) const;

  /// By increasing magnitude, none zero, and no two have bits of the same weight, so that the last has the sign of all.
  std::vector<double> terms_;
};

/// A rounded result and what rounding took away.
struct Rounded {
  double value, error;
};

Rounded sum(double a, double b) {
  const double value = a + b;
  const double b_in_it = value - a;
  const double a_in_it = value - b_in_it;
  return {value, (a - a_in_it) + (b - b_in_it)};
}

Rounded product(double a, double b) {
  const double value = a * b;
  return {value, std::fma(a, b, -value)};
}

Expansion Expansion::difference(double a, double b) {
  const Rounded d = sum(a, -b);
  Expansion result;
  if (d.error != 0) result.terms_.push_back(d.error);
  if (d.value != 0) result.terms_.push_back(d.value);
  return result;
}

void Expansion::add(double term) {
  std::size_t kept = 0;
  for (const double t : terms_) {
    const Rounded s = sum(term, t);
    term = s.value;
    if (s.error != 0) terms_[kept++] = s.error;
  }
  terms_.resize(kept);
  if (term != 0) terms_.push_back(term);
}

Expansion Expansion::times(double factor) const {
  Expansion result;
  double carried = 0;
  const auto keep = [&](double error) {
    if (error != 0) result.terms_.push_back(error);
  };
  for (const double t : terms_) {
    const Rounded p = product(t, factor);
    const Rounded low = sum(carried, p.error);
    keep(low.error);
    const Rounded high = sum(p.value, low.value);
    keep(high.error);
    carried = high.value;
  }
  keep(carried);
  return result;
}

Expansion operator+(const Expansion& a, const Expansion& b) {
  Expansion result = a;
  for (const double t : b.terms_) result.add(t);
  return result;
}

Expansion operator-(const Expansion& a, const Expansion& b) {
  Expansion result = a;
  for (const double t : b.terms_) result.add(-t);
  return result;
}

Expansion operator*(const Expansion& a, const Expansion& b) {
  Expansion result;
  for (const double t : b.terms_) result = result + a.times(t);
  return result;
}

int Expansion::sign() const {
  if (terms_.empty()) return 0;
  return terms_.back() > 0 ? 1 : -1;
}

// Each term of a determinant passes through as many roundings as these bounds have units of 2^-53 at most, its
// magnitude is summed with as many again, and there is room for the products of errors.
//   2 x 2: two differences, a product, a subtraction: 4 and 4.
//   3 x 3: three differences, two products, a subtraction, two additions: 8 and 8.
constexpr double unit = 0x1p-53;
constexpr double bound_2 = 10 * unit;
constexpr double bound_3 = 20 * unit;

int sign_exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto d = Expansion::difference;
  return (d(b[0], a[0]) * d(c[1], a[1]) - d(b[1], a[1]) * d(c[0], a[0])).sign();
}

int sign_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Expansion u[3], v[3], w[3];
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = Expansion::difference(b[k], a[k]);
    v[k] = Expansion::difference(c[k], a[k]);
    w[k] = Expansion::difference(d[k], a[k]);
  }
  return ((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2])
      .sign();
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  const double determinant = left - right;
  const double error = bound_2 * (std::abs(left) + std::abs(right));
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  return error == 0 ? 0 : sign_exact(a, b, c);
}

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
  const double determinant = (yz - zy) * wx + (zx - xz) * wy + (xy - yx) * wz;
  const double error =
      bound_3 * ((std::abs(yz) + std::abs(zy)) * std::abs(wx) + (std::abs(zx) + std::abs(xz)) * std::abs(wy) +
                 (std::abs(xy) + std::abs(yx)) * std::abs(wz));
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  return error == 0 ? 0 : sign_exact(a, b, c, d);
}

}  // namespace boxstream::mesh
