// SPDX-License-Identifier: MIT
// Random streams of calls, on boxstream and on btSimpleBroadphase side by side, with the oracle beside both (clause
// D5).
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

enum class What : int {
  create,
  move,
  move_far,
  move_bad,
  refilter,
  refresh,
  destroy,
  calculate,
  box_query,
  ray_query,
  clean_proxy,
  empty_reset
};

/// One call; indices wrap around the proxies that live when it is made.
struct Op {
  What what;
  int which;
  int x, y, z;
  int size;
};

void showValue(const Op& op, std::ostream& out) {
  constexpr const char* names[] = {"create",  "move",      "move_far",  "move_bad",  "refilter",    "refresh",
                                   "destroy", "calculate", "box_query", "ray_query", "clean_proxy", "empty_reset"};
  out << names[static_cast<int>(op.what)] << '(' << op.which << "; " << op.x << ' ' << op.y << ' ' << op.z << "; "
      << op.size << ')';
}

}  // namespace
}  // namespace boxstream::bullet_test

template <>
struct rc::Arbitrary<boxstream::bullet_test::Op> {
  static rc::Gen<boxstream::bullet_test::Op> arbitrary() {
    using boxstream::bullet_test::Op;
    using boxstream::bullet_test::What;
    const auto what = rc::gen::weightedElement<What>({{6, What::create},
                                                      {12, What::move},
                                                      {2, What::move_far},
                                                      {1, What::move_bad},
                                                      {2, What::refilter},
                                                      {1, What::refresh},
                                                      {2, What::destroy},
                                                      {5, What::calculate},
                                                      {3, What::box_query},
                                                      {3, What::ray_query},
                                                      {1, What::clean_proxy},
                                                      {1, What::empty_reset}});
    const auto coordinate = rc::gen::inRange(-5, 6);
    return rc::gen::build<Op>(rc::gen::set(&Op::what, what), rc::gen::set(&Op::which, rc::gen::inRange(0, 64)),
                              rc::gen::set(&Op::x, coordinate), rc::gen::set(&Op::y, coordinate),
                              rc::gen::set(&Op::z, coordinate), rc::gen::set(&Op::size, rc::gen::inRange(0, 7)));
  }
};

namespace boxstream::bullet_test {
namespace {

/// Boxes on a grid of halves, so that touching is common.
Box box_of(const Op& op) {
  return cube(btScalar(op.x), btScalar(op.y) / 2, btScalar(op.z) / 2, btScalar(op.size) / 4);
}

Box huge_box_of(const Op& op) {
  const btScalar big = op.size % 2 ? BT_LARGE_FLOAT : std::numeric_limits<btScalar>::infinity();
  Box box = box_of(op);
  for (int d = 0; d < 3; ++d) {
    if ((op.which >> d) % 2) box.lo[d] = -big;
    if ((op.which >> (3 + d)) % 2) box.hi[d] = big;
  }
  return box;
}

Box bad_box_of(const Op& op) {
  Box box = box_of(op);
  const int axis = op.size % 3;
  if (op.which % 2) {
    box.lo[axis] = std::numeric_limits<btScalar>::quiet_NaN();
  } else {
    box.lo[axis] = 3;
    box.hi[axis] = -3;
  }
  return box;
}

/// The two broad-phases, each behind an oracle, with the same proxies in the same order.
class SideBySide {
 public:
  explicit SideBySide(btOverlappingPairCache* cache) {
    subject_ = new Oracle(make_broadphase(Kind::subject, cache));
    simple_ = new Oracle(make_broadphase(Kind::simple));
    subject_rig_.broadphase.reset(subject_);
    simple_rig_.broadphase.reset(simple_);
  }

  void run(const std::vector<Op>& ops) {
    for (std::size_t i = 0; i < ops.size(); ++i) {
      std::ostringstream at;
      at << "op " << i << ": ";
      showValue(ops[i], at);
      apply(ops[i], at.str());
      validate(subject_->inner());
    }
    calculate("at the end");
    while (!live_.empty()) destroy(live_.size() / 2);
    RC_ASSERT(subject_rig_.pair_count() == 0);
  }

 private:
  struct Both {
    btBroadphaseProxy* subject;
    btBroadphaseProxy* simple;
  };

  void apply(const Op& op, const std::string& at) {
    const std::size_t chosen = live_.empty() ? 0 : static_cast<std::size_t>(op.which) % live_.size();
    if (op.what == What::create) return create(box_of(op), 1 << (op.size % 3), op.which % 8 ? -1 : op.which);
    if (op.what == What::calculate) return calculate(at);
    if (op.what == What::box_query) return box_query(op, at);
    if (op.what == What::ray_query) return ray_query(op, at);
    if (op.what == What::empty_reset && op.which % 8 == 0) return empty_and_reset(at);
    if (live_.empty()) return;
    switch (op.what) {
      case What::move:
        return move(chosen, box_of(op));
      case What::move_far:
        return move(chosen, huge_box_of(op));
      case What::move_bad:
        return break_box(chosen, op);
      case What::refilter:
        return refilter(chosen, op);
      case What::refresh:
        return refresh(chosen);
      case What::destroy:
        return destroy(chosen);
      case What::clean_proxy:
        return clean(chosen);
      default:
        return;
    }
  }

  void create(const Box& box, int group, int mask) {
    live_.push_back({subject_rig_.create(box, group, mask), simple_rig_.create(box, group, mask)});
  }

  void move(std::size_t i, const Box& box) {
    subject_rig_.move(live_[i].subject, box);
    simple_rig_.move(live_[i].simple, box);
  }

  /// For btSimpleBroadphase, to whose comparisons an inverted box can look as if it overlapped.
  static Box safe(const Box& box) {
    const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
    return is_valid_box(box.lo, box.hi) ? box : Box{btVector3(nan, nan, nan), btVector3(nan, nan, nan)};
  }

  void break_box(std::size_t i, const Op& op) {
    subject_rig_.move(live_[i].subject, bad_box_of(op));
    simple_rig_.move(live_[i].simple, safe(bad_box_of(op)));
  }

  /// Written in place, as users do. A pair that is held stays; others are decided afresh at the next calculate.
  void refilter(std::size_t i, const Op& op) {
    for (btBroadphaseProxy* proxy : {live_[i].subject, live_[i].simple}) {
      proxy->m_collisionFilterGroup = 1 << (op.x + 5) % 3;
      proxy->m_collisionFilterMask = op.y & 7;
    }
  }

  /// What btCollisionWorld::refreshBroadphaseProxy does.
  void refresh(std::size_t i) {
    btVector3 lo, hi;
    subject_->getAabb(live_[i].subject, lo, hi);
    const int group = live_[i].subject->m_collisionFilterGroup, mask = live_[i].subject->m_collisionFilterMask;
    subject_rig_.destroy(live_[i].subject);
    simple_rig_.destroy(live_[i].simple);
    live_[i] = {subject_rig_.create({lo, hi}, group, mask), simple_rig_.create(safe({lo, hi}), group, mask)};
  }

  void destroy(std::size_t i) {
    const btBroadphaseProxy* gone = live_[i].subject;
    const int uid = gone->m_uniqueId;
    subject_rig_.destroy(live_[i].subject);
    simple_rig_.destroy(live_[i].simple);
    live_.erase(live_.begin() + static_cast<std::ptrdiff_t>(i));
    for (const auto& [a, b] : subject_rig_.pairs()) RC_ASSERT(a != uid && b != uid);
  }

  void clean(std::size_t i) {
    const std::vector<UidPair> before = subject_rig_.pairs();
    subject_rig_.cache().cleanProxyFromPairs(live_[i].subject, &subject_rig_.dispatcher);
    RC_ASSERT(subject_rig_.pairs() == before);
  }

  void calculate(const std::string& at) {
    subject_rig_.calculate();
    simple_rig_.calculate();
    const testing::AssertionResult simple = simple_->check(Rule::exact), subject = subject_->check(Rule::exact);
    if (!simple) RC_FAIL(at + ": btSimpleBroadphase: " + simple.message());
    if (!subject) RC_FAIL(at + ": boxstream: " + subject.message());
    RC_ASSERT(subject_->expected() == simple_->expected());
    for (int i = 0; i < subject_rig_.pair_count(); ++i) {  // an algorithm, once given, stays with its pair
      btBroadphasePair& pair = subject_rig_.cache().getOverlappingPairArrayPtr()[i];
      if (!pair.m_algorithm) subject_rig_.plant(pair.m_pProxy0, pair.m_pProxy1);
    }
    const long alive = subject_rig_.dispatcher.allocated - subject_rig_.dispatcher.freed;
    RC_ASSERT(alive == subject_rig_.pair_count());
    if (external_order_) return;
    const std::vector<UidPair> order = subject_rig_.pairs();
    RC_ASSERT(std::is_sorted(order.begin(), order.end()));
  }

  void box_query(const Op& op, const std::string& at) {
    const Box box = op.which % 9 == 0 ? huge_box_of(op) : box_of(op);
    if (!is_valid_box(box.lo, box.hi)) return;
    if (subject_rig_.in_box(box) != sorted(subject_->expected_in_box(box.lo, box.hi)))
      RC_FAIL(at + ": aabbTest is not exact");
  }

  /// On the grid, rays often run along faces; no contract covers those cases, so boxes are shrunk and grown.
  void ray_query(const Op& op, const std::string& at) {
    const btVector3 from(btScalar(op.x) * 2, btScalar(op.y), btScalar(op.z));
    const btVector3 to(btScalar(op.which % 13) - 6, btScalar(op.which % 7) - 3, btScalar(op.size) - 3);
    if (from == to) return;
    const std::vector<const btBroadphaseProxy*> found = subject_rig_.on_ray(from, to);
    if (std::adjacent_find(found.begin(), found.end()) != found.end()) RC_FAIL(at + ": rayTest reports a proxy twice");
    for (const Both& both : live_) {
      btVector3 lo, hi;
      subject_->getAabb(both.subject, lo, hi);
      const bool hit = std::binary_search(found.begin(), found.end(), both.subject);
      const bool valid = is_valid_box(lo, hi);
      if (valid && !hit && meets(from, to, lo, hi, -1e-4)) RC_FAIL(at + ": rayTest misses a box");
      if (hit && !(valid && meets(from, to, lo, hi, 1e-4))) RC_FAIL(at + ": rayTest reports a distant box");
    }
  }

  static bool meets(const btVector3& from, const btVector3& to, const btVector3& lo, const btVector3& hi, double grow) {
    double enter = 0, leave = 1;
    for (int d = 0; d < 3; ++d) {
      const double l = static_cast<double>(lo[d]) - grow, h = static_cast<double>(hi[d]) + grow;
      if (l > h) return false;
      const double a = from[d], step = static_cast<double>(to[d]) - a;
      if (step == 0) {
        if (a < l || a > h) return false;
        continue;
      }
      enter = std::max(enter, std::min((l - a) / step, (h - a) / step));
      leave = std::min(leave, std::max((l - a) / step, (h - a) / step));
    }
    return enter <= leave;
  }

  void empty_and_reset(const std::string& at) {
    while (!live_.empty()) destroy(0);
    subject_->resetPool(&subject_rig_.dispatcher);
    create(cube(0, 0, 0), 1, -1);
    if (live_[0].subject->m_uniqueId != 1) RC_FAIL(at + ": unique ids do not start again");
  }

 public:
  bool external_order_ = false;

 private:
  Rig subject_rig_, simple_rig_;
  Oracle* subject_;
  Oracle* simple_;
  std::vector<Both> live_;
};

RC_GTEST_PROP(BulletRandomOperations, D5_OwnCacheEqualsSimpleAndTheOracle, (const std::vector<Op>& few)) {
  SideBySide run(nullptr);
  run.run(few);
}

RC_GTEST_PROP(BulletRandomOperations, D5_LongStreams, ()) {
  const auto ops = *rc::gen::container<std::vector<Op>>(400, rc::gen::arbitrary<Op>());
  SideBySide run(nullptr);
  run.run(ops);
}

RC_GTEST_PROP(BulletRandomOperations, D5_HashedCacheEqualsSimpleAndTheOracle, ()) {
  const auto ops = *rc::gen::container<std::vector<Op>>(200, rc::gen::arbitrary<Op>());
  btHashedOverlappingPairCache cache;
  SideBySide run(&cache);
  run.external_order_ = true;
  run.run(ops);
}

RC_GTEST_PROP(BulletRandomOperations, D5_SortedCacheEqualsSimpleAndTheOracle, ()) {
  const auto ops = *rc::gen::container<std::vector<Op>>(200, rc::gen::arbitrary<Op>());
  btSortedOverlappingPairCache cache;
  SideBySide run(&cache);
  run.external_order_ = true;
  run.run(ops);
}

}  // namespace
}  // namespace boxstream::bullet_test
