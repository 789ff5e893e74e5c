// SPDX-License-Identifier: MIT
#include <boxstream/boxstream.hpp>
#include <boxstream/ccd.hpp>
#include <cmath>

int main() {
  namespace ccd = boxstream::ccd;
  const ccd::Shape ball = ccd::Sphere{1}, crate = ccd::Box{{1, 1, 1}};
  const Eigen::Isometry3d here = Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d there = Eigen::Translation3d(1.5, 0, 0) * here;
  const boxstream::Aabb64 boxes[] = {bounds(ball, here), bounds(crate, there)};
  const bool pair = boxstream::find_pairs(boxstream::Span<const boxstream::Aabb64>(boxes, 2)).size() == 1;
  const ccd::Penetration contact = penetration(ball, here, crate, there);
  return pair && contact.status == ccd::Status::ok && std::abs(contact.depth - 0.5) < 1e-6 ? 0 : 1;
}
