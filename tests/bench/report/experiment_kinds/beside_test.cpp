// SPDX-License-Identifier: MIT
#include "experiment_kinds/beside.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boxstream::report {
namespace {

Point point(const std::string& series, double cost, double error, const std::string& failure = "") {
  Point made;
  made.series = series;
  made.cost.median = cost;
  made.values = {error};
  made.failure = failure;
  return made;
}

TEST(Beside, ErrorsAtACostFollowThePowerLawBetweenNeighbours) {
  const std::vector<Point> points{point("", 1, 1), point("", 10, 0.01), point("", 100, 0.001)};
  EXPECT_NEAR(error_at_cost(points, 0, std::sqrt(10.0)), 0.1, 1e-12);
  EXPECT_NEAR(error_at_cost(points, 0, 10), 0.01, 1e-12);
  EXPECT_NEAR(error_at_cost(points, 0, 10 * std::sqrt(10.0)), 0.01 / std::sqrt(10.0), 1e-12);
}

TEST(Beside, ThereIsNoErrorAtCostsThatWereNotMeasured) {
  const std::vector<Point> points{point("", 1, 1), point("", 10, 0.01), point("", 0.1, 7, "exploded"),
                                  point("", 100, 0)};
  EXPECT_TRUE(std::isnan(error_at_cost(points, 0, 0.5)));
  EXPECT_TRUE(std::isnan(error_at_cost(points, 0, 50)));
  EXPECT_TRUE(std::isnan(error_at_cost({}, 0, 1)));
}

TEST(Beside, RatiosAreToTheSeriesThatIsNamed) {
  const std::vector<Point> points{point("a", 1, 1), point("b", 1, 0.25), point("a", 4, 0.5), point("b", 4, 1)};
  const std::vector<double> ratios = errors_beside("a", 0, points);
  ASSERT_EQ(ratios.size(), 4U);
  EXPECT_TRUE(std::isnan(ratios[0]));
  EXPECT_NEAR(ratios[1], 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(ratios[2]));
  EXPECT_NEAR(ratios[3], 2, 1e-12);
}

}  // namespace
}  // namespace boxstream::report
