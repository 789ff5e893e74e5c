// SPDX-License-Identifier: MIT
// Clause P9 where many ask for their pairs in each move: random histories, beside all pairs of boxes.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

using boxstream::bullet::Eager;

enum class Cache { own, hashed };
enum class Motion { creep, fly, jump };

class EagerWorld {
 public:
  EagerWorld(Cache cache, Eager eager, Motion motion, btScalar margin, std::uint64_t start)
      : eager_(eager),
        motion_(motion),
        margin_(margin),
        are_refused_(start % 2 == 0),
        only_ghosts_move_(start % 4 >= 2),
        random_(start) {
    boxstream::bullet::Options options;
    options.eager = eager;
    options.margin = margin;
    options.exact_boxes = true;
    subject_ = new boxstream::bullet::Broadphase(cache == Cache::hashed ? &hashed_ : nullptr, options);
    rig_.broadphase.reset(subject_);
    rig_.cache().setInternalGhostPairCallback(&ghost_callback_);
    if (start % 4 >= 1) rig_.cache().setOverlapFilterCallback(&filter_);
  }
  ~EagerWorld() {
    while (!things_.empty()) destroy(things_.size() - 1);
    rig_.cache().setInternalGhostPairCallback(nullptr);
    rig_.cache().setOverlapFilterCallback(nullptr);
  }

  void run(int things, int steps) {
    while (int(things_.size()) < things) create();
    for (int step = 0; step < steps && !testing::Test::HasFailure(); ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      const int moves = random_.below(3) == 0 ? 1 : 3 * things;
      for (int i = 0; i < moves && !testing::Test::HasFailure(); ++i) change();
      calculate();
    }
  }

 private:
  struct Thing {
    std::unique_ptr<btCollisionObject> object;
    btBroadphaseProxy* proxy = nullptr;
    btVector3 at, velocity;
    bool is_ghost = false;
  };

  void change() {
    if (const int what = random_.below(200); what >= 5 || things_.size() < 3)
      return move(some());
    else if (what == 0)
      create();
    else if (what == 1 && things_.size() > 20)
      destroy(some());
    else if (what == 2)
      set(some(), strange_box());
    else if (what == 3)
      remove_a_pair();
    else if (random_.below(20) == 0)
      subject_->shrink_to_fit();
  }
  std::size_t some() { return std::size_t(random_.below(int(things_.size()))); }

  void create() {
    Thing& thing = things_.emplace_back();
    thing.is_ghost = random_.below(2) == 0;
    thing.object =
        thing.is_ghost ? std::make_unique<btPairCachingGhostObject>() : std::make_unique<btCollisionObject>();
    thing.at = random_.vector(-3, 3);
    const btScalar pace = motion_ == Motion::creep ? btScalar(0.003) : btScalar(0.05);
    thing.velocity = random_.vector(-pace, pace);
    const Box box = random_.below(40) == 0 ? strange_box() : cube(thing.at.x(), thing.at.y(), thing.at.z());
    const int group = are_refused_ ? 1 << random_.below(3) : 1, mask = are_refused_ && random_.below(6) == 0 ? 3 : -1;
    thing.proxy = rig_.create_for(thing.object.get(), box, group, mask);
    check(thing);
  }
  void destroy(std::size_t i) {
    rig_.destroy(things_[i].proxy);
    if (const auto* const ghost = btGhostObject::upcast(things_[i].object.get())) {
      EXPECT_EQ(ghost->getNumOverlappingObjects(), 0);
    }
    std::swap(things_[i], things_.back());
    things_.pop_back();
  }
  void move(std::size_t i) {
    Thing& thing = things_[i];
    if (only_ghosts_move_ && !thing.is_ghost) return;
    if (motion_ == Motion::jump) thing.at = random_.vector(-3, 3);
    thing.at += thing.velocity;
    if (thing.at.length() > 5) thing.velocity = -thing.velocity;
    if (random_.below(12) == 0) set(i, cube(20, thing.at.y(), thing.at.z()));  // and back
    set(i, cube(thing.at.x(), thing.at.y(), thing.at.z(), random_.below(2) == 0 ? btScalar(0.5) : btScalar(0.48)));
  }
  void set(std::size_t i, const Box& box) {
    rig_.move(things_[i].proxy, box);
    check(things_[i]);
  }
  Box strange_box() {
    const btScalar inf = std::numeric_limits<btScalar>::infinity(), nan = std::numeric_limits<btScalar>::quiet_NaN();
    switch (random_.below(5)) {
      case 0:
        return {btVector3(-inf, -inf, -inf), btVector3(inf, inf, random_.real(-1, 1))};
      case 1:
        return {btVector3(-1, nan, -1), btVector3(1, 1, 1)};
      case 2:
        return {btVector3(3, 3, 3), btVector3(-3, -3, -3)};
      case 3:
        return {btVector3(-3, -3, 0), btVector3(3, 3, 0)};
      default:
        return {btVector3(-BT_LARGE_FLOAT, -1, -1), btVector3(BT_LARGE_FLOAT, 1, 1)};
    }
  }
  void remove_a_pair() {
    if (rig_.pair_count() == 0) return;
    const btBroadphasePair pair = rig_.cache().getOverlappingPairArray()[random_.below(rig_.pair_count())];
    removed_.insert(std::minmax(pair.m_pProxy0->m_uniqueId, pair.m_pProxy1->m_uniqueId));
    rig_.cache().removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, &rig_.dispatcher);
  }

  static bool is_accepted(const btBroadphaseProxy& x, const btBroadphaseProxy& y) {
    return (x.m_collisionFilterGroup & y.m_collisionFilterMask) != 0 &&
           (y.m_collisionFilterGroup & x.m_collisionFilterMask) != 0;
  }
  /// The same and more, by the filter, which looks for what it is asked about.
  bool is_accepted_by_filter(btBroadphaseProxy* a, btBroadphaseProxy* b) {
    if (!is_accepted(*a, *b) || (a->m_uniqueId + b->m_uniqueId) % 5 == 0) return false;
    if (random_.below(10) == 0) {
      for (const btBroadphaseProxy* one : {a, b}) {
        const auto found = rig_.in_box({one->m_aabbMin, one->m_aabbMax});
        EXPECT_NE(std::find(found.begin(), found.end(), one), found.end());
      }
    }
    return true;
  }

  bool ought_to_pair(const Thing& a, const Thing& b) {
    const btBroadphaseProxy &x = *a.proxy, &y = *b.proxy;
    const btVector3 grown(margin_, margin_, margin_);
    return is_valid_box(x.m_aabbMin, x.m_aabbMax) && is_valid_box(y.m_aabbMin, y.m_aabbMax) &&
           boxes_overlap(x.m_aabbMin - grown, x.m_aabbMax + grown, y.m_aabbMin - grown, y.m_aabbMax + grown) &&
           is_accepted(x, y) &&
           (rig_.cache().getOverlapFilterCallback() == nullptr || (x.m_uniqueId + y.m_uniqueId) % 5 != 0);
  }
  /// What one that is eager touches is held at once, unless a user has removed it, and told to ghosts.
  void check(const Thing& moved) {
    if (eager_ == Eager::ghosts && !moved.is_ghost) return;
    if (random_.below(8) != 0) return;
    for (const Thing& other : things_)
      if (&other != &moved && ought_to_pair(moved, other)) {
        const UidPair pair = std::minmax(moved.proxy->m_uniqueId, other.proxy->m_uniqueId);
        ASSERT_TRUE(removed_.count(pair) != 0 || rig_.holds(moved.proxy, other.proxy)) << "missing after a move";
      }
  }
  void calculate() {
    rig_.calculate();
    removed_.clear();
    std::vector<UidPair> expected;
    for (std::size_t i = 0; i < things_.size(); ++i)
      for (std::size_t k = i + 1; k < things_.size(); ++k)
        if (ought_to_pair(things_[i], things_[k]))
          expected.push_back(std::minmax(things_[i].proxy->m_uniqueId, things_[k].proxy->m_uniqueId));
    ASSERT_EQ(sorted_pairs_of(*subject_), sorted(expected));
    ASSERT_NO_THROW(subject_->validate());
    for (const Thing& thing : things_)
      if (const auto* const ghost = btGhostObject::upcast(thing.object.get())) {
        const int id = thing.proxy->m_uniqueId;
        const auto pairs = std::count_if(expected.begin(), expected.end(),
                                         [&](const UidPair& pair) { return pair.first == id || pair.second == id; });
        ASSERT_EQ(ghost->getNumOverlappingObjects(), pairs);
      }
  }

  const Eager eager_;
  const Motion motion_;
  const btScalar margin_;
  const bool are_refused_, only_ghosts_move_;
  Random random_;
  btGhostPairCallback ghost_callback_;
  FunctionFilter filter_{[this](btBroadphaseProxy* a, btBroadphaseProxy* b) { return is_accepted_by_filter(a, b); }};
  btHashedOverlappingPairCache hashed_;
  Rig rig_;
  boxstream::bullet::Broadphase* subject_;
  std::vector<Thing> things_;
  std::set<UidPair> removed_;  // by a user, since the last batch
};

class BulletEagerWorlds : public testing::TestWithParam<std::tuple<Cache, Eager, Motion>> {};

TEST_P(BulletEagerWorlds, P9_PairsAreThereAfterEachMove) {
  const auto [cache, eager, motion] = GetParam();
  for (std::uint64_t start = 1; start <= 12 && !HasFailure(); ++start) {
    SCOPED_TRACE("start " + std::to_string(start));
    EagerWorld world(cache, eager, motion, start % 3 == 0 ? btScalar(0.05) : btScalar(0), start);
    world.run(start % 5 == 0 ? 120 : 40, 40);
  }
}

std::string name_of(const testing::TestParamInfo<BulletEagerWorlds::ParamType>& info) {
  const auto [cache, eager, motion] = info.param;
  return std::string(cache == Cache::own ? "Own" : "Hashed") + (eager == Eager::all ? "All" : "Ghosts") +
         (motion == Motion::creep ? "Creep"
          : motion == Motion::fly ? "Fly"
                                  : "Jump");
}

INSTANTIATE_TEST_SUITE_P(, BulletEagerWorlds,
                         testing::Combine(testing::Values(Cache::own, Cache::hashed),
                                          testing::Values(Eager::ghosts, Eager::all),
                                          testing::Values(Motion::creep, Motion::fly, Motion::jump)),
                         name_of);

/// So many neighbours that they are not kept.
TEST(BulletEagerCrowd, P9_ManyAtOnePlace) {
  boxstream::bullet::Options options;
  options.eager = Eager::all;
  boxstream::bullet::Broadphase subject(nullptr, options);
  constexpr int many = 300;
  std::vector<btBroadphaseProxy*> proxies;
  const btVector3 size(1, 1, 1);
  for (int i = 0; i < many; ++i)
    proxies.push_back(subject.createProxy(btVector3(0, 0, 0), size, 0, nullptr, 1, 1, nullptr));
  const auto& pairs = *subject.getOverlappingPairCache();
  for (int round = 0; round < 6; ++round) {
    for (int i = 0; i < many; ++i) {
      const btVector3 at(btScalar(0.001) * btScalar((i + round) % 7), 0, btScalar(round == 5 ? 2 * i : 0));
      subject.setAabb(proxies[std::size_t(i)], at, at + size, nullptr);
    }
    if (round < 5) {
      ASSERT_EQ(pairs.getNumOverlappingPairs(), many * (many - 1) / 2);
    }
    subject.calculateOverlappingPairs(nullptr);
    ASSERT_NO_THROW(subject.validate());
  }
  EXPECT_EQ(pairs.getNumOverlappingPairs(), 0);
  for (btBroadphaseProxy* proxy : proxies) subject.destroyProxy(proxy, nullptr);
}

}  // namespace
}  // namespace boxstream::bullet_test
