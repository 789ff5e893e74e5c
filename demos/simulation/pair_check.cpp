// SPDX-License-Identifier: MIT
#include "simulation/pair_check.hpp"

#include <algorithm>

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <fmt/format.h>

#include "simulation/pair_list.hpp"
#include "simulation/simulation.hpp"

namespace boxstream::scenes {
namespace {

const btBroadphaseProxy& proxy_of(const Simulation& simulation, std::uint32_t index) {
  return *simulation.objects()[index]->getBroadphaseHandle();
}

bool is_in_world(const Simulation& simulation, std::uint32_t index) {
  return simulation.objects()[index]->getBroadphaseHandle() != nullptr;
}

bool boxes_overlap(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  for (int d = 0; d < 3; ++d)
    if (!(a.m_aabbMin[d] <= b.m_aabbMax[d] && b.m_aabbMin[d] <= a.m_aabbMax[d])) return false;
  return true;
}

bool filters_accept(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return (a.m_collisionFilterGroup & b.m_collisionFilterMask) != 0 &&
         (b.m_collisionFilterGroup & a.m_collisionFilterMask) != 0;
}

bool is_box(const btBroadphaseProxy& proxy) {
  for (int d = 0; d < 3; ++d)
    if (!(proxy.m_aabbMin[d] <= proxy.m_aabbMax[d])) return false;
  return true;
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
  const auto [e, f] = std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
  if (e == expected.end() && f == found.end()) return {};
  const bool missing = f == found.end() || (e != expected.end() && *e < *f);
  return fmt::format("{} after {} steps: {} pairs, {} expected; first {}: {}", simulation.broadphase_name(),
                     simulation.steps_done(), found.size(), expected.size(), missing ? "missing" : "extra",
                     describe(simulation, missing ? *e : *f));
}

}  // namespace

std::vector<Pair> expected_pairs(const Simulation& simulation) {
  const auto count = static_cast<std::uint32_t>(simulation.objects().size());
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < count; ++i)
    if (is_in_world(simulation, i) && is_box(proxy_of(simulation, i))) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return proxy_of(simulation, a).m_aabbMin.x() < proxy_of(simulation, b).m_aabbMin.x();
  });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const btBroadphaseProxy& a = proxy_of(simulation, order[i]);
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const btBroadphaseProxy& b = proxy_of(simulation, order[j]);
      if (b.m_aabbMin.x() > a.m_aabbMax.x()) break;
      if (boxes_overlap(a, b) && filters_accept(a, b))
        pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
    }
  }
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
    if (boxes_overlap(proxy_of(simulation, pair.a), proxy_of(simulation, pair.b))) kept.push_back(pair);
  return kept;
}

std::string check_pairs(const Simulation& simulation) {
  const std::vector<Pair> held = held_pairs(simulation);
  const std::string& name = simulation.broadphase_name();
  const bool exact = name == "boxstream" || name == "simple";
  // A pair listed twice shows as a difference, too: both lists are sorted and compared as they are.
  return difference(simulation, expected_pairs(simulation), exact ? held : overlapping_only(simulation, held));
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
    const std::string name = simulation.broadphase_name();
    const bool exact = name == "boxstream" || name == "simple";
    const std::string text = difference(simulation, wanted, exact ? found : overlapping_only(simulation, found));
    if (!text.empty()) return fmt::format("list of ghost {}: {}", g, text);
  }
  return {};
}

}  // namespace boxstream::scenes
