// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "simulation/query/run.hpp"

namespace boxstream::query_test {
namespace {

using query::Answer;
using query::Kind;

class Differences : public testing::Test {
 protected:
  Differences() : motion_(scene()) {}

  static query::QueryScene scene() {
    query::QueryScene scene;
    scene.groups.push_back({"arm", {query::Arm{}}, 0});
    return scene;
  }
  std::string of(Kind kind, const Answer& x, const Answer& y) const {
    query::Query query;
    query.kind = kind;
    return difference(query, motion_, "x", x, "y", y);
  }

  query::ObjectMotion motion_;
};

TEST_F(Differences, AreTheFirstOnes) {
  Answer x, y;
  x.hits = {{0, 2, 1, 0}, {1, 4, 2, 0}};
  y.hits = x.hits;
  x.callbacks = 7;
  EXPECT_EQ(of(Kind::collide, x, y), "") << "callbacks may differ";
  y.hits[1].contacts = 3;
  EXPECT_EQ(of(Kind::collide, x, y), "arm body 0 link 1 - arm body 0 link 4: x 2 contacts, y 3 contacts");
  y.hits.pop_back();
  EXPECT_EQ(of(Kind::collide, x, y), "arm body 0 link 1 - arm body 0 link 4: found by x, not by y");
  EXPECT_EQ(of(Kind::collide, y, x), "arm body 0 link 1 - arm body 0 link 4: found by y, not by x");
  y.hits.insert(y.hits.begin(), {0, 1, 1, 0});
  EXPECT_EQ(of(Kind::collide, x, y), "arm body 0 link 0 - arm body 0 link 1: found by y, not by x");
  x.distance = 1, y.distance = 2;
  EXPECT_EQ(of(Kind::distance, x, y), "least distance 1 on x, 2 on y");
  y.distance = 1;
  EXPECT_EQ(of(Kind::distance, x, y), "");
  x.touching = true;
  EXPECT_EQ(of(Kind::first, x, y), "x finds a pair that touches, y none");
}

TEST_F(Differences, PartsThatBelongTogetherAreNoPair) {
  const auto& objects = motion_.objects();
  ASSERT_EQ(objects.size(), 8U) << "seven links and a tool";
  EXPECT_TRUE(belong_together(objects[0], objects[1]));
  EXPECT_FALSE(belong_together(objects[0], objects[2]));
  EXPECT_TRUE(belong_together(objects[6], objects[7]));
  EXPECT_EQ(motion_.name(7), "arm body 0 tool 7");
}

}  // namespace
}  // namespace boxstream::query_test
