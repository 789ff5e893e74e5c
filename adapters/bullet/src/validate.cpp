// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "broadphase_impl.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

void check(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

bool contains(const std::vector<std::uint64_t>& sorted_keys, std::uint64_t key) {
  return std::binary_search(sorted_keys.begin(), sorted_keys.end(), key);
}

std::vector<std::uint64_t> sorted(std::vector<std::uint64_t> keys) {
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace

void PairLinks::validate(const btBroadphasePairArray& pairs) const {
  if (!built_) return;
  const auto owner = [&](std::uint32_t link) {
    const btBroadphasePair& pair = pairs[int(link / 2)];
    return static_cast<const Proxy*>(link % 2 == 0 ? pair.m_pProxy0 : pair.m_pProxy1);
  };
  const auto count = 2 * std::uint32_t(pairs.size());
  check(nodes_.size() >= count, "links: fewer than pairs");
  std::unordered_map<const Proxy*, std::uint32_t> degrees;
  for (std::uint32_t link = 0; link < count; ++link) {
    const Proxy* const proxy = owner(link);
    const Node& node = nodes_[link];
    check(has_list(*proxy), "links: a proxy with pairs has no list");
    ++degrees[proxy];
    check(node.previous == no_link || node.previous < count, "links: a link leads nowhere");
    check(node.next == no_link || node.next < count, "links: a link leads nowhere");
    check((node.previous == no_link ? proxy->first_link : nodes_[node.previous].next) == link,
          "links: the link before does not lead here");
    check(node.next == no_link || (nodes_[node.next].previous == link && owner(node.next) == proxy),
          "links: the link after does not lead back");
  }
  for (const auto& [proxy, degree] : degrees) check(proxy->degree == degree, "links: a list of the wrong length");
}

void PairStore::validate() {
  splice_late();
  const auto count = std::uint32_t(pairs_.size());
  check(!is_in_world_order() || world_pairs_ <= count, "pairs: fewer than the World has");
  std::vector<std::uint64_t> keys;
  for (std::uint32_t i = 0; i < count; ++i) {
    const btBroadphasePair& pair = pairs_[int(i)];
    check(pair.m_pProxy0 != nullptr && pair.m_pProxy1 != nullptr, "pairs: a hole");
    check(pair.m_pProxy0->m_uniqueId < pair.m_pProxy1->m_uniqueId, "pairs: the lower id does not go first");
    keys.push_back(pair_key(*pair.m_pProxy0, *pair.m_pProxy1));
  }
  const std::vector<std::uint64_t> all = sorted(keys);
  check(std::adjacent_find(all.begin(), all.end()) == all.end(), "pairs: one is held twice");
  for (std::uint32_t i = 1; i < in_order(); ++i)
    check(comes_before(pairs_[int(i) - 1], pairs_[int(i)]), "pairs: not in the order of creation");
  links_.validate(pairs_);
}

void PairCache::validate(const BasicWorld<btScalar>& world) {
  store_.validate();
  std::vector<std::uint64_t> held, of_world;
  for (std::uint32_t i = 0; i < store_.size(); ++i)
    held.push_back(pair_key(*store_[i].m_pProxy0, *store_[i].m_pProxy1));
  held = sorted(held);
  world.for_each_pair([&](ProxyPair pair) {
    if (!world.contains(pair.a) || !world.contains(pair.b)) return true;
    of_world.push_back(pair_key(proxy_of(world, pair.a), proxy_of(world, pair.b)));
    check(contains(held, of_world.back()) || user_changes_.contains(pair.a, pair.b),
          "cache: a pair of the World is missing");
    return true;
  });
  of_world = sorted(of_world);
  for (std::uint32_t i = 0; i < store_.in_order(); ++i)
    check(contains(of_world, pair_key(*store_[i].m_pProxy0, *store_[i].m_pProxy1)),
          "cache: a pair among the World's that it does not have");
}

void Broadphase::Impl::validate() {
  rooms.validate(live, world, own && own->getOverlapFilterCallback() != nullptr);
  if (!rooms.are_open()) surroundings.validate(live, world);
  if (own && own->is_settled() && (!rooms.are_open() || rooms.are_few()))
    few_verdicts.validate(live, own->store(), world, default_rule);
  if (rooms.are_open() || all_have_begun) flush_pending();  // held pairs touch by boxes that the World may not have
  world.validate();
  std::unordered_set<const btBroadphaseProxy*> proxies;
  std::unordered_set<int> seen_ids;
  std::size_t known = 0;
  for (std::size_t i = 0; i < live.size(); ++i) {
    const Proxy& proxy = *live[i];
    check(proxies.insert(&proxy).second, "proxies: one is listed twice");
    check(proxy.position == i, "proxies: a wrong position");
    check(!proxy.destroyed, "proxies: one that was destroyed is listed");
    check(proxy.m_uniqueId > 0 && seen_ids.insert(proxy.m_uniqueId).second, "proxies: a unique id that is not");
    const bool is_pending = pending.contains(proxy);
    if (!proxy.id) {
      check(is_pending, "proxies: one that is neither pending nor in the World");
      continue;
    }
    ++known;
    check(world.contains(proxy.id) && world.user(proxy.id) == reinterpret_cast<std::uintptr_t>(&proxy),
          "proxies: the World has another one");
    const Box box = world.box(proxy.id), given = box_in_world(proxy);
    check(is_pending || box == given || rooms.differs(proxy) || (!is_valid(box) && !is_valid(given)),
          "proxies: the World has another box");
  }
  check(world.size() == known + destroyed.size(), "proxies: the World has some that are gone");
  check(pending.empty() || has_pending.load(), "proxies: changes are pending, and has_pending is false");

  const btBroadphasePair* const pairs =
      cache->getNumOverlappingPairs() == 0 ? nullptr : cache->getOverlappingPairArrayPtr();
  for (int i = 0; i < cache->getNumOverlappingPairs(); ++i)
    check(proxies.count(pairs[i].m_pProxy0) != 0 && proxies.count(pairs[i].m_pProxy1) != 0,
          "cache: a pair of a proxy that is gone");
  world.for_each_pair([&](ProxyPair pair) {
    const bool may_be_gone = !own || !destroyed.empty();
    check(may_be_gone || (world.contains(pair.a) && world.contains(pair.b)), "World: a pair of one that is gone");
    return true;
  });
  if (own && world_lags)
    own->store().validate();
  else if (own)
    own->validate(world);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
