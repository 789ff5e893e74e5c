// SPDX-License-Identifier: MIT
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>
#include <cstdint>

#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

btVector3 vector(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

std::uint32_t index_of(const btBroadphaseProxy* proxy) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(proxy->m_clientObject));
}

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

class BulletPeer : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) final {
    worlds_.push_back(fill(boxes));
    worlds_.back()->collect(boxes, pairs);
  }
  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs) final {
    worlds_.back()->move(boxes, moved);
    worlds_.back()->collect(boxes, pairs);
  }
  std::size_t candidates() const final { return worlds_.back()->held(); }
  void release() final { worlds_.clear(); }

 private:
  virtual std::unique_ptr<Filled> fill(Span<const Aabb> boxes) const = 0;

  std::vector<std::unique_ptr<Filled>> worlds_;
};

class Dbvt final : public BulletPeer {
 public:
  explicit Dbvt(bool deferred) : deferred_(deferred) {}

 private:
  std::unique_ptr<Filled> fill(Span<const Aabb> boxes) const override {
    auto broadphase = std::make_unique<btDbvtBroadphase>();
    broadphase->m_deferedcollide = deferred_;
    return std::make_unique<Filled>(std::move(broadphase), false, boxes);
  }

  bool deferred_;
};

class AxisSweep final : public BulletPeer {
  std::unique_ptr<Filled> fill(Span<const Aabb> boxes) const override {
    btVector3 low(0, 0, 0), high(1, 1, 1);
    if (!boxes.empty()) {
      Aabb all = boxes[0];
      for (const Aabb& box : boxes) all = merged(all, box);
      // Room to move; boxes beyond it would be clamped to its faces, which costs time but no pairs.
      const btVector3 size = vector(all.max) - vector(all.min);
      low = vector(all.min) - 0.25f * size;
      high = vector(all.max) + 0.25f * size;
    }
    const auto handles = static_cast<unsigned>(boxes.size() + 1);
    return std::make_unique<Filled>(std::make_unique<bt32BitAxisSweep3>(low, high, handles, nullptr, true), true,
                                    boxes);
  }
};

}  // namespace

std::vector<PeerConfig> make_bullet_peers() {
  std::vector<PeerConfig> peers;
  peers.push_back({"dbvt", "dbvt", 1, "", std::make_unique<Dbvt>(false)});
  peers.push_back({"dbvt-deferred", "dbvt-deferred", 1, "", std::make_unique<Dbvt>(true)});
  peers.push_back({"axis-sweep32", "axis-sweep32", 1, "", std::make_unique<AxisSweep>()});
  return peers;
}

}  // namespace boxstream::bench
