// SPDX-License-Identifier: MIT
#include "pair_orders/pair_sorter.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

namespace boxstream::report {
namespace {

/// The last step of splitmix64.
std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

btVector3 middle_of_shared(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  btVector3 low = a.m_aabbMin, high = a.m_aabbMax;
  low.setMax(b.m_aabbMin);
  high.setMin(b.m_aabbMax);
  return (low + high) / 2;
}

/// Compares as the number does.
std::uint64_t key(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t sign = std::uint64_t{1} << 63;
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// 21 bits, with two free ones between any two.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// Cells of 1/16 m, 65 km each way.
std::uint64_t place_on_curve(const btVector3& point) {
  constexpr double most = (1 << 21) - 1;
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp(double{point[axis]} * 16 + (1 << 20), 0.0, most);
    place |= spread(static_cast<std::uint64_t>(cell)) << axis;
  }
  return place;
}

bool is_fixed(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject)->isStaticOrKinematicObject();
}

}  // namespace

PairOrder parse_order(const std::string& name) {
  using By = PairOrder::By;
  static const std::map<std::string, PairOrder> known{
      {"ids", {By::ids}},     {"low first", {By::low}},       {"high first", {By::high}},
      {"curve", {By::curve}}, {"ground first", {By::ground}}, {"shuffled", {By::random, 0, true}},
  };
  const auto found = known.find(name);
  if (found == known.end()) throw std::invalid_argument("no order \"" + name + "\"");
  return found->second;
}

void PairSorter::begin() {
  keyed_.clear();
  pairs_.clear();
  if (order_.anew) ++order_.seed;
}

void PairSorter::add(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const auto id = [](const btBroadphaseProxy& proxy) { return static_cast<std::uint32_t>(proxy.m_uniqueId); };
  const std::uint64_t ids = std::uint64_t{id(a)} << 32 | id(b);
  keyed_.push_back({key_of(a, b, ids), ids, static_cast<std::uint32_t>(keyed_.size())});
  if (order_.by == PairOrder::By::ground) pairs_.emplace_back(&a, &b);
}

std::uint64_t PairSorter::key_of(const btBroadphaseProxy& a, const btBroadphaseProxy& b, std::uint64_t ids) const {
  switch (order_.by) {
    case PairOrder::By::low:
      return key(-double{middle_of_shared(a, b).dot(gravity_)});
    case PairOrder::By::high:
      return key(double{middle_of_shared(a, b).dot(gravity_)});
    case PairOrder::By::curve:
      return place_on_curve(middle_of_shared(a, b));
    case PairOrder::By::random:
      return hash(ids ^ hash(order_.seed));
    default:
      return 0;
  }
}

/// Breadth first.
void PairSorter::find_distances() {
  constexpr std::uint64_t far = std::numeric_limits<std::uint32_t>::max();
  std::unordered_map<const btBroadphaseProxy*, std::uint64_t> distances;
  for (const auto& [a, b] : pairs_)
    for (const btBroadphaseProxy* proxy : {a, b}) distances.emplace(proxy, is_fixed(*proxy) ? 0 : far);
  bool more = true;
  for (std::uint64_t distance = 0; more; ++distance) {
    more = false;
    for (const auto& [a, b] : pairs_) {
      std::uint64_t &of_a = distances[a], &of_b = distances[b];
      if (std::min(of_a, of_b) != distance || std::max(of_a, of_b) != far) continue;
      (of_a == far ? of_a : of_b) = distance + 1;
      more = true;
    }
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    keyed_[i].key = distances[pairs_[i].first] + distances[pairs_[i].second];
}

const std::vector<std::uint32_t>& PairSorter::sort() {
  if (order_.by == PairOrder::By::ground) find_distances();
  std::sort(keyed_.begin(), keyed_.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.ids != b.ids ? a.ids < b.ids : a.place < b.place;
  });
  permutation_.clear();
  for (const Keyed& keyed : keyed_) permutation_.push_back(keyed.place);
  return permutation_;
}

}  // namespace boxstream::report
