// SPDX-License-Identifier: MIT
#include "simulation/run/pair_check.hpp"

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/sorted_sweep.hpp"
#include "formats/scene_model/names.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {
namespace {

const btBroadphaseProxy& proxy_of(const Simulation& simulation, std::uint32_t index) {
  return *simulation.objects()[index]->getBroadphaseHandle();
}

bool is_in_world(const Simulation& simulation, std::uint32_t index) {
  return simulation.objects()[index]->getBroadphaseHandle() != nullptr;
}

Aabb64 box_of(const btBroadphaseProxy& proxy) {
  Aabb64 box;
  for (int d = 0; d < 3; ++d) box.min[d] = proxy.m_aabbMin[d], box.max[d] = proxy.m_aabbMax[d];
  return box;
}

/// How far contacts of an object may reach beyond its box, if its size was taken a little while ago.
double reach_of(const btCollisionObject& object) {
  const double disc = double{object.getCollisionShape()->getAngularMotionDisc()};
  const double missing = double{gContactBreakingThreshold} * (disc / 2 - 1);
  return std::clamp(missing * 1.05 + 0.001, 0.0, double{gDbvtMargin});
}

bool are_within_reach(const Simulation& simulation, Pair pair) {
  const Aabb64 a = box_of(proxy_of(simulation, pair.a)), b = box_of(proxy_of(simulation, pair.b));
  const double reach = reach_of(*simulation.objects()[pair.a]) + reach_of(*simulation.objects()[pair.b]);
  for (int d = 0; d < 3; ++d)
    if (std::max(a.min[d] - b.max[d], b.min[d] - a.max[d]) > reach) return false;
  return true;
}

/// Without the pairs that may be held though their boxes do not touch.
std::vector<Pair> without_extra(const Simulation& simulation, std::vector<Pair> held) {
  const Extra extra = extra_pairs(simulation.broadphase_name());
  if (extra == Extra::none) return held;
  if (extra == Extra::any) return overlapping_only(simulation, held);
  std::erase_if(held, [&](Pair pair) {
    return !overlaps(box_of(proxy_of(simulation, pair.a)), box_of(proxy_of(simulation, pair.b))) &&
           are_within_reach(simulation, pair);
  });
  return held;
}

bool filters_accept(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return (a.m_collisionFilterGroup & b.m_collisionFilterMask) != 0 &&
         (b.m_collisionFilterGroup & a.m_collisionFilterMask) != 0;
}

std::string describe(const Simulation& simulation, Pair pair) {
  std::string text = fmt::format("objects {} and {}", pair.a, pair.b);
  for (const std::uint32_t index : {pair.a, pair.b}) {
    const btBroadphaseProxy& p = proxy_of(simulation, index);
    text += fmt::format(", box of {}: [{} {} {}] to [{} {} {}]", index, p.m_aabbMin.x(), p.m_aabbMin.y(),
                        p.m_aabbMin.z(), p.m_aabbMax.x(), p.m_aabbMax.y(), p.m_aabbMax.z());
  }
  return text;
}

/// First difference between two sorted lists, or nothing.
std::string difference(const Simulation& simulation, const std::vector<Pair>& expected,
                       const std::vector<Pair>& found) {
  const auto first = first_difference(expected, found);
  if (!first) return {};
  return fmt::format("{} after {} steps: {} pairs, {} expected; first {}: {}", simulation.broadphase_name(),
                     simulation.steps_done(), found.size(), expected.size(), first->in_first ? "missing" : "extra",
                     describe(simulation, first->pair));
}

}  // namespace

void list_pairs(const btBroadphaseInterface& broadphase, std::vector<Pair>& out) {
  const btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
  const int count = cache.getNumOverlappingPairs();
  const btBroadphasePair* const pairs = count > 0 ? cache.getOverlappingPairArrayPtr() : nullptr;
  out.clear();
  out.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const auto index = [](const btBroadphaseProxy* proxy) {
      return static_cast<std::uint32_t>(static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
    };
    const std::uint32_t a = index(pairs[i].m_pProxy0), b = index(pairs[i].m_pProxy1);
    out.push_back(a < b ? Pair{a, b} : Pair{b, a});
  }
  std::sort(out.begin(), out.end());
}

std::uint64_t count_missing(const std::vector<Pair>& list, const std::vector<Pair>& other) {
  std::uint64_t count = 0;
  auto there = other.begin();
  for (const Pair& pair : list) {
    while (there != other.end() && *there < pair) ++there;
    if (there == other.end() || *there != pair) ++count;
  }
  return count;
}

std::vector<Pair> expected_pairs(const Simulation& simulation) {
  const auto count = static_cast<std::uint32_t>(simulation.objects().size());
  std::vector<Aabb64> boxes(count);
  std::vector<std::uint32_t> valid;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_in_world(simulation, i)) continue;
    boxes[i] = box_of(proxy_of(simulation, i));
    if (is_valid(boxes[i])) valid.push_back(i);
  }
  std::vector<Pair> pairs;
  sorted_sweep(
      valid, 0, [&](std::uint32_t i) -> const Aabb64& { return boxes[i]; },
      [&](Pair pair) {
        if (filters_accept(proxy_of(simulation, pair.a), proxy_of(simulation, pair.b))) pairs.push_back(pair);
      });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Pair> held_pairs(const Simulation& simulation) {
  std::vector<Pair> pairs;
  list_pairs(simulation.broadphase(), pairs);
  return pairs;
}

std::vector<Pair> overlapping_only(const Simulation& simulation, const std::vector<Pair>& pairs) {
  std::vector<Pair> kept;
  for (const Pair pair : pairs)
    if (overlaps(box_of(proxy_of(simulation, pair.a)), box_of(proxy_of(simulation, pair.b)))) kept.push_back(pair);
  return kept;
}

std::string check_pairs(const Simulation& simulation) {
  // A pair listed twice shows as a difference, too: both lists are sorted and compared as they are.
  return difference(simulation, expected_pairs(simulation), without_extra(simulation, held_pairs(simulation)));
}

std::string check_ghosts(const Simulation& simulation) {
  const std::vector<Pair> expected = expected_pairs(simulation);
  const std::vector<btCollisionObject*>& objects = simulation.objects();
  for (std::uint32_t g = 0; g < objects.size(); ++g) {
    const btGhostObject* const ghost = btGhostObject::upcast(objects[g]);
    if (ghost == nullptr) continue;
    std::vector<Pair> found, wanted;
    for (int i = 0; i < ghost->getNumOverlappingObjects(); ++i) {
      const auto other = static_cast<std::uint32_t>(ghost->getOverlappingObject(i)->getUserIndex());
      if (other != g) found.push_back({std::min(g, other), std::max(g, other)});
    }
    for (const Pair pair : expected)
      if (pair.a == g || pair.b == g) wanted.push_back(pair);
    std::sort(found.begin(), found.end());
    const std::string text = difference(simulation, wanted, without_extra(simulation, std::move(found)));
    if (!text.empty()) return fmt::format("list of ghost {}: {}", g, text);
  }
  return {};
}

}  // namespace boxstream::scenes
