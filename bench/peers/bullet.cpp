// SPDX-License-Identifier: MIT
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>
#include <cstdint>

#include "peers/bullet_boxes.hpp"
#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

/// A broad-phase filled with one proxy a box.
class Filled {
 public:
  Filled(std::unique_ptr<btBroadphaseInterface> broadphase, bool frees_proxies, Span<const Aabb> boxes)
      : broadphase_(std::move(broadphase)), frees_proxies_(frees_proxies) {
    proxies_.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      proxies_.push_back(broadphase_->createProxy(vector(boxes[i].min), vector(boxes[i].max), 0,
                                                  reinterpret_cast<void*>(std::uintptr_t{i}), 1, 1, nullptr));
  }
  ~Filled() {
    if (frees_proxies_) return;
    // With its pairs gone first, a proxy goes without a walk through all of them.
    broadphase_->getOverlappingPairCache()->getOverlappingPairArray().clear();
    for (btBroadphaseProxy* proxy : proxies_) broadphase_->destroyProxy(proxy, nullptr);
  }
  Filled(const Filled&) = delete;
  Filled& operator=(const Filled&) = delete;

  void move(Span<const Aabb> boxes, Span<const std::uint32_t> moved) {
    for (const std::uint32_t i : moved)
      broadphase_->setAabb(proxies_[i], vector(boxes[i].min), vector(boxes[i].max), nullptr);
  }

  std::size_t held() const {
    return static_cast<std::size_t>(broadphase_->getOverlappingPairCache()->getNumOverlappingPairs());
  }

  /// Bullet holds pairs of fat boxes, and some that are over: the list of exact ones takes a comparison each.
  void collect(Span<const Aabb> boxes, std::vector<Pair>& pairs) {
    broadphase_->calculateOverlappingPairs(nullptr);
    pairs.clear();
    btOverlappingPairCache* const cache = broadphase_->getOverlappingPairCache();
    const btBroadphasePair* const held = cache->getOverlappingPairArrayPtr();
    for (int i = 0, count = cache->getNumOverlappingPairs(); i < count; ++i) {
      const std::uint32_t a = index_of(held[i].m_pProxy0), b = index_of(held[i].m_pProxy1);
      if (overlaps(boxes[a], boxes[b])) pairs.push_back(a < b ? Pair{a, b} : Pair{b, a});
    }
  }

 private:
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  bool frees_proxies_;  // when it is destroyed
  std::vector<btBroadphaseProxy*> proxies_;
};

class BulletPeer final : public Peer {
 public:
  using Make = std::unique_ptr<btBroadphaseInterface> (*)(Span<const Aabb> boxes);
  BulletPeer(Make make, bool frees_proxies) : make_(make), frees_proxies_(frees_proxies) {}

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    worlds_.push_back(std::make_unique<Filled>(make_(boxes), frees_proxies_, boxes));
    worlds_.back()->collect(boxes, pairs);
  }
  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs) override {
    worlds_.back()->move(boxes, moved);
    worlds_.back()->collect(boxes, pairs);
  }
  std::size_t candidates() const override { return worlds_.back()->held(); }
  void release() override { worlds_.clear(); }

 private:
  Make make_;
  bool frees_proxies_;
  std::vector<std::unique_ptr<Filled>> worlds_;
};

template <bool deferred>
std::unique_ptr<btBroadphaseInterface> make_dbvt(Span<const Aabb>) {
  auto broadphase = std::make_unique<btDbvtBroadphase>();
  broadphase->m_deferedcollide = deferred;
  return broadphase;
}

std::unique_ptr<btBroadphaseInterface> make_axis_sweep(Span<const Aabb> boxes) {
  btVector3 low(0, 0, 0), high(1, 1, 1);
  if (!boxes.empty()) {
    Aabb all = boxes[0];
    for (const Aabb& box : boxes) all = merged(all, box);
    // Room to move; boxes beyond it would be clamped to its faces, which costs time but no pairs.
    const btVector3 size = vector(all.max) - vector(all.min);
    low = vector(all.min) - 0.25f * size;
    high = vector(all.max) + 0.25f * size;
  }
  return std::make_unique<bt32BitAxisSweep3>(low, high, static_cast<unsigned>(boxes.size() + 1), nullptr, true);
}

}  // namespace

std::vector<PeerConfig> make_bullet_peers() {
  std::vector<PeerConfig> peers;
  const auto add = [&peers](const char* name, BulletPeer::Make make, bool frees_proxies) {
    peers.push_back({name, name, 1, "", std::make_unique<BulletPeer>(make, frees_proxies)});
  };
  add("dbvt", make_dbvt<false>, false);
  add("dbvt-deferred", make_dbvt<true>, false);
  add("axis-sweep32", make_axis_sweep, true);
  return peers;
}

}  // namespace boxstream::bench
