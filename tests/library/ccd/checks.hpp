// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <boxstream/ccd.hpp>
#include <cmath>

namespace boxstream::ccd_test {

/// Every number is finite, directions have unit length.
inline void expect_sane(const ccd::Penetration& p) {
  EXPECT_TRUE(std::isfinite(p.depth) && p.depth >= 0);
  EXPECT_TRUE(p.on_a.allFinite() && p.on_b.allFinite());
  EXPECT_NEAR(p.direction.norm(), p.intersects ? 1 : 0, 1e-9);
}

}  // namespace boxstream::ccd_test
