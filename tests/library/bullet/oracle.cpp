// SPDX-License-Identifier: MIT
#include "oracle.hpp"

#include <algorithm>
#include <sstream>

namespace boxstream::bullet_test {

bool is_valid_box(const btVector3& lo, const btVector3& hi) {
  return lo.x() <= hi.x() && lo.y() <= hi.y() && lo.z() <= hi.z();
}

bool boxes_overlap(const btVector3& lo0, const btVector3& hi0, const btVector3& lo1, const btVector3& hi1) {
  for (int d = 0; d < 3; ++d)
    if (!(lo0[d] <= hi1[d] && lo1[d] <= hi0[d])) return false;
  return true;
}

btBroadphaseProxy* Oracle::createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client,
                                       int group, int mask, btDispatcher* dispatcher) {
  btBroadphaseProxy* proxy = inner().createProxy(lo, hi, shape_type, client, group, mask, dispatcher);
  records_[proxy] = Record{next_serial_++, lo, hi};
  return proxy;
}

void Oracle::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  const std::uint32_t gone = records_.at(proxy).serial;
  records_.erase(proxy);
  expected_.erase(std::remove_if(expected_.begin(), expected_.end(),
                                 [gone](SerialPair p) { return p.first == gone || p.second == gone; }),
                  expected_.end());
  inner().destroyProxy(proxy, dispatcher);
}

void Oracle::setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) {
  Record& record = records_.at(proxy);
  record.lo = lo;
  record.hi = hi;
  inner().setAabb(proxy, lo, hi, dispatcher);
}

void Oracle::calculateOverlappingPairs(btDispatcher* dispatcher) {
  inner().calculateOverlappingPairs(dispatcher);
  update_expected();
  ++calculations_;
  if (after_calculate) after_calculate();
}

std::vector<Oracle::Live> Oracle::live_by_serial() const {
  std::vector<Live> live;
  live.reserve(records_.size());
  for (const auto& [proxy, record] : records_)
    live.push_back({const_cast<btBroadphaseProxy*>(proxy), record, is_valid_box(record.lo, record.hi)});
  std::sort(live.begin(), live.end(), [](const Live& a, const Live& b) { return a.record.serial < b.record.serial; });
  return live;
}

void Oracle::update_expected() {
  const btOverlappingPairCache* cache = getOverlappingPairCache();
  std::vector<SerialPair> now;
  const std::vector<Live> live = live_by_serial();
  auto before = expected_.begin();  // both lists ascend, so one walk finds which pairs were there already
  for (std::size_t i = 0; i < live.size(); ++i) {
    if (!live[i].valid) continue;
    for (std::size_t j = i + 1; j < live.size(); ++j) {
      const Live &a = live[i], &b = live[j];
      if (!b.valid || !boxes_overlap(a.record.lo, a.record.hi, b.record.lo, b.record.hi)) continue;
      const SerialPair pair{a.record.serial, b.record.serial};
      while (before != expected_.end() && *before < pair) ++before;
      const bool held = before != expected_.end() && *before == pair;
      if (held || cache->needsBroadphaseCollision(a.proxy, b.proxy)) now.push_back(pair);
    }
  }
  expected_ = std::move(now);
}

testing::AssertionResult Oracle::check(Rule rule) const {
  const btOverlappingPairCache* cache = getOverlappingPairCache();
  std::vector<SerialPair> held;
  const int count = cache->getNumOverlappingPairs();
  const btBroadphasePair* pairs = count > 0 ? cache->getOverlappingPairArrayPtr() : nullptr;
  for (int i = 0; i < count; ++i) {
    const auto a = records_.find(pairs[i].m_pProxy0), b = records_.find(pairs[i].m_pProxy1);
    if (a == records_.end() || b == records_.end())
      return testing::AssertionFailure() << "pair " << i << " of " << count << " names a proxy that is not alive";
    if (a->first->m_uniqueId >= b->first->m_uniqueId)
      return testing::AssertionFailure() << "pair " << i << " has unique ids " << a->first->m_uniqueId << ", "
                                         << b->first->m_uniqueId << ": the lower one goes first";
    const Record &p = a->second, &q = b->second;
    if (!is_valid_box(p.lo, p.hi) || !is_valid_box(q.lo, q.hi)) continue;
    if (rule == Rule::superset && !boxes_overlap(p.lo, p.hi, q.lo, q.hi)) continue;
    held.push_back(std::minmax(p.serial, q.serial));
  }
  std::sort(held.begin(), held.end());
  if (const auto twice = std::adjacent_find(held.begin(), held.end()); twice != held.end())
    return testing::AssertionFailure() << "held twice: " << describe(*twice);

  std::vector<SerialPair> missing, extra;
  std::set_difference(expected_.begin(), expected_.end(), held.begin(), held.end(), std::back_inserter(missing));
  std::set_difference(held.begin(), held.end(), expected_.begin(), expected_.end(), std::back_inserter(extra));
  if (missing.empty() && extra.empty()) return testing::AssertionSuccess();
  testing::AssertionResult failure = testing::AssertionFailure();
  failure << "after calculation " << calculations_ << ": " << missing.size() << " of " << expected_.size()
          << " pairs missing, " << extra.size() << " extra";
  if (!missing.empty()) failure << "; first missing: " << describe(missing.front());
  if (!extra.empty()) failure << "; first extra: " << describe(extra.front());
  return failure;
}

std::vector<const btBroadphaseProxy*> Oracle::expected_partners(const btBroadphaseProxy* proxy) const {
  const std::uint32_t me = serial(proxy);
  std::vector<const btBroadphaseProxy*> partners;
  std::unordered_map<std::uint32_t, const btBroadphaseProxy*> by_serial;
  for (const auto& [other, record] : records_) by_serial[record.serial] = other;
  for (const auto& [a, b] : expected_)
    if (a == me || b == me) partners.push_back(by_serial.at(a == me ? b : a));
  return partners;
}

std::vector<const btBroadphaseProxy*> Oracle::expected_in_box(const btVector3& lo, const btVector3& hi) const {
  std::vector<const btBroadphaseProxy*> found;
  for (const Live& l : live_by_serial())
    if (l.valid && boxes_overlap(l.record.lo, l.record.hi, lo, hi)) found.push_back(l.proxy);
  return found;
}

bool Oracle::overlap_now(const btBroadphaseProxy* a, const btBroadphaseProxy* b) const {
  const Record &p = records_.at(a), &q = records_.at(b);
  return is_valid_box(p.lo, p.hi) && is_valid_box(q.lo, q.hi) && boxes_overlap(p.lo, p.hi, q.lo, q.hi);
}

std::string Oracle::describe(SerialPair pair) const {
  std::ostringstream out;
  out.precision(9);
  for (const std::uint32_t wanted : {pair.first, pair.second})
    for (const auto& [proxy, record] : records_)
      if (record.serial == wanted) {
        out << " #" << wanted << " (uid " << proxy->m_uniqueId << ", group " << proxy->m_collisionFilterGroup
            << ", mask " << proxy->m_collisionFilterMask << ") [";
        for (int d = 0; d < 3; ++d) out << record.lo[d] << " .. " << record.hi[d] << (d < 2 ? ", " : "]");
      }
  return out.str();
}

testing::AssertionResult check(btCollisionWorld& world, Rule rule) {
  return static_cast<Oracle*>(world.getBroadphase())->check(rule);
}

}  // namespace boxstream::bullet_test
