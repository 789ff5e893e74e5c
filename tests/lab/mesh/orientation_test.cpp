// SPDX-License-Identifier: MIT
#include "mesh/orientation.hpp"

#include <gtest/gtest.h>

#include "random.hpp"

namespace boxstream::mesh::tests {
namespace {

__extension__ typedef __int128 Wide;

int sign(Wide x) {
  return (x > 0) - (x < 0);
}

/// Whole numbers of up to 29 bits: a determinant of their differences has less than 96.
TEST(Orientation, OfWholeNumbers) {
  boxstream::tests::Random random(1);
  int zero = 0;
  for (const int bits : {1, 2, 4, 20, 29})
    for (int i = 0; i < 3000; ++i) {
      long p[4][3];
      const int most = 1 << bits;
      for (auto& point : p)
        for (long& x : point) x = random.integer(-most, most);
      if (i % 3 == 0)  // a parallelogram, so in one plane, or one step beside it
        for (int d = 0; d < 3; ++d) p[3][d] = p[1][d] + p[2][d] - p[0][d] + (d == 0 ? random.integer(-1, 1) : 0);
      Wide u[3][3];
      Vec3 v[4];
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 3; ++d) {
          v[k][static_cast<std::size_t>(d)] = static_cast<double>(p[k][d]);
          if (k > 0) u[k - 1][d] = p[k][d] - p[0][d];
        }
      const Wide determinant = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
                               u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
                               u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
      ASSERT_EQ(orientation(v[0], v[1], v[2], v[3]), sign(determinant)) << bits << " bits, " << i;
      zero += determinant == 0;
      const Vec2 a{v[0][0], v[0][1]}, b{v[1][0], v[1][1]}, c{v[2][0], v[2][1]};
      ASSERT_EQ(orientation(a, b, c), sign(u[0][0] * u[1][1] - u[0][1] * u[1][0])) << bits << " bits, " << i;
    }
  EXPECT_GT(zero, 1000);
}

}  // namespace
}  // namespace boxstream::mesh::tests
