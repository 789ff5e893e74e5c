// SPDX-License-Identifier: MIT
#include "mesh/orientation.hpp"

#include <cmath>

#include "mesh/expansion.hpp"

namespace boxstream::mesh {
namespace {

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
