// SPDX-License-Identifier: MIT
#include "bullet_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

extern btScalar gDbvtMargin;

namespace boxstream::preload {
namespace {

struct Box {
  btVector3 min, max;
};

/// Accepts all pairs: what the program's filter says is asked when sets are compared.
struct AcceptAll : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }
} accept_all;

struct CollectBoxes : btBroadphaseAabbCallback {
  std::vector<btBroadphaseProxy*> found;
  bool process(const btBroadphaseProxy* proxy) override {
    found.push_back(const_cast<btBroadphaseProxy*>(proxy));
    return true;
  }
};

struct CollectRay : btBroadphaseRayCallback {
  explicit CollectRay(const btBroadphaseRayCallback& like) : btBroadphaseRayCallback(like) {}
  std::vector<btBroadphaseProxy*> found;
  bool process(const btBroadphaseProxy* proxy) override {
    found.push_back(const_cast<btBroadphaseProxy*>(proxy));
    return true;
  }
};

bool is_valid(const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] <= box.max[axis])) return false;
  }
  return true;
}

bool touch(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis])) return false;
  }
  return is_valid(a) && is_valid(b);
}

/// Whether the ray meets the box grown by `slack`, a share of the coordinates.
bool meets(const btBroadphaseRayCallback& ray, const btVector3& from, const Box& box, double slack) {
  double begin = 0;
  double end = ray.m_lambda_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = ray.m_rayDirectionInverse[axis];
    const double room =
        slack * (std::fabs(static_cast<double>(from[axis])) + std::fabs(static_cast<double>(box.min[axis])) +
                 std::fabs(static_cast<double>(box.max[axis])) + 1e-6);
    double near = (box.min[axis] - room - from[axis]) * inverse;
    double far = (box.max[axis] + room - from[axis]) * inverse;
    if (near > far) std::swap(near, far);
    begin = std::max(begin, near);
    end = std::min(end, far);
  }
  return begin <= end;
}

std::string text_of(const Box& box) {
  char text[256];
  constexpr int digits = std::is_same_v<btScalar, float> ? 9 : 17;
  std::snprintf(text, sizeof text, "[%.*g %.*g %.*g, %.*g %.*g %.*g]", digits, static_cast<double>(box.min[0]), digits,
                static_cast<double>(box.min[1]), digits, static_cast<double>(box.min[2]), digits,
                static_cast<double>(box.max[0]), digits, static_cast<double>(box.max[1]), digits,
                static_cast<double>(box.max[2]));
  return text;
}

Box box_of(const bullet::Broadphase& broadphase, btBroadphaseProxy* proxy) {
  Box box;
  broadphase.getAabb(proxy, box.min, box.max);
  return box;
}

std::string text_of(const bullet::Broadphase& broadphase, btBroadphaseProxy* proxy) {
  return "proxy " + std::to_string(proxy->m_uniqueId) + " " + text_of(box_of(broadphase, proxy));
}

using Pair = std::pair<btBroadphaseProxy*, btBroadphaseProxy*>;

Pair in_order(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  return a->m_uniqueId < b->m_uniqueId ? Pair{a, b} : Pair{b, a};
}

/// Sorted by ids, so that the difference that is printed first is the same in each run.
std::vector<Pair> sorted(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::pair(a.first->m_uniqueId, a.second->m_uniqueId) < std::pair(b.first->m_uniqueId, b.second->m_uniqueId);
  });
  return pairs;
}

std::vector<btBroadphaseProxy*> sorted(std::vector<btBroadphaseProxy*> proxies) {
  std::sort(proxies.begin(), proxies.end(), [](auto* a, auto* b) { return a->m_uniqueId < b->m_uniqueId; });
  return proxies;
}

/// Calls `only_a` and `only_b` for what one of two sorted lists has alone.
template <class T, class OnlyA, class OnlyB>
void compare(const std::vector<T>& a, const std::vector<T>& b, const OnlyA& only_a, const OnlyB& only_b) {
  const auto id = [](const T& x) {
    if constexpr (std::is_pointer_v<T>) {
      return std::pair(x->m_uniqueId, 0);
    } else {
      return std::pair(x.first->m_uniqueId, x.second->m_uniqueId);
    }
  };
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && id(*i) < id(*j))) {
      only_a(*i++);
    } else if (i == a.end() || id(*j) < id(*i)) {
      only_b(*j++);
    } else {
      ++i;
      ++j;
    }
  }
}

}  // namespace

BulletCheck::BulletCheck(const Front& front, btDbvtBroadphase& own, bullet::Broadphase& ours,
                         btHashedOverlappingPairCache& cache, btScalar margin)
    : front_(front), own_(own), ours_(ours), cache_(cache), margin_(margin, margin, margin), widest_margin_(margin_) {
  widest_margin_.setMax(btVector3(gDbvtMargin, gDbvtMargin, gDbvtMargin));
  cache_.setOverlapFilterCallback(&accept_all);
}

/// Calls Bullet's own function on the program's object, with the cache of this check in it.
template <class... Arguments>
Word BulletCheck::call_own(BulletMember member, const Arguments&... arguments) {
  const auto word = [](const auto& argument) {
    if constexpr (std::is_class_v<std::decay_t<decltype(argument)>>) {
      return reinterpret_cast<Word>(&argument);
    } else if constexpr (std::is_pointer_v<std::decay_t<decltype(argument)>>) {
      return reinterpret_cast<Word>(argument);
    } else {
      return static_cast<Word>(argument);
    }
  };
  btOverlappingPairCache* const before = own_.m_paircache;
  own_.m_paircache = &cache_;
  const Word result = front_.own(static_cast<unsigned>(member), {{reinterpret_cast<Word>(&own_), word(arguments)...}});
  own_.m_paircache = before;
  return result;
}

void BulletCheck::created(btBroadphaseProxy* proxy, int shape_type) {
  const Box box = box_of(ours_, proxy);
  auto* const own =
      reinterpret_cast<btBroadphaseProxy*>(call_own(BulletMember::create_proxy, box.min, box.max, shape_type,
                                                    proxy->m_clientObject, 1, -1, static_cast<btDispatcher*>(nullptr)));
  own_of_[proxy] = own;
  ours_of_[own] = proxy;
}

void BulletCheck::destroyed(btBroadphaseProxy* proxy) {
  btBroadphaseProxy* const own = own_of_[proxy];
  own_of_.erase(proxy);
  ours_of_.erase(own);
  call_own(BulletMember::destroy_proxy, own, static_cast<btDispatcher*>(nullptr));
}

void BulletCheck::moved(btBroadphaseProxy* proxy) {
  const Box box = box_of(ours_, proxy);
  // Bullet's tree is not made for boxes that are none; ours finds them by nothing.
  if (!is_valid(box)) return;
  call_own(BulletMember::set_aabb, own_of_[proxy], box.min, box.max, static_cast<btDispatcher*>(nullptr));
}

void BulletCheck::batch() {
  call_own(BulletMember::calculate_overlapping_pairs, static_cast<btDispatcher*>(nullptr));
  btOverlappingPairCache* const cache = ours_.getOverlappingPairCache();
  if (dynamic_cast<btNullPairCache*>(cache)) return;  // a broad-phase for queries alone
  const auto& theirs_array = cache_.getOverlappingPairArray();
  std::vector<Pair> theirs, ours;
  for (int i = 0; i < theirs_array.size(); ++i) {
    const Pair pair = in_order(ours_of_[theirs_array[i].m_pProxy0], ours_of_[theirs_array[i].m_pProxy1]);
    if (touch(box_of(ours_, pair.first), box_of(ours_, pair.second))) theirs.push_back(pair);
  }
  const auto& ours_array = cache->getOverlappingPairArray();
  for (int i = 0; i < ours_array.size(); ++i) {
    ours.push_back(in_order(ours_array[i].m_pProxy0, ours_array[i].m_pProxy1));
  }
  theirs = sorted(std::move(theirs));
  ours = sorted(std::move(ours));
  front_.tally->checked_batches.fetch_add(1);
  front_.tally->checked_pairs.fetch_add(ours.size());
  std::string first;
  const auto note = [&](const char* what, const Pair& pair) {
    if (!first.empty()) return;
    first = "batch " + std::to_string(front_.tally->checked_batches.load()) + ": " + what + ": " +
            text_of(ours_, pair.first) + ", " + text_of(ours_, pair.second);
  };
  compare(
      theirs, ours,
      [&](const Pair& pair) {
        if (cache->needsBroadphaseCollision(pair.first, pair.second)) note("boxstream lacks a pair that touches", pair);
      },
      [&](const Pair& pair) {
        // Pairs within a margin are asked for; Bullet's may have them or not.
        Box grown = box_of(ours_, pair.first);
        grown.min -= 2 * widest_margin_;
        grown.max += 2 * widest_margin_;
        const Box other = box_of(ours_, pair.second);
        if (!touch(grown, other))
          note("boxstream has a pair that does not touch", pair);
        else if (touch(box_of(ours_, pair.first), other))
          note("btDbvtBroadphase lacks a pair", pair);
      });
  if (first.empty()) return;
  front_.tally->differing_batches.fetch_add(1);
  note_difference(first.c_str());
}

void BulletCheck::ray(const btVector3& from, const btVector3& to, const btBroadphaseRayCallback& callback,
                      const btVector3& min, const btVector3& max) {
  const std::lock_guard lock(asking_);
  CollectRay theirs(callback), ours(callback);
  call_own(BulletMember::ray_test, from, to, static_cast<btBroadphaseRayCallback*>(&theirs), min, max);
  ours_.rayTest(from, to, ours, min, max);
  front_.tally->checked_queries.fetch_add(1);
  // A ray that passes within rounding of a box is no difference.
  constexpr double rounding = std::is_same_v<btScalar, float> ? 1e-5 : 1e-12;
  std::string first;
  bool grazes = false;
  const auto note = [&](const char* what, btBroadphaseProxy* proxy, bool is_right) {
    Box box = box_of(ours_, proxy);
    const btVector3& margin = is_right ? margin_ : widest_margin_;
    box.min -= max + margin;
    box.max -= min - margin;
    const bool surely = meets(callback, from, box, -rounding);
    const bool perhaps = meets(callback, from, box, rounding);
    if (surely != perhaps) grazes = true;
    if (is_right ? !surely : perhaps) return;
    if (first.empty()) first = std::string("ray: ") + what + " " + text_of(ours_, proxy);
  };
  compare(
      sorted(as_ours(theirs.found)), sorted(ours.found),
      [&](btBroadphaseProxy* proxy) { note("boxstream misses", proxy, true); },
      [&](btBroadphaseProxy* proxy) { note("boxstream reports, and the ray does not meet,", proxy, false); });
  if (grazes) front_.tally->grazing_rays.fetch_add(1);
  if (first.empty()) return;
  front_.tally->differing_queries.fetch_add(1);
  note_difference(first.c_str());
}

void BulletCheck::box(const btVector3& min, const btVector3& max) {
  const std::lock_guard lock(asking_);
  CollectBoxes theirs, ours;
  call_own(BulletMember::aabb_test, min, max, static_cast<btBroadphaseAabbCallback*>(&theirs));
  ours_.aabbTest(min, max, ours);
  front_.tally->checked_queries.fetch_add(1);
  const Box asked{min - margin_, max + margin_};
  std::string first;
  const auto note = [&](const char* what, btBroadphaseProxy* proxy) {
    if (first.empty()) first = "box " + text_of(asked) + ": " + what + " " + text_of(ours_, proxy);
  };
  compare(
      sorted(as_ours(theirs.found)), sorted(ours.found),
      [&](btBroadphaseProxy* proxy) {
        if (touch(asked, box_of(ours_, proxy))) note("boxstream misses", proxy);
      },
      [&](btBroadphaseProxy* proxy) {
        if (!touch(asked, box_of(ours_, proxy))) note("boxstream reports, and it does not touch,", proxy);
      });
  if (first.empty()) return;
  front_.tally->differing_queries.fetch_add(1);
  note_difference(first.c_str());
}

BulletCheck::Proxies BulletCheck::as_ours(const Proxies& own) const {
  Proxies proxies;
  for (btBroadphaseProxy* proxy : own) proxies.push_back(ours_of_.at(proxy));
  return proxies;
}

void BulletCheck::note_difference(const char* text) {
  char* const first = front_.tally->first_difference;
  if (!first[0]) std::snprintf(first, sizeof front_.tally->first_difference, "%s", text);
}

}  // namespace boxstream::preload
