// SPDX-License-Identifier: MIT
// Pairs that the World is told of, by boxes that it does not have: they begin and end where others tremble.
#include <boxstream/bullet.hpp>

#include <vector>

#include "pile.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

/// A pile with few others, of which pairs are told to the World by boxes that it does not have.
class ToldPairs : public ::testing::Test {
 public:
  explicit ToldPairs(boxstream::bullet::Eager eager = boxstream::bullet::Eager::ghosts) : pile_(options(eager)) {}
  ~ToldPairs() override {
    for (btBroadphaseProxy* proxy : others_) pile_.broadphase.destroyProxy(proxy, nullptr);
    pile_.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(nullptr);
  }

 protected:
  btBroadphaseProxy* make(btScalar x, btScalar y = 0) {
    const Box box = cube(x, y, 0);
    others_.push_back(
        pile_.broadphase.createProxy(box.lo, box.hi, BOX_SHAPE_PROXYTYPE, nullptr, 1, -1, &rig_.dispatcher));
    return others_.back();
  }
  void set(btBroadphaseProxy* proxy, btScalar x, btScalar y = 0) {
    const Box box = cube(x, y, 0);
    pile_.broadphase.setAabb(proxy, box.lo, box.hi, nullptr);
  }
  bool holds(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
    return find_in_array(pile_.broadphase, a, b) != nullptr;
  }
  btOverlappingPairCache& cache() { return *pile_.broadphase.getOverlappingPairCache(); }

  Rig rig_;
  Pile pile_;
  std::vector<btBroadphaseProxy*> others_;

 private:
  static bullet::Options options(boxstream::bullet::Eager eager) {
    bullet::Options options;
    options.eager = eager;
    return options;
  }
};

class EagerToldPairs : public ToldPairs {
 public:
  EagerToldPairs() : ToldPairs(boxstream::bullet::Eager::all) {}
};

TEST_F(ToldPairs, BeginAgainWhereABoxGoesBack) {
  btBroadphaseProxy *const still = make(50), *const mover = make(btScalar(50.5));
  pile_.settle();
  set(mover, 80);
  pile_.calculate();
  EXPECT_FALSE(holds(still, mover));
  set(mover, btScalar(50.5));
  make(200);
  pile_.calculate();
  EXPECT_TRUE(holds(still, mover));
  pile_.broadphase.validate();
}

TEST_F(ToldPairs, EndAgainWhereABoxGoesBack) {
  btBroadphaseProxy *const still = make(50), *const mover = make(80);
  pile_.settle();
  set(mover, btScalar(50.5));
  pile_.calculate();
  EXPECT_TRUE(holds(still, mover));
  set(mover, 80);
  make(200);
  pile_.calculate();
  EXPECT_FALSE(holds(still, mover));
  pile_.broadphase.validate();
}

TEST_F(EagerToldPairs, BeginWhereAnotherOneIsRefused) {
  btBroadphaseProxy *refused = nullptr, *mover = nullptr;
  FunctionFilter filter([&](btBroadphaseProxy* a, btBroadphaseProxy* b) {
    return !((a == refused && b == mover) || (a == mover && b == refused));
  });
  cache().setOverlapFilterCallback(&filter);
  btBroadphaseProxy* const still = make(50);
  refused = make(50, btScalar(1.6));
  mover = make(70);
  pile_.settle();
  set(mover, 50, btScalar(0.8));
  EXPECT_TRUE(holds(mover, still));
  EXPECT_FALSE(holds(mover, refused));
  pile_.broadphase.validate();
  pile_.calculate();
  EXPECT_TRUE(holds(mover, still));
  pile_.broadphase.validate();
}

TEST_F(EagerToldPairs, BeginWithOneThatWentOutAndCameBack) {
  btBroadphaseProxy *const back = make(60), *const mover = make(60, 5);
  pile_.settle();
  set(back, 90);
  set(back, 60, btScalar(0.001));
  set(mover, 60, btScalar(0.5));
  EXPECT_TRUE(holds(back, mover));
  pile_.calculate();
  EXPECT_TRUE(holds(back, mover));
  pile_.broadphase.validate();
}

/// One leaves its room and comes so near to another that this touches it without leaving its own.
TEST_F(EagerToldPairs, BeginWithOneThatLeftItsRoom) {
  for (int step = 0; step < 12; ++step) {
    btBroadphaseProxy *const one = make(60), *const other = make(63);
    pile_.settle();
    const btScalar to = btScalar(61.95) + btScalar(step) / 200;
    set(one, to);
    set(other, to + btScalar(0.99));
    const bool touch = boxes_overlap(one->m_aabbMin, one->m_aabbMax, other->m_aabbMin, other->m_aabbMax);
    EXPECT_TRUE(touch);
    EXPECT_EQ(holds(one, other), touch) << step;
    pile_.calculate();
    EXPECT_EQ(holds(one, other), touch) << step;
    pile_.broadphase.validate();
    set(one, btScalar(1000 + 10 * step));
    set(other, btScalar(2000 + 10 * step));
  }
}

/// A filter that asks what is where a box has come to finds that box.
TEST_F(EagerToldPairs, FiltersFindBoxesAsTheyAre) {
  for (const bool of_pile : {true, false}) {
    btBroadphaseProxy *const still = make(of_pile ? 50 : 52), *const mover = make(of_pile ? 70 : 72);
    if (of_pile) {
      pile_.settle();
    } else {
      for (int round = 0; round < 60; ++round) pile_.tremble(btScalar(0.3));  // neighbours are kept without rooms
    }
    int asked = 0, found = 0;
    FunctionFilter filter([&](btBroadphaseProxy* a, btBroadphaseProxy* b) {
      if (a != mover && b != mover) return true;
      ++asked;
      struct Finder : btBroadphaseAabbCallback {
        bool process(const btBroadphaseProxy* proxy) override {
          has_found = has_found || proxy == wanted;
          return true;
        }
        const btBroadphaseProxy* wanted = nullptr;
        bool has_found = false;
      } finder;
      finder.wanted = mover;
      pile_.broadphase.aabbTest(mover->m_aabbMin, mover->m_aabbMax, finder);
      found += finder.has_found ? 1 : 0;
      return true;
    });
    cache().setOverlapFilterCallback(&filter);
    pile_.calculate();
    set(mover, of_pile ? btScalar(50.5) : btScalar(52.5));
    EXPECT_TRUE(holds(still, mover));
    EXPECT_GT(asked, 0);
    EXPECT_EQ(found, asked);
    pile_.calculate();
    pile_.broadphase.validate();
    cache().setOverlapFilterCallback(nullptr);
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
