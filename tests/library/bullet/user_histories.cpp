// SPDX-License-Identifier: MIT
// Random histories with filters that refuse and change, and with pairs that users add and remove: on boxstream and on
// btSimpleBroadphase side by side, which asks about every overlapping pair that it does not hold, at each calculate.
#include <boxstream/bullet.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

enum class Cache { own, hashed };

std::ostream& operator<<(std::ostream& out, Cache cache) {
  return out << (cache == Cache::own ? "own" : "hashed");
}

/// Refuses some pairs by their groups; which ones depends on `state`.
struct ChangingFilter : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    return (a->m_collisionFilterGroup + b->m_collisionFilterGroup + state) % 3 != 0;
  }
  int state = 0;
};

class Histories {
 public:
  Histories(Cache cache, boxstream::bullet::Eager eager, std::uint64_t start) : random_(start) {
    boxstream::bullet::Options options;
    options.eager = eager;
    options.exact_boxes = true;
    subject_ = new boxstream::bullet::Broadphase(cache == Cache::hashed ? &hashed_ : nullptr, options);
    ours_.broadphase.reset(subject_);
  }
  ~Histories() {
    both([](Rig& rig) { rig.cache().setOverlapFilterCallback(nullptr); });
  }

  void run(int calls) {
    for (int call = 0; call < calls && !testing::Test::HasFailure(); ++call) {
      SCOPED_TRACE("call " + std::to_string(call));
      step();
      subject_->validate();
    }
  }
  int most_pairs() const { return most_pairs_; }
  int refusals() const { return refusals_; }

 private:
  struct Both {
    btBroadphaseProxy* ours;
    btBroadphaseProxy* theirs;
  };

  template <class Do>
  void both(Do&& act) {
    act(ours_);
    act(theirs_);
  }

  Box some_box() {
    const btVector3 p = random_.vector(-3, 3);
    return cube(p.x(), p.y(), p.z(), random_.real(btScalar(0.2), 1));
  }
  std::size_t some() { return static_cast<std::size_t>(random_.below(static_cast<int>(live_.size()))); }

  void step() {
    const int what = random_.below(24);
    if (live_.size() < 2 || what < 2)
      create();
    else if (what < 9)
      move();
    else if (what == 9 && live_.size() > 30)
      destroy();
    else if (what < 14)
      add_pair();
    else if (what < 18)
      remove_pair();
    else if (what < 22)
      calculate();
    else
      change_filters();
  }

  void create() {
    const Box box = some_box();
    const int group = 1 + random_.below(3), mask = random_.below(8);
    live_.push_back({ours_.create(box, group, mask), theirs_.create(box, group, mask)});
  }

  void move() {
    const Both& proxy = live_[some()];
    const Box box = some_box();
    ours_.move(proxy.ours, box);
    theirs_.move(proxy.theirs, box);
  }

  void destroy() {
    const std::size_t i = some();
    ours_.destroy(live_[i].ours);
    theirs_.destroy(live_[i].theirs);
    live_.erase(live_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  void add_pair() {
    const std::size_t i = some(), j = some();
    if (i == j) return;
    const bool ours = ours_.cache().addOverlappingPair(live_[i].ours, live_[j].ours) != nullptr;
    EXPECT_EQ(theirs_.cache().addOverlappingPair(live_[i].theirs, live_[j].theirs) != nullptr, ours);
  }

  /// One that is held, or one that is not.
  void remove_pair() {
    std::size_t i = some(), j = some();
    if (ours_.pair_count() > 0 && random_.below(4) != 0) {
      const btBroadphasePair& pair = ours_.cache().getOverlappingPairArrayPtr()[random_.below(ours_.pair_count())];
      i = number_of(pair.m_pProxy0);
      j = number_of(pair.m_pProxy1);
    }
    if (i == j) return;
    ours_.cache().removeOverlappingPair(live_[i].ours, live_[j].ours, &ours_.dispatcher);
    theirs_.cache().removeOverlappingPair(live_[i].theirs, live_[j].theirs, &theirs_.dispatcher);
  }

  /// Between two batches, because a pair that has begun early stays whatever filters say later.
  void change_filters() {
    calculate();
    switch (random_.below(4)) {
      case 0: {  // written in place
        const Both& proxy = live_[some()];
        const int group = 1 + random_.below(3), mask = random_.below(8);
        for (btBroadphaseProxy* each : {proxy.ours, proxy.theirs}) {
          each->m_collisionFilterGroup = group;
          each->m_collisionFilterMask = mask;
        }
        break;
      }
      case 1:
        both([&](Rig& rig) { rig.cache().setOverlapFilterCallback(&filter_); });
        break;
      case 2:
        both([](Rig& rig) { rig.cache().setOverlapFilterCallback(nullptr); });
        break;
      default:
        ++filter_.state;
        subject_->refilter();
    }
    calculate();
  }

  void calculate() {
    both([](Rig& rig) { rig.calculate(); });
    const std::vector<UidPair> ours = pairs(ours_);
    EXPECT_EQ(ours, pairs(theirs_));
    most_pairs_ = std::max(most_pairs_, static_cast<int>(ours.size()));
    for (std::size_t i = 0; i < live_.size(); ++i)
      refusals_ += !ours_.cache().needsBroadphaseCollision(live_[i].ours, live_[0].ours);
  }

  std::size_t number_of(const btBroadphaseProxy* proxy) const {
    const auto at =
        std::find_if(live_.begin(), live_.end(), [&](const Both& b) { return b.ours == proxy || b.theirs == proxy; });
    return static_cast<std::size_t>(at - live_.begin());
  }

  /// By the numbers of their proxies.
  std::vector<UidPair> pairs(Rig& rig) {
    std::vector<UidPair> found;
    const btBroadphasePairArray& array = rig.cache().getOverlappingPairArray();
    for (int i = 0; i < array.size(); ++i)
      found.push_back(std::minmax(static_cast<int>(number_of(array[i].m_pProxy0)),
                                  static_cast<int>(number_of(array[i].m_pProxy1))));
    return sorted(found);
  }

  Random random_;
  ChangingFilter filter_;
  btHashedOverlappingPairCache hashed_;
  Rig ours_, theirs_{Kind::simple};
  boxstream::bullet::Broadphase* subject_;
  std::vector<Both> live_;
  int most_pairs_ = 0;
  int refusals_ = 0;
};

class BulletUserHistories : public testing::TestWithParam<std::tuple<Cache, boxstream::bullet::Eager>> {};

TEST_P(BulletUserHistories, EqualSimple) {
  const auto [cache, eager] = GetParam();
  int most_pairs = 0, refusals = 0;
  for (std::uint64_t start = 1; start <= 40 && !HasFailure(); ++start) {
    SCOPED_TRACE("start " + std::to_string(start));
    Histories histories(cache, eager, start);
    histories.run(600);
    most_pairs = std::max(most_pairs, histories.most_pairs());
    refusals += histories.refusals();
  }
  EXPECT_GT(most_pairs, 50);
  EXPECT_GT(refusals, 1000);
}

INSTANTIATE_TEST_SUITE_P(, BulletUserHistories,
                         testing::Combine(testing::Values(Cache::own, Cache::hashed),
                                          testing::Values(boxstream::bullet::Eager::none,
                                                          boxstream::bullet::Eager::all)));

/// What a filter was asked by a frame in which nothing moves but a bystander.
class BulletRefusals : public testing::TestWithParam<Cache> {
 protected:
  BulletRefusals() : rig_(Kind::subject, GetParam() == Cache::hashed ? &hashed_ : nullptr) {
    rig_.cache().setOverlapFilterCallback(&filter_);
    a_ = rig_.create(cube(0, 0, 0));
    b_ = rig_.create(cube(0, 0, 0));
    bystander_ = rig_.create(cube(9, 0, 0));
  }
  ~BulletRefusals() override { rig_.cache().setOverlapFilterCallback(nullptr); }

  long questions() {
    const long before = filter_.calls;
    rig_.move(bystander_, cube(9, btScalar(++frame_) / 4, 0));
    rig_.calculate();
    return filter_.calls - before;
  }

  bool answer_ = false;
  FunctionFilter filter_{[this](auto, auto) { return answer_; }};
  btHashedOverlappingPairCache hashed_;
  Rig rig_;
  btBroadphaseProxy *a_, *b_, *bystander_;
  int frame_ = 0;
};

TEST_P(BulletRefusals, P8_AreAskedAboutAgainOnlyAfterAChange) {
  EXPECT_EQ(questions(), 1);
  EXPECT_EQ(questions(), 0);
  rig_.move(a_, cube(0, 0, 0));
  EXPECT_EQ(questions(), 0) << "the same box";
  rig_.move(a_, cube(0, btScalar(0.1), 0));
  EXPECT_EQ(questions(), 1);
  b_->m_collisionFilterMask = 6;
  EXPECT_EQ(questions(), 1);
  a_->m_collisionFilterGroup = 2;
  EXPECT_EQ(questions(), 1);
  EXPECT_EQ(questions(), 0);
  FunctionFilter other([](auto, auto) { return false; });
  rig_.cache().setOverlapFilterCallback(&other);
  rig_.calculate();
  EXPECT_EQ(other.calls, 1);
  rig_.cache().setOverlapFilterCallback(&filter_);
  EXPECT_EQ(questions(), 1);
  EXPECT_EQ(questions(), 0);
  rig_.cache().setOverlapFilterCallback(&filter_);
  EXPECT_EQ(questions(), GetParam() == Cache::own ? 1 : 0) << "a borrowed cache does not tell";
  dynamic_cast<boxstream::bullet::Broadphase&>(*rig_.broadphase).refilter();
  EXPECT_EQ(questions(), 1);
  EXPECT_EQ(questions(), 0);
  EXPECT_EQ(rig_.pair_count(), 0);
  answer_ = true;
  EXPECT_EQ(questions(), 0);
  dynamic_cast<boxstream::bullet::Broadphase&>(*rig_.broadphase).refilter();
  questions();
  EXPECT_TRUE(rig_.holds(a_, b_));
  EXPECT_EQ(questions(), 0);
}

TEST_P(BulletRefusals, P8_APairThatAUserAddsIsDecidedAboutAnew) {
  EXPECT_EQ(questions(), 1);
  answer_ = true;
  EXPECT_NE(rig_.cache().addOverlappingPair(a_, b_), nullptr);
  questions();
  EXPECT_TRUE(rig_.holds(a_, b_));
  EXPECT_EQ(questions(), 0);
  rig_.move(a_, cube(0, 5, 0));
  rig_.calculate();
  EXPECT_EQ(rig_.pair_count(), 0) << "it ends like any other";
}

/// As many proxies in a row as there are refused pairs, nearly: none is asked about in a frame in which one moves.
TEST_P(BulletRefusals, P8_DoNotCostAFrame) {
  for (int i = 0; i < 500; ++i) rig_.create(cube(btScalar(20 + i), 0, 0, btScalar(0.6)));
  EXPECT_EQ(questions(), 500);
  for (int frame = 0; frame < 20; ++frame) ASSERT_EQ(questions(), 0);
}

/// The new proxy is where the old one was, and the user's pair where the old one's was.
TEST(BulletUserChanges, PairsOfAnAddressThatIsUsedAgainAreOthers) {
  btHashedOverlappingPairCache cache;
  Rig rig(Kind::subject, &cache);
  btBroadphaseProxy* const a = rig.create(cube(0, 0, 0));
  const btBroadphaseProxy* const old = rig.create(cube(0, 0, 0));
  rig.calculate();
  ASSERT_EQ(rig.pair_count(), 1);
  rig.destroy(const_cast<btBroadphaseProxy*>(old));
  btBroadphaseProxy* const far = rig.create(cube(50, 0, 0));
  ASSERT_EQ(far, old) << "nothing is tested otherwise";
  rig.cache().addOverlappingPair(a, far);
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 0) << "boxes do not overlap";
}

INSTANTIATE_TEST_SUITE_P(, BulletRefusals, testing::Values(Cache::own, Cache::hashed));

}  // namespace
}  // namespace boxstream::bullet_test
