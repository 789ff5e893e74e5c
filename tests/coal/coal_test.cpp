// SPDX-License-Identifier: MIT
// The contract of boxstream::coal::CollisionManager: every query beside all pairs of boxes, one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <coal/shape/geometric_shapes.h>
#include <boxstream/coal.hpp>

namespace boxstream {
namespace {

using Manager = boxstream::coal::CollisionManager;
using Object = ::coal::CollisionObject;
using Objects = std::vector<Object*>;
using Pairs = std::set<std::pair<Object*, Object*>>;
constexpr double inf = std::numeric_limits<double>::infinity();

bool touch(const Object* a, const Object* b) {
  for (int d = 0; d < 3; ++d)
    if (a->getAABB().min_[d] > b->getAABB().max_[d] || b->getAABB().min_[d] > a->getAABB().max_[d]) return false;
  return true;
}

double apart(const Object* a, const Object* b) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const double gap =
        std::max({0.0, a->getAABB().min_[d] - b->getAABB().max_[d], b->getAABB().min_[d] - a->getAABB().max_[d]});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

struct Collected : ::coal::CollisionCallBackBase {
  Pairs pairs;
  int calls = 0, inits = 0, stop_after = -1;
  void init() override { ++inits; }
  bool collide(Object* a, Object* b) override {
    ++calls;
    EXPECT_TRUE(pairs.emplace(std::minmax(a, b)).second) << "a pair twice";
    return calls == stop_after;
  }
};

struct Nearest : ::coal::DistanceCallBackBase {
  double least = inf;
  int inits = 0, calls = 0;
  void init() override { ++inits; }
  bool distance(Object* a, Object* b, ::coal::CoalScalar& dist) override {
    ++calls;
    EXPECT_NE(a, b);
    least = std::min(least, apart(a, b));
    dist = least;
    return false;
  }
};

class Crowd {
 public:
  explicit Crowd(std::size_t size, unsigned seed, double side = 12) : random_(seed), in_(0, side) {
    for (std::size_t i = 0; i < size; ++i) {
      owned_.push_back(std::make_unique<Object>(std::make_shared<::coal::Box>(1, 1, 1)));
      objects.push_back(owned_.back().get());
    }
    move();
  }
  void move() {
    for (Object* const each : objects)
      for (int d = 0; d < 3; ++d) {
        each->getAABB().min_[d] = in_(random_);
        each->getAABB().max_[d] = each->getAABB().min_[d] + in_(random_) / 4;
      }
  }

  Objects objects;

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> in_;
  std::vector<std::unique_ptr<Object>> owned_;
};

Pairs all_pairs(const Objects& a, const Objects& b) {
  Pairs pairs;
  for (Object* const one : a)
    for (Object* const other : b)
      if (one != other && touch(one, other)) pairs.emplace(std::minmax(one, other));
  return pairs;
}

double least_of(const Objects& a, const Objects& b) {
  double least = inf;
  for (Object* const one : a)
    for (Object* const other : b)
      if (one != other) least = std::min(least, apart(one, other));
  return least;
}

void expect_truth(const Manager& manager, Manager& others, const Objects& mine, const Objects& theirs) {
  Collected self, between;
  manager.collide(&self);
  EXPECT_EQ(self.pairs, all_pairs(mine, mine));
  manager.collide(&others, &between);
  EXPECT_EQ(between.pairs, all_pairs(mine, theirs));
  Nearest nearest, nearest_between;
  manager.distance(&nearest);
  EXPECT_EQ(nearest.least, least_of(mine, mine));
  manager.distance(&others, &nearest_between);
  EXPECT_EQ(nearest_between.least, least_of(mine, theirs));
  for (Object* const query : {mine.front(), theirs.front(), theirs.back()}) {
    Collected of_one;
    manager.collide(query, &of_one);
    EXPECT_EQ(of_one.pairs, all_pairs(mine, {query}));
    Nearest nearest_of_one;
    manager.distance(query, &nearest_of_one);
    EXPECT_EQ(nearest_of_one.least, least_of(mine, {query}));
    EXPECT_EQ(of_one.inits + nearest_of_one.inits, 2);
  }
  EXPECT_EQ(self.inits + between.inits + nearest.inits + nearest_between.inits, 4);
}

TEST(Coal, EveryQueryEqualsAllPairsOfBoxes) {
  for (const std::size_t size : {2U, 9U, 150U, 700U}) {
    Crowd crowd(size, 5), others(size / 2 + 1, 6);
    Manager manager, manager_of_others;
    manager.registerObjects(crowd.objects);
    manager_of_others.registerObjects(others.objects);
    for (int round = 0; round < 3; ++round) {
      expect_truth(manager, manager_of_others, crowd.objects, others.objects);
      crowd.move();
      manager.update();
    }
  }
}

TEST(Coal, BoxesAreReadByUpdatesAlone) {
  Crowd crowd(40, 7, 4);
  Manager manager;
  manager.registerObjects(crowd.objects);
  const Pairs before = all_pairs(crowd.objects, crowd.objects);
  crowd.move();
  Collected still;
  manager.collide(&still);
  EXPECT_EQ(still.pairs, before);
  manager.update(crowd.objects.front());
  manager.update(Objects(crowd.objects.begin() + 1, crowd.objects.end()));
  Collected now;
  manager.collide(&now);
  EXPECT_EQ(now.pairs, all_pairs(crowd.objects, crowd.objects));
  EXPECT_NE(now.pairs, before);
}

TEST(Coal, ObjectsComeAndGo) {
  Crowd crowd(30, 8, 4);
  Manager manager;
  EXPECT_TRUE(manager.empty());
  manager.registerObjects(crowd.objects);
  manager.registerObject(crowd.objects[3]);  // again: its box is read
  EXPECT_EQ(manager.size(), 30U);
  EXPECT_EQ(manager.getObjects(), crowd.objects);
  manager.unregisterObject(crowd.objects[3]);
  manager.unregisterObject(crowd.objects[3]);
  crowd.objects.erase(crowd.objects.begin() + 3);
  EXPECT_EQ(manager.getObjects(), crowd.objects);
  Collected left;
  manager.collide(&left);
  EXPECT_EQ(left.pairs, all_pairs(crowd.objects, crowd.objects));
  manager.clear();
  EXPECT_TRUE(manager.empty());
  Collected none;
  manager.collide(&none);
  manager.collide(crowd.objects[0], &none);
  EXPECT_EQ(none.calls, 0);
  EXPECT_EQ(none.inits, 2) << "init() comes first, also of an empty manager";
}

TEST(Coal, ACallbackThatReturnsTrueIsTheLast) {
  Crowd crowd(60, 9, 3);
  Manager manager, same;
  manager.registerObjects(crowd.objects);
  same.registerObjects(crowd.objects);
  Collected self, between, one;
  self.stop_after = between.stop_after = one.stop_after = 2;
  manager.collide(&self);
  manager.collide(&same, &between);
  Object everywhere(std::make_shared<::coal::Box>(1, 1, 1));
  everywhere.getAABB().min_.setConstant(-9);
  everywhere.getAABB().max_.setConstant(99);
  manager.collide(&everywhere, &one);
  EXPECT_EQ(self.calls, 2);
  EXPECT_EQ(between.calls, 2);
  EXPECT_EQ(one.calls, 2);
}

TEST(Coal, BoundsThatAreNoNumbersAreNone) {
  Crowd crowd(3, 10);
  for (Object* const each : crowd.objects) {
    each->getAABB().min_.setConstant(0);
    each->getAABB().max_.setConstant(1);
  }
  crowd.objects[1]->getAABB().min_[0] = std::numeric_limits<double>::quiet_NaN();
  crowd.objects[2]->getAABB().min_[0] = 7;  // inverted: it touches nothing
  Manager manager;
  manager.registerObjects(crowd.objects);
  Collected found;
  manager.collide(&found);
  EXPECT_EQ(found.pairs, (Pairs{std::minmax(crowd.objects[0], crowd.objects[1])}));
}

TEST(Coal, NearPairsEndTheSearchEarly) {
  Crowd crowd(2000, 11, 100);
  Manager manager;
  manager.registerObjects(crowd.objects);
  Nearest nearest;
  manager.distance(crowd.objects[0], &nearest);
  EXPECT_LT(nearest.calls, 200);
}

}  // namespace
}  // namespace boxstream
