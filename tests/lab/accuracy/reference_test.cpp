// SPDX-License-Identifier: MIT
#include "accuracy/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

/// One body that goes along x, each run off by an error of its own.
Member member(int substeps, const std::vector<double>& off) {
  Member run;
  run.substeps = substeps;
  run.trajectory.size = 1;
  for (std::size_t i = 0; i < off.size(); ++i)
    run.trajectory.frames.push_back(
        {{btVector3(btScalar(static_cast<double>(i) + off[i]), 0, 0)}, {btQuaternion(0, 0, 0, 1)}});
  run.series.push_back({off.back(), 0, 0, 0, 0});
  return run;
}

const std::vector<Measure> measures{parse_measure("lowest")};

TEST(Reference, ErrorOfASequenceThatConvergesIsExtrapolated) {
  // First order: 0.32 h, 0.16 h, 0.08 h off, so the last is off by what it gained.
  const Reference first = estimated({member(1, {0, 0.32}), member(2, {0, 0.16}), member(4, {0, 0.08})}, measures, 1);
  EXPECT_NEAR(first.error.back(), 0.08, 1e-6);
  EXPECT_NEAR(first.spread[0], 0.08, 1e-6);
  // Second order: a third of the last step.
  const Reference second = estimated({member(1, {0, 0.32}), member(2, {0, 0.08}), member(4, {0, 0.02})}, measures, 1);
  EXPECT_NEAR(second.error.back(), 0.02, 1e-6);
  EXPECT_TRUE(std::isinf(second.holds));
}

TEST(Reference, WhereRunsPartItHoldsNoLonger) {
  const Reference reference = estimated(
      {member(1, {0, 0.01, 0.01, -2, 5}), member(2, {0, 0.005, 0.005, 1, -3}), member(4, {0, 0.0025, 0.0025, -2, 4})},
      measures, 0.5);
  EXPECT_EQ(reference.holds, 1.5);  // the fourth frame
  EXPECT_NEAR(reference.error[3], 3, 1e-6);
  EXPECT_GE(reference.error[4], reference.error[3]);
}

TEST(Reference, TwoRunsAreApartByTheirError) {
  EXPECT_NEAR(estimated({member(1, {0, 0.3}), member(2, {0, 0.1})}, measures, 1).error.back(), 0.2, 1e-6);
  EXPECT_FALSE(estimated({member(1, {0, 0.3})}, measures, 1).is_estimated());
}

TEST(Reference, WhatStandsInAllRunsStands) {
  Member fallen = member(1, {0, 0}), standing = member(2, {0, 0}), also = member(4, {0, 0});
  fallen.vitals.height_loss = 0.7;
  EXPECT_FALSE(estimated({fallen, standing, also}, measures, 1).stands_alike);
  EXPECT_TRUE(estimated({standing, standing, also}, measures, 1).stands_alike);
}

TEST(Reference, WhatAllRunsLoseIsLost) {
  Member a = member(1, {0, 0}), b = member(2, {0, 0}), c = member(4, {0, 0});
  for (Member* each : {&a, &b, &c}) each->vitals.most_in_world = each->vitals.energy.first = 10;
  b.vitals.energy.now = c.vitals.energy.now = 8;
  a.vitals.energy.now = 8.2;
  EXPECT_TRUE(estimated({a, b, c}, measures, 1).loses_alike);
  a.vitals.energy.now = 8.4;
  EXPECT_FALSE(estimated({a, b, c}, measures, 1).loses_alike);
}

}  // namespace
}  // namespace boxstream::accuracy_test
